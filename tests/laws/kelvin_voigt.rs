//! A dashpot beside the spring: `#[viscosity(lambda = …)]`.

use core::fmt::Debug;

use eem::materials::KelvinVoigtDamper;
use eem::prelude::*;
use eem::{Domain, DomainError, SceneError, StateError, check_domain};
use eem_testkit::length::at_length;

use crate::support::orders::runge_kutta;
use crate::support::springs::linear;
use crate::support::tangents::assert_tangent;
use crate::support::{Laws, only_error};

/// As in `several_dashpots`.
const ENERGY_TOLERANCE: f64 = 4e-15;
const ENTROPY_TOLERANCE: f64 = -2.0;

pub(crate) const ROOM: f64 = 300.0;
pub(crate) const CONDUCTANCE: f64 = 3.0;
/// Those that keep the laws.
const SCHEMES: [Scheme; 5] = [
    Scheme::EemEntropy,
    Scheme::EemTemperature,
    Scheme::EemDamped,
    Scheme::EemEntropy4,
    Scheme::EemEntropy6,
];
/// All that step such an element.
const ALL: [Scheme; 9] = [
    Scheme::EemEntropy,
    Scheme::EemTemperature,
    Scheme::EemDamped,
    Scheme::EemEntropy4,
    Scheme::EemEntropy6,
    Scheme::Midpoint,
    Scheme::MidpointTemperature,
    Scheme::Trapezoidal,
    Scheme::TrapezoidalTemperature,
];

pub(crate) const VOIGT: KelvinVoigtDamper = KelvinVoigtDamper {
    stiffness: 60.0,
    coupling: 0.1,
    capacity: 2.0,
    natural_length: 1.0,
    theta_ref: 300.0,
    a: 800.0,
    eta: 1.5,
};

/// Its η by hand.
fn viscosity(theta: f64) -> f64 {
    VOIGT.eta * (VOIGT.a * (1.0 / theta - 1.0 / VOIGT.theta_ref)).exp()
}

/// With a dashpot of each kind.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    let strain = ln(lambda);
    0.5 * k * strain.powi(2) + 0.5 * branch * (strain - gamma).powi(2)
        - beta * (theta - theta_ref) * strain
        + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
})]
#[viscosity(gamma = slow * theta_ref / theta, lambda = fast * (theta_ref / theta).powf(1.5))]
pub(crate) struct Both {
    pub(crate) k: f64,
    pub(crate) branch: f64,
    pub(crate) beta: f64,
    pub(crate) capacity: f64,
    pub(crate) theta_ref: f64,
    pub(crate) slow: f64,
    pub(crate) fast: f64,
}

pub(crate) const BOTH: Both = Both {
    k: 60.0,
    branch: 30.0,
    beta: 0.1,
    capacity: 2.0,
    theta_ref: 300.0,
    slow: 9.0,
    fast: 0.7,
};

/// Without temperature.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch| 0.5 * k * (lambda - 1).powi(2))]
#[viscosity(lambda = eta)]
pub(crate) struct Isothermal {
    pub(crate) k: f64,
    pub(crate) eta: f64,
}

/// A mass of 1 kg on the model, stretched, turning, hot, and cooled by the room.
pub(crate) fn pendulum<M>(model: M, scheme: Scheme, step: f64) -> (Simulation<2>, Node, Element)
where
    M: FreeEnergy<f64> + Debug + Send + Sync + 'static,
{
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [1.4, 0.0], [0.3, 1.0]);
    let spring = scene.spring(model, [pivot, bob]);
    if M::THERMAL {
        scene.set_temperature(spring, 340.0);
        let room = scene.reservoir(ROOM);
        scene.conduct(spring, room, CONDUCTANCE);
    }
    (Simulation::new(scene, scheme, step).unwrap(), bob, spring)
}

/// A random walk of roundings, as in `high_order` with stages.
fn momentum_tolerance(scheme: Scheme) -> f64 {
    if scheme.order() == 2 {
        ENERGY_TOLERANCE
    } else {
        1e-13
    }
}

fn keeps_all_laws<M>(model: &M, tolerance: f64)
where
    M: FreeEnergy<f64> + Clone + Debug + Send + Sync + 'static,
{
    let cases = SCHEMES
        .into_iter()
        .flat_map(|scheme| [(scheme, 0.005), (scheme, 0.05), (scheme, 0.3)]);
    // More than two thirds of the period is too much for several stages.
    for (scheme, step) in cases.filter(|&(scheme, step)| scheme.order() == 2 || step < 0.3) {
        let (mut run, ..) = pendulum(model.clone(), scheme, step);
        let mut laws = Laws::new(&run);
        for _ in 0..at_length(500, 80) {
            run.step().unwrap();
            laws.watch(&run);
        }
        println!("{}, h = {step}: {laws:?}", scheme.name());
        assert!(laws.energy <= tolerance);
        assert!(laws.angular_momentum <= tolerance.max(momentum_tolerance(scheme)));
        assert!(laws.entropy_ulps >= ENTROPY_TOLERANCE);
    }
}

#[test]
fn all_laws_are_kept_at_any_step() {
    keeps_all_laws(&VOIGT, ENERGY_TOLERANCE);
    keeps_all_laws(&BOTH, ENERGY_TOLERANCE);
    // Hardly there at all, and beyond the spring by far.
    for eta in [1e-9, 1e4, 1e5] {
        keeps_all_laws(&KelvinVoigtDamper { eta, ..VOIGT }, 1e-13);
        keeps_all_laws(&Both { fast: eta, ..BOTH }, 1e-13);
    }
}

#[test]
fn free_masses_keep_their_momenta() {
    for scheme in SCHEMES {
        let mut scene = Scene::<3>::new();
        let masses = [
            scene.mass(1.0, [0.0, 0.0, 0.1], [0.2, -0.4, 0.0]),
            scene.mass(2.0, [1.3, 0.2, 0.0], [0.0, 1.0, 0.5]),
            scene.mass(0.5, [0.3, 1.1, 0.4], [-1.0, 0.0, 0.3]),
        ];
        for (i, j, theta) in [(0, 1, 310.0), (1, 2, 330.0), (2, 0, 350.0)] {
            let spring = scene.spring(VOIGT, [masses[i], masses[j]]);
            scene.set_temperature(spring, theta);
        }
        let mut run = Simulation::new(scene, scheme, 0.1).unwrap();
        let mut laws = Laws::new(&run);
        for _ in 0..300 {
            run.step().unwrap();
            laws.watch(&run);
        }
        println!("{scheme}: {laws:?}");
        assert!(laws.energy <= ENERGY_TOLERANCE);
        assert!(laws.angular_momentum <= momentum_tolerance(scheme));
        assert!(laws.entropy_ulps >= ENTROPY_TOLERANCE, "{laws:?}");
    }
}

#[test]
fn without_temperature_the_heat_is_lost() {
    for scheme in [Scheme::EemEntropy, Scheme::EemTemperature] {
        for step in [0.01, 0.2] {
            let (mut run, _, spring) = pendulum(Isothermal { k: 40.0, eta: 0.8 }, scheme, step);
            let start = run.ledger();
            let mut lost = 0.0;
            for _ in 0..400 {
                let before = run.stretch(spring).unwrap();
                run.step().unwrap();
                lost += 0.8 * (run.stretch(spring).unwrap() - before).powi(2) / step;
                let ledger = run.ledger();
                assert!((ledger.energy / start.energy - 1.0).abs() <= ENERGY_TOLERANCE);
                assert!((ledger.lost_heat - lost).abs() <= 1e-13 * start.energy);
            }
            // What is left turns without a change of length.
            assert!(lost > 0.3 * start.energy, "{lost} of {}", start.energy);
        }
    }
}

#[test]
fn ordinary_rules_lose_nearly_the_same_heat() {
    let lost = |scheme: Scheme, step: f64, steps: u32| {
        let (mut run, ..) = pendulum(Isothermal { k: 40.0, eta: 0.8 }, scheme, step);
        let start = run.ledger();
        for _ in 0..steps {
            run.step().unwrap();
        }
        let ledger = run.ledger();
        (ledger.lost_heat, (ledger.energy - start.energy).abs())
    };
    let (exact, _) = lost(Scheme::EemEntropy, 1e-3, 500);
    assert!(exact > 0.3, "{exact}");
    for scheme in ALL.into_iter().filter(|scheme| scheme.order() == 2) {
        let [coarse, fine] =
            [(0.02, 25), (0.01, 50)].map(|(step, steps)| lost(scheme, step, steps));
        println!("{scheme}: {coarse:?}, {fine:?} of {exact}");
        let [coarse_error, fine_error] = [coarse, fine].map(|(heat, _)| (heat - exact).abs());
        assert!(fine_error < 1e-3 * exact && fine_error < 0.3 * coarse_error);
        // What is lost is what is missing, but for the errors of the rule.
        assert!(fine.1 < 0.3 * coarse.1 || fine.1 < 1e-13, "{fine:?}");
    }
}

/// What a step of an insulated element is off by, relative to the largest impulse: the balance of momentum
/// and that of entropy, with the viscosity of a formula that is wrong by `error`.
fn defect(scheme: Scheme, error: f64) -> [f64; 2] {
    let h = 0.05;
    let mut scene = Scene::<1>::new();
    let pivot = scene.anchor([0.0]);
    let bob = scene.mass(1.0, [1.4], [-2.0]);
    let spring = scene.spring(VOIGT, [pivot, bob]);
    scene.set_temperature(spring, 340.0);
    let mut run = Simulation::new(scene, scheme, h).unwrap();
    let see = |run: &Simulation<1>| {
        let (lambda, theta) = (
            run.stretch(spring).unwrap(),
            run.temperature(spring).unwrap(),
        );
        let speed = run.velocity(bob).unwrap()[0];
        let entropy = run.ledger().element_entropy;
        [lambda, theta, speed, entropy]
    };
    let [lambda0, theta0, speed0, entropy0] = see(&run);
    run.step().unwrap();
    let [lambda1, theta1, speed1, entropy1] = see(&run);
    // θ* and f* of the temperature form, from the definitions: θ* = D_θ e/D_θ s, f* = D_λ e − θ* D_λ s.
    let [x00, x10, x01, x11] = [
        [lambda0, theta0],
        [lambda1, theta0],
        [lambda0, theta1],
        [lambda1, theta1],
    ];
    let energy = |x: [f64; 2]| VOIGT.internal_energy(&x);
    let entropy = |x: [f64; 2]| VOIGT.caloric(&x).entropy;
    let by_lambda = |f: &dyn Fn([f64; 2]) -> f64| {
        0.5 * ((f(x10) - f(x00)) + (f(x11) - f(x01))) / (lambda1 - lambda0)
    };
    let by_theta = |f: &dyn Fn([f64; 2]) -> f64| {
        0.5 * ((f(x01) - f(x00)) + (f(x11) - f(x10))) / (theta1 - theta0)
    };
    let theta = by_theta(&energy) / by_theta(&entropy);
    let force = by_lambda(&energy) - theta * by_lambda(&entropy);
    let eta = viscosity(theta) * (1.0 + error);
    let drag = eta * (lambda1 - lambda0) / h;
    let momentum = (speed1 - speed0) + h * (force + drag);
    let heat = drag * (lambda1 - lambda0) / theta;
    [momentum / (h * drag), (entropy1 - entropy0 - heat) / heat]
}

#[test]
fn a_step_is_that_of_the_formulas() {
    // The differences by θ lose digits: a kelvin of 340.
    let close = |[momentum, entropy]: [f64; 2]| momentum.abs() < 1e-9 && entropy.abs() < 1e-9;
    let found = defect(Scheme::EemTemperature, 0.0);
    assert!(close(found), "{found:?}");
    let spoilt = defect(Scheme::EemTemperature, 1e-6);
    assert!(
        spoilt.iter().all(|defect| defect.abs() > 5e-7),
        "{spoilt:?}"
    );
}

/// (q, p, θ).
type State = [f64; 5];

/// The continuous equations, from gradient and Hessian of ψ and the formula of η:
///
/// ```text
/// q̇ = p/m,   ṗ = −(f + η λ̇) q/λ,   ṡ = (η λ̇² + κ (θr − θ))/θ,   θ̇ = (ṡ − s_λ λ̇)/s_θ
/// ```
fn rate(z: &State) -> State {
    let [qx, qy, px, py, theta] = *z;
    let lambda = qx.hypot(qy);
    let (gradient, hessian) = VOIGT.hessian(&[lambda, theta]);
    let eta = viscosity(theta);
    let stretch_rate = (qx * px + qy * py) / lambda;
    let entropy_rate = (eta * stretch_rate.powi(2) + CONDUCTANCE * (ROOM - theta)) / theta;
    let theta_rate = (entropy_rate + hessian[1][0] * stretch_rate) / -hessian[1][1];
    let pull = -(gradient[0] + eta * stretch_rate) / lambda;
    [px, py, pull * qx, pull * qy, theta_rate]
}

#[test]
fn solutions_are_of_the_order_of_their_scheme() {
    const END: f64 = 0.6;
    let exact = runge_kutta(rate, [1.4, 0.0, 0.3, 1.0, 340.0], END, 20_000);
    for scheme in ALL {
        let error = |steps: u32| {
            let (mut run, bob, spring) = pendulum(VOIGT, scheme, END / f64::from(steps));
            for _ in 0..steps {
                run.step().unwrap();
            }
            let (q, v) = (run.position(bob).unwrap(), run.velocity(bob).unwrap());
            let found = [
                q[0],
                q[1],
                v[0],
                v[1],
                run.temperature(spring).unwrap() / 300.0,
            ];
            let exact = [exact[0], exact[1], exact[2], exact[3], exact[4] / 300.0];
            let errors = found
                .iter()
                .zip(exact)
                .map(|(found, exact)| (found - exact).abs());
            errors.fold(0.0, f64::max)
        };
        let steps = [0, 120, 0, 60, 0, 24][usize::from(scheme.order() - 1)];
        let [coarse, fine] = [error(steps), error(2 * steps)];
        let order = (coarse / fine).log2();
        println!("{scheme}: {coarse:e}, {fine:e}, order {order}");
        assert!((order - f64::from(scheme.order())).abs() < 0.1 && fine < 1e-3);
    }
}

#[test]
fn the_tangent_of_a_step_is_exact() {
    for scheme in ALL {
        let mut run = pendulum(BOTH, scheme, 0.1).0;
        let at = &[0.02, 0.07, 0.04, 0.05, 0.06, 0.03][..run.unknowns()];
        assert_tangent(&mut run, at, 0..at.len(), (|_| 1e-4, 2e-8));
    }
}

#[test]
fn other_schemes_refuse_it() {
    for scheme in Scheme::ALL {
        let mut scene = Scene::<2>::new();
        let pivot = scene.anchor([0.0, 0.0]);
        let bob = scene.mass(1.0, [1.4, 0.0], [0.3, 1.0]);
        scene.spring(linear(3.0), [pivot, bob]);
        let spring = scene.spring(Isothermal { k: 40.0, eta: 0.8 }, [pivot, bob]);
        let result = Simulation::new(scene, scheme, 0.1);
        if ALL.contains(&scheme) {
            result.unwrap();
            continue;
        }
        let error = only_error(result);
        let expected = SceneError::NoDrag {
            scheme: scheme.name(),
            element: spring,
        };
        assert_eq!(error, expected);
        let text = error.to_string();
        assert!(
            text.starts_with(scheme.name()) && text.contains("use eem-entropy or eem-temperature")
        );
    }
}

#[test]
fn a_viscosity_that_is_not_positive_is_refused() {
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [1.4, 0.0], [0.3, 1.0]);
    let spring = scene.spring(Isothermal { k: 40.0, eta: 0.0 }, [pivot, bob]);
    let error = only_error(Simulation::new(scene, Scheme::EemEntropy, 0.1));
    let SceneError::State(StateError::Drag { element, value, .. }) = error else {
        panic!("{error}");
    };
    assert!(element == spring && value == 0.0);
    assert_eq!(
        error.to_string(),
        format!(
            "at the start: the viscosity of the stretch of {spring} is 0 N s/m, it must be positive and finite"
        )
    );
    let domain = Domain::of_stretch([0.5, 2.0]);
    let model = Isothermal { k: 40.0, eta: -1.0 };
    let error = check_domain(&model, &domain, 10).unwrap_err();
    assert!(
        matches!(error, DomainError::Drag { value: -1.0, .. }),
        "{error}"
    );
    let report = check_domain(&Isothermal { eta: 2.0, ..model }, &domain, 10).unwrap();
    assert_eq!(report.drag.map(|least| least.value), Some(2.0));
    assert!(report.viscosities.is_empty());
}

#[test]
fn the_generated_viscosity_is_the_formula() {
    for theta in [250.0, 300.0, 400.0] {
        let ([eta], [slope]) = VOIGT.drag(theta);
        let expected = viscosity(theta);
        assert!((eta / expected - 1.0).abs() < 1e-14);
        let by_theta = -expected * VOIGT.a / theta.powi(2);
        assert!((slope / by_theta - 1.0).abs() < 1e-13);
    }
    let equation = KelvinVoigtDamper::DESCRIPTION
        .equation("η[lambda]")
        .unwrap();
    assert!(
        equation.starts_with("η[lambda] = ") && equation.contains("exp"),
        "{equation}"
    );
    assert_eq!(Isothermal { k: 1.0, eta: 2.0 }.drag(0.0), ([2.0], [0.0]));
    assert_eq!(linear(1.0).drag(0.0), ([], []));
}

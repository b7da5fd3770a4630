//! Several dashpots in one element: each creeps on its own, and together they keep all laws.

use core::fmt::Debug;

use eem::prelude::*;

use crate::kelvin_voigt::{CONDUCTANCE, ROOM, pendulum};
use crate::support::Laws;
use crate::support::dashpots::{ONE_DASHPOT, ThreeDashpots, TwoDashpots};
use crate::support::orders::runge_kutta;

/// As in `laws.rs`: a dozen roundings of the energies in the sum, and two of the entropy.
const ENERGY_TOLERANCE: f64 = 4e-15;
const ENTROPY_TOLERANCE: f64 = -2.0;

const SCHEMES: [Scheme; 3] = [
    Scheme::EemEntropy,
    Scheme::EemTemperature,
    Scheme::EemDamped,
];

/// The viscous stretches of an element.
fn stretches(run: &Simulation<2>, spring: Element) -> Vec<f64> {
    (0..)
        .map_while(|dashpot| run.viscous_stretch(spring, dashpot).ok())
        .collect()
}

fn keeps_all_laws<M>(model: &M, dashpots: usize)
where
    M: FreeEnergy<f64> + Clone + Debug + Send + Sync + 'static,
{
    for (scheme, step) in SCHEMES
        .into_iter()
        .flat_map(|scheme| [(scheme, 0.02), (scheme, 0.2)])
    {
        let (mut run, _, spring) = pendulum(model.clone(), scheme, step);
        assert_eq!(stretches(&run, spring).len(), dashpots);
        let mut laws = Laws::new(&run);
        for _ in 0..500 {
            run.step().unwrap();
            laws.watch(&run);
        }
        println!(
            "{dashpots} dashpots, {}, h = {step}: {laws:?}",
            scheme.name()
        );
        assert!(laws.energy <= ENERGY_TOLERANCE);
        assert!(laws.angular_momentum <= ENERGY_TOLERANCE);
        assert!(laws.entropy_ulps >= ENTROPY_TOLERANCE);
    }
}

#[test]
fn two_and_three_dashpots_keep_all_laws() {
    keeps_all_laws(&TwoDashpots::DATA, 2);
    keeps_all_laws(&ThreeDashpots::DATA, 3);
}

/// (q, p, γ₁, γ₂, γ₃, θ).
type State = [f64; 8];

/// The continuous equations, from gradient and Hessian of ψ alone:
///
/// ```text
/// q̇ = p/m,   ṗ = −f q/λ,   γ̇_k = g_k/η_k,   ṡ = (Σ g_k²/η_k + κ (θr − θ))/θ
/// θ̇ = (ṡ − s_λ λ̇ − Σ s_γ γ̇)/s_θ        with s_x = −∂²ψ/∂θ∂x
/// ```
fn rate(model: &ThreeDashpots, z: &State) -> State {
    let [qx, qy, px, py, g1, g2, g3, theta] = *z;
    let lambda = qx.hypot(qy);
    let (gradient, hessian) = model.hessian(&[lambda, g1, g2, g3, theta]);
    let (eta, _) = model.viscosity(theta);
    let creep = [0, 1, 2].map(|k| -gradient[1 + k] / eta[k]);
    let dissipation: f64 = (0..3).map(|k| -gradient[1 + k] * creep[k]).sum();
    let entropy_rate = (dissipation + CONDUCTANCE * (ROOM - theta)) / theta;
    let stretch_rate = (qx * px + qy * py) / lambda;
    let mut known = -hessian[4][0] * stretch_rate;
    for k in 0..3 {
        known -= hessian[4][1 + k] * creep[k];
    }
    let theta_rate = (entropy_rate - known) / -hessian[4][4];
    let pull = -gradient[0] / lambda;
    let [c1, c2, c3] = creep;
    [px, py, pull * qx, pull * qy, c1, c2, c3, theta_rate]
}

// Errors of second order are a quarter after halving; the next order, h⁴ of a symmetric scheme,
// changes the slope by less than a tenth at these steps.
const SLOPE_TOLERANCE: f64 = 0.1;

#[test]
fn each_dashpot_creeps_as_its_own_force_over_viscosity() {
    const END: f64 = 0.5;
    let model = ThreeDashpots::DATA;
    let start = [1.4, 0.0, 0.3, 1.0, 0.0, 0.0, 0.0, 340.0];
    let exact = runge_kutta(|z| rate(&model, z), start, END, 2_000);
    let coarse = runge_kutta(|z| rate(&model, z), start, END, 1_000);
    for scheme in SCHEMES {
        let errors = [100, 200].map(|steps| {
            let (mut run, _, spring) = pendulum(model.clone(), scheme, END / f64::from(steps));
            for _ in 0..steps {
                run.step().unwrap();
            }
            let gamma = stretches(&run, spring);
            [0, 1, 2].map(|k| (gamma[k] - exact[4 + k]).abs())
        });
        for k in 0..3 {
            let slope = (errors[0][k] / errors[1][k]).log2();
            // The oracle's own error, fifteen times that after halving, is out of sight.
            let oracle = (coarse[4 + k] - exact[4 + k]).abs();
            let (gamma, error) = (exact[4 + k], errors[1][k]);
            println!(
                "{}: γ_{k} = {gamma:.6} m, error {error:e} m, slope {slope:.3}",
                scheme.name()
            );
            assert!(gamma.abs() > 0.01 && oracle < 0.01 * error);
            assert!((slope - 2.0).abs() <= SLOPE_TOLERANCE);
        }
    }
}

/// Where two models are the same in exact arithmetic, rounding is what differs: a few ε per step
/// and quantity, which the motion carries along and which grow with the square of the steps when
/// velocities are integrated to positions.
const STEPS: u32 = 200;

fn same_tolerance() -> f64 {
    f64::EPSILON * f64::from(STEPS).powi(2)
}

/// λ, θ and γ₁ after the steps.
fn trace<M>(model: M, scheme: Scheme) -> (f64, f64, Vec<f64>)
where
    M: FreeEnergy<f64> + Debug + Send + Sync + 'static,
{
    let (mut run, _, spring) = pendulum(model, scheme, 0.02);
    for _ in 0..STEPS {
        run.step().unwrap();
    }
    let gamma = stretches(&run, spring);
    (
        run.stretch(spring).unwrap(),
        run.temperature(spring).unwrap(),
        gamma,
    )
}

#[test]
fn branches_without_stiffness_are_one_dashpot() {
    for scheme in SCHEMES {
        let (lambda, theta, gamma) = trace(ONE_DASHPOT, scheme);
        let two = TwoDashpots {
            mu2: 0.0,
            ..TwoDashpots::DATA
        };
        let three = ThreeDashpots {
            mu2: 0.0,
            mu3: 0.0,
            ..ThreeDashpots::DATA
        };
        for (other_lambda, other_theta, other) in [trace(two, scheme), trace(three, scheme)] {
            let tolerance = same_tolerance();
            println!("{}: λ off by {:e} m", scheme.name(), lambda - other_lambda);
            approx::assert_relative_eq!(lambda, other_lambda, max_relative = tolerance);
            approx::assert_relative_eq!(theta, other_theta, max_relative = tolerance);
            approx::assert_relative_eq!(gamma[0], other[0], max_relative = tolerance);
            // A branch that pulls at nothing does not move, not even by a rounding.
            assert!(other[1..].iter().all(|&gamma| gamma.abs() <= 0.0));
        }
    }
}

#[test]
fn two_equal_halves_are_one_dashpot() {
    for scheme in SCHEMES {
        let whole = ONE_DASHPOT;
        let halves = TwoDashpots {
            mu1: 0.5 * whole.mu,
            mu2: 0.5 * whole.mu,
            eta1: 0.5 * whole.eta,
            eta2: 0.5 * whole.eta,
            ..TwoDashpots::DATA
        };
        let (lambda, theta, gamma) = trace(whole, scheme);
        let (other_lambda, other_theta, other) = trace(halves, scheme);
        println!("{}: λ off by {:e} m", scheme.name(), lambda - other_lambda);
        let both = [other_lambda, other_theta, other[0], other[1]];
        for (own, other) in [lambda, theta, gamma[0], gamma[0]].into_iter().zip(both) {
            let tolerance = same_tolerance();
            approx::assert_relative_eq!(own, other, max_relative = tolerance);
        }
    }
}

/// Without temperature: one dashpot in series, one beside the spring.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| {
    0.5 * stiffness * (lambda - length).powi(2) + 0.5 * maxwell * (lambda - length - gamma).powi(2)
})]
#[viscosity(gamma = series, lambda = beside)]
struct Cold {
    stiffness: f64,
    maxwell: f64,
    length: f64,
    series: f64,
    beside: f64,
}

/// `½h (P⁰ + P¹)` with `P = g²/η + η λ̇²` of the stored states.
#[test]
fn the_trapezoidal_rule_loses_the_mean_power_of_both_ends() {
    let model = Cold {
        stiffness: 20.0,
        maxwell: 50.0,
        length: 1.0,
        series: 8.0,
        beside: 0.5,
    };
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0; 2]);
    let bob = scene.mass(1.0, [1.4, 0.0], [0.3, 1.0]);
    let spring = scene.spring(model.clone(), [pivot, bob]);
    let step = 0.05;
    let mut run = Simulation::new(scene, Scheme::Trapezoidal, step).unwrap();
    let power = |run: &Simulation<2>| {
        let [q, p] = [run.position(bob).unwrap(), run.momentum(bob).unwrap()];
        let gamma = run.viscous_stretch(spring, 0).unwrap();
        let g = model.maxwell * (q.norm() - model.length - gamma);
        let rate = q.dot(&p) / q.norm();
        g * g / model.series + model.beside * rate * rate
    };
    for _ in 0..20 {
        let (before, lost) = (power(&run), run.ledger().lost_heat);
        run.step().unwrap();
        let found = run.ledger().lost_heat - lost;
        let expected = 0.5 * step * (before + power(&run));
        // The equations of a step are solved to 1e-10 of their terms.
        assert!(
            (found - expected).abs() <= 1e-10 * expected,
            "{found} {expected}"
        );
    }
}

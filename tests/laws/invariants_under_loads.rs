//! Elastic, thermoelastic and isothermal scenes keep their own invariants under gravity and under
//! a force that changes with time.

use core::fmt::Debug;

use eem::prelude::*;

use crate::support::dashpots::ONE_DASHPOT;
use crate::support::{LogarithmicStiffness, hencky};

/// One rounding of the terms that the invariant sums per step, in a random walk of [`STEPS`]: √1000 ε, relative to the
/// sum of their magnitudes.
const TOLERANCE: f64 = 7.0e-15;

/// Two units in the last place of S.
const ENTROPY_TOLERANCE: f64 = 2.0;

const SCHEMES: [Scheme; 4] = [
    Scheme::EemEntropy,
    Scheme::EemTemperature,
    Scheme::EemDamped,
    Scheme::Staggered,
];
const STEPS: usize = 1_000;
const STEP: f64 = 0.02;
const GRAVITY: [f64; 3] = [0.0, 0.0, -9.81];
const THERMOSTAT: f64 = 310.0;

/// Two masses on a chain of two springs.
fn chain<M>(model: &M, scheme: Scheme, is_pushed: bool, heat: Heat) -> Simulation<3>
where
    M: FreeEnergy<f64> + Clone + Debug + Send + Sync + 'static,
{
    let mut scene = Scene::<3>::new();
    let pivot = scene.anchor([0.0; 3]);
    let first = scene.mass(1.0, [1.6, 0.2, 0.0], [0.0, 1.0, 0.5]);
    let second = scene.mass(2.0, [1.7, 0.2, -1.8], [0.4, -0.5, 0.0]);
    let springs = [[pivot, first], [first, second]].map(|ends| scene.spring(model.clone(), ends));
    for (spring, theta) in springs.into_iter().zip([THERMOSTAT, 290.0]) {
        match heat {
            Heat::None => {}
            Heat::Flows => scene.set_temperature(spring, theta),
            Heat::Prescribed => {
                scene.set_temperature(spring, THERMOSTAT);
                scene.prescribe_temperature(spring, |_| THERMOSTAT);
            }
        }
    }
    if matches!(heat, Heat::Flows) {
        scene.conduct(springs[0], springs[1], 5.0);
    }
    scene.set_gravity(GRAVITY);
    if is_pushed {
        scene.force(second, |t| [5.0 * (3.0 * t).sin(), 2.0 * t.cos(), 1.0]);
    }
    Simulation::new(scene, scheme, STEP).unwrap()
}

#[derive(Clone, Copy)]
enum Heat {
    None,
    Flows,
    Prescribed,
}

/// Energies that cancel within e = ψ + θ s of a spring with heat capacity c: c θ in ψ and c θr in θ s,
/// for two springs at about 300 K.
fn thermal(model: &LogarithmicStiffness) -> f64 {
    2.0 * 2.0 * model.capacity * model.theta_ref
}

/// The largest change of Σ terms along the run, relative to the largest Σ|terms| and what cancels
/// within the terms.
fn defect<const N: usize>(
    run: &mut Simulation<3>,
    cancelling: f64,
    terms: impl Fn(&Ledger<3>) -> [f64; N],
) -> f64 {
    let sum = |terms: [f64; N]| terms.iter().sum::<f64>();
    let size = |terms: [f64; N]| cancelling + terms.iter().map(|term| term.abs()).sum::<f64>();
    let start = terms(&run.ledger());
    let (mut largest, mut magnitude) = (0.0, size(start));
    for _ in 0..STEPS {
        run.step().unwrap();
        let now = terms(&run.ledger());
        let change = (sum(now) - sum(start)).abs();
        assert!(change.is_finite());
        largest = f64::max(largest, change);
        magnitude = f64::max(magnitude, size(now));
    }
    largest / magnitude
}

/// Kinetic, potential and internal energy, less the work of forces.
fn mechanical(ledger: &Ledger<3>) -> [f64; 4] {
    [
        ledger.kinetic_energy,
        ledger.potential_energy,
        ledger.internal_energy,
        -ledger.work,
    ]
}

fn both(mut check: impl FnMut(Scheme, bool)) {
    for scheme in SCHEMES {
        check(scheme, false);
        check(scheme, true);
    }
}

/// Gravity alone has no torque about the vertical through the pivot: `J_z` stays.
fn assert_vertical_momentum(run: &Simulation<3>, first: f64) {
    let ledger = run.ledger();
    // J is a sum of products q p, about 50 times as large here, and so are their roundings.
    let bound = 50.0 * TOLERANCE;
    approx::assert_relative_eq!(ledger.angular_momentum[2], first, max_relative = bound);
}

// T + V + Σψ − W is constant: there is no heat at all.
#[test]
fn an_elastic_scene() {
    let hencky = hencky(100.0, 1.5);
    both(|scheme, is_pushed| {
        let mut run = chain(&hencky, scheme, is_pushed, Heat::None);
        let first = run.ledger().angular_momentum[2];
        let defect = defect(&mut run, 0.0, mechanical);
        let ledger = run.ledger();
        println!("{}: {defect:e}, W = {} J", scheme.name(), ledger.work);
        assert!(defect <= TOLERANCE);
        assert!(ledger.heat.abs() <= 0.0 && ledger.entropy.abs() <= 0.0);
        if is_pushed {
            assert!(ledger.work.abs() > 1.0);
        } else {
            assert!(ledger.work.abs() <= 0.0);
            assert_vertical_momentum(&run, first);
        }
    });
}

// T + V + Σe − W is constant, and S grows by conduction alone.
#[test]
fn a_thermoelastic_scene() {
    both(|scheme, is_pushed| {
        let mut run = chain(&LogarithmicStiffness::FIRST, scheme, is_pushed, Heat::Flows);
        let (first, mut entropy) = (run.ledger().angular_momentum[2], run.ledger().entropy);
        let defect = defect(&mut run, thermal(&LogarithmicStiffness::FIRST), mechanical);
        println!("{}: {defect:e}, W = {} J", scheme.name(), run.ledger().work);
        assert!(defect <= TOLERANCE);
        if !is_pushed {
            assert_vertical_momentum(&run, first);
        }
        let mut run = chain(&LogarithmicStiffness::FIRST, scheme, is_pushed, Heat::Flows);
        for _ in 0..STEPS {
            run.step().unwrap();
            let now = run.ledger().entropy;
            assert!(now - entropy >= -ENTROPY_TOLERANCE * f64::EPSILON * now.abs());
            entropy = now;
        }
    });
}

// Energy less work and heat is constant.
#[test]
fn an_isothermal_scene_books_its_heat() {
    let model = LogarithmicStiffness::FIRST;
    both(|scheme, is_pushed| {
        let mut run = chain(&model, scheme, is_pushed, Heat::Prescribed);
        let first = run.ledger().angular_momentum[2];
        let booked = defect(&mut run, thermal(&model), |ledger| {
            let [kinetic, potential, internal, work] = mechanical(ledger);
            [kinetic, potential, internal, work, -ledger.heat]
        });
        let ledger = run.ledger();
        println!("{}: {booked:e}, Q = {} J", scheme.name(), ledger.heat);
        assert!(booked <= TOLERANCE);
        assert!(ledger.heat.abs() > 0.01);
        if !is_pushed {
            assert_vertical_momentum(&run, first);
        }
    });
}

/// The largest change of T + V + Σψ − W with ψ = e − θ s.
fn free_energy_defect(scheme: Scheme, is_pushed: bool, step: f64) -> f64 {
    let model = LogarithmicStiffness::FIRST;
    let mut run = chain(&model, scheme, is_pushed, Heat::Prescribed);
    run.set_step_size(step).unwrap();
    let defect = defect(&mut run, thermal(&model), |ledger| {
        let [kinetic, potential, internal, work] = mechanical(ledger);
        let bound = -THERMOSTAT * ledger.element_entropy;
        [kinetic, potential, internal, bound, work]
    });
    println!("{}, h = {step} s: {defect:e}", scheme.name());
    defect
}

// At constant temperature the heat is θ Δs, so that T + V + Σψ − W is constant, too.
#[test]
fn an_isothermal_scene_keeps_its_free_energy() {
    both(|scheme, is_pushed| {
        let exact = free_energy_defect(scheme, is_pushed, STEP);
        assert!(exact <= TOLERANCE, "{scheme}: {exact:e}");
    });
}

// With a dashpot T + V + Σψ − W falls by what is dissipated, all of which the thermostat takes; it
// never rises. In temperature form, for the reason above.
#[test]
fn an_isothermal_dashpot_loses_free_energy_in_every_step() {
    for is_pushed in [false, true] {
        let mut run = chain(
            &ONE_DASHPOT,
            Scheme::EemTemperature,
            is_pushed,
            Heat::Prescribed,
        );
        let terms = |ledger: &Ledger<3>| {
            let [kinetic, potential, internal, work] = mechanical(ledger);
            [
                kinetic,
                potential,
                internal,
                -THERMOSTAT * ledger.element_entropy,
                work,
            ]
        };
        let start = terms(&run.ledger());
        let (mut before, mut size) = (start.iter().sum::<f64>(), 0.0);
        for _ in 0..STEPS {
            run.step().unwrap();
            let now = terms(&run.ledger());
            size = f64::max(size, now.iter().map(|term| term.abs()).sum());
            let sum = now.iter().sum::<f64>();
            assert!(sum - before <= TOLERANCE * size);
            before = sum;
        }
        assert!(before < start.iter().sum::<f64>() - 1.0);
    }
}

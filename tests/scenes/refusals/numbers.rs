//! Every public number may be anything: there is a typed error, or a run whose numbers are finite.

use eem::Tolerance;
use eem::prelude::*;
use eem_testkit::length::at_length;

use super::{WARM, Warm};
use crate::support::hooke;

const WILD: [f64; 14] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    0.0,
    -0.0,
    -1.0,
    5e-324,
    1e-310,
    -1e-310,
    1e-160,
    1e160,
    -1e160,
    f64::MAX,
    f64::MIN_POSITIVE,
];

/// All numbers of a small scene.
#[derive(Clone, Debug)]
struct Draft {
    numbers: [f64; NAMES.len()],
}

const NAMES: [&str; 23] = [
    "mass",
    "position",
    "velocity",
    "momentum",
    "anchor",
    "temperature",
    "viscous stretch",
    "reservoir",
    "conductance to the room",
    "conductance to an element",
    "gravity",
    "dead load",
    "force of time",
    "motion",
    "thermostat",
    "step",
    "tolerance",
    "stiffness",
    "branch",
    "length",
    "coupling",
    "capacity",
    "eta",
];

const SOUND: Draft = Draft {
    numbers: [
        1.0, 0.5, 0.5, 0.3, 0.0, 310.0, 0.01, 290.0, 1.0, 2.0, -9.81, 0.5, 0.2, 0.1, 5.0, 0.02,
        1e-8, 50.0, 20.0, 1.0, 0.1, 2.0, 5.0,
    ],
};

impl Draft {
    fn get(&self, name: &str) -> f64 {
        let index = NAMES.iter().position(|other| *other == name);
        self.numbers[index.unwrap()]
    }

    fn build(&self, scheme: Scheme) -> Result<Simulation<2>, SceneError> {
        let get = |name: &str| self.get(name);
        let mut scene = Scene::<2>::new();
        let anchor = scene.anchor([get("anchor"), 0.0]);
        let bob = scene.mass(get("mass"), [1.0, get("position")], [get("velocity"), 0.0]);
        let tail = scene.mass(1.0, [2.0, 0.0], [0.0, 0.0]);
        scene.set_momentum(tail, [0.0, get("momentum")]);
        let warm = Warm {
            stiffness: get("stiffness"),
            branch: get("branch"),
            length: get("length"),
            coupling: get("coupling"),
            capacity: get("capacity"),
            eta: get("eta"),
            ..WARM
        };
        let springs = [
            scene.spring(warm, [anchor, bob]),
            scene.spring(WARM, [bob, tail]),
            scene.spring(WARM, [anchor, tail]),
        ];
        scene.set_temperature(springs[0], get("temperature"));
        scene.set_temperature(springs[1], 300.0);
        scene.set_temperature(springs[2], 305.0);
        scene.set_viscous_stretch(springs[0], 0, get("viscous stretch"));
        let room = scene.reservoir(get("reservoir"));
        scene.conduct(springs[0], room, get("conductance to the room"));
        scene.conduct(springs[0], springs[1], get("conductance to an element"));
        scene.set_gravity([0.0, get("gravity")]);
        scene.dead_load(bob, [get("dead load"), 0.0]);
        let (force, motion, heating) = (get("force of time"), get("motion"), get("thermostat"));
        scene.force(tail, move |t| [force * (3.0 * t).cos(), 0.0]);
        let origin = get("anchor");
        scene.move_anchor(anchor, move |t| [origin, motion * t]);
        scene.prescribe_temperature(springs[2], move |t| 305.0 + heating * t);
        let mut run = Simulation::new(scene, scheme, get("step"))?;
        let settings = NewtonSettings {
            tolerance: get("tolerance"),
            ..run.newton_settings()
        };
        run.set_newton_settings(settings)?;
        Ok(run)
    }
}

/// The state is finite, and so are its energies for a scheme that keeps them; others may find momenta
/// so large that the kinetic energy overflows.
fn assert_finite(run: &Simulation<2>, what: &str) {
    let ledger = run.ledger();
    let momentum = ledger.linear_momentum;
    for value in [run.time(), ledger.entropy, momentum.x, momentum.y] {
        assert!(value.is_finite(), "{what}: {value}");
    }
    let exact = [
        Scheme::EemEntropy,
        Scheme::EemTemperature,
        Scheme::Staggered,
    ];
    if exact.contains(&run.scheme()) {
        assert!(ledger.balance.is_finite(), "{what}: {ledger:?}");
    }
}

#[test]
fn a_wild_number_is_an_error_or_the_run_stays_finite() {
    let (mut refused, mut turn) = (0, 0);
    for scheme in Scheme::ALL {
        for (index, name) in NAMES.iter().enumerate() {
            for wild in WILD {
                // Every number with every scheme, and most of what it may be, in turn.
                turn += 1;
                if turn % at_length(1, 3) != 0 {
                    continue;
                }
                let mut draft = SOUND;
                draft.numbers[index] = wild;
                let what = format!("{}: {name} = {wild:e}", scheme.name());
                let Ok(mut run) = draft.build(scheme) else {
                    refused += 1;
                    continue;
                };
                assert_finite(&run, &what);
                for _ in 0..3 {
                    let before = format!("{:?}", run.checkpoint());
                    if let Err(error) = run.step() {
                        assert!(error.to_string().len() < 400, "{what}: {error}");
                        assert_eq!(before, format!("{:?}", run.checkpoint()), "{what}");
                        refused += 1;
                        break;
                    }
                    assert_finite(&run, &what);
                }
            }
        }
    }
    println!("{refused} refused");
    SOUND.build(Scheme::EemEntropy).unwrap().step().unwrap();
}

#[test]
fn ends_and_tolerances_of_runs() {
    for wild in WILD {
        let mut run = SOUND.build(Scheme::EemEntropy).unwrap();
        let go_on = |run: &Simulation<2>, _: &StepReport| {
            if run.time() < 0.1 {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        };
        let end = run.run_until_with(wild, go_on);
        // The increments h² F/m of a step may be too small for any number.
        let is_too_short = wild * wild < f64::MIN_POSITIVE;
        let is_expected = end.is_ok() == (wild >= 0.0) || is_too_short;
        assert!(is_expected, "{wild:e}: {end:?}");
        assert_finite(&run, "run_until");
        let mut run = SOUND.build(Scheme::EemEntropy).unwrap();
        let function = |run: &Simulation<2>| Ok(run.time() - 0.05);
        let event = Event::crossing(function).within(wild);
        let end = run.run_until_event_with(0.1, &mut [event], go_on);
        assert_eq!(end.is_ok(), wild >= 0.0, "{wild:e}");
        assert_finite(&run, "run_until_event");
        let mut run = SOUND.build(Scheme::EemEntropy).unwrap();
        let event = Event::crossing(|_: &Simulation<2>| Ok(wild)).within(1e-6);
        let end = run.run_until_event_with(0.1, &mut [event], go_on);
        assert_eq!(end.is_err(), wild.is_nan(), "{wild:e}");
        assert_finite(&run, "the function of an event");
    }
}

#[test]
fn time_does_not_run_over() {
    let mut scene = Scene::<1>::new();
    scene.mass(1.0, [0.0], [0.0]);
    let mut run = Simulation::new(scene, Scheme::EemEntropy, 1e308).unwrap();
    run.step().unwrap();
    let error = run.step().unwrap_err();
    println!("{error}");
    assert!(matches!(error.failure, StepFailure::Time { .. }), "{error}");
    assert!(run.time().is_finite());
}

#[test]
fn steps_have_squares() {
    for scheme in Scheme::ALL {
        let scene = || {
            let mut scene = Scene::<1>::new();
            let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.1], [0.0])];
            scene.spring(hooke(100.0, 1.0), ends);
            scene
        };
        for wild in [5e-324, 1e-300, 1e-160] {
            let refused = Simulation::new(scene(), scheme, wild).unwrap_err();
            let errors = refused.errors();
            assert!(matches!(errors, [SceneError::Step { .. }]), "{errors:?}");
            let mut run = Simulation::new(scene(), scheme, 0.01).unwrap();
            let error = run.run_until(wild).unwrap_err();
            let failure = error.failure;
            assert_eq!(failure, StepFailure::TooShort { value: wild });
            assert_eq!(run.time().to_bits(), 0.0_f64.to_bits());
        }
        // From a step that is only just long enough, control leaves at once.
        let mut run = Simulation::new(scene(), scheme, 1e-150).unwrap();
        if run.control_steps(Tolerance::new(1e-6)).is_ok() {
            run.run_until(0.1).unwrap();
        }
    }
}

#[test]
fn loads_that_overflow_together() {
    for scheme in Scheme::ALL {
        let mut scene = Scene::<1>::new();
        let mass = scene.mass(1.0, [0.0], [0.0]);
        scene.dead_load(mass, [1e308]);
        scene.dead_load(mass, [1e308]);
        let mut run = Simulation::new(scene, scheme, 0.1).unwrap();
        let error = run.step().unwrap_err();
        assert!(matches!(error.failure, StepFailure::Load { .. }), "{error}");
    }
}

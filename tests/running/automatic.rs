//! A scheme that is chosen on the way: explicit where that takes least, implicit where stability would limit the
//! steps, with all laws across the change.

use std::f64::consts::FRAC_PI_2;
use std::ops::ControlFlow;

use eem::prelude::*;
use eem::{Checkpoint, RestoreError, SceneError, StepFailure, Tolerance};

use crate::support::{DoublePendulum, ThermoViscoElastic, bits, hencky, single_pendulum};

mod orders;

/// A spring that softens by a factor e in so many kelvins.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    0.5 * stiffness * exp((theta_ref - theta) / kelvins) * (lambda - length).powi(2)
        + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
})]
struct Softening {
    stiffness: f64,
    length: f64,
    kelvins: f64,
    capacity: f64,
    theta_ref: f64,
}

/// A mass that goes round on a spring of 10¹⁰ N/m, vibrations of 10⁵ rad/s, or of 20 N/m when it is hot.
const ROTOR: Softening = Softening {
    stiffness: 1e10,
    length: 1.0,
    kelvins: 10.0,
    capacity: 1.0,
    theta_ref: 300.0,
};

fn rotor(
    tolerance: f64,
    temperature: impl Fn(f64) -> f64 + Send + Sync + 'static,
) -> Simulation<2> {
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0; 2]);
    let mass = scene.mass(1.0, [1.0, 0.0], [0.0, 1.0]);
    let spring = scene.spring(ROTOR, [pivot, mass]);
    scene.set_temperature(spring, temperature(0.0));
    scene.prescribe_temperature(spring, temperature);
    let mut run = Simulation::new(scene, Scheme::Auto, 1e-3).unwrap();
    run.control_steps(Tolerance::new(tolerance)).unwrap();
    run
}

/// A spring in parallel with a Maxwell element whose viscosity grows by a factor e in so many kelvins.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    0.5 * stiffness * (lambda - length).powi(2)
        + 0.5 * stiffness * (lambda - length - gamma).powi(2)
        + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
})]
#[viscosity(gamma = eta * exp((theta - theta_ref) / kelvins))]
struct Thickening {
    stiffness: f64,
    length: f64,
    eta: f64,
    kelvins: f64,
    capacity: f64,
    theta_ref: f64,
}

/// A mass that goes round on a spring that relaxes at 10⁵/s at 300 K, and hardly at 500 K.
const RELAXING: Thickening = Thickening {
    stiffness: 100.0,
    length: 1.0,
    eta: 1e-3,
    kelvins: 10.0,
    capacity: 1.0,
    theta_ref: 300.0,
};

/// Stiff for a second, soft after three.
fn relaxing(tolerance: f64) -> Simulation<2> {
    let temperature = |t: f64| 400.0 + 100.0 * (3.0 * (t - 2.0)).tanh();
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0; 2]);
    let mass = scene.mass(1.0, [1.0, 0.0], [0.0, 1.0]);
    let spring = scene.spring(RELAXING, [pivot, mass]);
    scene.set_temperature(spring, temperature(0.0));
    scene.prescribe_temperature(spring, temperature);
    let mut run = Simulation::new(scene, Scheme::Auto, 1e-3).unwrap();
    run.control_steps(Tolerance::new(tolerance)).unwrap();
    run
}

#[test]
fn accurate_motion_of_a_pendulum_is_explicit() {
    let mut run = single_pendulum(Scheme::Auto, 0.05).run;
    assert_eq!(run.tolerance(), Some(Tolerance::new(1e-6)));
    run.run_until(5.0).unwrap();
    let mut explicit = single_pendulum(Scheme::EemExplicit, 0.05).run;
    explicit.control_steps(Tolerance::default()).unwrap();
    explicit.run_until(5.0).unwrap();
    assert_eq!(run.scheme(), Scheme::Auto);
    assert_eq!(run.scheme_in_use(), Scheme::EemExplicit);
    assert_eq!(run.step_statistics(), explicit.step_statistics());
    assert_eq!(run.ledger(), explicit.ledger());
}

#[test]
fn stiff_motion_becomes_implicit_and_soft_motion_explicit_again() {
    let mut run = relaxing(1e-6);
    let first = run.ledger();
    let (mut used, mut worst) = (vec![run.scheme_in_use()], 0.0_f64);
    let end = run.run_until_with(30.0, |run, report| {
        if used.last() != Some(&run.scheme_in_use()) {
            used.push(run.scheme_in_use());
        }
        assert!(report.defect.abs() <= report.bound, "{report:?}");
        worst = worst.max((run.ledger().balance - first.balance).abs());
        ControlFlow::Continue(())
    });
    end.unwrap();
    let statistics = run.step_statistics().unwrap();
    let [explicit, implicit] = [Scheme::EemExplicit, Scheme::EemEntropy6];
    assert_eq!(used[..2], [explicit, implicit]);
    assert_eq!(used.last(), Some(&explicit));
    assert_eq!(statistics.changes_of_scheme, 2);
    // Explicit steps through the stiff second would be 16 000, by h < 6.4 η/k.
    assert!(statistics.accepted < 1_000, "{statistics:?}");
    // Roundings of the heat in the spring.
    let rounding = f64::EPSILON * RELAXING.capacity * 500.0;
    assert!(worst < 100.0 * rounding, "{:e}", worst / rounding);
}

#[test]
fn laws_hold_when_the_scheme_changes() {
    // Fast conduction between the two springs, which stability limits.
    let stiff = DoublePendulum {
        conductance: 1e6,
        ..DoublePendulum::KRUEGER
    };
    let mut run = stiff.simulation(Scheme::Auto, 1e-3).run;
    run.control_steps(Tolerance::new(1e-3)).unwrap();
    let first = run.ledger();
    let mut entropy = first.entropy;
    let steps = run.run_until_with(2.0, |run, _| {
        let now = run.ledger();
        assert!((now.energy / first.energy - 1.0).abs() < 1e-14);
        assert!(now.entropy >= entropy * (1.0 - f64::EPSILON));
        entropy = now.entropy;
        ControlFlow::Continue(())
    });
    steps.unwrap();
    let statistics = run.step_statistics().unwrap();
    assert_ne!(run.scheme_in_use(), Scheme::EemExplicit);
    assert!(statistics.changes_of_scheme >= 1, "{statistics:?}");
}

#[test]
fn a_resumed_run_has_the_same_bits_whatever_scheme_it_was_using() {
    let build = || relaxing(1e-3);
    let mut run = build();
    let mut seen = [false; 2];
    for _ in 0..28 {
        for _ in 0..15 {
            run.step().unwrap();
        }
        seen[usize::from(run.scheme_in_use() == Scheme::EemExplicit)] = true;
        let saved = run.checkpoint();
        let text = serde_json::to_string(&saved).unwrap();
        let read: Checkpoint = serde_json::from_str(&text).unwrap();
        let mut other = build();
        other.restore(&read).unwrap();
        assert_eq!(bits(&other), bits(&run));
        for _ in 0..40 {
            let [mut resumed, whole] = [other.step().unwrap(), run.step().unwrap()];
            // Magnitudes of the old state are found anew in the first step, that of ψ with up to an eighth of the
            // bound, and the bound has its residue.
            let ratio = resumed.bound / whole.bound;
            assert!((0.875..1.2).contains(&ratio), "{ratio}");
            resumed.bound = whole.bound;
            assert_eq!(resumed, whole);
        }
        assert_eq!(bits(&other), bits(&run));
        // And back.
        run.restore(&saved).unwrap();
        run.run_until(run.time() + 0.05).unwrap();
    }
    assert_eq!(seen, [true; 2]);
}

#[test]
fn a_checkpoint_whose_choice_is_impossible_is_refused() {
    let build = || rotor(1e-3, |_| 300.0);
    let mut run = build();
    for _ in 0..5 {
        run.step().unwrap();
    }
    let saved = run.checkpoint();
    let before = bits(&run);
    let mut refused = |edit: &dyn Fn(&mut serde_json::Value)| {
        let mut text = serde_json::to_value(&saved).unwrap();
        edit(&mut text["choice"]);
        let edited: Checkpoint = serde_json::from_value(text).unwrap();
        let refused = run.restore(&edited).unwrap_err();
        assert_eq!(bits(&run), before);
        refused
    };
    let error = refused(&|choice| choice["scheme"] = "midpoint".into());
    assert!(matches!(error, RestoreError::Scheme { .. }), "{error}");
    let explicit_trials = [
        "/selection/explicit_trials/due",
        "/selection/explicit_trials/wait",
    ];
    for name in ["/selection/spent", "/selection/size"]
        .into_iter()
        .chain(explicit_trials)
    {
        let error = refused(&|choice| *choice.pointer_mut(name).unwrap() = (-1.0).into());
        assert!(error.to_string().contains("choice of a scheme"), "{error}");
    }
    run.restore(&saved).unwrap();
}

/// Energies are those that the scheme in use had found, to the bit.
#[test]
fn a_refused_checkpoint_of_another_scheme_leaves_no_trace() {
    let mut run = relaxing(1e-3);
    run.step().unwrap();
    let (explicit, saved) = (run.scheme_in_use(), run.checkpoint());
    while run.scheme_in_use() == explicit {
        run.step().unwrap();
    }
    run.step().unwrap();
    let mut text = serde_json::to_value(&saved).unwrap();
    text["state"]["work"][0] = 1e3.into();
    let edited: Checkpoint = serde_json::from_value(text).unwrap();
    let before = bits(&run);
    let refused = run.restore(&edited).unwrap_err();
    assert_eq!(refused, RestoreError::Edited { entry: "work" });
    assert_eq!(bits(&run), before);
}

/// Masses in a row on stiff springs, in slow motion across; what matrices may take, bytes.
fn stiff_row(memory: Option<u64>) -> Simulation<2> {
    let stiff = hencky(1e8, 1.0);
    let mut scene = Scene::<2>::new();
    let mut last = scene.anchor([0.0, 0.0]);
    for index in 1..=20 {
        let next = scene.mass(1.0, [f64::from(index), 0.0], [0.0, 0.1 * f64::from(index)]);
        scene.spring(stiff.clone(), [last, next]);
        last = next;
    }
    if let Some(bytes) = memory {
        scene.limit_memory(bytes);
    }
    let mut run = Simulation::new(scene, Scheme::Auto, 1e-4).unwrap();
    run.control_steps(Tolerance::new(1e-3)).unwrap();
    run
}

#[test]
fn without_memory_for_a_matrix_it_stays_explicit_and_says_so() {
    let mut free = stiff_row(None);
    let mut bounded = stiff_row(Some(1_000));
    let saved = loop {
        free.step().unwrap();
        bounded.step().unwrap();
        if free.scheme_in_use() != Scheme::EemExplicit {
            break free.checkpoint();
        }
    };
    assert_eq!(free.step_statistics().unwrap().too_large, None);
    let statistics = bounded.step_statistics().unwrap();
    let too_large = statistics.too_large.unwrap();
    assert_eq!(too_large.unknowns, 40);
    assert!(too_large.needed > 1_000 && too_large.available == Some(1_000));
    assert_eq!(statistics.changes_of_scheme, 0);
    assert_eq!(bounded.scheme_in_use(), Scheme::EemExplicit);

    // A run that goes on from there would need the matrix.
    let before = bits(&bounded);
    assert_eq!(
        bounded.restore(&saved),
        Err(RestoreError::Memory(too_large))
    );
    assert_eq!(bits(&bounded), before);

    // Longer than what is stable.
    bounded.limit_steps([1e-2, 1e-2]).unwrap();
    let error = bounded.step().unwrap_err();
    let StepFailure::TooSmall {
        too_large: Some(_), ..
    } = error.failure
    else {
        panic!("{error}")
    };
    assert!(
        error.to_string().contains("no other scheme could be tried"),
        "{error}"
    );
}

#[test]
fn where_one_scheme_finds_no_step_another_one_does() {
    let cooling = |scheme| {
        let mut scene = Scene::<2>::new();
        let nodes = [0.0, 1.0].map(|x| scene.anchor([x, 0.0]));
        let spring = scene.spring(ThermoViscoElastic::PENDULUM, nodes);
        scene.set_temperature(spring, 300.2);
        let air = scene.reservoir(300.0);
        scene.conduct(spring, air, 1e5);
        let mut run = Simulation::new(scene, scheme, 0.1).unwrap();
        run.control_steps(Tolerance::new(1e-2)).unwrap();
        run.limit_steps([0.02, 1.0]).unwrap();
        let end = run.run_until(1.0);
        (end, run, spring)
    };
    let (end, ..) = cooling(Scheme::EemExplicit);
    let failure = end.unwrap_err().failure;
    assert!(matches!(failure, StepFailure::TooSmall { .. }), "{failure}");
    let (end, run, spring) = cooling(Scheme::Auto);
    end.unwrap();
    assert_eq!(run.step_statistics().unwrap().changes_of_scheme, 1);
    assert!((run.temperature(spring).unwrap() - 300.0).abs() < 0.2);
}

#[test]
fn fixed_steps_are_those_of_the_scheme_in_use() {
    let mut run = single_pendulum(Scheme::Auto, 0.05).run;
    run.fix_steps();
    let mut explicit = single_pendulum(Scheme::EemExplicit, 0.05).run;
    for _ in 0..20 {
        assert_eq!(run.step(), explicit.step());
    }
    let refused = run.control_steps(Tolerance::new(0.0)).unwrap_err();
    assert!(matches!(refused, SceneError::Tolerance { .. }));
}

#[test]
fn events_and_output_times_work_in_both_kinds() {
    let mut run = rotor(1e-3, |_| 300.0);
    let mut times = Vec::new();
    run.run_at([0.1, 0.5, 0.7], |run| {
        times.push(run.time());
        ControlFlow::Continue(())
    })
    .unwrap();
    assert_eq!(times, [0.1, 0.5, 0.7]);
    assert_eq!(run.scheme_in_use(), Scheme::EemTemperature);
    // A quarter of a turn.
    let height = |run: &Simulation<2>| Ok(run.ledger().linear_momentum[1]);
    let turned = Event::crossing(height).within(1e-6);
    run.run_until_event(3.0, &mut [turned]).unwrap();
    assert!((run.time() - FRAC_PI_2).abs() < 1e-2, "{}", run.time());
}

#[test]
fn samples_are_found_within_steps_at_the_limit_of_stability() {
    let spring = Softening {
        stiffness: 1.1e4,
        capacity: 27.8,
        kelvins: 100.0,
        ..ROTOR
    };
    let build = || {
        let mut scene = Scene::<2>::new();
        let pivot = scene.anchor([0.0; 2]);
        let mass = scene.mass(9.9, [1.0, 0.0], [0.0, 1.0]);
        let spring = scene.spring(spring.clone(), [pivot, mass]);
        let air = scene.reservoir(300.0);
        scene.conduct(spring, air, 6308.0);
        scene.set_temperature(spring, 346.6);
        scene.prescribe_temperature(spring, |t| 346.6 + 28.4 * (3.97 * t).sin());
        let mut run = Simulation::new(scene, Scheme::Auto, 1e-3).unwrap();
        run.control_steps(Tolerance::new(6.2e-3)).unwrap();
        run
    };
    let times: Vec<f64> = (1..=50).map(|k| 0.01 * f64::from(k)).collect();
    let mut run = build();
    run.sample_at(&times, |_| ControlFlow::Continue(()))
        .unwrap();
    for time in &times {
        let mut run = build();
        let clock = |run: &Simulation<2>| Ok(run.time() - time - 1e-3);
        let late = Event::crossing(clock).within(1e-9);
        run.run_until_event(0.6, &mut [late]).unwrap();
    }
}

#[test]
fn calls_that_fail_leave_no_trace() {
    let mut run = rotor(1e-3, |_| 300.0);
    for _ in 0..120 {
        run.step().unwrap();
        let before = bits(&run);
        let broken = Event::crossing(|_: &Simulation<2>| Ok(f64::NAN));
        assert!(run.run_until_event(9.0, &mut [broken]).is_err());
        assert_eq!(bits(&run), before);
        let start = run.time();
        let later = |run: &Simulation<2>| Ok(if run.time() > start { f64::NAN } else { 1.0 });
        let later = Event::crossing(later);
        assert!(run.run_until_event(9.0, &mut [later]).is_err());
        let after = bits(&run);
        // What an explicit scheme predicts has no effect on the steps; where the failed step had changed the scheme,
        // energies are evaluated again, with other roundings.
        let state = |bits: &str| {
            bits.split("energies: SavedEnergies")
                .next()
                .map(str::to_owned)
        };
        assert_eq!(state(&after), state(&before));
    }
}

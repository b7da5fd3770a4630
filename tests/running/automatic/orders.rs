//! Scenes that no explicit scheme can step: the choice among the orders.

use std::ops::ControlFlow;

use eem::materials::KelvinVoigtDamper;
use eem::prelude::*;
use eem::{ReferenceEnd, Setting, StateQuantity, Study};

use crate::support::hencky;
use crate::support::solids::{SECTION, ThermoelasticSolid};
use crate::support::springs::Branched;

/// A square of rubber that starts to shear and to turn.
fn square() -> Scene<2> {
    let mut scene = Scene::<2>::new();
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let nodes = corners.map(|at| scene.node(at, [0.0, 0.5 * at[0]]));
    for point in scene.quadrilateral(ThermoelasticSolid::RUBBER, nodes, SECTION) {
        scene.set_temperature(point, 300.0);
    }
    scene
}

/// A pendulum whose spring has a dashpot in parallel.
fn damped_pendulum() -> Scene<2> {
    let damper = KelvinVoigtDamper {
        stiffness: 60.0,
        coupling: 0.1,
        capacity: 2.0,
        natural_length: 1.0,
        theta_ref: 300.0,
        a: 800.0,
        eta: 1.5,
    };
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [1.4, 0.0], [0.3, 1.0]);
    let spring = scene.spring(damper, [pivot, bob]);
    scene.set_temperature(spring, 350.0);
    scene
}

/// A rod that a rocket turns faster and faster.
fn rocket() -> Scene<2> {
    let mut scene = Scene::<2>::new();
    let ends = [[0.0, 0.0], [1.0, 0.0]].map(|at| scene.mass(1.0, at, [0.0; 2]));
    scene.spring(hencky(300.0, 1.0), ends);
    let side = scene.mass(1.0, [0.0, 0.3], [0.0; 2]);
    scene.spring(hencky(100.0, 0.3), [ends[0], side]);
    scene.rocket(ends[1], [ends[0], side], |t| 5.0 * t.sin());
    scene
}

/// A chain of springs with Maxwell elements that relax within 10 µs.
fn maxwell_chain() -> Scene<2> {
    let mut scene = Scene::<2>::new();
    scene.set_gravity([0.0, -9.81]);
    let mut last = scene.anchor([0.0, 0.0]);
    for index in 1..=5 {
        let next = scene.mass(1.0, [f64::from(index), 0.0], [0.0; 2]);
        let spring = Branched {
            k: 300.0,
            mu: 1e5,
            eta: 1.0,
            length: 1.0,
        };
        scene.spring(spring, [last, next]);
        last = next;
    }
    scene
}

/// A run to 2 s in controlled steps.
fn controlled(scene: Scene<2>, scheme: Scheme, tolerance: f64) -> Simulation<2> {
    let mut run = Simulation::new(scene, scheme, 0.01).unwrap();
    run.control_steps(Tolerance::new(tolerance)).unwrap();
    let first = run.ledger();
    let mut entropy = first.entropy;
    let steps = run.run_until_with(2.0, |run, report| {
        assert!(report.defect.abs() <= report.bound, "{report:?}");
        let now = run.ledger();
        assert!(now.entropy >= entropy * (1.0 - f64::EPSILON));
        entropy = now.entropy;
        ControlFlow::Continue(())
    });
    steps.unwrap();
    run
}

#[test]
fn where_no_explicit_scheme_can_step_the_order_follows_the_tolerance() {
    for scene in [square, damped_pendulum, rocket] {
        let evaluations = |scheme, tolerance| controlled(scene(), scheme, tolerance).evaluations();
        let fine = controlled(scene(), Scheme::Auto, 1e-6);
        assert_eq!(fine.scheme_in_use(), Scheme::EemEntropy6);
        // The steps of order 2 before the first trial, and some trials.
        let best = evaluations(Scheme::EemEntropy6, 1e-6);
        assert!(
            4 * fine.evaluations() < 5 * best,
            "{} {best}",
            fine.evaluations()
        );
        let rough = controlled(scene(), Scheme::Auto, 1e-2);
        let second = evaluations(Scheme::EemTemperature, 1e-2);
        assert!(
            4 * rough.evaluations() < 5 * second,
            "{} {second}",
            rough.evaluations()
        );
    }
}

#[cfg(feature = "gradients")]
#[test]
fn a_run_that_keeps_its_history_keeps_a_scheme_with_gradients() {
    let mut run = Simulation::new(square(), Scheme::Auto, 0.01).unwrap();
    run.control_steps(Tolerance::new(1e-6)).unwrap();
    run.keep_history(eem::History::default());
    run.run_until(0.2).unwrap();
    assert_eq!(run.scheme_in_use(), Scheme::EemTemperature);
    let energy = eem::Objective::at_end(Quantity::TotalEnergy);
    run.gradient(&energy).unwrap();
}

/// Its references are of second order: those of fourth order cannot step a dashpot in parallel.
#[test]
fn a_study_of_a_dashpot_in_parallel_has_references() {
    let settings = [0.1, 0.05].map(|step| Setting::fixed(Scheme::EemTemperature, step));
    let study = Study::new(damped_pendulum, 1.0).settings(settings);
    let report = study.repeats(1).run().unwrap();
    assert_eq!(report.reference.end, ReferenceEnd::Agreed);
    let rows = report.rows.iter();
    let errors = rows.map(|row| row.error(StateQuantity::Positions).unwrap());
    let errors: Vec<f64> = errors.collect();
    // Second order.
    assert!((3.0..5.0).contains(&(errors[0] / errors[1])), "{errors:?}");
}

/// The table of the page about choosing a scheme.
#[test]
#[ignore = "prints a table"]
fn prints_the_table() {
    type Build = fn() -> Scene<2>;
    let scenes: [(&str, Build); 4] = [
        ("a dashpot in parallel", damped_pendulum),
        ("a square of rubber", square),
        ("a rod with a rocket", rocket),
        ("a stiff Maxwell chain", maxwell_chain),
    ];
    let schemes = [
        Scheme::EemTemperature,
        Scheme::EemEntropy4,
        Scheme::EemEntropy6,
        Scheme::Auto,
    ];
    println!(
        "| scene | tolerance | `EemTemperature` | `EemEntropy4` | `EemEntropy6` | `Auto` | in the end |"
    );
    println!("|---|---|---|---|---|---|---|");
    for (name, scene) in scenes {
        for tolerance in [1e-2, 1e-4, 1e-6, 1e-8] {
            let runs = schemes.map(|scheme| controlled(scene(), scheme, tolerance));
            let cells = runs.each_ref().map(|run| {
                let steps = run.step_statistics().unwrap();
                format!("{} ({})", run.evaluations(), steps.accepted)
            });
            let last = runs[3].scheme_in_use();
            println!(
                "| {name} | {tolerance:.0e} | {} | {last} |",
                cells.join(" | ")
            );
        }
    }
}

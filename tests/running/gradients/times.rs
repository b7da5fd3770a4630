//! Sizes of steps, times of events, and values that controllers set, against differences of runs.

use eem::kinematics::Quad4;
use eem::prelude::*;
use eem::{Gradient, GradientError, History, Input, Objective};

use super::inputs::check;
use super::{FORMS, INPUTS, TWO, VOIGT, assert_tangent, net};
use crate::support::single_pendulum_scene;
use crate::support::solids::Viscous;

/// Sizes of steps, two forces that are set one after the other, two velocities of an anchor, and two temperatures.
const SET: [f64; 11] = [
    0.02, 0.03, 0.01, 0.04, 0.025, 1.0, -2.0, 0.5, -0.3, 320.0, 305.0,
];

/// Springs with dashpots in contact, at an anchor and a thermostat that are set, in air.
fn controlled(values: [f64; 11], scheme: Scheme) -> (Gradient<2>, [Node; 2], Element) {
    let [sizes @ .., f1, f2, v1, v2, t1, t2] = values;
    let mut scene = Scene::<2>::new();
    let hook = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [1.2, 0.0], [0.3, 1.0]);
    let tail = scene.mass(0.5, [1.9, -0.4], [0.0, -0.5]);
    let springs = [
        scene.spring(VOIGT, [hook, bob]),
        scene.spring(TWO, [bob, tail]),
        scene.spring(VOIGT, [hook, tail]),
    ];
    scene.set_temperature(springs[0], 320.0);
    scene.set_temperature(springs[1], 310.0);
    scene.hold_temperature(springs[2], 300.0);
    scene.conduct(springs[0], springs[1], 0.5);
    scene.conduct(springs[0], springs[2], 0.5);
    let air = scene.reservoir(290.0);
    scene.conduct(springs[1], air, 0.7);
    scene.set_gravity([0.0, -9.81]);
    let mut run = Simulation::new(scene, scheme, 0.02).unwrap();
    run.keep_history(History::default());
    for (at, size) in sizes.into_iter().enumerate() {
        if at == 1 {
            run.set_force(bob, [f1, 0.0]).unwrap();
            run.set_motion(hook, [0.0, v1]).unwrap();
            run.set_temperature_of(springs[2], t1).unwrap();
        }
        if at == 3 {
            run.set_force(bob, [f2, 0.0]).unwrap();
            run.set_motion(hook, [0.0, v2]).unwrap();
            run.set_temperature_of(springs[2], t2).unwrap();
        }
        run.set_step_size(size).unwrap();
        run.step().unwrap();
    }
    let objective = Objective::at_end(Quantity::Position(bob))
        + Objective::at_end(Quantity::Velocity(tail)).component(1)
        + Objective::at_end(Quantity::ReservoirHeat(air))
        + Objective::integral(Quantity::TotalEnergy).times(0.1)
        + Objective::time().times(3.0)
        + Objective::at_end(Quantity::Temperature(springs[1])).times(0.1);
    let gradient = run.gradient(&objective).unwrap();
    assert_tangent("controlled", &mut run, &gradient, &objective);
    (gradient, [bob, hook], springs[2])
}

#[test]
fn sizes_of_steps_and_values_of_controllers_have_derivatives() {
    for scheme in FORMS {
        let (gradient, [bob, hook], held) = controlled(SET, scheme);
        let mut found = [0.0; 11];
        let sizes = gradient.by_step_size().unwrap();
        for (found, (_, by)) in found.iter_mut().zip(sizes) {
            *found = *by;
        }
        assert_eq!(
            gradient.by_end_time().unwrap().to_bits(),
            found[4].to_bits()
        );
        for (at, (_, by)) in gradient.by_force(bob).unwrap().iter().enumerate() {
            match at {
                0 => {}
                1 | 2 => found[5] += by[0],
                _ => found[6] += by[0],
            }
        }
        // The place of the anchor is the sum of its velocities by the sizes of the steps.
        let motion = gradient.by_motion(hook).unwrap();
        for (at, (_, by)) in motion.iter().enumerate() {
            found[7] += by[1] * SET[1..3].iter().take(at.saturating_sub(1)).sum::<f64>();
            found[8] += by[1] * SET[3..5].iter().take(at.saturating_sub(3)).sum::<f64>();
        }
        for (at, (_, by)) in gradient.by_thermostat(held).unwrap().iter().enumerate() {
            match at {
                0 => {}
                1 | 2 => found[9] += by,
                _ => found[10] += by,
            }
        }
        let sizes = [
            1e-4, 1e-4, 1e-4, 1e-4, 1e-4, 1e-2, 1e-2, 1e-3, 1e-3, 1e-1, 1e-1,
        ];
        check::<2, 11>(scheme.name(), found, (SET, sizes), |values| {
            controlled(values, scheme).0.value()
        });
    }
}

/// A block of rubber on a slope that is released, in air.
fn solid(sizes: [f64; 3], scheme: Scheme) -> Gradient<2> {
    let mut scene = Scene::<2>::new();
    let mesh = Mesh::<Quad4, 2>::block([2, 1], [[0.0, 2.0], [0.0, 1.0]]).unwrap();
    let body = scene.solid(Viscous::RUBBER, &mesh, &Bulk::new(10.0).conductivity(5.0));
    scene.set_temperatures(&body, 305.0);
    let hook = body.nodes()[0];
    scene.fix(hook);
    let corner = body.node_at([2.0, 1.0], 1e-9).unwrap();
    scene.set_velocity(corner, [0.5, 1.0]);
    scene.set_gravity([0.0, -9.81]);
    let mut run = Simulation::new(scene, scheme, 0.02).unwrap();
    run.keep_history(History::default());
    for (size, speed) in sizes.into_iter().zip([3.0, -3.0, 2.0]) {
        // Beside a solid with consistent mass.
        run.set_motion(hook, [speed, -0.5 * speed]).unwrap();
        run.set_step_size(size).unwrap();
        run.step().unwrap();
    }
    let objective = Objective::at_end(Quantity::Position(corner))
        + Objective::integral(Quantity::KineticEnergy)
        + Objective::at_end(Quantity::TotalEnergy).times(0.1);
    run.gradient(&objective).unwrap()
}

#[test]
fn sizes_of_steps_of_solids_have_derivatives() {
    let sizes = [0.02, 0.03, 0.01];
    for scheme in FORMS {
        let gradient = solid(sizes, scheme);
        let by = gradient.by_step_size().unwrap();
        let found = [by[0].1, by[1].1, by[2].1];
        check::<2, 3>(scheme.name(), found, (sizes, [1e-4; 3]), |sizes| {
            solid(sizes, scheme).value()
        });
    }
}

/// Where the wall of [`shaken`] is, and its velocity.
fn wall(t: f64) -> [f64; 2] {
    [0.3 * (1.0 - (9.0 * t).cos()), 2.7 * (9.0 * t).sin()]
}

/// A block of rubber whose corner is shaken.
fn shaken(sizes: [f64; 3], scheme: Scheme) -> (Gradient<2>, Node) {
    let mut scene = Scene::<2>::new();
    let mesh = Mesh::<Quad4, 2>::block([2, 1], [[0.0, 2.0], [0.0, 1.0]]).unwrap();
    let body = scene.solid(Viscous::RUBBER, &mesh, &Bulk::new(10.0));
    scene.set_temperatures(&body, 305.0);
    let hook = body.nodes()[0];
    scene.fix(hook);
    scene.move_anchor(hook, |t| [wall(t)[0], 0.0]);
    let corner = body.node_at([2.0, 1.0], 1e-9).unwrap();
    let mut run = Simulation::new(scene, scheme, 0.02).unwrap();
    run.keep_history(History::default());
    for size in sizes {
        run.set_step_size(size).unwrap();
        run.step().unwrap();
    }
    let objective =
        Objective::at_end(Quantity::Position(corner)) + Objective::at_end(Quantity::KineticEnergy);
    (run.gradient(&objective).unwrap(), hook)
}

/// A step that is longer moves all later positions of the wall, and those in it by their share.
#[test]
fn sizes_of_steps_move_functions_of_time() {
    let sizes = [0.02, 0.03, 0.01];
    for scheme in FORMS {
        let (gradient, hook) = shaken(sizes, scheme);
        let rate = Input::motion(hook, |t| [wall(t)[1], 0.0]);
        let by = gradient.by_step_size_with(&[rate]).unwrap();
        let found = [0, 1, 2].map(|step| by[step].1);
        check::<2, 3>(scheme.name(), found, (sizes, [1e-4; 3]), |sizes| {
            shaken(sizes, scheme).0.value()
        });
    }
}

#[test]
fn times_of_events_have_derivatives() {
    let inputs = [0.3, 12.0];
    for scheme in FORMS {
        let end = |[speed, fall]: [f64; 2]| {
            let (mut scene, bob, spring, _) = single_pendulum_scene();
            scene.set_velocity(bob, [speed, 0.2]);
            scene.set_gravity([0.0, -fall]);
            let mut run = Simulation::new(scene, scheme, 0.03).unwrap();
            run.keep_history(History::default());
            let passes = |run: &Simulation<2>| Ok(run.position(bob)?[1] + 0.4);
            let passes = Event::crossing(passes);
            assert_eq!(
                run.run_until_event(3.0, &mut [passes]).unwrap(),
                RunEnd::Event(0)
            );
            (run, bob, spring)
        };
        let event = |bob| Objective::at_end(Quantity::Position(bob)).component(1);
        let of = |bob, spring| {
            Objective::at_end(Quantity::Position(bob))
                + Objective::integral(Quantity::Temperature(spring)).times(0.1)
        };
        let (mut run, bob, spring) = end(inputs);
        let time = run
            .gradient_at_event(&Objective::time(), &event(bob))
            .unwrap();
        assert_eq!(time.value().to_bits(), run.time().to_bits());
        let found = [time.by_velocity(bob).unwrap()[0], -time.by_gravity()[1]];
        let sizes = [1e-3, 1e-2];
        check::<2, 2>(scheme.name(), found, (inputs, sizes), |inputs| {
            end(inputs).0.time()
        });
        let there = run
            .gradient_at_event(&of(bob, spring), &event(bob))
            .unwrap();
        let found = [there.by_velocity(bob).unwrap()[0], -there.by_gravity()[1]];
        check::<2, 2>(scheme.name(), found, (inputs, sizes), |inputs| {
            let (mut run, bob, spring) = end(inputs);
            run.gradient(&of(bob, spring)).unwrap().value()
        });
    }
}

#[test]
fn a_dead_load_does_not_depend_on_time() {
    let mut scene = Scene::<1>::new();
    let mass = scene.mass(2.0, [0.0], [1.0]);
    scene.dead_load(mass, [3.0]);
    let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.25).unwrap();
    run.keep_history(History::default());
    run.run_until(1.0).unwrap();
    let place = Objective::at_end(Quantity::Position(mass));
    let gradient = run.gradient(&place).unwrap();
    // q̇ = v, and ∂q/∂f of all forces is t²/2m.
    let velocity = run.momentum(mass).unwrap()[0] / 2.0;
    assert!((velocity - 2.5).abs() < 1e-15);
    assert!((gradient.by_end_time().unwrap() - velocity).abs() < 1e-15);
    let by_force = gradient.by_force(mass).unwrap();
    let sum: f64 = by_force.iter().map(|(_, by)| by[0]).sum();
    assert!((sum - 0.25).abs() < 1e-15);
}

#[test]
fn times_without_derivatives_are_errors() {
    let mut scene = Scene::<1>::new();
    let mass = scene.mass(1.0, [0.5], [0.0]);
    let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
    run.keep_history(History::default());
    let place = || Objective::at_end(Quantity::Position(mass));
    assert!(matches!(
        run.gradient_at_event(&place(), &place()),
        Err(GradientError::NoHistory)
    ));
    run.run_until(1.0).unwrap();
    let grazing = run
        .gradient_at_event(&Objective::time(), &place())
        .unwrap_err();
    assert!(
        matches!(grazing, GradientError::Grazing { rate: 0.0, .. }),
        "{grazing}"
    );

    let net = net(&INPUTS);
    let mut run = Simulation::new(net.scene.clone(), Scheme::EemTemperature, 0.025).unwrap();
    run.keep_history(History::default());
    run.run_until(0.1).unwrap();
    let place = || Objective::at_end(Quantity::Position(net.nodes[1]));
    let timed = run
        .gradient_at_event(&Objective::time(), &place())
        .unwrap_err();
    assert!(
        timed
            .to_string()
            .starts_with("the force on node 2 is a function of time"),
        "{timed}"
    );
    let gradient = run.gradient(&place()).unwrap();
    assert!(matches!(
        gradient.by_step_size(),
        Err(GradientError::NoTimeDerivative { .. })
    ));
    assert_eq!(gradient.by_step_size_at_kept_loads().len(), 4);

    let mut scene = Scene::<1>::new();
    let mass = scene.mass(1.0, [0.5], [0.0]);
    scene.force(mass, |t| [t]);
    let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.5).unwrap();
    run.keep_history(History::default());
    run.run_until(1.0).unwrap();
    let place = Objective::at_end(Quantity::Position(mass));
    let gradient = run.gradient(&place).unwrap();
    let sizes = gradient.by_step_size_with(&[Input::force(mass, |t| [1.0 / (t - 0.75)])]);
    assert!(
        matches!(sizes, Err(GradientError::NotFinite { .. })),
        "{sizes:?}"
    );
}

#[test]
fn times_of_jumps_have_derivatives() {
    for scheme in FORMS {
        let run = |jump: f64| {
            let (mut scene, bob, ..) = single_pendulum_scene();
            scene.force(bob, move |t| if t < jump { [1.0, 0.0] } else { [0.0, 3.0] });
            let mut run = Simulation::new(scene, scheme, 0.1).unwrap();
            run.keep_history(History::default());
            run.run_until(0.2).unwrap();
            run.run_until(jump).unwrap();
            run.run_until(0.35).unwrap();
            run.gradient(&Objective::at_end(Quantity::Position(bob)))
                .unwrap()
        };
        let gradient = run(0.27);
        let [_, _, (_, before), (_, after)] = gradient.by_step_size_at_kept_loads() else {
            panic!("four steps");
        };
        check::<2, 1>(
            scheme.name(),
            [before - after],
            ([0.27], [1e-3]),
            |[jump]| run(jump).value(),
        );
    }
}

//! A step allocates nothing after the first.

use eem::prelude::*;

use crate::support::{LogarithmicStiffness, Pendulum, single_pendulum};

#[test]
fn no_step_after_the_first_allocates() {
    for scheme in Scheme::ALL {
        let Pendulum { mut run, .. } = single_pendulum(scheme, 0.01);
        run.step().unwrap();
        let counted = allocation_counter::measure(|| {
            for _ in 0..1_000 {
                run.step().unwrap();
            }
        });
        assert_eq!(counted.count_total, 0, "{}: {counted:?}", scheme.name());
    }
}

// The choice of a scheme looks at the fastest motion from time to time.
#[test]
fn no_controlled_step_after_the_first_allocates() {
    let controlled = Scheme::ALL
        .into_iter()
        .filter(|scheme| scheme.may_change_steps());
    for scheme in controlled.chain([Scheme::Auto]) {
        let Pendulum { mut run, .. } = single_pendulum(scheme, 0.01);
        run.control_steps(Tolerance::default()).unwrap();
        run.step().unwrap();
        let counted = allocation_counter::measure(|| {
            for _ in 0..50 {
                run.step().unwrap();
            }
        });
        assert_eq!(counted.count_total, 0, "{}: {counted:?}", scheme.name());
    }
}

// Sparse elimination too works in memory that it has from the start.
#[test]
fn no_step_of_a_long_chain_after_the_first_allocates() {
    let mut scene = Scene::<2>::new();
    let mut last = scene.anchor([0.0, 0.0]);
    let mut before = None;
    for index in 1..=100 {
        let next = scene.mass(1.0, [2.0 * f64::from(index), 0.0], [0.0, 1.0]);
        let spring = scene.spring(LogarithmicStiffness::FIRST, [last, next]);
        scene.set_temperature(spring, 300.0 + f64::from(index % 7));
        if let Some(before) = before.replace(spring) {
            scene.conduct(before, spring, 10.0);
        }
        last = next;
    }
    let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.01).unwrap();
    run.step().unwrap();
    let counted = allocation_counter::measure(|| {
        for _ in 0..10 {
            run.step().unwrap();
        }
    });
    assert_eq!(counted.count_total, 0, "{counted:?}");
}

// The counter counts: without this the test above could not fail.
#[test]
fn the_counter_counts() {
    let counted = allocation_counter::measure(|| drop(std::hint::black_box(vec![1.0; 3])));
    assert_eq!(counted.count_total, 1);
}

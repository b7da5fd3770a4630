//! A step allocates nothing after the first.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod support;

use eem::prelude::*;
use support::{Pendulum, single_pendulum};

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

// The counter counts: without this the test above could not fail.
#[test]
fn the_counter_counts() {
    let counted = allocation_counter::measure(|| drop(std::hint::black_box(vec![1.0; 3])));
    assert_eq!(counted.count_total, 1);
}

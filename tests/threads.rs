//! The number of threads changes the time that a step takes, and nothing else.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod support;

use std::num::NonZero;

use eem::prelude::*;
use support::LogarithmicStiffness;

/// Nodes along a side: enough for dense blocks of some size in the factors.
const SIDE: u32 = 12;

/// A square lattice that floats freely, its corner warm.
fn lattice() -> (Simulation<2>, Vec<Node>) {
    let mut scene = Scene::<2>::new();
    let mut nodes = Vec::new();
    for row in 0..SIDE {
        for column in 0..SIDE {
            let velocity = [f64::from(row % 3) - 1.0, f64::from(column % 2) - 0.5];
            let site = [2.0 * f64::from(column), 2.0 * f64::from(row)];
            nodes.push(scene.mass(1.0, site, velocity));
        }
    }
    let side = SIDE as usize;
    let mut last = None;
    for at in 0..nodes.len() {
        for (next, exists) in [
            (at + 1, (at + 1) % side != 0),
            (at + side, at + side < nodes.len()),
        ] {
            if !exists {
                continue;
            }
            let spring = scene.spring(LogarithmicStiffness::FIRST, [nodes[at], nodes[next]]);
            scene.set_temperature(spring, if at == 0 { 380.0 } else { 300.0 });
            if let Some(last) = last.replace(spring) {
                scene.conduct(last, spring, 10.0);
            }
        }
    }
    (
        Simulation::new(scene, Scheme::EemTemperature, 0.02).unwrap(),
        nodes,
    )
}

fn positions(threads: usize) -> Vec<u64> {
    let (mut run, nodes) = lattice();
    run.set_threads(NonZero::new(threads).unwrap());
    let start = run.ledger();
    for _ in 0..2 {
        run.step().unwrap();
    }
    let end = run.ledger();
    // E adds up some thousand terms of the size of E over their number: √N ε.
    assert!((end.energy / start.energy - 1.0).abs() <= 64.0 * f64::EPSILON);
    assert!(end.entropy >= start.entropy);
    let positions = nodes.iter().map(|&node| run.position(node).unwrap());
    positions
        .flat_map(|q| [q[0].to_bits(), q[1].to_bits()])
        .collect()
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let one = positions(1);
    assert_eq!(one, positions(2));
    assert_eq!(one, positions(3));
}

//! Time of a step of chains and lattices of many springs, per spring and iteration; see `README.md`.

#![allow(clippy::unwrap_used, reason = "a benchmark fails by panicking")]

#[path = "../tests/support/mod.rs"]
mod support;

use divan::Bencher;
use divan::counter::ItemsCount;
use eem::prelude::*;
use support::{Hencky, LogarithmicStiffness, ThermoViscoElastic};

/// Springs of the chains.
const CHAINS: [usize; 6] = [10, 100, 1_000, 10_000, 100_000, 1_000_000];
/// Nodes along a side of the lattices.
const LATTICES: [usize; 4] = [10, 32, 100, 316];

/// A time in which neighbours move by a hundredth of their distance, s.
const STEP: f64 = 0.01;
/// Of a node, kg.
const MASS: f64 = 1.0;
/// Between springs that share a node, W/K.
const CONDUCTANCE: f64 = 10.0;

const SOFTENING: LogarithmicStiffness = LogarithmicStiffness {
    natural_length: 1.0,
    ..LogarithmicStiffness::FIRST
};
const ELASTIC: Hencky = Hencky {
    stiffness: 5000.0,
    natural_length: 1.0,
};

fn main() {
    divan::main();
}

/// A wave in which neighbours move differently, of the order of one.
fn wave(index: usize, phase: f64) -> f64 {
    let index = f64::from(u32::try_from(index).unwrap());
    (0.7 * index + phase).sin()
}

/// Adds a node near a site of a unit lattice, in motion.
fn node(scene: &mut Scene<2>, index: usize, site: [f64; 2]) -> Node {
    let position = [
        site[0] + 0.02 * wave(index, 0.0),
        site[1] + 0.02 * wave(index, 1.0),
    ];
    scene.mass(MASS, position, [wave(index, 2.0), wave(index, 3.0)])
}

fn number(index: usize) -> f64 {
    f64::from(u32::try_from(index).unwrap())
}

/// A thermoelastic chain that hangs on one end.
fn chain(springs: usize, conductance: Option<f64>) -> Scene<2> {
    let mut scene = Scene::new();
    let mut last = scene.anchor([0.0, 0.0]);
    let mut before = None;
    for index in 1..=springs {
        let next = node(&mut scene, index, [number(index), 0.0]);
        let spring = scene.spring(SOFTENING, [last, next]);
        scene.set_temperature(spring, 300.0 + 10.0 * wave(index, 4.0));
        if let Some((before, conductance)) = before.replace(spring).zip(conductance) {
            scene.conduct(before, spring, conductance);
        }
        last = next;
    }
    scene
}

/// A square lattice of thermoelastic rows, elastic and thermo-visco-elastic columns.
fn lattice(side: usize, conductance: Option<f64>) -> Scene<2> {
    let mut scene = Scene::new();
    let mut nodes = Vec::with_capacity(side * side);
    for row in 0..side {
        for column in 0..side {
            let site = [number(column), number(row)];
            nodes.push(node(&mut scene, row * side + column, site));
        }
    }
    // The last thermal spring at each node, to which the next one conducts heat.
    let mut warm: Vec<Option<Element>> = vec![None; nodes.len()];
    let mut heat = |scene: &mut Scene<2>, spring: Element, ends: [usize; 2]| {
        scene.set_temperature(spring, 300.0 + 10.0 * wave(ends[0] + ends[1], 4.0));
        for end in ends {
            if let Some((before, conductance)) = warm[end].replace(spring).zip(conductance) {
                scene.conduct(before, spring, conductance);
            }
        }
    };
    for at in 0..nodes.len() {
        let (right, below) = (at + 1, at + side);
        if right % side != 0 {
            let spring = scene.spring(SOFTENING, [nodes[at], nodes[right]]);
            heat(&mut scene, spring, [at, right]);
        }
        if below >= nodes.len() {
            continue;
        }
        let ends = [nodes[at], nodes[below]];
        if at % 2 == 0 {
            scene.spring(ELASTIC, ends);
        } else {
            let spring = scene.spring(ThermoViscoElastic::PENDULUM, ends);
            heat(&mut scene, spring, [at, below]);
        }
    }
    scene
}

/// A step in motion; items are springs times iterations.
fn bench(bencher: Bencher<'_, '_>, springs: usize, scheme: Scheme, scene: Scene<2>) {
    let mut run = Simulation::new(scene, scheme, STEP).unwrap();
    // The first step reserves the memory of the factors.
    run.step().unwrap();
    let iterations = run.step().unwrap().iterations;
    bencher
        .counter(ItemsCount::new(springs * iterations))
        .bench_local(move || run.step().unwrap());
}

/// A chain in temperature form.
#[divan::bench_group(sample_size = 1, sample_count = 5)]
mod chains {
    use super::{Bencher, CHAINS, CONDUCTANCE, Scheme, bench, chain};

    #[divan::bench(args = CHAINS)]
    fn insulated(bencher: Bencher<'_, '_>, springs: usize) {
        bench(
            bencher,
            springs,
            Scheme::EemTemperature,
            chain(springs, None),
        );
    }

    #[divan::bench(args = CHAINS)]
    fn conducting(bencher: Bencher<'_, '_>, springs: usize) {
        let scene = chain(springs, Some(CONDUCTANCE));
        bench(bencher, springs, Scheme::EemTemperature, scene);
    }

    #[divan::bench(args = [1_000, 100_000])]
    fn entropy_form(bencher: Bencher<'_, '_>, springs: usize) {
        bench(bencher, springs, Scheme::EemEntropy, chain(springs, None));
    }
}

/// A lattice of three models in temperature form.
#[divan::bench_group(sample_size = 1, sample_count = 3)]
mod lattices {
    use super::{Bencher, CONDUCTANCE, LATTICES, Scheme, bench, lattice};

    /// Springs of a lattice.
    fn springs(side: usize) -> usize {
        2 * side * (side - 1)
    }

    #[divan::bench(args = LATTICES)]
    fn insulated(bencher: Bencher<'_, '_>, side: usize) {
        let scene = lattice(side, None);
        bench(bencher, springs(side), Scheme::EemTemperature, scene);
    }

    #[divan::bench(args = LATTICES)]
    fn conducting(bencher: Bencher<'_, '_>, side: usize) {
        let scene = lattice(side, Some(CONDUCTANCE));
        bench(bencher, springs(side), Scheme::EemTemperature, scene);
    }
}

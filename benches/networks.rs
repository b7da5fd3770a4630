//! Time of a step of chains and lattices of many springs, per spring and iteration; see `README.md`.

#![allow(clippy::unwrap_used, reason = "a benchmark fails by panicking")]

#[path = "networks/scenes.rs"]
mod scenes;
use divan::Bencher;
use divan::counter::ItemsCount;
use eem::prelude::*;
use scenes::{SOFTENING, lattice, node, number, wave};

/// Springs of the chains.
const CHAINS: [usize; 6] = [10, 100, 1_000, 10_000, 100_000, 1_000_000];
/// Nodes along a side of the lattices.
const LATTICES: [usize; 4] = [10, 32, 100, 316];

/// A time in which neighbours move by a hundredth of their distance, s.
const STEP: f64 = 0.01;
/// Between springs that share a node, W/K.
const CONDUCTANCE: f64 = 10.0;

fn main() {
    divan::main();
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

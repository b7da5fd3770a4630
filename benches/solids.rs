//! Time of a Newton iteration of solids, beside that of a lattice of springs; see `README.md`.

#![allow(clippy::unwrap_used, reason = "a benchmark fails by panicking")]

#[path = "networks/scenes.rs"]
#[allow(dead_code, reason = "chains are those of another benchmark")]
mod networks;
#[path = "solids/scenes.rs"]
mod scenes;
use divan::Bencher;
use divan::counter::ItemsCount;
use eem::prelude::*;
use scenes::{cube, satellite, separate};

fn main() {
    divan::main();
}

/// A step in motion; items are elements, or systems, times iterations.
fn bench<const D: usize>(bencher: Bencher<'_, '_>, items: usize, scene: Scene<D>, step: f64) {
    let mut run = Simulation::new(scene, Scheme::EemTemperature, step).unwrap();
    // The first step reserves the memory of the factors.
    run.step().unwrap();
    let iterations = run.step().unwrap().iterations;
    bencher
        .counter(ItemsCount::new(items * iterations))
        .bench_local(move || run.step().unwrap());
}

/// Per system.
#[divan::bench_group(sample_size = 1, sample_count = 3)]
mod iterations {
    use super::{Bencher, bench, cube, networks, satellite};

    #[divan::bench(args = [5, 10, 20])]
    fn cubes(bencher: Bencher<'_, '_>, cells: usize) {
        bench(bencher, 1, cube(cells), 0.01);
    }

    #[divan::bench]
    fn lattice_of_springs(bencher: Bencher<'_, '_>) {
        bench(bencher, 1, networks::lattice(316, None), 0.01);
    }

    #[divan::bench(sample_count = 50)]
    fn satellites(bencher: Bencher<'_, '_>) {
        bench(bencher, 1, satellite(), 0.2);
    }
}

/// Per cell, with the elimination of 24 unknowns.
#[divan::bench_group(sample_size = 1, sample_count = 5)]
mod cells {
    use super::{Bencher, bench, separate};

    #[divan::bench(args = [1_000])]
    fn separate_cells(bencher: Bencher<'_, '_>, cells: usize) {
        bench(bencher, cells, separate(cells), 0.01);
    }
}

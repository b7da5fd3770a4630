//! Throughput of an ensemble of single pendulums by number of threads; see `README.md`.

#![allow(clippy::unwrap_used, reason = "a benchmark fails by panicking")]

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use eem::prelude::*;
use eem_testkit::scenes::ThermoViscoElastic;

/// Members of the ensemble.
const MEMBERS: u32 = 10_000;
/// Steps of a member, s, and how many: a quarter of the published run, so that a sample takes less
/// than a second.
const STEP: f64 = 0.2;
const STEPS: u32 = 25;
/// The explicit scheme, and its step, s.
const EXPLICIT: (Scheme, f64) = (Scheme::EemExplicit, 0.02);

fn main() {
    divan::main();
}

/// The published pendulum, started at different speeds.
fn scene(speed: f64) -> (Scene<2>, Element) {
    let mut scene = Scene::default();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [3.0, 0.0], [0.0, speed]);
    let spring = scene.spring(ThermoViscoElastic::PENDULUM, [pivot, bob]);
    scene.set_temperature(spring, 380.0);
    let air = scene.reservoir(300.0);
    scene.conduct(spring, air, 10.0);
    (scene, spring)
}

/// From inputs to results, set-up included.
#[divan::bench(args = [1, 2], sample_size = 1, sample_count = 10)]
fn pendulums(bencher: Bencher<'_, '_>, threads: usize) {
    let speeds: Vec<f64> = (0..MEMBERS).map(|i| 1.0 + 1e-4 * f64::from(i)).collect();
    let members = bencher.counter(ItemsCount::new(MEMBERS));
    members.bench_local(|| run(threads, STEPS, black_box(&speeds)));
}

/// Set-up alone, which asks for memory and could hold threads up.
#[divan::bench(args = [1, 2], sample_size = 1, sample_count = 20)]
fn set_up(bencher: Bencher<'_, '_>, threads: usize) {
    let speeds: Vec<f64> = (0..MEMBERS).map(|i| 1.0 + 1e-4 * f64::from(i)).collect();
    let members = bencher.counter(ItemsCount::new(MEMBERS));
    members.bench_local(|| run(threads, 0, black_box(&speeds)));
}

/// The explicit scheme at a step where it is accurate, so many steps.
#[divan::bench(args = [1, 2], sample_size = 1, sample_count = 10)]
fn explicit_pendulums(bencher: Bencher<'_, '_>, threads: usize) {
    let speeds: Vec<f64> = (0..MEMBERS).map(|i| 1.0 + 1e-4 * f64::from(i)).collect();
    let members = bencher.counter(ItemsCount::new(MEMBERS));
    members.bench_local(|| run_with(EXPLICIT, threads, STEPS, black_box(&speeds)));
}

fn run(threads: usize, steps: u32, speeds: &[f64]) -> usize {
    run_with((Scheme::EemTemperature, STEP), threads, steps, speeds)
}

fn run_with((scheme, step): (Scheme, f64), threads: usize, steps: u32, speeds: &[f64]) -> usize {
    let ensemble = Ensemble::new(scheme, step).threads(threads);
    let results = ensemble.run(
        speeds,
        |&speed| scene(speed),
        |run, spring, _| {
            for _ in 0..steps {
                run.step()?;
            }
            Ok(run.temperature(spring)?)
        },
    );
    let completed = results.iter().flatten().count();
    assert_eq!(completed, speeds.len(), "a pendulum failed");
    completed
}

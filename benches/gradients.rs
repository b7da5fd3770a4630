//! What gradients cost: the time of the adjoint over that of the run, in turn, the least of several.
//!
//! ```text
//! cargo bench -p eem-benches --bench gradients --features gradients [-- NAME ...]
//! ```

use std::time::Instant;

use eem::prelude::*;
use eem::{History, Objective};
use eem_testkit::scenes::{DoublePendulum, single_pendulum_scene};

#[path = "networks/scenes.rs"]
#[allow(
    dead_code,
    clippy::unwrap_used,
    reason = "another benchmark uses all of it"
)]
mod networks;
#[path = "solids/scenes.rs"]
#[allow(
    dead_code,
    clippy::unwrap_used,
    reason = "another benchmark uses all of it"
)]
mod solids;

/// Runs of which the fastest counts.
const REPEATS: usize = 5;

/// A run of some steps without a history, one with it, and its gradient; the least times, s.
fn times<const D: usize>(scene: &Scene<D>, scheme: Scheme, step: f64, steps: usize) -> [f64; 3] {
    let mut least = [f64::INFINITY; 3];
    for _ in 0..REPEATS {
        let mut note = |place: usize, start: Instant| {
            let time: &mut f64 = &mut least[place];
            *time = time.min(start.elapsed().as_secs_f64());
        };
        for keeps in [false, true] {
            let run = Simulation::new(scene.clone(), scheme, step);
            let mut run = run.expect("a valid scene");
            if keeps {
                run.keep_history(History::bytes(1 << 34));
            }
            let start = Instant::now();
            for _ in 0..steps {
                run.step().expect("a step");
            }
            note(usize::from(keeps), start);
            if keeps {
                let start = Instant::now();
                let energy = Objective::at_end(Quantity::KineticEnergy);
                run.gradient(&energy).expect("a gradient");
                note(2, start);
            }
        }
    }
    least
}

fn print<const D: usize>(name: &str, scene: impl FnOnce() -> Scene<D>, step: f64, steps: usize) {
    let names = std::env::args()
        .skip(1)
        .filter(|name| !name.starts_with("--"));
    if names.count() > 0 && !std::env::args().any(|own| own == name) {
        return;
    }
    let scene = scene();
    for scheme in [Scheme::EemTemperature, Scheme::EemEntropy] {
        let [plain, kept, gradient] = times(&scene, scheme, step, steps);
        let per_step = 1e6 * plain / f64::from(u32::try_from(steps).unwrap_or(u32::MAX));
        println!(
            "{name:<12} {scheme:<16} step {per_step:>11.2} µs   with history {:>5.2}   gradient {:>5.2}",
            kept / plain,
            gradient / plain
        );
    }
}

fn main() {
    print("single", || single_pendulum_scene().0, 0.1, 5000);
    let [_, krueger, log] = DoublePendulum::ALL;
    print("krueger", || krueger.scene().0, 0.02, 2000);
    print("log", || log.scene().0, 0.02, 2000);
    print("lattice 100²", || networks::lattice(100, None), 0.01, 4);
    print("cube 8³", || solids::cube(8), 0.01, 4);
}

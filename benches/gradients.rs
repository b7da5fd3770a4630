//! What gradients cost: the times of the adjoint and of three tangents over that of the run, in turn, the least of several.
//!
//! ```text
//! cargo bench -p eem-benches --bench gradients --features gradients [-- NAME ...]
//! ```

use std::time::Instant;

use eem::prelude::*;
use eem::{History, Input, Objective};
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

/// Three parameters of all elements of a model.
type Parameters = (&'static str, [&'static str; 3]);

/// A run of some steps without a history, one with it, its gradient, and its derivatives by three parameters; the least times, s.
fn times<const D: usize>(
    (scene, (model, names)): (&Scene<D>, Parameters),
    scheme: Scheme,
    step: f64,
    steps: usize,
) -> [f64; 4] {
    let mut least = [f64::INFINITY; 4];
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
                let elements: Vec<Element> = run.elements_of(model).collect();
                let inputs = names.map(|name| Input::parameter_of(elements.clone(), name));
                let start = Instant::now();
                let kinetic = [("kinetic", Quantity::KineticEnergy)];
                run.sensitivities(&inputs, kinetic).expect("tangents");
                note(3, start);
            }
        }
    }
    least
}

fn print<const D: usize>(
    name: &str,
    parameters: Parameters,
    scene: impl FnOnce() -> Scene<D>,
    step: f64,
    steps: usize,
) {
    let names = std::env::args()
        .skip(1)
        .filter(|name| !name.starts_with("--"));
    if names.count() > 0 && !std::env::args().any(|own| own == name) {
        return;
    }
    let scene = scene();
    for scheme in [Scheme::EemTemperature, Scheme::EemEntropy] {
        let of = (&scene, parameters);
        let [plain, kept, gradient, tangents] = times(of, scheme, step, steps);
        let per_step = 1e6 * plain / f64::from(u32::try_from(steps).unwrap_or(u32::MAX));
        println!(
            "{name:<12} {scheme:<16} step {per_step:>11.2} µs   with history {:>5.2}   gradient {:>5.2}   three tangents {:>5.2}",
            kept / plain,
            gradient / plain,
            tangents / plain
        );
    }
}

fn main() {
    let visco = ("ThermoViscoElastic", ["k0", "eta0", "capacity"]);
    let soft = (
        "LogarithmicStiffness",
        ["stiffness", "softening", "capacity"],
    );
    let rubber = ("SaintVenant", ["lame", "shear", "shear"]);
    print("single", visco, || single_pendulum_scene().0, 0.1, 5000);
    let [_, krueger, log] = DoublePendulum::ALL;
    print("krueger", soft, || krueger.scene().0, 0.02, 2000);
    print("log", soft, || log.scene().0, 0.02, 2000);
    let lattice = || networks::lattice(100, None);
    print("lattice 100²", soft, lattice, 0.01, 4);
    print("cube 8³", rubber, || solids::cube(8), 0.01, 4);
    print("cube 20³", rubber, || solids::cube(20), 0.01, 2);
}

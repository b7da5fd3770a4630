//! A parameter sweep in any number of processes: run this program several times at once.
//!
//! ```text
//! ψ(λ) = ½ k (λ − l)²,     t = (π/2) √(m/k)
//! ```
//!
//! ```text
//! cargo build --release -p eem-examples --features sweep --bin sweep
//! target/release/sweep run --dir out --shard 0/2 & target/release/sweep run --dir out --shard 1/2 & wait
//! target/release/sweep status --dir out
//! target/release/sweep merge --dir out
//! ```
//!
//! A mass on a spring is released, and the time at which it passes the rest position is recorded for a thousand pairs of
//! stiffness and mass. A killed process can be run again, and the merged table has the bits of a run by one process; see
//! `docs/sweeps.md`.

use std::process::ExitCode;

use eem::prelude::*;
use eem::sweep::{Inputs, Plan, Record};

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| 0.5 * stiffness * (lambda - length).powi(2))]
struct Spring {
    #[unit("N/m")]
    stiffness: f64,
    #[unit("m")]
    length: f64,
}

/// The result of one run.
struct Passing {
    time: f64,
}

impl Record for Passing {
    const COLUMNS: &'static [&'static str] = &["time (s)"];

    fn write(&self, row: &mut [f64]) {
        row[0] = self.time;
    }
}

fn main() -> ExitCode {
    let ranges = [("stiffness", 50.0..200.0), ("mass", 0.5..2.0)];
    let inputs = match Inputs::latin_hypercube(1000, 1, ranges) {
        Ok(inputs) => inputs,
        Err(error) => {
            eprintln!("error: {error}");
            return ExitCode::FAILURE;
        }
    };
    let plan = Plan::new("springs", inputs, Scheme::EemTemperature, 0.01);
    let sweep = plan.closures(
        |row| Ok([row.number("stiffness")?, row.number("mass")?]),
        |&[stiffness, mass]| {
            let mut scene = Scene::<1>::new();
            let mass = scene.mass(mass, [1.2], [0.0]);
            let ends = [scene.anchor([0.0]), mass];
            scene.spring(
                Spring {
                    stiffness,
                    length: 1.0,
                },
                ends,
            );
            (scene, mass)
        },
        |run, mass, _| {
            let rest = Event::falling(move |run: &Simulation<1>| Ok(run.position(mass)?[0] - 1.0));
            run.run_until_event(10.0, &mut [rest])?;
            Ok(Passing { time: run.time() })
        },
    );
    eem::sweep::main(&sweep)
}

//! Some steps of a published case, to count instructions of: `hot_cases CASE STEPS`.
//!
//! Prints the numbers of steps and of Newton iterations; see `studies/README.md`.

use std::error::Error;

use clap::{Parser, ValueEnum};
use eem::prelude::*;
use eem_studies::build::Build;
use eem_studies::models::{Elastic, Thermoelastic};
use eem_studies::pendulums::{self as single_pendulum, Double, single};

#[path = "satellite/scene.rs"]
#[allow(dead_code, reason = "the example uses all of it")]
mod satellite;

/// Steps of a hot case.
#[derive(Debug, Parser)]
struct Options {
    /// What is stepped.
    case: Case,
    /// How many steps are made.
    steps: usize,
    /// Their size in s, instead of the one that is measured.
    #[arg(long, value_name = "H")]
    step: Option<f64>,
}

/// A scheme and a scene.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Case {
    ExplicitSingle,
    ExplicitKrueger,
    ExplicitLog,
    ExplicitElastic,
    ExplicitChain,
    TemperatureSingle,
    TemperatureLog,
    EntropySingle,
    EntropyLog,
    Satellite,
}

/// Steps of one size: how many, and the iterations that they took.
fn go<const D: usize>(
    scene: Scene<D>,
    scheme: Scheme,
    step: f64,
    steps: usize,
) -> Result<(), Box<dyn Error>> {
    let mut run = Simulation::new(scene, scheme, step)?;
    let mut iterations = 0;
    for _ in 0..steps {
        iterations += run.step()?.iterations;
    }
    println!("{steps} {iterations}");
    Ok(())
}

/// Springs of a chain.
const SPRINGS: u8 = 64;

/// A chain in the plane that hangs on one end, elastic or thermoelastic and conducting.
fn chain(is_warm: bool) -> Scene<2> {
    let mut build = Build::new();
    let mut near = build.anchor([0.0; 2]);
    let mut last = None;
    for index in 1..=SPRINGS {
        let at = f64::from(index);
        let far = build.mass(1.0, [at, 0.0], [0.3 * at.cos(), 0.3 * at.sin()]);
        let (stiffness, length) = (100.0, 1.0);
        if is_warm {
            let model = Thermoelastic {
                stiffness,
                softening: 0.05,
                coupling: 0.2,
                capacity: 5.0,
                length,
                theta_ref: 300.0,
            };
            let spring = build.warm(model, [near, far], 300.0 + 10.0 * at.sin());
            if let Some(last) = last.replace(spring) {
                build.conduct(last, spring, 1.0);
            }
        } else {
            build.spring(Elastic { stiffness, length }, [near, far]);
        }
        near = far;
    }
    build.scene
}

fn main() -> Result<(), Box<dyn Error>> {
    use Scheme::{EemEntropy, EemExplicit, EemTemperature};
    let Options { case, steps, step } = Options::parse();
    let single = |scheme, size| go(single().scene, scheme, step.unwrap_or(size), steps);
    let double =
        |case: &Double, scheme, size| go(case.build().scene, scheme, step.unwrap_or(size), steps);
    match case {
        Case::ExplicitSingle => single(EemExplicit, 0.05),
        Case::ExplicitKrueger => double(&Double::KRUEGER, EemExplicit, 0.1),
        Case::ExplicitLog => double(&Double::LOG, EemExplicit, 0.05),
        Case::ExplicitElastic => go(chain(false), EemExplicit, step.unwrap_or(0.05), steps),
        Case::ExplicitChain => go(chain(true), EemExplicit, step.unwrap_or(0.05), steps),
        Case::TemperatureSingle => single(EemTemperature, 0.01),
        Case::TemperatureLog => double(&Double::LOG, EemTemperature, 0.01),
        Case::EntropySingle => single(EemEntropy, 0.01),
        Case::EntropyLog => double(&Double::LOG, EemEntropy, 0.01),
        Case::Satellite => {
            let scene =
                satellite::satellite(satellite::Axis::Z, |t| satellite::thrust(t, false))?.scene;
            go(
                scene,
                EemTemperature,
                step.unwrap_or(satellite::STEP),
                steps,
            )
        }
    }
}

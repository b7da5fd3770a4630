//! Some steps of a published case, to count instructions of: `hot_cases CASE STEPS`.
//!
//! Prints the numbers of steps and of Newton iterations; see `studies/README.md`.

#![allow(
    dead_code,
    unreachable_pub,
    reason = "the studies use all of what is shared with them, from their library"
)]

use std::env;
use std::error::Error;

use build::Build;
use eem::prelude::*;
use models::{Elastic, Thermoelastic};
use pendulums::{Double, single};

#[path = "../../src/build.rs"]
mod build;
#[path = "../../src/models.rs"]
mod models;
#[path = "../../src/pendulums.rs"]
mod pendulums;
#[cfg(feature = "solid")]
#[path = "../../src/bin/satellite/scene.rs"]
mod satellite;
#[cfg(feature = "solid")]
use pendulums as single_pendulum;

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
    let mut arguments = env::args().skip(1);
    let case = arguments.next().ok_or("which case?")?;
    let steps = arguments.next().ok_or("how many steps?")?.parse()?;
    let single = |scheme, step| go(single().scene, scheme, step, steps);
    let double = |case: &Double, scheme, step| go(case.build().scene, scheme, step, steps);
    match case.as_str() {
        "explicit-single" => single(EemExplicit, 0.05),
        "explicit-krueger" => double(&Double::KRUEGER, EemExplicit, 0.1),
        "explicit-log" => double(&Double::LOG, EemExplicit, 0.05),
        "explicit-elastic" => go(chain(false), EemExplicit, 0.05, steps),
        "explicit-chain" => go(chain(true), EemExplicit, 0.05, steps),
        "temperature-single" => single(EemTemperature, 0.01),
        "temperature-log" => double(&Double::LOG, EemTemperature, 0.01),
        "entropy-single" => single(EemEntropy, 0.01),
        "entropy-log" => double(&Double::LOG, EemEntropy, 0.01),
        #[cfg(feature = "solid")]
        "satellite" => {
            use satellite::{Axis, STEP, satellite, thrust};
            let scene = satellite(Axis::Z, |t| thrust(t, false))?.scene;
            go(scene, EemTemperature, STEP, steps)
        }
        _ => Err(format!("there is no case `{case}`").into()),
    }
}

//! A crane that damps its swinging load: the hook follows the load, by feedback in every step.
//!
//! ```text
//! ẋ_hook = 2ζω (x_load − x_hook),   ω = √(g/l)          then   φ̈ + 2ζω φ̇ + ω² φ = 0 for small angles φ
//! ```
//!
//! Claim: with ζ = ½ the swing decays to less than a percent within two periods, and what it loses is work of the hook: energy
//! less work stays constant to rounding.

use eem::materials::Hooke;
use eem::prelude::*;

const GRAVITY: f64 = 9.81;
/// Of the rope, m.
const LENGTH: f64 = 4.0;
const DAMPING: f64 = 0.5;
/// Between two actions of the controller, s.
const STEP: f64 = 0.02;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let rope = Hooke {
        stiffness: 1e5,
        natural_length: LENGTH,
    };
    let start = [0.5, -(LENGTH * LENGTH - 0.25_f64).sqrt()];
    let mut scene = Scene::<2>::new();
    let hook = scene.anchor([0.0, 0.0]);
    let load = scene.mass(100.0, start, [0.0, 0.0]);
    scene.spring(rope, [hook, load]);
    scene.set_gravity([0.0, -GRAVITY]);

    let omega = (GRAVITY / LENGTH).sqrt();
    let mut run = Simulation::new(scene, Scheme::EemEntropy, STEP)?;
    let before = run.ledger();
    println!("  time      hook      load      swing         work");
    for step in 0_u32..=400 {
        let x = run.position(hook)?[0];
        let swing = run.position(load)?[0] - x;
        if step % 40 == 0 {
            println!(
                "{:4.1} s {x:7.3} m {:7.3} m {swing:8.4} m {:10.4} J",
                run.time(),
                x + swing,
                run.ledger().work
            );
        }
        run.set_motion(hook, [2.0 * DAMPING * omega * swing, 0.0])?;
        run.step()?;
    }
    let swing = run.position(load)?[0] - run.position(hook)?[0];
    assert!(swing.abs() < 0.005);
    let after = run.ledger();
    assert!(after.work < -20.0);
    // Rounded in each of 401 steps relative to the potential energy, 4 kJ, and to the energy that the rope stores.
    let rounding = 401.0 * f64::EPSILON * before.potential_energy.abs();
    assert!((after.balance - before.balance).abs() < rounding);
    Ok(())
}

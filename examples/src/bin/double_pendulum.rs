//! Two masses in space on two hot springs that exchange heat.
//!
//! ```text
//! ψ(λ, θ) = ½ k ln²(λ/l) − β (θ − θr) ln(λ/l) + c (θ − θr − θ ln(θ/θr)),     θ_a ṡ_a = κ (θ_b − θ_a)
//! ```
//!
//! Claim: after 2 000 steps, each half a period of the fastest vibration, energy and angular momentum about the anchor are
//! those of the start, to rounding; the entropy falls in no step, and the temperatures become equal.

use eem::prelude::*;

/// A thermoelastic spring with logarithmic strain.
#[derive(Clone, FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let strain = ln(lambda / length);
    let heating = theta - theta_ref;
    0.5 * stiffness * strain.powi(2) - coupling * heating * strain
        + capacity * (heating - theta * ln(theta / theta_ref))
})]
struct Spring {
    #[unit("J")]
    stiffness: f64,
    #[unit("m")]
    length: f64,
    #[unit("J/K")]
    coupling: f64,
    #[unit("J/K")]
    capacity: f64,
    #[unit("K")]
    theta_ref: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let spring = |length| Spring {
        stiffness: 500.0,
        length,
        coupling: 0.2,
        capacity: 5.0,
        theta_ref: 300.0,
    };
    let mut scene = Scene::<3>::new();
    let anchor = scene.anchor([0.0, 0.0, 0.0]);
    let first = scene.mass(1.0, [2.1, 0.0, 0.0], [0.0, 3.0, 1.0]);
    let second = scene.mass(2.0, [2.0, 1.1, 0.0], [1.0, 0.0, -2.0]);
    let inner = scene.spring(spring(2.0), [anchor, first]);
    let outer = scene.spring(spring(1.0), [first, second]);
    scene.set_temperature(inner, 350.0);
    scene.set_temperature(outer, 290.0);
    scene.conduct(inner, outer, 1.0); // W/K

    let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    let start = run.ledger();
    let mut entropy = start.entropy;
    for _ in 0..2_000 {
        run.step()?;
        let now = run.ledger();
        assert!(now.entropy >= entropy - 2.0 * f64::EPSILON * entropy.abs());
        entropy = now.entropy;
    }
    let end = run.ledger();
    let temperatures = [run.temperature(inner)?, run.temperature(outer)?];

    println!(
        "after {:.0} s: {:.3} K and {:.3} K",
        run.time(),
        temperatures[0],
        temperatures[1]
    );
    println!(
        "energy            {:.10} J, at the start {:.10} J",
        end.energy, start.energy
    );
    println!("angular momentum  {:.9?}", end.angular_momentum.as_slice());
    println!(
        "at the start      {:.9?}",
        start.angular_momentum.as_slice()
    );
    println!("entropy produced  {:.6} J/K", end.entropy - start.entropy);
    // The energies are rounded relative to the heat 2 c θ of the springs.
    assert!((end.energy - start.energy).abs() < 20.0 * f64::EPSILON * 10.0 * 300.0);
    let turned = (end.angular_momentum - start.angular_momentum).norm();
    assert!(turned < 1e-12 * start.angular_momentum.norm());
    assert!((temperatures[0] - temperatures[1]).abs() < 5.0);
    Ok(())
}

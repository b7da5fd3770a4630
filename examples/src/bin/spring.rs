//! The smallest program: two masses on an elastic spring.
//!
//! ```text
//! ψ(λ) = ½ k (λ − l)²,     f = ∂ψ/∂λ,     q̇ = p/m,     ṗ = ∓f n
//! ```
//!
//! The pair is stretched; it vibrates, rotates and moves through the plane. Claim: after ten thousand steps, energy, linear
//! and angular momentum are those of the start, to rounding.

use eem::prelude::*;

/// Hooke's law.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| 0.5 * stiffness * (lambda - length).powi(2))]
struct Spring {
    #[unit("N/m")]
    stiffness: f64,
    #[unit("m")]
    length: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut scene = Scene::<2>::new();
    let left = scene.mass(1.0, [0.0, 0.0], [0.0, -1.0]); // kg, m, m/s
    let right = scene.mass(2.0, [1.2, 0.0], [0.5, 2.0]);
    let spring = Spring {
        stiffness: 100.0,
        length: 1.0,
    };
    scene.spring(spring, [left, right]);

    // 0.05 s is a tenth of the period of the vibration.
    let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.05)?;
    let start = run.ledger();
    for _ in 0..10_000 {
        run.step()?;
    }
    let end = run.ledger();

    println!("after {} s", run.time());
    println!(
        "energy            {:.12} J, at the start {:.12} J",
        end.energy, start.energy
    );
    println!(
        "linear momentum   {:?} kg m/s",
        end.linear_momentum.as_slice()
    );
    println!("angular momentum  {:.12} kg m²/s", end.angular_momentum[2]);
    assert!((end.energy - start.energy).abs() < 1e-12 * start.energy);
    assert!((end.linear_momentum - start.linear_momentum).norm() < 1e-12);
    // About the origin, from which the pair is 530 m away at the end.
    assert!((end.angular_momentum - start.angular_momentum).norm() < 1e-9);
    Ok(())
}

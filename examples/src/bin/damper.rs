//! A damper that heats up: a mass on a rubber band with a dashpot; the band cools in the air.
//!
//! ```text
//! ψ(λ, γ, θ) = ½ k ln²(λ/l) + ½ b (ln(λ/l) − γ/l)² − β (θ − θr) ln(λ/l) + c (θ − θr − θ ln(θ/θr))
//! γ̇ = g/η,   g = −∂ψ/∂γ          flow of the dashpot
//! θ ṡ = g γ̇ + κ (θ_air − θ)      dissipation, and heat from the air
//! ```
//!
//! Claim: while the motion decays into heat of band and air, the total energy stays constant to rounding, and the total
//! entropy never falls.

use eem::prelude::*;

/// A rubber band with a dashpot in series with a second spring.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    let strain = ln(lambda / length);
    let heating = theta - theta_ref;
    0.5 * stiffness * strain.powi(2) + 0.5 * branch * (strain - gamma / length).powi(2)
        - coupling * heating * strain
        + capacity * (heating - theta * ln(theta / theta_ref))
})]
#[viscosity(gamma = eta)]
struct Band {
    #[unit("J")]
    stiffness: f64,
    #[unit("J")]
    branch: f64,
    #[unit("m")]
    length: f64,
    #[unit("J/K")]
    coupling: f64,
    #[unit("J/K")]
    capacity: f64,
    #[unit("K")]
    theta_ref: f64,
    #[unit("N s/m")]
    eta: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let band = Band {
        stiffness: 100.0,
        branch: 80.0,
        length: 1.0,
        coupling: 0.1,
        capacity: 0.5,
        theta_ref: 300.0,
        eta: 40.0,
    };
    let mut scene = Scene::<2>::new();
    let hook = scene.anchor([0.0, 0.0]);
    let mass = scene.mass(2.0, [0.5, -1.6], [2.0, 0.0]);
    let band = scene.spring(band, [hook, mass]);
    scene.set_temperature(band, 300.0);
    scene.set_gravity([0.0, -9.81]);
    let air = scene.reservoir(300.0);
    scene.conduct(band, air, 0.1); // W/K

    let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.02)?;
    let start = run.ledger();
    run.meter_heat();
    println!(
        "  time   temperature   kinetic energy   dissipated     total energy    total entropy"
    );
    let mut entropy = start.entropy;
    for second in 0..=20 {
        run.run_until(f64::from(second))?;
        let now = run.ledger();
        assert!(now.entropy >= entropy - f64::EPSILON * entropy.abs());
        entropy = now.entropy;
        if second % 4 == 0 {
            let theta = run.temperature(band)?;
            println!(
                "{second:4} s {theta:11.4} K {:14.6} J {:10.6} J {:14.9} J {:12.9} J/K",
                now.kinetic_energy,
                run.dissipation(band)?,
                now.energy,
                now.entropy
            );
        }
    }
    // The energies are rounded relative to the heat c θ of the band.
    let rounding = f64::EPSILON * 0.5 * 300.0;
    assert!((run.ledger().energy - start.energy).abs() < 20.0 * rounding);
    Ok(())
}

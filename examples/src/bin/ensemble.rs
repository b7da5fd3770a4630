//! Two hundred dampers that differ in their viscosity: which one stops a mass soonest?
//!
//! ```text
//! ψ(λ, γ) = ½ k (λ − l)² + ½ b (λ − l − γ)²,     γ̇ = b (λ − l − γ)/η
//! ```
//!
//! A soft dashpot dissipates little because its force is small, a stiff one because it hardly moves. Claim: the best
//! viscosity lies between, near b/ω, and every run conserves its balance of energy.

use eem::prelude::*;

/// A spring in parallel with a Maxwell branch: a second spring and a dashpot in series.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| {
    let extension = lambda - length;
    0.5 * stiffness * extension.powi(2) + 0.5 * branch * (extension - gamma).powi(2)
})]
#[viscosity(gamma = eta)]
struct Damper {
    #[unit("N/m")]
    stiffness: f64,
    #[unit("N/m")]
    branch: f64,
    #[unit("m")]
    length: f64,
    #[unit("N s/m")]
    eta: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let viscosities: Vec<f64> = (0..200)
        .map(|i| 10_f64.powf(-1.0 + 0.02 * f64::from(i)))
        .collect();

    // One run per viscosity; with the feature `parallel` on all cores. Results: the mechanical energy left, J.
    let left = Ensemble::new(Scheme::EemTemperature, 0.01).run(
        &viscosities,
        |&eta| {
            let mut scene = Scene::<1>::new();
            let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.2], [0.0])];
            let (stiffness, branch, length) = (100.0, 100.0, 1.0);
            scene.spring(
                Damper {
                    stiffness,
                    branch,
                    length,
                    eta,
                },
                ends,
            );
            (scene, ())
        },
        |run, (), _| {
            let start = run.ledger().balance;
            run.run_until(3.0)?;
            let end = run.ledger();
            assert!((end.balance - start).abs() < 1e-13);
            // The material has no temperature: `energy` contains the heat of the dashpot as `lost_heat`.
            Ok(end.energy - end.lost_heat)
        },
    );

    let mut best = (f64::INFINITY, 0.0);
    for (place, (eta, left)) in viscosities.iter().zip(left).enumerate() {
        let left = left?;
        if left < best.0 {
            best = (left, *eta);
        }
        if place % 25 == 0 {
            println!("η = {eta:8.3} N s/m   {left:10.3e} J are left after 3 s");
        }
    }
    println!("least with η = {:.2} N s/m: {:.1e} J", best.1, best.0);
    // b/ω is 10 N s/m with the frequency of the first spring alone, 7 N s/m with that of both springs.
    assert!((5.0..15.0).contains(&best.1));
    Ok(())
}

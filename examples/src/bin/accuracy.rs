//! A tolerance instead of a step: the run chooses steps and scheme.
//!
//! ```text
//! ψ(λ) = −g/λ,     f = ∂ψ/∂λ = g/λ²
//! ```
//!
//! A planet on an elongated orbit is fast near the sun and slow far from it, so that any fixed step is too long in one place
//! or too short in the other. Claim: the error after an orbit is at most 10³ times the tolerance, and the energy is constant
//! to rounding at every tolerance.

use core::f64::consts::PI;

use eem::prelude::*;

/// Newton's law of gravitation.
#[derive(Clone, FreeEnergy)]
#[free_energy(|lambda: Stretch| -(strength / lambda))]
struct Gravitation {
    #[unit("J m")]
    strength: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Kepler: with 1 kg and g = 1 J m, an orbit with the semi-major axis 1 m takes 2π s.
    // It starts at the point nearest to the sun.
    let eccentricity: f64 = 0.8;
    let near = 1.0 - eccentricity;
    let speed = ((1.0 + eccentricity) / near).sqrt();

    println!("tolerance   steps   largest / smallest   error after an orbit   energy kept to");
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
        let mut scene = Scene::<2>::new();
        let sun = scene.anchor([0.0, 0.0]);
        let planet = scene.mass(1.0, [near, 0.0], [0.0, speed]);
        scene.spring(Gravitation { strength: 1.0 }, [sun, planet]);

        let mut run = Simulation::new(scene, Scheme::Auto, 0.01)?;
        run.control_steps(Tolerance::new(tolerance))?;
        let start = run.ledger();
        let (mut shortest, mut longest, mut steps) = (f64::INFINITY, 0.0_f64, 0);
        run.run_until_with(2.0 * PI, |_, report| {
            shortest = shortest.min(report.step);
            longest = longest.max(report.step);
            steps += 1;
            ControlFlow::Continue(())
        })?;

        let end = run.ledger();
        let place = run.position(planet)?;
        let error = (place[0] - near).hypot(place[1]);
        let energy = ((end.energy - start.energy) / start.energy).abs();
        println!(
            "{tolerance:9.0e} {steps:7} {:20.0} {error:22.1e} {energy:16.1e}",
            longest / shortest
        );
        assert!(error < 1e3 * tolerance);
        assert!(energy < 1e-13);
    }
    Ok(())
}

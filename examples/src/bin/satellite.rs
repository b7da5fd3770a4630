//! A satellite with two soft panels: rockets spin it up, and the panels swing.
//!
//! ```text
//! ψ = ½ Λ e1² + μ e2          Saint-Venant–Kirchhoff, per volume; e1 = tr E, e2 = E:E
//! J̇ = Σ r × F                 angular momentum; the forces F of two rockets turn with the body
//! ```
//!
//! A short version of the study `satellite` in `studies`, which reproduces a published satellite. Claim: while the rockets
//! fire, the change of energy is their work; afterwards energy and angular momentum are constant to rounding.

use eem::kinematics::Hex8;
use eem::prelude::*;

#[derive(Clone, FreeEnergy)]
#[free_energy(|e1: StrainTrace, e2: StrainSquare| 0.5 * lame * e1.powi(2) + mu * e2)]
struct Elastic {
    #[unit("Pa")]
    lame: f64,
    #[unit("Pa")]
    mu: f64,
}

/// How long the rockets fire, s.
const BURN: f64 = 1.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut scene = Scene::<3>::new();
    // A body of 1 m × 1 m × 0.1 m, and panels of 4 m × 1 m × 0.1 m on both sides of it.
    let body = Mesh::<Hex8, 3>::block([1, 1, 1], [[-0.5, 0.5], [-0.5, 0.5], [-0.05, 0.05]])?;
    let stiff = Elastic { lame: 1e8, mu: 1e8 };
    let body = scene.solid(stiff, &body, &Bulk::new(5000.0));
    let soft = Elastic { lame: 1e5, mu: 1e5 };
    for side in [[-4.5, -0.5], [0.5, 4.5]] {
        let panel = Mesh::<Hex8, 3>::block([8, 1, 1], [side, [-0.5, 0.5], [-0.05, 0.05]])?;
        scene.solid(
            soft.clone(),
            &panel,
            &Bulk::new(10.0).joined_to(&body, 1e-9),
        );
    }
    // Rockets at opposite corners, each pushing along the edge to the next corner.
    let corners = [[0.5, -0.5], [0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5]];
    let [a, b, c, d] = corners.map(|[x, y]| body.node_at([x, y, 0.05], 1e-9));
    let [a, b, c, d] = [a?, b?, c?, d?];
    let thrust = |t: f64| if t < BURN { 40.0 } else { 0.0 };
    scene.rocket(a, [a, b], thrust);
    scene.rocket(c, [c, d], thrust);

    let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.05)?;
    run.run_until(BURN)?;
    let burnt = run.ledger();
    println!("   time       energy     energy − work   angular momentum about z");
    for second in 0..=6 {
        run.run_until(BURN + 2.0 * f64::from(second))?;
        let now = run.ledger();
        println!(
            "{:5.1} s {:12.9} J {:13.1e} J {:17.12} kg m²/s",
            run.time(),
            now.energy,
            now.balance,
            now.angular_momentum[2]
        );
        assert!(now.balance.abs() < 1e-12);
        let turned = (now.angular_momentum - burnt.angular_momentum).norm();
        assert!(turned < 1e-11 * burnt.angular_momentum.norm());
    }
    // Two rockets of 40 N with lever arms of 0.5 m, for 1 s: 40 kg m²/s.
    assert!((burnt.angular_momentum[2] - 40.0).abs() < 1.0);
    Ok(())
}

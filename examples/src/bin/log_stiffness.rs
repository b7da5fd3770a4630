//! A stiffness that depends on the temperature: a spring cools when it is pulled.
//!
//! ```text
//! ψ(λ, θ) = ½ C(θ) ln²(λ/l) − β (θ − θr) ln(λ/l) + c (θ − θr − θ ln(θ/θr))
//! C(θ) = C0 − C1 θr ln(θ/θr)
//! s = −∂ψ/∂θ = ½ C1 θr/θ ln²(λ/l) + β ln(λ/l) + c ln(θ/θr)
//! ```
//!
//! Material: Conde Martín, Betsch & García Orden (2016), eq. (43). Without conduction and dashpots every motion is
//! isentropic, so the temperature is a function of the stretch. Claim: the entropy is constant to the last bit, and the
//! temperature at the largest stretch is that of the formula.

use eem::prelude::*;

#[derive(Clone, FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let strain = ln(lambda / length);
    let modulus = stiffness - softening * theta_ref * ln(theta / theta_ref);
    0.5 * modulus * strain.powi(2) - coupling * (theta - theta_ref) * strain
        + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
})]
struct Spring {
    #[unit("J")]
    stiffness: f64,
    #[unit("J/K")]
    softening: f64,
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
    let material = Spring {
        stiffness: 1000.0,
        softening: 2.0,
        length: 1.0,
        coupling: 1.0,
        capacity: 20.0,
        theta_ref: 300.0,
    };
    let mut scene = Scene::<1>::new();
    let mass = scene.mass(1.0, [1.0], [8.0]);
    let ends = [scene.anchor([0.0]), mass];
    let spring = scene.spring(material.clone(), ends);
    scene.set_temperature(spring, 300.0);

    let mut run = Simulation::new(scene, Scheme::Auto, 0.01)?;
    run.control_steps(Tolerance::new(1e-10))?;
    let entropy = run.ledger().entropy;
    // To the largest stretch, where the velocity changes its sign.
    let turns = Event::falling(move |run: &Simulation<1>| Ok(run.velocity(mass)?[0]));
    run.run_until_event(1.0, &mut [turns])?;

    let (stretch, theta) = (run.stretch(spring)?, run.temperature(spring)?);
    println!(
        "largest stretch {stretch:.6} after {:.6} s, at {theta:.6} K",
        run.time()
    );

    // Bisection for the temperature at which the formula gives the entropy of the start, zero.
    let strain = stretch.ln();
    let of_formula = |theta: f64| {
        0.5 * material.softening * 300.0 / theta * strain.powi(2)
            + material.coupling * strain
            + material.capacity * (theta / 300.0).ln()
    };
    let [mut low, mut high] = [200.0, 400.0];
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        *(if of_formula(middle) < entropy {
            &mut low
        } else {
            &mut high
        }) = middle;
    }
    println!("by the formula of the entropy    {low:.6} K");
    assert!((theta - low).abs() < 1e-10 * low);
    assert!(run.ledger().entropy.to_bits() == entropy.to_bits());
    Ok(())
}

//! Rubber: its entropy is a difference of terms far above its heat capacity. Its internal energy is
//! `c (θ − θ_r)` whatever its stretch, so that the energy of a state is known without them.

use eem::prelude::*;

use super::super::watched::EXACT;

/// An ideal rubber, whose stiffness is all of entropy.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    stiffness * theta / theta_ref * (0.5 * (lambda * lambda - 1.0) - ln(lambda))
        + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
})]
struct Rubber {
    stiffness: f64,
    capacity: f64,
    theta_ref: f64,
}

const AIR: f64 = 400.0;

/// `T + c (θ − θ_r) + θ_air σ`, J.
fn energy(run: &Simulation<2>, (mass, rubber, air): (Node, Element, Reservoir), c: f64) -> f64 {
    let p = run.momentum(mass).unwrap();
    let heat = AIR * run.reservoir_entropy(air).unwrap();
    0.5 * p.dot(&p) + c * (run.temperature(rubber).unwrap() - 300.0) + heat
}

#[test]
fn an_entropy_of_terms_that_cancel_keeps_energy_within_the_reported_bound() {
    for scheme in EXACT {
        for (capacity, speed, conductance) in [
            (1e-2, 1e-6, 0.0),
            (1e-2, 1e-6, 1.0),
            (1e-2, 1.0, 1.0),
            (1e-4, 1e-6, 1.0),
        ] {
            let mut scene = Scene::<2>::new();
            let anchor = scene.anchor([0.0, 0.0]);
            let mass = scene.mass(1.0, [0.6, 0.8], [speed, 0.3 * speed]);
            let rubber = Rubber {
                stiffness: 1e6,
                capacity,
                theta_ref: 300.0,
            };
            let rubber = scene.spring(rubber, [anchor, mass]);
            scene.set_temperature(rubber, 300.0);
            let air = scene.reservoir(AIR);
            scene.conduct(rubber, air, conductance);
            let mut run = Simulation::new(scene, scheme, 1e-3).unwrap();
            let parts = (mass, rubber, air);
            let before = energy(&run, parts, capacity);
            let report = run.step().unwrap();
            let change = energy(&run, parts, capacity) - before;
            let what = format!("{} c = {capacity} v = {speed}", scheme.name());
            assert!(
                change.abs() <= report.bound,
                "{what}: {change:e} J, {report:?}"
            );
            // What is reported is what is stored, to the rounding of this sum.
            let rounding = 8.0 * f64::EPSILON * (before.abs() + capacity * AIR);
            assert!(
                (change - report.defect).abs() <= rounding,
                "{what}: {change:e} J, {report:?}"
            );
        }
    }
}

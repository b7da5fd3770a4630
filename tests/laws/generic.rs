//! The scenes are GENERIC systems, and the EEM schemes discrete ones.

use eem::Generic;
use eem::prelude::*;
use nalgebra::{DMatrix, DVector};

use crate::kelvin_voigt::VOIGT;
use crate::support::solids::{Relaxing, SECTION};
use crate::support::{DoublePendulum, ThermoViscoElastic, hencky, single_pendulum_scene};

/// Roundings of one sum of products, relative to its terms.
const ROUNDING: f64 = 1e-14;

/// Four springs of three models, two of them in contact with each other and with the air, one with a dashpot
/// beside it.
fn scene(scheme: Scheme, step: f64) -> Simulation<2> {
    network(scheme, step).0
}

/// The same, with the springs that have a temperature.
fn network(scheme: Scheme, step: f64) -> (Simulation<2>, [Element; 3]) {
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let masses = [
        scene.mass(1.0, [1.3, 0.0], [0.0, 1.0]),
        scene.mass(2.0, [1.3, 1.2], [-0.5, 0.3]),
    ];
    let springs = [
        scene.spring(ThermoViscoElastic::PENDULUM, [pivot, masses[0]]),
        scene.spring(ThermoViscoElastic::PENDULUM, [masses[0], masses[1]]),
    ];
    let hencky = hencky(30.0, 1.5);
    scene.spring(hencky, [pivot, masses[1]]);
    let voigt = scene.spring(VOIGT, [masses[1], masses[0]]);
    scene.set_temperature(voigt, 320.0);
    let air = scene.reservoir(295.0);
    for (spring, temperature) in springs.into_iter().zip([330.0, 305.0]) {
        scene.set_temperature(spring, temperature);
        scene.set_viscous_stretch(spring, 0, 0.01);
        scene.conduct(spring, air, 2.0);
    }
    scene.conduct(springs[0], springs[1], 5.0);
    let run = Simulation::new(scene, scheme, step).unwrap();
    (run, [springs[0], springs[1], voigt])
}

/// |A x| against |A| |x|, entry by entry.
fn assert_vanishes(matrix: &DMatrix<f64>, vector: &DVector<f64>) {
    let product = matrix * vector;
    let size = matrix.abs() * vector.abs();
    for (entry, size) in product.iter().zip(size.iter()) {
        assert!(entry.abs() <= ROUNDING * size, "{entry:e} of {size:e}");
    }
}

fn assert_structure(generic: &Generic) {
    let (l, m) = (&generic.reversible, &generic.irreversible);
    assert_eq!(l.transpose(), -l);
    assert_eq!(&m.transpose(), m);
    let smallest = m.symmetric_eigenvalues().min();
    assert!(smallest >= -ROUNDING * m.norm(), "{smallest}");
    assert!(m.norm() > 0.0);
    assert_vanishes(l, &generic.entropy_gradient);
    assert_vanishes(m, &generic.energy_gradient);
}

/// L ∇E + M ∇S.
fn rate(generic: &Generic) -> DVector<f64> {
    &generic.reversible * &generic.energy_gradient
        + &generic.irreversible * &generic.entropy_gradient
}

#[test]
fn the_continuous_equations_are_generic() {
    let mut run = scene(Scheme::EemEntropy, 1e-6);
    let z0 = run.generic_state();
    let before = run.generic();
    assert_structure(&before);
    run.step().unwrap();
    let after = run.generic();
    let mean = (rate(&before) + rate(&after)) * 0.5;
    let difference = (run.generic_state() - z0) / 1e-6;
    // Trapezoidal rule: h² = 1e-12 times derivatives of the motion; the differences carry the rounding
    // of the state, ε |z|/h ≈ 1e-9.
    for (found, exact) in difference.iter().zip(mean.iter()) {
        assert!(
            (found - exact).abs() <= 1e-7 * (1.0 + exact.abs()),
            "{found} {exact}"
        );
    }
}

#[test]
fn a_step_that_is_no_longer_known_has_no_discrete_form() {
    let mut run = scene(Scheme::EemEntropy, 0.05);
    run.step().unwrap();
    assert!(run.generic_of_last_step().is_some());
    run.linearize(&vec![0.0; run.unknowns()]).unwrap();
    assert!(run.generic_of_last_step().is_none());

    run.step().unwrap();
    let end = run.time() + 1.0;
    let no_number = Event::crossing(|now: &Simulation<2>| {
        let is_early = now.time() < end - 0.5;
        Ok(if is_early { 1.0 } else { f64::NAN })
    });
    let failed = run.run_until_event(end, &mut [no_number]);
    assert!(failed.is_err());
    assert!(run.generic_of_last_step().is_none());
}

/// Steps of which each is a discrete GENERIC system: what changes is what the form says.
fn assert_steps(run: &mut Simulation<2>, steps: usize) {
    assert!(run.generic_of_last_step().is_none());
    for _ in 0..steps {
        let z0 = run.generic_state();
        run.step().unwrap();
        let generic = run.generic_of_last_step().unwrap();
        assert_structure(&generic);
        let change = run.generic_state() - &z0;
        let expected = rate(&generic) * run.step_size();
        let size = z0.abs() + run.generic_state().abs();
        for ((found, exact), size) in change.iter().zip(expected.iter()).zip(size.iter()) {
            // Discrete forces are those of the state before closing, off by rounding.
            let tolerance = 1e-13 * (1.0 + size + exact.abs());
            assert!((found - exact).abs() <= tolerance, "{found} {exact}");
        }
    }
}

#[test]
fn steps_are_discrete_generic_systems() {
    for scheme in [Scheme::EemEntropy, Scheme::EemTemperature] {
        assert_steps(&mut scene(scheme, 0.05), 100);
    }
}

/// A square whose viscous strain is a tensor, while it flows.
#[test]
fn steps_of_a_flowing_solid_are_discrete_generic_systems() {
    for scheme in [Scheme::EemEntropy, Scheme::EemTemperature] {
        let mut scene = Scene::<2>::new();
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let nodes = corners.map(|[x, y]| scene.node([x, y], [0.5 - y + x, 2.0 * x - y]));
        for point in scene.quadrilateral(Relaxing::RUBBER, nodes, SECTION) {
            scene.set_temperature(point, 310.0);
            scene.set_viscous_strain(point, [[0.1, 0.1, 0.0], [0.1, 0.0, 0.0], [0.0; 3]]);
        }
        let mut run = Simulation::new(scene, scheme, 0.02).unwrap();
        assert_structure(&run.generic());
        assert_steps(&mut run, 20);
    }
}

#[test]
fn the_double_pendulum_conducts_between_entropies() {
    let case = DoublePendulum::KRUEGER;
    let mut run = case.simulation(Scheme::EemTemperature, case.step).run;
    let generic = run.generic();
    assert_structure(&generic);
    // q and p of two masses in space, two entropies: κ θ₁θ₂ (1/θ₁², −1/(θ₁θ₂); …).
    assert_eq!(generic.energy_gradient.len(), 14);
    let (theta1, theta2, kappa) = (380.0, 310.0, 10.0);
    let m = &generic.irreversible;
    approx::assert_relative_eq!(m[(12, 12)], kappa * theta2 / theta1, max_relative = 1e-15);
    approx::assert_relative_eq!(m[(12, 13)], -kappa, max_relative = 1e-15);
    approx::assert_relative_eq!(m[(13, 13)], kappa * theta1 / theta2, max_relative = 1e-15);
}

#[test]
fn networks_have_the_form_in_temperatures_too() {
    let mut run = scene(Scheme::EemTemperature, 0.05);
    for _ in 0..10 {
        assert_structure(&run.generic_in_temperature());
        run.step().unwrap();
    }
}

#[test]
fn the_double_pendulum_has_the_published_form_in_temperatures() {
    for case in [DoublePendulum::KRUEGER, DoublePendulum::ROMERO] {
        let mut double = case.simulation(Scheme::EemTemperature, case.step);
        for _ in 0..5 {
            let entropies = double.run.generic();
            let form = double.run.generic_in_temperature();
            assert_structure(&form);
            // What moves is the same: ż of q, p and γ does not depend on the other variables.
            let rates = |form: &Generic| {
                &form.reversible * &form.energy_gradient
                    + &form.irreversible * &form.entropy_gradient
            };
            let (by_entropy, by_temperature) = (rates(&entropies), rates(&form));
            let size = by_entropy.rows(0, 12).norm();
            let difference = by_entropy.rows(0, 12) - by_temperature.rows(0, 12);
            assert!(difference.norm() < 1e-13 * size, "{difference}");
            // Eqs. (22) and (23), with (∂e/∂θ) from the gradient of E and ∂s/∂θ from that of S.
            let [e1, e2] = [12, 13].map(|place| form.energy_gradient[place]);
            let theta = [12, 13].map(|place| entropies.energy_gradient[place]);
            let factor = case.conductance * theta[0] * theta[1];
            let m = &form.irreversible;
            for (at, expected) in [
                ((12, 12), factor / (e1 * e1)),
                ((12, 13), -factor / (e1 * e2)),
                ((13, 13), factor / (e2 * e2)),
            ] {
                approx::assert_relative_eq!(m[at], expected, max_relative = 1e-13);
            }
            for spring in [12, 13] {
                let slope = form.entropy_gradient[spring];
                approx::assert_relative_eq!(
                    theta[spring - 12] * slope,
                    form.energy_gradient[spring],
                    max_relative = 1e-13
                );
            }
            double.run.step().unwrap();
        }
    }
    // The paper's case in its first state: κ θ₁θ₂/(∂e₁/∂θ₁)², and (∂s₁/∂θ₁)⁻¹ ∂s₁/∂λ₁ along the first axis.
    let case = DoublePendulum::KRUEGER;
    let mut run = case.simulation(Scheme::EemTemperature, case.step).run;
    let form = run.generic_in_temperature();
    approx::assert_relative_eq!(form.irreversible[(12, 12)], 1.178, max_relative = 1e-14);
    approx::assert_relative_eq!(form.reversible[(6, 12)], 0.076, max_relative = 1e-14);
}

/// A number between two others, the next of a simple sequence (Lehmer 1949, with the multiplier of Knuth).
fn between(least: f64, most: f64, seed: &mut u64) -> f64 {
    *seed = seed
        .wrapping_mul(6_364_136_223_846_793_005)
        .wrapping_add(1_442_695_040_888_963_407);
    let unit = f64::from(u32::try_from(*seed >> 32).unwrap()) / f64::from(u32::MAX);
    least + (most - least) * unit
}

/// Both forms of a scene, with masses and springs anywhere.
fn assert_generic_anywhere<const D: usize>(
    scene: &Scene<D>,
    (masses, springs): (&[Node], &[Element]),
    dashpots: usize,
) {
    let mut seed = 2016;
    for _ in 0..50 {
        let mut scene = scene.clone();
        for &mass in masses {
            let mut vector = |size: f64| [(); D].map(|()| between(-size, size, &mut seed));
            scene.set_position(mass, vector(3.0));
            scene.set_momentum(mass, vector(20.0));
        }
        for &spring in springs {
            scene.set_temperature(spring, between(250.0, 400.0, &mut seed));
            for dashpot in 0..dashpots {
                scene.set_viscous_stretch(spring, dashpot, between(-0.5, 0.5, &mut seed));
            }
        }
        let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.1).unwrap();
        assert_structure(&run.generic());
        assert_structure(&run.generic_in_temperature());
    }
}

#[test]
fn both_forms_hold_at_random_states_of_the_published_cases() {
    let (scene, bob, spring, _) = single_pendulum_scene();
    assert_generic_anywhere(&scene, (&[bob], &[spring]), 1);
    for case in DoublePendulum::ALL {
        let (scene, masses, springs) = case.scene();
        assert_generic_anywhere(&scene, (&masses, &springs), 0);
    }
}

#[test]
fn elements_produce_what_the_form_says() {
    let (mut run, springs) = network(Scheme::EemTemperature, 0.05);
    for _ in 0..20 {
        let form = run.generic();
        let expected = form
            .entropy_gradient
            .dot(&(&form.irreversible * &form.entropy_gradient));
        let productions = springs.map(|spring| run.entropy_production(spring).unwrap());
        assert!(productions.iter().all(|&production| production > 0.0));
        let sum: f64 = productions.iter().sum();
        // Terms of the form cancel: sums over all variables with gradients of both ends of a path.
        approx::assert_relative_eq!(sum, expected, max_relative = 1e-11);
        run.step().unwrap();
    }
}

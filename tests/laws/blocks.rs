//! Two hexahedra that tumble keep energy, momenta and the growth of entropy at any step.

use eem::kinematics::Hex8;
use eem::prelude::*;
use eem::{Body, StrainEnergy};
use eem_testkit::length::at_length;

use crate::support::solids::{Flowing, MooneyRivlin, Reinforced, Relaxing, ThermoelasticSolid};

/// A bar of two cubes, warm at one end and in contact with air, and what its points hold, J.
fn tumbling<M, const N: usize>(
    (material, bulk): (&M, &Bulk<3>),
    theta_ref: f64,
    (scheme, step): (Scheme, f64),
) -> (Simulation<3>, f64)
where
    M: FreeEnergy<f64> + StrainEnergy<N> + Clone + Send + Sync + 'static,
{
    let mut scene = Scene::<3>::new();
    let mesh = Mesh::block([2, 1, 1], [[0.0, 2.0], [0.0, 1.0], [0.0, 1.0]]).unwrap();
    let body: Body<Hex8, 3> = scene.solid(material.clone(), &mesh, bulk);
    let speed = f64::min(1.0, 0.2 / step);
    let [a, b, c] = [1.0, 2.0, 1.0].map(|n| n / f64::sqrt(6.0));
    for (&node, &[x, y, z]) in body.nodes().iter().zip(mesh.nodes()) {
        let [u, v, w] = [x - 1.0, y - 0.5, z - 0.5];
        let velocity = [
            b * w - c * v + 1e-3 * x * y,
            c * u - a * w - 1e-3 * z,
            a * v - b * u + 1e-3 * x,
        ];
        scene.set_velocity(node, velocity.map(|v| speed * v));
    }
    let mut heat = 0.0;
    let mut theta = theta_ref;
    for &point in body.points() {
        scene.set_temperature(point, theta);
        // 1/8 m³ of 100 J/(K m³) each.
        heat += 100.0 / 8.0 * theta;
        theta += 0.05;
    }
    let air = scene.reservoir(295.0);
    scene.conduct(body.points()[0], air, 5.0);
    let end = mesh.face(|[x, ..]| x >= 2.0).unwrap();
    scene.exchange(&body, &end, air, 10.0);
    (Simulation::new(scene, scheme, step).unwrap(), heat)
}

/// Steps keep the laws, whatever the step.
fn keep_the_laws<M, const N: usize>(name: &str, parts: (&M, &Bulk<3>), theta_ref: f64)
where
    M: FreeEnergy<f64> + StrainEnergy<N> + Clone + Send + Sync + 'static,
{
    for scheme in [Scheme::EemEntropy, Scheme::EemTemperature] {
        for step in [1e-3, 1e-2, 1e-1, 1.0, 10.0] {
            let (mut run, heat) = tumbling(parts, theta_ref, (scheme, step));
            let first = run.ledger();
            // 20 kg, the fastest of which move at about 1 m/s.
            let momenta = 20.0 * f64::min(1.0, 0.2 / step);
            let mut entropy = first.entropy;
            let mut worst = [0.0_f64; 3];
            for _ in 0..at_length(40, 4) {
                run.step().unwrap();
                let ledger = run.ledger();
                let errors = [
                    (ledger.balance - first.balance).abs() / heat,
                    (ledger.linear_momentum - first.linear_momentum).norm() / momenta,
                    (ledger.angular_momentum - first.angular_momentum).norm()
                        / first.angular_momentum.norm(),
                ];
                let [energy, linear, angular] = errors;
                worst = std::array::from_fn(|law| worst[law].max(errors[law]));
                assert!(
                    energy <= 1e-15 && linear <= 2e-14 && angular <= 5e-14,
                    "{name} {scheme} {step}: {errors:?}"
                );
                assert!(ledger.entropy >= entropy, "{name} {scheme} {step}");
                entropy = ledger.entropy;
            }
            println!("{name} {scheme} {step}: {worst:?}");
        }
    }
}

#[test]
fn tumbling_hexahedra_keep_the_laws() {
    let bulk = Bulk::new(10.0).conductivity(20.0);
    keep_the_laws("softening", (&ThermoelasticSolid::RUBBER, &bulk), 300.0);
    keep_the_laws("Mooney-Rivlin", (&MooneyRivlin::RUBBER, &bulk), 293.15);
    let bulk = bulk.fibre([0.6, 0.8, 0.0]);
    keep_the_laws("viscoelastic", (&Reinforced::RUBBER, &bulk), 300.0);
}

#[test]
fn tumbling_hexahedra_whose_shape_flows_keep_the_laws() {
    let bulk = Bulk::new(10.0).conductivity(20.0);
    keep_the_laws("relaxing", (&Relaxing::RUBBER, &bulk), 300.0);
    let bulk = bulk.fibre([0.6, 0.8, 0.0]);
    keep_the_laws("flowing", (&Flowing::RUBBER, &bulk), 300.0);
}

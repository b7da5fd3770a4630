//! Solids converge with the order of the scheme, at strains of order one.

use eem::StrainEnergy;
use eem::kinematics::Hex8;
use eem::prelude::*;

use crate::support::solids::{MooneyRivlin, Reinforced, ThermoelasticSolid};

const END: f64 = 0.04;
const STEPS: [f64; 2] = [0.0025, 0.00125];

/// Positions and velocities at the end, of a block that is stretched, sheared and released.
fn end<M, const N: usize>(
    (material, theta): (&M, f64),
    fibre: bool,
    (scheme, step): (Scheme, f64),
) -> Vec<f64>
where
    M: FreeEnergy<f64> + StrainEnergy<N> + Clone + Send + Sync + 'static,
{
    let mut scene = Scene::<3>::new();
    let mesh = Mesh::<Hex8, 3>::block([1; 3], [[0.0, 2.0], [0.0, 1.0], [0.0, 1.0]]).unwrap();
    let mut bulk = Bulk::new(10.0).conductivity(20.0);
    if fibre {
        bulk = bulk.fibre([0.6, 0.8, 0.0]);
    }
    let body = scene.solid(material.clone(), &mesh, &bulk);
    for (&node, &[x, y, z]) in body.nodes().iter().zip(mesh.nodes()) {
        scene.set_position(node, [1.4 * x + 0.2 * y, 0.9 * y + 0.1 * x * z, 0.95 * z]);
        scene.set_velocity(node, [2.0 * y, -3.0 * z, 1.0 * x * y]);
    }
    for &point in body.points() {
        scene.set_temperature(point, theta);
    }
    let mut run = Simulation::new(scene, scheme, step).unwrap();
    run.run_until(END).unwrap();
    let state = |&node: &Node| {
        let [q, v] = [run.position(node).unwrap(), run.velocity(node).unwrap()];
        [q.x, q.y, q.z, v.x, v.y, v.z]
    };
    body.nodes().iter().flat_map(state).collect()
}

fn converges<M, const N: usize>(name: &str, material: (&M, f64), fibre: bool)
where
    M: FreeEnergy<f64> + StrainEnergy<N> + Clone + Send + Sync + 'static,
{
    let exact = end(material, fibre, (Scheme::EemTemperature, STEPS[1] / 4.0));
    for scheme in [Scheme::EemEntropy, Scheme::EemTemperature] {
        let errors = STEPS.map(|step| {
            let found = end(material, fibre, (scheme, step));
            let squares = found.iter().zip(&exact).map(|(a, b)| (a - b) * (a - b));
            squares.sum::<f64>().sqrt()
        });
        let slope = (errors[0] / errors[1]).log2();
        println!("{name} {scheme}: {errors:?}, {slope}");
        assert!((1.9..=2.2).contains(&slope), "{name} {scheme}: {slope}");
    }
}

#[test]
fn solids_converge_with_second_order() {
    converges("softening", (&ThermoelasticSolid::RUBBER, 300.0), false);
    converges("viscoelastic", (&Reinforced::RUBBER, 300.0), true);
    converges("Mooney-Rivlin", (&MooneyRivlin::RUBBER, 293.15), false);
}

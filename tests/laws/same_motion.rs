//! How a solid is turned in space and how its nodes and cells are numbered changes its motion by rounding
//! only; and Newton's method converges quadratically.

use eem::StrainEnergy;
use eem::kinematics::{Hex8, Hex20, Shape};
use eem::nalgebra::{DMatrix, DVector, Rotation3, Vector3};
use eem::prelude::*;

use crate::support::numbers::Numbers;
use crate::support::solids::{MooneyRivlin, ThermoelasticSolid};

/// The numbers below `count` in an order of chance.
fn shuffled(count: usize, numbers: &mut Numbers) -> Vec<usize> {
    let mut order: Vec<_> = (0..count).map(|at| (numbers.next(), at)).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    order.into_iter().map(|(_, at)| at).collect()
}

/// Positions (m) and velocities (m/s) of the nodes and temperatures (K) of the first points of the cells after
/// some steps, in the numbering and the axes of `Mesh::block`.
fn motion<H: Shape<3>, M, const N: usize>(
    (material, scheme): (&M, Scheme),
    turn: Rotation3<f64>,
    is_shuffled: bool,
) -> Vec<f64>
where
    M: FreeEnergy<f64> + StrainEnergy<N> + Clone + Send + Sync + 'static,
{
    let mut numbers = Numbers(11);
    let block = Mesh::<H, 3>::block([2, 1, 1], [[0.0, 2.0], [0.0, 1.0], [0.0, 1.0]]).unwrap();
    let [mut nodes, mut cells] =
        [block.nodes().len(), block.cells().len()].map(|count| (0..count).collect::<Vec<_>>());
    if is_shuffled {
        nodes = shuffled(nodes.len(), &mut numbers);
        cells = shuffled(cells.len(), &mut numbers);
        cells.reverse();
    }
    let place_of = |old: usize| nodes.iter().position(|&node| node == old).unwrap();
    let turned = |place: [f64; 3]| -> [f64; 3] { (turn * Vector3::from(place)).into() };
    let places = nodes.iter().map(|&old| turned(block.nodes()[old]));
    let renumbered = cells.iter().map(|&old| {
        let mut cell = block.cells()[old];
        for node in cell.as_mut() {
            *node = place_of(*node);
        }
        cell
    });
    let mesh = Mesh::<H, 3>::new(places.collect(), renumbered.collect()).unwrap();
    let mut scene = Scene::<3>::new();
    let bulk = Bulk::new(10.0).conductivity(20.0);
    let body = scene.solid(material.clone(), &mesh, &bulk);
    for (&node, &old) in body.nodes().iter().zip(&nodes) {
        let [x, y, z] = block.nodes()[old];
        let velocity = [0.5 * y - 0.3 * z * x, 0.4 * x * z - 0.2, 0.3 * x - 0.4 * y];
        scene.set_velocity(node, turned(velocity));
    }
    let points = body.points().len() / cells.len();
    for (at, &point) in body.points().iter().enumerate() {
        let old = u32::try_from(cells[at / points] * points + at % points).unwrap();
        scene.set_temperature(point, 300.0 + 0.1 * f64::from(old));
    }
    let mut run = Simulation::new(scene, scheme, 0.05).unwrap();
    for _ in 0..4 {
        run.step().unwrap();
    }
    let back = turn.inverse();
    let mut found = Vec::new();
    for old in 0..nodes.len() {
        let node = body.nodes()[place_of(old)];
        let vectors = [run.position(node).unwrap(), run.velocity(node).unwrap()];
        found.extend(
            vectors
                .iter()
                .flat_map(|vector| <[f64; 3]>::from(back * vector)),
        );
    }
    for old in 0..cells.len() {
        let cell = cells.iter().position(|&cell| cell == old).unwrap();
        found.push(run.temperature(body.points()[cell * points]).unwrap());
    }
    found
}

/// Coordinates of 2 m are rounded by 4e-16 m, which stiffnesses of 4000 N/m make a force and four steps of 0.05 s on
/// 1 kg a velocity.
const ROUNDING: f64 = 4.0 * 0.05 * 4000.0 * 4.4e-16;

fn is_the_same_motion<H: Shape<3>, M, const N: usize>(material: &M, schemes: &[Scheme])
where
    M: FreeEnergy<f64> + StrainEnergy<N> + Clone + Send + Sync + 'static,
{
    let turn = Rotation3::new(Vector3::new(0.7, -1.9, 0.4));
    for &scheme in schemes {
        let known = motion::<H, M, N>((material, scheme), Rotation3::identity(), false);
        let found = motion::<H, M, N>((material, scheme), turn, true);
        assert_eq!(found.len(), known.len());
        for (found, known) in found.iter().zip(&known) {
            let error = (found - known).abs();
            assert!(
                error <= ROUNDING * known.abs().max(1.0),
                "{scheme}: {error:e}"
            );
        }
    }
}

#[test]
fn turns_and_numbers_change_a_motion_by_rounding_only() {
    let forms = [Scheme::EemEntropy, Scheme::EemTemperature];
    is_the_same_motion::<Hex8, _, _>(&ThermoelasticSolid::RUBBER, &forms);
    is_the_same_motion::<Hex8, _, _>(&MooneyRivlin::RUBBER, &forms);
    is_the_same_motion::<Hex20, _, _>(&ThermoelasticSolid::RUBBER, &forms[1..]);
}

/// The updates (m) of Newton's method with the tangent of a step, of a body of 1 m that is strained a lot.
fn updates<H: Shape<3>>(scheme: Scheme) -> Vec<f64> {
    let mesh = Mesh::<H, 3>::block([1; 3], [[0.0, 1.0]; 3]).unwrap();
    let mut scene = Scene::<3>::new();
    let body = scene.solid(ThermoelasticSolid::RUBBER, &mesh, &Bulk::new(10.0));
    for (&node, &[x, y, z]) in body.nodes().iter().zip(mesh.nodes()) {
        scene.set_position(node, [1.3 * x + 0.2 * y, 0.9 * y, z + 0.1 * x * y]);
    }
    for &point in body.points() {
        scene.set_temperature(point, 310.0);
    }
    let mut run = Simulation::new(scene, scheme, 0.05).unwrap();
    let count = run.unknowns();
    let mut found = DVector::zeros(count);
    let mut updates = Vec::new();
    for _ in 0..10 {
        let system = run.linearize(found.as_slice()).unwrap();
        let tangent = DMatrix::from_row_slice(count, count, &system.tangent);
        let residual = DVector::from_vec(system.residual);
        let change = tangent.lu().solve(&residual).unwrap();
        updates.push(change.amax());
        found -= change;
    }
    updates
}

#[test]
fn newtons_method_converges_quadratically_for_solids() {
    for scheme in [
        Scheme::EemEntropy,
        Scheme::EemTemperature,
        Scheme::Midpoint,
        Scheme::Trapezoidal,
    ] {
        // Cells of twenty nodes with the schemes of both forms.
        let quadratic = scheme.is_exact().then(|| updates::<Hex20>(scheme));
        for updates in [updates::<Hex8>(scheme)].into_iter().chain(quadratic) {
            println!("{scheme}: {updates:?}");
            let near = updates
                .windows(2)
                .filter(|pair| pair[0] < 0.1 && pair[0] > 1e-7);
            let mut seen = 0;
            for pair in near {
                // The third derivative over the second one, in 1/m.
                assert!(
                    pair[1] <= 4.0 * pair[0] * pair[0] + 1e-12,
                    "{scheme}: {pair:?}"
                );
                seen += 1;
            }
            assert!(seen >= 2, "{scheme}: {updates:?}");
        }
    }
}

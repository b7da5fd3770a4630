//! Meshes and the solids made of them: what is wrong with them is said, and solids are joined.

use eem::kinematics::{Hex8, Hex20, Quad4, Quad8};
use eem::prelude::*;
use eem::{Body, MeshError, SolidError, Strain, StrainEnergy};

use crate::support::solids::{MooneyRivlin, Reinforced, SaintVenant, ThermoelasticSolid};

const ELASTIC: SaintVenant = SaintVenant {
    lame: 2000.0,
    shear: 1000.0,
};

fn cube(cells: usize) -> Mesh<Hex8, 3> {
    Mesh::block([cells; 3], [[0.0, 1.0]; 3]).unwrap()
}

#[test]
fn what_is_wrong_with_a_mesh_is_said() {
    let corners = || vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let build = |nodes, cells| Mesh::<Quad4, 2>::new(nodes, cells).unwrap_err().to_string();
    assert_eq!(build(corners(), vec![]), "the mesh has no cells");
    assert_eq!(
        build(corners(), vec![[0, 1, 2, 4]]),
        "cell 0 has node 4, but there are 4 nodes, counted from 0"
    );
    assert_eq!(
        build(corners(), vec![[0, 1, 2, 2]]),
        "cell 0 has node 2 twice"
    );
    let mut nodes = corners();
    nodes.push([2.0, 2.0]);
    assert_eq!(
        build(nodes, vec![[0, 1, 2, 3]]),
        "node 4 belongs to no cell"
    );
    let mut nodes = corners();
    nodes.extend([[2.0, 0.0], [2.0, 1.0], [1.0, -0.0]]);
    assert_eq!(
        build(nodes, vec![[0, 1, 2, 3], [6, 4, 5, 2]]),
        "nodes 1 and 6 are in the same place"
    );
    let mut nodes = corners();
    nodes[2][1] = f64::INFINITY;
    assert!(build(nodes, vec![[0, 1, 2, 3]]).starts_with("coordinate 1 of node 2 is inf"));
    let message = build(corners(), vec![[0, 1, 3, 2]]);
    assert!(
        message.starts_with("cell 0 is inside out: det dX/dxi is"),
        "{message}"
    );
    for (cells, ranges) in [
        ([0, 1], [[0.0, 1.0]; 2]),
        ([1, 1], [[0.0, 1.0], [1.0, 1.0]]),
    ] {
        assert!(Mesh::<Quad4, 2>::block(cells, ranges).is_err());
    }
    assert_eq!(
        Mesh::<Quad4, 2>::grid([&[0.0, 1.0], &[0.0, 2.0, f64::NAN]])
            .unwrap_err()
            .to_string(),
        "cut 2 along axis 1 is NaN m, it must be finite and above the one before"
    );
    assert_eq!(cube(2).kept(|_| false).unwrap_err(), MeshError::Empty);
}

/// The message of a scene with a body of one cell.
fn refused<M, const N: usize>(
    material: M,
    bulk: &Bulk<3>,
    change: impl FnOnce(&mut Scene<3>, &Body<Hex8, 3>),
) -> SceneError
where
    M: FreeEnergy<f64> + StrainEnergy<N> + Clone + Send + Sync + 'static,
{
    let mut scene = Scene::<3>::new();
    let body = scene.solid(material, &cube(1), bulk);
    change(&mut scene, &body);
    let run = Simulation::new(scene, Scheme::EemEntropy, 0.1);
    run.unwrap_err().into()
}

#[test]
fn what_is_wrong_with_a_solid_from_a_mesh_is_said() {
    assert_eq!(Reinforced::STRAINS[2], Strain::Fibre);
    let bulk = Bulk::new(10.0);
    let nothing = |_: &mut Scene<3>, _: &Body<Hex8, 3>| {};
    let counts = |error| match error {
        SceneError::Solid(SolidError::Fibres { needed, given, .. }) => [needed, given],
        other => panic!("{other}"),
    };
    assert_eq!(counts(refused(Reinforced::RUBBER, &bulk, nothing)), [1, 0]);
    let along = bulk.clone().fibre([1.0, 0.0, 0.0]);
    assert_eq!(counts(refused(ELASTIC, &along, nothing)), [0, 1]);
    let nowhere = bulk.clone().fibre([0.0; 3]);
    let message = refused(Reinforced::RUBBER, &nowhere, nothing).to_string();
    assert!(
        message.starts_with("the direction of a fibre of the solid at element 0"),
        "{message}"
    );
    let message = refused(ELASTIC, &Bulk::new(-1.0), nothing).to_string();
    assert!(
        message.starts_with("the density of the solid at element 0 (SaintVenant) is -1 kg/m^3"),
        "{message}"
    );
    let message = refused(MooneyRivlin::RUBBER, &bulk, |scene, body| {
        let air = scene.reservoir(300.0);
        let end = body.mesh().face(|[x, ..]| x >= 1.0).unwrap();
        scene.exchange(body, &end, air, 10.0);
    });
    assert!(
        message.to_string().contains("has no conductivity"),
        "{message}"
    );
    let inverse = bulk.clone().conductivity(-1.0);
    let message = refused(MooneyRivlin::RUBBER, &inverse, |scene, body| {
        for &point in body.points() {
            scene.set_temperature(point, 300.0);
        }
    });
    assert!(
        message
            .to_string()
            .starts_with("the conductance between element 0"),
        "{message}"
    );
    let message = refused(ELASTIC, &bulk, |scene, body| {
        scene.dead_load(body.nodes()[0], [1.0, 0.0, 0.0]);
        scene.fix(body.nodes()[0]);
    });
    assert!(
        message.to_string().contains("cannot be given a force"),
        "{message}"
    );
    let message = refused(ELASTIC, &bulk, |scene, body| {
        scene.fix(body.nodes()[0]);
        scene.set_velocity(body.nodes()[0], [1.0, 0.0, 0.0]);
    });
    assert!(
        message.to_string().contains("cannot be given a velocity"),
        "{message}"
    );
    let error = {
        let mut scene = Scene::<3>::new();
        let body = scene.solid(ELASTIC, &cube(1), &bulk);
        body.node_at([0.0, 0.0, 0.1], 0.01).unwrap_err()
    };
    assert_eq!(
        error.to_string(),
        "no node is at [0.0, 0.0, 0.1] m: the nearest is at [0.0, 0.0, 0.0] m"
    );
}

/// A few skew faces are no error: the rim of a mesh may have some.
#[test]
fn conduction_through_skew_cells_has_to_be_allowed() {
    let squares = Mesh::<Quad4, 2>::block([20, 22], [[0.0, 1.0]; 2]).unwrap();
    let build = |by: f64, from: f64, allow: bool| {
        let mesh = squares
            .mapped(|[x, y]| [x + by * (y - from).max(0.0), y])
            .unwrap();
        let bulk = Bulk::new(10.0).conductivity(1.0);
        let bulk = if allow { bulk.allow_skew_cells() } else { bulk };
        let mut scene = Scene::<2>::new();
        let body = scene.solid(ThermoelasticSolid::RUBBER, &mesh, &bulk);
        for &point in body.points() {
            scene.set_temperature(point, 300.0);
        }
        let run = Simulation::new(scene, Scheme::EemEntropy, 0.1);
        (mesh.skew_faces(), run.err().map(SceneError::from))
    };
    // A shear of 0.3 has the cosine 0.958, one of 0.35 0.944.
    assert!(matches!(build(0.3, 0.0, false), ((0, 3436), None)));
    let ((skew, faces), error) = build(0.35, 0.0, false);
    assert_eq!((skew, faces), (3436, 3436));
    let message = error.unwrap().to_string();
    assert!(
        message.contains("heat crosses 3436 of 3436 faces") && message.contains("at 0.944"),
        "{message}"
    );
    assert!(build(0.35, 0.0, true).1.is_none());
    // One layer of 22 is skew, with the faces to its neighbour.
    let ((skew, _), error) = build(0.35, 21.0 / 22.0, false);
    assert!(
        skew > 0 && skew <= 171 && error.is_none(),
        "{skew} {error:?}"
    );
}

/// Heat passes between solids that conduct and share a whole face.
#[test]
fn heat_between_solids_needs_a_shared_face_and_conductivities() {
    let refused = |conductivities: [Option<f64>; 2], within: f64, twice: bool| {
        let bulk = |conductivity| match conductivity {
            Some(conductivity) => Bulk::new(10.0).conductivity(conductivity),
            None => Bulk::<3>::new(10.0),
        };
        let mut scene = Scene::<3>::new();
        let first = scene.solid(MooneyRivlin::RUBBER, &cube(1), &bulk(conductivities[0]));
        let beside = cube(1).translated([1.0, 0.0, 0.0]).unwrap();
        let joined = bulk(conductivities[1]).joined_to(&first, within);
        let second = scene.solid(MooneyRivlin::RUBBER, &beside, &joined);
        for &point in first.points().iter().chain(second.points()) {
            scene.set_temperature(point, 300.0);
        }
        scene.conduct_between(&first, if twice { &first } else { &second });
        let run = Simulation::new(scene, Scheme::EemEntropy, 0.1);
        run.unwrap_err().to_string()
    };
    let both = [Some(1.0); 2];
    let message = refused(both, -1.0, false);
    assert!(
        message.starts_with("the solids at element 0 (MooneyRivlin) and element 8 (MooneyRivlin) share no whole face"),
        "{message}"
    );
    let message = refused([Some(1.0), None], 1e-9, false);
    assert!(
        message.starts_with("the solid at element 8 (MooneyRivlin) has no conductivity"),
        "{message}"
    );
    let message = refused(both, 1e-9, true);
    assert!(message.contains("itself"), "{message}");
}

/// Two solids share the nodes of a line, about which one turns freely beside the other.
#[test]
fn joined_solids_share_nodes() {
    let mut scene = Scene::<3>::new();
    let body = scene.solid(ELASTIC, &cube(1), &Bulk::new(10.0));
    let beside = Mesh::<Hex20, 3>::block([1; 3], [[1.0, 2.0], [0.0, 1.0], [-1.0, 0.0]]).unwrap();
    let bulk = Bulk::new(10.0).joined_to(&body, 1e-9);
    let panel = scene.solid(ELASTIC, &beside, &bulk);
    let shared = panel
        .nodes()
        .iter()
        .filter(|node| body.nodes().contains(node));
    assert_eq!(shared.count(), 2);
    for (&node, [x, _, z]) in panel.nodes().iter().zip(beside.nodes()) {
        // About the line x = 1, z = 0.
        scene.set_velocity(node, [-z, 0.0, x - 1.0]);
    }
    let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.01).unwrap();
    let before = run.ledger();
    for _ in 0..20 {
        run.step().unwrap();
    }
    let after = run.ledger();
    assert!((after.balance - before.balance).abs() <= 1e-14 * before.energy);
    let turned = (after.angular_momentum - before.angular_momentum).norm();
    assert!(
        turned <= 1e-13 * before.angular_momentum.norm(),
        "{turned:e}"
    );
}

#[test]
fn an_extruded_block_is_a_block() {
    let cuts: [&[f64]; 3] = [&[0.0, 1.0, 3.0], &[-1.0, 1.0], &[0.0, 0.25, 2.0]];
    let block = Mesh::<Hex8, 3>::grid(cuts).unwrap();
    let profile = Mesh::<Quad4, 2>::grid([cuts[0], cuts[1]]).unwrap();
    let extruded = Mesh::<Hex8, 3>::extruded(&profile, cuts[2]).unwrap();
    assert_eq!(extruded.cells(), block.cells());
    let block_of_20 = Mesh::<Hex20, 3>::grid(cuts).unwrap();
    let profile_of_8 = Mesh::<Quad8, 2>::grid([cuts[0], cuts[1]]).unwrap();
    let of_20 = Mesh::<Hex20, 3>::extruded(&profile_of_8, cuts[2]).unwrap();
    assert_eq!(of_20.cells(), block_of_20.cells());
    let bits = |nodes: &[[f64; 3]]| {
        nodes
            .iter()
            .map(|place| place.map(f64::to_bits))
            .collect::<Vec<_>>()
    };
    assert_eq!(bits(extruded.nodes()), bits(block.nodes()));
    assert_eq!(bits(of_20.nodes()), bits(block_of_20.nodes()));

    let heights = |heights: &[f64]| Mesh::<Hex8, 3>::extruded(&profile, heights).unwrap_err();
    assert_eq!(heights(&[1.0]), MeshError::Empty);
    let message = heights(&[1.0, 0.5]).to_string();
    assert!(
        message.starts_with("cut 1 along axis 2 is 0.5 m"),
        "{message}"
    );
}

/// The area of a mesh, m².
fn area(mesh: &Mesh<Quad4, 2>) -> f64 {
    let cross =
        |[a, b, c, d]: [[f64; 2]; 4]| (c[0] - a[0]) * (d[1] - b[1]) - (c[1] - a[1]) * (d[0] - b[0]);
    let cells = mesh.cells().iter();
    cells
        .map(|cell| 0.5 * cross(cell.map(|node| mesh.nodes()[node])))
        .sum()
}

#[test]
fn polygons_are_filled() {
    // A star with re-entrant corners, a comb, a square with corners in the middles of its sides; in both senses.
    let star: Vec<[f64; 2]> = (0..12_u8)
        .map(|at| {
            let (angle, radius) = (f64::from(at) * 0.523, if at % 2 == 0 { 2.0 } else { 0.7 });
            [radius * f64::cos(angle), radius * f64::sin(angle)]
        })
        .collect();
    let comb = vec![
        [0.0, 0.0],
        [5.0, 0.0],
        [5.0, 3.0],
        [4.0, 3.0],
        [4.0, 1.0],
        [3.0, 1.0],
        [3.0, 3.0],
        [2.0, 3.0],
        [2.0, 1.0],
        [1.0, 1.0],
        [1.0, 3.0],
        [0.0, 3.0],
    ];
    let square = vec![
        [0.0, 0.0],
        [1.0, 0.0],
        [2.0, 0.0],
        [2.0, 1.0],
        [2.0, 2.0],
        [1.0, 2.0],
        [0.0, 2.0],
        [0.0, 1.0],
    ];
    for mut corners in [star, comb, square] {
        let mut twice = 0.0;
        for (at, [x, y]) in corners.iter().enumerate() {
            let [u, v] = corners[(at + 1) % corners.len()];
            twice += x * v - y * u;
        }
        for _ in 0..2 {
            let mesh = Mesh::<Quad4, 2>::polygon(&corners).unwrap();
            assert_eq!(mesh.cells().len(), 3 * (corners.len() - 2));
            assert!((area(&mesh) - 0.5 * twice).abs() <= 1e-14 * twice);
            let finer = mesh.refined().unwrap();
            assert_eq!(finer.cells().len(), 4 * mesh.cells().len());
            assert!((area(&finer) - 0.5 * twice).abs() <= 1e-14 * twice);
            corners.reverse();
        }
    }
}

#[test]
fn what_is_wrong_with_a_polygon_is_said() {
    let polygon = |corners: &[[f64; 2]]| Mesh::<Quad4, 2>::polygon(corners).unwrap_err();
    assert_eq!(polygon(&[[0.0, 0.0], [1.0, 0.0]]), MeshError::Empty);
    assert!(matches!(
        polygon(&[[0.0, 0.0], [1.0, f64::NAN], [0.0, 1.0]]),
        MeshError::Place {
            node: 1,
            axis: 1,
            ..
        }
    ));
    // On a line; with a corner twice; going back; touching itself at a corner.
    let crossing = |corners: &[[f64; 2]]| match polygon(corners) {
        MeshError::Crossing { sides } => sides,
        other => panic!("{other}"),
    };
    assert_eq!(crossing(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]), [0, 2]);
    assert_eq!(
        crossing(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [0.0, 1.0]]),
        [0, 1]
    );
    assert_eq!(
        crossing(&[[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [0.0, 1.0]]),
        [0, 1]
    );
    let touching = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 0.0], [0.0, 2.0]];
    assert_eq!(crossing(&touching), [0, 2]);
}

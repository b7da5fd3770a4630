//! Meshes and the solids made of them: what is wrong with them is said, and solids are joined.

use eem::kinematics::{Hex8, Hex20, Quad4, Quad8, Shape};
use eem::prelude::*;
use eem::{Body, Face, MeshError, SolidError, Strain, StrainEnergy};

use crate::support::only_error;
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
    let endless = [[0.0, 1.0], [f64::NEG_INFINITY, f64::INFINITY]];
    let error = Mesh::<Quad4, 2>::block([1, 1], endless).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the block reaches from -inf m to inf m along axis 1: both ends must be finite, and the second above the first"
    );
    assert_eq!(
        Mesh::<Quad4, 2>::grid([&[0.0, 1.0], &[0.0, 2.0, f64::NAN]])
            .unwrap_err()
            .to_string(),
        "cut 2 along axis 1 is NaN m, it must be finite and above the one before"
    );
    assert_eq!(cube(2).kept(|_| false).unwrap_err(), MeshError::Empty);
}

/// The cells next to each other and on each other.
#[test]
fn cells_lie_beside_each_other() {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let build = |more: &[[f64; 2]], cells: &[[usize; 4]]| {
        let nodes = [&corners, more].concat();
        Mesh::<Quad4, 2>::new(nodes, cells.to_vec())
    };
    let cells = [0, 1];
    assert_eq!(
        build(&[], &[[0, 1, 2, 3], [1, 2, 3, 0]]).unwrap_err(),
        MeshError::SameNodes { cells }
    );
    let right = [[2.0, 0.0], [2.0, 1.0]];
    assert!(build(&right, &[[0, 1, 2, 3], [1, 4, 5, 2]]).is_ok());
    let twice = [right[0], right[1], [3.0, 0.0], [3.0, 1.0]];
    let three = build(&twice, &[[0, 1, 2, 3], [1, 4, 5, 2], [1, 6, 7, 2]]);
    assert_eq!(
        three.unwrap_err().to_string(),
        "cells 0, 1 and 2 all have a face with the corners [1, 2], which two can have in common"
    );
    let inside = build(&[[0.9, 0.5], [0.1, 0.5]], &[[0, 1, 2, 3], [0, 1, 4, 5]]);
    let nodes = vec![0, 1];
    assert_eq!(inside.unwrap_err(), MeshError::SameSide { cells, nodes });

    let cube = cube(1);
    let build = |shifts: &[f64]| {
        let (mut nodes, mut cells) = (cube.nodes().to_vec(), cube.cells().to_vec());
        for &shift in shifts {
            let last = nodes.len();
            // On the face z = 1 of the cube, which has the nodes 4 to 7.
            nodes.extend(
                cube.nodes()[..4]
                    .iter()
                    .map(|[x, y, _]| [*x, *y, 1.0 + shift]),
            );
            let above = [4, 5, 7, 6];
            let far = [last, last + 1, last + 3, last + 2];
            let [lower, upper] = if shift > 0.0 {
                [above, far]
            } else {
                [far, above]
            };
            cells.push([lower, upper].concat().try_into().unwrap());
        }
        Mesh::<Hex8, 3>::new(nodes, cells)
    };
    assert!(build(&[1.0]).is_ok());
    assert!(matches!(
        build(&[1.0, 2.0]),
        Err(MeshError::CrowdedFace {
            cells: [0, 1, 2],
            ..
        })
    ));
    let nodes = vec![4, 5, 7, 6];
    assert_eq!(
        build(&[-0.5]).unwrap_err(),
        MeshError::SameSide { cells, nodes }
    );
}

/// A cell may be inside out at a corner only, where it has no point.
#[test]
fn cells_are_inside_out_at_no_node() {
    let concave = vec![[0.0, 0.0], [1.0, 0.0], [0.45, 0.45], [0.0, 1.0]];
    let error = Mesh::<Quad4, 2>::new(concave, vec![[0, 1, 2, 3]]).unwrap_err();
    assert!(
        matches!(error, MeshError::InsideOutAtNode { cell: 0, node: 2, value, .. } if value < 0.0),
        "{error}"
    );
    let message = error.to_string();
    assert!(
        message.starts_with("cell 0 is inside out, or flat, at its node 2: det dX/dxi is -0.02"),
        "{message}"
    );
    // The middle of an edge at a part of it: at a quarter, det is zero at the corner.
    let quad = |part: f64| {
        let mut nodes = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        nodes.extend([[part, 0.0], [1.0, 0.5], [0.5, 1.0], [0.0, 0.5]]);
        Mesh::<Quad8, 2>::new(nodes, vec![[0, 1, 2, 3, 4, 5, 6, 7]])
    };
    assert!(quad(0.5).is_ok() && quad(0.26).is_ok() && quad(0.74).is_ok());
    for (part, at) in [(0.25, 0), (0.24, 0), (0.75, 1)] {
        let error = quad(part).unwrap_err();
        assert!(
            matches!(error, MeshError::InsideOutAtNode { node, .. } if node == at),
            "{error}"
        );
    }
}

/// Counts of which no mesh can be made are refused before anything is reserved.
#[test]
fn blocks_that_are_too_large_are_refused_at_once() {
    let ends = [[0.0, 1.0]; 3];
    for cells in [
        [usize::MAX, 1, 1],
        [1 << 32, 1 << 32, 1],
        [1 << 14; 3],
        [usize::MAX; 3],
    ] {
        let error = Mesh::<Hex8, 3>::block(cells, ends).unwrap_err();
        assert!(matches!(error, MeshError::TooMany { .. }), "{error}");
        assert!(Mesh::<Hex20, 3>::block(cells, ends).is_err());
    }
    let error = Mesh::<Hex8, 3>::block([1 << 14; 3], ends).unwrap_err();
    assert_eq!(
        error.to_string(),
        "4398046511104 cells have 4398851866625 nodes, which take 668543874367536 bytes, and no more than 4294967295 \
         nodes can be numbered: use fewer cells"
    );
}

/// Numbers ascend with z, then y, then x: corners, and middles of edges.
#[test]
fn nodes_of_blocks_are_numbered_along_x_then_y_then_z() {
    fn check<H: Shape<D>, const D: usize>(cells: [usize; D], count: usize) {
        let mesh = Mesh::<H, D>::block(cells, [[0.0, 1.0]; D]).unwrap();
        assert_eq!(mesh.nodes().len(), count, "{}", H::NAME);
        let backwards = |place: &[f64; D]| place.iter().rev().copied().collect::<Vec<_>>();
        let places: Vec<_> = mesh.nodes().iter().map(backwards).collect();
        assert!(places.is_sorted_by(|a, b| a < b), "{}", H::NAME);
    }
    check::<Quad4, 2>([3, 4], 20);
    check::<Quad8, 2>([3, 4], 20 + 3 * 5 + 4 * 4);
    check::<Hex8, 3>([3, 4, 2], 60);
    check::<Hex20, 3>([3, 4, 2], 60 + 3 * 15 + 4 * 12 + 2 * 20);
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
        message.starts_with(
            "the density of the solid at element 0 (SaintVenantKirchhoff) is -1 kg/m^3"
        ),
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

#[test]
fn what_is_not_positive_in_a_solid_is_said_and_faces_of_other_meshes_are_refused() {
    let bulk = Bulk::new(10.0);
    let nothing = |_: &mut Scene<3>, _: &Body<Hex8, 3>| {};
    for value in [-1.0, 0.0, f64::NAN] {
        let bulk = bulk.clone().conductivity(value);
        let message = refused(MooneyRivlin::RUBBER, &bulk, nothing).to_string();
        let value = if value.is_nan() {
            "NaN".to_owned()
        } else {
            value.to_string()
        };
        let said = format!("element 0 (MooneyRivlin) is {value} W/(m K), it must be positive");
        assert!(
            message.starts_with("the conductivity of the solid") && message.contains(&said),
            "{message}"
        );
    }
    let conducting = bulk.clone().conductivity(1.0);
    // So negative that the conductance would be positive again.
    for film in [-100.0, 0.0] {
        let message = refused(MooneyRivlin::RUBBER, &conducting, |scene, body| {
            let air = scene.reservoir(300.0);
            let end = body.mesh().face(|[x, ..]| x >= 1.0).unwrap();
            scene.exchange(body, &end, air, film);
        });
        let message = message.to_string();
        assert!(
            message.starts_with("the film coefficient of the solid at element 0"),
            "{message}"
        );
    }
    let larger = cube(2).face(|[x, ..]| x >= 1.0).unwrap();
    for load in [true, false] {
        let message = refused(MooneyRivlin::RUBBER, &conducting, |scene, body| {
            if load {
                scene.traction(body, &larger, |_| [1.0; 3]);
            } else {
                let air = scene.reservoir(300.0);
                scene.wall(body, &larger, air);
            }
        });
        let message = message.to_string();
        assert!(
            message.starts_with("the face is not of the mesh of the solid at element 0"),
            "{message}"
        );
    }
    let plate = |thickness| {
        let mesh = Mesh::<Quad4, 2>::block([1; 2], [[0.0, 1.0]; 2]).unwrap();
        let mut scene = Scene::<2>::new();
        scene.solid(ELASTIC, &mesh, &Bulk::new(10.0).thickness(thickness));
        let run = Simulation::new(scene, Scheme::EemEntropy, 0.1);
        run.unwrap_err().to_string()
    };
    assert!(
        plate(0.0)
            .starts_with("the thickness of the solid at element 0 (SaintVenantKirchhoff) is 0 m")
    );
    assert_eq!(cube(1).face(|[x, ..]| x > 1.0), Err(MeshError::NoFace));
}

/// Faces that are numbered alike are not the same.
#[test]
fn a_face_is_of_the_mesh_that_it_was_taken_from() {
    let mesh = |length| Mesh::<Quad4, 2>::block([2, 2], [[0.0, length]; 2]).unwrap();
    let end = |mesh: &Mesh<Quad4, 2>, x: f64| mesh.face(|place| place[0] >= x).unwrap();
    let pushed = |face: &Face| {
        let mut scene = Scene::<2>::new();
        let body = scene.solid(ELASTIC, &mesh(1.0), &Bulk::new(10.0));
        scene.traction(&body, face, |_| [1.0, 0.0]);
        Simulation::new(scene, Scheme::EemEntropy, 0.1)
    };
    // Of one that is equal, and of its copy.
    assert!(pushed(&end(&mesh(1.0), 1.0)).is_ok());
    assert!(pushed(&end(&mesh(1.0).clone(), 1.0)).is_ok());
    let larger = end(&mesh(7.0), 7.0);
    let moved = mesh(1.0).translated([7.0, 0.0]).unwrap();
    for face in [larger, end(&moved, 8.0)] {
        let error = only_error(pushed(&face));
        assert!(
            matches!(error, SceneError::Solid(SolidError::ForeignFace { .. })),
            "{error}"
        );
    }
}

/// What is wrong with a solid is said once, and not for each of its cells.
#[test]
fn what_is_wrong_with_all_cells_is_said_once() {
    let squares = Mesh::<Quad4, 2>::block([3, 3], [[0.0, 1.0]; 2]).unwrap();
    let refused = |bulk: Bulk<2>| {
        let mut scene = Scene::<2>::new();
        scene.solid(ELASTIC, &squares, &bulk);
        only_error(Simulation::new(scene, Scheme::EemEntropy, 0.1)).to_string()
    };
    assert_eq!(
        refused(Bulk::new(0.0)),
        "the density of the solid at element 0 (SaintVenantKirchhoff) is 0 kg/m^3, it must be positive and finite"
    );
    let message = refused(Bulk::new(1.0).fibre([1.0, 0.0]));
    assert!(
        message.contains("has 0 strains of fibres, and 1 directions"),
        "{message}"
    );
    assert_eq!(
        refused(Bulk::new(1.0).conductivity(2.0)),
        "the solid at element 0 (SaintVenantKirchhoff) has a conductivity, but no temperature: leave `Bulk::conductivity` out, or \
         take a free energy with an argument `Temperature`"
    );
}

/// Lengths that are far from any body's are no other mistake.
#[test]
fn cells_whose_size_is_no_number_are_said_to_be_so() {
    let square = |length: f64| [[0.0, 0.0], [length, 0.0], [length, length], [0.0, length]];
    for (length, said) in [(1e200, "inf"), (1e-170, "0")] {
        let said = format!("cell 0 is too large or too small: det dX/dxi is {said} m^2, outside");
        let nodes = square(length).to_vec();
        let mesh = Mesh::<Quad4, 2>::new(nodes, vec![[0, 1, 2, 3]]);
        let polygon = Mesh::<Quad4, 2>::polygon(&square(length));
        for error in [mesh.unwrap_err(), polygon.unwrap_err()] {
            assert!(error.to_string().starts_with(&said), "{error}");
        }
        let nodes = square(length).to_vec();
        let error = Mesh::<Quad4, 2>::new(nodes, vec![[3, 2, 1, 0]]).unwrap_err();
        assert!(matches!(error, MeshError::InsideOut { .. }), "{error}");
    }
    let all = [-f64::MAX, f64::MAX];
    let ends = Mesh::<Quad4, 2>::block([2, 1], [all, [0.0, 1.0]]).unwrap();
    assert_eq!(ends.cells().len(), 2);
    let mut scene = Scene::<3>::new();
    let body = scene.solid(ELASTIC, &cube(1), &Bulk::new(1.0));
    for within in [f64::NAN, -1.0] {
        let error = body.node_at([0.0; 3], within).unwrap_err().to_string();
        let said =
            format!("a node is looked for within {within} m, which must be zero or positive");
        assert_eq!(error, said);
    }
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
    let refused = |conductivities: [Option<f64>; 2], is_joined: bool, twice: bool| {
        let bulk = |conductivity| match conductivity {
            Some(conductivity) => Bulk::new(10.0).conductivity(conductivity),
            None => Bulk::<3>::new(10.0),
        };
        let mut scene = Scene::<3>::new();
        let first = scene.solid(MooneyRivlin::RUBBER, &cube(1), &bulk(conductivities[0]));
        let beside = cube(1).translated([1.0, 0.0, 0.0]).unwrap();
        let mut joined = bulk(conductivities[1]);
        if is_joined {
            joined = joined.joined_to(&first, 1e-9);
        }
        let second = scene.solid(MooneyRivlin::RUBBER, &beside, &joined);
        for &point in first.points().iter().chain(second.points()) {
            scene.set_temperature(point, 300.0);
        }
        scene.conduct_between(&first, if twice { &first } else { &second });
        let run = Simulation::new(scene, Scheme::EemEntropy, 0.1);
        run.unwrap_err().to_string()
    };
    let both = [Some(1.0); 2];
    let message = refused(both, false, false);
    assert!(
        message.starts_with("the solids at element 0 (MooneyRivlin) and element 8 (MooneyRivlin) share no whole face"),
        "{message}"
    );
    let message = refused([Some(1.0), None], true, false);
    assert!(
        message.starts_with("the solid at element 8 (MooneyRivlin) has no conductivity"),
        "{message}"
    );
    let message = refused(both, true, true);
    assert!(message.contains("itself"), "{message}");
}

/// What joins nothing, or the wrong nodes, is said with the solids and the distances.
#[test]
fn joints_that_cannot_be_are_refused() {
    let squares = |cells| Mesh::<Quad4, 2>::block(cells, [[0.0, 1.0]; 2]).unwrap();
    let refused = |cells: [usize; 2], by: f64, within: f64| {
        let mut scene = Scene::<2>::new();
        let first = scene.solid(ELASTIC, &squares([2, 2]), &Bulk::new(10.0));
        let beside = squares(cells).translated([by, 0.0]).unwrap();
        scene.solid(ELASTIC, &beside, &Bulk::new(10.0).joined_to(&first, within));
        let run = Simulation::new(scene, Scheme::EemEntropy, 0.1);
        run.is_err().then(|| only_error(run).to_string())
    };
    assert_eq!(refused([2, 2], 1.0, 1e-9), None);
    assert_eq!(refused([2, 2], 1.0 + 1e-12, 1e-9), None);
    let solids = "the solid at element 16 (SaintVenantKirchhoff)";
    for within in [f64::NAN, -1.0, f64::INFINITY] {
        let message = refused([2, 2], 1.0, within).unwrap();
        let said = format!(
            "{solids} is joined to that at element 0 (SaintVenantKirchhoff) within {within} m"
        );
        assert!(message.starts_with(&said), "{message}");
    }
    assert_eq!(
        refused([2, 2], 1.75, 0.25).unwrap(),
        "no node of the solid at element 16 (SaintVenantKirchhoff) is within 0.25 m of one of the solid at element 0 \
         (SaintVenantKirchhoff), to which it is joined (`Bulk::joined_to`): the nearest are 0.75 m apart; move its mesh, or join \
         within a larger distance"
    );
    // Nodes of a finer mesh become the same ones.
    let message = refused([2, 4], 1.0, 0.3).unwrap();
    let said =
        format!("{solids} is joined within 0.3 m (`Bulk::joined_to`), and with its nodes where");
    assert!(
        message.starts_with(&said) && message.contains("in the same place: join within a smaller"),
        "{message}"
    );
    let message = refused([2, 2], 0.0, 0.0).unwrap();
    let said = format!(
        "cell 0 of {solids} is joined (`Bulk::joined_to`) to all nodes of the cell at element 0"
    );
    assert!(message.starts_with(&said), "{message}");
    let message = refused([2, 2], 0.5, 1e-9).unwrap();
    assert!(
        message.contains("to all nodes of the cell at element 4"),
        "{message}"
    );
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

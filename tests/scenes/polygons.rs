//! Meshes of polygons, and those extruded from meshes in the plane.

use eem::kinematics::{Hex8, Hex20, Quad4, Quad8};
use eem::{Mesh, MeshError};

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

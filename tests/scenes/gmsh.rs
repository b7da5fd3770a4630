//! Files of Gmsh: meshes come from them as they are, and what is wrong with a file is said.

use std::fmt::Write;

use eem::kinematics::{Hex8, Hex20, Quad4, Quad8, Shape};
use eem::{Mesh, MeshError, Msh, MshError};

/// The nodes of a `Hex20` of Gmsh in its own order: corners, then the middles of its edges 0-1, 0-3, 0-4, 1-2, 1-5, 2-3,
/// 2-6, 3-7, 4-5, 4-7, 5-6, 6-7, as nodes of VTK.
const HEX20: [usize; 20] = [
    0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14,
];

/// A file with a mesh, whose nodes have their tags in an order of their own. Cells left of x = 1 belong to the
/// entity 4, others to 6.
fn written<H: Shape<D>, const D: usize>(mesh: &Mesh<H, D>, kind: u32) -> String {
    let count = mesh.nodes().len();
    // 7 has no divisor in common with the numbers of nodes here.
    let tag = |node: usize| 1 + (7 * node) % count;
    let mut text =
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 0\n$EndEntities\n".to_owned();
    writeln!(text, "$Nodes\n1 {count} 1 {count}\n{D} 4 0 {count}").unwrap();
    for node in 0..count {
        writeln!(text, "{}", tag(node)).unwrap();
    }
    for place in mesh.nodes() {
        let mut all = [0.0; 3];
        all[..D].copy_from_slice(place);
        writeln!(text, "{} {} {}", all[0], all[1], all[2]).unwrap();
    }
    let cells = mesh.cells();
    writeln!(text, "$EndNodes\n$Elements\n2 {0} 1 {0}", cells.len()).unwrap();
    for (entity, left) in [(4, true), (6, false)] {
        let is_of = |cell: &&H::PerNode<usize>| (mesh.nodes()[cell.as_ref()[0]][0] < 1.0) == left;
        let cells: Vec<_> = cells.iter().filter(is_of).collect();
        writeln!(text, "{D} {entity} {kind} {}", cells.len()).unwrap();
        for (at, cell) in cells.iter().enumerate() {
            let nodes = cell.as_ref();
            write!(text, "{}", 10 * entity + at).unwrap();
            for (at, &of_gmsh) in HEX20.iter().enumerate().take(nodes.len()) {
                let from = if kind == 17 { of_gmsh } else { at };
                write!(text, " {}", tag(nodes[from])).unwrap();
            }
            writeln!(text).unwrap();
        }
    }
    text + "$EndElements\n"
}

/// The places of the nodes of each cell, m.
fn places<H: Shape<D>, const D: usize>(mesh: &Mesh<H, D>) -> Vec<Vec<[u64; D]>> {
    let place = |&node: &usize| mesh.nodes()[node].map(f64::to_bits);
    let cell = |cell: &H::PerNode<usize>| cell.as_ref().iter().map(place).collect();
    mesh.cells().iter().map(cell).collect()
}

fn comes_back<H: Shape<D>, const D: usize>(kind: u32) {
    let mut counts = [3; D];
    counts[0] = 2;
    let mesh = Mesh::<H, D>::block(counts, [[0.0, 2.0]; D]).unwrap();
    // No line of nodes is straight.
    let bent = |place: [f64; D]| {
        let mut to = place;
        to[1] += 0.1 * place[0] * place[0] / 3.0;
        to
    };
    let mesh = mesh.mapped(bent).unwrap();
    let file = Msh::parse(&written(&mesh, kind)).unwrap();
    let read = file.mesh::<H, D>().unwrap();
    let mut known = places(&mesh);
    // In the file the left cells come first.
    known.sort_by_key(|cell| f64::from_bits(cell[0][0]) >= 1.0);
    assert_eq!(places(&read), known, "{}", H::NAME);
    let half = file.mesh_of::<H, D>(&[6]).unwrap();
    assert_eq!(2 * half.cells().len(), mesh.cells().len());
    assert!(half.nodes().iter().all(|place| place[0] >= 1.0));
}

#[test]
fn meshes_come_from_files_as_they_are() {
    comes_back::<Quad4, 2>(3);
    comes_back::<Quad8, 2>(16);
    comes_back::<Hex8, 3>(5);
    comes_back::<Hex20, 3>(17);
}

#[test]
fn what_is_wrong_with_a_file_is_said() {
    let square = Mesh::<Quad4, 2>::block([2, 1], [[0.0, 2.0], [0.0, 1.0]]).unwrap();
    let good = written(&square, 3);
    let error = |from: &str, to: &str| {
        assert!(good.contains(from), "{from} in {good}");
        let read = Msh::parse(&good.replacen(from, to, 1));
        read.and_then(|file| file.mesh::<Quad4, 2>()).unwrap_err()
    };
    let said = |from: &str, to: &str| error(from, to).to_string();
    assert!(said("4.1 0 8", "4.1 1 8").starts_with("the mesh has the format `4.1 1 8`"));
    assert!(said("4.1 0 8", "2.2 0 8").starts_with("the mesh has the format `2.2 0 8`"));
    assert_eq!(said("$Nodes", "$Knots"), "the mesh has no section `$Nodes`");
    assert!(said("0 1 0\n", "0 one 0\n").contains("in `$Nodes`, is `0 one 0`"));
    assert!(said("0 1 0\n", "").contains("in `$Nodes`, is `$EndNodes`"));
    assert!(said("40 1 2 5 4", "40 1 2 5").contains("in `$Elements`, is `40 1 2 5`"));
    assert_eq!(
        said("60 2 3 6 5", "60 2 3 6 9"),
        "element 60 has node 9, which is not in the mesh"
    );
    assert!(said("2 4 3 1", "2 4 2 1").starts_with("entity 4 has triangles, and Quad4 is asked"));
    assert!(matches!(
        error("40 1 2 5 4", "40 1 4 5 2"),
        MshError::Element {
            element: 40,
            error: MeshError::InsideOut { .. }
        }
    ));
    assert!(matches!(
        error("0 1 0\n", "0 1 0.5\n"),
        MshError::Plane { .. }
    ));
    assert!(matches!(
        error("\n1 1 0\n", "\n1 0 0\n"),
        MshError::Duplicate { .. }
    ));
    let orphan = good.replacen("1 6 1 6\n2 4 0 6\n", "1 7 1 7\n2 4 0 7\n8\n", 1);
    let orphan = orphan.replacen("0 0 0\n1 0 0", "9 9 0\n0 0 0\n1 0 0", 1);
    let file = Msh::parse(&orphan).unwrap();
    assert_eq!(
        file.mesh::<Quad4, 2>().unwrap_err(),
        MshError::Orphan { node: 8 }
    );
    // Entities that do not need it can be taken.
    assert!(file.mesh_of::<Quad4, 2>(&[4, 6]).is_ok());
    assert_eq!(
        file.mesh_of::<Quad4, 2>(&[5]).unwrap_err().to_string(),
        "there are no Quad4 elements of entity 5"
    );
    let mesh = file.mesh_of::<Quad4, 2>(&[4]).unwrap();
    assert_eq!(file.face(&mesh, 3), Err(MshError::NoFace { entity: 3 }));
    assert!(file.mesh::<Hex8, 3>().is_err());
}

//! Files of Gmsh: meshes come from them as they are, and what is wrong with a file is said.

use std::fmt::Write;

use eem::kinematics::{Hex8, Hex20, Quad4, Quad8, Shape};
use eem::{LineFault, Mesh, MeshError, Msh, MshError};

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
    let last = 60 + cells.len() / 2 - 1;
    writeln!(text, "$EndNodes\n$Elements\n2 {} 40 {last}", cells.len()).unwrap();
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
    let other = Msh::parse(&good.replace("Nodes", "Knots")).unwrap_err();
    assert_eq!(other.to_string(), "the mesh has no section `$Nodes`");
    assert!(said("0 1 0\n", "0 one 0\n").contains("in `$Nodes`, is `0 one 0`"));
    assert!(said("0 1 0\n", "").contains("in `$Nodes`, is `$EndNodes`"));
    assert!(said("40 1 2 5 4", "40 1 2 5").contains("in `$Elements`, is `40 1 2 5`"));
    assert_eq!(
        said("60 2 3 6 5", "60 2 3 6 9"),
        "element 60 has node 9, which is not in the mesh"
    );
    let quad = "2 2 40 60\n2 4 3 1\n40 1 2 5 4";
    let triangles = "2 3 40 60\n2 4 2 2\n40 1 2 5\n41 1 5 4";
    assert!(said(quad, triangles).starts_with("entity 4 has triangles, and Quad4 is asked"));
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
    let orphan = good.replacen("1 6 1 6\n2 4 0 6\n", "1 7 1 8\n2 4 0 7\n8\n", 1);
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

/// A file with a line and two squares in entities of their own.
const FILE: &str = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n\
    $Nodes\n2 6 1 6\n2 7 0 4\n1\n2\n4\n5\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 8 0 2\n3\n6\n2 0 0\n2 1 0\n$EndNodes\n\
    $Elements\n3 3 1 3\n1 5 1 1\n1 3 6\n2 7 3 1\n2 1 2 5 4\n2 8 3 1\n3 2 3 6 5\n$EndElements\n";

fn changed(from: &str, to: &str) -> Result<Msh, MshError> {
    assert!(FILE.contains(from), "{from}");
    Msh::parse(&FILE.replacen(from, to, 1))
}

/// The number of the line that is wrong, with what is wrong with it.
fn fault(from: &str, to: &str) -> (usize, LineFault) {
    match changed(from, to) {
        Err(MshError::Line { line, fault, .. }) => (line, fault),
        other => panic!("{from} → {to}: {other:?}"),
    }
}

/// A file in which a count, a dimension or a tag is wrong has another mesh than it says.
#[test]
fn sections_hold_what_they_say_of_themselves() {
    let totals = |count, least, largest| LineFault::Totals {
        count,
        range: [least, largest],
    };
    assert_eq!(fault("2 6 1 6", "2 60 1 6"), (5, totals(6, 1, 6)));
    assert_eq!(fault("2 6 1 6", "2 6 5 2"), (5, totals(6, 1, 6)));
    assert_eq!(fault("3 3 1 3", "3 30 1 3"), (22, totals(3, 1, 3)));
    assert_eq!(fault("3 3 1 3", "3 3 1 4"), (22, totals(3, 1, 3)));
    // Fewer or more blocks or lines than there are.
    let ended = LineFault::NotTheEnd;
    assert_eq!(fault("2 6 1 6", "1 6 1 6"), (15, ended.clone()));
    assert_eq!(fault("3 3 1 3", "2 3 1 3"), (27, ended.clone()));
    assert_eq!(fault("3 3 1 3", "4 3 1 3"), (29, LineFault::Numbers));
    assert_eq!(fault("2 7 3 1", "2 7 3 2"), (27, LineFault::Numbers));
    assert_eq!(fault("2 8 0 2", "2 8 0 999999999999").1, LineFault::Numbers);
    assert_eq!(fault("2 8 0 2", "2 8 0 -2"), (15, LineFault::Numbers));
    assert_eq!(fault("$EndNodes", "7 7 7\n$EndNodes"), (20, ended.clone()));
    assert_eq!(
        fault("$EndElements", "rubbish\n$EndElements"),
        (29, ended.clone())
    );
    assert_eq!(fault("4.1 0 8\n", "4.1 0 8\n8\n"), (3, ended));
    // Tags twice.
    let repeated = |tag, first| LineFault::Repeated { tag, first };
    assert_eq!(fault("3 2 3 6 5", "2 2 3 6 5"), (28, repeated(2, 26)));
    assert_eq!(fault("3\n6\n2 0", "3\n5\n2 0"), (17, repeated(5, 10)));
    // Dimensions, and coordinates within an entity.
    let dimension = |found| LineFault::Dimension {
        found,
        elements: "Quad4",
        needed: 2,
    };
    assert_eq!(fault("2 7 3 1", "3 7 3 1"), (25, dimension(3)));
    assert_eq!(fault("2 7 3 1", "0 7 3 1"), (25, dimension(0)));
    let found = 9;
    let none = LineFault::EntityDimension { found };
    assert_eq!(fault("2 8 0 2", "9 8 0 2"), (15, none));
    let parametric = LineFault::Parametric { found: 2 };
    assert_eq!(fault("2 8 0 2", "2 8 2 2"), (15, parametric));
    assert_eq!(fault("2 8 0 2", "2 8 1 2"), (18, LineFault::Numbers));
    assert_eq!(fault("2 1 0\n", "2 1 0 0 0\n"), (19, LineFault::Numbers));
    let message = changed("2 7 3 1", "3 7 3 1").unwrap_err().to_string();
    assert_eq!(
        message,
        "line 25 of the mesh, in `$Elements`, is `3 7 3 1`: the entity has the dimension 3, and its Quad4 have the \
         dimension 2"
    );
}

/// What is wrong between elements names them by their tags.
#[test]
fn an_element_is_in_a_file_once() {
    let twice = "3 4 1 4\n1 5 1 1\n1 3 6\n2 7 3 1\n2 1 2 5 4\n2 8 3 2\n4 5 2 3 6\n3 2 3 6 5\n$";
    let once = "3 3 1 3\n1 5 1 1\n1 3 6\n2 7 3 1\n2 1 2 5 4\n2 8 3 1\n3 2 3 6 5\n$";
    let file = changed(once, twice).unwrap();
    let error = file.mesh::<Quad4, 2>().unwrap_err();
    assert_eq!(
        error.to_string(),
        "elements [4, 3] of the file: cells 1 and 2 have the same nodes: leave one of them"
    );
    assert!(file.mesh_of::<Quad4, 2>(&[7]).is_ok());
}

#[test]
fn sections_begin_and_end_and_are_there_once() {
    let said = |from, to| changed(from, to).unwrap_err().to_string();
    assert_eq!(
        said("$EndElements\n", ""),
        "the section `$Elements` of the mesh, which begins in line 21, has no `$EndElements`"
    );
    assert!(said("$EndNodes\n", "").contains("is `$Elements`: the section has to end here"));
    assert_eq!(
        said("$EndNodes\n", "$EndNodes\n2 7 0 4\n"),
        "line 21 of the mesh is `2 7 0 4`, outside of all sections, where only heads like `$Nodes` are"
    );
    let second = "$Nodes\n1 1 1 1\n2 7 0 1\n1\n9 9 9\n$EndNodes\n$Elements";
    assert!(said("$Elements", second).starts_with(
        "line 21 of the mesh begins a second section `$Nodes`, the first begins in line 4"
    ));
    assert!(said("4.1 0 8", "4.1 0 4").starts_with("the mesh has the format `4.1 0 4`"));
    let unended = changed("$Nodes", "$Comment\n$Nodes").unwrap_err();
    let section = "Comment".to_owned();
    assert_eq!(unended, MshError::Unended { section, line: 4 });
}

/// What says nothing of the mesh changes nothing.
#[test]
fn comments_marks_of_the_order_of_bytes_and_coordinates_within_entities_are_passed_over() {
    let known = Msh::parse(FILE).unwrap().mesh::<Quad4, 2>().unwrap();
    let comment = "$Comment\n$Nodes\nhello\n$EndComment\n$Nodes";
    let inside = "2 8 1 2\n3\n6\n2 0 0 0.5 0.25\n2 1 0 0.5 0.75\n";
    for (from, to) in [
        ("$MeshFormat", "\u{feff}$MeshFormat"),
        ("$Nodes", comment),
        ("2 8 0 2\n3\n6\n2 0 0\n2 1 0\n", inside),
        ("\n$EndNodes", "\n\n$EndNodes"),
    ] {
        let mesh = changed(from, to).unwrap().mesh::<Quad4, 2>().unwrap();
        assert_eq!(places(&mesh), places(&known), "{to}");
    }
}

//! Cook's membrane: how deformation converges with the mesh, for quadrilaterals of four and of eight nodes.
//!
//! A tapered panel is clamped on its left side and sheared on its right one, in plane strain. It bends, and thin
//! or skew cells of four nodes are too stiff for that; those of eight nodes are not.
//!
//! ```text
//! Div(F ∂ψ/∂E) = 0,   F = Grad q,   E = ½ (FᵀF − 1),   ψ = ½ λ (tr E)² + μ E:E
//! q = X on the left side,   (F ∂ψ/∂E) n = (0, 100 N/(16 m · 1 m)) on the right side, 0 elsewhere
//! λ = E₀ ν/((1 + ν)(1 − 2 ν)),   μ = E₀/(2 + 2 ν)
//! ```
//!
//! | symbol | meaning | value |
//! |---|---|---|
//! | – | corners | (0, 0), (48, 44), (48, 60), (0, 44) m |
//! | – | thickness | 1 m |
//! | E₀, ν | modulus of elasticity, Poisson's ratio | 240.565 Pa, 0.3 |
//! | – | dead shear on the right side, upwards | 100 N in all |
//!
//! The material is that of Saint-Venant and Kirchhoff. The state at rest is that of `Scene::equilibrium`.
//!
//! Source: R. D. Cook, J. Struct. Div. ASCE 100 (1974), 1851–1863, there linear; the finite strains are ours. Nothing
//! moves here: of the options of the other examples there is `--out` only.
//!
//! A CSV file has nodes per cell, cells per side, nodes, and the displacement (m) of the corner (48, 60).
//!
//! What the example claims, and fails without: the displacements that another program found, to 1e-8 m; they grow
//! with the number of cells, as conforming cells are too stiff; and 2 × 2 cells of eight nodes are closer to the finest
//! than 4 × 4 of four.

use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

use eem::kinematics::{Quad4, Quad8};

mod membrane;

use eem_studies::claims::{self, Claims};
use eem_studies::comparison::look_beside_schemes;
use eem_studies::deformed::{Picture, View};
use eem_studies::figures::{Axes, Curve, Figure};
use eem_studies::{command_line, output, table, terminal};
use membrane::{Membrane, Row};

const ABOUT: &str = "Cook's membrane: convergence with the mesh";
const HINT: &str = "Add --out DIR for a CSV file and pictures.";

/// Of the displacements that are known, m.
const ACCURACY: f64 = 1e-8;

/// Nodes per cell, cells per side, and the displacement of the corner (48, 60), m, from another program.
const KNOWN: [(usize, usize, [f64; 2]); 7] = [
    (4, 2, [-2.661_325_82, 4.233_042_48]),
    (4, 4, [-4.809_000_13, 6.081_161_39]),
    (4, 8, [-6.111_653_79, 7.028_542_94]),
    (4, 16, [-6.635_132_42, 7.363_962_43]),
    (8, 2, [-6.282_715_04, 7.014_618_97]),
    (8, 4, [-6.706_020_44, 7.377_488_71]),
    (8, 8, [-6.843_605_94, 7.472_309_24]),
];

/// Columns of the CSV file.
const COLUMNS: [&str; 5] = [
    "nodes_per_cell",
    "cells_per_side",
    "nodes",
    "corner_x (m)",
    "corner_y (m)",
];

/// What the example understands.
#[derive(Clone, Debug, clap::Parser)]
struct Options {
    /// Directory for a CSV file and pictures; created when missing.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

fn main() -> ExitCode {
    claims::verdict(run(&command_line::read(ABOUT)))
}

fn run(options: &Options) -> Result<Claims, Box<dyn Error>> {
    let directory = options.out.as_deref();
    directory.map_or(Ok(()), output::prepare)?;
    let (mut rows, mut states) = (Vec::new(), Vec::new());
    for (nodes_per_cell, cells, _) in KNOWN {
        let (row, state) = match nodes_per_cell {
            4 => Membrane::<Quad4>::loaded(cells)?.seen()?,
            _ => Membrane::<Quad8>::loaded(cells)?.seen()?,
        };
        rows.push(row);
        if cells == 2 || cells == 8 {
            states.push(state);
        }
    }
    print(&rows);
    match directory {
        Some(directory) => {
            let numbers: Vec<_> = rows.iter().map(Row::numbers).collect();
            output::write_numbers(directory, "corner", &COLUMNS, &numbers)?;
            let picture = Picture {
                title: "Cook's membrane: its shape, and the mean stress of each cell".to_owned(),
                quantity: "von Mises's stress (Pa)".to_owned(),
                view: View::Along(2),
                states,
            };
            picture.write_svg(&directory.join("membrane.svg"))?;
            convergence(&rows).write_svg(&directory.join("convergence.svg"))?;
            terminal::say(format_args!("Table and pictures: {}", directory.display()));
        }
        None => terminal::say(HINT),
    }
    Ok(check(&rows))
}

/// The displacement of the corner over the number of nodes, a curve for each kind of cell.
fn convergence(rows: &[Row]) -> Figure {
    let curve = |(index, nodes_per_cell): (usize, usize)| {
        let rows = rows.iter().map(|row| (row.nodes_per_cell, row.numbers()));
        let rows = rows.filter(|(own, _)| *own == nodes_per_cell);
        Curve {
            label: format!("cells of {nodes_per_cell} nodes"),
            points: rows.map(|(_, numbers)| (numbers[2], numbers[4])).collect(),
            look: look_beside_schemes(index),
            trusted: true,
            decisive: usize::MAX,
        }
    };
    Figure {
        title: "Cook's membrane: convergence with the mesh".to_owned(),
        x_label: "nodes of the mesh".to_owned(),
        y_label: "upward displacement of the corner (m)".to_owned(),
        curves: [4, 8].into_iter().enumerate().map(curve).collect(),
        axes: Axes::LogarithmicAcross,
    }
}

/// A row per mesh.
fn print(rows: &[Row]) {
    let mut table = table::headed([
        "cells",
        "nodes per cell",
        "nodes",
        "u of the corner (m)",
        "v of the corner (m)",
        "v, of the finest",
    ]);
    let finest = rows.last().map_or(f64::NAN, |row| row.corner[1]);
    for row in rows {
        let [u, v] = row.corner;
        table.add_row([
            format!("{0} × {0}", row.cells),
            row.nodes_per_cell.to_string(),
            row.nodes.to_string(),
            format!("{u:.8}"),
            format!("{v:.8}"),
            format!("{:.1} %", 100.0 * v / finest),
        ]);
    }
    terminal::say(format_args!("{table}\n"));
}

fn check(rows: &[Row]) -> Claims {
    let mut claims = Claims::default();
    for (row, (nodes_per_cell, cells, known)) in rows.iter().zip(KNOWN) {
        for (axis, known) in known.into_iter().enumerate() {
            let what = format!(
                "{cells} × {cells} cells of {nodes_per_cell} nodes: the error along axis {axis}"
            );
            let error = (row.corner[axis] - known).abs();
            claims.at_most(&what, Some(error), ACCURACY);
        }
    }
    for pair in rows.windows(2) {
        if pair[0].nodes_per_cell == pair[1].nodes_per_cell {
            let grows = pair[0].corner[1] < pair[1].corner[1];
            claims.holds(grows, "the membrane is no softer with more cells");
        }
    }
    let finest = rows.last().map_or(f64::NAN, |row| row.corner[1]);
    let error = |at: usize| {
        rows.get(at)
            .map_or(f64::NAN, |row| (row.corner[1] - finest).abs())
    };
    claims.holds(
        error(4) < error(1),
        "2 × 2 cells of eight nodes are no better than 4 × 4 of four",
    );
    claims
}

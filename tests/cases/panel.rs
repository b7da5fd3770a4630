//! The lowest frequency of a clamped panel, by inverse iteration.

use eem::kinematics::{Hex8, Hex20, Shape};
use eem::prelude::*;

use crate::support::solids::SaintVenant;
use eem_testkit::length::at_length;

const SIZE: [[f64; 2]; 3] = [[0.0, 4.0], [0.0, 1.0], [0.0, 0.1]];
const MODULUS: f64 = 5000.0;
const RATIO: f64 = 0.3;
const DENSITY: f64 = 10.0;

/// So small, m, all nodes together, that the square of its share of the thickness is below the printed digits.
const AMPLITUDE: f64 = 1e-3;

/// So long, s, that inertia is nothing.
const LONG: f64 = 1e6;

/// The panel, one end of which is clamped.
fn panel<H: Shape<3>>(scene: &mut Scene<3>, cells: [usize; 3]) -> Body<H, 3> {
    let mesh = Mesh::<H, 3>::block(cells, SIZE).unwrap();
    let material = SaintVenant {
        lame: MODULUS * RATIO / ((1.0 + RATIO) * (1.0 - 2.0 * RATIO)),
        shear: MODULUS / (2.0 * (1.0 + RATIO)),
    };
    let body = scene.solid(material, &mesh, &Bulk::new(DENSITY));
    for node in body.nodes_where(|[x, ..]| x <= 0.0) {
        scene.fix(node);
    }
    body
}

/// `M u` of every node: its momentum at the velocity u.
fn inertia<H: Shape<3>>(cells: [usize; 3], shape: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let mut scene = Scene::<3>::new();
    let body = panel::<H>(&mut scene, cells);
    for ((&node, [x, ..]), &u) in body.nodes().iter().zip(body.mesh().nodes()).zip(shape) {
        if *x > 0.0 {
            scene.set_velocity(node, u);
        }
    }
    let run = Simulation::new(scene, Scheme::EemEntropy, 1.0).unwrap();
    let momentum = |&node| run.momentum(node).unwrap().into();
    body.nodes().iter().map(momentum).collect()
}

/// `K⁻¹ f`: a long step from rest goes twice as far, as its mean is in balance.
fn deflection<H: Shape<3>>(cells: [usize; 3], forces: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let mut scene = Scene::<3>::new();
    let body = panel::<H>(&mut scene, cells);
    for ((&node, [x, ..]), &force) in body.nodes().iter().zip(body.mesh().nodes()).zip(forces) {
        if *x > 0.0 {
            scene.dead_load(node, force);
        }
    }
    let mut run = Simulation::new(scene, Scheme::EemEntropy, LONG).unwrap();
    run.step().unwrap();
    let moved = |(&node, place): (&Node, &[f64; 3])| {
        let position = run.position(node).unwrap();
        std::array::from_fn(|axis| 0.5 * (position[axis] - place[axis]))
    };
    body.nodes()
        .iter()
        .zip(body.mesh().nodes())
        .map(moved)
        .collect()
}

fn product(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let pairs = a.as_flattened().iter().zip(b.as_flattened());
    pairs.map(|(a, b)| a * b).sum()
}

/// `ω² = (u·K u)/(u·M u)` of the shape to which inverse iteration leads, as Hz.
fn frequency<H: Shape<3>>(cells: [usize; 3]) -> f64 {
    let mesh = Mesh::<H, 3>::block(cells, SIZE).unwrap();
    let mut shape: Vec<_> = mesh
        .nodes()
        .iter()
        .map(|[x, ..]| [0.0, 0.0, x * x])
        .collect();
    let mut squared = 0.0;
    for _ in 0..4 {
        let size = product(&shape, &shape).sqrt();
        for u in shape.as_flattened_mut() {
            *u *= AMPLITUDE / size;
        }
        let forces = inertia::<H>(cells, &shape);
        // Forces that deflect it by about as much.
        let guess = (std::f64::consts::TAU * 0.025).powi(2);
        let scaled: Vec<_> = forces.iter().map(|f| f.map(|f| guess * f)).collect();
        shape = deflection::<H>(cells, &scaled);
        squared = product(&shape, &scaled) / product(&shape, &inertia::<H>(cells, &shape));
    }
    squared.sqrt() / std::f64::consts::TAU
}

#[test]
fn a_clamped_panel_has_its_frequency() {
    type Frequency = fn([usize; 3]) -> f64;
    let all: [(Frequency, _, _); 5] = [
        (frequency::<Hex8>, [8, 2, 2], 0.07404),
        (frequency::<Hex20>, [4, 1, 1], 0.02397),
        (frequency::<Hex8>, [16, 2, 2], 0.04260),
        (frequency::<Hex8>, [32, 2, 2], 0.02990),
        (frequency::<Hex20>, [8, 2, 1], 0.02330),
    ];
    for &(frequency, cells, known) in at_length(&all[..], &all[..2]) {
        let found = frequency(cells);
        println!("{found:.7} Hz, {known}");
        // Five digits are printed.
        assert!((found - known).abs() <= 5e-6, "{found} Hz, {known}");
    }
}

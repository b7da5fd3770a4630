//! The explicit scheme keeps momenta of bodies of any shape in any dimension: pairs, lines, bodies that are nearly
//! lines, more planes than three.

use eem::prelude::*;

use crate::support::{Hencky, LogarithmicStiffness, hencky};

const SPRING: Hencky = hencky(60.0, 1.0);

/// Roundings of `Σ |q||p|` that a step may change an angular momentum by.
const ROUNDINGS: f64 = 64.0;

/// A sum to twice the precision.
#[derive(Clone, Copy, Default)]
struct Exact(f64, f64);

impl Exact {
    fn add_product(&mut self, a: f64, b: f64) {
        let product = a * b;
        let sum = self.0 + product;
        let back = sum - self.0;
        let lost = (self.0 - (sum - back)) + (product - back);
        self.1 += lost + a.mul_add(b, -product);
        self.0 = sum;
    }
}

/// `q ∧ p` of all nodes in every plane, and `Σ |q||p|`.
fn angular<const D: usize>(run: &Simulation<D>, nodes: &[Node]) -> (Vec<Exact>, f64) {
    let mut planes = vec![Exact::default(); D * D.saturating_sub(1) / 2];
    let mut terms = 0.0;
    for &node in nodes {
        let (q, p) = (run.position(node).unwrap(), run.momentum(node).unwrap());
        terms += q.norm() * p.norm();
        let pairs = (0..D).flat_map(|i| (i + 1..D).map(move |j| (i, j)));
        for (plane, (i, j)) in planes.iter_mut().zip(pairs) {
            plane.add_product(q[i], p[j]);
            plane.add_product(-q[j], p[i]);
        }
    }
    (planes, terms)
}

/// Steps, none of which may be refused; each has to keep the angular momentum in all planes.
fn keeps_momenta<const D: usize>(name: &str, mut run: Simulation<D>, nodes: &[Node], steps: usize) {
    let (mut old, _) = angular(&run, nodes);
    for step in 0..steps {
        run.step().unwrap_or_else(|error| panic!("{name}: {error}"));
        let (new, terms) = angular(&run, nodes);
        for (old, new) in old.iter().zip(&new) {
            let off = ((new.0 - old.0) + (new.1 - old.1)).abs();
            let roundings = off / (f64::EPSILON * terms);
            assert!(
                roundings <= ROUNDINGS,
                "{name}: step {step} is off by {roundings:.1} ε"
            );
        }
        old = new;
    }
}

/// Masses that are all joined, or in a row.
fn body<const D: usize>(
    positions: &[[f64; D]],
    velocities: &[[f64; D]],
    is_row: bool,
) -> (Scene<D>, Vec<Node>) {
    let mut scene = Scene::new();
    let nodes: Vec<Node> = (1..)
        .zip(positions.iter().zip(velocities))
        .map(|(mass, (&q, &v))| scene.mass(f64::from(2 * mass - 1), q, v))
        .collect();
    for (i, &a) in nodes.iter().enumerate() {
        for &b in nodes
            .iter()
            .skip(i + 1)
            .take(if is_row { 1 } else { nodes.len() })
        {
            scene.spring(SPRING, [a, b]);
        }
    }
    (scene, nodes)
}

fn pair() -> (Scene<3>, Vec<Node>) {
    body(
        &[[0.1, 0.2, 0.3], [1.1, 0.5, -0.2]],
        &[[0.5, -1.0, 0.2], [-0.5, 2.0, 1.0]],
        false,
    )
}

#[test]
fn of_a_free_pair_in_space() {
    for tolerance in [1e-3, 1e-6] {
        let (scene, nodes) = pair();
        let mut run = Simulation::new(scene, Scheme::Auto, 0.05).unwrap();
        run.control_steps(Tolerance::new(tolerance)).unwrap();
        keeps_momenta("controlled", run, &nodes, 300);
    }
    let (scene, nodes) = pair();
    let run = Simulation::new(scene, Scheme::EemExplicit, 0.1).unwrap();
    keeps_momenta("fixed", run, &nodes, 300);
}

/// Some numbers of size one.
fn numbers<const D: usize>(count: usize, shift: f64) -> Vec<[f64; D]> {
    let mut phase = shift;
    let mut next = move || {
        phase += 2.39;
        phase.sin()
    };
    (0..count)
        .map(|_| core::array::from_fn(|_| next()))
        .collect()
}

fn keeps_momenta_in<const D: usize>(count: usize, is_free: bool) {
    let (mut scene, nodes) = body(&numbers::<D>(count, 0.3), &numbers::<D>(count, 1.7), false);
    if !is_free {
        let anchor = scene.anchor([0.0; D]);
        scene.spring(SPRING, [anchor, nodes[0]]);
    }
    let run = Simulation::new(scene, Scheme::EemExplicit, 0.02).unwrap();
    keeps_momenta(
        &format!("{count} masses, free: {is_free}, D = {D}"),
        run,
        &nodes,
        60,
    );
}

#[test]
fn of_few_masses_in_two_to_four_dimensions() {
    for count in [2, 3, 4] {
        keeps_momenta_in::<2>(count, true);
        keeps_momenta_in::<3>(count, true);
        keeps_momenta_in::<4>(count, true);
    }
    for count in [1, 2] {
        keeps_momenta_in::<3>(count, false);
        keeps_momenta_in::<4>(count, false);
    }
}

/// Masses in a line, or beside it by some length.
fn keeps_momenta_of_rows<const D: usize>(off: f64) {
    for count in [3, 4, 5] {
        let places: Vec<[f64; D]> = numbers::<D>(count, 0.9)
            .into_iter()
            .zip(0_u8..)
            .map(|(beside, at)| {
                let along = f64::from(at);
                core::array::from_fn(|axis| {
                    along * [1.0, 0.3, -0.2, 0.1][axis] + off * beside[axis]
                })
            })
            .collect();
        let (scene, nodes) = body(&places, &numbers::<D>(count, 2.1), true);
        let run = Simulation::new(scene, Scheme::EemExplicit, 0.02).unwrap();
        let name = format!("{count} in line to {off:e}, D = {D}");
        keeps_momenta(&name, run, &nodes, 100);
    }
}

#[test]
fn of_rows_that_are_lines_or_nearly_so() {
    for off in [0.0, 1e-12, 1e-10, 1e-9, 1e-6, 1e-3] {
        keeps_momenta_of_rows::<3>(off);
        keeps_momenta_of_rows::<4>(off);
    }
}

/// Positions are rounded to ε of their coordinates, which is more than the energy of a pair is known to.
#[test]
fn of_a_pair_far_from_the_origin_and_no_step_is_refused() {
    for far in [1e2, 1e4, 1e6] {
        let (scene, nodes) = body(
            &[[far, far, 0.0], [far + 1.0, far + 0.3, -0.2]],
            &[[0.0, 0.0, 0.0], [0.1, 0.9, -0.9]],
            false,
        );
        let run = Simulation::new(scene, Scheme::EemExplicit, 0.02).unwrap();
        keeps_momenta(&format!("pair at {far:e} m"), run, &nodes, 300);
    }
}

/// Where there is a single path of heat, it has produced all entropy, also what the closing has added or taken; but where
/// nothing else could take the energy of a step, that is entropy of no path.
#[test]
fn the_least_production_is_that_of_the_closed_step() {
    let mut scene = Scene::<3>::new();
    let anchor = scene.anchor([0.0; 3]);
    let nodes = [
        scene.mass(1.0, [1.1, 0.0, 0.2], [0.0, 3.0, 1.0]),
        scene.mass(2.0, [2.0, 0.4, 0.0], [1.0, -4.0, 2.0]),
    ];
    let springs =
        [[anchor, nodes[0]], nodes].map(|ends| scene.spring(LogarithmicStiffness::FIRST, ends));
    scene.set_temperature(springs[0], 310.0);
    scene.set_temperature(springs[1], 300.0);
    scene.conduct(springs[0], springs[1], 5.0);
    let mut run = Simulation::new(scene, Scheme::EemExplicit, 0.05).unwrap();
    let (mut has_changed, mut all, mut steps) = (false, 0, 0);
    for _ in 0..200 {
        let Ok(report) = run.step() else { continue };
        let more = report.production - report.least_production;
        let rounding = 8.0 * f64::EPSILON * report.production;
        assert!(more >= -rounding, "{report:?}");
        all += usize::from(more <= rounding);
        steps += 1;
        has_changed |= report.correction.abs() > 1e-12;
    }
    assert!(has_changed && 10 * all >= 9 * steps, "{all} of {steps}");
}

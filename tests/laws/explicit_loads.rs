//! Constant loads with the explicit scheme: like weights they have a potential, so that the energy with it keeps to rounding over
//! any number of steps, however large the tolerance.

use eem::Tolerance;
use eem::materials::Hooke;
use eem::prelude::*;

use crate::support::hooke;

const SCHEME: Scheme = Scheme::EemExplicit;

/// Errors per step are as large as step control allows in practice.
const COARSE: f64 = 1e-2;

/// Roundings of the terms of an energy: 8 that the closing leaves at most, and as many of this test, which squares and sums up. What
/// a step leaves at a turning point may be no debt of later ones, so that the energy does a random walk: √N of them in N steps.
const ROUNDINGS: f64 = 16.0;

const SPRING: Hooke = hooke(100.0, 1.0);

/// A mass and the constant force on it.
#[derive(Clone, Copy)]
struct Loaded<const D: usize> {
    node: Node,
    mass: f64,
    load: [f64; D],
}

/// A scene with all that its energy depends on.
struct Body<const D: usize> {
    run: Simulation<D>,
    gravity: [f64; D],
    masses: Vec<Loaded<D>>,
    springs: Vec<[Node; 2]>,
}

/// The first components of vectors in space.
fn part<const D: usize>(of: [f64; 3]) -> [f64; D] {
    core::array::from_fn(|axis| of[axis])
}

/// Two masses in a row on springs, the first one at a hook if there is one, with loads on both and weights.
fn body<const D: usize>(is_held: bool, gravity: [f64; 3]) -> (Scene<D>, Body<D>) {
    let mut scene = Scene::<D>::new();
    let gravity = part(gravity);
    scene.set_gravity(gravity);
    let places = [[1.1, 0.2, -0.1], [2.2, -0.1, 0.3]];
    let loads = [[1.5, -2.0, 0.5], [0.7, 0.4, -0.9]];
    let momenta = [[0.2, 0.4, 0.1], [-0.1, 0.3, 0.6]];
    let mut masses = Vec::new();
    for (at, mass) in [1.0, 2.5].into_iter().enumerate() {
        let node = scene.mass(mass, part(places[at]), part(momenta[at]));
        let load = part(loads[at]);
        // In two parts, which add up exactly.
        scene.dead_load(node, load.map(|force| 0.25 * force));
        scene.dead_load(node, load.map(|force| 0.75 * force));
        masses.push(Loaded { node, mass, load });
    }
    let mut springs = vec![[masses[0].node, masses[1].node]];
    if is_held {
        springs.push([scene.anchor(part([0.1, 0.0, 0.05])), masses[0].node]);
    }
    for &ends in &springs {
        scene.spring(SPRING, ends);
    }
    let run = Simulation::new(Scene::new(), SCHEME, 1.0).unwrap();
    let body = Body {
        run,
        gravity,
        masses,
        springs,
    };
    (scene, body)
}

impl<const D: usize> Body<D> {
    fn start(mut self, scene: Scene<D>) -> Self {
        self.run = Simulation::with_tolerance(scene, SCHEME, Tolerance::new(COARSE)).unwrap();
        self
    }

    /// `p²/2m + ½k(λ − L)² − (F + m g)·q` and the magnitude of its terms, with `|f|λ` for lengths that are rounded.
    fn energy(&self) -> [f64; 2] {
        let [mut energy, mut terms] = [0.0, 0.0_f64];
        let mut add = |term: f64| {
            energy += term;
            terms += term.abs();
        };
        for own in &self.masses {
            let [q, p] = [self.run.position(own.node), self.run.momentum(own.node)];
            add(0.5 * p.unwrap().norm_squared() / own.mass);
            for (axis, &q) in q.unwrap().iter().enumerate() {
                add(-own.load[axis] * q);
                add(-own.mass * self.gravity[axis] * q);
            }
        }
        let mut rounded = 0.0;
        for ends in &self.springs {
            let [a, b] = ends.map(|end| self.run.position(end).unwrap());
            let (length, stretch) = ((b - a).norm(), (b - a).norm() - SPRING.natural_length);
            add(0.5 * SPRING.stiffness * stretch * stretch);
            rounded += (SPRING.stiffness * stretch).abs() * (length + a.norm() + b.norm());
        }
        [energy, terms + rounded]
    }

    /// `Σ F·q` of the loads.
    fn load_potential(&self) -> f64 {
        let own = self.masses.iter().map(|own| {
            let q = self.run.position(own.node).unwrap();
            own.load
                .iter()
                .zip(q.iter())
                .map(|(f, q)| f * q)
                .sum::<f64>()
        });
        own.sum()
    }

    /// Steps to a time; the energy stays, and the ledger's work is `F·Δq`.
    fn keeps_energy_until(&mut self, end: f64) -> u32 {
        let ([first, mut most], before) = (self.energy(), self.load_potential());
        let (work, mut steps) = (self.run.ledger().work, 0);
        let root = |steps: u32| f64::from(steps).sqrt();
        while self.run.time() < end {
            self.run.step().unwrap();
            steps += 1;
            let [energy, terms] = self.energy();
            most = most.max(terms);
            let drift = energy - first;
            let bound = ROUNDINGS * f64::EPSILON * most * root(steps);
            assert!(drift.abs() <= bound, "{D}D, {steps}: {drift:e}, {bound:e}");
        }
        let off = self.run.ledger().work - work - (self.load_potential() - before);
        // The work of each step is rounded.
        let bound = f64::EPSILON * most * root(steps);
        assert!(off.abs() <= bound, "{D}D: work off by {off:e}, {bound:e}");
        steps
    }
}

fn a_held_body_keeps_its_energy<const D: usize>() {
    let (scene, body) = body::<D>(true, [0.5, -9.81, 0.3]);
    let steps = body.start(scene).keeps_energy_until(1_000.0);
    println!("{D}D: {steps} steps");
}

#[test]
fn a_body_on_an_anchor_keeps_its_energy() {
    a_held_body_keeps_its_energy::<1>();
    a_held_body_keeps_its_energy::<2>();
    a_held_body_keeps_its_energy::<3>();
}

/// The momentum grows by `F t` exactly, and the body by its own motion only.
fn a_free_body_keeps_its_energy<const D: usize>() {
    let (scene, body) = body::<D>(false, [-0.6, 0.4, 0.1]);
    let mut body = body.start(scene);
    let first = body.run.ledger().linear_momentum;
    let steps = body.keeps_energy_until(100.0);
    let (time, last) = (body.run.time(), body.run.ledger().linear_momentum);
    println!("{D}D: {steps} steps");
    for axis in 0..D {
        let forces = body
            .masses
            .iter()
            .flat_map(|own| [own.load[axis], own.mass * body.gravity[axis]]);
        let (force, size) = forces.fold((0.0, 0.0), |(sum, size), force| {
            (sum + force, size + force.abs())
        });
        let off = last[axis] - first[axis] - force * time;
        // Impulses, momenta and their sum here are rounded.
        let bound = 4.0 * f64::EPSILON * (size * time + last.norm() + first.norm());
        assert!(off.abs() <= bound, "{D}D, {axis}: {off:e}, {bound:e}");
    }
}

#[test]
fn a_free_body_keeps_its_energy_with_the_potential_of_its_loads() {
    a_free_body_keeps_its_energy::<1>();
    a_free_body_keeps_its_energy::<2>();
    a_free_body_keeps_its_energy::<3>();
}

#[test]
fn loads_that_are_set_between_steps_keep_their_own_energies() {
    let (mut scene, mut body) = body::<2>(true, [0.0, -9.81, 0.0]);
    let node = scene.mass(0.7, [3.0, 0.5], [0.0, 0.0]);
    let (mass, load) = (0.7, [0.0; 2]);
    body.masses.push(Loaded { node, mass, load });
    body.springs.push([body.masses[1].node, node]);
    scene.spring(SPRING, body.springs[2]);
    let mut body = body.start(scene);
    for (at, load) in [[2.0, 1.0], [-3.0, 0.5], [0.0, 0.0], [1e-3, 4.0]]
        .into_iter()
        .enumerate()
    {
        body.run.set_force(node, load).unwrap();
        body.masses[2].load = load;
        let end = 50.0 * f64::from(u8::try_from(at + 1).unwrap());
        body.keeps_energy_until(end);
    }
}

#[test]
fn of_loads_that_end_only_the_constant_part_stays() {
    let (mut scene, body) = body::<3>(true, [0.0, 0.0, -9.81]);
    scene.force(body.masses[1].node, |t| {
        if t < 1.0 { [3.0, t, -t] } else { [0.0; 3] }
    });
    scene.stop_at([1.0]);
    let mut body = body.start(scene);
    let (before, balance) = (body.load_potential(), body.run.ledger().balance);
    body.run.run_until(1.0).unwrap();
    let ledger = body.run.ledger();
    let pushed = ledger.work - (body.load_potential() - before);
    assert!(pushed.abs() > 0.1, "{pushed}");
    let [_, terms] = body.energy();
    let off = ledger.balance - balance;
    assert!(off.abs() <= ROUNDINGS * f64::EPSILON * terms, "{off:e}");
    body.keeps_energy_until(500.0);
}

/// Nothing but the mass itself can close the energy.
#[test]
fn a_single_mass_has_the_work_of_constant_and_varying_loads() {
    let mut scene = Scene::<2>::new();
    let node = scene.mass(2.0, [0.3, 4.0], [1.0, 0.0]);
    let (load, weight) = ([0.5, 1.0], -2.0 * 9.81);
    scene.set_gravity([0.0, -9.81]);
    scene.dead_load(node, load);
    scene.force(node, |t| [(3.0 * t).sin(), 5.0 * (2.0 * t).cos()]);
    let tolerance = Tolerance::new(COARSE);
    let mut run = Simulation::with_tolerance(scene, SCHEME, tolerance).unwrap();
    let energy = |run: &Simulation<2>| {
        let [q, p] = [run.position(node).unwrap(), run.momentum(node).unwrap()];
        let terms = [0.25 * p.norm_squared(), -weight * q[1], -run.ledger().work];
        [
            terms.iter().sum::<f64>(),
            terms.iter().map(|term| term.abs()).sum(),
        ]
    };
    let [first, mut most] = energy(&run);
    let mut steps = 0.0;
    while run.time() < 10.0 {
        run.step().unwrap();
        let [energy, terms] = energy(&run);
        (most, steps) = (terms.max(most), steps + 1.0);
        let bound = (ROUNDINGS + steps) * f64::EPSILON * most;
        assert!(
            (energy - first).abs() <= bound,
            "{:e}, {bound:e}",
            energy - first
        );
    }
    // None was shortened because of the energy; the force has eight turning points.
    assert!(steps <= 16.0, "{steps}");
}

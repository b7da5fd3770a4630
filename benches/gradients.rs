//! What gradients cost: the time of the adjoint over that of the run, in turn, the least of several.
//!
//! ```text
//! cargo bench -p eem-benches --bench gradients --features gradients
//! ```

use std::time::Instant;

use eem::kinematics::Hex8;
use eem::materials::{SaintVenantKirchhoff, ThermoelasticSpring};
use eem::prelude::*;
use eem::{History, Objective};
use eem_testkit::scenes::{DoublePendulum, single_pendulum_scene};

/// Runs of which the fastest counts.
const REPEATS: usize = 5;

/// A run of some steps without a history, one with it, and its gradient; the least times, s.
fn times<const D: usize>(scene: &Scene<D>, scheme: Scheme, step: f64, steps: usize) -> [f64; 3] {
    let mut least = [f64::INFINITY; 3];
    for _ in 0..REPEATS {
        let mut note = |place: usize, start: Instant| {
            let time: &mut f64 = &mut least[place];
            *time = time.min(start.elapsed().as_secs_f64());
        };
        for keeps in [false, true] {
            let run = Simulation::new(scene.clone(), scheme, step);
            let mut run = run.expect("a valid scene");
            if keeps {
                run.keep_history(History::bytes(1 << 34));
            }
            let start = Instant::now();
            for _ in 0..steps {
                run.step().expect("a step");
            }
            note(usize::from(keeps), start);
            if keeps {
                let start = Instant::now();
                let energy = Objective::at_end(Quantity::KineticEnergy);
                run.gradient(&energy).expect("a gradient");
                note(2, start);
            }
        }
    }
    least
}

fn print<const D: usize>(name: &str, scene: &Scene<D>, step: f64, steps: usize) {
    for scheme in [Scheme::EemTemperature, Scheme::EemEntropy] {
        let [plain, kept, gradient] = times(scene, scheme, step, steps);
        let per_step = 1e6 * plain / f64::from(u32::try_from(steps).unwrap_or(u32::MAX));
        println!(
            "{name:<12} {scheme:<16} step {per_step:>11.2} µs   with history {:>5.2}   gradient {:>5.2}",
            kept / plain,
            gradient / plain
        );
    }
}

/// A square lattice of thermoelastic springs of 1 m, in motion.
fn lattice(side: usize) -> Scene<2> {
    let spring = ThermoelasticSpring {
        stiffness: 5000.0,
        natural_length: 1.0,
        coupling: 20.0,
        capacity: 2000.0,
        theta_ref: 300.0,
    };
    let number = |index: usize| f64::from(u32::try_from(index).unwrap_or(0));
    let wave = |index: usize, phase: f64| (0.7 * number(index) + phase).sin();
    let mut scene = Scene::new();
    let all: Vec<Node> = (0..side * side)
        .map(|index| {
            let position = [
                number(index % side) + 0.02 * wave(index, 0.0),
                number(index / side) + 0.02 * wave(index, 1.0),
            ];
            scene.mass(1.0, position, [wave(index, 2.0), wave(index, 3.0)])
        })
        .collect();
    for index in 0..all.len() {
        let right = (index % side + 1 < side).then_some(index + 1);
        for other in [right, Some(index + side)].into_iter().flatten() {
            if let Some(&end) = all.get(other) {
                let spring = scene.spring(spring.clone(), [all[index], end]);
                scene.set_temperature(spring, 300.0 + 10.0 * wave(index, 4.0));
            }
        }
    }
    scene
}

/// A cube of 1 m that turns and shears.
fn cube(cells: usize) -> Scene<3> {
    let mesh = Mesh::<Hex8, 3>::block([cells; 3], [[-0.5, 0.5]; 3]).expect("a mesh");
    let mut scene = Scene::new();
    let rubber = SaintVenantKirchhoff {
        lame: 2000.0,
        shear: 1000.0,
    };
    let body = scene.solid(rubber, &mesh, &Bulk::new(10.0));
    for (&node, &[x, y, z]) in body.nodes().iter().zip(body.mesh().nodes()) {
        scene.set_velocity(node, [z - y + 0.1 * y * z, x, 0.1 * x - x]);
    }
    scene
}

fn main() {
    print("single", &single_pendulum_scene().0, 0.1, 5000);
    let [_, krueger, log] = DoublePendulum::ALL;
    print("krueger", &krueger.scene().0, 0.02, 2000);
    print("log", &log.scene().0, 0.02, 2000);
    print("lattice 100²", &lattice(100), 0.01, 4);
    print("cube 8³", &cube(8), 0.01, 4);
}

//! A copy of a scene is the same scene, with the same handles, until one of them is changed.

use eem::prelude::*;

use crate::support::solids::{SECTION, ThermoelasticSolid};
use crate::support::{Hencky, ThermoViscoElastic, hencky};

const HENCKY: Hencky = hencky(100.0, 1.0);

/// A scene with something of each kind, and handles of each kind.
struct Full {
    scene: Scene<2>,
    mass: Node,
    spring: Element,
    air: Reservoir,
}

fn full() -> Full {
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let mass = scene.mass(1.0, [3.0, 0.0], [0.0, 1.0]);
    let other = scene.mass(2.0, [4.0, 1.0], [0.0, 0.0]);
    let spring = scene.spring(ThermoViscoElastic::PENDULUM, [pivot, mass]);
    scene.spring(HENCKY, [mass, other]);
    let held = scene.spring(ThermoViscoElastic::PENDULUM, [other, pivot]);
    scene.set_temperature(spring, 380.0);
    scene.set_viscous_stretch(spring, 0, 0.1);
    scene.hold_temperature(held, 310.0);
    let air = scene.reservoir(300.0);
    scene.conduct(spring, air, 10.0);
    scene.conduct(spring, held, 3.0);
    scene.set_gravity([0.0, -9.81]);
    scene.force(mass, |t| [t.sin(), 0.0]);
    scene.move_anchor(pivot, |t| [0.0, 0.1 * t]);
    Full {
        scene,
        mass,
        spring,
        air,
    }
}

fn bits(mut run: Simulation<2>) -> String {
    for _ in 0..20 {
        run.step().unwrap();
    }
    format!("{:?}", run.checkpoint())
}

fn run(scene: Scene<2>) -> Simulation<2> {
    Simulation::new(scene, Scheme::EemEntropy, 0.05).unwrap()
}

#[test]
fn a_copy_moves_with_the_bits_of_the_scene() {
    let Full { scene, .. } = full();
    let copies = [scene.clone(), scene.clone().clone()];
    let expected = bits(run(scene));
    for copy in copies {
        assert_eq!(bits(run(copy)), expected);
    }
    // Solids, whose masses couple nodes.
    let mut scene = Scene::<2>::new();
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let nodes = corners.map(|at| scene.node(at, [-at[1], at[0]]));
    for point in scene.quadrilateral(ThermoelasticSolid::RUBBER, nodes, SECTION) {
        scene.set_temperature(point, 300.0);
    }
    let copy = scene.clone();
    assert_eq!(bits(run(copy)), bits(run(scene)));
}

#[test]
fn handles_of_a_scene_are_those_of_its_copies() {
    let Full {
        scene,
        mass,
        spring,
        air,
    } = full();
    let copy = scene.clone();
    for run in [run(copy.clone()), run(copy), run(scene)] {
        approx::assert_relative_eq!(run.position(mass).unwrap()[0], 3.0);
        approx::assert_relative_eq!(run.temperature(spring).unwrap(), 380.0);
        approx::assert_relative_eq!(run.reservoir_heat(air).unwrap(), 0.0);
    }
}

#[test]
fn what_is_added_later_has_handles_of_its_own() {
    let Full {
        mut scene, mass, ..
    } = full();
    let mut copy = scene.clone();
    let mut grandchild = copy.clone();
    // The same place in each of them.
    let nodes = [&mut scene, &mut copy, &mut grandchild].map(|scene| {
        let node = scene.mass(1.0, [9.0, 9.0], [0.0; 2]);
        let spring = scene.spring(HENCKY, [mass, node]);
        let air = scene.reservoir(290.0);
        (node, spring, air)
    });
    let late = copy.clone();
    for (place, scene) in [scene, copy, grandchild].into_iter().enumerate() {
        let run = run(scene);
        for (other, &(node, spring, air)) in nodes.iter().enumerate() {
            let is_own = place == other;
            assert_eq!(run.position(node).is_ok(), is_own);
            assert_eq!(run.stretch(spring).is_ok(), is_own);
            assert_eq!(run.reservoir_heat(air).is_ok(), is_own);
        }
    }
    // A copy that was made afterwards has those of the scene it was made from.
    let run = run(late);
    let known = nodes.map(|(node, ..)| run.position(node).is_ok());
    assert_eq!(known, [false, true, false]);
}

#[test]
fn errors_of_a_copy_name_the_handles_that_the_user_has() {
    let Full { scene, spring, .. } = full();
    let mut copy = scene.clone();
    copy.set_temperature(spring, -1.0);
    let refused = Simulation::new(copy, Scheme::EemEntropy, 0.05).unwrap_err();
    let [SceneError::State(eem::StateError::Temperature { element, .. })] = refused.errors() else {
        panic!("{refused}")
    };
    assert_eq!(*element, spring);
}

#[test]
fn what_was_wrong_with_a_scene_is_wrong_with_its_copy() {
    let Full { mut scene, .. } = full();
    let foreign = full().mass;
    scene.dead_load(foreign, [1.0, 0.0]);
    let refused = Simulation::new(scene.clone(), Scheme::EemEntropy, 0.05).unwrap_err();
    assert_eq!(refused.to_string(), "node 1 belongs to another scene");
}

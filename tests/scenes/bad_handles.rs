//! Handles of another scene, and things that an element cannot do, are typed errors.

use eem::prelude::*;

use crate::support::{ThermoViscoElastic, hencky, only_error};

/// An elastic and a thermal spring between an anchor and a mass, and a reservoir.
struct Parts {
    scene: Scene<2>,
    pivot: Node,
    bob: Node,
    elastic: Element,
    thermal: Element,
    room: Reservoir,
}

fn parts() -> Parts {
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [1.5, 0.0], [0.0, 1.0]);
    let elastic = scene.spring(hencky(10.0, 1.0), [pivot, bob]);
    let thermal = scene.spring(ThermoViscoElastic::PENDULUM, [pivot, bob]);
    scene.set_temperature(thermal, 300.0);
    let room = scene.reservoir(290.0);
    Parts {
        scene,
        pivot,
        bob,
        elastic,
        thermal,
        room,
    }
}

/// The error of a scene that `spoil` spoils, given the handles of another scene.
fn error(spoil: impl FnOnce(&mut Parts, &Parts)) -> SceneError {
    let (mut own, foreign) = (parts(), parts());
    spoil(&mut own, &foreign);
    let refused = Simulation::new(own.scene, Scheme::EemEntropy, 0.1);
    refused.unwrap_err().into()
}

#[test]
fn an_element_conducts_no_heat_to_itself() {
    let mut own = parts();
    own.scene.conduct(own.thermal, own.thermal, 1.0);
    let element = own.thermal;
    let error = only_error(Simulation::new(own.scene, Scheme::EemEntropy, 0.1));
    assert_eq!(error, SceneError::SelfConduction { element });
    println!("{error}");
}

#[test]
fn handles_of_another_scene_are_refused_wherever_they_are_used() {
    type Spoil = fn(&mut Parts, &Parts);
    let misuses: [(&str, Spoil); 12] = [
        ("a spring", |own, foreign| {
            own.scene
                .spring(ThermoViscoElastic::PENDULUM, [foreign.pivot, own.bob]);
        }),
        ("a conductor from", |own, foreign| {
            own.scene.conduct(foreign.thermal, own.room, 1.0);
        }),
        ("a conductor to an element", |own, foreign| {
            own.scene.conduct(own.thermal, foreign.thermal, 1.0);
        }),
        ("a conductor to a reservoir", |own, foreign| {
            own.scene.conduct(own.thermal, foreign.room, 1.0);
        }),
        ("a temperature", |own, foreign| {
            own.scene.set_temperature(foreign.thermal, 300.0);
        }),
        ("a viscous stretch", |own, foreign| {
            own.scene.set_viscous_stretch(foreign.thermal, 0, 0.0);
        }),
        ("a thermostat", |own, foreign| {
            own.scene.prescribe_temperature(foreign.thermal, |_| 300.0);
        }),
        ("a force", |own, foreign| {
            own.scene.force(foreign.bob, |_| [0.0, 0.0]);
        }),
        ("a dead load", |own, foreign| {
            own.scene.dead_load(foreign.bob, [0.0, 0.0]);
        }),
        ("a momentum", |own, foreign| {
            own.scene.set_momentum(foreign.bob, [0.0, 0.0]);
        }),
        ("a motion", |own, foreign| {
            own.scene.move_anchor(foreign.pivot, |_| [0.0, 0.0]);
        }),
        ("another spring", |own, foreign| {
            own.scene
                .spring(ThermoViscoElastic::PENDULUM, [own.pivot, foreign.bob]);
        }),
    ];
    for (what, spoil) in misuses {
        let error = error(spoil);
        println!("{what}: {error}");
        assert!(matches!(error, SceneError::ForeignHandle { .. }), "{what}");
    }
}

#[test]
fn questions_with_a_handle_of_another_scene_are_refused() {
    let (own, foreign) = (parts(), parts());
    let run = Simulation::new(own.scene, Scheme::EemEntropy, 0.1).unwrap();
    let node = foreign.bob;
    let element = foreign.thermal;
    let answers = [
        run.position(node).err(),
        run.momentum(node).err(),
        run.velocity(node).err(),
        run.stretch(element).err(),
        run.force(element).err(),
        run.internal_energy(element).err(),
        run.temperature(element).err(),
        run.entropy(element).err(),
        run.viscous_stretch(element, 0).err(),
        run.reservoir_entropy(foreign.room).err(),
        run.reservoir_heat(foreign.room).err(),
    ];
    for answer in answers {
        assert!(matches!(answer, Some(SceneError::ForeignHandle { .. })));
    }
}

#[test]
fn an_element_without_temperature_has_none_to_set_hold_or_conduct() {
    type Spoil = fn(&mut Parts, &Parts);
    let misuses: [(&str, Spoil); 4] = [
        ("set", |own, _| {
            own.scene.set_temperature(own.elastic, 300.0);
        }),
        ("held", |own, _| {
            own.scene.prescribe_temperature(own.elastic, |_| 300.0);
        }),
        ("conducting", |own, _| {
            own.scene.conduct(own.elastic, own.room, 1.0);
        }),
        ("conducted to", |own, _| {
            own.scene.conduct(own.thermal, own.elastic, 1.0);
        }),
    ];
    for (what, spoil) in misuses {
        let error = error(spoil);
        println!("{what}: {error}");
        assert!(matches!(error, SceneError::NotThermal { .. }), "{what}");
    }
}

#[test]
fn a_model_without_temperature_asked_for_one() {
    let own = parts();
    let mut run = Simulation::new(own.scene, Scheme::EemEntropy, 0.1).unwrap();
    run.step().unwrap();
    let element = own.elastic;
    assert_eq!(
        run.temperature(element),
        Err(SceneError::NotThermal { element })
    );
    assert_eq!(
        run.entropy(element),
        Err(SceneError::NotThermal { element })
    );
}

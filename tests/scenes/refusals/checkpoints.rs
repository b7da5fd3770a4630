//! A checkpoint that was edited, or that belongs to a scene with other numbers, is refused with what is
//! wrong, and the simulation stays as it was.

use eem::kinematics::Quad4;
use eem::prelude::*;
use eem::{RestoreError, StateError};
use serde_json::{Value, json};

use super::{Elastic, WARM, Warm};
use crate::support::solids::ThermoelasticSolid;

/// All numbers of the scene that a state does not contain.
#[derive(Clone)]
struct Numbers {
    model: Warm<f64>,
    mass: f64,
    conductance: f64,
    reservoir: f64,
    gravity: f64,
}

const NUMBERS: Numbers = Numbers {
    model: WARM,
    mass: 1.5,
    conductance: 2.0,
    reservoir: 290.0,
    gravity: -9.81,
};

/// Nodes 0 and 1 are a fixed and a moved anchor, 2 and 3 masses. Of the springs, element 0 is warm,
/// 1 elastic and 2 kept at a temperature.
fn build(scheme: Scheme, numbers: &Numbers) -> Simulation<2> {
    let mut scene = Scene::<2>::new();
    let fixed = scene.anchor([0.1, -0.2]);
    let moved = scene.anchor([3.0, 0.0]);
    let bob = scene.mass(numbers.mass, [1.0, 0.0], [0.0, 0.5]);
    let tail = scene.mass(1.0, [2.0, 0.3], [0.0, 0.0]);
    let warm = scene.spring(numbers.model.clone(), [fixed, bob]);
    let elastic = Elastic {
        stiffness: 10.0,
        length: 1.0,
    };
    scene.spring(elastic, [bob, tail]);
    let kept = scene.spring(WARM, [tail, moved]);
    scene.set_temperature(warm, 330.0);
    scene.set_temperature(kept, 310.0);
    let room = scene.reservoir(numbers.reservoir);
    scene.conduct(warm, room, numbers.conductance);
    scene.conduct(warm, kept, 0.5);
    scene.set_gravity([0.0, numbers.gravity]);
    scene.move_anchor(moved, |t| [3.0 + 0.2 * (2.0 * t).sin(), 0.1 * t]);
    scene.prescribe_temperature(kept, |t| 310.0 + 3.0 * (5.0 * t).sin());
    Simulation::new(scene, scheme, 0.02).unwrap()
}

/// A run that has made some steps.
fn run(scheme: Scheme) -> Simulation<2> {
    let mut run = build(scheme, &NUMBERS);
    for _ in 0..20 {
        run.step().unwrap();
    }
    run
}

/// The error of restoring an edited checkpoint into the simulation that it comes from.
fn refusal(edit: impl Fn(&mut Value)) -> RestoreError {
    let mut run = run(Scheme::EemEntropy);
    let mut value = serde_json::to_value(run.checkpoint()).unwrap();
    edit(&mut value["state"]);
    let checkpoint: Checkpoint = serde_json::from_value(value).unwrap();
    run.step().unwrap();
    let before = format!("{:?}", run.checkpoint());
    let error = run.restore(&checkpoint).unwrap_err();
    assert_eq!(before, format!("{:?}", run.checkpoint()));
    run.step().unwrap();
    println!("{error}");
    error
}

/// Adds to a number in JSON.
fn add(number: &mut Value, change: f64) {
    *number = json!(number.as_f64().unwrap() + change);
}

/// An edited number is refused with an error that begins, in `Debug`, with this.
fn refuses(expected: &str, edit: impl Fn(&mut Value)) {
    let error = format!("{:?}", refusal(edit));
    assert!(error.starts_with(expected), "{expected}: {error}");
}

#[test]
fn an_edited_temperature_or_entropy() {
    let heated = refusal(|state| add(&mut state["temperatures"][0], 1e-9));
    let RestoreError::Entropy {
        element: 0,
        entropy,
        expected,
        bound,
        ..
    } = heated
    else {
        panic!("{heated}");
    };
    assert!(expected > entropy && expected - entropy > bound);
    let of_first = "Entropy { element: 0,";
    refuses(of_first, |state| add(&mut state["entropies"][0][0], 1e-9));
    // The other variables of the entropy.
    refuses(of_first, |state| add(&mut state["positions"][5][0], 1e-9));
    // One that a thermostat gives.
    refuses("Thermostat {", |state| {
        add(&mut state["temperatures"][1], 1e-9);
    });
}

#[test]
fn a_carry_that_no_rounding_leaves() {
    let error = refusal(|state| state["positions"][4][1] = json!(5.0));
    let RestoreError::Carry {
        quantity, carry, ..
    } = error
    else {
        panic!("{error}");
    };
    assert!(quantity == "coordinates" && (carry - 5.0).abs() <= 0.0);
    // One unit in the last place of a number near 1 is twice what is left.
    for sums in ["momenta", "positions"] {
        refuses("Carry {", |state| {
            let value = state[sums][4][0].as_f64().unwrap();
            state[sums][4][1] = json!(value.abs() * f64::EPSILON);
        });
    }
    for sum in ["time", "work", "heat", "thermostat_entropy"] {
        refuses("Carry {", |state| state[sum][1] = json!(1e-3));
    }
    // Nothing is missing of zero.
    refuses("Carry {", |state| {
        state["dissipated"] = json!([0.0, 5e-324]);
    });
}

#[test]
fn nodes_in_the_wrong_place() {
    // The mass on its anchor.
    let error = refusal(|state| {
        for axis in 0..2 {
            state["positions"][4 + axis] = state["positions"][axis].clone();
        }
    });
    let RestoreError::State(StateError::Stretch { value, .. }) = error else {
        panic!("{error}");
    };
    assert!(value.abs() <= 0.0);
    let first = "Anchor { node: 0, axis: 0,";
    for change in [0.5, 1e-15] {
        refuses(first, |state| add(&mut state["positions"][0][0], change));
    }
    refuses(first, |state| state["positions"][0][1] = json!(1e-18));
    for change in [0.5, 1e-13] {
        refuses("Anchor { node: 1, axis: 1,", |state| {
            add(&mut state["positions"][3][0], change);
        });
    }
    refuses("AnchorMomentum { node: 1, axis: 0,", |state| {
        state["momenta"][2][0] = json!(1.0);
    });
}

#[test]
fn an_edited_velocity_of_an_anchor_of_a_solid() {
    let mut scene = Scene::<2>::new();
    let mesh = Mesh::<Quad4, 2>::block([1, 1], [[0.0, 1.0]; 2]).unwrap();
    let bulk = Bulk::new(10.0).thickness(0.1);
    let body = scene.solid(ThermoelasticSolid::RUBBER, &mesh, &bulk);
    let corner = body.node_at([0.0; 2], 1e-9).unwrap();
    scene.fix(corner);
    for &point in body.points() {
        scene.set_temperature(point, 300.0);
    }
    let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.01).unwrap();
    run.step().unwrap();
    let mut value = serde_json::to_value(run.checkpoint()).unwrap();
    value["state"]["velocities"][1] = json!([0.5, 0.0]);
    let checkpoint: Checkpoint = serde_json::from_value(value).unwrap();
    let error = run.restore(&checkpoint).unwrap_err().to_string();
    let said = "component 1 of the velocity of the anchor node 0 is 0.5 m/s in the checkpoint, it must be zero";
    assert_eq!(error, said);
}

#[test]
fn another_time_or_an_infinite_energy() {
    // Where the anchor was then is not where it is now.
    refuses("Anchor { node: 1,", |state| {
        state["time"] = json!([0.3, 0.0]);
    });
    refuses("Value { quantity: \"time\",", |state| {
        state["time"] = json!([-1.0, 0.0]);
    });
    refuses("Total {", |state| {
        state["momenta"][4] = json!([1e300, 0.0]);
    });
}

/// Bookings, what step control has learnt, and the rates of an explicit scheme.
#[test]
fn what_follows_from_the_steps() {
    let controlled = |scheme| {
        let mut run = build(scheme, &NUMBERS);
        run.control_steps(Tolerance::new(1e-4)).unwrap();
        for _ in 0..20 {
            run.step().unwrap();
        }
        run
    };
    let common = [
        ("/state/heat/0", "heat"),
        ("/state/work/0", "work"),
        ("/state/thermostat_entropy/0", "thermostat entropy"),
        ("/state/reservoir_entropies/0/0", "reservoir entropies"),
        ("/state/dissipated/0", "lost heat"),
        ("/control/smallest", "the smallest step"),
        ("/control/largest", "the largest step"),
        ("/control/largest_momentum", "the largest momentum"),
        ("/control/controller/last/0", "the last step under control"),
        ("/control/statistics/accepted", "statistics of steps"),
    ];
    let newton = [
        ("/past/forces/0/0", "forces"),
        ("/past/internal/0", "the start of the last step"),
    ];
    let explicit = [
        ("/explicit/rates/0", "rates"),
        ("/explicit/targets/0/0", "targets"),
        ("/explicit/largest_momentum", "the largest momentum"),
        ("/explicit/residue", "the energy defect"),
    ];
    for (scheme, own) in [
        (Scheme::EemEntropy, &newton[..]),
        (Scheme::EemExplicit, &explicit[..]),
    ] {
        for &(path, entry) in common.iter().chain(own) {
            let edits = if path.contains("statistics") {
                [json!(7), json!(u64::MAX)]
            } else {
                [json!(1e3), json!(1e300)]
            };
            for edited in edits {
                let mut run = controlled(scheme);
                let mut value = serde_json::to_value(run.checkpoint()).unwrap();
                let number = value.pointer_mut(path).unwrap();
                *number = edited;
                let checkpoint: Checkpoint = serde_json::from_value(value).unwrap();
                run.step().unwrap();
                let before = format!("{:?}", run.checkpoint());
                let error = run.restore(&checkpoint).unwrap_err();
                assert_eq!(error, RestoreError::Edited { entry }, "{scheme}: {path}");
                assert_eq!(before, format!("{:?}", run.checkpoint()));
            }
        }
    }
}

#[test]
fn a_scene_with_other_numbers() {
    let saved = run(Scheme::EemEntropy).checkpoint();
    let expect = |spoil: fn(&mut Numbers), kind: &str| {
        let mut numbers = NUMBERS;
        spoil(&mut numbers);
        let mut other = build(Scheme::EemEntropy, &numbers);
        let error = other.restore(&saved).unwrap_err();
        assert_eq!(
            error.to_string(),
            format!(
                "the checkpoint is one of a scene with other {kind}: build the scene with the numbers \
                 that it had"
            )
        );
        assert!(other.time() <= 0.0);
    };
    expect(
        |numbers| numbers.model.eta *= 2.0,
        "parameters of materials",
    );
    expect(|numbers| numbers.mass = 1.0, "masses");
    expect(|numbers| numbers.conductance += 1e-15, "conductances");
    expect(
        |numbers| numbers.reservoir = 291.0,
        "temperatures of reservoirs",
    );
    expect(|numbers| numbers.gravity = 0.0, "gravity");
    build(Scheme::EemEntropy, &NUMBERS).restore(&saved).unwrap();
}

#[test]
fn what_a_run_saves_it_can_restore() {
    for scheme in Scheme::ALL {
        let mut run = build(scheme, &NUMBERS);
        let mut other = build(scheme, &NUMBERS);
        for step in 0..300_u32 {
            if step % 50 == 0 {
                run.set_step_size(0.02 / f64::from(1 + step / 50)).unwrap();
            }
            let end = run.time() + 0.0037;
            if step % 7 == 0 {
                run.run_until(end).unwrap();
            }
            let saved = run.checkpoint();
            let restored = other.restore(&saved);
            restored.unwrap_or_else(|error| panic!("{}, {step}: {error}", scheme.name()));
            run.step().unwrap();
        }
    }
}

//! What a spring of a long chain takes, in bytes, and that what takes too much is refused.

use eem::TooLarge;
use eem::kinematics::Hex8;
use eem::prelude::*;

use crate::support::LogarithmicStiffness;
use crate::support::only_error;
use crate::support::solids::SaintVenant;

/// Springs of the chain: what does not grow with them is then a thousandth.
const SPRINGS: u32 = 10_000;

fn chain() -> Scene<2> {
    let mut scene = Scene::new();
    let mut last = scene.anchor([0.0, 0.0]);
    for index in 1..=SPRINGS {
        let next = scene.mass(1.0, [2.0 * f64::from(index), 0.0], [0.0, 1.0]);
        let spring = scene.spring(LogarithmicStiffness::FIRST, [last, next]);
        scene.set_temperature(spring, 300.0);
        last = next;
    }
    scene
}

/// Of a thermoelastic spring in the plane with its node: the element and its part of the trial state, with two pointers to what
/// classical and damped schemes need beside it, and its material behind a table, 512 B;
/// the tangent with its pattern, factors and solution, 284 B; the old and the new state with their
/// energies, 256 B; the solver's vectors, with two earlier temperatures, 16 B; what the simulation knows of node and element,
/// 16 B; what its conduction and dashpots add up to, and the least scales of step control at its node, 48 B. 1334 B were measured.
const BYTES: i64 = 1_334;

/// With the scene from which the simulation is made, whose lists have grown by doubling.
const BYTES_AT_MOST: u64 = 1_364;

#[test]
fn a_spring_of_a_chain_takes_what_is_said() {
    let mut kept = None;
    let counted = allocation_counter::measure(|| {
        let mut run = Simulation::new(chain(), Scheme::EemTemperature, 0.01).unwrap();
        run.step().unwrap();
        kept = Some(run);
    });
    let per_spring = counted.bytes_current / i64::from(SPRINGS);
    let at_most = counted.bytes_max / u64::from(SPRINGS);
    println!("{per_spring} bytes per spring, {at_most} at most");
    assert!(per_spring <= BYTES, "{per_spring} bytes per spring");
    assert!(at_most <= BYTES_AT_MOST, "{at_most} bytes while it is made");
}

/// A block of six cells along each edge, on a limit.
fn block(bytes: u64) -> Scene<3> {
    let mesh: Mesh<Hex8, 3> = Mesh::block([6; 3], [[0.0, 1.0]; 3]).unwrap();
    let material = SaintVenant {
        lame: 2000.0,
        shear: 1000.0,
    };
    let mut scene = Scene::new();
    scene.solid(material, &mesh, &Bulk::new(10.0));
    scene.limit_memory(bytes);
    scene
}

#[test]
fn what_does_not_fit_is_refused_with_its_bytes() {
    let start = |bytes| Simulation::new(block(bytes), Scheme::EemTemperature, 0.01);
    let refused = only_error(start(1_000_000));
    let SceneError::TooLarge(TooLarge {
        unknowns: 1_029,
        needed,
        available: Some(1_000_000),
    }) = refused
    else {
        panic!("{refused}")
    };
    assert!(refused.to_string().contains(&format!("{needed} bytes")));
    // The factors are reserved by the number that was said: not one byte less is enough.
    assert!(start(needed - 1).is_err());
    let counted = allocation_counter::measure(|| drop(start(needed).unwrap()));
    assert!(counted.bytes_max >= needed, "{counted:?}, {needed} needed");
    // A scene that is refused comes back as it was.
    let mut scene = start(needed - 1).unwrap_err().into_scene();
    scene.limit_memory(needed);
    let run = Simulation::new(scene, Scheme::EemTemperature, 0.01);
    assert!(run.unwrap().step().is_ok());
}

//! What a spring of a long chain takes, in bytes.

use eem::prelude::*;

use crate::support::LogarithmicStiffness;

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

/// Of a thermoelastic spring in the plane with its node: the element and its part of the trial state, 408 B;
/// the tangent with its pattern, factors and solution, 284 B; the old and the new state with their
/// energies, 208 B; the solver's vectors; what the simulation knows of node and element, 16 B. 1077 B were
/// measured.
const BYTES: i64 = 1_100;

/// With the scene from which the simulation is made, whose lists have grown by doubling.
const BYTES_AT_MOST: u64 = 1_300;

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

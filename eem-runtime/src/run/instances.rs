//! Simulations in the plane and in space, compiled with this crate.
//!
//! `Simulation<D, f64>` is generic, so every program would compile its own copy. Without optimisation the
//! compiler links the copy of a library if there is one: that spares each test and example 2 of 5 s.

use core::ops::ControlFlow;

use crate::run::simulation::Simulation;
use crate::scene::Scene;
use crate::step::scheme::Scheme;

/// Is never called. It is public, since the compiler leaves out what nobody can reach.
#[doc(hidden)]
pub fn instances() {
    instance::<2>();
    instance::<3>();
}

/// Names what programs call; everything below follows.
fn instance<const D: usize>() {
    let Ok(mut run) = Simulation::<D, f64>::new(Scene::new(), Scheme::EemEntropy, 1.0) else {
        return;
    };
    let _ = run.step();
    let _ = run.run_until(1.0);
    let _ = run.run_until_with(1.0, |_, _| ControlFlow::Break(()));
    let _ = run.ledger();
    let checkpoint = run.checkpoint();
    let _ = run.restore(&checkpoint);
}

//! Loads and events: a crane lifts a mass, a gust pushes it, and the run stops when the rope breaks.
//!
//! ```text
//! ψ(λ) = ½ k (λ − l)²
//! balance = energy (kinetic, elastic and of gravity) − work of the crane and of the gust
//! ```
//!
//! Claim: the balance is constant to rounding while the loads change the energy; the run stops at the event, where the
//! force is the strength of the rope; a run resumed from a checkpoint has the same bits.

use core::f64::consts::PI;

use eem::prelude::*;

#[derive(Clone, FreeEnergy)]
#[free_energy(|lambda: Stretch| 0.5 * stiffness * (lambda - length).powi(2))]
struct Rope {
    #[unit("N/m")]
    stiffness: f64,
    #[unit("m")]
    length: f64,
}

const ROPE: Rope = Rope {
    stiffness: 2000.0,
    length: 3.0,
};

/// The force at which the rope breaks, N.
const STRENGTH: f64 = 260.0;

fn build() -> Result<(Simulation<2>, Element), SceneError> {
    let mut scene = Scene::<2>::new();
    let crane = scene.anchor([0.0, 0.0]);
    let load = scene.mass(10.0, [0.0, -3.05], [0.0, 0.0]);
    let rope = scene.spring(ROPE, [crane, load]);
    scene.set_gravity([0.0, -9.81]);
    // The crane stops for a moment every two seconds; the gust grows.
    scene.move_anchor(crane, |t| [0.0, 0.4 * (t - (PI * t).sin() / PI)]);
    scene.force(load, |t| [20.0 * (1.5 * t).sin() * t, 0.0]);
    Ok((Simulation::new(scene, Scheme::EemTemperature, 0.02)?, rope))
}

/// The force of the rope, N.
fn force(run: &Simulation<2>, rope: Element) -> Result<f64, SceneError> {
    Ok(ROPE.stiffness * (run.stretch(rope)? - ROPE.length))
}

/// The event that the rope breaks.
fn breaks<'a>(rope: Element) -> Event<'a, 2> {
    Event::rising(move |run: &Simulation<2>| Ok(force(run, rope)? - STRENGTH))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (mut run, rope) = build()?;
    let start = run.ledger().balance;

    run.run_until(1.0)?;
    let saved = run.checkpoint();

    let end = run.run_until_event(20.0, &mut [breaks(rope)])?;
    assert_eq!(end, RunEnd::Event(0));

    let now = run.ledger();
    println!(
        "the rope breaks at {:.6} s with {:.3} N",
        run.time(),
        force(&run, rope)?
    );
    println!("work of crane and gust  {:10.6} J", now.work);
    println!(
        "energy minus work has changed by {:.1e} J",
        now.balance - start
    );
    assert!((force(&run, rope)? - STRENGTH).abs() < 1e-6);
    assert!((now.balance - start).abs() < 1e-10);

    // The same scene, resumed from the checkpoint, stops at the same time, bit for bit.
    let (mut again, rope) = build()?;
    again.restore(&saved)?;
    again.run_until_event(20.0, &mut [breaks(rope)])?;
    assert_eq!(again.time().to_bits(), run.time().to_bits());
    assert_eq!(again.ledger(), run.ledger());
    Ok(())
}

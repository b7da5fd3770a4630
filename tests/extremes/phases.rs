//! Kind 6: free energies that are not convex, along the ways on which they are not.

use eem::prelude::*;

use super::findings::on_anchor;
use super::models::{Landau, Morse, VanDerWaals, hooke};
use super::tally::{Effort, Family, Tally};
use super::watched::{EXACT, Watched};
use super::world::World;

pub(crate) const FAMILIES: &[Family] = &[
    landau_bar,
    van_der_waals_piston,
    springs_past_their_peak,
    snap_through,
];

/// A bar of which the austenite (e = 0) is cooled below its stability, or pulled and pressed into the
/// martensites e² = (b + √(b² − 4ad(θ − θ0)))/2d.
fn landau_bar(effort: Effort) -> Tally {
    let mut tally = Tally::new(
        "bar with a martensitic transformation (Landau, sixth power), cooled, pulled, pressed",
    );
    let steps = effort.of([10, 60, 20_000]);
    let bar = Landau {
        a: 4.0,
        b: 1.2e5,
        d: 2.4e7,
        theta_0: 280.0,
        capacity: 10.0,
        length: 1.0,
    };
    for scheme in EXACT {
        for (theta, speed, step) in [
            (320.0, 0.5, 0.01),
            (320.0, 3.0, 0.05),
            (281.0, 0.1, 0.02),
            (285.0, 0.0, 0.05),
            (250.0, 1.0, 0.1),
            (250.0, 0.01, 0.5),
        ] {
            let spring = |world: &mut World<2>, ends| {
                let spring = world.warm(bar, ends, theta);
                let cold = world.reservoir(240.0);
                world.cool(spring, cold, 5.0);
            };
            let world = on_anchor(spring, [1.001, 0.0], [speed, 0.01]);
            let mut watched = world.start(scheme, step).expect("a sound scene");
            let label = format!("{theta} K, {speed} m/s, h = {step}, {}", scheme.name());
            tally.add(&label, watched.steps(steps));
            if scheme == Scheme::EemEntropy && watched.record.refused.is_none() {
                tally.note(format!(
                    "{label}: ends at strain {:.3}",
                    length(&watched) - 1.0
                ));
            }
        }
    }
    tally
}

fn length(watched: &Watched<2>) -> f64 {
    let q = &watched.stored().positions;
    q[2].value().hypot(q[3].value())
}

/// A gas below and above its critical temperature 8a/27bR under the weight of a piston.
fn van_der_waals_piston(effort: Effort) -> Tally {
    let mut tally = Tally::new("piston on a van der Waals gas, through the spinodal");
    let steps = effort.of([10, 60, 20_000]);
    // Critical: λ = 3b = 0.3 m, θ = 8a/27bR = 296 K, pressure a/27b² = 370 N; at 260 K it boils at
    // about 220 N.
    let gas = VanDerWaals {
        gas: 1.0,
        covolume: 0.1,
        cohesion: 100.0,
        capacity: 20.0,
        theta_ref: 300.0,
    };
    for scheme in EXACT {
        for (lambda, theta, speed, step) in [
            (1.0, 290.0, -2.0, 0.01),
            (0.8, 260.0, 0.0, 0.02),
            (0.35, 270.0, -0.5, 0.02),
            (0.3, 250.0, 0.5, 0.05),
            (0.13, 250.0, 6.0, 0.01),
            (0.5, 320.0, -3.0, 0.1),
        ] {
            let spring = |world: &mut World<2>, ends| {
                let spring = world.warm(gas, ends, theta);
                let bath = world.reservoir(260.0);
                world.cool(spring, bath, 10.0);
            };
            let mut world = on_anchor(spring, [lambda, 0.0], [speed, 0.0]);
            world.set_gravity([-220.0, 0.0]);
            let mut watched = world.start(scheme, step).expect("a sound scene");
            let label = format!("{lambda} m, {theta} K, h = {step}, {}", scheme.name());
            tally.add(&label, watched.steps(steps));
            if scheme == Scheme::EemEntropy && watched.record.refused.is_none() {
                tally.note(format!("{label}: ends at {:.3} m", length(&watched)));
            }
        }
    }
    tally
}

fn springs_past_their_peak(effort: Effort) -> Tally {
    let mut tally =
        Tally::new("Morse bonds pulled past the peak of their force, by a load and by speed");
    let steps = effort.of([10, 60, 10_000]);
    let bond = Morse {
        depth: 10.0,
        steepness: 3.0,
        length: 1.0,
    };
    for scheme in EXACT {
        // The peak is depth · steepness/2 = 15 N; the bond breaks at a speed of √(2 · 10).
        for (load, speed, step) in [
            (14.0, 0.0, 0.05),
            (15.0, 0.0, 0.05),
            (16.0, 0.0, 0.05),
            (0.0, 4.4, 0.05),
            (0.0, 4.5, 0.05),
            (0.0, 4.5, 0.5),
            (0.0, -4.0, 0.1),
            (100.0, 0.0, 0.2),
        ] {
            let mut world = World::<2>::new();
            let anchor = world.anchor([0.0; 2]);
            let mass = world.mass(1.0, [1.0, 0.0], [speed, 0.001]);
            world.spring(bond, [anchor, mass]);
            world.force(mass, move |t| [load * (0.2 * t).min(1.0), 0.0]);
            let mut watched = world.start(scheme, step).expect("a sound scene");
            let label = format!("{load} N, {speed} m/s, h = {step}, {}", scheme.name());
            tally.add(label, watched.steps(steps));
        }
    }
    tally
}

/// Two bars that meet at a joint which is pressed through the line between their anchors (von Mises 1923).
fn snap_through(effort: Effort) -> Tally {
    let mut tally = Tally::new("von Mises truss pressed through");
    let steps = effort.of([10, 60, 10_000]);
    let bar = hooke(1000.0, 1.0);
    for scheme in EXACT {
        for (load, step) in [(10.0, 0.01), (20.0, 0.01), (60.0, 0.1), (60.0, 1.0)] {
            let mut world = World::<2>::new();
            let anchors = [-1.0, 1.0].map(|x: f64| world.anchor([0.97 * x, 0.0]));
            let joint = world.mass(1.0, [0.0, 0.243_104_9], [0.0; 2]);
            for anchor in anchors {
                world.spring(bar, [anchor, joint]);
            }
            world.force(joint, move |t| [1e-3, -load * t.min(1.0)]);
            let mut watched = world.start(scheme, step).expect("a sound scene");
            let label = format!("{load} N, h = {step}, {}", scheme.name());
            tally.add(&label, watched.steps(steps));
        }
    }
    tally
}

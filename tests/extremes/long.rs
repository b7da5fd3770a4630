//! Kind 7: many steps, and motions that are known for what they return to.

use core::f64::consts::PI;

use eem::prelude::*;

use super::findings::{on_anchor, sprung, warmed};
use super::models::{Cubic, Gravitation, Thermoelastic};
use super::tally::{Effort, Family, Tally};
use super::watched::{EXACT, FORMS, Watched};
use super::world::World;

pub(crate) const FAMILIES: &[Family] = &[insulated_pendulum, recurrence, ellipses, comets];

fn insulated_pendulum(effort: Effort) -> Tally {
    let steps = effort.of([500, 4000, 10_000_000]);
    let mut tally = Tally::new(format!(
        "insulated thermoelastic pendulum without dashpot, {steps} steps of 0.1 s"
    ));
    for scheme in FORMS {
        let spring = warmed(Thermoelastic::ORDINARY, 300.0);
        let world = on_anchor(spring, [1.3, 0.0], [0.0, 1.0]);
        let mut watched = world.start(scheme, 0.1).expect("a sound scene");
        let start = watched.run.ledger();
        tally.add_complete(scheme.name(), watched.steps(steps));
        let end = watched.run.ledger();
        // Nothing produces entropy: it stays to the last bit.
        let produced = end.entropy - start.entropy;
        tally.claim(
            produced.abs() <= 0.0,
            format!("{}: ΔS = {produced:e} J/K", scheme.name()),
        );
        let off = |of: fn(&Ledger<2>) -> f64| (of(&end) - of(&start)).abs();
        tally.note(format!(
            "{}: |E − E₀| = {:.1e} J of {:.1e} J, |J − J₀|/J₀ = {:.1e}",
            scheme.name(),
            off(|ledger| ledger.energy),
            start.energy,
            off(|ledger| ledger.angular_momentum[2]) / start.angular_momentum[2],
        ));
    }
    tally
}

/// Springs of the chain of Fermi, Pasta, Ulam & Tsingou (1955).
const SPRINGS: u8 = 32;
const SPACING: f64 = 10.0;
/// When mode 1 is back, s, and its share of the energy.
const RETURN: f64 = 9376.0;
const SHARE: [f64; 2] = [0.97, 0.99];

fn chain(scheme: Scheme) -> Watched<1> {
    let mut world = World::<1>::new();
    let place = |i: u8| {
        let x = f64::from(i);
        SPACING * x + (PI * x / f64::from(SPRINGS)).sin()
    };
    let nodes: Vec<Node> = (0..=SPRINGS)
        .map(|i| match i {
            0 => world.anchor([0.0]),
            SPRINGS => world.anchor([SPACING * f64::from(SPRINGS)]),
            _ => world.mass(1.0, [place(i)], [0.0]),
        })
        .collect();
    for ends in nodes.windows(2) {
        world.spring(
            Cubic {
                alpha: 0.25,
                length: SPACING,
            },
            [ends[0], ends[1]],
        );
    }
    world.start(scheme, 0.1).expect("a sound scene")
}

/// The energy of the first mode of the linear chain, up to a factor.
fn first_mode(watched: &Watched<1>) -> f64 {
    let state = watched.stored();
    let shape = |i: u8| (PI * f64::from(i) / f64::from(SPRINGS)).sin();
    let project = |of: &dyn Fn(usize) -> f64| -> f64 {
        (1..SPRINGS).map(|i| of(usize::from(i)) * shape(i)).sum()
    };
    #[expect(clippy::cast_precision_loss, reason = "small numbers")]
    let displacement = project(&|i| state.positions[i].value() - SPACING * i as f64);
    let velocity = project(&|i| state.momenta[i].value());
    let frequency = 2.0 * (PI / (2.0 * f64::from(SPRINGS))).sin();
    velocity.powi(2) + (frequency * displacement).powi(2)
}

fn recurrence(effort: Effort) -> Tally {
    let mut tally = Tally::new("FPUT chain, 32 springs, α = 0.25, sine of amplitude 1, h = 0.1 s");
    let steps = effort.of([20, 200, 95_700]);
    for scheme in [Scheme::EemEntropy] {
        let mut watched = chain(scheme);
        let start = first_mode(&watched);
        let (mut best, mut when) = (0.0, 0.0);
        for _ in 0..steps {
            let Ok(report) = watched.step() else { break };
            let share = first_mode(&watched) / start;
            if (report.time / RETURN - 1.0).abs() < 0.02 && share > best {
                (best, when) = (share, report.time);
            }
        }
        tally.add_complete(scheme.name(), &watched.record);
        if effort == Effort::Long {
            let is_back = (SHARE[0]..=SHARE[1]).contains(&best);
            tally.claim(
                is_back,
                format!("mode 1 has {best} of its energy at {when} s"),
            );
            tally.note(format!(
                "mode 1 is back to {:.1} % at t = {when:.0} s",
                100.0 * best
            ));
        }
    }
    tally
}

/// A planet on an ellipse about its sun, from the perihelion.
fn planet(scheme: Scheme, [distance, speed]: [f64; 2], step: f64) -> Watched<2> {
    let sun = sprung(Gravitation { strength: 1.0 });
    let world = on_anchor(sun, [distance, 0.0], [0.0, speed]);
    world.start(scheme, step).expect("a sound scene")
}

fn ellipses(effort: Effort) -> Tally {
    let mut tally = Tally::new("Kepler's ellipse, e = 0.6, h = 0.001 … 10 s, period 2π s");
    let steps = effort.of([20, 200, 100_000]);
    for scheme in EXACT {
        for step in [0.001, 0.01, 0.05, 0.1, 0.5, 1.0, 10.0] {
            let mut watched = planet(scheme, [0.4, 2.0], step);
            let ledger = watched.run.ledger();
            let [energy, turn] = [ledger.energy + 0.5, ledger.angular_momentum[2] - 0.8];
            tally.claim(
                energy.abs() < 1e-15 && turn.abs() < 1e-15,
                "H = −½ and J = 0.8 at the start",
            );
            let label = format!("h = {step}, {}", scheme.name());
            let record = watched.steps(steps);
            if step < 0.1 {
                tally.add_complete(label, record);
            } else {
                tally.add(label, record);
            }
        }
    }
    tally
}

fn comets(effort: Effort) -> Tally {
    let mut tally = Tally::new("Kepler's ellipse, e = 0.99, h = 1e-5 … 1 s, period 2π s");
    let steps = effort.of([20, 200, 100_000]);
    for scheme in EXACT {
        for exponent in -5..=0 {
            let step = 10.0_f64.powi(exponent);
            let mut watched = planet(scheme, [0.01, 199.0_f64.sqrt()], step);
            tally.add(
                format!("h = {step}, {}", scheme.name()),
                watched.steps(steps),
            );
        }
    }
    tally
}

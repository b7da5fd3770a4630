//! Kind 4: temperatures, conductances and heat capacities over many decades.

use super::findings::{contact, on_anchor, small_capacity, warmed};
use super::models::{Hot, Lattice, ThermoViscoElastic, Thermoelastic};
use super::tally::{Effort, Family, Tally};
use super::watched::{EXACT, FORMS, Watched};
use super::world::World;

pub(crate) const FAMILIES: &[Family] = &[
    temperatures,
    heated_from_cold,
    conductances,
    cooling,
    capacities,
    vanishing_capacities,
];

fn temperatures(effort: Effort) -> Tally {
    let mut tally = Tally::new("thermoelastic pendulum at θ = 1e-6 … 1e8 K, h = 0.1 s");
    let steps = effort.of([5, 30, 10_000]);
    for scheme in EXACT {
        for exponent in -6..=8 {
            let theta = 10.0_f64.powi(exponent);
            // Neither thermal stress nor the heat of extension is more than at 300 K.
            let coupling = 0.1 * (300.0 / theta).min(1.0);
            let model = Thermoelastic {
                theta_ref: theta,
                coupling,
                ..Thermoelastic::ORDINARY
            };
            let spring = |world: &mut World<2>, ends| {
                let spring = world.warm(model, ends, theta);
                let air = world.reservoir(0.9 * theta);
                world.cool(spring, air, 2.0);
            };
            let world = on_anchor(spring, [1.3, 0.0], [0.0, 1.0]);
            let mut watched = world.start(scheme, 0.1).expect("a sound scene");
            let label = format!("θ = 1e{exponent}, {}", scheme.name());
            tally.add_complete(label, watched.steps(steps));
        }
    }
    tally
}

/// The pendulum of García Orden & Romero, with a dashpot, from another temperature and insulated.
fn heated_from_cold(effort: Effort) -> Tally {
    let mut tally =
        Tally::new("published pendulum with dashpot, insulated, from θ = 1e-6 … 1e8 K, h = 0.05 s");
    let steps = effort.of([5, 30, 10_000]);
    for scheme in EXACT {
        for exponent in -6..=8 {
            let theta = 10.0_f64.powi(exponent);
            let model = ThermoViscoElastic {
                theta_ref: theta,
                k1: 0.0,
                mu1: 0.0,
                coupling: 0.1,
                a: 0.1 * theta,
                ..ThermoViscoElastic::PENDULUM
            };
            let spring = warmed(model, theta);
            let world = on_anchor(spring, [3.0, 0.0], [0.0, 1.0]);
            let mut watched = world.start(scheme, 0.05).expect("a sound scene");
            // From 1e-6 K the first Joule of heat multiplies the temperature by a million.
            tally.add(
                format!("θ = 1e{exponent}, {}", scheme.name()),
                watched.steps(steps),
            );
        }
    }
    tally
}

/// The mean of 380 and 310 K, which a constant capacity makes the temperature of balance; K.
const MEAN: f64 = 345.0;
/// `5 ln(345/380) + 5 ln(345/310)`, J/K, with half a unit of its last digit.
const PRODUCED: [f64; 2] = [0.051_726, 5e-7];
/// What rounding does to the mean, relative: a few roundings of θ and, over the steps, of the heat.
const OFF: f64 = 1e-12;

fn conductances(effort: Effort) -> Tally {
    let mut tally = Tally::new("two springs at 380 and 310 K in contact, κh/c = 1e-9 … 1e9");
    let steps = effort.of([10, 50, 10_000]);
    // The steps at which the temperatures of stiff contacts swap for the first time.
    let mut began = Vec::new();
    for scheme in EXACT {
        for exponent in -9..=9 {
            let mut watched = contact(scheme, 10.0_f64.powi(exponent));
            let label = format!("κh/c = 1e{exponent}, {}", scheme.name());
            let start = watched.run.ledger().entropy;
            let mut swaps = Vec::new();
            let mut sign = 1.0;
            for step in 1..=steps {
                if watched.step().is_err() {
                    break;
                }
                let [a, b] = temperatures_of(&watched);
                let mean = 0.5 * (a + b);
                let is_kept = (mean / MEAN - 1.0).abs() < OFF;
                tally.claim(
                    is_kept,
                    format!("{label}: mean of {mean} K after {step} steps"),
                );
                if (a - b) * sign < 0.0 {
                    sign = -sign;
                    swaps.push(step);
                }
                if exponent == 0 && step == 10 {
                    let produced = watched.run.ledger().entropy - start;
                    let is_done = (a - MEAN).abs() < OFF * MEAN * 100.0
                        && (produced - PRODUCED[0]).abs() < PRODUCED[1];
                    tally.claim(is_done, format!("{label}: {a} and {b} K, {produced} J/K"));
                }
            }
            tally.add_swift(&label, &watched.record, scheme);
            if exponent > 0 {
                began.extend(swaps.first().copied());
                let is_each = swaps.len() == watched.record.steps;
                tally.claim(is_each, format!("{label}: {} swaps", swaps.len()));
            }
        }
    }
    if let Some(began) = began.iter().max() {
        tally.note(format!(
            "from κh/c = 10 on the temperatures swap in every step, from step {began} on"
        ));
    }
    tally
}

/// Roundings of the heat of a step that its energy may be off by: those of θ*, of Q and of the two entropies.
const OF_HEAT: f64 = 8.0 * f64::EPSILON;

/// Nothing but heat changes the energy: each step is off by roundings of that heat, however much more the
/// spring contains.
fn cooling(effort: Effort) -> Tally {
    let mut tally = Tally::new("a spring at rest, from 400 K to air of 300 K, hκ/c = 1e-9 … 1e9");
    let steps = effort.of([5, 20, 1000]);
    let (h, air) = (0.1, 300.0);
    for scheme in FORMS {
        for exponent in -9..=9 {
            let model = Thermoelastic {
                coupling: 0.0,
                ..Thermoelastic::ORDINARY
            };
            let conductance = 10.0_f64.powi(exponent) * model.capacity / h;
            let spring = |world: &mut World<2>, ends| {
                let spring = world.warm(model, ends, 400.0);
                let air = world.reservoir(air);
                world.cool(spring, air, conductance);
            };
            let world = on_anchor(spring, [model.length, 0.0], [0.0; 2]);
            let mut watched = world.start(scheme, h).expect("a sound scene");
            let label = format!("hκ/c = 1e{exponent}, {}", scheme.name());
            for _ in 0..steps {
                let old = watched.stored().reservoirs[0];
                if watched.step().is_err() {
                    break;
                }
                let heat = air * (watched.stored().reservoirs[0] - old).value();
                let (defect, allowed) = (watched.record.defect, OF_HEAT * heat.abs());
                tally.claim(
                    defect.abs() <= allowed,
                    format!("{label}: off by {defect:.1e} J, heat of {heat:.1e} J explains {allowed:.1e} J"),
                );
            }
            tally.add_complete(&label, &watched.record);
        }
    }
    tally
}

fn temperatures_of(watched: &Watched<2>) -> [f64; 2] {
    let temperatures = &watched.stored().temperatures;
    [temperatures[0], temperatures[1]]
}

fn capacities(effort: Effort) -> Tally {
    let mut tally = Tally::new("heat capacities 1e-12 … 1e12 J/K, with coupling: circles complete");
    let steps = effort.of([3, 12, 100]);
    for scheme in EXACT {
        for exponent in -12..=12 {
            let capacity = 10.0_f64.powi(exponent);
            let label = format!("c = 1e{exponent}, {}", scheme.name());
            let mut circle = small_capacity(scheme, capacity, 0.0);
            let circular = format!("circle, {label}");
            circle.steps(steps);
            // The entropy form finds a circle with a small capacity from that of the temperature form, after
            // its own start has failed.
            if scheme == eem::Scheme::EemTemperature {
                tally.add_swift(circular, &circle.record, scheme);
            } else {
                tally.add(circular, &circle.record);
            }
            let mut radial = small_capacity(scheme, capacity, 0.5);
            tally.add(format!("radial, {label}"), radial.steps(steps));
        }
    }
    tally
}

fn vanishing_capacities(effort: Effort) -> Tally {
    let mut tally = Tally::new(
        "capacities that vanish at θ → 0: c = a θ³ (Debye), Einstein's, from 1e-6 … 100 K",
    );
    let steps = effort.of([3, 20, 2000]);
    let lattice = Lattice {
        stiffness: 100.0,
        length: 1.0,
        coupling: 1e-3,
        a: 1.0,
    };
    for scheme in EXACT {
        for exponent in -6..=2 {
            let theta = 10.0_f64.powi(exponent);
            let cold = warmed(lattice, theta);
            let oscillators = warmed(
                Hot {
                    capacity: 0.0,
                    ..Hot::FOUND
                },
                theta,
            );
            let scenes = [
                ("Debye", on_anchor(cold, [1.1, 0.0], [0.0, 1.0])),
                ("Einstein", on_anchor(oscillators, [1.1, 0.0], [0.0, 1.0])),
            ];
            for (name, world) in scenes {
                let label = format!("{name}, θ = 1e{exponent}, {}", scheme.name());
                match world.start(scheme, 0.05) {
                    Ok(mut watched) => tally.add(label, watched.steps(steps)),
                    Err(error) => tally.note(format!("{label}: no scene, {error}")),
                }
            }
        }
    }
    tally
}

#[cfg(test)]
#[path = "cancelling.rs"]
mod cancelling;

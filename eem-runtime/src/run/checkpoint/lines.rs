//! The lines of a file with a checkpoint. Each function writes the part `own`, or reads it if `own` is `None`.

use super::file::{Read, Text};
use super::{
    Checkpoint, ElementOutline, Numbers, Outline, SavedChoice, SavedControl, SavedEnergies,
    SavedLoads,
};
use crate::algebra::memory::TooLarge;
use crate::element::meters::Meters;
use crate::element::state::{Energy, State};
use crate::step::automatic::{SchemeSelection, TrialClock};
use crate::step::control::{Controller, StepStatistics, Tolerance};
use crate::step::explicit::SavedExplicit;
use crate::step::newton::NewtonSettings;
use crate::step::solver::SavedPast;

impl Checkpoint {
    /// Writes or reads the whole checkpoint.
    pub(super) fn lines(text: &mut Text<'_>, own: Option<&Self>) -> Read<Self> {
        let newton = own.map(|own| own.newton);
        Ok(Self {
            scheme: text.item("scheme", own.map(|own| own.scheme))?,
            outline: outline(text, own.map(|own| &own.outline))?,
            numbers: numbers(text, own.map(|own| &own.numbers))?,
            step: text.number("step size", own.map(|own| own.step))?,
            newton: NewtonSettings {
                max_iterations: text.item("iterations", newton.map(|own| own.max_iterations))?,
                tolerance: text
                    .number("tolerance of an iteration", newton.map(|own| own.tolerance))?,
            },
            control: text.part("step control", own.map(|own| &own.control), control)?,
            choice: text.part("choice of a scheme", own.map(|own| &own.choice), choice)?,
            state: state(text, own.map(|own| &own.state))?,
            energies: energies(text, own.map(|own| &own.energies))?,
            loads: loads(text, own.map(|own| &own.loads))?,
            past: past(text, own.map(|own| &own.past))?,
            explicit: text.part("explicit", own.map(|own| &own.explicit), explicit)?,
            seals: text.items("digests", own.map(|own| &own.seals[..]))?,
        })
    }
}

fn outline(text: &mut Text<'_>, own: Option<&Outline>) -> Read<Outline> {
    let dashpots = own.map(|own| own.elements.iter().map(|element| element.dashpots));
    let dashpots: Option<Vec<usize>> = dashpots.map(Iterator::collect);
    let are_thermal = own.map(|own| own.elements.iter().map(|element| element.thermal));
    let are_thermal: Option<Vec<bool>> = are_thermal.map(Iterator::collect);
    let dimensions = text.item("dimensions", own.map(|own| own.dimensions))?;
    let anchors = text.items("anchors", own.map(|own| &own.anchors[..]))?;
    let dashpots = text.items("dashpots", dashpots.as_deref())?;
    let are_thermal = text.items("have a temperature", are_thermal.as_deref())?;
    if dashpots.len() != are_thermal.len() {
        return Err(text.fault("have a temperature"));
    }
    let elements = dashpots.into_iter().zip(are_thermal);
    Ok(Outline {
        dimensions,
        anchors,
        elements: elements
            .map(|(dashpots, thermal)| ElementOutline { dashpots, thermal })
            .collect(),
        reservoirs: text.item("reservoirs", own.map(|own| own.reservoirs))?,
    })
}

fn numbers(text: &mut Text<'_>, own: Option<&Numbers>) -> Read<Numbers> {
    Ok(Numbers {
        materials: text.item("digest of materials", own.map(|own| own.materials))?,
        masses: text.item("digest of masses", own.map(|own| own.masses))?,
        conductances: text.item("digest of conductances", own.map(|own| own.conductances))?,
        reservoirs: text.item("digest of reservoirs", own.map(|own| own.reservoirs))?,
        gravity: text.item("digest of gravity", own.map(|own| own.gravity))?,
    })
}

fn control(text: &mut Text<'_>, own: Option<&SavedControl>) -> Read<SavedControl> {
    let tolerance = own.map(|own| {
        let tolerance = own.tolerance;
        [
            tolerance.relative,
            tolerance.position,
            tolerance.momentum,
            tolerance.temperature,
        ]
    });
    let [relative, position, momentum, temperature] = text.array("tolerances", tolerance)?;
    let over = own.map(|own| own.tolerance.over.map(|time| [time]));
    let over = text.few("time of the tolerance", over.as_ref())?;
    let statistics = own.map(|own| &own.statistics);
    Ok(SavedControl {
        tolerance: Tolerance {
            relative,
            position,
            momentum,
            temperature,
            over: over.map(|[time]| time),
        },
        controller: Controller {
            last: text.few(
                "error and size of the last step",
                own.map(|own| &own.controller.last),
            )?,
        },
        statistics: StepStatistics {
            accepted: text.item("accepted", statistics.map(|own| own.accepted))?,
            rejected_by_error: text.item(
                "rejected by error",
                statistics.map(|own| own.rejected_by_error),
            )?,
            rejected_by_newton: text.item(
                "rejected by newton",
                statistics.map(|own| own.rejected_by_newton),
            )?,
            rejected_by_domain: text.item(
                "rejected by domain",
                statistics.map(|own| own.rejected_by_domain),
            )?,
            rejected_by_law: text
                .item("rejected by law", statistics.map(|own| own.rejected_by_law))?,
            changes_of_scheme: text.item(
                "changes of scheme",
                statistics.map(|own| own.changes_of_scheme),
            )?,
            too_large: too_large(text, statistics.map(|own| &own.too_large))?,
        },
        largest_momentum: text.number("largest momentum", own.map(|own| own.largest_momentum))?,
        smallest: text.number("smallest step", own.map(|own| own.smallest))?,
        largest: text.number("largest step", own.map(|own| own.largest))?,
    })
}

fn too_large(text: &mut Text<'_>, own: Option<&Option<TooLarge>>) -> Read<Option<TooLarge>> {
    text.part("missing memory", own, |text, own| {
        let available = own.map(|own| own.available.as_slice());
        let available = text.items("available bytes", available)?;
        Ok(TooLarge {
            unknowns: text.item("unknowns", own.map(|own| own.unknowns))?,
            needed: text.item("needed bytes", own.map(|own| own.needed))?,
            available: available.first().copied(),
        })
    })
}

fn choice(text: &mut Text<'_>, own: Option<&SavedChoice>) -> Read<SavedChoice> {
    Ok(SavedChoice {
        scheme: text.item("scheme in use", own.map(|own| own.scheme))?,
        previous: text.item("scheme before", own.map(|own| own.previous))?,
        selection: selection(text, own.map(|own| &own.selection))?,
    })
}

fn selection(text: &mut Text<'_>, own: Option<&SchemeSelection>) -> Read<SchemeSelection> {
    let clock = |text: &mut Text<'_>, [due, wait]: [&'static str; 2], own: Option<TrialClock>| {
        let waits = own.map(|own| own.wait.map(|wait| [wait]));
        Ok(TrialClock {
            due: text.number(due, own.map(|own| own.due))?,
            wait: text.few(wait, waits.as_ref())?.map(|[wait]| wait),
        })
    };
    let explicit_trials = ["explicit trial due", "wait for an explicit trial"];
    let implicit_trials = ["implicit trial due", "wait for an implicit trial"];
    Ok(SchemeSelection {
        recent_effort: text.number("recent effort", own.map(|own| own.recent_effort))?,
        recent_time: text.number("recent time", own.map(|own| own.recent_time))?,
        steps: text.item("steps", own.map(|own| own.steps))?,
        size: text.number("size of the last step", own.map(|own| own.size))?,
        limited_checks: text.item("limited checks", own.map(|own| own.limited_checks))?,
        failures: text.item("failures", own.map(|own| own.failures))?,
        previous_rate: text.number("effort before", own.map(|own| own.previous_rate))?,
        previous_step: text.number("step before", own.map(|own| own.previous_step))?,
        is_on_trial: text.item("on trial", own.map(|own| own.is_on_trial))?,
        tried_at: text.number("tried at", own.map(|own| own.tried_at))?,
        spent: text.number("spent", own.map(|own| own.spent))?,
        explicit_trials: clock(text, explicit_trials, own.map(|own| own.explicit_trials))?,
        implicit_trials: clock(text, implicit_trials, own.map(|own| own.implicit_trials))?,
        failed_trials: text.item("failed trials", own.map(|own| own.failed_trials))?,
    })
}

fn state(text: &mut Text<'_>, own: Option<&State>) -> Read<State> {
    let positions = ["positions", "compensations of positions"];
    let momenta = ["momenta", "compensations of momenta"];
    let velocities = ["velocities", "compensations of velocities"];
    let viscous = ["viscous stretches", "compensations of viscous stretches"];
    let entropies = ["entropies", "compensations of entropies"];
    let received = [
        "reservoir entropies",
        "compensations of reservoir entropies",
    ];
    Ok(State {
        time: text.sum("time", own.map(|own| own.time))?,
        positions: text.sums(positions, own.map(|own| &own.positions))?,
        momenta: text.sums(momenta, own.map(|own| &own.momenta))?,
        velocities: text.sums(velocities, own.map(|own| &own.velocities))?,
        viscous: text.sums(viscous, own.map(|own| &own.viscous))?,
        entropies: text.sums(entropies, own.map(|own| &own.entropies))?,
        temperatures: text.numbers("temperatures", own.map(|own| &own.temperatures[..]))?,
        energies: Vec::new(),
        reservoir_entropies: text.sums(received, own.map(|own| &own.reservoir_entropies))?,
        work: text.sum("work", own.map(|own| own.work))?,
        heat: text.sum("heat", own.map(|own| own.heat))?,
        thermostat_entropy: text.sum(
            "entropy of thermostats",
            own.map(|own| own.thermostat_entropy),
        )?,
        dissipated: text.sum("lost heat", own.map(|own| own.dissipated))?,
        meters: meters(text, own.map(|own| &own.meters))?,
    })
}

fn meters(text: &mut Text<'_>, own: Option<&Meters>) -> Read<Meters> {
    let dissipated = ["heat of dashpots", "compensations of heat of dashpots"];
    let produced = ["entropy production", "compensations of entropy production"];
    let conducted = ["conducted heat", "compensations of conducted heat"];
    Ok(Meters {
        are_on: text.item("meters", own.map(|own| own.are_on))?,
        dissipated: text.sums(dissipated, own.map(|own| &own.dissipated))?,
        produced: text.sums(produced, own.map(|own| &own.produced))?,
        conducted: text.sums(conducted, own.map(|own| &own.conducted))?,
    })
}

fn energies(text: &mut Text<'_>, own: Option<&SavedEnergies>) -> Read<SavedEnergies> {
    let of = text.item("digest of the state", own.map(|own| own.of))?;
    let own = own.map(SavedEnergies::numbers);
    let numbers = text.numbers("energies", own.as_deref())?;
    let (energies, []) = numbers.as_chunks() else {
        return Err(text.fault("energies"));
    };
    let list = energies
        .iter()
        .map(|&numbers| Energy::of(numbers))
        .collect();
    Ok(SavedEnergies { of, list })
}

fn loads(text: &mut Text<'_>, own: Option<&SavedLoads>) -> Read<SavedLoads> {
    Ok(SavedLoads {
        forced: text.items("nodes with a force", own.map(|own| &own.forced[..]))?,
        forces: text.numbers("forces on them", own.map(|own| &own.forces[..]))?,
        moved: text.items("moved anchors", own.map(|own| &own.moved[..]))?,
        velocities: text.numbers("velocities of them", own.map(|own| &own.velocities[..]))?,
        held: text.items("thermostats", own.map(|own| &own.held[..]))?,
        temperatures: text.numbers("temperatures of them", own.map(|own| &own.temperatures[..]))?,
    })
}

fn past(text: &mut Text<'_>, own: Option<&SavedPast>) -> Read<SavedPast> {
    Ok(SavedPast {
        forces: [
            text.numbers("last forces", own.map(|own| &own.forces[0][..]))?,
            text.numbers("earlier forces", own.map(|own| &own.forces[1][..]))?,
        ],
        errors: text.array("errors of forces", own.map(|own| own.errors))?,
        internal: text.numbers("start of the last step", own.map(|own| &own.internal[..]))?,
    })
}

fn explicit(text: &mut Text<'_>, own: Option<&SavedExplicit>) -> Read<SavedExplicit> {
    Ok(SavedExplicit {
        is_new: text.item("new", own.map(|own| own.is_new))?,
        state: text.item("digest of the explicit state", own.map(|own| own.state))?,
        is_motion_first: text.item("motion first", own.map(|own| own.is_motion_first))?,
        targets: text.pairs("targets", own.map(|own| &own.targets[..]))?,
        shares: text.pairs("shares of reservoirs", own.map(|own| &own.shares[..]))?,
        largest_momentum: text.number(
            "largest explicit momentum",
            own.map(|own| own.largest_momentum),
        )?,
        residue: text.number("residue", own.map(|own| own.residue))?,
        rates: text.numbers("rates", own.map(|own| &own.rates[..]))?,
        loads: text.numbers("loads", own.map(|own| &own.loads[..]))?,
    })
}

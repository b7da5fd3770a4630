//! The lines of a file with a checkpoint. Each function writes its part, or reads it over one of any content.

use super::file::{Read, Text};
use super::{
    Checkpoint, ElementOutline, Numbers, Outline, SavedChoice, SavedControl, SavedEnergies,
    SavedLoads,
};
use crate::algebra::memory::TooLarge;
use crate::element::meters::Meters;
use crate::element::state::{Energy, State};
use crate::step::automatic::{SchemeSelection, TrialClock};
use crate::step::control::{StepStatistics, Tolerance};
use crate::step::explicit::SavedExplicit;
use crate::step::newton::NewtonSettings;
use crate::step::scheme::Scheme;
use crate::step::solver::SavedPast;
use eem_material::number::compensated::{Compensated, Sum};
use eem_material::number::digest::Digest;

impl Checkpoint {
    /// One of nothing, to be read.
    pub(super) fn blank() -> Self {
        let digest = Digest::of(|_| {});
        let (sum, sums) = (Sum::new(0.0), || Compensated::new(Vec::new()));
        Self {
            scheme: Scheme::Auto,
            outline: Outline {
                dimensions: 0,
                anchors: Vec::new(),
                elements: Vec::new(),
                reservoirs: 0,
            },
            numbers: Numbers {
                materials: digest,
                masses: digest,
                conductances: digest,
                reservoirs: digest,
                gravity: digest,
            },
            step: 0.0,
            newton: NewtonSettings::default(),
            control: None,
            choice: None,
            state: State {
                time: sum,
                positions: sums(),
                momenta: sums(),
                velocities: sums(),
                viscous: sums(),
                entropies: sums(),
                temperatures: Vec::new(),
                energies: Vec::new(),
                reservoir_entropies: sums(),
                work: sum,
                heat: sum,
                thermostat_entropy: sum,
                dissipated: sum,
                meters: Meters::default(),
            },
            energies: SavedEnergies {
                of: digest,
                list: Vec::new(),
            },
            loads: SavedLoads::default(),
            past: SavedPast::none(),
            explicit: None,
            seals: Vec::new(),
        }
    }

    /// Writes or reads the whole checkpoint.
    pub(super) fn lines(&mut self, text: &mut Text<'_>) -> Read {
        text.item("scheme", &mut self.scheme)?;
        outline(text, &mut self.outline)?;
        numbers(text, &mut self.numbers)?;
        text.number("step size", &mut self.step)?;
        text.item("iterations", &mut self.newton.max_iterations)?;
        text.number("tolerance of an iteration", &mut self.newton.tolerance)?;
        let blank = SavedControl::new(Tolerance::default());
        text.part("step control", &mut self.control, blank, control)?;
        let blank = SavedChoice {
            scheme: Scheme::Auto,
            previous: Scheme::Auto,
            selection: SchemeSelection::new(),
        };
        text.part("choice of a scheme", &mut self.choice, blank, choice)?;
        state(text, &mut self.state)?;
        energies(text, &mut self.energies)?;
        loads(text, &mut self.loads)?;
        past(text, &mut self.past)?;
        let blank = SavedExplicit {
            is_new: false,
            state: Digest::of(|_| {}),
            is_motion_first: false,
            targets: Vec::new(),
            shares: Vec::new(),
            largest_momentum: 0.0,
            residue: 0.0,
            rates: Vec::new(),
            loads: Vec::new(),
        };
        text.part("explicit", &mut self.explicit, blank, explicit)?;
        text.items("digests", &mut self.seals)
    }
}

fn outline(text: &mut Text<'_>, own: &mut Outline) -> Read {
    let (mut dashpots, mut are_thermal) = (Vec::new(), Vec::new());
    for element in own.elements.drain(..) {
        dashpots.push(element.dashpots);
        are_thermal.push(element.thermal);
    }
    text.item("dimensions", &mut own.dimensions)?;
    text.items("anchors", &mut own.anchors)?;
    text.items("dashpots", &mut dashpots)?;
    text.items("have a temperature", &mut are_thermal)?;
    if dashpots.len() != are_thermal.len() {
        return Err(text.fault("have a temperature"));
    }
    for (dashpots, thermal) in dashpots.into_iter().zip(are_thermal) {
        own.elements.push(ElementOutline { dashpots, thermal });
    }
    text.item("reservoirs", &mut own.reservoirs)
}

fn numbers(text: &mut Text<'_>, own: &mut Numbers) -> Read {
    text.item("digest of materials", &mut own.materials)?;
    text.item("digest of masses", &mut own.masses)?;
    text.item("digest of conductances", &mut own.conductances)?;
    text.item("digest of reservoirs", &mut own.reservoirs)?;
    text.item("digest of gravity", &mut own.gravity)
}

fn control(text: &mut Text<'_>, own: &mut SavedControl) -> Read {
    let Tolerance {
        relative,
        position,
        momentum,
        temperature,
        over,
    } = &mut own.tolerance;
    text.array(
        "tolerances",
        &mut [relative, position, momentum, temperature],
    )?;
    text.maybe("time of the tolerance", over)?;
    text.few("error and size of the last step", &mut own.controller.last)?;
    let StepStatistics {
        accepted,
        rejected_by_error,
        rejected_by_newton,
        rejected_by_domain,
        rejected_by_law,
        changes_of_scheme,
        too_large,
    } = &mut own.statistics;
    text.item("accepted", accepted)?;
    text.item("rejected by error", rejected_by_error)?;
    text.item("rejected by newton", rejected_by_newton)?;
    text.item("rejected by domain", rejected_by_domain)?;
    text.item("rejected by law", rejected_by_law)?;
    text.item("changes of scheme", changes_of_scheme)?;
    let blank = TooLarge {
        unknowns: 0,
        needed: 0,
        available: None,
    };
    text.part("missing memory", too_large, blank, |text, own| {
        let mut available = own.available.as_slice().to_vec();
        text.items("available bytes", &mut available)?;
        own.available = available.first().copied();
        text.item("unknowns", &mut own.unknowns)?;
        text.item("needed bytes", &mut own.needed)
    })?;
    text.number("largest momentum", &mut own.largest_momentum)?;
    text.number("smallest step", &mut own.smallest)?;
    text.number("largest step", &mut own.largest)
}

fn choice(text: &mut Text<'_>, own: &mut SavedChoice) -> Read {
    text.item("scheme in use", &mut own.scheme)?;
    text.item("scheme before", &mut own.previous)?;
    let own = &mut own.selection;
    text.number("recent effort", &mut own.recent_effort)?;
    text.number("recent time", &mut own.recent_time)?;
    text.item("steps", &mut own.steps)?;
    text.number("size of the last step", &mut own.size)?;
    text.item("limited checks", &mut own.limited_checks)?;
    text.item("failures", &mut own.failures)?;
    text.number("effort before", &mut own.previous_rate)?;
    text.number("step before", &mut own.previous_step)?;
    text.item("on trial", &mut own.is_on_trial)?;
    text.number("tried at", &mut own.tried_at)?;
    text.number("spent", &mut own.spent)?;
    let TrialClock { due, wait } = &mut own.explicit_trials;
    text.number("explicit trial due", due)?;
    text.maybe("wait for an explicit trial", wait)?;
    let TrialClock { due, wait } = &mut own.implicit_trials;
    text.number("implicit trial due", due)?;
    text.maybe("wait for an implicit trial", wait)?;
    text.item("failed trials", &mut own.failed_trials)
}

fn state(text: &mut Text<'_>, own: &mut State) -> Read {
    let positions = ["positions", "compensations of positions"];
    let momenta = ["momenta", "compensations of momenta"];
    let velocities = ["velocities", "compensations of velocities"];
    let viscous = ["viscous stretches", "compensations of viscous stretches"];
    let entropies = ["entropies", "compensations of entropies"];
    let received = [
        "reservoir entropies",
        "compensations of reservoir entropies",
    ];
    text.sum("time", &mut own.time)?;
    text.sums(positions, &mut own.positions)?;
    text.sums(momenta, &mut own.momenta)?;
    text.sums(velocities, &mut own.velocities)?;
    text.sums(viscous, &mut own.viscous)?;
    text.sums(entropies, &mut own.entropies)?;
    text.numbers("temperatures", &mut own.temperatures)?;
    text.sums(received, &mut own.reservoir_entropies)?;
    text.sum("work", &mut own.work)?;
    text.sum("heat", &mut own.heat)?;
    text.sum("entropy of thermostats", &mut own.thermostat_entropy)?;
    text.sum("lost heat", &mut own.dissipated)?;
    let own = &mut own.meters;
    let dissipated = ["heat of dashpots", "compensations of heat of dashpots"];
    let produced = ["entropy production", "compensations of entropy production"];
    let conducted = ["conducted heat", "compensations of conducted heat"];
    text.item("meters", &mut own.are_on)?;
    text.sums(dissipated, &mut own.dissipated)?;
    text.sums(produced, &mut own.produced)?;
    text.sums(conducted, &mut own.conducted)
}

fn energies(text: &mut Text<'_>, own: &mut SavedEnergies) -> Read {
    text.item("digest of the state", &mut own.of)?;
    let mut numbers = own.numbers();
    text.numbers("energies", &mut numbers)?;
    let (energies, []) = numbers.as_chunks() else {
        return Err(text.fault("energies"));
    };
    own.list.clear();
    for &numbers in energies {
        own.list.push(Energy::of(numbers));
    }
    Ok(())
}

fn loads(text: &mut Text<'_>, own: &mut SavedLoads) -> Read {
    text.items("nodes with a force", &mut own.forced)?;
    text.numbers("forces on them", &mut own.forces)?;
    text.items("moved anchors", &mut own.moved)?;
    text.numbers("velocities of them", &mut own.velocities)?;
    text.items("thermostats", &mut own.held)?;
    text.numbers("temperatures of them", &mut own.temperatures)
}

fn past(text: &mut Text<'_>, own: &mut SavedPast) -> Read {
    let [last, before] = &mut own.forces;
    text.numbers("last forces", last)?;
    text.numbers("earlier forces", before)?;
    text.array("errors of forces", &mut own.errors.each_mut())?;
    text.numbers("start of the last step", &mut own.internal)
}

fn explicit(text: &mut Text<'_>, own: &mut SavedExplicit) -> Read {
    text.item("new", &mut own.is_new)?;
    text.item("digest of the explicit state", &mut own.state)?;
    text.item("motion first", &mut own.is_motion_first)?;
    text.pairs("targets", &mut own.targets)?;
    text.pairs("shares of reservoirs", &mut own.shares)?;
    text.number("largest explicit momentum", &mut own.largest_momentum)?;
    text.number("residue", &mut own.residue)?;
    text.numbers("rates", &mut own.rates)?;
    text.numbers("loads", &mut own.loads)
}

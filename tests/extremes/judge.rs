//! Whether a step kept the laws, by their definitions from the stored states, with 32 digits.
//!
//! ```text
//! E = Σ p²/2m − Σ m g·q + Σ (ψ(λ, γ, θ) + θ s) + Σ θ_r σ_r + lost heat       s the entropy that is kept
//! S = Σ s + Σ σ_r + entropy of the thermostats          −Q/θ if all have one θ, Q = ΔE − work; else as booked
//!
//! |ΔE − work − heat|          ≤ 64 ε (A + A⁺)
//! ΔS                          ≥ −64 ε² Σ |s|      and −64 ε (A + A⁺)/θ for a thermostat
//! |ΔS − production|            ≤ 64 ε (production + ε Σ |s|)
//! |ΔL − Σ h F|                ≤ 64 ε Σ (|p| + h |f| + h |F|)                without anchors
//! |ΔJ_ij − Σ h (q − o) ∧ F|   ≤ 64 ε Σ (|q − o| (|p| + h |F|) + h λ |f|)    o the one anchor or the origin
//! |s(λ, γ, θ) − s|            ≤ 4 ε (|s|₊ + Σ |∂s/∂x| |x| + c)              x = λ, γ;  |s|₊ the magnitude of its terms
//!
//! A  = Σ over both ends [T + Σ (|f| λ + Σ |g γ| + |ψ| + θ |s| + c θ)]
//!      + Σ |θ_r Δσ_r| + |work| + |heat| + Σ η Δγ²/h
//! A⁺ = Σ Σ_ij |T_ij| |x_j| |Δx_i|      T = ∂(f*, −g*, θ*)/∂x¹,  x = (λ, γ, θ),  Δx = (Δλ, Δγ, Δs)
//! ```
//!
//! A is what the terms of the balance round by in units of ε, A⁺ the work of what the arguments of the
//! forces round by; T is that of the temperature form, which every model has in closed form. Angular momentum is
//! judged in every plane i < j of the D axes. The laws of momenta need the impulses of loads, which the judge knows
//! of schemes that have one force at the middle of a step.

mod books;
mod momenta;
mod refusal;

pub(crate) use refusal::explained;

use eem::StepReport;

use self::momenta::momenta;
use super::digits::Digits;
use super::element::{self, Ends};
use super::rounding::{ROUNDINGS, share, worse};
use super::stored::Stored;
use super::world::Facts;

/// Roundings of the entropy that is kept, in the units of its law.
const KEPT: f64 = 4.0;
/// How much larger than the rounding of the energies of a step its bound may be without saying so.
const WIDE: f64 = 100.0;
/// By how much the judge's sum of the energies' terms may differ from that of the report: rounding, also of forces
/// at a millionth of their limit.
const SAME: f64 = 1.0 + 1e-6;

/// What the judge found of one step.
#[derive(Clone, Debug)]
pub(crate) struct Verdict {
    /// ΔE − work − heat and what rounding may do to it, J.
    pub(crate) defect: f64,
    pub(crate) bound: f64,
    /// ΔS of the states, J/K.
    pub(crate) entropy: f64,
    /// The largest defect of a momentum, in ε of its terms.
    pub(crate) momentum: f64,
    /// Whether the bound of the report is more than [`WIDE`] times that of the energies' terms.
    pub(crate) is_wide: bool,
    /// The laws that are broken, in words.
    pub(crate) broken: Vec<String>,
}

/// What is broken so far.
struct Complaints {
    time: f64,
    broken: Vec<String>,
}

impl Complaints {
    fn hold(&mut self, law: &str, defect: f64, bound: f64) {
        // A NaN is within no bound, and bounds nothing.
        let is_kept = defect <= bound;
        if !is_kept {
            let time = self.time;
            self.broken.push(format!(
                "t = {time:e}: {law} {defect:.5e} above {bound:.5e}"
            ));
        }
    }
}

impl Complaints {
    /// Holds a step to the laws of entropy, given its report and the defect and the bound of its energy; returns ΔS.
    fn hold_entropy<const D: usize>(
        &mut self,
        facts: &Facts<D>,
        states: [&Stored; 2],
        elements: &[Ends<'_>],
        (report, defect, bound): (&StepReport, Digits, f64),
    ) -> f64 {
        let booked = states[1].thermostats - states[0].thermostats;
        let received = match books::temperatures(facts, states[0].time, report.step) {
            Some([least, most]) if least >= most => {
                let heat = states[1].heat - states[0].heat + defect;
                -(heat / least)
            }
            _ => booked,
        };
        let (entropy, magnitude) = entropy_change(states, received);
        // The heat of a thermostat is what the balance of energy leaves, with its rounding.
        let kept = facts
            .kept
            .iter()
            .filter_map(|&(index, _)| elements[index].theta);
        let kept: f64 = kept.map(|theta| bound / theta[0].min(theta[1])).sum();
        let ovens = facts.ovens.iter().map(|theta| bound / theta(report.time));
        let thermostats = kept + ovens.sum::<f64>();
        let rounding = ROUNDINGS * f64::EPSILON.powi(2) * magnitude;
        self.hold("entropy lost", -entropy, rounding + thermostats);
        self.hold(
            "production of a part below zero by",
            -report.least_production,
            0.0,
        );
        let is_closed = facts.kept.is_empty() && facts.ovens.is_empty();
        if report.bound > 0.0 && is_closed && !element::has_cold_dashpots(facts) {
            let off = (entropy - report.production).abs();
            let parts = ROUNDINGS * f64::EPSILON * report.production.abs();
            self.hold("reported production is off by", off, parts + rounding);
            let parts = element::count_parts(facts);
            let whole = report.production * (1.0 + ROUNDINGS * f64::EPSILON) + rounding;
            let all = report.least_production * parts;
            self.hold("least production of all parts", all, whole);
        }
        entropy
    }
}

/// Judges a step from `before` to `after` that an exact scheme reported.
pub(crate) fn check_step<const D: usize>(
    facts: &Facts<D>,
    before: &Stored,
    after: &Stored,
    report: &StepReport,
) -> Verdict {
    let elements = element::ends(facts, [before, after]);
    let mut complaints = Complaints {
        time: report.time,
        broken: Vec::new(),
    };
    let exact_defect = energy_change(facts, [before, after], &elements);
    let mut defect = exact_defect.value();
    let mut bound = energy_bound(facts, [before, after], &elements, report.step);
    // A length beyond the end of a model by its rounding: only the rounded one has an energy.
    let is_beyond = defect.is_nan() && report.defect.is_finite();
    if is_beyond {
        (defect, bound) = (report.defect, report.bound);
    }
    // A step proves what it reports: at most WIDE times the rounding of its energies, or it says so.
    complaints.hold("energy is off by", defect.abs(), bound.max(report.bound));
    if report.bound > 0.0 {
        complaints.hold(
            "energy beyond the reported bound by",
            defect.abs(),
            report.bound,
        );
        complaints.hold("reported defect", report.defect.abs(), report.bound);
    }
    let energies = energies(facts, [before, after], &elements, report.step);
    let energies = ROUNDINGS * f64::EPSILON * energies;
    let is_wide = report.is_bound_wide;
    // Where anchors move, and in dashpots in parallel, forces within a step may be larger than at its ends.
    let has_known_forces =
        facts.motions.is_empty() && elements.iter().all(Ends::has_forces_of_ends);
    if has_known_forces && !(is_wide || is_beyond || facts.has_halves) {
        complaints.hold("bound without a flag", report.bound, SAME * WIDE * energies);
    }
    let lacking = if is_beyond {
        Digits::ZERO
    } else {
        exact_defect
    };
    let of_energy = (report, lacking, bound);
    let entropy = complaints.hold_entropy(facts, [before, after], &elements, of_energy);
    complaints.hold_books(facts, [before, after], &elements, (report.step, bound));
    let mut momentum = 0.0;
    for law in momenta(facts, [before, after], &elements, report.step) {
        complaints.hold(&format!("{} is off by", law.law), law.defect, law.bound);
        momentum = worse(momentum, share(law.defect, f64::EPSILON * law.terms));
    }
    for ends in elements.iter().filter(|ends| ends.theta.is_some()) {
        let (defect, unit) = ends.kept_entropy();
        complaints.hold("kept entropy is off by", defect, KEPT * f64::EPSILON * unit);
    }
    let broken = complaints.broken;
    Verdict {
        defect,
        bound,
        entropy,
        momentum,
        is_wide,
        broken,
    }
}

/// ΔE − work − heat.
fn energy_change<const D: usize>(
    facts: &Facts<D>,
    states: [&Stored; 2],
    elements: &[Ends<'_>],
) -> Digits {
    let mut change = Digits::ZERO;
    for (node, mass) in facts.masses.iter().enumerate() {
        let Some(mass) = *mass else { continue };
        let [p0, p1] = states.map(|state| state.momentum::<D>(node));
        let [q0, q1] = states.map(|state| state.position::<D>(node));
        for axis in 0..D {
            // p¹² − p⁰² as a product keeps the digits of a small change.
            let squares = (p1[axis] - p0[axis]) * (p1[axis] + p0[axis]);
            change = change + squares / (Digits::from(mass) * 2.0);
            change = change - (q1[axis] - q0[axis]) * Digits::from(mass) * facts.gravity[axis];
        }
    }
    for ends in elements {
        change = change + ends.energy(1) - ends.energy(0);
    }
    let reservoirs = facts.reservoirs.iter().enumerate();
    for (index, &theta) in reservoirs {
        change = change + (states[1].reservoirs[index] - states[0].reservoirs[index]) * theta;
    }
    let booked = |of: fn(&Stored) -> Digits| of(states[1]) - of(states[0]);
    change + booked(|state| state.lost) - booked(|state| state.work) - booked(|state| state.heat)
}

/// `64 ε (A + A⁺)`.
fn energy_bound<const D: usize>(
    facts: &Facts<D>,
    states: [&Stored; 2],
    elements: &[Ends<'_>],
    step: f64,
) -> f64 {
    let mut amplitude = energies(facts, states, elements, step);
    for (node, mass) in facts.masses.iter().enumerate() {
        let Some(mass) = *mass else { continue };
        let [q0, q1] = states.map(|state| state.position::<D>(node));
        for axis in 0..D {
            amplitude += (mass * facts.gravity[axis] * (q1[axis] - q0[axis]).value()).abs();
        }
    }
    let middle = states[0].time + 0.5 * step;
    for (node, force) in &facts.forces {
        let [q0, q1] = states.map(|state| state.position::<D>(*node));
        let force = force(middle);
        for axis in 0..D {
            amplitude += (force[axis] * (q1[axis] - q0[axis]).value()).abs();
        }
    }
    amplitude += elements.iter().map(|ends| ends.way(step)).sum::<f64>();
    for (index, &theta) in facts.reservoirs.iter().enumerate() {
        let change = states[1].reservoirs[index] - states[0].reservoirs[index];
        amplitude += (theta * change.value()).abs();
    }
    let booked = |of: fn(&Stored) -> Digits| (of(states[1]) - of(states[0])).value().abs();
    amplitude += booked(|state| state.work) + booked(|state| state.heat);
    ROUNDINGS * f64::EPSILON * amplitude
}

/// `Σ over both ends [T + Σ (|f| λ + Σ|g γ| + |ψ| + θ |s| + c θ)]`.
fn energies<const D: usize>(
    facts: &Facts<D>,
    states: [&Stored; 2],
    elements: &[Ends<'_>],
    step: f64,
) -> f64 {
    let kinetic = |(node, mass): (usize, &Option<f64>)| {
        let mass = (*mass)?;
        let of = |state: &Stored| {
            let p = state.momentum::<D>(node).map(Digits::value);
            p.iter().map(|p| p / (mass + mass) * p).sum::<f64>()
        };
        Some(states.map(of).iter().sum::<f64>())
    };
    let kinetic: f64 = facts.masses.iter().enumerate().filter_map(kinetic).sum();
    kinetic + elements.iter().map(|ends| ends.energies(step)).sum::<f64>()
}

/// ΔS of the states and of the thermostats, which received this much, and Σ |s|.
fn entropy_change(states: [&Stored; 2], received: Digits) -> (f64, f64) {
    let terms = |state: &Stored| {
        let lists = state.entropies.iter().chain(&state.reservoirs);
        lists.copied().collect::<Vec<_>>()
    };
    let [old, new] = states.map(terms);
    let change: Digits = old.iter().zip(&new).map(|(&old, &new)| new - old).sum();
    let magnitude: f64 = new.iter().map(|s| s.value().abs()).sum();
    let thermostats = states[1].thermostats.value().abs();
    ((change + received).value(), magnitude + thermostats)
}

#[cfg(test)]
#[path = "judge_tests.rs"]
mod tests;

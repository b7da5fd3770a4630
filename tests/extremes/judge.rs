//! Whether a step kept the laws, by their definitions from the stored states, with 32 digits.
//!
//! ```text
//! E = Σ p²/2m − Σ m g·q + Σ (ψ(λ, γ, θ) + θ s) + Σ θ_r σ_r + lost heat       s the entropy that is kept
//! S = Σ s + Σ σ_r + entropy of the thermostats
//!
//! |ΔE − work − heat|          ≤ 64 ε (A + A⁺)
//! ΔS                          ≥ −64 ε² Σ |s|      and −64 ε (A + A⁺)/θ for a thermostat
//! |ΔS − production|            ≤ 64 ε (production + ε Σ |s|)
//! |ΔL − Σ h F|                ≤ 64 ε Σ (|p| + h |f| + h |F|)                without anchors
//! |ΔJ − Σ h (q − o) × F|      ≤ 64 ε Σ (|q − o| (|p| + h |F|) + h λ |f|)    o the one anchor or the origin
//! |s(λ, γ, θ) − s|            ≤ 4 ε (|s| + Σ |∂s/∂x| |x| + c)               x = λ, γ
//!
//! A  = Σ over both ends [T + Σ (|f| λ + Σ |g γ| + |ψ| + θ |s| + c θ)]
//!      + Σ |θ_r Δσ_r| + |work| + |heat| + Σ η Δγ²/h
//! A⁺ = Σ Σ_ij |T_ij| |x_j| |Δx_i|      T = ∂(f*, −g*, θ*)/∂x¹,  x = (λ, γ, θ),  Δx = (Δλ, Δγ, Δs)
//! ```
//!
//! A is what the terms of the balance round by in units of ε, A⁺ the work of what the arguments of the
//! forces round by; T is that of the temperature form, which every model has in closed form.

use eem::StepReport;

use super::digits::Digits;
use super::element::{self, Ends};
use super::stored::Stored;
use super::world::Facts;

/// Roundings that the bounds allow in the place of the eight that were ever seen.
pub(crate) const ROUNDINGS: f64 = 64.0;
/// Roundings of the entropy that is kept, in the units of its law.
const KEPT: f64 = 4.0;
/// How much larger than the judge's the bound of a report may be. Both follow one formula; T is that of
/// the scheme there and that of the temperature form here.
const BOUNDS: f64 = 64.0;

/// What the judge found of one step.
#[derive(Clone, Debug)]
pub(crate) struct Verdict {
    /// ΔE − work − heat and what rounding may do to it, J.
    pub(crate) defect: f64,
    pub(crate) bound: f64,
    /// ΔS of the states, J/K.
    pub(crate) entropy: f64,
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
                "t = {time:e}: {law} {defect:.2e} above {bound:.2e}"
            ));
        }
    }
}

/// Judges a step from `before` to `after` that an exact scheme reported.
pub(crate) fn check_step<const D: usize>(
    facts: &Facts<D>,
    before: &Stored,
    after: &Stored,
    report: &StepReport<f64>,
) -> Verdict {
    let elements = element::ends(facts, [before, after]);
    let mut complaints = Complaints {
        time: report.time,
        broken: Vec::new(),
    };
    let defect = energy_change(facts, [before, after], &elements).value();
    let bound = energy_bound(facts, [before, after], &elements, report.step);
    complaints.hold("energy is off by", defect.abs(), bound);
    if report.bound > 0.0 {
        complaints.hold(
            "energy beyond the reported bound by",
            defect.abs(),
            report.bound,
        );
        complaints.hold("reported bound", report.bound, BOUNDS * bound);
        complaints.hold("reported defect", report.defect.abs(), report.bound);
    }
    let (entropy, magnitude) = entropy_change([before, after]);
    // The heat of a thermostat is what the balance of energy leaves, with its rounding.
    let kept = facts.kept.iter().filter_map(|&index| elements[index].theta);
    let thermostats: f64 = kept.map(|theta| bound / theta[0].min(theta[1])).sum();
    let rounding = ROUNDINGS * f64::EPSILON.powi(2) * magnitude;
    complaints.hold("entropy lost", -entropy, rounding + thermostats);
    complaints.hold(
        "production of a part below zero by",
        -report.least_production,
        0.0,
    );
    if report.bound > 0.0 && facts.kept.is_empty() && !element::has_cold_dashpots(facts) {
        let off = (entropy - report.production).abs();
        let parts = ROUNDINGS * f64::EPSILON * report.production.abs();
        complaints.hold("reported production is off by", off, parts + rounding);
    }
    for (law, defect, bound) in momenta(facts, [before, after], &elements, report.step) {
        complaints.hold(law, defect, bound);
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
    let mut amplitude = 0.0;
    for (node, mass) in facts.masses.iter().enumerate() {
        let Some(mass) = *mass else { continue };
        for state in states {
            let p = state.momentum::<D>(node).map(Digits::value);
            amplitude += p.iter().map(|p| p / (mass + mass) * p).sum::<f64>();
        }
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
    amplitude += elements
        .iter()
        .map(|ends| ends.amplitude(step))
        .sum::<f64>();
    for (index, &theta) in facts.reservoirs.iter().enumerate() {
        let change = states[1].reservoirs[index] - states[0].reservoirs[index];
        amplitude += (theta * change.value()).abs();
    }
    let booked = |of: fn(&Stored) -> Digits| (of(states[1]) - of(states[0])).value().abs();
    amplitude += booked(|state| state.work) + booked(|state| state.heat);
    ROUNDINGS * f64::EPSILON * amplitude
}

/// ΔS of the states, and Σ |s|.
fn entropy_change(states: [&Stored; 2]) -> (f64, f64) {
    let terms = |state: &Stored| {
        let lists = state.entropies.iter().chain(&state.reservoirs);
        lists
            .copied()
            .chain([state.thermostats])
            .collect::<Vec<_>>()
    };
    let [old, new] = states.map(terms);
    let change: Digits = old.iter().zip(&new).map(|(&old, &new)| new - old).sum();
    let magnitude = new.iter().map(|s| s.value().abs()).sum();
    (change.value(), magnitude)
}

/// The laws of momentum that the scene has: name, defect, bound.
fn momenta<const D: usize>(
    facts: &Facts<D>,
    states: [&Stored; 2],
    elements: &[Ends<'_>],
    step: f64,
) -> Vec<(&'static str, f64, f64)> {
    let anchors: Vec<usize> = (0..facts.masses.len())
        .filter(|&node| facts.masses[node].is_none())
        .collect();
    let mut laws = Vec::new();
    if anchors.len() > 1 || facts.has_moved_anchors {
        return laws;
    }
    let impulses = impulses(facts, states[0].time, step);
    let forces: f64 = elements.iter().map(Ends::force).sum();
    let moments: f64 = elements
        .iter()
        .map(|ends| ends.force() * ends.length())
        .sum();
    let origin = anchors
        .first()
        .map_or([Digits::ZERO; D], |&node| states[0].position(node));
    let (mut linear, mut angular) = ([Digits::ZERO; D], [Digits::ZERO; 3]);
    let (mut sum_p, mut sum_qp) = (step * forces, step * moments);
    for (node, impulse) in impulses.iter().enumerate() {
        if facts.masses[node].is_none() {
            continue;
        }
        let [p0, p1] = states.map(|state| state.momentum::<D>(node));
        let [r0, r1] = states.map(|state| {
            let q = state.position::<D>(node);
            core::array::from_fn(|axis| q[axis] - origin[axis])
        });
        let impulse: [Digits; D] = impulse.map(Digits::from);
        let middle: [Digits; D] = core::array::from_fn(|axis| (r0[axis] + r1[axis]) * 0.5);
        for axis in 0..D {
            linear[axis] = linear[axis] + p1[axis] - p0[axis] - impulse[axis];
        }
        let [old, new, given] = [cross(&r0, &p0), cross(&r1, &p1), cross(&middle, &impulse)];
        for axis in 0..3 {
            angular[axis] = angular[axis] + new[axis] - old[axis] - given[axis];
        }
        let size = |v: &[Digits; D]| Digits::norm(v).value();
        let sizes = size(&p0) + size(&p1) + size(&impulse);
        sum_p += sizes;
        sum_qp += sizes * size(&r0).max(size(&r1));
    }
    let unit = ROUNDINGS * f64::EPSILON;
    if anchors.is_empty() {
        laws.push(("linear momentum is off by", largest(&linear), unit * sum_p));
    }
    laws.push((
        "angular momentum is off by",
        largest(&angular),
        unit * sum_qp,
    ));
    laws
}

/// `h F` of every node: loads in the middle of the step, and weight.
fn impulses<const D: usize>(facts: &Facts<D>, time: f64, step: f64) -> Vec<[f64; D]> {
    let weight = |mass: &Option<f64>| {
        let mass = mass.unwrap_or(0.0);
        facts.gravity.map(|component| step * mass * component)
    };
    let mut impulses: Vec<[f64; D]> = facts.masses.iter().map(weight).collect();
    for (node, force) in &facts.forces {
        let force = force(time + 0.5 * step);
        for axis in 0..D {
            impulses[*node][axis] += step * force[axis];
        }
    }
    impulses
}

fn cross<const D: usize>(r: &[Digits; D], p: &[Digits; D]) -> [Digits; 3] {
    let at = |v: &[Digits; D], axis: usize| v.get(axis).copied().unwrap_or(Digits::ZERO);
    core::array::from_fn(|axis| {
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        at(r, i) * at(p, j) - at(r, j) * at(p, i)
    })
}

fn largest(v: &[Digits]) -> f64 {
    // A sum keeps a NaN, which a maximum loses.
    v.iter().map(|x| x.value().abs()).sum()
}

#[cfg(test)]
#[path = "judge_tests.rs"]
mod tests;

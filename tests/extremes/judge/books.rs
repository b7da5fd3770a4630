//! What is booked beside the state: heat and entropy of thermostats, lost heat, the work of a support.
//!
//! ```text
//! heat        = θ · entropy given          all thermostats and ovens at one constant θ
//! heat        = θ* · entropy given         one of them, in a step with one temperature θ* between the least and the largest
//!                                          that are prescribed in the step
//! lost heat   ≥ Σ η Δγ²/h                  no way from one end to the other dissipates less; η constant
//!             = Σ (η Δγ²/h + η Δλ²/h)      in a step with one rate
//! work        = Σ F·Δq + R·Δx/h            R = ΔL − Σ h F the impulse of the one support, x its position
//! ```

use super::super::digits::Digits;
use super::super::element::Ends;
use super::super::rounding::ROUNDINGS;
use super::super::stored::Stored;
use super::super::world::Facts;
use super::Complaints;
use super::momenta::{impulses, linear};

/// Parts of a step in which temperatures as functions of time are looked at.
const PARTS: u32 = 8;

impl Complaints {
    /// Holds a step to its books, to what rounding does to its energies.
    pub(super) fn hold_books<const D: usize>(
        &mut self,
        facts: &Facts<D>,
        states: [&Stored; 2],
        elements: &[Ends<'_>],
        (step, bound): (f64, f64),
    ) {
        self.hold_heat(facts, states, (step, bound));
        self.hold_lost_heat(facts, states, elements, (step, bound));
        if let Some((work, terms)) = work(facts, states, elements, step) {
            let booked = states[1].work - states[0].work;
            let off = (booked - work).value().abs();
            self.hold(
                "work is off by",
                off,
                bound + ROUNDINGS * f64::EPSILON * terms,
            );
        }
    }

    fn hold_heat<const D: usize>(
        &mut self,
        facts: &Facts<D>,
        states: [&Stored; 2],
        (step, bound): (f64, f64),
    ) {
        let [heat, given] = [
            states[1].heat - states[0].heat,
            states[0].thermostats - states[1].thermostats,
        ];
        let Some([least, most]) = temperatures(facts, states[0].time, step) else {
            self.hold("heat without a thermostat", heat.value().abs(), 0.0);
            self.hold("entropy without a thermostat", given.value().abs(), 0.0);
            return;
        };
        let is_one = facts.kept.len() + facts.ovens.len() == 1 && facts.has_one_temperature();
        if most > least && !is_one {
            return;
        }
        let middle = least + 0.5 * (most - least);
        let off = (heat - given * middle).value().abs();
        let within = 0.5 * (most - least) * given.value().abs();
        self.hold("heat is not θ times its entropy by", off, bound + within);
    }

    fn hold_lost_heat<const D: usize>(
        &mut self,
        facts: &Facts<D>,
        states: [&Stored; 2],
        elements: &[Ends<'_>],
        (step, bound): (f64, f64),
    ) {
        let lost = (states[1].lost - states[0].lost).value();
        let cold = elements.iter().filter(|ends| ends.theta.is_none());
        let [creep, drag] = cold.fold([0.0; 2], |sums, ends| {
            let own = ends.dissipations(step);
            [sums[0] + own[0], sums[1] + own[1]]
        });
        let all = creep + drag;
        let rounding = bound + ROUNDINGS * f64::EPSILON * all;
        self.hold("lost heat below zero by", -lost, 0.0);
        if facts.has_positive_weights() {
            self.hold("lost heat is too little by", creep - lost, rounding);
        }
        if facts.has_own_viscosity() {
            self.hold("lost heat is off by", (lost - all).abs(), rounding);
        }
    }
}

/// The least and the largest temperature of all thermostats and ovens in a step, if there are any.
pub(super) fn temperatures<const D: usize>(
    facts: &Facts<D>,
    start: f64,
    step: f64,
) -> Option<[f64; 2]> {
    let kept = facts.kept.iter().map(|(_, theta)| theta);
    let time = |part: u32| start + step * f64::from(part) / f64::from(PARTS);
    let all = kept
        .chain(&facts.ovens)
        .flat_map(|theta| (0..=PARTS).map(move |part| theta(time(part))));
    all.fold(None, |ends: Option<[f64; 2]>, theta| {
        let [least, most] = ends.unwrap_or([theta; 2]);
        Some([least.min(theta), most.max(theta)])
    })
}

/// The work of loads and of the one support in a step with one force, J, and the magnitude of its terms.
fn work<const D: usize>(
    facts: &Facts<D>,
    states: [&Stored; 2],
    elements: &[Ends<'_>],
    step: f64,
) -> Option<(Digits, f64)> {
    let anchors = facts
        .masses
        .iter()
        .enumerate()
        .filter(|(_, mass)| mass.is_none());
    let anchors: Vec<usize> = anchors.map(|(node, _)| node).collect();
    if !facts.has_one_force() || anchors.len() > 1 {
        return None;
    }
    let way = |node: usize| -> [Digits; D] {
        let [old, new] = states.map(|state| state.position::<D>(node));
        core::array::from_fn(|axis| new[axis] - old[axis])
    };
    let (mut work, mut terms) = (Digits::ZERO, 0.0);
    for (node, force) in &facts.forces {
        let (force, way) = (force(states[0].time + 0.5 * step), way(*node));
        for axis in 0..D {
            let part = way[axis] * force[axis];
            work = work + part;
            terms += part.value().abs();
        }
    }
    for &support in &anchors {
        let reaction = linear(facts, states, &impulses(facts, states[0].time, step));
        // f and, as the length rounds, k λ.
        let rounding = |ends: &Ends<'_>| ends.force(step) + ends.stiffness() * ends.length();
        let forces: f64 = elements.iter().map(rounding).sum();
        for (part, way) in reaction.iter().zip(way(support)) {
            work = work + part.change * way / Digits::from(step);
            terms += (part.terms / step + forces) * way.value().abs();
        }
    }
    Some((work, terms))
}

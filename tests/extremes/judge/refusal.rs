//! Whether rounding explains the defect for which a step was refused.
//!
//! The state that was refused is not known, but how far a step goes from the old one is, so that energies are bounded by
//!
//! ```text
//! 64 ε (2 A⁰ + Σ_e Σ_ij |H_ij| |x_j| |Δx_i| + Σ_e k λ |Δx_anchor|)
//!
//! Δλ = |Δv| min(h, 1/ω) + |Δx_anchor|,   Δγ = |g| min(h/η, 1/|H_γγ|),   ω = √(Σ k/m) of a mass
//! ```
//!
//! with the terms A⁰ of the energy, the Hessian H and the rates at the old state, and k its entry for λ: no mass goes further
//! than a vibration with its velocity does. Refusals for momenta are not judged: the forces of the old state, which may have been
//! relaxed on the way, explain nearly all of them.

use eem::{Law, StepError, StepFailure, StepLimit};

use super::super::digits::Digits;
use super::super::element::{self, Ends};
use super::super::rounding::ROUNDINGS;
use super::super::stored::Stored;
use super::super::world::Facts;

/// The law for which a step was refused, and its defect.
fn refused(failure: &StepFailure) -> Option<(Law, f64)> {
    match failure {
        StepFailure::LawNotKept { law, defect, .. } => Some((*law, defect.abs())),
        StepFailure::TooSmall { limit, .. } => match &**limit {
            StepLimit::Failure(limit) => refused(limit),
            _ => None,
        },
        _ => None,
    }
}

/// In words, if rounding explains a defect for which a step from this state was refused.
pub(crate) fn explained<const D: usize>(
    facts: &Facts<D>,
    state: &Stored,
    error: &StepError,
) -> Option<String> {
    let (law, defect) = refused(&error.failure).filter(|&(law, _)| law == Law::Energy)?;
    let (time, step) = (error.time, error.step);
    let elements = element::ends(facts, [state, state]);
    let bound = energy(facts, state, &elements, [time, step]);
    (defect <= bound).then(|| {
        let unit = law.unit();
        format!("t = {time:e}: refused for {defect:.5e} {unit} where rounding explains {bound:.5e} {unit}")
    })
}

/// What rounding does to the energy of a step from a state, J.
fn energy<const D: usize>(
    facts: &Facts<D>,
    state: &Stored,
    elements: &[Ends<'_>],
    [time, step]: [f64; 2],
) -> f64 {
    let mut amplitude = super::energies(facts, [state, state], elements, step);
    let mut stiffness = vec![0.0; facts.masses.len()];
    for (spring, ends) in facts.springs.iter().zip(elements) {
        for node in spring.ends {
            stiffness[node] += ends.stiffness();
        }
    }
    let way = |node: usize| -> [f64; D] {
        let Some(mass) = facts.masses[node] else {
            return motion(facts, node, [time, time + step]);
        };
        let vibration = (mass / stiffness[node]).sqrt();
        let momentum = state.momentum::<D>(node);
        momentum.map(|p| p.value() / mass * step.min(vibration))
    };
    for (spring, ends) in facts.springs.iter().zip(elements) {
        let ways = spring.ends.map(way);
        let size = |way: [f64; D]| Digits::norm(&way.map(Digits::from)).value();
        let apart = size(core::array::from_fn(|axis| ways[1][axis] - ways[0][axis]));
        let moved = ways.iter().zip(spring.ends);
        let moved = moved.filter(|&(_, node)| facts.masses[node].is_none());
        let supports: f64 = moved.map(|(&way, _)| size(way)).sum();
        amplitude += ends.rounding([apart, step], supports);
    }
    ROUNDINGS * f64::EPSILON * amplitude
}

/// How far an anchor is moved between two times.
fn motion<const D: usize>(facts: &Facts<D>, node: usize, times: [f64; 2]) -> [f64; D] {
    let mut own = facts.motions.iter().filter(|(moved, _)| *moved == node);
    own.next().map_or([0.0; D], |(_, position)| {
        let [old, new] = times.map(|time| position(time));
        core::array::from_fn(|axis| new[axis] - old[axis])
    })
}

//! Why an explicit step failed: it is longer than the fastest motion allows, or an element is too cold.

use super::accounts::Accounts;
use super::bodies::Bodies;
use super::components::Path;
use super::memory::RowSums;
use super::tableau::{IMAGINARY_LIMIT, REAL_LIMIT};
use super::{Explicit, View};
use crate::algebra::largest;
use crate::element::error::StateError;
use crate::step::error::StepFailure;
use crate::step::scheme::Scheme;
use eem_material::number::scalar::Scalar;

/// The limits for the fastest vibration, conduction and dashpot.
const LIMITS: [f64; 3] = [IMAGINARY_LIMIT, REAL_LIMIT, REAL_LIMIT];

/// The index of the dashpot among them.
const DASHPOT: usize = 2;

impl Accounts {
    /// The fastest vibration, conduction and dashpot, by bounds of the eigenvalues: sums of rows of the
    /// matrices that are symmetric in `√m q` and `√c θ`, 1/s.
    fn fastest(&mut self, bodies: &dyn Bodies) -> [f64; 3] {
        let RowSums {
            squares,
            capacities,
            flows,
        } = &mut self.scratch.stability;
        squares.fill(0.0);
        capacities.fill(0.0);
        flows.fill(0.0);
        let per_root = |node: usize| {
            let mass = bodies.view().masses.get(node);
            mass.map_or(0.0, |mass| mass.sqrt().recip())
        };
        let mut relaxation = 0.0;
        let held = &self.stage;
        bodies.see_stiffnesses(&mut |element| {
            let [a, b] = element.ends();
            let [by_a, by_b] = [per_root(a), per_root(b)];
            let mut stiffness = element.elastic;
            if let Some((slot, capacity)) = element.capacity {
                capacities[slot] = capacity;
                if held.is_held(slot) {
                    // A thermostat keeps the temperature as a body of any size would.
                    (stiffness, capacities[slot]) = (element.isothermal, f64::MAX);
                }
            }
            squares[a] += stiffness * by_a * (by_a + by_b);
            squares[b] += stiffness * by_b * (by_a + by_b);
            relaxation = Scalar::maximum(relaxation, element.relaxation);
        });
        add_conduction(&self.components.paths, capacities, flows);
        [largest(squares).sqrt(), largest(flows), relaxation]
    }

    /// The reason behind a failure, if the step is too long to be stable.
    #[cold]
    pub(super) fn explain(&mut self, bodies: &dyn Bodies, failure: StepFailure) -> StepFailure {
        let may_be_unstable = matches!(
            failure,
            StepFailure::State(_)
                | StepFailure::Unbounded { .. }
                | StepFailure::Correction { .. }
                | StepFailure::NotClosed { .. }
                | StepFailure::LawNotKept { .. }
        );
        if !may_be_unstable {
            return failure;
        }
        unstable(self.fastest(bodies), 0, bodies.view())
            .or_else(|| self.too_cold(bodies, &failure))
            .unwrap_or(failure)
    }

    /// An error if the step is too long for a dashpot. Asked where heat cannot correct the energy of a step by a small part of
    /// itself: a dashpot beyond its limit of stability dissipates by far another energy than its spring gives.
    #[cold]
    pub(super) fn expect_stable_dashpots(
        &mut self,
        bodies: &dyn Bodies,
    ) -> Result<(), StepFailure> {
        if self.components.dashpots.is_empty() {
            return Ok(());
        }
        unstable(self.fastest(bodies), DASHPOT, bodies.view()).map_or(Ok(()), Err)
    }

    /// The element without an admissible temperature, as it was at the start of the step.
    fn too_cold(&self, bodies: &dyn Bodies, failure: &StepFailure) -> Option<StepFailure> {
        let StepFailure::State(
            StateError::Temperature { element, .. }
            | StateError::HeatCapacity { element, .. }
            | StateError::NoSuchTemperature { element, .. },
        ) = failure
        else {
            return None;
        };
        let elements = &self.components.elements;
        let slot = elements.iter().position(|&at| at == element.index())?;
        let mut heat_capacity = 0.0;
        bodies.see_stiffnesses(&mut |found| {
            if let Some((own, capacity)) = found.capacity
                && own == slot
            {
                heat_capacity = capacity;
            }
        });
        let is_known = heat_capacity > 0.0;
        is_known.then(|| StepFailure::TooCold {
            element: *element,
            heat_capacity,
            temperature: bodies.view().state.temperatures[slot],
            scheme: Scheme::EemEntropy.name(),
            time: bodies.view().end(),
        })
    }
}

impl<const D: usize> Explicit<D> {
    /// The step as a fraction of the longest stable one.
    pub(crate) fn share_of_stable_step(&mut self, view: &View<'_>) -> f64 {
        let (accounts, bodies) = self.parts(view);
        let rates = accounts.fastest(&bodies);
        let mut largest = 0.0_f64;
        for (rate, limit) in rates.iter().zip(LIMITS) {
            largest = largest.max(rate / limit);
        }
        view.step * largest
    }
}

/// The error of a step that is too long for one of the processes from this one on.
fn unstable(rates: [f64; 3], first: usize, view: &View<'_>) -> Option<StepFailure> {
    let h = view.step;
    let process = (first..rates.len()).find(|&process| h * rates[process] > LIMITS[process])?;
    let (fastest, limit) = (rates[process], LIMITS[process]);
    Some(StepFailure::Unstable {
        rate: ["ωh", "κh/c", "kh/η"][process],
        product: h * fastest,
        limit,
        longest: limit / fastest,
        scheme: Scheme::EemEntropy.name(),
        time: view.end(),
    })
}

/// Adds the flows along paths of heat to the sums of the rows of their slots, given the heat capacities, J/K.
fn add_conduction(paths: &[Path], capacities: &[f64], flows: &mut [f64]) {
    for path in paths {
        let ends = path.ends;
        let per_root = |end: usize| {
            let capacity = capacities.get(end).copied();
            capacity.map_or(0.0, |capacity| capacity.sqrt().recip())
        };
        let both = per_root(ends[0]) + per_root(ends[1]);
        for end in ends {
            if let Some(flow) = flows.get_mut(end) {
                *flow += path.conductance * per_root(end) * both;
            }
        }
    }
}

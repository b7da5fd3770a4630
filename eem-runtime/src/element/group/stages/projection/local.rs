//! The local equations of an element with projected conjugates.
//!
//! ```text
//! η(Θ_i) ν_i/h − G_i = 0                                        for every dashpot and stage
//! Θ_i ς_i − Σ η(Θ_i) ν_i²/h − h Σ κ (Θ_f − Θ)_i = 0              for every stage
//! ```
//!
//! with the unknown increments `ν = hγ̇` and `ς = hṡ`, so that neither η = 0 nor η = ∞ is special. Where a
//! thermostat gives the temperature, the entropies of the path are those of the given temperatures at its
//! supports instead.

use super::path::PointPath;
use super::vector::{Vector, chained};
use crate::element::error::StateError;
use crate::element::group::point::Point;
use crate::element::group::stages::equations::StageEquations;
use crate::element::group::stages::point::{LocalStages, Outside, StagePoint};
use crate::element::group::view::StepView;
use crate::element::kinematics::{MeasuresOf, PerStrain, StrainMeasures};
use crate::element::state::State;
use crate::element::tableau::MOST_STAGES;
use crate::element::tally::Tally;
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;
use eem_material::number::scalar::Scalar;

impl<A: Arrays, G: StrainMeasures> StageEquations<A, G::Measures> for PointPath<A, G> {
    const FORCES: usize = Self::STRAINS;

    fn point_mut(&mut self) -> &mut StagePoint {
        &mut self.point
    }

    fn begin(&mut self, in_state: &Point<A, G::Measures>, x0: &A::Variables, strain: &[f64]) {
        self.begin_at(in_state, x0, PerStrain::<G>::beginning_of(strain));
    }

    // All in J; the unknowns are in their units.
    fn write_equations(
        &mut self,
        in_state: &Point<A, G::Measures>,
        local: &mut LocalStages,
        view: &StepView<'_>,
    ) -> Result<(), StateError> {
        let stages = 0..self.point.rule.stages();
        for stage in stages.clone() {
            for k in 0..self.point.dashpots {
                self.write_creep(local, [stage, k], view.per_step);
            }
        }
        let Some(slot) = in_state.slots().thermal else {
            return Ok(());
        };
        if let Some(prescribed) = self.point.prescribed {
            return self.prescribe(in_state, local, &prescribed);
        }
        for stage in stages {
            let theta = self.mean_temperature(stage);
            let flow = view.conduction.reservoir_flow(slot, theta);
            let heat = flow.heat + self.received[stage];
            let has_drag = in_state.drags() > 0;
            self.write_heat(local, stage, (view, [heat, flow.conductance]), has_drag);
        }
        Ok(())
    }

    fn force(&self, local: &mut LocalStages, [stage, component]: [usize; 2]) -> f64 {
        self.differentiate(local, [stage, component]);
        self.point.eliminate(local);
        self.conjugates[stage][component]
    }

    fn temperature(&self, local: &mut LocalStages, set: usize) -> f64 {
        self.differentiate(local, [set, Self::ENTROPY]);
        self.point.eliminate(local);
        self.mean_temperature(set)
    }

    fn hold(&mut self) {
        self.previous = self.rates;
        self.correction = [Vector::zero(); MOST_STAGES];
    }

    fn correct(&mut self, local: &LocalStages) -> f64 {
        let entropies = self.point.rule.sets() * self.point.dashpots;
        let mut largest = 0.0;
        for unknown in 0..local.unknowns() {
            let change = local.change(&self.point.solved, unknown);
            let (stage, index) = if unknown < entropies {
                (
                    unknown / self.point.dashpots,
                    Self::STRAINS + unknown % self.point.dashpots,
                )
            } else {
                (unknown - entropies, Self::ENTROPY)
            };
            self.correction[stage][index] = self.units[index] * change;
            largest = Scalar::maximum(largest, change.abs());
        }
        largest
    }

    fn apply(&mut self, fraction: f64) {
        for stage in 0..self.point.rule.stages() {
            for index in Self::STRAINS..Self::LEN {
                let change = fraction * self.correction[stage][index];
                self.rates[stage][index] = self.previous[stage][index] + change;
            }
        }
    }

    fn close(
        &mut self,
        in_state: &mut Point<A, G::Measures>,
        measures: &MeasuresOf<G>,
        view_and_outside: (&StepView<'_>, Outside<'_>),
        next_and_tally: (&mut State, &mut Tally),
    ) -> Result<(), StateError> {
        self.close_at(in_state, measures, view_and_outside, next_and_tally)
    }

    fn change_of_energy(&self) -> Option<f64> {
        Some(self.change_along_path())
    }
}

impl<A: Arrays, G: StrainMeasures> PointPath<A, G> {
    /// Writes the derivatives of a conjugate of a stage to the row of the workspace.
    fn differentiate(&self, local: &mut LocalStages, [stage, index]: [usize; 2]) {
        let (sets, strains) = (self.point.rule.sets(), Self::STRAINS);
        local.clear_row();
        for (set, by) in self.by_rates[stage].iter().enumerate().take(sets) {
            for q in 0..strains {
                local.row[1 + set * strains + q] = by.at([index, q]);
            }
            for k in 0..self.point.dashpots {
                let entry = by.at([index, strains + k]) * self.units[strains + k];
                local.by_unknown[set * self.point.dashpots + k] = entry;
            }
            if self.point.is_thermal {
                let last = Self::ENTROPY;
                let entry = by.at([index, last]) * self.units[last];
                local.by_unknown[sets * self.point.dashpots + set] = entry;
            }
        }
    }

    /// Adds a multiple of a conjugate of a stage to an equation.
    fn add(
        &mut self,
        local: &mut LocalStages,
        equation: usize,
        stage_and_index: [usize; 2],
        factor: f64,
    ) {
        self.differentiate(local, stage_and_index);
        self.point.add_row(local, equation, factor);
    }

    /// The equation of a dashpot at a stage, times the unit of its stretch.
    fn write_creep(&mut self, local: &mut LocalStages, [stage, k]: [usize; 2], per_step: f64) {
        let (equation, index) = (stage * self.point.dashpots + k, Self::STRAINS + k);
        let unit = self.units[index];
        let (viscosities, slopes) = &self.viscosities[stage];
        let (drag, slope) = (viscosities[k] * per_step, slopes[k] * per_step);
        let rate = self.rates[stage][index];
        let residual = drag * rate + self.conjugates[stage][index];
        self.point.solved[equation] = unit * residual;
        let diagonal = equation * (local.unknowns() + 1);
        local.matrix[diagonal] += unit * unit * drag;
        self.add(local, equation, [stage, index], unit);
        if self.point.is_thermal {
            let temperature = [stage, Self::ENTROPY];
            self.add(local, equation, temperature, unit * slope * rate);
        }
    }

    /// The balance of heat at a stage, given the heat received from paths, W, and the conductance to
    /// reservoirs.
    fn write_heat(
        &mut self,
        local: &mut LocalStages,
        stage: usize,
        (view, [heat, conductance]): (&StepView<'_>, [f64; 2]),
        has_drag: bool,
    ) {
        let (sets, strains) = (self.point.rule.sets(), Self::STRAINS);
        let (unknowns, last) = (local.unknowns(), Self::ENTROPY);
        let equation = sets * self.point.dashpots + stage;
        let (theta, rate) = (self.mean_temperature(stage), self.rates[stage][last]);
        let mut residual = theta * rate - view.step * heat;
        let mut by_theta = rate + view.step * conductance;
        let (viscosities, slopes) = &self.viscosities[stage];
        for k in 0..self.point.dashpots {
            let creep = self.rates[stage][strains + k];
            let drag = viscosities[k] * view.per_step * creep;
            residual -= drag * creep;
            by_theta -= slopes[k] * view.per_step * creep * creep;
            let unknown = stage * self.point.dashpots + k;
            local.matrix[equation * unknowns + unknown] -= (drag + drag) * self.units[strains + k];
        }
        if has_drag {
            residual -= self.viscous_heat[stage];
            by_theta -= self.heat_by_theta[stage];
            for (set, by) in self.heat_by_strain[stage].iter().enumerate().take(sets) {
                for (q, &by) in by.as_ref().iter().enumerate() {
                    let input = 1 + set * strains + q;
                    self.point.solved[input * unknowns + equation] -= by;
                }
            }
        }
        self.point.solved[equation] = residual;
        local.matrix[equation * (unknowns + 1)] += theta * self.units[last];
        self.add(local, equation, [stage, last], by_theta);
        let input = 1 + sets * strains + stage;
        self.point.solved[input * unknowns + equation] -= view.step;
    }

    /// The equations `θ (s(τ) − S(λ, γ, θ)) = 0` where the temperature θ is given.
    fn prescribe(
        &mut self,
        in_state: &Point<A, G::Measures>,
        local: &mut LocalStages,
        prescribed: &[f64; MOST_STAGES],
    ) -> Result<(), StateError> {
        let rule = self.point.rule;
        let Some(path) = rule.path else {
            return Ok(());
        };
        let (strains, last) = (Self::STRAINS, Self::ENTROPY);
        let (unknowns, first) = (local.unknowns(), rule.sets() * self.point.dashpots);
        for (at, (shares, &theta)) in path.supports.integrals.iter().zip(prescribed).enumerate() {
            let equation = first + at;
            let y = self.path_at(shares);
            let measures = self.measures_in_path(in_state.element, &y.strain)?;
            let x = y.variables(measures.as_ref(), theta);
            let (gradient, hessian) = in_state.model.hessian(&x);
            let row = hessian[A::MEASURES + A::DASHPOTS];
            let increment = self.increments(shares)[last];
            let entropy = -gradient[A::MEASURES + A::DASHPOTS];
            let residual = (self.old[last] - entropy) + increment;
            self.point.solved[equation] = theta * residual;
            let slopes = self.measures.slopes([&y.strain, &y.strain]);
            let by_strain = chained::<G>(&slopes, &row.as_ref()[..A::MEASURES]);
            for (set, &share) in shares.iter().enumerate() {
                let share = theta * share;
                for (q, &by) in by_strain.as_ref().iter().enumerate() {
                    let input = (1 + set * strains + q) * unknowns + equation;
                    self.point.solved[input] += share * by;
                }
                let matrix = &mut local.matrix[equation * unknowns..];
                for k in 0..self.point.dashpots {
                    let entry = share * row[A::MEASURES + k] * self.units[strains + k];
                    matrix[set * self.point.dashpots + k] += entry;
                }
                matrix[first + set] += share * self.units[last];
            }
        }
        Ok(())
    }
}

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

use super::ProjectedPoint;
use super::derivatives::chained;
use super::vector::Vector;
use crate::element::error::StateError;
use crate::element::group::stages::local::{Column, LocalStages};
use crate::element::group::stages::member::StatePoint;
use crate::element::group::view::StepView;
use crate::element::kinematics::QuadraticStrain;
use crate::element::tableau::{MOST_STAGES, Tableau};
use eem_material::free_energy::{Array, Material};
use eem_material::number::scalar::Real;

impl<S: Real, M: Material<S>, K: QuadraticStrain<S, D>, const D: usize> ProjectedPoint<S, M, K, D> {
    /// Writes the equations, all in J; the unknowns are in their units.
    pub(super) fn write_path(
        &mut self,
        in_state: &StatePoint<S, M, K, D>,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        view: &StepView<'_, S>,
    ) -> Result<(), StateError> {
        for stage in 0..rule.stages() {
            for k in 0..M::DASHPOTS {
                self.creep(rule, local, [stage, k], view.per_step);
            }
        }
        let Some(slot) = in_state.slots().thermal else {
            return Ok(());
        };
        if let Some(prescribed) = self.prescribed {
            return self.prescribe(in_state, rule, local, &prescribed);
        }
        for stage in 0..rule.stages() {
            let flow = view
                .conduction
                .reservoir_flow(slot, self.mean_temperature(stage));
            let heat = flow.heat + self.own.received[stage];
            self.warm(rule, local, stage, (view, [heat, flow.conductance]));
        }
        Ok(())
    }

    /// Where the derivatives of a conjugate by the increments go.
    fn sort(&self, rule: &Tableau, [stage, index]: [usize; 2], mut add: impl FnMut(Column, S)) {
        let first = rule.sets() * M::DASHPOTS;
        for (set, by) in self.own.by_rates[stage]
            .iter()
            .enumerate()
            .take(rule.sets())
        {
            let strains = Vector::<S, M, K, D>::STRAINS;
            for q in 0..strains {
                add(Column::Input(set * strains + q), by[[index, q]]);
            }
            for k in 0..M::DASHPOTS {
                let entry = by[[index, strains + k]] * self.own.units[strains + k];
                add(Column::Unknown(set * M::DASHPOTS + k), entry);
            }
            if M::THERMAL {
                let last = Vector::<S, M, K, D>::ENTROPY;
                let entry = by[[index, last]] * self.own.units[last];
                add(Column::Unknown(first + set), entry);
            }
        }
    }

    /// Adds a multiple of a conjugate to an equation.
    fn add(
        &mut self,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        equation: usize,
        conjugate: [usize; 2],
        factor: S,
    ) {
        let unknowns = local.unknowns();
        let mut solved = core::mem::take(&mut self.solved);
        self.sort(rule, conjugate, |column, entry| match column {
            Column::Input(j) => solved[(1 + j) * unknowns + equation] += factor * entry,
            Column::Unknown(u) => local.matrix[equation * unknowns + u] += factor * entry,
        });
        self.solved = solved;
    }

    /// The equation of a dashpot at a stage, times the unit of its stretch.
    fn creep(
        &mut self,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        [stage, k]: [usize; 2],
        per_step: S,
    ) {
        let (equation, index) = (stage * M::DASHPOTS + k, Vector::<S, M, K, D>::STRAINS + k);
        let unit = self.own.units[index];
        let (viscosities, slopes) = &self.own.viscosities[stage];
        let (drag, slope) = (viscosities[k] * per_step, slopes[k] * per_step);
        let rate = self.own.rates[stage][index];
        let rest = drag * rate + self.own.conjugates[stage][index];
        self.solved[equation] = unit * rest;
        let diagonal = equation * (local.unknowns() + 1);
        local.matrix[diagonal] += unit * unit * drag;
        self.add(rule, local, equation, [stage, index], unit);
        if M::THERMAL {
            let factor = unit * slope * rate;
            self.add(
                rule,
                local,
                equation,
                [stage, Vector::<S, M, K, D>::ENTROPY],
                factor,
            );
        }
    }

    /// The balance of heat at a stage, given the heat received from paths, W, and the conductance to
    /// reservoirs.
    fn warm(
        &mut self,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        stage: usize,
        (view, [heat, conductance]): (&StepView<'_, S>, [S; 2]),
    ) {
        let (unknowns, last) = (local.unknowns(), Vector::<S, M, K, D>::ENTROPY);
        let first = rule.sets() * M::DASHPOTS;
        let equation = first + stage;
        let (theta, rate) = (self.mean_temperature(stage), self.own.rates[stage][last]);
        let mut rest = theta * rate - view.step * heat;
        let mut by_theta = rate + view.step * conductance;
        for k in 0..M::DASHPOTS {
            let index = Vector::<S, M, K, D>::STRAINS + k;
            let (viscosities, slopes) = &self.own.viscosities[stage];
            let creep = self.own.rates[stage][index];
            let drag = viscosities[k] * view.per_step * creep;
            rest -= drag * creep;
            by_theta -= slopes[k] * view.per_step * creep * creep;
            let unknown = stage * M::DASHPOTS + k;
            local.matrix[equation * unknowns + unknown] -= (drag + drag) * self.own.units[index];
        }
        if M::Drag::LEN > 0 {
            rest -= self.own.drags[stage].heat;
            by_theta -= self.own.drags[stage].by_theta;
            self.add_heat_of_drag(rule, (&*local, equation), stage);
        }
        self.solved[equation] = rest;
        local.matrix[equation * (unknowns + 1)] += theta * self.own.units[last];
        self.add(rule, local, equation, [stage, last], by_theta);
        let input = 1 + rule.sets() * Vector::<S, M, K, D>::STRAINS + stage;
        self.solved[input * unknowns + equation] -= view.step;
    }

    /// The equations `θ (s(τ) − S(λ, γ, θ)) = 0` where the temperature θ is given.
    fn prescribe(
        &mut self,
        in_state: &StatePoint<S, M, K, D>,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        prescribed: &[S; MOST_STAGES],
    ) -> Result<(), StateError> {
        let Some(path) = rule.path else {
            return Ok(());
        };
        let (unknowns, last) = (local.unknowns(), Vector::<S, M, K, D>::ENTROPY);
        let first = rule.sets() * M::DASHPOTS;
        for (at, (shares, &theta)) in path.supports.integrals.iter().zip(prescribed).enumerate() {
            let equation = first + at;
            let y = self.path_at(shares);
            let measures = self.measures_in_path(in_state.element, &y.strain)?;
            let x = y.variables(measures.as_ref(), theta);
            let (gradient, hessian) = in_state.model.hessian(&x);
            let row = hessian[M::MEASURES + M::DASHPOTS];
            let increment = self.increments(shares)[last];
            let entropy = -gradient[M::MEASURES + M::DASHPOTS];
            let rest = (self.own.old[last] - entropy) + increment;
            self.solved[equation] = theta * rest;
            let slopes = self.kinematics.strain_slopes([&y.strain, &y.strain]);
            let by_strain = chained::<S, K, D>(&slopes, &row.as_ref()[..M::MEASURES]);
            for (set, &share) in shares.iter().enumerate() {
                let share = theta * S::from_f64(share);
                for (q, &by) in by_strain.as_ref().iter().enumerate() {
                    let input = (1 + set * Vector::<S, M, K, D>::STRAINS + q) * unknowns + equation;
                    self.solved[input] += share * by;
                }
                let matrix = &mut local.matrix[equation * unknowns..];
                for k in 0..M::DASHPOTS {
                    let unit = self.own.units[Vector::<S, M, K, D>::STRAINS + k];
                    matrix[set * M::DASHPOTS + k] += share * row[M::MEASURES + k] * unit;
                }
                matrix[first + set] += share * self.own.units[last];
            }
        }
        Ok(())
    }

    /// A conjugate of a stage with the local unknowns eliminated: its derivatives go to the row of the local
    /// memory.
    pub(super) fn eliminate(
        &self,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        conjugate: [usize; 2],
    ) {
        local.by_unknown.fill(S::zero());
        local.row.fill(S::zero());
        let (row, by_unknown) = (&mut local.row, &mut local.by_unknown);
        self.sort(rule, conjugate, |column, entry| match column {
            Column::Input(j) => row[1 + j] += entry,
            Column::Unknown(u) => by_unknown[u] += entry,
        });
        self.substitute(local);
    }
}

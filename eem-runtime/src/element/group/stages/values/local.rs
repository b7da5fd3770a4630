//! The variables of a point at the stages, and their local equations.

use super::at_stage::AtStage;
use crate::element::conduction::{InterfaceTemperatures, Partner};
use crate::element::conjugates::{Any, Infeasible};
use crate::element::error::StateError;
use crate::element::group::arms::measures_in;
use crate::element::group::point::{Point, grown};
use crate::element::group::respond::check_temperature;
use crate::element::group::stages::equations::StageEquations;
use crate::element::group::stages::point::{LocalStages, Outside, StagePoint};
use crate::element::group::view::StepView;
use crate::element::kinematics::{MeasureSet, Numbers};
use crate::element::layout::Slots;
use crate::element::state::State;
use crate::element::tableau::{EntropyBalance, MOST_STAGES};
use crate::element::tally::Tally;
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;
use eem_material::number::scalar::Scalar;

/// The variables of a point and its model at the stages. They know its measures and no nodes.
pub(crate) struct StageValues<A: Arrays> {
    pub(super) point: StagePoint,
    /// The old variables `(π, γ, θ)⁰`.
    old: A::Variables,
    /// The trial variables at the stages.
    x: [A::Variables; MOST_STAGES],
    /// Those before the last correction, and the correction; temperatures only at the stages whose
    /// temperatures are unknowns.
    previous: [A::Variables; MOST_STAGES],
    correction: [A::Variables; MOST_STAGES],
    stages: [AtStage<A>; MOST_STAGES],
}

impl<A: Arrays, Q: MeasureSet> StageEquations<A, Q> for StageValues<A> {
    const FORCES: usize = A::MEASURES;

    fn point_mut(&mut self) -> &mut StagePoint {
        &mut self.point
    }

    fn begin(&mut self, _: &Point<A, Q>, x0: &A::Variables, _strain: &[f64]) {
        (self.old, self.x) = (*x0, [*x0; MOST_STAGES]);
        let prescribed = self.point.prescribed.into_iter().flatten();
        for (x, theta) in self.x.iter_mut().zip(prescribed) {
            x[Self::TEMPERATURE] = theta;
        }
    }

    fn write_equations(
        &mut self,
        _: &Point<A, Q>,
        local: &mut LocalStages,
        view: &StepView<'_>,
    ) -> Result<(), StateError> {
        self.write_creep(local, view.step);
        let unknowns = local.unknowns();
        let first = self.point.rule.sets() * self.point.dashpots;
        for (set, balance) in self.point.rule.entropies.iter().enumerate() {
            if self.point.is_thermal && self.point.prescribed.is_none() {
                self.write_balance(local, (first + set, balance), view.step);
            } else if self.point.is_thermal {
                // δθ = 0
                local.matrix[(first + set) * (unknowns + 1)] = 1.0;
            }
        }
        Ok(())
    }

    fn force(&self, local: &mut LocalStages, [stage, measure]: [usize; 2]) -> f64 {
        let at_stage = &self.stages[stage];
        self.differentiate(local, stage, &at_stage.hessian[measure]);
        self.point.eliminate(local);
        at_stage.gradient[measure]
    }

    fn temperature(&self, local: &mut LocalStages, set: usize) -> f64 {
        let mut by = A::Variables::filled(0.0);
        by[Self::TEMPERATURE] = 1.0;
        let stage = self.point.rule.entropies[set].unknown;
        self.differentiate(local, stage, &by);
        self.point.eliminate(local);
        self.theta(stage)
    }

    fn hold(&mut self) {
        self.previous = self.x;
        self.correction = [A::Variables::filled(0.0); MOST_STAGES];
    }

    fn correct(&mut self, local: &LocalStages) -> f64 {
        let rule = self.point.rule;
        let temperatures = rule.sets() * self.point.dashpots;
        let mut largest = 0.0;
        for u in 0..local.unknowns() {
            let change = local.change(&self.point.solved, u);
            let (stage, index, scale) = if u < temperatures {
                let stage = rule.stage_of(u / self.point.dashpots);
                let index = A::MEASURES + u % self.point.dashpots;
                (stage, index, self.point.viscous_unit)
            } else {
                let stage = rule.entropies[u - temperatures].unknown;
                (stage, Self::TEMPERATURE, self.theta(stage))
            };
            self.correction[stage][index] = change;
            largest = Scalar::maximum(largest, (change / scale).abs());
        }
        largest
    }

    /// Viscous stretches linearly, temperatures in their logarithms, so that they stay positive.
    fn apply(&mut self, fraction: f64) {
        let rule = self.point.rule;
        for stage in rule.known..rule.stages() {
            for index in A::MEASURES..A::MEASURES + self.point.dashpots {
                let change = fraction * self.correction[stage][index];
                self.x[stage][index] = self.previous[stage][index] + change;
            }
        }
        if !self.point.is_thermal || self.point.prescribed.is_some() {
            return;
        }
        for stage in rule.entropies.iter().map(|balance| balance.unknown) {
            let change = fraction * self.correction[stage][Self::TEMPERATURE];
            self.x[stage][Self::TEMPERATURE] =
                grown(self.previous[stage][Self::TEMPERATURE], change);
        }
        for (stage, shares) in rule.temperatures.iter().enumerate() {
            let terms = shares.iter().zip(rule.entropies);
            self.x[stage][Self::TEMPERATURE] = terms.fold(0.0, |sum, (&share, balance)| {
                sum + share * self.theta(balance.unknown)
            });
        }
    }

    fn close(
        &mut self,
        in_state: &mut Point<A, Q>,
        measures: &Numbers<Q>,
        (view, _): (&StepView<'_>, Outside<'_>),
        (next, _): (&mut State, &mut Tally),
    ) -> Result<(), StateError> {
        let received = self.book(in_state.slots(), view, next);
        let near = self.theta(self.point.rule.stages() - 1);
        if let Some(entropy) =
            in_state.recover_temperature::<Any>(measures, view, (near, None), next)?
        {
            self.book_thermostat(view.step, [entropy, received], next);
        }
        Ok(())
    }
}

impl<A: Arrays> StageValues<A> {
    /// The index of the last variable, the temperature of elements that have one.
    const TEMPERATURE: usize = A::Variables::LEN - 1;

    pub(crate) fn new(point: StagePoint) -> Self {
        let zeros = [A::Variables::filled(0.0); MOST_STAGES];
        Self {
            point,
            old: zeros[0],
            x: zeros,
            previous: zeros,
            correction: zeros,
            stages: [(); MOST_STAGES].map(|()| AtStage::zero()),
        }
    }

    /// Sets the measures of a stage.
    pub(crate) fn set_measures(&mut self, stage: usize, measures: &[f64]) {
        self.x[stage].as_mut()[..A::MEASURES].copy_from_slice(measures);
    }

    /// The temperature of a stage, K; without meaning for elements that have none.
    fn theta(&self, stage: usize) -> f64 {
        self.x[stage][Self::TEMPERATURE]
    }

    /// Measures and forces of a stage.
    pub(crate) fn measures_and_forces<Q: MeasureSet>(&self, stage: usize) -> [Numbers<Q>; 2] {
        [&self.x[stage], &self.stages[stage].gradient].map(measures_in::<Q>)
    }

    /// Evaluates the model at a stage whose measures are known.
    pub(crate) fn evaluate<Q: MeasureSet>(
        &mut self,
        in_state: &mut Point<A, Q>,
        stage: usize,
        (view, interface): (&StepView<'_>, &InterfaceTemperatures),
    ) -> Result<(), StateError> {
        let (theta, at_stage) = (self.theta(stage), &mut self.stages[stage]);
        if self.point.is_thermal {
            check_temperature(in_state.element, theta)?;
        }
        (at_stage.gradient, at_stage.hessian) = in_state.model.hessian(&self.x[stage]);
        let mut values = at_stage.gradient.as_ref().iter();
        if let Some(value) = values.find(|value| !value.is_finite()) {
            return Err(StateError::NotFinite {
                element: in_state.element,
                quantity: "force or entropy",
                value: *value,
            });
        }
        in_state.find_viscosities(theta)?;
        let dissipation_by = at_stage.creep(in_state.dashpots(), &in_state.viscosities);
        let Some(slot) = in_state.slots().thermal else {
            return Ok(());
        };
        let slope = at_stage.entropy_by()[Self::TEMPERATURE];
        Infeasible::unless_stable(theta * slope, theta)
            .map_err(|infeasible| infeasible.of(in_state.element))?;
        let mut flow = view.conduction.reservoir_flow(slot, theta);
        flow.heat += (self.point).heat_received(stage, slot, (view, interface));
        at_stage.warm(theta, &flow, &dissipation_by);
        Ok(())
    }

    /// Writes the derivatives of a quantity of a stage, given those with respect to x, to the row of the workspace.
    fn differentiate(&self, local: &mut LocalStages, stage: usize, by: &A::Variables) {
        let rule = self.point.rule;
        let (measures, rest) = by.as_ref().split_at(A::MEASURES);
        let dashpots = &rest[..self.point.dashpots];
        local.clear_row();
        if let Some(set) = rule.set_of(stage) {
            let first = 1 + set * A::MEASURES;
            local.row[first..first + A::MEASURES].copy_from_slice(measures);
            let first = set * self.point.dashpots;
            local.by_unknown[first..first + dashpots.len()].copy_from_slice(dashpots);
        }
        if self.point.is_thermal && self.point.prescribed.is_none() {
            let thetas = &mut local.by_unknown[rule.sets() * self.point.dashpots..];
            for (entry, &share) in thetas.iter_mut().zip(rule.temperatures[stage]) {
                *entry = share * by[Self::TEMPERATURE];
            }
        }
    }

    /// Writes the equations of the viscous stretches.
    fn write_creep(&mut self, local: &mut LocalStages, h: f64) {
        let rule = self.point.rule;
        for (set, weights) in rule.rates.iter().enumerate() {
            for k in 0..self.point.dashpots {
                let (equation, index) = (set * self.point.dashpots + k, A::MEASURES + k);
                let mut residual = self.x[rule.stage_of(set)][index] - self.old[index];
                let diagonal = equation * (local.unknowns() + 1);
                local.matrix[diagonal] = 1.0;
                for (stage, &weight) in weights.iter().enumerate() {
                    let weight = -h * weight;
                    residual += weight * self.stages[stage].rates[index];
                    self.differentiate(local, stage, &self.stages[stage].rates_by[index]);
                    self.point.add_row(local, equation, weight);
                }
                self.point.solved[equation] = residual;
            }
        }
    }

    /// Writes an equation of the entropies, if the temperature is free.
    fn write_balance(
        &mut self,
        local: &mut LocalStages,
        (equation, balance): (usize, &EntropyBalance),
        h: f64,
    ) {
        let rule = self.point.rule;
        let unknowns = local.unknowns();
        let mut residual = -balance.old * self.point.entropy;
        for (stage, &weight) in balance.entropies.iter().enumerate() {
            if weight != 0.0 {
                residual += weight * self.stages[stage].entropy();
                self.differentiate(local, stage, &self.stages[stage].entropy_by());
                self.point.add_row(local, equation, weight);
            }
        }
        for (stage, &weight) in balance.rates.iter().enumerate() {
            if weight != 0.0 {
                let weight = -h * weight;
                residual += weight * self.stages[stage].rates[Self::TEMPERATURE];
                self.differentiate(
                    local,
                    stage,
                    &self.stages[stage].rates_by[Self::TEMPERATURE],
                );
                self.point.add_row(local, equation, weight);
                let heat = 1 + rule.sets() * A::MEASURES + stage;
                self.point.solved[heat * unknowns + equation] = weight / self.theta(stage);
            }
        }
        self.point.solved[equation] = residual;
        // Newton's method on θ r, which is far less curved than r where conduction is stiff, and zero
        // where it is.
        let scaled = residual / self.theta(balance.stage);
        let row = &mut local.matrix[equation * unknowns + rule.sets() * self.point.dashpots..];
        for (entry, &share) in row.iter_mut().zip(rule.temperatures[balance.stage]) {
            *entry += share * scaled;
        }
    }

    /// Books the increments of the internal variables and of the reservoirs' entropies; returns the entropy that dashpots
    /// and conduction gave to the point, J/K.
    fn book(&self, slots: Slots, view: &StepView<'_>, next: &mut State) -> f64 {
        let (stages, old) = (&self.stages, view.state);
        let over_step = |of: &dyn Fn(usize) -> f64| {
            let terms = self.point.rule.weights.iter().enumerate();
            terms.fold(0.0, |sum, (stage, &weight)| {
                sum + view.step * weight * of(stage)
            })
        };
        for k in 0..self.point.dashpots {
            let creep = over_step(&|stage| stages[stage].rates[A::MEASURES + k]);
            (next.viscous).advance(slots.viscous + k, &old.viscous, creep);
        }
        let Some(slot) = slots.thermal else {
            let heat = over_step(&|stage| stages[stage].dissipation);
            next.dissipated.add(heat);
            return 0.0;
        };
        let received = over_step(&|stage| stages[stage].rates[Self::TEMPERATURE]);
        next.entropies.advance(slot, &old.entropies, received);
        for link in view.conduction.links(slot) {
            if let Partner::Reservoir(index) = link.partner {
                let theta = view.conduction.reservoirs[index];
                let flow = |stage: usize| link.conductance * (self.theta(stage) - theta) / theta;
                next.reservoir_entropies.add(index, over_step(&flow));
            }
        }
        received
    }

    /// Books the heat of the thermostat of an element whose new entropy is given: at the stages it gives what the equations
    /// of the rule need with the prescribed temperatures, at the last stage the rest of the total.
    fn book_thermostat(&self, h: f64, [new_entropy, received]: [f64; 2], next: &mut State) {
        let total = new_entropy - self.point.entropy - received;
        let mut rest = total;
        for balance in self.point.rule.entropies {
            let mut defect = -balance.old * self.point.entropy;
            let terms = balance.entropies.iter().zip(balance.rates);
            for ((&entropy, &rate), stage) in terms.zip(&self.stages) {
                defect += entropy * stage.entropy();
                defect -= h * rate * stage.rates[Self::TEMPERATURE];
            }
            for (stage, &supply) in balance.supply.iter().enumerate() {
                let given = supply * defect;
                next.heat.add(self.theta(stage) * given);
                rest -= given;
            }
        }
        let stages = self.point.rule.stages();
        next.heat.add(self.theta(stages - 1) * rest);
        next.thermostat_entropy.add(-total);
    }
}

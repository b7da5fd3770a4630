//! The points of one model at the stages.

use core::any::Any;

use super::equations::StageEquations;
use super::models::{PathModels, StageModels, ValueModels};
use super::point::{LocalStages, Outside, StagePoint};
use super::projection::path::PointPath;
use super::values::local::StageValues;
use crate::element::conduction::InterfaceTemperatures;
use crate::element::conjugates::{Any as AnyScheme, OneSet, PointRule};
use crate::element::error::StateError;
use crate::element::group::model_points::ModelPoints;
use crate::element::group::point::Point;
use crate::element::group::points::{HasPoints, PointPlace, PointsInState};
use crate::element::group::view::StepView;
use crate::element::kinematics::{MeasureSet, Numbers, PerStrain, StrainMeasures};
use crate::element::state::State;
use crate::element::tableau::{MOST_STAGES, Tableau};
use crate::element::tally::{Reevaluation, Tally};
use eem_material::arrays::Arrays;
use eem_material::tabled::Tabled;

/// The points of models in the arrays `A`, with equations `E`.
pub(crate) struct StagePoints<A: Arrays, Q: MeasureSet, E> {
    rule: &'static Tableau,
    in_state: ModelPoints<A, Q, AnyScheme>,
    equations: Vec<E>,
}

impl<A: Arrays, Q: MeasureSet, E: StageEquations<A, Q>> StagePoints<A, Q, E> {
    /// The points of these models at their places, with equations for a point of the rule.
    pub(crate) fn new(
        rule: &'static Tableau,
        models: Vec<Tabled<A>>,
        places: &mut dyn Iterator<Item = PointPlace>,
        equations: &mut dyn FnMut(StagePoint) -> E,
    ) -> Self {
        let (scheme, count) = (OneSet::Point(PointRule::Variational), models.len());
        let mut all = Self {
            rule,
            in_state: ModelPoints::new(scheme, (&mut models.into_iter(), places, count)),
            equations: Vec::with_capacity(count),
        };
        let [unknowns, inputs] = all.unknowns_and_inputs();
        let (dashpots, is_thermal) = all.dashpots_and_temperature();
        for _ in 0..count {
            all.equations.push(equations(StagePoint {
                rule,
                dashpots,
                is_thermal,
                entropy: 0.0,
                prescribed: None,
                viscous_unit: 1.0,
                solved: vec![0.0; (1 + inputs) * unknowns],
            }));
        }
        all
    }

    /// Number of dashpots in series of every point, and whether they have a temperature.
    fn dashpots_and_temperature(&self) -> (usize, bool) {
        match self.in_state.points.first() {
            Some(first) => (first.dashpots(), first.is_thermal()),
            None => (0, false),
        }
    }

    fn unknowns_and_inputs(&self) -> [usize; 2] {
        let (dashpots, is_thermal) = self.dashpots_and_temperature();
        [
            E::unknowns_of(self.rule, (dashpots, is_thermal)),
            E::inputs_of(self.rule, is_thermal),
        ]
    }

    /// A point with its equations.
    fn at(&mut self, place: usize) -> (&mut Point<A, Q>, &mut E) {
        (&mut self.in_state.points[place], &mut self.equations[place])
    }
}

impl<A: Arrays, Q: MeasureSet, E: StageEquations<A, Q>> HasPoints<Q> for StagePoints<A, Q, E> {
    fn in_state(&self) -> &dyn PointsInState<Q> {
        &self.in_state
    }

    fn in_state_mut(&mut self) -> &mut dyn PointsInState<Q> {
        &mut self.in_state
    }

    fn into_models(self: Box<Self>) -> Box<dyn Any> {
        Box::new(self.in_state).into_models()
    }
}

impl<A: Arrays, Q: MeasureSet, E: StageEquations<A, Q>> StageModels<Q> for StagePoints<A, Q, E> {
    fn unknowns_and_inputs(&self) -> [usize; 2] {
        Self::unknowns_and_inputs(self)
    }

    fn begin(
        &mut self,
        place: usize,
        (measures, strain): (&Numbers<Q>, &[f64]),
        view: &StepView<'_>,
    ) {
        let (point, equations) = self.at(place);
        let x0 = point.variables_in(measures, view.state);
        let unit = Q::unit(measures);
        (equations.point_mut()).begin(unit, point.slots().thermal, view);
        equations.begin(point, &x0, strain);
        equations.hold();
    }

    fn condense(
        &mut self,
        place: usize,
        local: &mut LocalStages,
        view: &StepView<'_>,
    ) -> Result<(), StateError> {
        let (point, equations) = self.at(place);
        equations.condense(point, local, view)
    }

    fn force(&self, place: usize, local: &mut LocalStages, stage_and_force: [usize; 2]) -> f64 {
        self.equations[place].force(local, stage_and_force)
    }

    fn temperature(&self, place: usize, local: &mut LocalStages, set: usize) -> f64 {
        self.equations[place].temperature(local, set)
    }

    fn hold(&mut self) {
        for equations in &mut self.equations {
            equations.hold();
        }
    }

    fn correct(&mut self, place: usize, local: &LocalStages) -> f64 {
        let equations = &mut self.equations[place];
        equations.hold();
        let largest = equations.correct(local);
        equations.apply(1.0);
        largest
    }

    fn apply(&mut self, fraction: f64) {
        for equations in &mut self.equations {
            equations.apply(fraction);
        }
    }

    fn close(
        &mut self,
        place: usize,
        measures: &Numbers<Q>,
        view_and_outside: (&StepView<'_>, Outside<'_>),
        next_and_tally: (&mut State, &mut Tally),
    ) -> Result<(), StateError> {
        let (point, equations) = self.at(place);
        equations.close(point, measures, view_and_outside, next_and_tally)
    }

    fn is_reevaluated(&self) -> bool {
        let first = self.equations.first();
        first.is_some_and(|first| first.change_of_energy().is_some())
    }

    fn reevaluate(
        &self,
        place: usize,
        of_nodes: ([&Numbers<Q>; 2], &Numbers<Q>),
        ends: [&State; 2],
        reevaluation: &mut Reevaluation,
    ) {
        let Some(found) = self.equations[place].change_of_energy() else {
            return;
        };
        let point = &self.in_state.points[place];
        let own = point.balance_between(of_nodes, ends);
        reevaluation.element(point.element, own.by_values, own.by_differences, found);
    }
}

impl<A: Arrays, G: StrainMeasures> PathModels<G> for StagePoints<A, G::Measures, PointPath<A, G>> {
    fn evaluate(
        &mut self,
        place: usize,
        strain_rates: &[PerStrain<G>; MOST_STAGES],
        view_and_interface: (&StepView<'_>, &InterfaceTemperatures),
    ) -> Result<(), StateError> {
        let (point, path) = self.at(place);
        path.evaluate(point, strain_rates, view_and_interface)
    }

    fn stress(&self, place: usize, stage: usize) -> PerStrain<G> {
        self.equations[place].conjugates[stage].strain
    }

    fn limited_stress(&self, place: usize, stage: usize) -> PerStrain<G> {
        self.equations[place].limited_stress(stage)
    }

    fn stress_at_end(&self, place: usize) -> PerStrain<G> {
        self.equations[place].end_slopes[1].strain
    }

    fn conditioned_stress(&mut self, place: usize) -> [PerStrain<G>; MOST_STAGES] {
        let (point, path) = self.at(place);
        path.conditioned_stress(point)
    }
}

impl<A: Arrays, Q: MeasureSet> ValueModels<Q> for StagePoints<A, Q, StageValues<A>> {
    fn evaluate(
        &mut self,
        place: usize,
        (stage, measures): (usize, Option<&Numbers<Q>>),
        view_and_interface: (&StepView<'_>, &InterfaceTemperatures),
    ) -> Result<(), StateError> {
        let (point, values) = self.at(place);
        if let Some(measures) = measures {
            values.set_measures(stage, measures.as_ref());
        }
        values.evaluate(point, stage, view_and_interface)
    }

    fn measures_and_forces(&self, place: usize, stage: usize) -> [Numbers<Q>; 2] {
        self.equations[place].measures_and_forces::<Q>(stage)
    }
}

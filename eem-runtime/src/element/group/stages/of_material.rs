//! The points of one material at the stages.

use super::equations::StageEquations;
use super::models::{PathModels, StageModels, StrainOf, ValueModels};
use super::point::{LocalStages, Outside, StagePoint};
use super::projection::PointPath;
use super::values::StageValues;
use crate::element::conduction::InterfaceTemperatures;
use crate::element::conjugates::{OneSet, PointRule};
use crate::element::error::StateError;
use crate::element::group::element_group::ElementGroup;
use crate::element::group::interface::{Elements, Loose};
use crate::element::group::loose::LooseElements;
use crate::element::group::placed::PlacedPoint;
use crate::element::group::point::variables;
use crate::element::group::site::Site;
use crate::element::group::view::{Placed, StepView};
use crate::element::kinematics::{Kinematics, MeasureSet, Measures, Points, QuadraticStrain};
use crate::element::state::State;
use crate::element::tableau::{MOST_STAGES, Tableau};
use crate::element::tally::{Reevaluation, Tally};
use eem_material::arrays::Arrays;

/// The points of all elements of the model `A`, with equations `E`.
pub(crate) struct OfMaterial<A: Arrays, K: Kinematics<D>, E, const D: usize> {
    rule: &'static Tableau,
    /// The elements in a state.
    elements: ElementGroup<A, K, D>,
    equations: Vec<E>,
}

impl<A: Arrays, K: Kinematics<D>, E: StageEquations<A, K::Measures>, const D: usize>
    OfMaterial<A, K, E, D>
{
    /// The elements, with equations for a kind of kinematics and a point of the rule.
    pub(crate) fn new(
        rule: &'static Tableau,
        elements: LooseElements<A, K, D>,
        placed: Placed<'_>,
        equations: impl Fn(&K, StagePoint) -> E,
    ) -> Self {
        let scheme = OneSet::Point(PointRule::Variational);
        let mut all = Self {
            rule,
            elements: ElementGroup::new(scheme, elements, placed),
            equations: Vec::new(),
        };
        let [unknowns, inputs] = all.unknowns_and_inputs();
        let (dashpots, is_thermal) = all.dashpots_and_temperature();
        for point in all.elements.points() {
            let staged = StagePoint {
                rule,
                dashpots,
                is_thermal,
                entropy: 0.0,
                prescribed: None,
                viscous_unit: 1.0,
                solved: vec![0.0; (1 + inputs) * unknowns],
            };
            all.equations.push(equations(&point.kinematics, staged));
        }
        all
    }

    /// Number of dashpots in series of every point, and whether they have a temperature.
    fn dashpots_and_temperature(&self) -> (usize, bool) {
        match self.elements.members.first() {
            Some(first) => (first.only().dashpots(), first.only().is_thermal()),
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
    fn at(&mut self, place: usize) -> (&mut PlacedPoint<A, K, D>, &mut E) {
        let points = K::PerPoint::<()>::LEN;
        let member = &mut self.elements.members[place / points];
        let point = &mut member.points.as_mut()[place % points];
        (point, &mut self.equations[place])
    }
}

impl<A: Arrays, K: QuadraticStrain<D>, E: StageEquations<A, K::Measures>, const D: usize>
    StageModels<K, D> for OfMaterial<A, K, E, D>
{
    fn elements(&self) -> &dyn Elements<D> {
        &self.elements
    }

    fn elements_mut(&mut self) -> &mut dyn Elements<D> {
        &mut self.elements
    }

    fn into_loose(self: Box<Self>) -> Box<dyn Loose<D>> {
        Box::new(self.elements.into_loose())
    }

    fn sites(&self) -> Vec<Site<K, D>> {
        let mut sites = Vec::with_capacity(self.elements.members.len());
        for member in &self.elements.members {
            sites.push(member.site);
        }
        sites
    }

    fn kinematics(&self, place: usize) -> K {
        let (member, point) = self.elements.at(place);
        member.points.as_ref()[point].kinematics
    }

    fn unknowns_and_inputs(&self) -> [usize; 2] {
        Self::unknowns_and_inputs(self)
    }

    fn begin(
        &mut self,
        place: usize,
        (measures, strain): (&Measures<K, D>, &[f64]),
        view: &StepView<'_>,
    ) {
        let (point, equations) = self.at(place);
        let x0 = variables(&point.model, measures.as_ref(), point.slots(), view.state);
        let unit = K::Measures::unit(measures);
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
        measures: &Measures<K, D>,
        view_and_outside: (&StepView<'_>, Outside<'_>),
        next_and_tally: (&mut State, &mut Tally),
    ) -> Result<(), StateError> {
        let (point, equations) = self.at(place);
        equations.close(point, measures, view_and_outside, next_and_tally)
    }

    fn reevaluate(&self, ends: [&State; 2], reevaluation: &mut Reevaluation) {
        for (place, equations) in self.equations.iter().enumerate() {
            let Some(found) = equations.change_of_energy() else {
                return;
            };
            let (member, point) = self.elements.at(place);
            let point = &member.points.as_ref()[point];
            let own = point.balance_between(&member.site.nodes, ends);
            reevaluation.element(point.element, own.by_values, own.by_differences, found);
        }
    }
}

impl<A: Arrays, K: QuadraticStrain<D>, const D: usize> PathModels<K, D>
    for OfMaterial<A, K, PointPath<A, K::Strain>, D>
{
    fn evaluate(
        &mut self,
        place: usize,
        strain_rates: &[StrainOf<K, D>; MOST_STAGES],
        view_and_interface: (&StepView<'_>, &InterfaceTemperatures),
    ) -> Result<(), StateError> {
        let (point, path) = self.at(place);
        path.evaluate(point, strain_rates, view_and_interface)
    }

    fn stress(&self, place: usize, stage: usize) -> StrainOf<K, D> {
        self.equations[place].conjugates[stage].strain
    }

    fn limited_stress(&self, place: usize, stage: usize) -> StrainOf<K, D> {
        self.equations[place].limited_stress(stage)
    }

    fn stress_at_end(&self, place: usize) -> StrainOf<K, D> {
        self.equations[place].end_slopes[1].strain
    }

    fn conditioned_stress(&mut self, place: usize) -> [StrainOf<K, D>; MOST_STAGES] {
        let (point, path) = self.at(place);
        path.conditioned_stress(point)
    }
}

impl<A: Arrays, K: QuadraticStrain<D>, const D: usize> ValueModels<K, D>
    for OfMaterial<A, K, StageValues<A>, D>
{
    fn evaluate(
        &mut self,
        place: usize,
        (stage, measures): (usize, Option<&Measures<K, D>>),
        view_and_interface: (&StepView<'_>, &InterfaceTemperatures),
    ) -> Result<(), StateError> {
        let (point, values) = self.at(place);
        if let Some(measures) = measures {
            values.set_measures(stage, measures.as_ref());
        }
        values.evaluate(&mut point.point, stage, view_and_interface)
    }

    fn measures_and_forces(&self, place: usize, stage: usize) -> [Measures<K, D>; 2] {
        self.equations[place].measures_and_forces::<K::Measures>(stage)
    }
}

//! The elements of one model, stepped through stages.

use super::forces::StageForces;
use super::local::LocalStages;
use super::member::StageMember;
use super::site::{StageSite, contacts};
use super::source::Source;
use crate::algebra::system::LinearSystem;
use crate::element::conjugates::PointRule;
use crate::element::error::StateError;
use crate::element::group::element_group::ElementGroup;
use crate::element::group::interface::{Elements, Group, Loose};
use crate::element::group::loose::LooseElements;
use crate::element::group::view::{Along, ElementGeneric, Old, Placed, Sites, StepView, Trial};
use crate::element::impulse::Impulses;
use crate::element::kinematics::{Kinematics, QuadraticStrain};
use crate::element::state::State;
use crate::element::tableau::Tableau;
use crate::element::tally::{Recount, Tally};
use eem_material::free_energy::Material;
use eem_material::number::scalar::Real;

/// Elements of the model `M` with the kinematics `K`.
pub(crate) struct StageGroup<
    S: Real,
    M: Material<S>,
    K: Kinematics<S, D>,
    C: Source<S, M, K, D>,
    const D: usize,
> {
    pub(super) rule: &'static Tableau,
    /// What they are in a state.
    pub(super) elements: ElementGroup<S, M, K, PointRule, D>,
    pub(super) members: Vec<StageMember<S, M, K, C, D>>,
    pub(super) local: LocalStages<S>,
    /// Those of one element.
    pub(super) forces: Box<StageForces<K, S, D>>,
}

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, C: Source<S, M, K, D>, const D: usize>
    StageGroup<S, M, K, C, D>
{
    pub(crate) fn new(
        rule: &'static Tableau,
        elements: LooseElements<S, M, K, D>,
        placed: Placed<'_>,
    ) -> Self {
        let elements = ElementGroup::new(PointRule::Variational, elements, placed);
        let members = elements.members.iter();
        let members = members.map(|member| StageMember::new(member, rule));
        Self {
            rule,
            members: members.collect(),
            forces: Box::new(StageForces::zero()),
            local: LocalStages::new::<M>(rule, C::inputs_of(rule)),
            elements,
        }
    }
}

impl<S: Real, M: Material<S>, K: QuadraticStrain<S, D>, C: Source<S, M, K, D>, const D: usize>
    Group<S, D> for StageGroup<S, M, K, C, D>
{
    fn elements(&self) -> &dyn Elements<S, D> {
        &self.elements
    }

    fn elements_mut(&mut self) -> &mut dyn Elements<S, D> {
        &mut self.elements
    }

    fn into_loose(self: Box<Self>) -> Box<dyn Loose<S, D>> {
        Box::new(self.elements.into_loose())
    }

    fn connect(&mut self, sites: &Sites<'_, S, D>) {
        for (member, stages) in self.elements.members.iter().zip(&mut self.members) {
            let (rule, nodes) = (self.rule, &member.site.nodes);
            stages.site = StageSite::new(rule, nodes, sites);
            let points = stages.points.iter_mut();
            for (point, in_state) in points.zip(member.points.as_ref()) {
                point.contacts = contacts(rule, nodes, in_state.slots().thermal, sites);
            }
        }
    }

    fn begin(&mut self, view: &StepView<'_, S>, old: &mut Old<'_, S, D>) -> Result<(), StateError> {
        for (member, stages) in self.elements.members.iter().zip(&mut self.members) {
            stages.begin(member, view, old.lengths);
        }
        Ok(())
    }

    fn evaluate(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        system: Option<&mut LinearSystem<S, 1>>,
    ) -> Result<(), StateError> {
        let members = self.elements.members.iter_mut().zip(&mut self.members);
        for (member, stages) in members {
            let arms = stages.arms(self.rule, trial);
            let points = stages.points.iter_mut();
            for (point, in_state) in points.zip(member.points.as_mut()) {
                C::evaluate(point, in_state, self.rule, (view, trial), &arms)?;
            }
        }
        match system {
            None => Ok(()),
            Some(system) => self.assemble_all(view, trial, system),
        }
    }

    fn correct(&mut self, solution: &[[S; 1]], _: S::Mask) -> S {
        self.correct_all(solution)
    }

    fn apply(&mut self, share: S) {
        let points = self.members.iter_mut();
        let points = points.flat_map(|stages| &mut stages.points);
        points.for_each(|point| C::apply(point, self.rule, share));
    }

    fn hold(&mut self) {
        let points = self.members.iter_mut();
        let points = points.flat_map(|stages| &mut stages.points);
        points.for_each(C::hold);
    }

    fn add_impulse(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        along: Along,
        impulses: &mut Impulses<'_, S, D>,
        magnitudes: &mut [S],
    ) {
        if let Along::Stage(stage) = along {
            self.add_impulse_of(stage, view, trial, impulses, magnitudes);
        }
    }

    fn add_secant(
        &mut self,
        set: usize,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        system: &mut LinearSystem<S, D>,
    ) {
        self.add_secant_all(set, view, trial, system);
    }

    fn close(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        next: &mut State<S>,
        tally: &mut Tally<S>,
    ) -> Result<(), StateError> {
        self.close_all(view, trial, next, tally)
    }

    fn recount(&self, ends: [&State<S>; 2], recount: &mut Recount<S>) {
        for (member, stages) in self.elements.members.iter().zip(&self.members) {
            let of_step = (self.rule, &member.site.nodes);
            for (point, in_state) in stages.points.iter().zip(member.points.as_ref()) {
                C::recount(point, in_state, of_step, ends, recount);
            }
        }
    }

    fn generic_of_step(&self, _: [&State<S>; 2]) -> Vec<ElementGeneric<S>> {
        Vec::new()
    }
}

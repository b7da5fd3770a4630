//! The elements of one model, stepped through stages.
//!
//! Newton's method leaves an error in the trial stages. At the end of a step `f`, `g` and `θ` of the stages are taken as
//! given, and the remaining relations are evaluated explicitly from them: the balances of momentum and entropy then hold
//! to rounding whatever that error is.

use super::assemble::{StageForces, Target};
use super::point::{
    LocalStages, StageArms, StageMember, StagePoint, StagedPoint, StateMember, StatePoint, paths_of,
};
use super::site::{StageSite, contacts};
use super::source::{Source, StageEquations};
use crate::algebra::system::LinearSystem;
use crate::element::conjugates::{OneSet, PointRule};
use crate::element::error::StateError;
use crate::element::group::arms::arms_in;
use crate::element::group::begin::shorten;
use crate::element::group::element_group::ElementGroup;
use crate::element::group::interface::{Elements, Group, Loose};
use crate::element::group::loose::LooseElements;
use crate::element::group::point::variables;
use crate::element::group::view::{Along, Old, Placed, Sites, StepView, Trial};
use crate::element::group::ways::StageWays;
use crate::element::impulse::Impulses;
use crate::element::kinematics::{Arms, Kinematics, MeasureSet, QuadraticStrain, add_blocks};
use crate::element::state::State;
use crate::element::tableau::{MOST_SETS, Tableau};
use crate::element::tally::{Care, Reevaluation, Tally};
use eem_material::free_energy::{Array, Material};
use eem_material::number::scalar::Scalar;

/// Elements of the model `M` with the kinematics `K`, with conjugates from the source `C`.
pub(crate) struct StageGroup<M: Material, K: Kinematics<D>, C: Source<M, K, D>, const D: usize> {
    pub(super) rule: &'static Tableau,
    /// The elements in a state.
    pub(super) elements: ElementGroup<M, K, D>,
    pub(super) members: Vec<StageMember<K, C, D>>,
    pub(super) local: LocalStages,
    /// The forces of one element.
    pub(super) forces: Box<StageForces<K, D>>,
}

impl<M: Material, K: Kinematics<D>, C: Source<M, K, D>, const D: usize> StageGroup<M, K, C, D> {
    pub(crate) fn new(
        rule: &'static Tableau,
        elements: LooseElements<M, K, D>,
        placed: Placed<'_>,
    ) -> Self {
        let scheme = OneSet::Point(PointRule::Variational);
        let elements = ElementGroup::new(scheme, elements, placed);
        let dashpots = elements
            .points()
            .next()
            .map_or(0, |in_state| in_state.dashpots());
        let unknowns = C::Equations::unknowns_of(rule, dashpots);
        let inputs = C::Equations::inputs_of(rule);
        let point = || StagePoint {
            rule,
            dashpots,
            entropy: 0.0,
            prescribed: None,
            viscous_unit: 1.0,
            solved: vec![0.0; (1 + inputs) * unknowns],
        };
        let source = |in_state: &StatePoint<M, K, D>| StagedPoint {
            source: C::new(in_state.kinematics, point()),
            contacts: None,
        };
        let staged = |member: &StateMember<M, K, D>| StageMember {
            site: StageSite::unconnected(member.site),
            points: member.points.as_ref().iter().map(source).collect(),
        };
        Self {
            rule,
            members: elements.members.iter().map(staged).collect(),
            forces: Box::new(StageForces::zero()),
            local: LocalStages::new(unknowns, inputs),
            elements,
        }
    }

    /// Eliminates the local unknowns at an evaluated trial, and adds residual and tangent.
    fn assemble(
        &mut self,
        (view, trial): (&StepView<'_>, &Trial<D>),
        system: &mut LinearSystem<1>,
    ) -> Result<(), StateError> {
        let rule = self.rule;
        let (values, right) = system.parts();
        for (member, stages) in self.elements.members.iter().zip(&mut self.members) {
            let arms = StageArms::<K, D>::new(rule, &member.site.nodes, (view, trial));
            self.forces.clear(rule);
            let mut target = Target {
                rule,
                step: view.step,
                site: &stages.site,
                local: &mut self.local,
                forces: &mut self.forces,
                values: &mut *values,
                right: &mut *right,
            };
            for (point, in_state) in stages.points.iter_mut().zip(member.points.as_ref()) {
                let source = &mut point.source;
                (source.equations_mut()).condense(in_state, target.local, view)?;
                let bases = source.bases();
                target.add_forces(point, &bases);
                for set in 0..rule.sets() {
                    let blocks = &mut target.forces.blocks[rule.stage_of(set)][set];
                    add_blocks::<K, D>(blocks, &point.source.geometric_stiffness(set, &arms));
                }
                if let Some(slot) = in_state.slots().thermal {
                    target.add_temperatures(point, &bases, (slot, trial));
                }
            }
            target.add_impulses();
        }
        Ok(())
    }
}

impl<M: Material, K: QuadraticStrain<D>, C: Source<M, K, D>, const D: usize> Group<D>
    for StageGroup<M, K, C, D>
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

    fn connect(&mut self, sites: &Sites<'_, D>) {
        for (member, stages) in self.elements.members.iter().zip(&mut self.members) {
            let (rule, nodes) = (self.rule, &member.site.nodes);
            stages.site = StageSite::new(rule, nodes, sites);
            for (point, in_state) in stages.points.iter_mut().zip(member.points.as_ref()) {
                let slot = in_state.slots().thermal;
                point.contacts = contacts(rule, nodes, slot, sites);
            }
        }
    }

    fn begin(&mut self, view: &StepView<'_>, old: &mut Old<'_, D>) -> Result<(), StateError> {
        for (member, stages) in self.elements.members.iter().zip(&mut self.members) {
            let nodes = &member.site.nodes;
            let r0 = arms_in::<K, D>(nodes, &view.state.positions);
            for (point, in_state) in stages.points.iter_mut().zip(member.points.as_ref()) {
                let (slots, kinematics) = (in_state.slots(), &in_state.kinematics);
                let measures = kinematics.measure(&r0);
                shorten::<K, D>(nodes, kinematics.length(&measures), old.lengths);
                let x0 = variables(&in_state.model, measures.as_ref(), slots, view.state);
                let (unit, source) = (K::Measures::unit(&measures), &mut point.source);
                (source.equations_mut().point_mut()).begin(unit, slots.thermal, view);
                source.begin(in_state, &x0, &r0);
                source.equations_mut().hold();
            }
        }
        Ok(())
    }

    fn evaluate(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        system: Option<&mut LinearSystem<1>>,
    ) -> Result<(), StateError> {
        for (member, stages) in (self.elements.members.iter_mut()).zip(&mut self.members) {
            let arms = StageArms::new(self.rule, &member.site.nodes, (view, trial));
            for (point, in_state) in stages.points.iter_mut().zip(member.points.as_mut()) {
                (point.source).evaluate(in_state, (view, &trial.interface), &arms)?;
            }
        }
        match system {
            None => Ok(()),
            Some(system) => self.assemble((view, trial), system),
        }
    }

    fn correct(&mut self, solution: &[[f64; 1]]) -> f64 {
        let (rule, local) = (self.rule, &mut self.local);
        let mut largest = 0.0;
        for stages in &mut self.members {
            let mut motions = [Arms::<K, D>::filled([0.0; D]); MOST_SETS];
            for (set, motion) in motions.iter_mut().enumerate().take(rule.sets()) {
                *motion = stages.site.sets[set][set].motion_in(solution);
            }
            for point in &mut stages.points {
                let (strains, heat) = local.inputs.split_at_mut(rule.sets() * C::FORCES);
                point.source.inputs(&motions, strains);
                for (stage, input) in heat.iter_mut().enumerate() {
                    *input = point.heat_change(rule, stage, solution);
                }
                let equations = point.source.equations_mut();
                equations.hold();
                largest = Scalar::maximum(largest, equations.correct(local));
                equations.apply(1.0);
            }
        }
        largest
    }

    fn apply(&mut self, share: f64) {
        for stages in &mut self.members {
            for point in &mut stages.points {
                point.source.equations_mut().apply(share);
            }
        }
    }

    fn hold(&mut self) {
        for stages in &mut self.members {
            for point in &mut stages.points {
                point.source.equations_mut().hold();
            }
        }
    }

    fn add_impulse(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        along: Along,
        impulses: &mut Impulses<'_, D>,
        magnitudes: &mut [f64],
    ) {
        let Along::Stage(stage) = along else {
            return;
        };
        for (member, stages) in self.elements.members.iter().zip(&mut self.members) {
            let nodes = &stages.site.first().nodes;
            let arms = StageArms::new(self.rule, nodes, (view, trial));
            for (point, in_state) in stages.points.iter_mut().zip(member.points.as_ref()) {
                let force = point.source.nodal_force(stage, &arms);
                for (&node, force) in nodes.as_ref().iter().zip(force.as_ref()) {
                    for (sum, &force) in impulses.of(node as usize).iter_mut().zip(force) {
                        *sum -= view.step * force;
                    }
                }
                if stage == 0 && !magnitudes.is_empty() {
                    let magnitude = point.source.impulse_size(in_state, view.step);
                    for &node in nodes.as_ref() {
                        magnitudes[node as usize] += magnitude;
                    }
                }
            }
        }
    }

    fn add_secant(
        &mut self,
        set: usize,
        view: &StepView<'_>,
        trial: &Trial<D>,
        system: &mut LinearSystem<D>,
    ) {
        let stage = self.rule.stage_of(set);
        let impulse = view.step * self.rule.positions[set][stage];
        let (values, right) = system.parts();
        for stages in &self.members {
            let site = stages.site.first();
            let mut known = arms_in::<K, D>(&site.nodes, &view.state.positions);
            site.add_anchors(&mut known, trial.displacements_of_set(set));
            for point in &stages.points {
                let weights = point.source.secant(stage);
                stages.site.add_secant(&weights, impulse, values);
                site.subtract_known(&weights, (&known, impulse), right);
            }
        }
    }

    fn close(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        next: &mut State,
        tally: &mut Tally,
    ) -> Result<(), StateError> {
        for (member, stages) in (self.elements.members.iter_mut()).zip(&mut self.members) {
            let r1 = member.arms_in(next);
            for (point, in_state) in stages.points.iter_mut().zip(member.points.as_mut()) {
                let outside = (point.contacts.as_ref().map(paths_of), &trial.interface);
                (point.source).close(in_state, &r1, (view, outside), (next, tally))?;
            }
            if tally.care == Care::Thorough {
                let nodes = member.site.nodes.as_ref();
                let ways = StageWays::new(self.rule, nodes, (view, trial));
                for point in &stages.points {
                    tally.force(point.source.work_along(&ways, &r1));
                }
            }
        }
        Ok(())
    }

    fn reevaluate(&self, ends: [&State; 2], reevaluation: &mut Reevaluation) {
        for (member, stages) in self.elements.members.iter().zip(&self.members) {
            for (point, in_state) in stages.points.iter().zip(member.points.as_ref()) {
                (point.source).reevaluate(in_state, &member.site.nodes, ends, reevaluation);
            }
        }
    }
}

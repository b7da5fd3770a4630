//! The elements of one model, stepped through stages.
//!
//! Newton's method leaves an error in the trial stages. At the end of a step `f`, `g` and `θ` of the stages are taken as
//! given, and the remaining relations are evaluated explicitly from them: the balances of momentum and entropy then hold
//! to rounding whatever that error is.

use super::assemble::{StageForces, Target};
use super::geometry::Geometry;
use super::models::StageModels;
use super::point::{LocalStages, StageArms, StageMember, StagedPoint, paths_of};
use super::site::{StageSite, contacts};
use crate::algebra::system::LinearSystem;
use crate::element::conjugates::{OneSet, PointRule};
use crate::element::error::StateError;
use crate::element::group::arms::arms_in;
use crate::element::group::begin::shorten;
use crate::element::group::elements::Blocks;
use crate::element::group::interface::{Elements, Group, Loose};
use crate::element::group::loose::LooseElements;
use crate::element::group::member::Member;
use crate::element::group::placed::admissible;
use crate::element::group::points::HasPoints;
use crate::element::group::view::{Along, Old, Placed, Sites, StepView, Trial};
use crate::element::group::ways::StageWays;
use crate::element::impulse::Impulses;
use crate::element::kinematics::{Arms, QuadraticStrain, add_blocks};
use crate::element::state::State;
use crate::element::tableau::{MOST_SETS, Tableau};
use crate::element::tally::{Care, Reevaluation, Tally};
use eem_material::free_energy::Array;
use eem_material::number::scalar::Scalar;

/// Elements of one model with the kinematics `K`, whose points have the geometry `G`.
pub(crate) struct StageGroup<K: QuadraticStrain<D>, G: Geometry<K, D>, const D: usize> {
    rule: &'static Tableau,
    /// In one block.
    elements: Blocks<K, G::Models, D>,
    /// Their models are in the block.
    loose: LooseElements<K, D>,
    members: Vec<StageMember<K, G, D>>,
    local: LocalStages,
    /// The forces of one element.
    forces: Box<StageForces<K, D>>,
}

impl<K: QuadraticStrain<D>, G: Geometry<K, D>, const D: usize> StageGroup<K, G, D> {
    /// Elements whose models have been given to these points.
    pub(crate) fn new(
        rule: &'static Tableau,
        loose: LooseElements<K, D>,
        models: Box<G::Models>,
        placed: Placed<'_>,
    ) -> Self {
        let [unknowns, inputs] = models.unknowns_and_inputs();
        let scheme = OneSet::Point(PointRule::Variational);
        let how = (loose.elements.len().max(1), placed);
        let elements: Blocks<K, G::Models, D> =
            Blocks::new(scheme, &loose.elements, vec![models], how);
        let block = &elements.blocks[0];
        let (mut members, mut place) = (Vec::new(), 0);
        for own in &block.members {
            let mut points = Vec::with_capacity(Member::<K, D>::POINTS);
            for point in own.points.as_ref() {
                let (handle, slots) = block.points.in_state().place(place);
                points.push(StagedPoint {
                    place,
                    element: handle,
                    slot: slots.thermal,
                    geometry: G::new(rule, point.kinematics),
                    contacts: None,
                });
                place += 1;
            }
            members.push(StageMember {
                site: StageSite::unconnected(own.site),
                points,
            });
        }
        Self {
            rule,
            elements,
            members,
            loose: loose.without_elements(),
            forces: Box::new(StageForces::zero()),
            local: LocalStages::new(unknowns, inputs),
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
        for stages in &mut self.members {
            let arms = StageArms::<K, D>::new(rule, &stages.site.first().nodes, (view, trial));
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
            for point in &stages.points {
                self.elements.blocks[0]
                    .points
                    .condense(point.place, target.local, view)?;
                let bases = point.geometry.bases();
                target.add_forces(&*self.elements.blocks[0].points, point, &bases);
                for set in 0..rule.sets() {
                    let blocks = &mut target.forces.blocks[rule.stage_of(set)][set];
                    let at = (&*self.elements.blocks[0].points, point.place);
                    add_blocks::<K, D>(blocks, &point.geometry.geometric_stiffness(at, set, &arms));
                }
                if let Some(slot) = point.slot {
                    target.add_temperatures(
                        &*self.elements.blocks[0].points,
                        point,
                        &bases,
                        (slot, trial),
                    );
                }
            }
            target.add_impulses();
        }
        Ok(())
    }
}

impl<K: QuadraticStrain<D>, G: Geometry<K, D>, const D: usize> Group<D> for StageGroup<K, G, D> {
    fn elements(&self) -> &dyn Elements {
        &self.elements
    }

    fn elements_mut(&mut self) -> &mut dyn Elements {
        &mut self.elements
    }

    fn into_loose(self: Box<Self>) -> Box<dyn Loose<D>> {
        let mut loose = self.loose;
        let mut take_back = |own| loose.models.take_back(own);
        loose.elements = self.elements.into_loose(&mut take_back);
        Box::new(loose)
    }

    fn connect(&mut self, sites: &Sites<'_, D>) {
        for stages in &mut self.members {
            let (rule, nodes) = (self.rule, stages.site.first().nodes);
            stages.site = StageSite::new(rule, &nodes, sites);
            for point in &mut stages.points {
                point.contacts = contacts(rule, &nodes, point.slot, sites);
            }
        }
    }

    fn begin(&mut self, view: &StepView<'_>, old: &mut Old<'_, D>) -> Result<(), StateError> {
        for stages in &mut self.members {
            let nodes = &stages.site.first().nodes;
            let r0 = arms_in::<K, D>(nodes, &view.state.positions);
            for point in &mut stages.points {
                let kinematics = point.geometry.kinematics();
                let measures = kinematics.measure(&r0);
                shorten::<K, D>(nodes, kinematics.length(&measures), old.lengths);
                let at = (&mut *self.elements.blocks[0].points, point.place);
                point.geometry.begin(at, (&r0, &measures), view);
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
        for stages in &mut self.members {
            let arms = StageArms::new(self.rule, &stages.site.first().nodes, (view, trial));
            for point in &mut stages.points {
                let at = (&mut *self.elements.blocks[0].points, point.place);
                let view = (view, &trial.interface);
                (point.geometry).evaluate(at, point.element, view, &arms)?;
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
        for stages in &self.members {
            let mut motions = [Arms::<K, D>::filled([0.0; D]); MOST_SETS];
            for (set, motion) in motions.iter_mut().enumerate().take(rule.sets()) {
                *motion = stages.site.sets[set][set].motion_in(solution);
            }
            for point in &stages.points {
                let (strains, heat) = local.inputs.split_at_mut(rule.sets() * G::FORCES);
                point.geometry.inputs(&motions, strains);
                for (stage, input) in heat.iter_mut().enumerate() {
                    *input = point.heat_change(rule, stage, solution);
                }
                largest = Scalar::maximum(
                    largest,
                    self.elements.blocks[0].points.correct(point.place, local),
                );
            }
        }
        largest
    }

    fn apply(&mut self, share: f64) {
        self.elements.blocks[0].points.apply(share);
    }

    fn hold(&mut self) {
        self.elements.blocks[0].points.hold();
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
        for stages in &self.members {
            let nodes = &stages.site.first().nodes;
            let arms = StageArms::new(self.rule, nodes, (view, trial));
            for point in &stages.points {
                let at = (&*self.elements.blocks[0].points, point.place);
                let force = point.geometry.nodal_force(at, stage, &arms);
                for (&node, force) in nodes.as_ref().iter().zip(force.as_ref()) {
                    for (sum, &force) in impulses.of(node as usize).iter_mut().zip(force) {
                        *sum -= view.step * force;
                    }
                }
                if stage == 0 && !magnitudes.is_empty() {
                    let at = (&mut *self.elements.blocks[0].points, point.place);
                    let magnitude = point.geometry.impulse_size(at, view.step);
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
                let weights = point
                    .geometry
                    .secant((&*self.elements.blocks[0].points, point.place), stage);
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
        for stages in &self.members {
            let nodes = &stages.site.first().nodes;
            let r1 = arms_in::<K, D>(nodes, &next.positions);
            for StagedPoint {
                place,
                element,
                geometry,
                contacts,
                ..
            } in &stages.points
            {
                let measures = admissible(geometry.kinematics(), *element, &r1)?;
                geometry.see_impulse((&*self.elements.blocks[0].points, *place), view.step, tally);
                let outside = (contacts.as_ref().map(paths_of), &trial.interface);
                (self.elements.blocks[0].points).close(
                    *place,
                    &measures,
                    (view, outside),
                    (next, tally),
                )?;
            }
            if tally.care == Care::Thorough {
                let ways = StageWays::new(self.rule, nodes.as_ref(), (view, trial));
                for point in &stages.points {
                    let at = (&*self.elements.blocks[0].points, point.place);
                    tally.force(point.geometry.work_along(at, &ways, &r1));
                }
            }
        }
        Ok(())
    }

    fn reevaluate(&self, ends: [&State; 2], reevaluation: &mut Reevaluation) {
        let block = &self.elements.blocks[0];
        if !block.points.is_reevaluated() {
            return;
        }
        for (first, member) in block.elements() {
            for (place, point) in (first..).zip(member.points.as_ref()) {
                let (measures, increments) = point.increments_between(&member.site.nodes, ends);
                let of_nodes = (measures.each_ref(), &increments);
                block.points.reevaluate(place, of_nodes, ends, reevaluation);
            }
        }
    }
}

//! The end of a step: the new state from the increments that were found, and its certificate.

mod masses;
mod path;
mod stages;
mod supports;

use super::Solver;
use super::begin::old_force;
use crate::algebra::{scaled, vector};
use crate::element::group::{Along, Group, StepView, points};
use crate::element::state::State;
use crate::element::tally::{Care, Reevaluation, Tally};
use crate::step::certificate::{Certificate, Internal, Kept, Motion, NodeStep, Speeds};
use crate::step::error::StepFailure;
use crate::step::scheme::Closing;

impl<const D: usize> Solver<D> {
    /// Writes the new state to `next`, from the increments at which the elements have been evaluated, and finds its
    /// certificate. It may be called again at another trial.
    #[inline]
    pub(super) fn close(
        &mut self,
        groups: &mut [Box<dyn Group<D>>],
        view: &StepView<'_>,
        next: &mut State,
    ) -> Result<(), StepFailure> {
        self.close_with(Care::Quick, groups, view, next)?;
        if !self.scheme.is_exact() {
            return Ok(());
        }
        if !self.certificate.is_enough() {
            self.close_thoroughly(groups, view, next)?;
        }
        if self.certificate.is_bound_wide() {
            self.certificate.find_terms(groups, [view.state, next]);
        }
        Ok(())
    }

    /// Closes the step with thorough bounds; energy changes by discrete derivatives decide where those by values are too
    /// inaccurate.
    #[cold]
    fn close_thoroughly(
        &mut self,
        groups: &mut [Box<dyn Group<D>>],
        view: &StepView<'_>,
        next: &mut State,
    ) -> Result<(), StepFailure> {
        let quick = self.certificate;
        self.close_with(Care::Thorough, groups, view, next)?;
        if !self.certificate.has_enough_energy() {
            let mut reevaluation = Reevaluation::new();
            for group in groups.iter() {
                group.reevaluate([view.state, next], &mut reevaluation);
            }
            self.worst = reevaluation.worst();
            self.certificate = self.certificate.reevaluated(&reevaluation);
        }
        self.certificate = quick.sharpened_by(self.certificate);
        Ok(())
    }

    fn close_with(
        &mut self,
        care: Care,
        groups: &mut [Box<dyn Group<D>>],
        view: &StepView<'_>,
        next: &mut State,
    ) -> Result<(), StepFailure> {
        next.copy_books(view.state);
        if view.phase.heats() {
            next.time.add(view.step);
        }
        let mut tally = Tally::new(care);
        let mut motion = Motion::new(self.kept(view));
        if self.stages.is_none() {
            self.final_residual = 0.0;
        }
        if self.scheme.closing() == Closing::Stages {
            self.forget_magnitudes(care);
            self.move_through_stages(groups, view, next, (&mut motion, &mut tally))?;
        } else if view.phase.moves() {
            self.find_motion(groups, view, care);
            self.move_masses(view, next, &mut motion, &mut tally)?;
            self.move_anchors(view, next, &mut motion);
        } else {
            next.positions.copy_from(&view.state.positions);
            next.momenta.copy_from(&view.state.momenta);
            next.velocities.copy_from(&view.state.velocities);
        }
        for group in groups.iter_mut() {
            group.close(view, &self.trial, next, &mut tally)?;
        }
        let internal = Internal::new(&view.conduction.reservoirs, [view.state, next]);
        self.certificate = Certificate::new(&motion, &tally, &internal);
        Ok(())
    }

    /// The momenta that the scene conserves and the scheme proves.
    #[inline]
    fn kept(&self, view: &StepView<'_>) -> Kept<D> {
        if !view.loads.moved.is_empty() || !self.scheme.is_exact() {
            return Kept::None;
        }
        match *self.anchors {
            [] => Kept::Both,
            [anchor] => Kept::Angular(points(view.state.positions.values())[anchor]),
            _ => Kept::None,
        }
    }

    /// Finds impulses, and displacements where these follow from impulses.
    #[inline]
    pub(super) fn find_motion(
        &mut self,
        groups: &mut [Box<dyn Group<D>>],
        view: &StepView<'_>,
        care: Care,
    ) {
        self.forget_magnitudes(care);
        match self.scheme.closing() {
            Closing::Increments => {
                let is_along_scheme = self.scheme.has_old_forces();
                let along = if is_along_scheme {
                    Along::Scheme
                } else {
                    Along::Secant
                };
                self.find_impulse(groups, view, along);
            }
            Closing::Start => {
                self.find_impulse(groups, view, Along::Scheme);
                self.move_from_start(groups, view);
            }
            Closing::Stages | Closing::Explicit => {}
        }
    }

    /// Clears the magnitudes of the forces, and makes room for them if a thorough bound needs them.
    #[inline]
    fn forget_magnitudes(&mut self, care: Care) {
        self.magnitudes.clear();
        if care == Care::Thorough {
            self.magnitudes.resize(self.lengths.len(), 0.0);
        }
    }

    /// Sets the new positions of moved anchors, and adds the work of their supports.
    #[inline]
    fn move_anchors(&mut self, view: &StepView<'_>, next: &mut State, motion: &mut Motion<D>) {
        let old = &view.state.positions;
        let mut impulses = self.past.impulses();
        for &node in &view.loads.moved {
            for axis in 0..D {
                let at = node * D + axis;
                let displacement = self.trial.displacements[node][axis];
                next.positions.advance(at, old, displacement);
                // The support bears the impulse of the springs.
                let support = -impulses.of(node)[axis] / view.step;
                next.work.add(support * displacement);
                motion.work(support * displacement);
            }
            if view.masses.are_coupled() {
                let displacement = &self.trial.displacements[node];
                let work = carry(node, displacement, view, next, motion);
                next.work.add(work);
                motion.work(work);
            }
        }
    }

    /// Sets the impulses to `−h F`, with the forces F at the trial.
    #[inline]
    fn find_impulse(
        &mut self,
        groups: &mut [Box<dyn Group<D>>],
        view: &StepView<'_>,
        along: Along,
    ) {
        let mut impulses = self.past.impulses();
        for (node, impulse) in impulses.iter_mut().enumerate() {
            *impulse = scaled(-view.step, &old_force(&self.old_force, node));
        }
        for group in groups.iter_mut() {
            let magnitudes = &mut self.magnitudes;
            group.add_impulse(view, &self.trial, along, &mut impulses, magnitudes);
        }
        self.rockets
            .add_impulses((0, view.step), &mut impulses, &mut self.magnitudes);
    }

    /// `Δq = (h/m)(p⁰ − ½h F⁰)`, `Δp = −½h (F⁰ + F¹)`, where F¹ acts along the gradient at q¹.
    fn move_from_start(&mut self, groups: &mut [Box<dyn Group<D>>], view: &StepView<'_>) {
        let p0 = points::<D>(view.state.momenta.values());
        let mut impulses = self.past.impulses();
        for node in &self.nodes {
            let at = node.place.node();
            self.trial.carries[at] = [0.0; D];
            let mobility = view.step * node.place.per_mass;
            let impulse = impulses.of(at);
            let displacement = vector(|axis| mobility * (p0[at][axis] + 0.5 * impulse[axis]));
            self.trial.displacements[at] = displacement;
        }
        for group in groups.iter_mut() {
            group.add_impulse(view, &self.trial, Along::Gradient, &mut impulses, &mut []);
        }
        for (node, impulse) in impulses.iter_mut().enumerate() {
            let force = old_force(&self.old_force, node);
            *impulse = vector(|axis| 0.5 * (impulse[axis] - view.step * force[axis]));
        }
    }
}

/// Adds the mass of a solid at a moved anchor to the certificate; returns the work `v̄·Δp` of the support on it, J.
fn carry<const D: usize>(
    node: usize,
    displacement: &[f64; D],
    view: &StepView<'_>,
    next: &State,
    motion: &mut Motion<D>,
) -> f64 {
    let momentum = points::<D>(view.state.momenta.values())[node];
    let end = points::<D>(next.momenta.values())[node];
    let impulse = vector(|axis| end[axis] - momentum[axis]);
    let change = view.change_of_speed(node);
    let old = points::<D>(view.state.velocities.values())[node];
    let load = view
        .loads
        .has_total_force()
        .then(|| view.loads.total_force(node));
    let step = NodeStep {
        speeds: Speeds::Given { old, change },
        position: &points(view.state.positions.values())[node],
        momentum: &momentum,
        displacement,
        impulse: &impulse,
    };
    motion.see(&step, load.as_ref(), view.step);
    step.energies()[0]
}

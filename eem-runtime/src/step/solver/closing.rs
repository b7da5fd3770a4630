//! The end of a step: the new state from the increments that were found, and its certificate.

mod masses;
mod path;
mod stages;

use super::begin::old_force;
use super::{Search, Solver};
use crate::algebra::{scaled, vector};
use crate::element::group::{Along, StepView, points};
use crate::element::state::State;
use crate::element::tally::{Care, Reevaluation, Tally};
use crate::step::certificate::{Certificate, Kept, Motion};
use crate::step::error::StepFailure;
use crate::step::scheme::Closing;
use masses::carry;

impl<const D: usize> Search<'_, D> {
    /// Writes the new state to `next`, from the increments at which the elements have been evaluated, and finds its
    /// certificate. It may be called again at another trial.
    #[inline]
    pub(super) fn close(&mut self, next: &mut State) -> Result<(), StepFailure> {
        self.close_with(Care::Quick, next)?;
        if !self.solver.scheme.is_exact() {
            return Ok(());
        }
        if !self.solver.certificate.is_enough() {
            self.close_thoroughly(next)?;
        }
        if self.solver.certificate.is_bound_wide() {
            let ends = [self.view.state, next];
            self.solver.certificate.find_terms(self.groups, ends);
        }
        Ok(())
    }

    /// Closes the step with thorough bounds; energy changes by discrete derivatives decide where those by values are too
    /// inaccurate.
    #[cold]
    fn close_thoroughly(&mut self, next: &mut State) -> Result<(), StepFailure> {
        let quick = self.solver.certificate;
        self.close_with(Care::Thorough, next)?;
        let mut thorough = self.solver.certificate;
        if !thorough.has_enough_energy() {
            let mut reevaluation = Reevaluation::new();
            for group in &*self.groups {
                group.reevaluate([self.view.state, next], &mut reevaluation);
            }
            self.solver.worst = reevaluation.worst();
            thorough = thorough.reevaluated(&reevaluation);
        }
        self.solver.certificate = quick.sharpened_by(thorough);
        Ok(())
    }

    fn close_with(&mut self, care: Care, next: &mut State) -> Result<(), StepFailure> {
        let view = self.view;
        next.copy_books(view.state);
        if view.phase.heats() {
            next.time.add(view.step);
        }
        let mut tally = Tally::new(care);
        let mut motion = Motion::new(self.solver.kept(view));
        if self.solver.stages.is_none() {
            self.solver.final_residual = 0.0;
        }
        if self.solver.scheme.closing() == Closing::Stages {
            self.solver.forget_magnitudes(care);
            self.move_through_stages(next, (&mut motion, &mut tally))?;
        } else if view.phase.moves() {
            self.find_motion(care);
            (self.solver).move_masses(view, next, &mut motion, &mut tally)?;
            self.solver.move_anchors(view, next, &mut motion);
        } else {
            next.positions.copy_from(&view.state.positions);
            next.momenta.copy_from(&view.state.momenta);
            next.velocities.copy_from(&view.state.velocities);
        }
        for group in &mut *self.groups {
            group.close(view, &self.solver.trial, next, &mut tally)?;
        }
        let (reservoirs, ends) = (&view.conduction.reservoirs, [view.state, next]);
        self.solver.certificate = Certificate::new(&motion, &tally, reservoirs, ends);
        Ok(())
    }

    /// Finds impulses, and displacements where these follow from impulses.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "see `Search::begin`")]
    pub(super) fn find_motion(&mut self, care: Care) {
        self.solver.forget_magnitudes(care);
        let scheme = self.solver.scheme;
        match scheme.closing() {
            Closing::Increments if scheme.has_old_forces() => self.find_impulse(Along::Scheme),
            Closing::Increments => self.find_impulse(Along::Secant),
            Closing::Start => {
                self.find_impulse(Along::Scheme);
                self.move_from_start();
            }
            Closing::Stages | Closing::Explicit => {}
        }
    }

    /// Sets the impulses to `−h F`, with the forces F at the trial.
    #[inline]
    fn find_impulse(&mut self, along: Along) {
        let (solver, view) = (&mut *self.solver, self.view);
        let magnitudes = &mut solver.magnitudes;
        let mut impulses = solver.past.impulses();
        for (node, impulse) in impulses.iter_mut().enumerate() {
            *impulse = scaled(-view.step, &old_force(&solver.old_force, node));
        }
        for group in &mut *self.groups {
            group.add_impulse(view, &solver.trial, along, &mut impulses, magnitudes);
        }
        (solver.rockets).add_impulses((0, view.step), &mut impulses, magnitudes);
    }

    /// `Δq = (h/m)(p⁰ − ½h F⁰)`, `Δp = −½h (F⁰ + F¹)`, where F¹ acts along the gradient at q¹.
    fn move_from_start(&mut self) {
        let (solver, view) = (&mut *self.solver, self.view);
        let p0 = points::<D>(view.state.momenta.values());
        let mut impulses = solver.past.impulses();
        for node in &solver.nodes {
            let (momentum, impulse) = (&p0[node.node], impulses.of(node.node));
            let mobility = view.step * node.per_mass;
            solver.trial.displacements[node.node] =
                vector(|axis| mobility * (momentum[axis] + 0.5 * impulse[axis]));
            solver.trial.carries[node.node] = [0.0; D];
        }
        for group in &mut *self.groups {
            group.add_impulse(view, &solver.trial, Along::Gradient, &mut impulses, &mut []);
        }
        for (node, impulse) in impulses.iter_mut().enumerate() {
            let force = old_force(&solver.old_force, node);
            *impulse = vector(|axis| 0.5 * (impulse[axis] - view.step * force[axis]));
        }
    }
}

impl<const D: usize> Solver<D> {
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
            for (axis, &displacement) in self.trial.displacements[node].iter().enumerate() {
                next.positions.advance(node * D + axis, old, displacement);
                // The support bears the impulse of the springs.
                let support = -impulses.of(node)[axis] / view.step;
                next.work.add(support * displacement);
                motion.work(support * displacement);
            }
            if view.masses.are_coupled() {
                let displacement = &self.trial.displacements[node];
                let has_load = view.loads.has_total_force();
                let load = has_load.then(|| view.loads.total_force(node));
                let work = carry((node, displacement), load.as_ref(), view, (next, motion));
                next.work.add(work);
                motion.work(work);
            }
        }
    }
}

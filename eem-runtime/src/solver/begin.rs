//! Where Newton's method starts.
//!
//! ```text
//! q¹ = q⁰ + (h/m)(p⁰ + ½h F)      F: the mean force of the step, foretold from those of the last ones
//! ```

use super::Solver;
use crate::error::StepFailure;
use crate::group::{Group, Old, StepView, points};
use crate::scalar::Real;
use crate::state::{Forecast, Past};

/// What is left of the error of a forecast one step later. Any memory of some steps will do.
const MEMORY: f64 = 0.875;

impl<S: Real, const D: usize> Solver<S, D> {
    /// Starts at the old state, with a foretold motion as the first correction if the scheme wants it.
    pub(super) fn begin(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) -> Result<(), StepFailure> {
        let loads = points::<S, D>(&view.loads.total_force);
        for (force, load) in self.old_force.iter_mut().zip(loads) {
            *force = load.map(|load| -load);
        }
        self.per_length.fill(S::MAX);
        let mut old = Old {
            force: &mut self.old_force,
            lengths: &mut self.per_length,
        };
        for group in groups.iter_mut() {
            group.begin(view, &mut old)?;
        }
        invert_lengths(&mut self.per_length);
        self.start(view);
        Ok(())
    }

    fn start(&mut self, view: &StepView<'_, S>) {
        let old = points::<S, D>(view.state.positions.values());
        let motion = points::<S, D>(&view.loads.motion);
        let moves = view.phase.moves();
        let nodes = self.trial.displacements.iter_mut();
        for (node, displacement) in nodes.enumerate() {
            *displacement = if moves { motion[node] } else { [S::zero(); D] };
            for axis in 0..D {
                self.trial.positions[node][axis] = old[node][axis] + displacement[axis];
            }
        }
        self.trial
            .seen_temperatures
            .copy_from_slice(&view.state.temperatures);
        self.remember();
        let is_foretold = moves && self.scheme.foretells_its_start();
        let half_step = S::from_f64(0.5) * view.step;
        let momenta = view.state.momenta.values();
        let past = &view.state.past;
        let forecast = past.best();
        for mass in &self.masses {
            let mobility = view.step / mass.mass;
            for (axis, change) in self.correction.0[mass.node].iter_mut().enumerate() {
                let at = mass.node * D + axis;
                let force = forecast.of(past.forces[0][at], past.forces[1][at]);
                *change = if is_foretold {
                    mobility * (momenta[at] + half_step * force)
                } else {
                    S::zero()
                };
            }
        }
        self.correction.1.fill(S::zero());
    }

    /// Remembers the force of a step in `next`, and how well it would have been foretold.
    pub(super) fn remember_force(&self, view: &StepView<'_, S>, next: &mut Past<S>) {
        if !self.scheme.foretells_its_start() {
            return;
        }
        let past = &view.state.past;
        if !view.phase.moves() {
            next.copy_from(past);
            return;
        }
        let mut errors = past.errors.map(|error| S::from_f64(MEMORY) * error);
        let per_step = view.step.recip();
        for mass in &self.masses {
            for (axis, &impulse) in self.impulse[mass.node].iter().enumerate() {
                let at = mass.node * D + axis;
                let force = impulse * per_step;
                let (last, before) = (past.forces[0][at], past.forces[1][at]);
                for (error, forecast) in errors.iter_mut().zip(Forecast::ALL) {
                    let miss = (force - forecast.of(last, before)) / mass.mass;
                    *error += miss * miss;
                }
                next.forces[0][at] = force;
                next.forces[1][at] = last;
            }
        }
        next.errors = errors;
    }
}

/// Makes units of length their reciprocals; nodes without elements, which have the largest number
/// there is, get 1 m.
pub(super) fn invert_lengths<S: Real>(lengths: &mut [S]) {
    for length in lengths {
        *length = if *length == S::MAX {
            S::one()
        } else {
            length.recip()
        };
    }
}

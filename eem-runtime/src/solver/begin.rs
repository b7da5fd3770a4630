//! Where Newton's method starts.

use super::Solver;
use crate::error::StepFailure;
use crate::group::{Group, Old, StepView, points};
use crate::scalar::Real;

impl<S: Real, const D: usize> Solver<S, D> {
    /// Starts at the old state, with free flight as the first correction if the scheme wants it.
    pub(super) fn begin(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) -> Result<(), StepFailure> {
        let loads = points::<S, D>(&view.loads.total_force);
        for (force, load) in self.old_force.iter_mut().zip(loads) {
            *force = load.map(|load| -load);
        }
        self.lengths.fill(S::MAX);
        let mut old = Old {
            force: &mut self.old_force,
            lengths: &mut self.lengths,
        };
        for group in groups.iter_mut() {
            group.begin(view, &mut old)?;
        }
        for length in &mut self.lengths {
            if *length == S::MAX {
                *length = S::one();
            }
        }
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
        let flies = moves && self.scheme.starts_in_free_flight();
        let momenta = points::<S, D>(view.state.momenta.values());
        for mass in &self.masses {
            self.correction.0[mass.node] = if flies {
                let mobility = view.step / mass.mass;
                momenta[mass.node].map(|p| mobility * p)
            } else {
                [S::zero(); D]
            };
        }
        self.correction.1.fill(S::zero());
    }
}

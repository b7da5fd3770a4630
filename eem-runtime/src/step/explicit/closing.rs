//! The closing of a step: energy and momenta of each component are corrected to their targets.
//!
//! Momenta first, by a rigid motion. Then energy, by the first of these that can give it:
//!
//! | by | changes | cannot |
//! |---|---|---|
//! | heat | what elements have produced themselves, by up to 0.3 % | where less is produced |
//! | motion | the part of the momenta that is no rigid motion | where there is little of it: turning points |
//! | shape | positions, viscous stretches and exchanged heat, downhill | at equilibrium |
//! | sink | entropies of elements that produce | without production |
//!
//! Where step control would feel a correction by motion or shape, a defect that is [rounding](rounding) is left: its correction would be
//! noise in the motion.
//!
//! None of them lowers the entropy: what an element gives is at most what it has produced in this step. The heat of an
//! element with a thermostat goes to the thermostat, and the heat of a dashpot without temperature leaves the scene: these
//! are sinks for at most as much again as they have produced.

mod energy;
mod momenta;
mod rigid;
mod rounding;
mod shape;

use super::accounts::Accounts;
use super::demand::{Demand, Scales};
use super::{Explicit, View};
use crate::element::error::StateError;
use crate::element::group::{ClosingView, ComponentEnergy};
use crate::element::state::State;
use crate::step::error::StepFailure;

/// Corrections of a component after which its closing fails.
const MOST_ITERATIONS: usize = 10;

/// The defect of a component, in ε, that is accepted where no correction is possible.
pub(super) const FROZEN: f64 = 8.0;

/// How far the energy of a component is closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Status {
    /// Within tolerance.
    Closed,
    /// Its elements must be evaluated again.
    Changed,
    /// A correction needs its forces.
    NeedsForces,
    /// No correction is possible.
    Failed,
}

impl Accounts {
    /// Corrects the energy of open components by heat; returns whether forces are needed.
    fn balance_all(&mut self, demand: Demand, next: &mut State) -> bool {
        let mut needs_forces = false;
        for index in 0..self.components.all.len() {
            let status = if self.scratch.open[index] {
                self.balance(index, demand, next)
            } else {
                Status::Closed
            };
            self.scratch.open[index] = status == Status::Changed;
            self.scratch.needs_forces[index] = status == Status::NeedsForces;
            needs_forces |= status == Status::NeedsForces;
        }
        needs_forces
    }
}

impl<const D: usize> Explicit<D> {
    /// Closes all components.
    #[inline]
    pub(super) fn close(
        &mut self,
        view: &View<'_>,
        (demand, scales): (Demand, Scales),
        next: &mut State,
    ) -> Result<(), StepFailure> {
        for index in 0..self.components.all.len() {
            self.restore_momenta(index);
        }
        self.scratch.open.fill(true);
        self.find_energies(view, next)?;
        self.share_productions();
        let mut has_looked = false;
        loop {
            if self.balance_all(demand, next) {
                let (accounts, bodies) = self.parts(view);
                if !has_looked {
                    accounts.expect_stable_dashpots(&bodies)?;
                    has_looked = true;
                }
                accounts.find_forces(&bodies);
                for index in 0..self.components.all.len() {
                    if self.scratch.needs_forces[index] {
                        let status = self.reshape(index, (view, demand), next);
                        self.scratch.open[index] = status == Status::Changed;
                        if status == Status::Failed {
                            self.turn_rigidly(index, (view, demand, scales), next)?;
                        }
                    }
                }
            }
            if !self.scratch.open.contains(&true) {
                return Ok(());
            }
            self.find_energies(view, next)?;
        }
    }

    /// Finds temperatures and energies of the elements of open components, and the heat of their thermostats.
    #[inline]
    fn find_energies(&mut self, explicit: &View<'_>, next: &mut State) -> Result<(), StateError> {
        let scratch = &mut self.accounts.scratch;
        for (energy, &is_open) in scratch.energies.iter_mut().zip(&scratch.open) {
            if is_open {
                *energy = ComponentEnergy::default();
            }
        }
        let mut view = ClosingView {
            open: &scratch.open,
            places: &self.places,
            stage: &mut self.accounts.stage,
            slots: &mut scratch.slots,
            unkept: &mut scratch.unkept,
            next,
            energies: &mut scratch.energies,
        };
        self.accounts.evaluations += 1;
        for group in &mut self.groups {
            group.close(&mut view)?;
        }
        if self.stage.has_thermostats {
            self.book_thermostats(explicit.state, next);
        }
        Ok(())
    }
}

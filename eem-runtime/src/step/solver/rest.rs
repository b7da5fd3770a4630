//! States at rest: Newton's method on the balance of forces, without inertia.
//!
//! ```text
//! R(q) = F_loads(q) − F_elements(q) = (1 − share) R(q⁰)       share: 0 at the initial state, 1 at rest under all loads
//! ```
//!
//! The initial state is the solution for `share = 0`. Solutions for growing shares are followed as long as the tangent K is
//! positive definite. Where it is not, as in a mechanism or at a limit point, the scene moves under all its loads against
//! friction, by implicit steps that grow as the forces come into balance:
//!
//! ```text
//! (K + μ D) δ = R        D: the largest diagonal entry of each node
//! ```
//!
//! That is the first iteration for `R(q) = μ D (q − q_n)`. It is the last one, too, unless the force along it turns round: where a stiff
//! spring is turned, it is stretched by the square of the angle. Further iterations take the stretch back, so that steps are limited by
//! the angle and not by the stiffness.
//!
//! Against this friction heavy masses fall on light ones below them, and springs whose length vanishes have a D without bounds, so that all
//! stands still. Where no stable state is found, the motion is made once more with a D in proportion to the masses, against which all
//! weights begin to fall alike.
//!
//! A state at rest is the end of one implicit Euler step of a huge size h. Then neither inertia nor viscosity is left in
//! the rows `2 m/h Δq + h F` of a step, which are h times forces, and `Δγ = h g/η` becomes `g = 0`. In the code, R, K and
//! D are h times those above.

mod search;
mod stability;
mod system;

use super::Solver;
use crate::element::group::{Group, StepView};
use crate::element::state::State;
use crate::step::error::StepFailure;
use crate::step::newton::{NewtonSettings, is_last};
use search::{AnySearch, Moving};

/// The size h of the step to a state at rest: `2⁵⁰⁰ s = 3·10¹⁵⁰ s`, a power of two, so that products with it are exact.
/// Its reciprocal is set to zero, so that there is no inertia; dashpots are relaxed to rounding unless a viscosity is
/// 10¹³⁰ times a stiffness, in s.
pub(crate) const LONG: f64 = f64::from_bits((1023 + 500) << 52);

/// How often a load step is halved before the load path is given up.
const CUTS: u32 = 8;

/// Friction is multiplied by the first factor after a step at whose end the force along it does not point backwards, and
/// by the second if that force is less than a tenth of its value at the start. A step that goes too far is repeated with
/// more friction.
const FRICTION_FALLS: [f64; 2] = [0.25, 0.0625];

/// A scene whose extent has grown by this factor does not come to rest.
const RUNAWAY: f64 = 1e6;

/// The largest number of steps against friction, in units of the most iterations of a load step.
const FRICTION_STEPS: usize = 10;

/// The iteration for a state at rest, compiled once for all dimensions.
pub(crate) struct AtRest<'a> {
    search: Box<dyn AnySearch + 'a>,
    view: &'a StepView<'a>,
    dimension: usize,
    /// In the order of their rows.
    nodes: Vec<Moving>,
    settings: NewtonSettings,
    /// The end nodes of the arms of all elements: the edges from their first nodes.
    arms: Vec<[usize; 2]>,
    /// R(q⁰), N.
    first: Vec<f64>,
    share: f64,
    /// D per moving node, N/m, and whether it is in proportion to the masses.
    sizes: Vec<f64>,
    is_by_mass: bool,
    pub(crate) effort: RestEffort,
}

/// How a state at rest was found.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct RestEffort {
    pub(crate) load_steps: usize,
    pub(crate) iterations: usize,
    pub(crate) friction_steps: usize,
}

/// The motion with the least stiffness.
pub(crate) struct Softest {
    /// The moving nodes.
    pub(crate) nodes: Vec<usize>,
    /// Their displacements, node after node; the largest component is 1.
    pub(crate) motion: Vec<f64>,
    /// N/m.
    pub(crate) stiffness: f64,
    /// `xᵀ K x / xᵀ D x`, and what rounding may contribute to it.
    pub(crate) relative: f64,
    pub(crate) rounding: f64,
}

/// The displacements of all nodes and their compensations of rounding, m, node after node.
type Place = [Vec<f64>; 2];

impl<'a> AtRest<'a> {
    /// Starts at the state of a view whose step is [`LONG`], given the end nodes of the arms of elements.
    pub(crate) fn new<const D: usize>(
        solver: &'a mut Solver<D>,
        groups: &'a mut [Box<dyn Group<D>>],
        view: &'a StepView<'a>,
        (settings, arms): (NewtonSettings, Vec<[usize; 2]>),
    ) -> Result<Self, StepFailure> {
        Self::of(
            Box::new(solver.search(groups, view)),
            view,
            D,
            (settings, arms),
        )
    }

    fn of(
        search: Box<dyn AnySearch + 'a>,
        view: &'a StepView<'a>,
        dimension: usize,
        (settings, arms): (NewtonSettings, Vec<[usize; 2]>),
    ) -> Result<Self, StepFailure> {
        let mut rest = Self {
            nodes: search.moving(),
            search,
            view,
            dimension,
            settings,
            arms,
            first: Vec::new(),
            share: 0.0,
            sizes: Vec::new(),
            is_by_mass: false,
            effort: RestEffort::default(),
        };
        rest.start(None)?;
        rest.first = rest.forces();
        Ok(rest)
    }

    /// Finds the state at rest under all loads in this many load steps. Returns the share of the loads up to which the
    /// path was followed.
    pub(crate) fn follow(&mut self, load_steps: u32) -> (f64, Result<(), StepFailure>) {
        let whole = load_steps.saturating_mul(1 << CUTS);
        let (mut done, mut size) = (0, 1 << CUTS);
        let share = |done: u32| f64::from(done) / f64::from(whole);
        let mut found = Ok(());
        if self.is_stable() {
            while done < whole && size > 0 {
                let place = self.place();
                let next = whole.min(done.saturating_add(size));
                if self.converge(share(next), true).is_ok() {
                    self.effort.load_steps += 1;
                    done = next;
                    size = (2 * size).min(1 << CUTS);
                } else {
                    size /= 2;
                    found = self.start(Some(&place));
                    if found.is_err() {
                        return (share(done), found);
                    }
                }
            }
        }
        if done < whole {
            found = self.relax();
            if found.is_err() || !self.is_stable() {
                found = self.relax_by_mass(found);
            }
        }
        (share(done), found)
    }

    /// Writes the state that was found.
    pub(crate) fn close(&mut self, next: &mut State) -> Result<(), StepFailure> {
        let [moved, carries] = self.search.place();
        for (at, (moved, carry)) in moved.iter().zip(carries).enumerate() {
            let old = &self.view.state.positions;
            next.positions.advance(at, old, moved + carry);
        }
        self.search.close(next)
    }

    /// Newton's method for a share of the loads. On the load path, all tangents are positive definite.
    fn converge(&mut self, share: f64, is_on_path: bool) -> Result<(), StepFailure> {
        self.share = share;
        self.renew()?;
        let mut before = None;
        for _ in 0..self.settings.max_iterations {
            let update = self.update(0.0)?;
            self.effort.iterations += 1;
            if is_on_path && !update.is_definite {
                return Err(StepFailure::SingularTangent);
            }
            let is_full = update.part >= 1.0;
            let stagnates = before.is_some_and(|before: f64| update.size >= 0.5 * before);
            let ends = is_last(update.size, before, self.settings.tolerance)
                || (stagnates && self.is_balanced());
            if is_full && ends {
                return Ok(());
            }
            before = is_full.then_some(update.size);
        }
        let update = before.unwrap_or(f64::NAN);
        Err(StepFailure::NotConverged { update })
    }

    /// Moves from the initial state against friction by mass; if that finds no stable state either, goes back to what was found.
    #[cold]
    fn relax_by_mass(&mut self, found: Result<(), StepFailure>) -> Result<(), StepFailure> {
        let place = self.place();
        self.is_by_mass = true;
        let again = self.start(None).and_then(|()| self.relax());
        self.is_by_mass = false;
        if again.is_ok() && self.is_stable() {
            return again;
        }
        self.start(Some(&place))?;
        found
    }

    /// Moves against friction under all loads until they are balanced.
    fn relax(&mut self) -> Result<(), StepFailure> {
        self.share = 1.0;
        self.renew()?;
        let (mut friction, extent) = (1.0, self.extent());
        let mut last = f64::NAN;
        for _ in 0..FRICTION_STEPS * self.settings.max_iterations {
            if self.extent() > RUNAWAY * extent {
                break;
            }
            self.effort.friction_steps += 1;
            let mut update = match self.update(friction) {
                Ok(update) => update,
                Err(failure) => {
                    if failure == StepFailure::SingularTangent {
                        self.renew()?;
                    }
                    friction *= 4.0;
                    continue;
                }
            };
            let is_balanced = self.is_balanced();
            if !update.is_definite {
                self.take_back(update.part, 0.0);
                self.assemble()?;
                friction *= 4.0;
                continue;
            }
            if update.goes_too_far() && !is_balanced && !self.settle(friction, &mut update) {
                self.start(Some(&update.begin.place))?;
                friction *= 4.0;
                continue;
            }
            last = update.size;
            let contracts = update.after <= 0.1 * update.before || is_balanced;
            // Beside an unstable state the forces are small, but they grow.
            if contracts && last <= self.settings.tolerance && (is_balanced || self.is_stable()) {
                return self.polish();
            }
            let [some, much] = FRICTION_FALLS;
            if update.left.abs() <= 0.1 {
                friction *= much;
            } else if update.left >= 0.0 {
                friction *= some;
            }
        }
        Err(StepFailure::NotConverged { update: last })
    }

    /// Iterations without friction from a state near that at rest, where K is not singular.
    fn polish(&mut self) -> Result<(), StepFailure> {
        let place = self.place();
        let found = self.converge(1.0, false);
        if found.is_err() {
            self.start(Some(&place))?;
        }
        found
    }

    /// Starts at a place, or at the initial state, with the initial internal variables.
    fn start(&mut self, place: Option<&Place>) -> Result<(), StepFailure> {
        self.search.start()?;
        if let Some([moved, carries]) = place {
            let [own, own_carries] = self.search.place_mut();
            own.copy_from_slice(moved);
            own_carries.copy_from_slice(carries);
        }
        self.renew()
    }

    fn place(&self) -> Place {
        let [moved, carries] = self.search.place();
        [moved.to_vec(), carries.to_vec()]
    }

    /// The largest force out of balance, N, and its node if any moves.
    pub(crate) fn residual(&self) -> (f64, Option<usize>) {
        let mut largest = (0.0, self.nodes.first().map(|node| node.node));
        for (row, force) in self.forces().iter().enumerate() {
            if force.abs() > largest.0 {
                largest = (force.abs(), Some(self.nodes[row / self.dimension].node));
            }
        }
        (largest.0 / LONG, largest.1)
    }

    /// The places of all nodes, m.
    pub(crate) fn positions(&self) -> Vec<f64> {
        let mut positions = self.view.state.positions.values().to_vec();
        let [moved, _] = self.search.place();
        for (position, moved) in positions.iter_mut().zip(moved) {
            *position += moved;
        }
        positions
    }
}

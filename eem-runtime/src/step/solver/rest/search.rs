//! What the iteration for a state at rest needs of a search for the state after a step, whatever the dimension.

use crate::algebra::system::LinearSystem;
use crate::element::error::StateError;
use crate::element::state::State;
use crate::element::tally::{Care, Tally};
use crate::step::error::StepFailure;
use crate::step::solver::Search;
use crate::step::solver::begin::Start;

/// A node that moves.
pub(super) struct Moving {
    pub(super) node: usize,
    /// kg.
    pub(super) mass: f64,
    /// The places of its diagonal entries in the tangent.
    pub(super) diagonal: Box<[u32]>,
}

/// A search of any dimension.
pub(super) trait AnySearch {
    /// The nodes that move, in the order of their rows.
    fn moving(&self) -> Vec<Moving>;

    /// Starts at the initial state.
    fn start(&mut self) -> Result<(), StepFailure>;

    /// Starts the system at the trial.
    fn balance(&mut self);

    /// Evaluates the elements there, and adds them to the system.
    fn evaluate(&mut self) -> Result<(), StateError>;

    fn tangent(&self) -> &LinearSystem<1>;

    fn tangent_mut(&mut self) -> &mut LinearSystem<1>;

    /// Whether the tangent is symmetric: without rockets.
    fn is_symmetric(&self) -> bool;

    /// Applies the solution of the system. Returns the largest change, in lengths of elements.
    fn correct(&mut self) -> f64;

    /// Reduces the part of the last update that is applied to `next`, and starts the next system.
    fn take_back(&mut self, part: f64, next: f64);

    /// The displacements of all nodes and their compensations of rounding, m.
    fn place(&self) -> [&[f64]; 2];

    fn place_mut(&mut self) -> [&mut [f64]; 2];

    /// The magnitude of the terms of the impulses of elements on each node, N s.
    fn magnitudes(&mut self) -> &[f64];

    /// Writes the internal variables.
    fn close(&mut self, next: &mut State) -> Result<(), StepFailure>;
}

impl<const D: usize> AnySearch for Search<'_, D> {
    fn moving(&self) -> Vec<Moving> {
        let mut moving = Vec::with_capacity(self.solver.nodes.len());
        for node in &self.solver.nodes {
            moving.push(Moving {
                node: node.node,
                mass: node.mass,
                diagonal: Box::new(node.diagonal),
            });
        }
        moving
    }

    fn start(&mut self) -> Result<(), StepFailure> {
        self.begin(Start::Rest)
    }

    fn balance(&mut self) {
        self.solver.balance(self.view);
    }

    fn evaluate(&mut self) -> Result<(), StateError> {
        Search::evaluate(self, true)
    }

    fn tangent(&self) -> &LinearSystem<1> {
        &self.solver.tangent
    }

    fn tangent_mut(&mut self) -> &mut LinearSystem<1> {
        &mut self.solver.tangent
    }

    fn is_symmetric(&self) -> bool {
        self.solver.rockets.are_none()
    }

    fn correct(&mut self) -> f64 {
        Search::correct(self)
    }

    fn take_back(&mut self, part: f64, next: f64) {
        self.solver.take_back(self.view, part - next);
        for group in &mut *self.groups {
            group.apply(next);
        }
    }

    fn place(&self) -> [&[f64]; 2] {
        let trial = &self.solver.trial;
        let moved = trial.displacements.as_flattened();
        [moved, trial.carries.as_flattened()]
    }

    fn place_mut(&mut self) -> [&mut [f64]; 2] {
        let trial = &mut self.solver.trial;
        let moved = trial.displacements.as_flattened_mut();
        [moved, trial.carries.as_flattened_mut()]
    }

    fn magnitudes(&mut self) -> &[f64] {
        self.find_motion(Care::Thorough);
        &self.solver.magnitudes
    }

    fn close(&mut self, next: &mut State) -> Result<(), StepFailure> {
        let (view, trial) = (self.view, &self.solver.trial);
        let mut tally = Tally::new(Care::Quick);
        for group in &mut *self.groups {
            group.close(view, trial, next, &mut tally)?;
        }
        Ok(())
    }
}

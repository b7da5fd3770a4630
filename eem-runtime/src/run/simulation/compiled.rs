//! Simulations in double precision in one to three dimensions are compiled with this crate.
//!
//! `Simulation<D, S>` is generic, so that every program would compile its own copy, 12 of the 40 CPU seconds of one with
//! a single material. What a simulation does starts in one of the functions of a table, which is either that of this
//! crate or, for other scalars and dimensions, made where it is asked for.

use core::any::Any;

use super::Simulation;
use crate::number::scalar::Real;
use crate::run::checkpoint::{Checkpoint, RestoreError};
use crate::run::ledger::Ledger;
use crate::scene::Scene;
use crate::scene::refused::RefusedScene;
use crate::step::error::StepError;
use crate::step::newton::StepReport;
use crate::step::scheme::Scheme;

/// The functions in which the work of a simulation starts.
pub(super) struct Functions<const D: usize, S: Real> {
    pub(super) new: Begin<D, S>,
    pub(super) step: Step<D, S>,
    pub(super) step_towards: StepTo<D, S>,
    pub(super) step_in_scheme_towards: StepTo<D, S>,
    pub(super) step_again: StepTo<D, S>,
    pub(super) undo: fn(&mut Simulation<D, S>),
    pub(super) checkpoint: fn(&Simulation<D, S>) -> Checkpoint<S>,
    pub(super) restore: fn(&mut Simulation<D, S>, &Checkpoint<S>) -> Result<(), RestoreError>,
    pub(super) ledger: fn(&Simulation<D, S>) -> Ledger<D, S>,
}

type Begin<const D: usize, S> =
    fn(Scene<D, S>, Scheme, S) -> Result<Simulation<D, S>, RefusedScene<D, S>>;
type Step<const D: usize, S> = fn(&mut Simulation<D, S>) -> Result<StepReport<S>, StepError>;
type StepTo<const D: usize, S> = fn(&mut Simulation<D, S>, S) -> Result<StepReport<S>, StepError>;

static LINE: Functions<1, f64> = Functions::HERE;
static PLANE: Functions<2, f64> = Functions::HERE;
static SPACE: Functions<3, f64> = Functions::HERE;

impl<const D: usize, S: Real> Functions<D, S> {
    /// Compiled where they are asked for.
    const HERE: Self = Self {
        new: Simulation::begin,
        step: Simulation::step_here,
        step_towards: Simulation::step_towards_here,
        step_in_scheme_towards: Simulation::step_in_scheme_towards_here,
        step_again: Simulation::step_again_here,
        undo: Simulation::undo_here,
        checkpoint: Simulation::checkpoint_here,
        restore: Simulation::restore_here,
        ledger: Simulation::ledger_here,
    };

    /// Those of this crate if it has them. A branch that a constant rules out is not compiled.
    #[inline]
    pub(super) fn get() -> &'static Self {
        if const { S::IS_DOUBLE && D == 1 } {
            of_this_crate(&LINE)
        } else if const { S::IS_DOUBLE && D == 2 } {
            of_this_crate(&PLANE)
        } else if const { S::IS_DOUBLE && D == 3 } {
            of_this_crate(&SPACE)
        } else {
            const { &Self::HERE }
        }
    }
}

/// The same table by its own type.
#[inline]
fn of_this_crate<const D: usize, S: Real>(functions: &'static dyn Any) -> &'static Functions<D, S> {
    functions
        .downcast_ref()
        .expect("the scalar is f64, and the dimension that of the table")
}

//! Tapes of the derivatives of a law with respect to its parameters.

use eem_symbolic::{ParameterPrograms, Program};

use super::staged::of_state;
use crate::error::LawError;
use crate::tape::Tape;

/// The most parameters of a law that is differentiated with respect to them: their number is known only at run time, but the
/// size of an array of derivatives is fixed at compile time.
pub(crate) const MOST_PARAMETERS: usize = 64;

/// The tapes of [`ParameterPrograms`], for fixed values of the parameters.
#[derive(Debug)]
pub(crate) struct ByParameters {
    /// `None` without a temperature, as the next one.
    pub(crate) temperature_form_adjoint: Option<Tape>,
    pub(crate) temperature_form_tangent: Option<Tape>,
    pub(crate) entropy_form_adjoint: Tape,
    pub(crate) entropy_form_tangent: Tape,
    pub(crate) gradient_adjoint: Tape,
    pub(crate) energy: Tape,
    pub(crate) viscosity_adjoint: Option<Tape>,
    pub(crate) drag_adjoint: Option<Tape>,
}

impl ByParameters {
    /// The tapes of these programs.
    pub(super) fn new(programs: &ParameterPrograms, parameters: &[f64]) -> Result<Self, LawError> {
        let one = |program: &Program| of_state(program, parameters);
        let sometimes = |program: &Option<Program>| program.as_ref().map(one).transpose();
        Ok(Self {
            temperature_form_adjoint: sometimes(&programs.temperature_form_adjoint)?,
            temperature_form_tangent: sometimes(&programs.temperature_form_tangent)?,
            entropy_form_adjoint: one(&programs.entropy_form_adjoint)?,
            entropy_form_tangent: one(&programs.entropy_form_tangent)?,
            gradient_adjoint: one(&programs.gradient_adjoint)?,
            energy: one(&programs.energy_by_parameters)?,
            viscosity_adjoint: sometimes(&programs.viscosity_adjoint)?,
            drag_adjoint: sometimes(&programs.drag_adjoint)?,
        })
    }
}

//! Programs of the derivatives with respect to the parameters of a law.
//!
//! In entropy form the corner temperatures depend on the parameters, too: they solve `G_c = S(c) − s_c = 0`, hence
//!
//! ```text
//! dθ_c = −G_c,μ dμ θ_c/C_c      dJ/dμ = ∂J/∂μ − Σ_c ∂J/∂θ_c (θ_c/C_c) G_c,μ      C_c = θ_c S_θ(c)
//! ```
//!
//! where `G_c,μ` is the derivative at fixed temperatures. It is the derivative of the sum of divided
//! differences in `mixed_states`: the response consists of the same differences, and small changes keep their digits.

use crate::adjoint::adjoint;
use crate::composer::Signed;
use crate::discrete::{self, Step};
use crate::model::Model;
use crate::number::Number;
use crate::operation::{Operation, Value};
use crate::program::{Input, Program, Stage};
use crate::programs::Programs;
use crate::sweep::Sweep;
use crate::tangent::tangent;
use crate::verify_error::VerifyError;

/// Derivatives of other programs with respect to the parameters μ, in the order of [`Model::parameters`].
///
/// The last inputs of an adjoint are weights w of the outputs of the other program; its outputs are
/// `[Σ w ∂(output)/∂μ …]`. The last inputs of a tangent are a direction δμ; its outputs are `[Σ ∂(output)/∂μ δμ …]`. The
/// first inputs are those of the other program. All instructions are of [`Stage::New`].
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterPrograms {
    /// Of the response of [`Programs::temperature_form`] at fixed x⁰ and x¹; `None` without a temperature.
    pub temperature_form_adjoint: Option<Program>,
    /// The tangent of the same response.
    pub temperature_form_tangent: Option<Program>,
    /// Of the response of [`Programs::entropy_form`] at fixed x⁰ and x¹; corner temperatures depend on the parameters.
    pub entropy_form_adjoint: Program,
    /// The tangent of the same response.
    pub entropy_form_tangent: Program,
    /// Of [`Programs::gradient`].
    pub gradient_adjoint: Program,
    /// `[∂e/∂μ …]` at fixed x, without a weight.
    pub energy_by_parameters: Program,
    /// Of the viscosities, the first half of [`Programs::viscosity`]; `None` without dashpots.
    pub viscosity_adjoint: Option<Program>,
    /// Of the viscosity of the dashpot in parallel with the spring; `None` without one.
    pub drag_adjoint: Option<Program>,
}

impl ParameterPrograms {
    /// The programs with the names of the functions that are generated from them.
    pub fn named(&self) -> impl Iterator<Item = (&'static str, &Program)> {
        let all = [
            (
                "temperature_form_adjoint",
                self.temperature_form_adjoint.as_ref(),
            ),
            (
                "temperature_form_tangent",
                self.temperature_form_tangent.as_ref(),
            ),
            ("entropy_form_adjoint", Some(&self.entropy_form_adjoint)),
            ("entropy_form_tangent", Some(&self.entropy_form_tangent)),
            ("gradient_adjoint", Some(&self.gradient_adjoint)),
            ("energy_by_parameters", Some(&self.energy_by_parameters)),
            ("viscosity_adjoint", self.viscosity_adjoint.as_ref()),
            ("drag_adjoint", self.drag_adjoint.as_ref()),
        ];
        all.into_iter()
            .filter_map(|(name, program)| Some((name, program?)))
    }

    /// Checks all programs; see [`Program::verify`].
    ///
    /// # Errors
    ///
    /// As [`Programs::verify`].
    pub fn verify(&self) -> Result<(), VerifyError> {
        self.named().try_for_each(|(_, program)| program.verify())
    }
}

impl Model {
    /// The derivatives of the programs of the law with respect to its parameters.
    #[must_use]
    pub fn parameter_programs(&self, programs: &Programs) -> ParameterPrograms {
        let responses = self.variables().len() + usize::from(self.temperature.is_some());
        let response = |form: &Program| form.restricted_to(responses).program;
        let temperature_form = programs.temperature_form.as_ref().map(response);
        let of_laws = |program: Option<&Program>, laws: usize| {
            let values = program.map(|program| program.restricted_to(laws).program);
            values.map(|values| self.adjoint(&values))
        };
        let entropy_form = EntropyForm::new(self, response(&programs.entropy_form));
        ParameterPrograms {
            temperature_form_adjoint: temperature_form.as_ref().map(|form| self.adjoint(form)),
            temperature_form_tangent: temperature_form.as_ref().map(|form| self.tangent(form)),
            entropy_form_adjoint: entropy_form.adjoint(),
            entropy_form_tangent: entropy_form.tangent(),
            gradient_adjoint: self.adjoint(&programs.gradient),
            energy_by_parameters: self.energy_by_parameters(&programs.internal_energy),
            viscosity_adjoint: of_laws(programs.viscosity.as_ref(), self.viscosities.len()),
            drag_adjoint: of_laws(programs.drag.as_ref(), 1),
        }
    }

    fn wanted(&self) -> Vec<usize> {
        (0..self.parameters.len()).collect()
    }

    /// Inputs that are not quantities of the model.
    fn inputs(&self, name: &str, count: usize) -> Vec<Input> {
        let mut graph = self.graph.clone();
        let mut input = |index| {
            // No identifier of a formula contains `#`.
            let name = format!("#{name}{index}");
            let symbol = graph.symbol(&name);
            let stage = Stage::New;
            Input {
                symbol,
                name,
                stage,
            }
        };
        (0..count).map(&mut input).collect()
    }

    fn weights(&self, count: usize) -> Vec<Input> {
        self.inputs("weight", count)
    }

    fn directions(&self) -> Vec<Input> {
        self.inputs("direction", self.parameters.len())
    }

    fn adjoint(&self, program: &Program) -> Program {
        adjoint(
            program,
            &self.weights(program.outputs.len()),
            &self.wanted(),
        )
    }

    fn tangent(&self, program: &Program) -> Program {
        tangent(program, &self.directions(), &self.wanted())
    }

    fn energy_by_parameters(&self, energy: &Program) -> Program {
        let mut sweep = Sweep::new(energy, &[]);
        let one = sweep.composer.number(Number::ONE);
        let derivatives = sweep.backward(&[Some(one.into())], &self.wanted());
        sweep.finish(&derivatives)
    }
}

/// The response of the entropy form, then `S(c) − s_c` and `C_c` of its corners.
struct EntropyForm<'m> {
    model: &'m Model,
    program: Program,
    responses: usize,
    /// Number of inputs before the corner temperatures.
    before: usize,
    corners: usize,
}

/// A corner in a sweep.
struct Corner {
    input: usize,
    /// Position of the output `S(c) − s_c`.
    excess: usize,
    /// `θ_c/C_c`.
    theta_over_capacity: Value,
}

impl<'m> EntropyForm<'m> {
    fn new(model: &'m Model, response: Program) -> Self {
        let before = model.parameters.len() + 2 * model.variables().len();
        let responses = response.outputs.len();
        let program = match model.temperature {
            Some(theta) => {
                let mut step = Step::new(model, true);
                let form = discrete::entropy_form_with_corners(&mut step, theta);
                step.program(&form)
            }
            None => response,
        };
        Self {
            model,
            responses,
            before,
            corners: program.inputs.len() - before,
            program,
        }
    }

    fn corners(&self, sweep: &mut Sweep) -> Vec<Corner> {
        let corner = |index| {
            let input = self.before + index;
            let excess = self.responses + index;
            let capacity = sweep.outputs[excess + self.corners];
            let theta = sweep.composer.input(input);
            Corner {
                input,
                excess,
                theta_over_capacity: sweep.composer.emit(Operation::Div(theta, capacity)),
            }
        };
        (0..self.corners).map(corner).collect()
    }

    fn adjoint(&self) -> Program {
        let mut sweep = Sweep::new(&self.program, &self.model.weights(self.responses));
        let corners = self.corners(&mut sweep);
        let mut weights = vec![None; sweep.outputs.len()];
        for (index, weight) in weights[..self.responses].iter_mut().enumerate() {
            *weight = Some(
                sweep
                    .composer
                    .input(self.program.inputs.len() + index)
                    .into(),
            );
        }
        let mut wanted = self.model.wanted();
        wanted.extend(corners.iter().map(|corner| corner.input));
        let mut derivatives = sweep.backward(&weights, &wanted);
        let by_corners = derivatives.split_off(self.model.parameters.len());
        let mut weights = vec![None; sweep.outputs.len()];
        for (corner, derivative) in corners.iter().zip(by_corners) {
            weights[corner.excess] = derivative.map(|x| corner.follow(&mut sweep, x));
        }
        let through_corners = sweep.backward(&weights, &self.model.wanted());
        for (sum, term) in derivatives.iter_mut().zip(through_corners) {
            if let Some(term) = term {
                sweep.accumulate(sum, term);
            }
        }
        sweep.finish(&derivatives)
    }

    fn tangent(&self) -> Program {
        let mut sweep = Sweep::new(&self.program, &self.model.directions());
        let corners = self.corners(&mut sweep);
        let first = self.program.inputs.len();
        let directions = self.model.wanted().into_iter();
        let mut directions: Vec<(usize, Signed)> = directions
            .map(|input| (input, sweep.composer.input(first + input).into()))
            .collect();
        let changes = sweep.forward(&directions);
        for corner in &corners {
            if let Some(change) = changes[corner.excess] {
                directions.push((corner.input, corner.follow(&mut sweep, change)));
            }
        }
        let mut derivatives = sweep.forward(&directions);
        derivatives.truncate(self.responses);
        sweep.finish(&derivatives)
    }
}

impl Corner {
    /// `−x θ_c/C_c`.
    fn follow(&self, sweep: &mut Sweep, x: Signed) -> Signed {
        let value = sweep.composer.mul(x.value, self.theta_over_capacity);
        Signed { value, ..x }.negated()
    }
}

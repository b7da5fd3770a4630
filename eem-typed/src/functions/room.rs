//! Programs of a law in the arrays of a type with room for more variables than the law has.
//!
//! ```text
//! (λ, γ₁ … γ_k, θ)  ↦  (λ, γ₁ … γ_k, unused …, θ)
//! (λ, γ₁ … γ_k)     ↦  (λ, γ₁ … γ_k, unused …, unused)
//! ```
//!
//! No value depends on an unused input, and unused results are 0, except viscosities and heat capacities, which are 1: what
//! divides by them stays finite.

use eem_symbolic::{
    Instruction, Number, Operation, ParameterPrograms, Program, Programs, Stage, Value,
};

use crate::shape::Shape;

/// For each place of an array the place that it has in the programs of a law; `None` if it is unused.
type Places = Vec<Option<usize>>;

/// Where the numbers of a law are in the arrays of a type.
#[derive(Debug)]
pub(super) struct Room {
    state: Places,
    responses: Places,
    corners: Places,
    viscosities: Places,
    temperature: Places,
}

/// What an unused result is.
#[derive(Clone, Copy)]
enum Unused {
    Zero,
    One,
}

impl Room {
    /// The room of a law of the shape `law` in a type with the shape `all`; `None` if the law fills it.
    pub(super) fn new(law: &Shape, all: &Shape) -> Option<Self> {
        if law.variables() == all.variables() {
            return None;
        }
        let mechanical = law.variables() - usize::from(law.thermal);
        let room = all.dashpots - law.dashpots;
        let with_room = |beyond: usize| {
            let used = (0..mechanical).map(Some);
            let unused = (0..room).map(|_| None);
            let rest = (mechanical..mechanical + beyond).map(|place| law.thermal.then_some(place));
            used.chain(unused).chain(rest).collect::<Places>()
        };
        let chain = |first: usize| {
            let all = with_room(0).into_iter();
            all.map(move |place| place.map(|place| first + place))
        };
        Some(Self {
            state: with_room(usize::from(all.thermal)),
            responses: with_room(2 * usize::from(all.thermal)),
            corners: if law.thermal {
                chain(0).chain(chain(mechanical)).collect()
            } else {
                vec![None; 2 * (all.variables() - 1) * usize::from(all.thermal)]
            },
            viscosities: (0..all.dashpots)
                .map(|k| (k < law.dashpots).then_some(k))
                .collect(),
            temperature: (0..usize::from(law.thermal)).map(Some).collect(),
        })
    }

    /// A state of a law in the arrays of the type.
    pub(super) fn spread(&self, x: &[f64]) -> Vec<f64> {
        let places = self.state.iter();
        places.map(|place| place.map_or(0.0, |at| x[at])).collect()
    }

    /// The numbers of a law in an array of the type, for each of its variables.
    pub(super) fn gathered(&self, found: &[f64]) -> Vec<f64> {
        let used = found.iter().zip(&self.state);
        used.filter_map(|(&number, place)| place.map(|_| number))
            .collect()
    }

    /// The programs, each with inputs and results at their places.
    pub(super) fn programs(&self, of: &Programs) -> Programs {
        let [x, y, c] = [&self.state, &self.responses, &self.corners];
        let eta = &self.viscosities;
        let first = |count: usize| (0..count).map(Some).collect::<Places>();
        let scalar = &first(1);
        let all = |program: &Program, inputs: &[&Places], results: &[Results<'_>]| {
            widened(program, inputs, results)
        };
        let sometimes = |program: &Option<Program>, inputs: &[&Places], results: &[Results<'_>]| {
            program
                .as_ref()
                .map(|program| all(program, inputs, results))
        };
        let slopes = &x[..x.len() - self.temperature.len()].to_vec();
        let form = [Results::of(y), Results::Rows(y, x)];
        let mut rates = vec![Results::of(x)];
        // Without a temperature there are no slopes.
        if !self.temperature.is_empty() {
            rates.push(Results::of(slopes));
        }
        let others = &first(1 + self.temperature.len());
        let rates_at: Vec<_> = rates.iter().copied().chain([Results::of(others)]).collect();
        let (caloric, caloric_at) = (&first(3), &first(4));
        Programs {
            free_energy: all(&of.free_energy, &[x], &[Results::of(scalar)]),
            energy_magnitude: all(&of.energy_magnitude, &[x], &[Results::of(scalar)]),
            internal_energy: all(&of.internal_energy, &[x], &[Results::of(scalar)]),
            gradient: all(&of.gradient, &[x], &[Results::of(x)]),
            hessian: all(&of.hessian, &[x], &[Results::of(x), Results::Rows(x, x)]),
            caloric: sometimes(&of.caloric, &[x], &[Results::of(caloric)]),
            caloric_at: sometimes(&of.caloric_at, &[x], &[Results::of(caloric_at)]),
            rates: all(&of.rates, &[x], &rates),
            rates_at: all(&of.rates_at, &[x], &rates_at),
            entropy_hessian: sometimes(&of.entropy_hessian, &[x], &[Results::Rows(x, x)]),
            viscosity: sometimes(
                &of.viscosity,
                &[&self.temperature],
                &[Results::Row(eta, Unused::One), Results::of(eta)],
            ),
            drag: of.drag.clone(),
            entropy_form: all(&of.entropy_form, &[x, x, c], &form),
            temperature_form: sometimes(&of.temperature_form, &[x, x], &form),
            mixed_states: sometimes(
                &of.mixed_states,
                &[x, x, c],
                &[Results::of(c), Results::Row(c, Unused::One)],
            ),
            has_constant_capacity: of.has_constant_capacity,
        }
    }

    /// The derivatives with respect to `parameters` parameters, likewise.
    pub(super) fn parameter_programs(
        &self,
        of: &ParameterPrograms,
        parameters: usize,
    ) -> ParameterPrograms {
        let [x, y, c] = [&self.state, &self.responses, &self.corners];
        let p: &Places = &(0..parameters).map(Some).collect();
        let sometimes = |program: &Option<Program>, inputs: &[&Places], results: &Places| {
            let program = program.as_ref();
            program.map(|program| widened(program, inputs, &[Results::of(results)]))
        };
        let all = |program: &Program, inputs: &[&Places], results: &Places| {
            widened(program, inputs, &[Results::of(results)])
        };
        let (theta, eta) = (&self.temperature, &self.viscosities);
        ParameterPrograms {
            temperature_form_adjoint: sometimes(&of.temperature_form_adjoint, &[x, x, y], p),
            temperature_form_tangent: sometimes(&of.temperature_form_tangent, &[x, x, p], y),
            entropy_form_adjoint: all(&of.entropy_form_adjoint, &[x, x, c, y], p),
            entropy_form_tangent: all(&of.entropy_form_tangent, &[x, x, c, p], y),
            gradient_adjoint: all(&of.gradient_adjoint, &[x, x], p),
            energy_by_parameters: all(&of.energy_by_parameters, &[x], p),
            viscosity_adjoint: sometimes(&of.viscosity_adjoint, &[theta, eta], p),
            drag_adjoint: of.drag_adjoint.clone(),
        }
    }
}

/// Results that follow one another.
#[derive(Clone, Copy)]
enum Results<'a> {
    Row(&'a [Option<usize>], Unused),
    /// Rows and columns of a matrix.
    Rows(&'a [Option<usize>], &'a [Option<usize>]),
}

impl<'a> Results<'a> {
    fn of(places: &'a [Option<usize>]) -> Self {
        Self::Row(places, Unused::Zero)
    }

    /// Number of results in the program of the law.
    fn used(&self) -> usize {
        let count = |places: &[Option<usize>]| places.iter().flatten().count();
        match self {
            Self::Row(places, _) => count(places),
            Self::Rows(rows, columns) => count(rows) * count(columns),
        }
    }

    /// The place of each result in the program of the law, or what it is.
    fn all(&self) -> Vec<Result<usize, Unused>> {
        match *self {
            Self::Row(places, unused) => places.iter().map(|place| place.ok_or(unused)).collect(),
            Self::Rows(rows, columns) => {
                let width = columns.iter().flatten().count();
                let of_row = |&row: &Option<usize>| {
                    columns.iter().map(move |&column| match (row, column) {
                        (Some(row), Some(column)) => Ok(row * width + column),
                        _ => Err(Unused::Zero),
                    })
                };
                rows.iter().flat_map(of_row).collect()
            }
        }
    }
}

/// A program with the inputs after its parameters and the results at other places.
fn widened(program: &Program, inputs: &[&Places], results: &[Results<'_>]) -> Program {
    let used = |places: &Places| places.iter().flatten().count();
    let parameters = program.inputs.len() - inputs.iter().map(|places| used(places)).sum::<usize>();
    let mut moved: Vec<usize> = (0..parameters).collect();
    let mut all = program.inputs[..parameters].to_vec();
    for places in inputs {
        let first = moved.len();
        moved.resize(first + used(places), 0);
        for place in *places {
            if let Some(place) = place {
                moved[first + place] = all.len();
            }
            // An unused input has the symbol of another one; no instruction reads it.
            all.push(program.inputs[parameters + place.unwrap_or(0)].clone());
        }
    }
    let mut instructions: Vec<_> = program.instructions.clone();
    for instruction in &mut instructions {
        if let Operation::Input(input) = &mut instruction.operation {
            *input = moved[*input];
        }
    }
    let mut constant = |number: Number| {
        instructions.push(Instruction {
            operation: Operation::Constant(number),
            stage: Stage::New,
        });
        Value::new(instructions.len() - 1)
    };
    let [zero, one] = [Number::ZERO, Number::ONE].map(&mut constant);
    let mut outputs = Vec::new();
    let mut first = 0;
    for part in results {
        for place in part.all() {
            outputs.push(match place {
                Ok(place) => program.outputs[first + place],
                Err(Unused::Zero) => zero,
                Err(Unused::One) => one,
            });
        }
        first += part.used();
    }
    debug_assert_eq!(first, program.outputs.len(), "all results have places");
    Program {
        inputs: all,
        instructions,
        outputs,
    }
}

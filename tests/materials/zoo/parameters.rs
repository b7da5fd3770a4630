//! Derivatives by the parameters: generated code against the interpreter, bit for bit, and against 96 digits.

use eem::FreeEnergy;
use eem_symbolic::{
    Bounded, Operation, ParameterPrograms, Program, ProgramKernel, RunningError, Value as Place,
};
use eem_testkit::random::Random;
use eem_testkit::table::array;

use crate::kernels::Kernels;
use crate::zoo::bounds::{Worst, assert_all};
use crate::zoo::digits::{Law, exact};
use crate::zoo::families;
use crate::zoo::number::Value;
use crate::zoo::precise::{self, Precise};
use crate::zoo::specimen::Specimen;
use crate::zoo::states::{self, Corner};

/// The exact value is known here: what is left is what a first-order bound leaves out.
const ALLOWED: f64 = 1.25;
/// Size of the step whose derivatives are compared with 96 digits.
const STEP: f64 = 1e-2;

/// A function of a model by its name; arguments in the order of its inputs.
pub(crate) fn generated<F: FreeEnergy<f64>>(
    model: &F,
    function: &str,
    arguments: &[&[f64]],
) -> Vec<f64> {
    let parameters = match (function, arguments) {
        ("temperature_form_adjoint", [x0, x1, w]) => {
            model.temperature_form_adjoint(&array(x0), &array(x1), &array(w))
        }
        ("entropy_form_adjoint", [x0, x1, corners, w]) => {
            model.entropy_form_adjoint(&array(x0), &array(x1), &array(corners), &array(w))
        }
        ("gradient_adjoint", [x, w]) => model.gradient_adjoint(&array(x), &array(w)),
        ("energy_by_parameters", [x]) => model.energy_by_parameters(&array(x)),
        ("viscosity_adjoint", [theta, w]) => {
            model.viscosity_adjoint(theta.first().copied().unwrap_or_default(), &array(w))
        }
        ("temperature_form_tangent", [x0, x1, direction]) => {
            let tangent = model.temperature_form_tangent(&array(x0), &array(x1), &array(direction));
            return tangent.as_ref().to_vec();
        }
        ("entropy_form_tangent", [x0, x1, corners, direction]) => {
            let tangent = model.entropy_form_tangent(
                &array(x0),
                &array(x1),
                &array(corners),
                &array(direction),
            );
            return tangent.as_ref().to_vec();
        }
        _ => panic!("`{function}` of {} arguments", arguments.len()),
    };
    parameters.as_ref().to_vec()
}

/// Numbers between −½ and ½.
fn seed(count: usize) -> Vec<f64> {
    let mut random = Random::new(11);
    (0..count).map(|_| random.unit() - 0.5).collect()
}

/// Parts of the parameters.
fn direction(specimen: &dyn Specimen) -> Vec<f64> {
    let parameters = specimen.parameters();
    let parts = seed(parameters.len()).into_iter().zip(parameters);
    parts.map(|(part, parameter)| part * parameter).collect()
}

/// All functions that a model has, with their programs and arguments at a step, or at its end.
fn calls<'p>(
    specimen: &dyn Specimen,
    programs: &'p ParameterPrograms,
    [x0, x1]: &[Vec<f64>; 2],
    corners: &[f64],
) -> Vec<(&'static str, &'p Program, Vec<Vec<f64>>)> {
    let responses = x0.len() + usize::from(specimen.thermal());
    let (weights, direction) = (seed(responses), direction(specimen));
    let theta = x1.last().copied().filter(|_| specimen.thermal());
    let theta = theta.as_slice().to_vec();
    let before = specimen.parameters().len() + theta.len();
    let arguments = |function, program: &Program| match function {
        "temperature_form_adjoint" => vec![x0.clone(), x1.clone(), weights.clone()],
        "temperature_form_tangent" => vec![x0.clone(), x1.clone(), direction.clone()],
        "entropy_form_adjoint" => {
            vec![x0.clone(), x1.clone(), corners.to_vec(), weights.clone()]
        }
        "entropy_form_tangent" => {
            vec![x0.clone(), x1.clone(), corners.to_vec(), direction.clone()]
        }
        "gradient_adjoint" => vec![x1.clone(), seed(x1.len())],
        "energy_by_parameters" => vec![x1.clone()],
        "viscosity_adjoint" => vec![theta.clone(), seed(program.inputs.len() - before)],
        _ => panic!("no specimen has `{function}`"),
    };
    let named = programs.named();
    named
        .map(|(function, program)| (function, program, arguments(function, program)))
        .collect()
}

fn call(specimen: &dyn Specimen, function: &str, arguments: &[Vec<f64>]) -> Vec<f64> {
    let arguments: Vec<_> = arguments.iter().map(Vec::as_slice).collect();
    specimen.by_parameters(function, &arguments)
}

fn thetas(corners: &[Corner]) -> Vec<f64> {
    corners.iter().map(|corner| corner.theta).collect()
}

#[test]
fn generated_code_is_the_interpreted_program_bit_for_bit() {
    for specimen in families::all() {
        let model = specimen.symbolic();
        let programs = model.parameter_programs(&model.programs());
        for step in states::steps(&*specimen) {
            let corners = thetas(&states::corners(&*specimen, &step[0], &step[1]));
            for (function, program, arguments) in calls(&*specimen, &programs, &step, &corners) {
                let inputs = [vec![specimen.parameters()], arguments.clone()].concat();
                let interpreted = program.interpret(&Kernels, &inputs.concat());
                let generated = call(&*specimen, function, &arguments);
                let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
                assert_eq!(
                    bits(&interpreted),
                    bits(&generated),
                    "{}, {function} at {step:?}: {interpreted:?} and {generated:?}",
                    specimen.name()
                );
            }
        }
    }
}

/// What is differentiated, with the value of one parameter.
type Outputs<'f> = &'f dyn Fn(Option<(usize, Precise)>) -> Vec<Precise>;

/// `[∂(output)/∂μ_j …]` by a central difference.
fn difference(specimen: &dyn Specimen, j: usize, outputs: Outputs<'_>) -> Vec<Precise> {
    let parameter = Precise::of(specimen.parameters()[j]);
    let step = precise::coarse_offset(parameter);
    let above = outputs(Some((j, parameter.add(step))));
    let below = outputs(Some((j, parameter.sub(step))));
    let pairs = above.into_iter().zip(below);
    pairs
        .map(|(above, below)| above.sub(below).div(step.add(step)))
        .collect()
}

/// A call with the bounds of its outputs.
struct Call<'c> {
    what: String,
    generated: Vec<f64>,
    bounded: Vec<Bounded>,
    weights: &'c [f64],
}

impl Call<'_> {
    /// Adjoints against `Σ w ∂(output)/∂μ_j`.
    fn compare(&self, j: usize, slopes: &[Precise], worst: &mut Worst) -> Option<String> {
        let terms = slopes.iter().zip(self.weights);
        let terms = terms.map(|(&slope, &weight)| slope.mul(Precise::of(weight)));
        let expected = terms.reduce(Value::add).unwrap_or_else(|| Precise::of(0.0));
        let error = expected.distance(self.generated[j]);
        let what = || format!("{} by {j}", self.what);
        worst.see(error, self.bounded[j], ALLOWED, what)
    }
}

fn compare(
    specimen: &dyn Specimen,
    programs: &ParameterPrograms,
    worst: &mut Worst,
) -> Vec<String> {
    let step = states::step(specimen, STEP);
    let corners = states::corners(specimen, &step[0], &step[1]);
    let thetas = thetas(&corners);
    let mut wrong = Vec::new();
    for (function, program, arguments) in calls(specimen, programs, &step, &thetas) {
        let Some((weights, _)) = arguments.split_last() else {
            continue;
        };
        let inputs = [vec![specimen.parameters()], arguments.clone()].concat();
        let mut inputs: Vec<_> = inputs.concat().into_iter().map(Bounded::exact).collect();
        if function.starts_with("entropy_form") {
            let first = specimen.parameters().len() + 2 * step[0].len();
            for (input, corner) in inputs[first..].iter_mut().zip(&corners) {
                input.error = corner.error;
            }
        }
        let one = [1.0];
        let is_energy = function == "energy_by_parameters";
        let call = Call {
            what: format!("{}, {function}", specimen.name()),
            generated: call(specimen, function, &arguments),
            bounded: program.interpret(&RunningError, &inputs),
            weights: if is_energy { &one } else { weights },
        };
        let [x0, x1, near] = [&step[0], &step[1], &thetas].map(|x| exact(x));
        let outputs = |moved| -> Vec<Precise> {
            let law = Law { specimen, moved };
            let form = |name| {
                law.form(name, &x0, &x1, &near)
                    .expect("no increment is zero")
            };
            match function {
                "temperature_form_adjoint" => form("temperature form"),
                "entropy_form_adjoint" => form("entropy form"),
                "gradient_adjoint" => (0..x1.len())
                    .map(|i| {
                        law.point("gradient", i, &x1)
                            .expect("a function of the state")
                    })
                    .collect(),
                "energy_by_parameters" => law.point("e", 0, &x1).into_iter().collect(),
                _ => Vec::new(),
            }
        };
        if outputs(None).is_empty() {
            continue;
        }
        for j in 0..specimen.parameters().len() {
            let slopes = difference(specimen, j, &outputs);
            wrong.extend(call.compare(j, &slopes, worst));
        }
        precise::forget();
    }
    wrong
}

#[test]
fn derivatives_have_the_digits_of_the_exact_ones() {
    assert_all(|specimen, programs, worst| {
        let derivatives = specimen.symbolic().parameter_programs(programs);
        compare(specimen, &derivatives, worst)
    });
}

/// The adjoint of a response against its tangent, `wᵀ (∂(response)/∂μ δμ)`, within the bounds of both.
#[test]
fn adjoints_agree_with_tangents() {
    let product = |outputs: Vec<Bounded>, factors: &[f64]| {
        let terms = outputs.into_iter().zip(factors);
        terms.fold([0.0, 0.0], |[value, error], (output, factor)| {
            [
                value + output.value * factor,
                error + output.error * factor.abs(),
            ]
        })
    };
    for specimen in families::all() {
        let model = specimen.symbolic();
        let programs = model.parameter_programs(&model.programs());
        for step in states::steps(&*specimen) {
            let corners = thetas(&states::corners(&*specimen, &step[0], &step[1]));
            let calls = calls(&*specimen, &programs, &step, &corners);
            for form in ["temperature_form", "entropy_form"] {
                let of = |kind: &str| {
                    let name = format!("{form}_{kind}");
                    let (_, program, arguments) =
                        calls.iter().find(|(function, ..)| *function == name)?;
                    let inputs = [vec![specimen.parameters()], arguments.clone()].concat();
                    let inputs = inputs.concat().into_iter().map(Bounded::exact);
                    let outputs = program.interpret(&RunningError, &inputs.collect::<Vec<_>>());
                    Some((outputs, arguments.last()?.clone()))
                };
                let (Some((adjoint, weights)), Some((tangent, direction))) =
                    (of("adjoint"), of("tangent"))
                else {
                    continue;
                };
                let [a, t] = [product(adjoint, &direction), product(tangent, &weights)];
                assert!(
                    (a[0] - t[0]).abs() <= a[1] + t[1],
                    "{}, {form} at {step:?}: {} and {}",
                    specimen.name(),
                    a[0],
                    t[0]
                );
            }
        }
    }
}

/// What an adjoint costs, values included, over what it is the derivative of; Baur & Strassen 1983 allow four times for
/// products and quotients. A difference `xᵖ[a, b]` with p a parameter takes two second ones and one of the logarithm more,
/// which is four kernels, and the powers and logarithms at the ends.
fn allowed(program: &Program) -> [usize; 2] {
    let is_constant = |exponent: Place| {
        let operation = &program.instructions[exponent.index()].operation;
        matches!(operation, Operation::Constant(_))
    };
    let has_exponents = program.instructions.iter().any(|instruction| {
        matches!(instruction.operation, Operation::DividedDifference(ProgramKernel::Powf(p), ..)
            if !is_constant(p))
    });
    if has_exponents { [5, 4] } else { [3, 3] }
}

#[test]
fn adjoints_cost_three_times_the_values_at_most() {
    let cost = |program: &Program| {
        let count = program.operation_count();
        let kernels = count.old.kernels + count.new.kernels;
        [count.old.total() + count.new.total(), kernels]
    };
    for specimen in families::all() {
        let model = specimen.symbolic();
        let programs = model.programs();
        let derivatives = model.parameter_programs(&programs);
        let responses = specimen.state().len() + usize::from(specimen.thermal());
        let response = |form: &Program| form.restricted_to(responses).program;
        // The adjoint of the entropy form differentiates what determines its corners, too.
        let corners = programs.mixed_states.as_ref().map_or([0, 0], cost);
        let mut rows = vec![(
            "entropy",
            response(&programs.entropy_form),
            corners,
            &derivatives.entropy_form_adjoint,
        )];
        let temperature = programs.temperature_form.as_ref();
        let adjoint = derivatives.temperature_form_adjoint.as_ref();
        if let Some((form, adjoint)) = temperature.zip(adjoint) {
            rows.push(("temperature", response(form), [0, 0], adjoint));
        }
        for (form, response, corners, adjoint) in rows {
            let [values, adjoint] = [cost(&response), cost(adjoint)];
            let values = [values[0] + corners[0], values[1] + corners[1]];
            let what = format!("{:24} {form:12} {values:?} {adjoint:?}", specimen.name());
            println!("{what}");
            for (i, allowed) in allowed(&response).into_iter().enumerate() {
                assert!(adjoint[i] <= allowed * values[i], "{what}");
            }
        }
    }
}

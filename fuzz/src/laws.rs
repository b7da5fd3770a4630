//! Any expression as a free energy: programs are valid and the same each time, divided differences
//! times increments are differences, and the first law holds in every step.

use eem_symbolic::{
    Bounded, ExprId, Graph, Input, Operation, Program, Stage, Symbol, Value, diff,
    divided_difference, format, schedule,
};

use crate::kernels::BoundedKernels;
use crate::recipe::Recipe;

/// λ, γ, θ, k, c.
const POINT: [f64; 5] = [1.3, 0.4, 2.1, 1.7, 0.6];
/// |b − a|/a.
const INCREMENTS: [f64; 4] = [1e-12, 1e-6, 1e-2, 0.7];
/// Bounds are of first order: numbers with fewer digits than this, relative, are not compared.
const DETERMINED: f64 = 1e-6;
/// Numbers outside of 1/LARGE … LARGE are not compared: their products overflow.
const LARGE: f64 = 1e60;
/// Room for what a first-order bound leaves out.
const ALLOWED: f64 = 4.0;

/// What must hold for every expression.
///
/// # Panics
///
/// If something does not hold.
pub fn laws(data: &[u8]) {
    let recipe = Recipe::read(data);
    if !recipe.is_tame() {
        return;
    }
    let increment = INCREMENTS[data.len() % INCREMENTS.len()];
    differences(&recipe, data.len() / INCREMENTS.len() % 3, increment);
    let model = recipe.model();
    let (programs, formulas) = (model.programs(), model.formulas());
    assert_eq!(formulas.free_energy, format(&model.graph, model.psi));
    let all = [
        Some(&programs.free_energy),
        Some(&programs.energy_magnitude),
        Some(&programs.gradient),
        Some(&programs.hessian),
        Some(&programs.internal_energy),
        programs.caloric.as_ref(),
        programs.entropy_hessian.as_ref(),
        programs.viscosity.as_ref(),
        Some(&programs.entropy_form),
        programs.temperature_form.as_ref(),
    ];
    for program in all.into_iter().flatten() {
        program.verify().expect("a valid program");
    }
    // Costs as much as everything else together.
    if data.len().is_multiple_of(8) {
        assert_eq!(programs, recipe.model().programs());
    }
    if let Some(form) = &programs.temperature_form {
        first_law(&programs.internal_energy, form, increment);
    }
}

fn program(graph: &Graph, symbols: &[Symbol], outputs: &[ExprId]) -> Program {
    let input = |&symbol: &Symbol| Input {
        symbol,
        name: graph.name(symbol).to_owned(),
        stage: Stage::New,
    };
    let program = schedule(graph, symbols.iter().map(input).collect(), outputs);
    program.verify().expect("a valid program");
    program
}

/// The first outputs, if everything on the way to them is determined.
fn determined(program: &Program, inputs: &[f64], count: usize) -> Option<Vec<Bounded>> {
    let mut all = program.clone();
    let wanted = &program.outputs[..count];
    let last = wanted.iter().map(|output| output.index()).max()?;
    all.instructions.truncate(last + 1);
    // Joint differences are no numbers; each of their parts is an instruction.
    let joint = |operation: &Operation| matches!(operation, Operation::JointDifferences(..));
    let numbers = (0..=last).filter(|&index| !joint(&all.instructions[index].operation));
    all.outputs = numbers.map(Value::new).chain(wanted.to_vec()).collect();
    let inputs: Vec<Bounded> = inputs.iter().map(|&x| Bounded::exact(x)).collect();
    let values = all.interpret(&BoundedKernels, &inputs);
    let sound = |Bounded { value, error }: &Bounded| {
        let size = value.abs();
        let exact = *error <= 0.0 && size < LARGE;
        exact || (size < LARGE && size > 1.0 / LARGE && *error <= DETERMINED * size)
    };
    let results = &values[values.len() - count..];
    values.iter().all(sound).then(|| results.to_vec())
}

/// `e[a, b] (b − a) = e(b) − e(a)`, and `e[a, a] = ∂e/∂x`.
fn differences(recipe: &Recipe, variable: usize, increment: f64) {
    let (mut graph, symbols) = (recipe.graph.clone(), recipe.symbols);
    let x = symbols[variable];
    let ends = [graph.version(x, "a"), graph.version(x, "b")];
    let [a, b] = ends.map(|end| graph.variable(end));
    let difference = divided_difference(&mut graph, recipe.psi, x, a, b);
    let curvature = diff(&mut graph, difference, ends[1]);
    let slope = diff(&mut graph, recipe.psi, x);
    let of_state = program(&graph, &symbols, &[recipe.psi, slope]);
    let symbols = [&symbols[..], &ends].concat();
    let of_ends = program(&graph, &symbols, &[difference]);
    program(&graph, &symbols, &[curvature]);

    let at = |x: f64| {
        let mut point = POINT;
        point[variable] = x;
        point
    };
    let a = POINT[variable];
    let b = a * (1.0 + increment);
    let states = [a, b].map(|x| determined(&of_state, &at(x), 2));
    let secants = [a, b].map(|x| determined(&of_ends, &[&at(a)[..], &[a, x]].concat(), 1));
    let [Some(at_a), Some(at_b)] = states else {
        return;
    };
    let [tangent, secant] = secants;
    let what = || format(&graph, recipe.psi);
    if let Some(tangent) = tangent {
        let defect = (tangent[0].value - at_a[1].value).abs();
        let bound = tangent[0].error + at_a[1].error;
        assert!(
            defect <= ALLOWED * bound,
            "slope of {}: {defect:e}, {bound:e}",
            what()
        );
    }
    if let Some(secant) = secant {
        let (width, rise) = (b - a, at_b[0].value - at_a[0].value);
        let defect = (secant[0].value * width - rise).abs();
        let own = f64::EPSILON * (rise.abs() + (secant[0].value * width).abs());
        let bound = secant[0].error * width.abs() + at_a[0].error + at_b[0].error + own;
        assert!(
            defect <= ALLOWED * bound,
            "difference of {}: {defect:e}, {bound:e}",
            what()
        );
    }
}

/// `f* Δλ − g* Δγ + θ* Δs = Δe` in temperature form.
fn first_law(energy: &Program, form: &Program, increment: f64) {
    let [lambda, gamma, theta, k, c] = POINT;
    let x0 = [lambda, gamma, theta];
    let x1 = [1.0, -0.7, 0.4].map(|shape| 1.0 + shape * increment);
    let x1 = [0, 1, 2].map(|i| x0[i] * x1[i]);
    let energies = [x0, x1].map(|x| determined(energy, &[&[k, c][..], &x].concat(), 1));
    let [Some(before), Some(after)] = energies else {
        return;
    };
    let Some(response) = determined(form, &[&[k, c][..], &x0, &x1].concat(), 4) else {
        return;
    };
    let [f, g, theta, entropy] = [0, 1, 2, 3].map(|i| response[i]);
    let [dl, dg] = [x1[0] - x0[0], x1[1] - x0[1]];
    let terms = [f.value * dl, -g.value * dg, theta.value * entropy.value];
    let change = after[0].value - before[0].value;
    let defect = (terms.iter().sum::<f64>() - change).abs();
    let own = f64::EPSILON * (terms.iter().map(|term| term.abs()).sum::<f64>() + change.abs());
    let bound = f.error * dl.abs()
        + g.error * dg.abs()
        + theta.error * entropy.value.abs()
        + theta.value.abs() * entropy.error
        + before[0].error
        + after[0].error
        + own;
    assert!(
        defect <= ALLOWED * bound,
        "first law: {defect:e} J, bound {bound:e} J"
    );
}

//! What the numbers have to fulfil whoever computes them: the first law of a step, and symmetry in time.

use eem_symbolic::{Bounded, Programs};

use crate::zoo::bounds::{self, assert_none};
use crate::zoo::families;
use crate::zoo::specimen::Specimen;
use crate::zoo::states;

/// All numbers are within their bounds; a quarter for what a first-order bound leaves out.
const ALLOWED: f64 = 1.25;
/// The sums taken here round, too: half an ulp of each of at most a dozen terms.
const SUMS: f64 = 6.0 * f64::EPSILON;

/// A response as it was generated, and what rounding can have done to it.
struct Response {
    form: &'static str,
    values: Vec<Bounded>,
}

fn bounded(generated: f64, bound: Bounded) -> Bounded {
    Bounded {
        value: generated,
        error: bound.error,
    }
}

/// The responses of a step in both forms: the same bits with and without a tangent.
fn responses(
    specimen: &dyn Specimen,
    programs: &Programs,
    step: &[Vec<f64>; 2],
    wrong: &mut Vec<String>,
) -> Vec<Response> {
    let [x0, x1] = step;
    let corners = states::corners(specimen, x0, x1);
    let thetas: Vec<f64> = corners.iter().map(|corner| corner.theta).collect();
    let outputs = bounds::forms(specimen, programs, step, &corners);
    let respond = |output: bounds::Output| {
        let form = output.function;
        let alone = match form {
            "entropy form" => specimen.entropy_response(x0, x1, &thetas),
            _ => specimen.temperature_response(x0, x1),
        };
        for (i, (alone, with)) in alone.iter().zip(&output.generated).enumerate() {
            if alone.to_bits() != with.to_bits() {
                let name = specimen.name();
                wrong.push(format!(
                    "{name}, {form} {i} in {step:?}: {alone:e} without tangent, {with:e}"
                ));
            }
        }
        let pairs = alone.into_iter().zip(output.bounded);
        let values = pairs
            .map(|(generated, bound)| bounded(generated, bound))
            .collect();
        Response { form, values }
    };
    outputs.into_iter().map(respond).collect()
}

/// e of a state.
fn energy(specimen: &dyn Specimen, programs: &Programs, x: &[f64]) -> Bounded {
    let mut outputs = bounds::points(specimen, programs, x).into_iter();
    let e = outputs
        .find(|output| output.function == "e")
        .expect("every model has an energy");
    bounded(e.generated[0], e.bounded[0])
}

/// `f*·Δλ − g*·Δγ + θ* Δs = Δe`.
fn first_law(
    specimen: &dyn Specimen,
    response: &[Bounded],
    [x0, x1]: &[Vec<f64>; 2],
    [e0, e1]: [Bounded; 2],
) -> (f64, f64) {
    let mechanical = specimen.measures() + specimen.dashpots();
    let mut terms = vec![e0.value, -e1.value];
    let mut error = e0.error + e1.error;
    for (i, force) in response[..mechanical].iter().enumerate() {
        let sign = if i < specimen.measures() { 1.0 } else { -1.0 };
        let width = x1[i] - x0[i];
        terms.push(sign * force.value * width);
        error += force.error * width.abs();
    }
    if let [theta, change] = response[mechanical..] {
        terms.push(theta.value * change.value);
        error += theta.error * change.value.abs() + theta.value.abs() * change.error;
    }
    let size: f64 = terms.iter().map(|term| term.abs()).sum();
    (terms.iter().sum::<f64>().abs(), error + SUMS * size)
}

#[test]
fn discrete_derivatives_add_up_to_the_energy() {
    let mut wrong = Vec::new();
    for specimen in families::all() {
        let (programs, mut worst) = (specimen.symbolic().programs(), 0.0_f64);
        for step in states::steps(&*specimen) {
            let energies = [0, 1].map(|end| energy(&*specimen, &programs, &step[end]));
            for Response { form, values } in responses(&*specimen, &programs, &step, &mut wrong) {
                let (defect, bound) = first_law(&*specimen, &values, &step, energies);
                worst = worst.max(defect / bound);
                if defect.is_nan() || defect > ALLOWED * bound {
                    let name = specimen.name();
                    wrong.push(format!(
                        "{name}, {form} in {step:?}: off by {defect:e} J, bound {bound:e}"
                    ));
                }
            }
        }
        println!("{:22} {worst:.2} of the bound", specimen.name());
    }
    assert_none(&wrong);
}

/// Exchanging the two states changes nothing but the sign of Δs: the step is its own inverse.
#[test]
fn forms_are_symmetric_in_time() {
    let mut wrong = Vec::new();
    for specimen in families::all() {
        let (programs, mut worst) = (specimen.symbolic().programs(), 0.0_f64);
        for step in states::steps(&*specimen) {
            let back = [step[1].clone(), step[0].clone()];
            let forward = responses(&*specimen, &programs, &step, &mut wrong);
            let backward = responses(&*specimen, &programs, &back, &mut wrong);
            for (forward, backward) in forward.iter().zip(&backward) {
                let pairs = forward.values.iter().zip(&backward.values);
                for (i, (there, back)) in pairs.enumerate() {
                    let sign = if i == step[0].len() { -1.0 } else { 1.0 };
                    let difference = (there.value - sign * back.value).abs();
                    let bound = there.error + back.error + f64::MIN_POSITIVE;
                    worst = worst.max(difference / bound);
                    if difference.is_nan() || difference > ALLOWED * bound {
                        let (name, form) = (specimen.name(), forward.form);
                        wrong.push(format!(
                            "{name}, {form} {i} in {step:?}: {:e} and {:e}, bound {bound:e}",
                            there.value, back.value
                        ));
                    }
                }
            }
        }
        println!("{:22} {worst:.2} of the bound", specimen.name());
    }
    assert_none(&wrong);
}

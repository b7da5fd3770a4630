//! Generated code against 96 digits: derivatives and discrete derivatives as plain quotients of
//! differences of ψ, which is all that the two have in common.

use eem_symbolic::{Bounded, Programs};
use eem_testkit::length::at_length;

use crate::zoo::bounds::{self, Output, Worst, assert_all};
use crate::zoo::digits::{Law, exact};
use crate::zoo::families;
use crate::zoo::number::Value;
use crate::zoo::precise::{self, Precise};
use crate::zoo::specimen::Specimen;
use crate::zoo::states;

/// The exact value is known here: what is left is what a first-order bound leaves out.
const ALLOWED: f64 = 1.25;
/// Size of the step whose tangents are compared.
const TANGENT: f64 = 1e-2;

fn compare_points(specimen: &dyn Specimen, programs: &Programs, worst: &mut Worst) -> Vec<String> {
    let (law, mut wrong) = (Law::new(specimen), Vec::new());
    for x in states::around(specimen) {
        for Output {
            function,
            bounded,
            generated,
        } in bounds::points(specimen, programs, &x)
        {
            for (i, &generated) in generated.iter().enumerate() {
                let Some(exact) = law.point(function, i, &exact(&x)) else {
                    continue;
                };
                let what = || format!("{}, {function} {i} at {x:?}", specimen.name());
                wrong.extend(worst.see(exact.distance(generated), bounded[i], ALLOWED, what));
            }
        }
        precise::forget();
    }
    wrong
}

#[test]
fn functions_of_a_state_have_the_digits_of_the_exact_ones() {
    assert_all(compare_points);
}

/// Units of ε that a magnitude of ψ stands for.
const UNITS: f64 = 8.0;

#[test]
fn free_energies_are_within_their_magnitude() {
    for specimen in families::all() {
        let (law, name) = (Law::new(&*specimen), specimen.name());
        let mut worst = 0.0_f64;
        for x in states::around(&*specimen) {
            let (psi, magnitude) = (specimen.free_energy(&x), specimen.energy_magnitude(&x));
            let exact = law
                .point("ψ", 0, &exact(&x))
                .expect("ψ is a function of the state");
            let part = exact.distance(psi) / (UNITS * f64::EPSILON * magnitude);
            assert!(
                part <= 1.0,
                "{name} at {x:?}: {part:.2} of 8 ε {magnitude:e} J"
            );
            worst = worst.max(part);
        }
        precise::forget();
        println!("{name:22} {worst:.2} of the magnitude");
    }
}

fn compare_forms(specimen: &dyn Specimen, programs: &Programs, worst: &mut Worst) -> Vec<String> {
    let (law, mut wrong) = (Law::new(specimen), Vec::new());
    for step in states::steps(specimen) {
        let corners = states::corners(specimen, &step[0], &step[1]);
        let near: Vec<f64> = corners.iter().map(|corner| corner.theta).collect();
        let [x0, x1, near] = [&step[0], &step[1], &near].map(|x| exact(x));
        for Output {
            function,
            bounded,
            generated,
        } in bounds::forms(specimen, programs, &step, &corners)
        {
            let response = law.form(function, &x0, &x1, &near);
            for (i, exact) in response.into_iter().flatten().enumerate() {
                let Bounded { value, .. } = bounded[i];
                let what = || {
                    format!(
                        "{}, {function} {i} = {value:e} in {step:?}",
                        specimen.name()
                    )
                };
                wrong.extend(worst.see(exact.distance(generated[i]), bounded[i], ALLOWED, what));
            }
        }
        precise::forget();
    }
    wrong
}

#[test]
fn discrete_derivatives_have_the_digits_of_the_exact_ones() {
    assert_all(compare_forms);
}

/// Entry i of the result is `∂(response i)/∂x¹_j`.
fn tangent(respond: &dyn Fn(&[Precise]) -> Vec<Precise>, x1: &[Precise], j: usize) -> Vec<Precise> {
    let step = precise::coarse_offset(x1[j]);
    let at = |step: Precise| {
        let mut x1 = x1.to_vec();
        x1[j] = x1[j].add(step);
        respond(&x1)
    };
    let pairs = at(step).into_iter().zip(at(step.neg()));
    let slope = |(above, below): (Precise, Precise)| above.sub(below).div(step.add(step));
    pairs.map(slope).collect()
}

fn compare_tangents(
    specimen: &dyn Specimen,
    programs: &Programs,
    worst: &mut Worst,
) -> Vec<String> {
    let (law, mut wrong) = (Law::new(specimen), Vec::new());
    let step = states::step(specimen, TANGENT);
    let corners = states::corners(specimen, &step[0], &step[1]);
    let near: Vec<f64> = corners.iter().map(|corner| corner.theta).collect();
    let [x0, x1, near] = [&step[0], &step[1], &near].map(|x| exact(x));
    for output in bounds::forms(specimen, programs, &step, &corners) {
        let respond = |x1: &[Precise]| {
            let response = law.form(output.function, &x0, x1, &near);
            response.expect("no increment is zero")
        };
        for j in (0..x1.len()).step_by(at_length(1, 2)) {
            let column = tangent(&respond, &x1, j);
            for (i, exact) in column.iter().enumerate() {
                let place = column.len() + i * x1.len() + j;
                let error = exact.distance(output.generated[place]);
                let what = || format!("{}, {} {i} by {j}", specimen.name(), output.function);
                wrong.extend(worst.see(error, output.bounded[place], ALLOWED, what));
            }
        }
    }
    precise::forget();
    wrong
}

#[test]
fn tangents_have_the_digits_of_the_exact_ones() {
    assert_all(compare_tangents);
}

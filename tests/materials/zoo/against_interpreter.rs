//! Generated code against the interpreter of the programs it was printed from.

use crate::zoo::bounds::{self, Output, Worst, assert_all};
use crate::zoo::states;

/// Both are within the bound of the exact value; half a bound for what the first order leaves out.
const ALLOWED: f64 = 2.5;

fn compare(
    worst: &mut Worst,
    name: &str,
    outputs: Vec<Output>,
    at: &dyn std::fmt::Debug,
) -> Vec<String> {
    let mut wrong = Vec::new();
    for Output {
        function,
        bounded,
        generated,
    } in outputs
    {
        for (i, (bounded, generated)) in bounded.into_iter().zip(generated).enumerate() {
            let error = (bounded.value - generated).abs();
            let what = || format!("{name}, {function} {i} at {at:?}");
            wrong.extend(worst.see(error, bounded, ALLOWED, what));
        }
    }
    wrong
}

#[test]
fn functions_of_a_state_agree_with_the_interpreter() {
    assert_all(|specimen, programs, worst| {
        let mut wrong = Vec::new();
        for x in states::around(specimen) {
            let outputs = bounds::points(specimen, programs, &x);
            wrong.extend(compare(worst, specimen.name(), outputs, &x));
        }
        wrong
    });
}

#[test]
fn forms_agree_with_the_interpreter() {
    assert_all(|specimen, programs, worst| {
        let mut wrong = Vec::new();
        for step in states::steps(specimen) {
            let corners = states::corners(specimen, &step[0], &step[1]);
            let outputs = bounds::forms(specimen, programs, &step, &corners);
            wrong.extend(compare(worst, specimen.name(), outputs, &step));
        }
        wrong
    });
}

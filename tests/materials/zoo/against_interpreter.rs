//! Generated code against the interpreter of the programs it was printed from.

use crate::zoo::bounds::{self, Output, Worst, assert_none};
use crate::zoo::families;
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
    let mut wrong = Vec::new();
    for specimen in families::all() {
        let (programs, mut worst) = (specimen.symbolic().programs(), Worst::default());
        for x in states::around(&*specimen) {
            let outputs = bounds::points(&*specimen, &programs, &x);
            wrong.extend(compare(&mut worst, specimen.name(), outputs, &x));
        }
        let Worst { of_bound, ulps } = worst;
        println!(
            "{:22} {of_bound:.2} of the bound, {ulps:.1} ulp",
            specimen.name()
        );
    }
    assert_none(&wrong);
}

#[test]
fn forms_agree_with_the_interpreter() {
    let mut wrong = Vec::new();
    for specimen in families::all() {
        let (programs, mut worst) = (specimen.symbolic().programs(), Worst::default());
        for step in states::steps(&*specimen) {
            let corners = states::corners(&*specimen, &step[0], &step[1]);
            let outputs = bounds::forms(&*specimen, &programs, &step, &corners);
            wrong.extend(compare(&mut worst, specimen.name(), outputs, &step));
        }
        let Worst { of_bound, ulps } = worst;
        println!(
            "{:22} {of_bound:.2} of the bound, {ulps:.1} ulp",
            specimen.name()
        );
    }
    assert_none(&wrong);
}

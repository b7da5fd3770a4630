//! Generated code against dual numbers: no graph, no rule of differentiation in common.

use eem_symbolic::{Bounded, Programs};

use crate::zoo::bounds::{self, Output, Worst, assert_all};
use crate::zoo::dual::seeded;
use crate::zoo::specimen::Specimen;
use crate::zoo::states;

/// The dual numbers round too, and their rules of differentiation take more operations: products
/// of the same terms by three or four roundings each instead of one.
const ALLOWED: f64 = 4.0;
/// The least error of a number that the program may know without any: three products by a rule.
const ULPS: f64 = 4.0;

/// The value that an output of a function should have.
fn expected(specimen: &dyn Specimen, function: &str, i: usize, x: &[f64]) -> Option<f64> {
    let n = x.len();
    let psi = |j, k| specimen.psi_of_duals(&seeded(x, j, k)).0;
    let last = n - 1;
    Some(match (function, i) {
        ("e", _) if specimen.thermal() => {
            let psi = psi(last, last);
            psi.re - x[last] * psi.eps1
        }
        ("ψ" | "e", _) => psi(0, 0).re,
        ("gradient", j) => psi(j, j).eps1,
        ("Hessian", j) if j < n => psi(j, j).eps1,
        ("Hessian", entry) => psi(entry / n - 1, entry % n).eps1eps2,
        ("caloric", 0) => -psi(last, last).eps1,
        ("caloric", 1) => -x[last] * psi(last, last).eps1eps2,
        ("viscosity", i) => {
            let eta = specimen.viscosities_of_duals(&seeded(x, last, last));
            let [value, slope] = [eta[i % eta.len()].0.re, eta[i % eta.len()].0.eps1];
            if i < eta.len() { value } else { slope }
        }
        _ => return None,
    })
}

/// What the subtraction `ψ − θ ∂ψ/∂θ` costs, which the program of e has not.
fn own_error(specimen: &dyn Specimen, programs: &Programs, function: &str, x: &[f64]) -> f64 {
    match (function, x) {
        ("e", &[.., theta]) if specimen.thermal() => {
            let outputs = bounds::points(specimen, programs, x);
            let [psi, slope] = [&outputs[0].bounded[0], &outputs[2].bounded[x.len() - 1]];
            psi.error + theta * slope.error
        }
        _ => 0.0,
    }
}

fn compare(specimen: &dyn Specimen, programs: &Programs, worst: &mut Worst) -> Vec<String> {
    let mut wrong = Vec::new();
    for x in states::around(specimen) {
        for Output {
            function,
            bounded,
            generated,
        } in bounds::points(specimen, programs, &x)
        {
            for (i, &generated) in generated.iter().enumerate() {
                // Σ |terms of S| is a matter of the program.
                let Some(expected) = expected(specimen, function, i, &x) else {
                    continue;
                };
                let own = own_error(specimen, programs, function, &x)
                    + ULPS / ALLOWED * f64::EPSILON * expected.abs();
                let bounded = Bounded {
                    value: expected,
                    error: bounded[i].error + own,
                };
                let what = || format!("{}, {function} {i} at {x:?}", specimen.name());
                wrong.extend(worst.see((generated - expected).abs(), bounded, ALLOWED, what));
            }
        }
    }
    wrong
}

#[test]
fn functions_of_a_state_agree_with_dual_numbers() {
    assert_all(compare);
}

//! What the numbers of a model have to fulfil, by computations that know nothing of programs.

use eem_runtime::invert;

use crate::generated_against_interpreter::compare::array;
use crate::generated_against_interpreter::laws::Law;

/// Relative increments of a step.
const INCREMENTS: [f64; 7] = [0.0, 1e-15, 1e-12, 1e-8, 1e-4, 1e-2, 0.2];
/// Rounding of a sum of energies, relative to the sum of their magnitudes: some ten operations on
/// quantities of that size.
const ROUNDING: f64 = 32.0 * f64::EPSILON;
/// Rounding of an algorithmic quantity: that of its terms, of which at least a tenth remains in the
/// sum, and of the corner temperatures, whose inversions start at different ends.
const SYMMETRY: f64 = 64.0 * f64::EPSILON;
/// Step of a central difference relative to the variable: the third root of the rounding error of
/// the differences taken.
const DIFFERENCE: f64 = 1e-5;
/// Error of a central difference of that step: h² f‴/6 and ε f/h, relative to the largest entry.
const DIFFERENCE_ERROR: f64 = 2e-8;

/// Pairs of an old and a new state.
pub(crate) fn steps<L: Law>() -> Vec<(Vec<f64>, Vec<f64>)> {
    // Unequal changes, of both signs.
    let shapes = [1.0, -0.7, 0.9, 0.6];
    let state = L::state();
    let step = |increment: f64| {
        let moved = state.iter().zip(shapes);
        let moved = moved.map(|(x, shape)| x * (1.0 + shape * increment));
        (state.clone(), moved.collect())
    };
    INCREMENTS.map(step).to_vec()
}

/// The corner temperatures of the entropy form, by inversion of the entropy.
pub(crate) fn corners<L: Law>(law: &L, x0: &[f64], x1: &[f64]) -> Vec<f64> {
    if !L::THERMAL {
        return Vec::new();
    }
    let mechanical = x0.len() - 1;
    let entropy = |x: &[f64]| law.caloric(&array(x)).entropy;
    let corner = |first: &[f64], rest: &[f64], count: usize, s: f64, start: f64| {
        let mut y = [&first[..count], &rest[count..]].concat();
        let evaluate = |theta| {
            y[mechanical] = theta;
            law.caloric(&array(&y))
        };
        invert(evaluate, s, start)
            .expect("the corner exists")
            .temperature
    };
    let ascending = (1..=mechanical).map(|k| corner(x1, x0, k, entropy(x0), x0[mechanical]));
    let descending = (1..=mechanical).map(|k| corner(x0, x1, k, entropy(x1), x1[mechanical]));
    ascending.chain(descending).collect()
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

/// The responses of both forms, the same bits with and without the tangent.
fn responses<L: Law>(law: &L, x0: &[f64], x1: &[f64]) -> [Vec<f64>; 2] {
    let corners = array(&corners(law, x0, x1));
    let (old, new) = (array(x0), array(x1));
    let kept = law.entropy_form_old(&old);
    let entropy = law.entropy_form(&kept, &new, &corners).0;
    let alone = law.entropy_form_response(&kept, &new, &corners);
    assert_eq!(bits(entropy.as_ref()), bits(alone.as_ref()), "entropy form");
    let kept = law.temperature_form_old(&old);
    let temperature = law.temperature_form(&kept, &new).0;
    let alone = law.temperature_form_response(&kept, &new);
    assert_eq!(
        bits(temperature.as_ref()),
        bits(alone.as_ref()),
        "temperature form"
    );
    [entropy.as_ref().to_vec(), temperature.as_ref().to_vec()]
}

/// The first law of a step: f*·Δπ − g*·Δγ + θ* Δs = Δe, in both forms.
pub(crate) fn directionality<L: Law>() {
    let law = L::example();
    for (x0, x1) in steps::<L>() {
        let change = law.internal_energy(&array(&x1)) - law.internal_energy(&array(&x0));
        let size = law.internal_energy(&array(&x1)).abs();
        for response in responses(&law, &x0, &x1) {
            let work = (0..L::MEASURES + L::DASHPOTS).map(|i| {
                let sign = if i < L::MEASURES { 1.0 } else { -1.0 };
                sign * response[i] * (x1[i] - x0[i])
            });
            let heat = if L::THERMAL {
                response[x0.len() - 1] * response[x0.len()]
            } else {
                0.0
            };
            let terms: Vec<f64> = work.chain([heat]).collect();
            let size = size + terms.iter().map(|term| term.abs()).sum::<f64>();
            let defect = terms.iter().sum::<f64>() - change;
            assert!(
                defect.abs() <= ROUNDING * size,
                "{x0:?} → {x1:?}: {defect:e} of {size:e}"
            );
        }
    }
}

/// Gradient, Hessian and the tangents of both forms against central differences.
pub(crate) fn derivatives<L: Law>() {
    let law = L::example();
    for (x0, x1) in steps::<L>() {
        let gradient = |x: &[f64]| law.gradient(&array(x)).as_ref().to_vec();
        let potential = |x: &[f64]| vec![law.free_energy(&array(x))];
        compare(&x1, potential, &[gradient(&x1)]);
        let hessian = law.hessian(&array(&x1)).1;
        compare(&x1, gradient, &rows(hessian.as_ref()));

        let old = law.entropy_form_old(&array(&x0));
        let (_, tangent) = law.entropy_form(&old, &array(&x1), &array(&corners(&law, &x0, &x1)));
        compare(
            &x1,
            |x1| responses(&law, &x0, x1)[0].clone(),
            &rows(tangent.as_ref()),
        );
        let old = law.temperature_form_old(&array(&x0));
        let (_, tangent) = law.temperature_form(&old, &array(&x1));
        compare(
            &x1,
            |x1| responses(&law, &x0, x1)[1].clone(),
            &rows(tangent.as_ref()),
        );
    }
}

fn rows<R: AsRef<[f64]>>(matrix: &[R]) -> Vec<Vec<f64>> {
    matrix.iter().map(|row| row.as_ref().to_vec()).collect()
}

fn compare(x: &[f64], f: impl Fn(&[f64]) -> Vec<f64>, jacobian: &[Vec<f64>]) {
    for j in 0..x.len() {
        let at = |sign: f64| {
            let mut moved = x.to_vec();
            moved[j] *= 1.0 + sign * DIFFERENCE;
            (moved[j], f(&moved))
        };
        let ((right, f_right), (left, f_left)) = (at(1.0), at(-1.0));
        for (i, row) in jacobian.iter().enumerate() {
            let difference = (f_right[i] - f_left[i]) / (right - left);
            // The rounding of f itself is divided by the step.
            let rounding = f64::EPSILON * f_right[i].abs() / (right - left).abs();
            let size = row[j]
                .abs()
                .max(difference.abs())
                .max(f_right[i].abs() / x[j].abs());
            assert!(
                (row[j] - difference).abs() <= DIFFERENCE_ERROR * size + 8.0 * rounding,
                "entry {i}, {j} at {x:?}: {} instead of {difference}",
                row[j],
            );
        }
    }
}

/// Exchanging the two states changes nothing but the sign of Δs: the step is its own inverse.
pub(crate) fn symmetry<L: Law>() {
    let law = L::example();
    for (x0, x1) in steps::<L>() {
        let (forward, backward) = (responses(&law, &x0, &x1), responses(&law, &x1, &x0));
        for (forward, backward) in forward.iter().zip(&backward) {
            for (i, (a, b)) in forward.iter().zip(backward).enumerate() {
                let b = if i > x0.len() - 1 { -b } else { *b };
                assert!(
                    (a - b).abs() <= SYMMETRY * a.abs(),
                    "quantity {i}: {a} and {b}"
                );
            }
        }
    }
}

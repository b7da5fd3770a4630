//! The functions of one state.

use num_dual::Dual;

use crate::dual_numbers::duals::{Sum, array, energy, energy_size, second};
use crate::dual_numbers::formulas::Formula;

/// Each of the two computations rounds a term at most eight times by half an ulp, or half as often
/// by the ulp of an elementary function: together 8 ulp of the sum of |terms|, however much of them
/// remains in the sum.
const ULPS: f64 = 8.0;

/// The state of the example, and others around it.
fn states<F: Formula>() -> Vec<Vec<f64>> {
    // Unequal changes, of both signs.
    let shapes = [1.0, -0.7, 0.9, 0.6];
    let moved = |amount: f64| {
        let pairs = F::state().into_iter().zip(shapes);
        pairs.map(|(x, shape)| x * (1.0 + amount * shape)).collect()
    };
    [-0.2, -0.03, 0.0, 0.07, 0.3].map(moved).to_vec()
}

/// Value, gradient and Hessian.
pub(crate) fn free_energy<F: Formula>() {
    let law = F::example();
    let mut worst = 0.0_f64;
    for x in states::<F>() {
        let point = array(&x);
        let gradient = law.gradient(&point);
        let (same_gradient, hessian) = law.hessian(&point);
        let mut check = |expected: Sum, found: f64, what: &str| {
            let what = format!("{what} at {x:?}");
            worst = worst.max(expected.assert(found, ULPS, &what));
        };
        for (j, row) in hessian.as_ref().iter().enumerate() {
            for (k, &entry) in row.as_ref().iter().enumerate() {
                let [value, slope, curvature] = second(&law, &x, j, k);
                check(value, law.free_energy(&point), "ψ");
                check(slope, gradient.as_ref()[j], &format!("∂ψ/∂x{j}"));
                check(slope, same_gradient.as_ref()[j], &format!("∂ψ/∂x{j}"));
                check(curvature, entry, &format!("∂²ψ/∂x{j}∂x{k}"));
            }
        }
    }
    println!("largest error {worst:.1} ulp of the sum of |terms|");
}

/// Entropy, heat capacity, internal energy.
pub(crate) fn caloric<F: Formula>() {
    let law = F::example();
    for x in states::<F>() {
        let point = array(&x);
        let e = Sum {
            value: energy(&law, &x),
            size: energy_size(&law, &x),
        };
        e.assert(law.internal_energy(&point), ULPS, &format!("e at {x:?}"));
        let caloric = law.caloric(&point);
        if !F::THERMAL {
            let nothing = [caloric.entropy, caloric.heat_capacity];
            assert_eq!(nothing.map(f64::to_bits), [0; 2]);
            continue;
        }
        let index = x.len() - 1;
        let [_, slope, curvature] = second(&law, &x, index, index);
        let what = format!("S at {x:?}");
        slope.scaled(-1.0).assert(caloric.entropy, ULPS, &what);
        let what = format!("C at {x:?}");
        let heat_capacity = curvature.scaled(-x[index]);
        heat_capacity.assert(caloric.heat_capacity, ULPS, &what);
        assert!(
            caloric.magnitude >= caloric.entropy.abs() * (1.0 - f64::EPSILON),
            "{caloric:?} at {x:?}"
        );
    }
}

/// Viscosities; those of models without temperature are not functions.
pub(crate) fn viscosities<F: Formula>() {
    let law = F::example();
    if !F::THERMAL {
        return;
    }
    for x in states::<F>() {
        let theta = *x.last().unwrap();
        let expected = law.viscosities(Dual::from_re(theta).derivative());
        let (eta, slope) = law.viscosity(theta);
        assert_eq!(expected.len(), F::DASHPOTS);
        for (k, expected) in expected.iter().enumerate() {
            let what = format!("η{k} at {theta}");
            Sum::of(expected.re).assert(eta.as_ref()[k], ULPS, &what);
            Sum::of(expected.eps).assert(slope.as_ref()[k], ULPS, &format!("slope of {what}"));
        }
    }
}

//! A small rotation of a body that brings its angular momentum within reach of its momenta.
//!
//! All arms of a body lie in the space of its principal axes with inertia, so that `J = Σ r ∧ p` has no component in
//! planes perpendicular to them: the angular momentum of a single mass is perpendicular to its arm. Truncation and
//! rounding of a step leave the arms slightly off, so that the target has such a component. No change of momenta corrects
//! it, and where the inertia in a plane is weak, the change would be large. A rotation of positions and momenta changes
//! no length, no speed and no energy of the elements. With the target T in the principal axes, rotations by the angles φ
//! from the axes b to the axes a and c of the plane change
//!
//! ```text
//! T_ac  by  −Σ_b (φ_ba T_bc + φ_bc T_ab)
//! ```
//!
//! and the smallest that change it by δ are `φ_ba = δ T_bc/s`, `φ_bc = δ T_ab/s` with `s = Σ_b (T_bc² + T_ab²)`.

use super::{NO_INERTIA, Principal, WEAK};
use crate::algebra::bivector::{Bivector, planes};
use eem_material::number::scalar::Scalar;

/// Rounds of corrections. With a single plane they converge quadratically; several planes are corrected in turn.
const MOST_ROUNDS: usize = 100;

/// The largest angle: a step that needs a larger one does not resolve the motion.
const LARGEST_ANGLE: f64 = 0.1;

/// The axes of a body that is being rotated, and their changes so far.
struct Turned<const D: usize> {
    axes: [[f64; D]; D],
    changes: [[f64; D]; D],
}

impl<const D: usize> Turned<D> {
    /// Rotates axis `from` towards axis `to`.
    fn rotate(&mut self, from: usize, to: usize, angle: f64) {
        let (sine, half) = (Scalar::sin(angle), Scalar::sin(0.5 * angle));
        // 1 − cos, without cancellation.
        let versine = 2.0 * half * half;
        for column in 0..D {
            let [x, y] = [self.axes[from][column], self.axes[to][column]];
            for (axis, by) in [
                (from, sine * y - versine * x),
                (to, -(sine * x + versine * y)),
            ] {
                self.axes[axis][column] += by;
                self.changes[axis][column] += by;
            }
        }
    }

    /// Changes the component of the target in a plane by −`off`, to first order; `None` if that takes a large angle.
    fn approach(&mut self, target: &Bivector<f64, D>, [a, c]: [usize; 2], off: f64) -> Option<()> {
        let (terms, square) = slopes(target, &self.axes, [a, c]);
        for (b, terms) in terms.iter().enumerate() {
            if b == a || b == c {
                continue;
            }
            for (to, term) in [(a, terms[0]), (c, terms[1])] {
                let angle = off * term / square;
                let is_small = angle.abs() < LARGEST_ANGLE;
                if !is_small {
                    return None;
                }
                self.rotate(b, to, angle);
            }
        }
        Some(())
    }
}

/// The matrix W of a rotation `1 + W` of the arms of a body, after which small changes of the momenta give the target
/// of its angular momentum. `None` if that holds to `rounding` without a rotation, or cannot be reached.
#[cold]
pub(in super::super) fn turning<const D: usize>(
    principal: &Principal<D>,
    [present, target]: [&Bivector<f64, D>; 2],
    rounding: f64,
) -> Option<[[f64; D]; D]> {
    let trace = principal.trace();
    let axes = principal.axes;
    let mut turned = Turned {
        axes,
        changes: [[0.0; D]; D],
    };
    // The wanted components of the target in the axes of the body: the present ones, plus as much of the defect as
    // momenta can add.
    let mut goals = Bivector::<Option<f64>, D>::filled(None);
    for [a, c] in planes::<D>() {
        let inertia = principal.moments[a] + principal.moments[c];
        let own = present.between(&axes[a], &axes[c]);
        let missing = target.between(&axes[a], &axes[c]) - own;
        if inertia < WEAK * trace && missing.abs() > rounding {
            let slope = slopes(target, &axes, [a, c]).1;
            let by_momenta = inertia * target.square();
            let share = by_momenta / (by_momenta + trace * slope);
            *goals.at_mut([a, c]) = share.is_finite().then_some(own + share * missing);
        }
    }
    let mut has_turned = false;
    for round in 0..MOST_ROUNDS {
        let mut is_met = true;
        for [a, c] in planes::<D>() {
            let Some(goal) = goals.at([a, c]) else {
                continue;
            };
            // In planes with some inertia, momenta can add the rest.
            let has_none = principal.moments[a] + principal.moments[c] <= NO_INERTIA * trace;
            let off = target.between(&turned.axes[a], &turned.axes[c]) - goal;
            if off.abs() <= rounding || (round > 0 && !has_none) {
                continue;
            }
            turned.approach(target, [a, c], off)?;
            (is_met, has_turned) = (false, true);
        }
        if is_met {
            break;
        }
    }
    let mut change = [[0.0; D]; D];
    for (i, row) in change.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            *entry = (0..D).map(|a| turned.changes[a][i] * axes[a][j]).sum();
        }
    }
    has_turned.then_some(change)
}

/// `[T_bc, T_ab]` for each b, and the sum of their squares.
fn slopes<const D: usize>(
    target: &Bivector<f64, D>,
    axes: &[[f64; D]; D],
    [a, c]: [usize; 2],
) -> ([[f64; 2]; D], f64) {
    let (mut terms, mut square) = ([[0.0; 2]; D], 0.0);
    for b in 0..D {
        if b == a || b == c {
            continue;
        }
        terms[b] = [
            target.between(&axes[b], &axes[c]),
            target.between(&axes[a], &axes[b]),
        ];
        square += terms[b][0] * terms[b][0] + terms[b][1] * terms[b][1];
    }
    (terms, square)
}

#[cfg(test)]
mod tests {
    use super::super::{Inertia, Moments};
    use super::*;
    use crate::algebra::vector;

    /// Masses with one, two or three arms, a target that is a little off, and what is left of it after turning and a
    /// change of momenta.
    fn left<const D: usize>(arms: &[[f64; D]], momenta: &[[f64; D]], off: f64) -> f64 {
        let sum = |arms: &[[f64; D]], momenta: &[[f64; D]]| {
            let mut sum = Bivector::zero();
            for (r, p) in arms.iter().zip(momenta) {
                sum.add(1.0, &Bivector::wedge(r, p));
            }
            sum
        };
        // The target of arms that are elsewhere.
        let shift = |r: &[f64; D], by: f64| {
            vector(|i| r[i] + off * (by + f64::from(u8::try_from(i).unwrap())).sin())
        };
        let pairs = arms.iter().zip([1.0, 3.0, 7.0]);
        let others: Vec<[f64; D]> = pairs.map(|(r, by)| shift(r, by)).collect();
        let target = sum(&others, momenta);
        let moments = |arms: &[[f64; D]]| {
            let mut moments = Moments::none();
            for r in arms {
                moments.add(1.0, r);
            }
            moments
        };
        let change = turning(
            &Principal::of(&moments(arms)),
            [&sum(arms, momenta), &target],
            1e-16,
        );
        let change = change.expect("is off");
        let turn = |r: &[f64; D]| -> [f64; D] {
            vector(|i| r[i] + (0..D).map(|j| change[i][j] * r[j]).sum::<f64>())
        };
        let arms: Vec<[f64; D]> = arms.iter().map(turn).collect();
        let mut momenta: Vec<[f64; D]> = momenta.iter().map(turn).collect();
        for _ in 0..2 {
            let mut missing = target;
            missing.add(-1.0, &sum(&arms, &momenta));
            let omega = Inertia::of_body(moments(&arms)).solve(&missing);
            for (p, r) in momenta.iter_mut().zip(&arms) {
                let change = omega.turn(r);
                *p = vector(|i| p[i] + change[i]);
            }
        }
        let mut missing = target;
        missing.add(-1.0, &sum(&arms, &momenta));
        missing.largest()
    }

    #[test]
    fn a_target_beside_the_reach_of_momenta_is_met() {
        for off in [1e-3, 1e-6, 1e-12] {
            let one = left(&[[1.0, 0.2, -0.4]], &[[0.3, 1.0, 0.5]], off);
            let line = [[1.0, 0.2, -0.4], [-0.5, -0.1, 0.2]];
            let two = left(&line, &[[0.3, 1.0, 0.5], [-0.2, 0.1, 0.8]], off);
            let one_of_four = left(&[[1.0, 0.2, -0.4, 0.3]], &[[0.3, 1.0, 0.5, -0.2]], off);
            let arms = [[1.0, 0.2, -0.4, 0.3], [0.1, -0.7, 0.4, 0.6]];
            let momenta = [[0.3, 1.0, 0.5, -0.2], [-0.4, 0.2, 0.9, 0.1]];
            let two_of_four = left(&arms, &momenta, off);
            for left in [one, two, one_of_four, two_of_four] {
                assert!(left < 4e-16, "{off}: {left}");
            }
        }
    }
}

//! The angular velocity of a body for an angular momentum, for any shape and dimension.
//!
//! The angular momentum of a rigid rotation Ω is
//!
//! ```text
//! J = M Ω + Ω M,     M = Σ m r rᵀ
//! ```
//!
//! In the principal axes of M, with moments μ, it is `J_ab = (μ_a + μ_b) Ω_ab`. Masses on a line have no inertia about
//! the line. In planes without inertia, no change of the momenta of the masses changes J; see [`turning`].

pub(super) mod turning;

use crate::algebra::bivector::{Bivector, planes};
use crate::algebra::jacobi::diagonalize;
use crate::algebra::{dot, hypot, vector};

/// The fraction of the trace of M below which the inertia in a plane is weak: a correction of momenta there would be
/// at least a hundred times as large as in other planes, so that the body is rotated instead.
pub(super) const WEAK: f64 = 1e-4;

/// The fraction below which it is rounding: 64 ε.
const NO_INERTIA: f64 = 1.4e-14;

/// `M = Σ m r rᵀ`, kg m². Only the entries on and above the diagonal are used.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moments<const D: usize>([[f64; D]; D]);

impl<const D: usize> Moments<D> {
    /// Of nothing.
    pub(super) fn none() -> Self {
        Self([[0.0; D]; D])
    }

    /// Adds a mass at the end of an arm.
    #[inline]
    pub(super) fn add(&mut self, mass: f64, r: &[f64; D]) {
        for i in 0..D {
            for j in i..D {
                self.0[i][j] += mass * (r[i] * r[j]);
            }
        }
    }

    #[inline]
    fn trace(&self) -> f64 {
        let mut sum = 0.0;
        for (axis, row) in self.0.iter().enumerate() {
            sum += row[axis];
        }
        sum
    }
}

/// The inertia of a body.
#[derive(Clone, Copy, Debug)]
pub(super) enum Inertia<const D: usize> {
    /// In the plane, or of masses that are all at their centre: `Σ m r²`.
    Single(f64),
    /// One arm by construction, a single mass on an anchor or a free pair: its direction and `Σ m r²`.
    Line { along: [f64; D], moment: f64 },
    /// In space.
    Space(Inverse),
    /// Nearly on a line, or in more than three dimensions.
    Principal(Principal<D>),
}

impl<const D: usize> Inertia<D> {
    /// Of a body with more than one arm.
    pub(super) fn of_body(moments: Moments<D>) -> Self {
        if const { D < 3 } {
            return Self::Single(moments.trace());
        }
        if const { D == 3 }
            && let Some(inverse) = Inverse::of(&moments)
        {
            return Self::Space(inverse);
        }
        Self::Principal(Principal::of(&moments))
    }

    /// Of a body with one arm, given the arm of one of its masses and `Σ m r²`.
    #[inline]
    pub(super) fn of_line(arm: &[f64; D], moment: f64) -> Self {
        if const { D < 3 } {
            return Self::Single(moment);
        }
        let far = hypot(arm);
        let has_length = far > 0.0;
        let along = vector(|axis| if has_length { arm[axis] / far } else { 0.0 });
        Self::Line { along, moment }
    }

    /// The slowest rotation with an angular momentum; none in planes without inertia.
    #[inline]
    pub(super) fn solve(&self, momentum: &Bivector<f64, D>) -> Bivector<f64, D> {
        match self {
            Self::Single(moment) if *moment <= 0.0 => Bivector::zero(),
            Self::Single(moment) => momentum.over(*moment),
            Self::Line { along, moment } => {
                let turning = momentum.turn(along);
                let over = |j: f64| if *moment <= 0.0 { 0.0 } else { j / moment };
                Bivector::wedge(along, &vector(|axis| over(turning[axis])))
            }
            Self::Space(inverse) => inverse.solve(momentum),
            Self::Principal(principal) => principal.solve(momentum),
        }
    }
}

/// The inverse of the inertia tensor `I = tr M − M` of a body in space: its cofactors over its determinant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inverse {
    cofactors: [[f64; 3]; 3],
    determinant: f64,
}

impl Inverse {
    /// `None` if the inertia about an axis is weak.
    fn of<const D: usize>(moments: &Moments<D>) -> Option<Self> {
        let m = &moments.0;
        let [a, b, c] = [m[1][1] + m[2][2], m[0][0] + m[2][2], m[0][0] + m[1][1]];
        let [d, e, f] = [-m[0][1], -m[0][2], -m[1][2]];
        let [xx, yy, zz] = [b * c - f * f, a * c - e * e, a * b - d * d];
        let [xy, xz, yz] = [e * f - d * c, d * f - e * b, d * e - a * f];
        let determinant = a * xx + d * xy + e * xz;
        // About the weakest axis the inertia is nearly the determinant over the sum of principal minors.
        let least = WEAK * moments.trace() * (xx + yy + zz);
        (least < determinant).then_some(Self {
            cofactors: [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]],
            determinant,
        })
    }

    /// The rotation about the axes (1, 2), (2, 0) and (0, 1).
    #[inline]
    fn solve<const D: usize>(&self, momentum: &Bivector<f64, D>) -> Bivector<f64, D> {
        let right = [
            momentum.at([1, 2]),
            -momentum.at([0, 2]),
            momentum.at([0, 1]),
        ];
        let [x, y, z] = vector(|axis| dot(&self.cofactors[axis], &right) / self.determinant);
        let mut rotation = Bivector::zero();
        *rotation.at_mut([1, 2]) = x;
        *rotation.at_mut([0, 2]) = -y;
        *rotation.at_mut([0, 1]) = z;
        rotation
    }
}

/// Principal axes and moments.
#[derive(Clone, Copy, Debug)]
pub(super) struct Principal<const D: usize> {
    /// Unit vectors.
    axes: [[f64; D]; D],
    /// `Σ m r_a²`, not negative, kg m².
    moments: [f64; D],
}

impl<const D: usize> Principal<D> {
    pub(super) fn of(moments: &Moments<D>) -> Self {
        let mut matrix = moments.0;
        for [i, j] in planes::<D>() {
            matrix[j][i] = matrix[i][j];
        }
        let mut axes = [[0.0; D]; D];
        for (axis, row) in axes.iter_mut().enumerate() {
            row[axis] = 1.0;
        }
        diagonalize(D, matrix.as_flattened_mut(), axes.as_flattened_mut());
        // Sums of squares, but rounding may leave −0 or less.
        let moments = vector(|axis| matrix[axis][axis].max(0.0));
        Self { axes, moments }
    }

    fn trace(&self) -> f64 {
        self.moments.iter().sum()
    }

    /// The slowest rotation with an angular momentum, in the planes that have inertia.
    fn solve(&self, momentum: &Bivector<f64, D>) -> Bivector<f64, D> {
        let least = NO_INERTIA * self.trace();
        let mut omega = Bivector::zero();
        for [a, b] in planes::<D>() {
            let inertia = self.moments[a] + self.moments[b];
            if inertia > least {
                let speed = momentum.between(&self.axes[a], &self.axes[b]) / inertia;
                omega.add(speed, &Bivector::wedge(&self.axes[a], &self.axes[b]));
            }
        }
        omega
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::difference;

    /// The angular momentum of masses 1, 2, … that turn, and their moments.
    fn turning<const D: usize>(
        arms: &[[f64; D]],
        omega: &Bivector<f64, D>,
    ) -> (Bivector<f64, D>, Moments<D>) {
        let (mut momentum, mut moments) = (Bivector::zero(), Moments::none());
        for (mass, arm) in (1..).zip(arms) {
            let mass = f64::from(mass);
            momentum.add(mass, &Bivector::wedge(arm, &omega.turn(arm)));
            moments.add(mass, arm);
        }
        (momentum, moments)
    }

    fn spin<const D: usize>() -> Bivector<f64, D> {
        let mut omega = Bivector::zero();
        for (value, plane) in [0.3, -0.7, 1.9, 0.2, 1.1, -0.4]
            .into_iter()
            .zip(planes::<D>())
        {
            *omega.at_mut(plane) = value;
        }
        omega
    }

    #[test]
    fn the_rotation_of_a_body_follows_from_its_angular_momentum() {
        let omega = spin::<3>();
        let arms = [[1.0, 0.2, -0.3], [0.1, 2.0, 0.4], [0.3, -0.5, 1.1]];
        let (momentum, moments) = turning(&arms, &omega);
        let mut off = Inertia::of_body(moments).solve(&momentum);
        off.add(-1.0, &omega);
        assert!(off.largest() < 1e-15, "{off:?}");

        let omega = spin::<4>();
        let arms = [
            [1.0, 0.2, -0.3, 0.5],
            [0.1, 2.0, 0.4, -1.0],
            [0.3, -0.5, 1.1, 0.0],
        ];
        let (momentum, moments) = turning(&arms, &omega);
        let mut off = Inertia::of_body(moments).solve(&momentum);
        off.add(-1.0, &omega);
        assert!(off.largest() < 1e-14, "{off:?}");
    }

    // Also on a diagonal, where rounding leaves no entry zero.
    #[test]
    fn masses_on_a_line_turn_across_it_only() {
        for line in [[1.0, 0.0, 0.0], [0.0, 0.0, 2.0], [0.3, 1.7, -0.9]] {
            let arms = [line, line.map(|x: f64| 2.5 * x)];
            let (momentum, moments) = turning(&arms, &spin::<3>());
            let square = |r: &[f64; 3]| r.iter().map(|x| x * x).sum::<f64>();
            let moment = square(&arms[0]) + 2.0 * square(&arms[1]);
            let both = [Inertia::of_body(moments), Inertia::of_line(&line, moment)];
            let found = both.map(|inertia| inertia.solve(&momentum));
            for omega in &found {
                let (again, _) = turning(&arms, omega);
                let mut off = again;
                off.add(-1.0, &momentum);
                assert!(off.largest() < 1e-14 * momentum.largest(), "{off:?}");
                // The slowest of all that have it: the axis is perpendicular to the line.
                let axis = [omega.at([1, 2]), -omega.at([0, 2]), omega.at([0, 1])];
                let along: f64 = axis.iter().zip(&line).map(|(a, b)| a * b).sum();
                assert!(along.abs() < 1e-13, "{along}");
            }
            let [a, b] = found.map(|omega| omega.turn(&[1.0, 2.0, 3.0]));
            assert!(hypot(&difference(&a, &b)) < 1e-13);
        }
    }
}

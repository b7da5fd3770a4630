//! The temperature of an element at the end of a step, from its stored entropy.

use crate::element::conjugates::{Infeasible, PointRule};
use crate::element::error::StateError;
use crate::element::group::explicit::view::UnkeptEntropy;
use crate::element::group::point::Point;
use crate::element::kinematics::Kinematics;
use eem_material::free_energy::{FreeEnergy, Material, Rates};
use eem_material::inversion::temperature_near;
use eem_material::number::scalar::{Mask, Real, unless};

/// Evaluations after which the safeguarded search takes over. Newton's method from the
/// temperature of the stages needs one or two.
const MOST_EVALUATIONS: usize = 6;

/// The correction of ln θ above which a guess is poor and the safeguarded search takes over.
const LARGEST_CORRECTION: f64 = 0.25;

/// An evaluated entropy may differ from the stored one by this many ε of its terms. Four are promised to the user; two
/// are left for the rounding of the value itself.
const KEPT_ROUNDINGS: f64 = 2.0;

/// The temperature found for an entropy.
pub(super) struct Recovered<S: Real, M: FreeEnergy<S>, T> {
    /// The temperature of the last evaluation, K, and its values.
    pub(super) theta: S,
    pub(super) evaluated: (Rates<M::Variables>, T),
    /// The temperature after the last correction, K.
    pub(super) corrected: S,
    /// `|∂c/∂ ln θ|`, J/K.
    pub(super) bend: S,
}

impl<S: Real, M: FreeEnergy<S>, T> Recovered<S, M, T> {
    /// A temperature that needs no correction, and the values there.
    #[inline]
    pub(super) fn given(theta: S, evaluated: (Rates<M::Variables>, T)) -> Self {
        Self {
            theta,
            evaluated,
            corrected: theta,
            bend: S::zero(),
        }
    }
}

/// Whether the change `δ = Δs/c` of ln θ gives the entropy, with c and `|∂c/∂ ln θ|` given: the remainder of Δs is
/// small,
///
/// ```text
/// ½ |∂c/∂ ln θ| δ²  ≤  ε c/16
/// ```
///
/// a 64th of the bound of [`Law::KeptEntropy`](crate::Law::KeptEntropy), so that several changes may add up. A phase
/// transition of the width w has `|∂c/∂ ln θ| = c θ/w`.
#[inline]
pub(crate) fn is_met<S: Real>(change: S, [capacity, bend]: [S; 2]) -> S::Mask {
    let eighth = S::from_f64(0.125);
    (bend * change * change).at_most(eighth * S::EPSILON * capacity)
}

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, const D: usize> Point<S, M, K, PointRule, D> {
    /// The temperature of an entropy near a guess by Newton's method in ln θ.
    ///
    /// Each lane stops where it would stop alone.
    #[inline]
    pub(super) fn temperature_of<T>(
        &self,
        x: &M::Variables,
        at: &impl Fn(S) -> (Rates<M::Variables>, T),
        [entropy, guess]: [S; 2],
        unkept: &mut Option<UnkeptEntropy>,
    ) -> Result<Recovered<S, M, T>, StateError>
    where
        T: Copy + AsRef<[S]>,
    {
        // √u, whose square is a rounding.
        let enough = (S::from_f64(0.5) * S::EPSILON).sqrt();
        let mut theta = guess;
        let (mut has_converged, mut is_lost) = (S::Mask::none(), S::Mask::none());
        for _ in 0..MOST_EVALUATIONS {
            let (rates, values) = at(theta);
            let capacity = rates.forces[Self::TEMPERATURE];
            let correction = (entropy - values.as_ref()[0]) / capacity;
            let size = correction.abs();
            let is_near = S::zero().less(capacity) & size.at_most(S::from_f64(LARGEST_CORRECTION));
            is_lost = is_lost | !is_near;
            let is_last = size.at_most(enough);
            if is_last.any() {
                let bend = self.bend(x, [theta, capacity]);
                let is_last = is_last & is_met(correction, [capacity, bend]);
                has_converged = (has_converged | is_last) & !is_lost;
                if has_converged.all() {
                    return Ok(Recovered {
                        theta,
                        evaluated: (rates, values),
                        corrected: theta + theta * correction,
                        bend,
                    });
                }
            }
            if (has_converged | is_lost).all() {
                break;
            }
            let next = theta * correction.exp();
            theta = unless(has_converged | is_lost, theta, next);
        }
        self.search(x, at, [entropy, guess], (has_converged, theta), unkept)
    }

    /// `|∂c/∂ ln θ| = |c + θ² ∂²s/∂θ²|`, J/K.
    #[inline]
    fn bend(&self, x: &M::Variables, [theta, capacity]: [S; 2]) -> S {
        let mut x = *x;
        x[Self::TEMPERATURE] = theta;
        let second = self.model.entropy_hessian(&x)[Self::TEMPERATURE][Self::TEMPERATURE];
        (capacity + theta * theta * second).abs()
    }

    /// The same from a poor guess, by the safeguarded search, in the lanes in which Newton's method has not converged.
    /// A temperature that misses the entropy is reported in `unkept`.
    #[cold]
    fn search<T: Copy + AsRef<[S]>>(
        &self,
        x: &M::Variables,
        at: &impl Fn(S) -> (Rates<M::Variables>, T),
        [entropy, guess]: [S; 2],
        (has_converged, recovered): (S::Mask, S),
        unkept: &mut Option<UnkeptEntropy>,
    ) -> Result<Recovered<S, M, T>, StateError> {
        let caloric_at = self.model.caloric_at(*x);
        // ε^¾, as in the implicit schemes.
        let root = S::EPSILON.sqrt();
        let enough = root * root.sqrt();
        let found = temperature_near(|theta| (caloric_at(theta).0, []), entropy, guess, enough);
        let (found, []) = found.map_err(|source| {
            let entropy = entropy.to_f64();
            Infeasible::Entropy { entropy, source }.of(self.element)
        })?;
        let theta = S::select(has_converged, recovered, found);
        let (rates, values) = at(theta);
        let capacity = rates.forces[Self::TEMPERATURE];
        let defect = entropy - values.as_ref()[0];
        let slopes = rates.slopes.as_ref()[..Self::TEMPERATURE].iter();
        let slopes = slopes.zip(x.as_ref());
        let terms = slopes.fold(
            caloric_at(theta).0.magnitude + capacity,
            |sum, (&slope, &x)| sum + (slope * x).abs(),
        );
        let bound = S::from_f64(KEPT_ROUNDINGS) * S::EPSILON * terms;
        let left = unless(has_converged, S::zero(), defect.abs());
        if !left.at_most(bound).all() && unkept.is_none() {
            *unkept = Some(UnkeptEntropy {
                element: self.element,
                sizes: [left.to_f64(), bound.to_f64()],
            });
        }
        let correction = defect / capacity;
        Ok(Recovered {
            theta,
            evaluated: (rates, values),
            corrected: S::select(has_converged, theta + theta * correction, theta),
            bend: self.bend(x, [theta, capacity]),
        })
    }
}

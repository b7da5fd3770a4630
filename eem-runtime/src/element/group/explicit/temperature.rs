//! The temperature of an element at the end of a step, from its stored entropy.

use crate::element::conjugates::Infeasible;
use crate::element::error::StateError;
use crate::element::group::explicit::point::ExplicitPoint;
use crate::element::group::explicit::view::UnkeptEntropy;
use crate::element::kinematics::Kinematics;
use eem_material::free_energy::{FreeEnergy, Material, Rates};
use eem_material::inversion::temperature_near;
use eem_material::number::scalar::Scalar;

/// Evaluations after which the safeguarded search takes over. Newton's method from the
/// temperature of the stages needs one or two.
const MOST_EVALUATIONS: usize = 6;

/// The correction of ln θ above which a guess is poor and the safeguarded search takes over.
const LARGEST_CORRECTION: f64 = 0.25;

/// An evaluated entropy may differ from the stored one by this many ε of its terms. Four are promised to the user; two
/// are left for the rounding of the value itself.
const KEPT_ROUNDINGS: f64 = 2.0;

/// The temperature found for an entropy.
pub(super) struct Recovered<M: FreeEnergy<f64>, T> {
    /// The temperature of the last evaluation, K, and its values.
    pub(super) theta: f64,
    pub(super) evaluated: (Rates<M::Variables>, T),
    /// The temperature after the last correction, K.
    pub(super) corrected: f64,
    /// `|∂c/∂ ln θ|`, J/K.
    pub(super) bend: f64,
}

impl<M: FreeEnergy<f64>, T> Recovered<M, T> {
    /// A temperature that needs no correction, and the values there.
    #[inline]
    pub(super) fn given(theta: f64, evaluated: (Rates<M::Variables>, T)) -> Self {
        Self {
            theta,
            evaluated,
            corrected: theta,
            bend: 0.0,
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
pub(crate) fn is_met(change: f64, [capacity, bend]: [f64; 2]) -> bool {
    bend * change * change <= 0.125 * f64::EPSILON * capacity
}

impl<M: Material, K: Kinematics<D>, const D: usize> ExplicitPoint<M, K, D> {
    /// The temperature of an entropy near a guess by Newton's method in ln θ.
    #[expect(clippy::inline_always, reason = "the logarithms of `at` are shared")]
    #[inline(always)]
    pub(super) fn temperature_of<T>(
        &self,
        x: &M::Variables,
        at: &impl Fn(f64) -> (Rates<M::Variables>, T),
        [entropy, guess]: [f64; 2],
        unkept: &mut Option<UnkeptEntropy>,
    ) -> Result<Recovered<M, T>, StateError>
    where
        T: Copy + AsRef<[f64]>,
    {
        // √u, whose square is a rounding.
        let enough = (0.5 * f64::EPSILON).sqrt();
        let mut theta = guess;
        for _ in 0..MOST_EVALUATIONS {
            let (rates, values) = at(theta);
            let capacity = rates.forces[Self::TEMPERATURE];
            let correction = (entropy - values.as_ref()[0]) / capacity;
            let size = correction.abs();
            if !(capacity > 0.0 && size <= LARGEST_CORRECTION) {
                break;
            }
            if size <= enough {
                let bend = self.bend(x, [theta, capacity]);
                if is_met(correction, [capacity, bend]) {
                    return Ok(Recovered {
                        theta,
                        evaluated: (rates, values),
                        corrected: theta + theta * correction,
                        bend,
                    });
                }
            }
            theta *= Scalar::exp(correction);
        }
        self.search(x, at, [entropy, guess], unkept)
    }

    /// `|∂c/∂ ln θ| = |c + θ² ∂²s/∂θ²|`, J/K.
    #[inline]
    fn bend(&self, x: &M::Variables, [theta, capacity]: [f64; 2]) -> f64 {
        let mut x = *x;
        x[Self::TEMPERATURE] = theta;
        let second = self.model.entropy_hessian(&x)[Self::TEMPERATURE][Self::TEMPERATURE];
        (capacity + theta * theta * second).abs()
    }

    /// The same from a poor guess, by the safeguarded search. A temperature that misses the entropy is reported in
    /// `unkept`.
    #[cold]
    fn search<T: Copy + AsRef<[f64]>>(
        &self,
        x: &M::Variables,
        at: &impl Fn(f64) -> (Rates<M::Variables>, T),
        [entropy, guess]: [f64; 2],
        unkept: &mut Option<UnkeptEntropy>,
    ) -> Result<Recovered<M, T>, StateError> {
        let caloric_at = self.model.caloric_at(*x);
        // ε^¾, as in the implicit schemes.
        let root = f64::EPSILON.sqrt();
        let enough = root * root.sqrt();
        let caloric_at = |theta| (caloric_at(theta).0, []);
        let found = temperature_near((guess, caloric_at(guess)), caloric_at, entropy, enough);
        let (theta, []) =
            found.map_err(|source| Infeasible::Entropy { entropy, source }.of(self.element))?;
        let (rates, values) = at(theta);
        let capacity = rates.forces[Self::TEMPERATURE];
        let left = (entropy - values.as_ref()[0]).abs();
        let slopes = rates.slopes.as_ref()[..Self::TEMPERATURE].iter();
        let slopes = slopes.zip(x.as_ref());
        let terms = slopes.fold(
            caloric_at(theta).0.magnitude + capacity,
            |sum, (&slope, &x)| sum + (slope * x).abs(),
        );
        let bound = KEPT_ROUNDINGS * f64::EPSILON * terms;
        if !(left <= bound) && unkept.is_none() {
            *unkept = Some(UnkeptEntropy {
                element: self.element,
                sizes: [left, bound],
            });
        }
        Ok(Recovered {
            theta,
            evaluated: (rates, values),
            corrected: theta,
            bend: self.bend(x, [theta, capacity]),
        })
    }
}

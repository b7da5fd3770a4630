//! The distance of two nodes.

use core::array;

use crate::element::error::StateError;
use crate::element::handle::Element;
use crate::element::kinematics::measures::{Ends, Kinematics, QuadraticStrain};
use eem_material::free_energy::Entry;
use eem_material::number::scalar::{Mask, Real, Scalar, is_positive};
use eem_mesh::tensor::dot;

/// The stretch `λ = |r|`, `r = q_j − q_i`, of two nodes in `D` dimensions, m.
///
/// It is computed as `√Σr²`, so that `Σr²` must neither underflow nor overflow: λ lies between
/// 1.5·10⁻¹⁵⁴ m and 1.3·10¹⁵⁴ m in double precision, between 1.1·10⁻¹⁹ m and 1.8·10¹⁹ m in single.
///
/// ```text
/// ∂λ/∂r = r/λ,   ∂²λ/∂r² = (1 − n nᵀ)/λ,   n = r/λ
/// D*λ = 2 r_m/(λ⁰ + λ¹),   r_m = ½(r⁰ + r¹)
/// ```
///
/// `λ⁰ + λ¹` is the sum of the end lengths, not `2|r_m|`: only then is
/// `D*λ·(r¹ − r⁰) = (λ¹² − λ⁰²)/(λ⁰ + λ¹) = λ¹ − λ⁰`.
///
/// ```
/// use eem::kinematics::{Kinematics, Stretch};
///
/// let arms = [[3.0, 4.0]];
/// assert_eq!(Stretch::<2>.measure(&arms), [5.0]);
/// assert!(Stretch::<2>.is_admissible(&arms, &[5.0]));
///
/// // Too short for the square.
/// let arms = [[3e-170, 4e-170]];
/// let stretch = Stretch::<2>.measure(&arms);
/// assert!(!Stretch::<2>.is_admissible(&arms, &stretch));
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Stretch<const D: usize>;

/// `t (1 − a bᵀ)`.
#[inline]
fn block<S: Scalar, const D: usize>(t: S, a: [S; D], b: [S; D]) -> [[S; D]; D] {
    let mut block = [[S::zero(); D]; D];
    for row in 0..D {
        let along = t * a[row];
        for column in 0..D {
            block[row][column] = -(along * b[column]);
        }
        block[row][row] += t;
    }
    block
}

impl<S: Real, const D: usize> Kinematics<S, D> for Stretch<D> {
    type PerNode<T: Entry> = [T; 2];
    type PerArm<T: Entry> = [T; 1];
    type PerMeasure<T: Entry> = [T; 1];

    type PerPoint<T: Send + Sync> = [T; 1];

    type Between = ();

    const IS_SPRING: bool = true;
    const VISCOUS_UNIT: &'static str = "m";
    const VISCOSITY_UNIT: &'static str = "N s/m";

    #[inline]
    fn is_admissible(&self, _: &[[S; D]; 1], &[lambda]: &[S; 1]) -> bool {
        let [least, most] = admissible::<S>();
        (least.at_most(lambda) & lambda.at_most(most)).all()
    }

    // The stretch may have under- or overflowed; the message has the correct value.
    #[cold]
    fn refusal(&self, element: Element, [r]: &[[S; D]; 1]) -> StateError {
        let lambda = r
            .iter()
            .fold(S::zero(), |length, &component| length.hypot(component));
        let [least, most] = admissible::<S>().map(Real::to_f64);
        StateError::Stretch {
            element,
            value: lambda.to_f64(),
            least,
            most,
        }
    }

    #[inline]
    fn unit(&self, &[lambda]: &[S; 1]) -> S {
        lambda
    }

    #[inline]
    fn length(&self, &[lambda]: &[S; 1]) -> S {
        lambda
    }

    // ∂λ/∂r·r = λ
    #[inline]
    fn sizes(&self, _: &[[S; D]; 1], &lambda: &[S; 1]) -> [S; 1] {
        lambda
    }

    #[inline]
    fn slopes(&self, _: &[[S; D]; 1], _: &[S; 1]) -> [S; 1] {
        [S::one()]
    }

    fn numbers(&self, _: &mut dyn FnMut(S)) {}

    #[inline]
    fn measure(&self, [r]: &[[S; D]; 1]) -> [S; 1] {
        let square = r
            .iter()
            .fold(S::zero(), |sum, &component| sum + component * component);
        [square.sqrt()]
    }

    #[inline]
    fn gradient(&self, [r]: &[[S; D]; 1], &[lambda]: &[S; 1]) -> [[[S; D]; 1]; 1] {
        [[scaled(r, lambda.recip())]]
    }

    #[inline]
    fn curvature(
        &self,
        [r]: &[[S; D]; 1],
        &[lambda]: &[S; 1],
        &[force]: &[S; 1],
    ) -> [[[[S; D]; D]; 1]; 1] {
        let shrink = lambda.recip();
        let n = scaled(r, shrink);
        [[block(force * shrink, n, n)]]
    }

    #[inline]
    fn between(&self, _: [&[[S; D]; 1]; 2]) {}

    #[inline]
    fn discrete_gradient(&self, ends: &Ends<Self, S, D>) -> [[[S; D]; 1]; 1] {
        [[mean_direction(ends)]]
    }

    // With d = D*λ and t = f/(λ⁰ + λ¹): ∂(f d)/∂r¹ = t (1 − d n¹ᵀ) + d (∂f/∂r¹)ᵀ
    #[inline]
    fn discrete_tangent(
        &self,
        ends: &Ends<Self, S, D>,
        &[force]: &[S; 1],
        [[force_by_arm]]: &[[[S; D]; 1]; 1],
    ) -> [[[[S; D]; D]; 1]; 1] {
        let ([lambda0], [lambda1]) = (ends.measures0, ends.measures1);
        let n1 = scaled(&ends.r1[0], lambda1.recip());
        let direction = mean_direction(ends);
        let tension = force * (lambda0 + lambda1).recip();
        let along = array::from_fn(|axis| force_by_arm[axis] - tension * n1[axis]);
        let mut block = direction.map(|row| scaled(&along, row));
        for (axis, row) in block.iter_mut().enumerate() {
            row[axis] += tension;
        }
        [[block]]
    }

    #[inline]
    fn secant(&self, ends: &Ends<Self, S, D>, &[force]: &[S; 1]) -> [[S; 1]; 1] {
        let ([lambda0], [lambda1]) = (ends.measures0, ends.measures1);
        [[(force + force) / (lambda0 + lambda1)]]
    }
}

// C = λ²
impl<S: Real, const D: usize> QuadraticStrain<S, D> for Stretch<D> {
    type PerStrain<T: Entry> = [T; 1];

    #[inline]
    fn strain(&self, [r]: &[[S; D]; 1]) -> [S; 1] {
        [dot(r, r)]
    }

    #[inline]
    fn strain_rate(&self, [r]: &[[S; D]; 1], [w]: &[[S; D]; 1]) -> [S; 1] {
        let half = dot(r, w);
        [half + half]
    }

    #[inline]
    fn strain_force(&self, [r]: &[[S; D]; 1], &[n]: &[S; 1]) -> [[S; D]; 1] {
        [scaled(r, n + n)]
    }

    #[inline]
    fn strain_force_size(&self, [r]: &[[S; D]; 1], &[n]: &[S; 1]) -> S {
        dot(r, r).sqrt() * (n + n)
    }

    #[inline]
    fn strain_stiffness(&self, &[n]: &[S; 1]) -> [[S; 1]; 1] {
        [[n + n]]
    }

    #[inline]
    fn strain_sizes(&self, &strain: &[S; 1]) -> [S; 1] {
        strain
    }

    #[inline]
    fn strain_metric(&self, &[square]: &[S; 1]) -> ([S; 1], S) {
        ([S::one()], square)
    }

    #[inline]
    fn measures_of(&self, &[square]: &[S; 1]) -> Option<[S; 1]> {
        is_positive(square).then(|| [square.sqrt()])
    }

    #[cold]
    fn refuse(&self, element: Element, &[square]: &[S; 1]) -> StateError {
        StateError::Path {
            element,
            quantity: "squared stretch",
            value: square.to_f64(),
            unit: "m^2",
        }
    }

    #[inline]
    fn strain_slopes(&self, ends: [&[S; 1]; 2]) -> [[S; 1]; 1] {
        let [old, new] = ends.map(|&[square]| square.sqrt());
        [[(old + new).recip()]]
    }

    // ∂²λ/∂C² = −1/4λ³
    #[inline]
    fn strain_curvature(&self, &[square]: &[S; 1], &[force]: &[S; 1]) -> [[S; 1]; 1] {
        let stretch = square.sqrt();
        let shrink = (stretch + stretch).recip();
        [[-(force / stretch) * shrink * shrink]]
    }
}

/// The shortest and the longest stretch, m.
///
/// Below `√MIN_POSITIVE` the square Σr² is subnormal and has lost digits, or is zero; above `√MAX`
/// it is infinite. In between, squares of single components may underflow: that takes at most
/// ε/2 of Σr² per component. Both ends are constants to the compiler.
#[inline]
fn admissible<S: Real>() -> [S; 2] {
    [S::MIN_POSITIVE.sqrt(), S::MAX.sqrt()]
}

/// `2 r_m/(λ⁰ + λ¹)`.
#[inline]
fn mean_direction<S: Real, const D: usize>(ends: &Ends<Stretch<D>, S, D>) -> [S; D] {
    let (r0, r1) = (&ends.r0[0], &ends.r1[0]);
    let shrink = (ends.measures0[0] + ends.measures1[0]).recip();
    array::from_fn(|axis| (r0[axis] + r1[axis]) * shrink)
}

/// `factor r`.
#[inline]
fn scaled<S: Scalar, const D: usize>(r: &[S; D], factor: S) -> [S; D] {
    array::from_fn(|axis| r[axis] * factor)
}

//! The distance of two nodes.

use crate::algebra::vector;
use crate::element::error::StateError;
use crate::element::handle::Element;
use crate::element::kinematics::measures::{
    Ends, Kinematics, Length, QuadraticStrain, StrainMeasures,
};
use eem_material::free_energy::Entry;
use eem_material::number::scalar::{Scalar, is_positive};
use eem_mesh::tensor::dot;

/// The stretch `λ = |r|`, `r = q_j − q_i`, of two nodes in `D` dimensions, m.
///
/// It is computed as `√Σr²`, so that `Σr²` must neither underflow nor overflow: λ lies between
/// 1.5·10⁻¹⁵⁴ m and 1.3·10¹⁵⁴ m.
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
fn block<const D: usize>(t: f64, a: [f64; D], b: [f64; D]) -> [[f64; D]; D] {
    let mut block = [[0.0; D]; D];
    for row in 0..D {
        let along = t * a[row];
        for column in 0..D {
            block[row][column] = -(along * b[column]);
        }
        block[row][row] += t;
    }
    block
}

impl<const D: usize> Kinematics<D> for Stretch<D> {
    type PerNode<T: Entry> = [T; 2];
    type PerArm<T: Entry> = [T; 1];
    type Measures = Length;

    type PerPoint<T: Send + Sync> = [T; 1];

    type Between = ();

    #[inline]
    fn is_admissible(&self, _: &[[f64; D]; 1], &[lambda]: &[f64; 1]) -> bool {
        let [least, most] = admissible();
        least <= lambda && lambda <= most
    }

    // The stretch may have under- or overflowed; the message has the correct value.
    #[cold]
    fn refusal(&self, element: Element, [r]: &[[f64; D]; 1]) -> StateError {
        let lambda = r
            .iter()
            .fold(0.0, |length, &component| Scalar::hypot(length, component));
        let [least, most] = admissible();
        StateError::Stretch {
            element,
            value: lambda,
            least,
            most,
        }
    }

    #[inline]
    fn length(&self, &[lambda]: &[f64; 1]) -> f64 {
        lambda
    }

    // ∂λ/∂r·r = λ
    #[inline]
    fn sizes(&self, _: &[[f64; D]; 1], &lambda: &[f64; 1]) -> [f64; 1] {
        lambda
    }

    #[inline]
    fn slopes(&self, _: &[[f64; D]; 1], _: &[f64; 1]) -> [f64; 1] {
        [1.0]
    }

    fn numbers(&self, _: &mut dyn FnMut(f64)) {}

    #[inline]
    fn measure(&self, [r]: &[[f64; D]; 1]) -> [f64; 1] {
        let square = r
            .iter()
            .fold(0.0, |sum, &component| sum + component * component);
        [square.sqrt()]
    }

    #[inline]
    fn gradient(&self, [r]: &[[f64; D]; 1], &[lambda]: &[f64; 1]) -> [[[f64; D]; 1]; 1] {
        [[scaled(r, lambda.recip())]]
    }

    #[inline]
    fn curvature(
        &self,
        [r]: &[[f64; D]; 1],
        &[lambda]: &[f64; 1],
        &[force]: &[f64; 1],
    ) -> [[[[f64; D]; D]; 1]; 1] {
        let shrink = lambda.recip();
        let n = scaled(r, shrink);
        [[block(force * shrink, n, n)]]
    }

    #[inline]
    fn between(&self, _: [&[[f64; D]; 1]; 2]) {}

    #[inline]
    fn discrete_gradient(&self, ends: &Ends<Self, D>) -> [[[f64; D]; 1]; 1] {
        [[mean_direction(ends)]]
    }

    // With d = D*λ and t = f/(λ⁰ + λ¹): ∂(f d)/∂r¹ = t (1 − d n¹ᵀ) + d (∂f/∂r¹)ᵀ
    #[inline]
    fn discrete_tangent(
        &self,
        ends: &Ends<Self, D>,
        &[force]: &[f64; 1],
        [[force_by_arm]]: &[[[f64; D]; 1]; 1],
    ) -> [[[[f64; D]; D]; 1]; 1] {
        let ([lambda0], [lambda1]) = (ends.measures0, ends.measures1);
        let n1 = scaled(&ends.r1[0], lambda1.recip());
        let direction = mean_direction(ends);
        let tension = force * (lambda0 + lambda1).recip();
        let along = vector(|axis| force_by_arm[axis] - tension * n1[axis]);
        let mut block = direction.map(|row| scaled(&along, row));
        for (axis, row) in block.iter_mut().enumerate() {
            row[axis] += tension;
        }
        [[block]]
    }

    #[inline]
    fn secant(&self, ends: &Ends<Self, D>, &[force]: &[f64; 1]) -> [[f64; 1]; 1] {
        let ([lambda0], [lambda1]) = (ends.measures0, ends.measures1);
        [[(force + force) / (lambda0 + lambda1)]]
    }
}

// C = λ²
impl<const D: usize> QuadraticStrain<D> for Stretch<D> {
    type Strain = Length;

    #[inline]
    fn strain_measures(&self) -> Length {
        Length
    }

    #[inline]
    fn strain(&self, [r]: &[[f64; D]; 1]) -> [f64; 1] {
        [dot(r, r)]
    }

    #[inline]
    fn strain_rate(&self, [r]: &[[f64; D]; 1], [w]: &[[f64; D]; 1]) -> [f64; 1] {
        let half = dot(r, w);
        [half + half]
    }

    #[inline]
    fn strain_force(&self, [r]: &[[f64; D]; 1], &[n]: &[f64; 1]) -> [[f64; D]; 1] {
        [scaled(r, n + n)]
    }

    #[inline]
    fn strain_force_size(&self, [r]: &[[f64; D]; 1], &[n]: &[f64; 1]) -> f64 {
        dot(r, r).sqrt() * (n + n)
    }

    #[inline]
    fn strain_stiffness(&self, &[n]: &[f64; 1]) -> [[f64; 1]; 1] {
        [[n + n]]
    }
}

impl StrainMeasures for Length {
    type Measures = Self;
    type PerStrain<T: Entry> = [T; 1];

    #[inline]
    fn sizes(&self, &strain: &[f64; 1]) -> [f64; 1] {
        strain
    }

    #[inline]
    fn metric(&self, &[square]: &[f64; 1]) -> ([f64; 1], f64) {
        ([1.0], square)
    }

    #[inline]
    fn measures_of(&self, &[square]: &[f64; 1]) -> Option<[f64; 1]> {
        is_positive(square).then(|| [square.sqrt()])
    }

    #[cold]
    fn refuse(&self, element: Element, &[square]: &[f64; 1]) -> StateError {
        StateError::Path {
            element,
            quantity: "squared stretch",
            value: square,
            unit: "m^2",
        }
    }

    #[inline]
    fn slopes(&self, ends: [&[f64; 1]; 2]) -> [[f64; 1]; 1] {
        let [old, new] = ends.map(|&[square]| square.sqrt());
        [[(old + new).recip()]]
    }

    // ∂²λ/∂C² = −1/4λ³
    #[inline]
    fn curvature(&self, &[square]: &[f64; 1], &[force]: &[f64; 1]) -> [[f64; 1]; 1] {
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
fn admissible() -> [f64; 2] {
    [f64::MIN_POSITIVE.sqrt(), f64::MAX.sqrt()]
}

/// `2 r_m/(λ⁰ + λ¹)`.
#[inline]
fn mean_direction<const D: usize>(ends: &Ends<Stretch<D>, D>) -> [f64; D] {
    let (r0, r1) = (&ends.r0[0], &ends.r1[0]);
    let shrink = (ends.measures0[0] + ends.measures1[0]).recip();
    vector(|axis| (r0[axis] + r1[axis]) * shrink)
}

/// `factor r`.
#[inline]
fn scaled<const D: usize>(r: &[f64; D], factor: f64) -> [f64; D] {
    vector(|axis| r[axis] * factor)
}

//! Tensors of the plane and of space.

use eem_material::free_energy::Array;
use eem_material::number::scalar::Real;

/// A tensor, row by row.
pub(super) type Tensor<S, const D: usize> = [[S; D]; D];

/// A symmetric tensor in `D` dimensions. Out of the plane nothing stretches, `F₃₃ = 1`.
pub trait Symmetric<S: Real, const D: usize>: Array<S> {
    /// The unit tensor.
    fn unit() -> Self;

    /// The tensor `b_k` of [`Strain::Component`](super::Strain::Component), as far as it is in these dimensions.
    fn basis(k: usize) -> Self;

    /// `½(FᵀF − 1)`.
    fn green_lagrange(tensor: &[[S; D]; D]) -> Self;

    /// `tr A`.
    fn trace(&self) -> S;

    /// `A:B`.
    fn contracted(&self, other: &Self) -> S;

    /// `A v`.
    fn applied(&self, v: &[S; D]) -> [S; D];

    /// `sym(u ⊗ v)`.
    fn symmetrised(u: &[S; D], v: &[S; D]) -> Self;

    /// `det(1 + 2A) − 1`.
    fn growth(&self) -> S;

    /// `cof(1 + A)`.
    fn cofactor_of_one_plus(&self) -> Self;

    /// D with `D:ΔC = det C¹ − det C⁰`, from `E⁰ + E¹` and `E¹ − E⁰`.
    fn slope_of_determinant(sum: &Self, difference: &Self) -> Self;

    /// The change of D by a change of E¹.
    fn change_of_slope(sum: &Self, difference: &Self, change: &Self) -> Self;

    /// `det F`.
    fn determinant(tensor: &[[S; D]; D]) -> S;

    /// `cof F`.
    fn cofactor(tensor: &[[S; D]; D]) -> [[S; D]; D];
}

/// `a·b`.
#[inline]
pub(super) fn dot<S: Real, const D: usize>(a: &[S; D], b: &[S; D]) -> S {
    let first = a[0] * b[0];
    (1..D).fold(first, |sum, axis| sum + a[axis] * b[axis])
}

/// `F v`.
#[inline]
pub(super) fn pushed<S: Real, const D: usize>(tensor: &Tensor<S, D>, v: &[S; D]) -> [S; D] {
    core::array::from_fn(|axis| dot(&tensor[axis], v))
}

/// `sum += factor tensor`.
#[inline]
pub(super) fn add<S: Real, A: Array<S>>(sum: &mut A, factor: S, tensor: &A) {
    for (sum, &entry) in sum.as_mut().iter_mut().zip(tensor.as_ref()) {
        *sum += factor * entry;
    }
}

/// `factor tensor`.
#[inline]
pub(super) fn scaled<S: Real, A: Array<S>>(factor: S, tensor: &A) -> A {
    let mut scaled = *tensor;
    for entry in scaled.as_mut() {
        *entry = factor * *entry;
    }
    scaled
}

/// `A + factor B`.
#[inline]
pub(super) fn plus<S: Real, A: Array<S>>(a: &A, factor: S, b: &A) -> A {
    let mut sum = *a;
    add(&mut sum, factor, b);
    sum
}

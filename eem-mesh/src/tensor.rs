//! Tensors of the plane and of space.
//!
//! Symmetric tensors are stored as xx, yy, xy and as xx, yy, zz, xy, xz, yz. The discrete gradient D of the determinant,
//!
//! ```text
//! D = cof(C_m) + cof(ΔC)/12,   D:ΔC = det C¹ − det C⁰,   ∂D = ⅓(C⁰ + 2C¹) ⨯ ∂E¹
//! ```
//!
//! with the mean `C_m` of C⁰ and C¹, and with `A ⨯ B` the part of `cof(A + B)` that is linear in both (Bonet, Gil &
//! Ortigosa 2015), is `cof(C_m)` in the plane, where the determinant is quadratic in C.

use core::array;

use eem_material::free_energy::Array;
use eem_material::joint::basis;
use eem_material::number::scalar::Real;

/// A tensor, row by row.
pub type Tensor<S, const D: usize> = [[S; D]; D];

/// A symmetric tensor in `D` dimensions; two are for plane strain, `F₃₃ = 1`.
pub trait Symmetric<S: Real, const D: usize>: Array<S> {
    /// The unit tensor.
    fn unit() -> Self;

    /// The tensor `b_k` of [`basis`], without its components in other dimensions.
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
    #[must_use]
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
pub fn dot<S: Real, const D: usize>(a: &[S; D], b: &[S; D]) -> S {
    let first = a[0] * b[0];
    (1..D).fold(first, |sum, axis| sum + a[axis] * b[axis])
}

/// `F v`.
#[inline]
pub fn pushed<S: Real, const D: usize>(tensor: &Tensor<S, D>, v: &[S; D]) -> [S; D] {
    array::from_fn(|axis| dot(&tensor[axis], v))
}

/// `sum += factor tensor`.
#[inline]
pub fn add<S: Real, A: Array<S>>(sum: &mut A, factor: S, tensor: &A) {
    for (sum, &entry) in sum.as_mut().iter_mut().zip(tensor.as_ref()) {
        *sum += factor * entry;
    }
}

/// `factor tensor`.
#[inline]
pub fn scaled<S: Real, A: Array<S>>(factor: S, tensor: &A) -> A {
    let mut scaled = *tensor;
    for entry in scaled.as_mut() {
        *entry = factor * *entry;
    }
    scaled
}

/// `A + factor B`.
#[inline]
pub fn plus<S: Real, A: Array<S>>(a: &A, factor: S, b: &A) -> A {
    let mut sum = *a;
    add(&mut sum, factor, b);
    sum
}

impl<S: Real> Symmetric<S, 2> for [S; 3] {
    #[inline]
    fn unit() -> Self {
        [S::one(), S::one(), S::zero()]
    }

    #[inline]
    fn basis(k: usize) -> Self {
        let [xx, yy, _, xy, ..] = basis(k);
        [xx, yy, xy]
    }

    #[inline]
    fn green_lagrange([[xx, xy], [yx, yy]]: &[[S; 2]; 2]) -> Self {
        let half = S::from_f64(0.5);
        [
            half * ((*xx * *xx + *yx * *yx) - S::one()),
            half * ((*xy * *xy + *yy * *yy) - S::one()),
            half * (*xx * *xy + *yx * *yy),
        ]
    }

    #[inline]
    fn trace(&self) -> S {
        self[0] + self[1]
    }

    #[inline]
    fn contracted(&self, other: &Self) -> S {
        (self[0] * other[0] + self[1] * other[1]) + S::from_f64(2.0) * (self[2] * other[2])
    }

    #[inline]
    fn applied(&self, v: &[S; 2]) -> [S; 2] {
        let [xx, yy, xy] = *self;
        [xx * v[0] + xy * v[1], xy * v[0] + yy * v[1]]
    }

    #[inline]
    fn symmetrised(u: &[S; 2], v: &[S; 2]) -> Self {
        let shear = S::from_f64(0.5) * (u[0] * v[1] + u[1] * v[0]);
        [u[0] * v[0], u[1] * v[1], shear]
    }

    // det C − 1 = 2 tr E + 4 det E
    #[inline]
    fn growth(&self) -> S {
        let [xx, yy, xy] = *self;
        S::from_f64(2.0) * (xx + yy) + S::from_f64(4.0) * (xx * yy - xy * xy)
    }

    #[inline]
    fn cofactor_of_one_plus(&self) -> Self {
        let [xx, yy, xy] = *self;
        [S::one() + yy, S::one() + xx, -xy]
    }

    #[inline]
    fn slope_of_determinant(sum: &Self, _: &Self) -> Self {
        sum.cofactor_of_one_plus()
    }

    #[inline]
    fn change_of_slope(_: &Self, _: &Self, &[xx, yy, xy]: &Self) -> Self {
        [yy, xx, -xy]
    }

    #[inline]
    fn determinant([[xx, xy], [yx, yy]]: &[[S; 2]; 2]) -> S {
        *xx * *yy - *xy * *yx
    }

    #[inline]
    fn cofactor(&[[xx, xy], [yx, yy]]: &[[S; 2]; 2]) -> [[S; 2]; 2] {
        [[yy, -yx], [-xy, xx]]
    }
}

/// `cof A`.
#[inline]
fn cofactor<S: Real>([xx, yy, zz, xy, xz, yz]: [S; 6]) -> [S; 6] {
    [
        yy * zz - yz * yz,
        xx * zz - xz * xz,
        xx * yy - xy * xy,
        xz * yz - xy * zz,
        xy * yz - xz * yy,
        xy * xz - yz * xx,
    ]
}

/// `A ⨯ B`.
#[inline]
fn crossed<S: Real>(a: &[S; 6], b: &[S; 6]) -> [S; 6] {
    // (A ⨯ B)_ij = A_k B_l + B_k A_l − A_m B_n − B_m A_n
    let of = |[k, l]: [usize; 2], [m, n]: [usize; 2]| {
        (a[k] * b[l] + b[k] * a[l]) - (a[m] * b[n] + b[m] * a[n])
    };
    [
        of([1, 2], [5, 5]),
        of([0, 2], [4, 4]),
        of([0, 1], [3, 3]),
        of([4, 5], [3, 2]),
        of([3, 5], [4, 1]),
        of([3, 4], [5, 0]),
    ]
}

/// `1 ⨯ A = tr A 1 − A`.
#[inline]
fn crossed_with_unit<S: Real>(&[xx, yy, zz, xy, xz, yz]: &[S; 6]) -> [S; 6] {
    [yy + zz, xx + zz, xx + yy, -xy, -xz, -yz]
}

impl<S: Real> Symmetric<S, 3> for [S; 6] {
    #[inline]
    fn unit() -> Self {
        let (one, zero) = (S::one(), S::zero());
        [one, one, one, zero, zero, zero]
    }

    #[inline]
    fn basis(k: usize) -> Self {
        basis(k)
    }

    #[inline]
    fn green_lagrange(tensor: &[[S; 3]; 3]) -> Self {
        let half = S::from_f64(0.5);
        let columns: [[S; 3]; 3] = array::from_fn(|column| tensor.map(|row| row[column]));
        let product = |i: usize, j: usize| dot(&columns[i], &columns[j]);
        let stretched = |i: usize| half * (product(i, i) - S::one());
        [
            stretched(0),
            stretched(1),
            stretched(2),
            half * product(0, 1),
            half * product(0, 2),
            half * product(1, 2),
        ]
    }

    #[inline]
    fn trace(&self) -> S {
        self[0] + self[1] + self[2]
    }

    #[inline]
    fn contracted(&self, other: &Self) -> S {
        let of = |k: usize| self[k] * other[k];
        (of(0) + of(1) + of(2)) + S::from_f64(2.0) * (of(3) + of(4) + of(5))
    }

    #[inline]
    fn applied(&self, v: &[S; 3]) -> [S; 3] {
        let [xx, yy, zz, xy, xz, yz] = *self;
        [
            dot(&[xx, xy, xz], v),
            dot(&[xy, yy, yz], v),
            dot(&[xz, yz, zz], v),
        ]
    }

    #[inline]
    fn symmetrised(u: &[S; 3], v: &[S; 3]) -> Self {
        let shear = |i: usize, j: usize| S::from_f64(0.5) * (u[i] * v[j] + u[j] * v[i]);
        [
            u[0] * v[0],
            u[1] * v[1],
            u[2] * v[2],
            shear(0, 1),
            shear(0, 2),
            shear(1, 2),
        ]
    }

    // det C − 1 = 2 tr E + 4 tr cof E + 8 det E
    #[inline]
    fn growth(&self) -> S {
        let number = S::from_f64;
        let minors = cofactor(*self);
        let determinant = self[0] * minors[0] + (self[3] * minors[3] + self[4] * minors[4]);
        let squares = number(4.0) * minors.trace();
        number(2.0) * self.trace() + (squares + number(8.0) * determinant)
    }

    // cof(1 + A) = 1 + 1 ⨯ A + cof A
    #[inline]
    fn cofactor_of_one_plus(&self) -> Self {
        let linear = crossed_with_unit(self);
        let mut sum = plus(&cofactor(*self), S::one(), &linear);
        add(&mut sum, S::one(), &Self::unit());
        sum
    }

    // ΔC = 2ΔE, so that cof(ΔC)/12 = cof(ΔE)/3.
    #[inline]
    fn slope_of_determinant(sum: &Self, difference: &Self) -> Self {
        let third = S::one() / S::from_f64(3.0);
        plus(&sum.cofactor_of_one_plus(), third, &cofactor(*difference))
    }

    // ⅓(C⁰ + 2C¹) = 1 + (E⁰ + E¹) + ⅓(E¹ − E⁰)
    #[inline]
    fn change_of_slope(sum: &Self, difference: &Self, change: &Self) -> Self {
        let third = S::one() / S::from_f64(3.0);
        let strain = plus(sum, third, difference);
        plus(
            &crossed_with_unit(change),
            S::one(),
            &crossed(&strain, change),
        )
    }

    #[inline]
    fn determinant(tensor: &[[S; 3]; 3]) -> S {
        dot(&tensor[0], &Self::cofactor(tensor)[0])
    }

    #[inline]
    fn cofactor(tensor: &[[S; 3]; 3]) -> [[S; 3]; 3] {
        let of = |i: usize, j: usize| {
            let [k, l] = [(i + 1) % 3, (i + 2) % 3];
            let [m, n] = [(j + 1) % 3, (j + 2) % 3];
            tensor[k][m] * tensor[l][n] - tensor[k][n] * tensor[l][m]
        };
        array::from_fn(|i| array::from_fn(|j| of(i, j)))
    }
}

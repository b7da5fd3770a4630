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

/// A tensor, row by row.
pub type Tensor<const D: usize> = [[f64; D]; D];

/// A symmetric tensor in `D` dimensions; two are for plane strain, `F₃₃ = 1`.
pub trait Symmetric<const D: usize>: Array<f64> {
    /// The unit tensor.
    fn unit() -> Self;

    /// The tensor `b_k` of [`basis`], without its components in other dimensions.
    fn basis(k: usize) -> Self;

    /// `½(FᵀF − 1)`.
    fn green_lagrange(tensor: &[[f64; D]; D]) -> Self;

    /// `tr A`.
    fn trace(&self) -> f64;

    /// `A:B`.
    fn contracted(&self, other: &Self) -> f64;

    /// `A v`.
    fn applied(&self, v: &[f64; D]) -> [f64; D];

    /// `sym(u ⊗ v)`.
    fn symmetrised(u: &[f64; D], v: &[f64; D]) -> Self;

    /// `det(1 + 2A) − 1`.
    fn growth(&self) -> f64;

    /// `cof(1 + A)`.
    #[must_use]
    fn cofactor_of_one_plus(&self) -> Self;

    /// D with `D:ΔC = det C¹ − det C⁰`, from `E⁰ + E¹` and `E¹ − E⁰`.
    fn slope_of_determinant(sum: &Self, difference: &Self) -> Self;

    /// The change of D by a change of E¹.
    fn change_of_slope(sum: &Self, difference: &Self, change: &Self) -> Self;

    /// `det F`.
    fn determinant(tensor: &[[f64; D]; D]) -> f64;

    /// `cof F`.
    fn cofactor(tensor: &[[f64; D]; D]) -> [[f64; D]; D];
}

/// `a·b`.
#[inline]
#[must_use]
pub fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    let first = a[0] * b[0];
    (1..D).fold(first, |sum, axis| sum + a[axis] * b[axis])
}

/// `F v`.
#[inline]
#[must_use]
pub fn pushed<const D: usize>(tensor: &Tensor<D>, v: &[f64; D]) -> [f64; D] {
    array::from_fn(|axis| dot(&tensor[axis], v))
}

/// `sum += factor tensor`.
#[inline]
pub fn add<A: Array<f64>>(sum: &mut A, factor: f64, tensor: &A) {
    for (sum, &entry) in sum.as_mut().iter_mut().zip(tensor.as_ref()) {
        *sum += factor * entry;
    }
}

/// `factor tensor`.
#[inline]
pub fn scaled<A: Array<f64>>(factor: f64, tensor: &A) -> A {
    let mut scaled = *tensor;
    for entry in scaled.as_mut() {
        *entry *= factor;
    }
    scaled
}

/// `A + factor B`.
#[inline]
pub fn plus<A: Array<f64>>(a: &A, factor: f64, b: &A) -> A {
    let mut sum = *a;
    add(&mut sum, factor, b);
    sum
}

impl Symmetric<2> for [f64; 3] {
    #[inline]
    fn unit() -> Self {
        [1.0, 1.0, 0.0]
    }

    #[inline]
    fn basis(k: usize) -> Self {
        let [xx, yy, _, xy, ..] = basis(k);
        [xx, yy, xy]
    }

    #[inline]
    fn green_lagrange([[xx, xy], [yx, yy]]: &[[f64; 2]; 2]) -> Self {
        [
            0.5 * ((*xx * *xx + *yx * *yx) - 1.0),
            0.5 * ((*xy * *xy + *yy * *yy) - 1.0),
            0.5 * (*xx * *xy + *yx * *yy),
        ]
    }

    #[inline]
    fn trace(&self) -> f64 {
        self[0] + self[1]
    }

    #[inline]
    fn contracted(&self, other: &Self) -> f64 {
        (self[0] * other[0] + self[1] * other[1]) + 2.0 * (self[2] * other[2])
    }

    #[inline]
    fn applied(&self, v: &[f64; 2]) -> [f64; 2] {
        let [xx, yy, xy] = *self;
        [xx * v[0] + xy * v[1], xy * v[0] + yy * v[1]]
    }

    #[inline]
    fn symmetrised(u: &[f64; 2], v: &[f64; 2]) -> Self {
        let shear = 0.5 * (u[0] * v[1] + u[1] * v[0]);
        [u[0] * v[0], u[1] * v[1], shear]
    }

    // det C − 1 = 2 tr E + 4 det E
    #[inline]
    fn growth(&self) -> f64 {
        let [xx, yy, xy] = *self;
        2.0 * (xx + yy) + 4.0 * (xx * yy - xy * xy)
    }

    #[inline]
    fn cofactor_of_one_plus(&self) -> Self {
        let [xx, yy, xy] = *self;
        [1.0 + yy, 1.0 + xx, -xy]
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
    fn determinant([[xx, xy], [yx, yy]]: &[[f64; 2]; 2]) -> f64 {
        *xx * *yy - *xy * *yx
    }

    #[inline]
    fn cofactor(&[[xx, xy], [yx, yy]]: &[[f64; 2]; 2]) -> [[f64; 2]; 2] {
        [[yy, -yx], [-xy, xx]]
    }
}

/// `cof A`.
#[inline]
fn cofactor([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> [f64; 6] {
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
fn crossed(a: &[f64; 6], b: &[f64; 6]) -> [f64; 6] {
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
fn crossed_with_unit(&[xx, yy, zz, xy, xz, yz]: &[f64; 6]) -> [f64; 6] {
    [yy + zz, xx + zz, xx + yy, -xy, -xz, -yz]
}

impl Symmetric<3> for [f64; 6] {
    #[inline]
    fn unit() -> Self {
        [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]
    }

    #[inline]
    fn basis(k: usize) -> Self {
        basis(k)
    }

    #[inline]
    fn green_lagrange(tensor: &[[f64; 3]; 3]) -> Self {
        let columns: [[f64; 3]; 3] = array::from_fn(|column| tensor.map(|row| row[column]));
        let product = |i: usize, j: usize| dot(&columns[i], &columns[j]);
        let stretched = |i: usize| 0.5 * (product(i, i) - 1.0);
        [
            stretched(0),
            stretched(1),
            stretched(2),
            0.5 * product(0, 1),
            0.5 * product(0, 2),
            0.5 * product(1, 2),
        ]
    }

    #[inline]
    fn trace(&self) -> f64 {
        self[0] + self[1] + self[2]
    }

    #[inline]
    fn contracted(&self, other: &Self) -> f64 {
        let of = |k: usize| self[k] * other[k];
        (of(0) + of(1) + of(2)) + 2.0 * (of(3) + of(4) + of(5))
    }

    #[inline]
    fn applied(&self, v: &[f64; 3]) -> [f64; 3] {
        let [xx, yy, zz, xy, xz, yz] = *self;
        [
            dot(&[xx, xy, xz], v),
            dot(&[xy, yy, yz], v),
            dot(&[xz, yz, zz], v),
        ]
    }

    #[inline]
    fn symmetrised(u: &[f64; 3], v: &[f64; 3]) -> Self {
        let shear = |i: usize, j: usize| 0.5 * (u[i] * v[j] + u[j] * v[i]);
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
    fn growth(&self) -> f64 {
        let minors = cofactor(*self);
        let determinant = self[0] * minors[0] + (self[3] * minors[3] + self[4] * minors[4]);
        let squares = 4.0 * minors.trace();
        2.0 * self.trace() + (squares + 8.0 * determinant)
    }

    // cof(1 + A) = 1 + 1 ⨯ A + cof A
    #[inline]
    fn cofactor_of_one_plus(&self) -> Self {
        let linear = crossed_with_unit(self);
        let mut sum = plus(&cofactor(*self), 1.0, &linear);
        add(&mut sum, 1.0, &Self::unit());
        sum
    }

    // ΔC = 2ΔE, so that cof(ΔC)/12 = cof(ΔE)/3.
    #[inline]
    fn slope_of_determinant(sum: &Self, difference: &Self) -> Self {
        let third = 1.0 / 3.0;
        plus(&sum.cofactor_of_one_plus(), third, &cofactor(*difference))
    }

    // ⅓(C⁰ + 2C¹) = 1 + (E⁰ + E¹) + ⅓(E¹ − E⁰)
    #[inline]
    fn change_of_slope(sum: &Self, difference: &Self, change: &Self) -> Self {
        let third = 1.0 / 3.0;
        let strain = plus(sum, third, difference);
        plus(&crossed_with_unit(change), 1.0, &crossed(&strain, change))
    }

    #[inline]
    fn determinant(tensor: &[[f64; 3]; 3]) -> f64 {
        dot(&tensor[0], &Self::cofactor(tensor)[0])
    }

    #[inline]
    fn cofactor(tensor: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
        let of = |i: usize, j: usize| {
            let [k, l] = [(i + 1) % 3, (i + 2) % 3];
            let [m, n] = [(j + 1) % 3, (j + 2) % 3];
            tensor[k][m] * tensor[l][n] - tensor[k][n] * tensor[l][m]
        };
        array::from_fn(|i| array::from_fn(|j| of(i, j)))
    }
}

//! Joint invariants of a strain and a viscous strain, from their components.
//!
//! ```text
//! m1 = tr Γ,   m2 = Γ:Γ,   m3 = E:Γ
//! Δm3 = Γ_m:ΔE + E_m:ΔΓ,   Δm2 = 2 Γ_m:ΔΓ,   Δm1 = 1:ΔΓ        exactly
//! ```
//!
//! Symmetric tensors are given by their components `A:b_k` along six tensors of length one, each at a right
//! angle to the others, so that `A:B = Σ (A:b_k)(B:b_k)`. The first five have no trace, the last is `1/√3`
//! times the unit tensor: deviatoric and volumetric flow are flows of different components.

use core::array;
use core::f64::consts::FRAC_1_SQRT_2;

/// Components of a symmetric tensor of space.
pub const COMPONENTS: usize = 6;

/// Components of a symmetric tensor without trace, the first of all.
pub const DEVIATORIC: usize = 5;

/// An invariant of the viscous strain Γ, or of E and Γ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joint {
    /// `tr Γ`; role `ViscousTrace`.
    Trace,
    /// `Γ:Γ`; role `ViscousSquare`.
    Square,
    /// `E:Γ`; role `ViscousStrain`.
    Strain,
}

/// A free energy of joint invariants, which are the last of its measures. Its last viscosities are those of the
/// deviatoric flow and, with a trace, of the volumetric flow.
///
/// `#[derive(FreeEnergy)]` implements it where an argument of the formula has the role `ViscousStrain`.
///
/// ```
/// use eem::{FreeEnergy, Joint, JointEnergy};
///
/// #[derive(Clone, FreeEnergy)]
/// #[free_energy(|e2: StrainSquare, m3: ViscousStrain, m2: ViscousSquare| 3.0 * (e2 - 2 * m3 + m2))]
/// #[viscosity(m3 = 5.0)]
/// struct Fluid;
///
/// assert_eq!(Fluid::JOINT, [Joint::Strain, Joint::Square]);
/// assert_eq!(<Fluid as FreeEnergy<f64>>::MEASURES, 3);
/// ```
pub trait JointEnergy {
    /// The invariants, in the order of the arguments. The type determines their number and whether the trace is among
    /// them; which they are may be known only at run time, see [`joints`](Self::joints).
    const JOINT: &'static [Joint];

    /// [`JOINT`](Self::JOINT), unless the invariants are known only at run time.
    #[inline]
    fn joints(&self) -> &[Joint] {
        Self::JOINT
    }
}

/// `1/√3`.
const THIRD_ROOT: f64 = 0.577_350_269_189_625_8;
/// `1/√6`.
const SIXTH_ROOT: f64 = 0.408_248_290_463_863;

/// `b_k` as `[xx, yy, zz, xy, xz, yz]`.
#[must_use]
pub fn basis(k: usize) -> [f64; COMPONENTS] {
    let [half, third, sixth] = [FRAC_1_SQRT_2, THIRD_ROOT, SIXTH_ROOT];
    match k {
        0 => [half, -half, 0.0, 0.0, 0.0, 0.0],
        1 => [sixth, sixth, -(sixth + sixth), 0.0, 0.0, 0.0],
        2 => [0.0, 0.0, 0.0, half, 0.0, 0.0],
        3 => [0.0, 0.0, 0.0, 0.0, half, 0.0],
        4 => [0.0, 0.0, 0.0, 0.0, 0.0, half],
        _ => [third, third, third, 0.0, 0.0, 0.0],
    }
}

/// `A:b_k` of a tensor.
#[must_use]
pub fn components(tensor: &[[f64; 3]; 3]) -> [f64; COMPONENTS] {
    array::from_fn(|k| {
        let [xx, yy, zz, xy, xz, yz] = basis(k);
        let along = |axis: usize, b: f64| b * tensor[axis][axis];
        // Twice the mean of both.
        let across = |i: usize, j: usize, b: f64| (b + b) * (0.5 * (tensor[i][j] + tensor[j][i]));
        (along(0, xx) + along(1, yy) + along(2, zz))
            + (across(0, 1, xy) + across(0, 2, xz) + across(1, 2, yz))
    })
}

/// `Σ A_k b_k`.
#[must_use]
pub fn tensor(components: &[f64]) -> [[f64; 3]; 3] {
    let mut sum = [0.0; COMPONENTS];
    for (k, &component) in components.iter().enumerate() {
        for (sum, entry) in sum.iter_mut().zip(basis(k)) {
            *sum += component * entry;
        }
    }
    let [xx, yy, zz, xy, xz, yz] = sum;
    [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
}

/// Components of E and Γ.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tensors {
    pub(super) strain: [f64; COMPONENTS],
    pub(super) viscous: [f64; COMPONENTS],
}

impl Tensors {
    /// Tensors with these components; the others are zero.
    pub(super) fn new(strain: &[f64], viscous: &[f64]) -> Self {
        let all = |some: &[f64]| {
            let mut all = [0.0; COMPONENTS];
            all[..some.len()].copy_from_slice(some);
            all
        };
        Self {
            strain: all(strain),
            viscous: all(viscous),
        }
    }

    /// The mean of two states.
    pub(super) fn mean(&self, other: &Self) -> Self {
        let mean =
            |a: &[f64; COMPONENTS], b: &[f64; COMPONENTS]| array::from_fn(|k| 0.5 * (a[k] + b[k]));
        Self {
            strain: mean(&self.strain, &other.strain),
            viscous: mean(&self.viscous, &other.viscous),
        }
    }

    /// The value of an invariant.
    pub(super) fn value(&self, joint: Joint) -> f64 {
        match joint {
            Joint::Trace => TRACE * self.viscous[DEVIATORIC],
            Joint::Square => dot(&self.viscous, &self.viscous),
            Joint::Strain => dot(&self.strain, &self.viscous),
        }
    }

    /// The sum of the absolute values of the terms of an invariant.
    pub(super) fn size(&self, joint: Joint) -> f64 {
        let sizes = |components: &[f64; COMPONENTS]| components.map(f64::abs);
        match joint {
            Joint::Trace => self.value(joint).abs(),
            Joint::Square => self.value(joint),
            Joint::Strain => dot(&sizes(&self.strain), &sizes(&self.viscous)),
        }
    }

    /// `∂m/∂E` along `b_k`; for a mean of two states the discrete gradient between them.
    pub(super) fn by_strain(&self, joint: Joint, k: usize) -> f64 {
        match joint {
            Joint::Trace | Joint::Square => 0.0,
            Joint::Strain => self.viscous[k],
        }
    }

    /// `∂m/∂Γ` along `b_k`; for a mean of two states the discrete gradient between them.
    pub(super) fn by_viscous(&self, joint: Joint, k: usize) -> f64 {
        match joint {
            Joint::Trace if k == DEVIATORIC => TRACE,
            Joint::Trace => 0.0,
            Joint::Square => self.viscous[k] + self.viscous[k],
            Joint::Strain => self.strain[k],
        }
    }
}

/// The trace of the last `b_k`, `√3`.
const TRACE: f64 = 1.732_050_807_568_877_2;

fn dot(a: &[f64; COMPONENTS], b: &[f64; COMPONENTS]) -> f64 {
    (1..COMPONENTS).fold(a[0] * b[0], |sum, k| sum + a[k] * b[k])
}

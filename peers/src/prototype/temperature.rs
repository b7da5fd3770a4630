//! The temperature form of the case `log`, its discrete derivatives from a computer algebra system.
//!
//! The unknowns of a step are x = (q₁, θ₁), 8 numbers, and with r of a spring between its ends
//!
//! ```text
//! 2m/h (q₁ − q₀) − 2p₀ − h F = 0,     F = ∓ φ (r₀ + r₁) at the ends of each spring
//! s₁ − s₀ − hκ (θ*_other/θ* − 1) = 0  for each spring
//! p₁ = 2m/h (q₁ − q₀) − p₀
//! θ* = D_θ e/D_θ s,   φ = D e − θ* D s,   D_θ and D: quotients in θ and in λ², averaged over the other argument
//! ```
//!
//! Newton's method with the exact, dense Jacobian. Plain quotients: no digits are left where λ or θ hardly changes,
//! for which the library has other formulas.

mod conjugates;
mod elimination;

use core::array;

use conjugates::conjugates;
use elimination::solve;

use crate::double_pendulum::LOG;
use crate::systems::State;

/// Newton's method ends with a change below this, relative to 1 + |x|.
const LAST_CHANGE: f64 = 1e-10;
const MOST_ITERATIONS: u32 = 30;
/// First guess of the relative change of θ: quotients need one.
const WARMING: f64 = 1e-6;

/// Values, and their derivatives with respect to λ₁ and θ₁.
#[derive(Clone, Copy, Debug)]
struct Conjugates {
    /// φ, N/m.
    factor: [f64; 3],
    /// θ*, K.
    theta: [f64; 3],
    /// s₁ − s₀, J/K.
    entropy: [f64; 3],
}

/// A spring in a step.
struct Spring {
    conjugates: Conjugates,
    /// r₀ + r₁, m.
    sum: [f64; 3],
    /// ∂λ₁/∂r₁.
    direction: [f64; 3],
}

/// The pendulum in motion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TemperatureRun {
    /// q₁ and q₂, m, then θ, K.
    x: [f64; 8],
    /// kg m/s.
    momenta: [f64; 6],
}

impl TemperatureRun {
    pub(crate) fn new() -> Self {
        let [[x1, y1, z1], [x2, y2, z2]] = LOG.positions;
        let [near, far] = LOG.temperatures;
        let mut momenta = [0.0; 6];
        momenta.copy_from_slice(LOG.momenta.as_flattened());
        Self {
            x: [x1, y1, z1, x2, y2, z2, near, far],
            momenta,
        }
    }

    /// A step of size h; nothing, and no step, if Newton's method does not converge.
    pub(crate) fn step(&mut self, h: f64) -> Option<()> {
        let mut x: [f64; 8] = array::from_fn(|i| match i {
            0..6 => self.x[i] + h * self.momenta[i] / LOG.masses[i / 3],
            _ => self.x[i] * (1.0 + WARMING),
        });
        for _ in 0..MOST_ITERATIONS {
            let (residual, jacobian) = self.equations(h, &x);
            let change = solve(jacobian, residual);
            let mut largest = 0.0_f64;
            for (x, change) in x.iter_mut().zip(change) {
                *x -= change;
                largest = largest.max(change.abs() / (1.0 + x.abs()));
            }
            if largest < LAST_CHANGE {
                for (i, momentum) in self.momenta.iter_mut().enumerate() {
                    *momentum = 2.0 * LOG.masses[i / 3] / h * (x[i] - self.x[i]) - *momentum;
                }
                self.x = x;
                return Some(());
            }
        }
        None
    }

    /// Residual and Jacobian.
    #[inline(always)]
    fn equations(&self, h: f64, x: &[f64; 8]) -> ([f64; 8], [[f64; 8]; 8]) {
        let springs = [0, 1].map(|i| self.spring(i, x));
        let mut residual = [0.0; 8];
        let mut jacobian = [[0.0; 8]; 8];
        for i in 0..6 {
            let inertia = 2.0 * LOG.masses[i / 3] / h;
            residual[i] = inertia * (x[i] - self.x[i]) - 2.0 * self.momenta[i];
            jacobian[i][i] = inertia;
        }
        for (i, spring) in springs.iter().enumerate() {
            spring.add_force(i, h, &mut residual, &mut jacobian);
        }
        for i in 0..2 {
            add_heat(i, h, &springs, &mut residual, &mut jacobian);
        }
        (residual, jacobian)
    }

    #[inline(always)]
    fn spring(&self, i: usize, x: &[f64; 8]) -> Spring {
        let (before, after) = (arm(&self.x, i), arm(x, i));
        let [from, to] = [before, after].map(|[x, y, z]| (x * x + y * y + z * z).sqrt());
        Spring {
            conjugates: conjugates(&LOG.springs[i], [from, self.x[6 + i]], [to, x[6 + i]]),
            sum: array::from_fn(|d| before[d] + after[d]),
            direction: after.map(|component| component / to),
        }
    }

    /// q, p and θ.
    pub(crate) fn state(&self) -> State {
        State {
            positions: self.x[..6].to_vec(),
            momenta: self.momenta.to_vec(),
            temperatures: self.x[6..].to_vec(),
            viscous: Vec::new(),
        }
    }
}

impl Spring {
    /// Adds h φ (r₀ + r₁) to the rows of the masses: with + at the end of the spring, − at its beginning.
    #[inline(always)]
    fn add_force(&self, i: usize, h: f64, residual: &mut [f64; 8], jacobian: &mut [[f64; 8]; 8]) {
        let [factor, by_lambda, by_theta] = self.conjugates.factor;
        for row in 0..3 {
            let force = h * factor * self.sum[row];
            let warming = h * by_theta * self.sum[row];
            let mut stiffness = self.direction.map(|n| h * by_lambda * self.sum[row] * n);
            stiffness[row] += h * factor;
            let end = 3 * i + row;
            residual[end] += force;
            jacobian[end][6 + i] += warming;
            for (d, stiffness) in stiffness.into_iter().enumerate() {
                jacobian[end][3 * i + d] += stiffness;
            }
            if i > 0 {
                let beginning = end - 3;
                residual[beginning] -= force;
                jacobian[beginning][6 + i] -= warming;
                for (d, stiffness) in stiffness.into_iter().enumerate() {
                    let (there, here) = (3 * i + d, 3 * (i - 1) + d);
                    jacobian[beginning][there] -= stiffness;
                    jacobian[beginning][here] += stiffness;
                    jacobian[end][here] -= stiffness;
                }
            }
        }
    }
}

/// Adds s₁ − s₀ − hκ (θ*_other/θ* − 1) to the row of spring i.
#[inline(always)]
fn add_heat(
    i: usize,
    h: f64,
    springs: &[Spring; 2],
    residual: &mut [f64; 8],
    jacobian: &mut [[f64; 8]; 8],
) {
    let [own, other] = [i, 1 - i].map(|i| springs[i].conjugates);
    let conducted = h * LOG.conductance / own.theta[0];
    let ratio = other.theta[0] / own.theta[0];
    residual[6 + i] = own.entropy[0] - conducted * (other.theta[0] - own.theta[0]);
    for by in 1..3 {
        let mut derivatives = [0.0; 2];
        derivatives[i] = own.entropy[by] + conducted * ratio * own.theta[by];
        derivatives[1 - i] = -conducted * other.theta[by];
        for (k, derivative) in derivatives.into_iter().enumerate() {
            if by == 2 {
                jacobian[6 + i][6 + k] += derivative;
                continue;
            }
            for (d, n) in springs[k].direction.into_iter().enumerate() {
                jacobian[6 + i][3 * k + d] += derivative * n;
                if k > 0 {
                    jacobian[6 + i][3 * (k - 1) + d] -= derivative * n;
                }
            }
        }
    }
}

/// r of spring i, m.
#[inline(always)]
fn arm(x: &[f64; 8], i: usize) -> [f64; 3] {
    array::from_fn(|d| {
        if i == 0 {
            x[d]
        } else {
            x[3 * i + d] - x[3 * (i - 1) + d]
        }
    })
}

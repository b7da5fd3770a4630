//! One step of the published pendulum in temperature form, written out by hand for one scene or
//! for one scene per lane: all lanes iterate until the last of them has converged.
//!
//! ```text
//! q¹ − q⁰ = h/2m (p⁰ + p¹),   p¹ − p⁰ = −h f* (q⁰ + q¹)/(λ⁰ + λ¹)
//! γ¹ − γ⁰ = h g*/η(θ*),       θ* Δs = h (g*²/η(θ*) + κ (θr − θ*))
//! ```

use eem::__private::Scalar;
use eem::FreeEnergy;

use super::Bundle;
use eem_testkit::scenes::ThermoViscoElastic;

/// The published step, s, mass, kg, conductance, W/K, and temperature of the surroundings, K.
const STEP: f64 = 0.2;
const MASS: f64 = 1.0;
const CONDUCTANCE: f64 = 10.0;
const SURROUNDINGS: f64 = 300.0;

/// The last update, relative to length and temperature: its square is below rounding.
const TOLERANCE: f64 = 1e-8;
const MAX_ITERATIONS: usize = 50;

const LAW: ThermoViscoElastic = ThermoViscoElastic::PENDULUM;

/// The law on numbers of one kind, the sizes of its arrays known.
pub(crate) trait Law<S: Scalar>:
    FreeEnergy<S, Variables = [S; 3], Response = [S; 4], Tangent = [[S; 3]; 4], Viscosities = [S; 1]>
{
}

impl<S: Scalar, M> Law<S> for M where
    M: FreeEnergy<
            S,
            Variables = [S; 3],
            Response = [S; 4],
            Tangent = [[S; 3]; 4],
            Viscosities = [S; 1],
        >
{
}

/// What a step changes.
#[derive(Clone, Copy)]
pub(crate) struct State<S> {
    q: [S; 2],
    p: [S; 2],
    gamma: S,
    pub(crate) theta: S,
}

impl<S: Bundle> State<S> {
    /// The published start, at other speeds (m/s).
    pub(crate) fn start(speed: S) -> Self {
        let zero = S::zero();
        Self {
            q: [S::from_f64(3.0), zero],
            p: [zero, S::from_f64(MASS) * speed],
            gamma: zero,
            theta: S::from_f64(380.0),
        }
    }

    /// One step; the number of iterations.
    pub(crate) fn step(&mut self) -> usize
    where
        ThermoViscoElastic: Law<S>,
    {
        let (h, m) = (S::from_f64(STEP), S::from_f64(MASS));
        let length = norm(self.q[0], self.q[1]);
        let old = LAW.temperature_form_old(&[length, self.gamma, self.theta]);
        let flight = |axis: usize| self.q[axis] + h * self.p[axis] / m;
        let mut x = [flight(0), flight(1), self.gamma, self.theta];
        for iteration in 1..=MAX_ITERATIONS {
            let new_length = norm(x[0], x[1]);
            let (response, tangent) = LAW.temperature_form(&old, &[new_length, x[2], x[3]]);
            let lengths = [length, new_length];
            let (mut residual, mut matrix) = self.momentum(&x, lengths, &response, &tangent);
            self.rates(
                &x,
                new_length,
                &response,
                &tangent,
                (&mut residual, &mut matrix),
            );
            let update = solve(matrix, residual);
            for (x, update) in x.iter_mut().zip(update) {
                *x -= update;
            }
            let moved = update[0].abs().maximum(update[1].abs());
            let stretched = moved.maximum(update[2].abs()) / new_length;
            let size = stretched.maximum((update[3] / x[3]).abs());
            if size.all_below(TOLERANCE) {
                self.close(&x);
                return iteration;
            }
        }
        panic!("not converged")
    }

    /// The balance of momentum, and its rows of the tangent.
    fn momentum(
        &self,
        x: &[S; 4],
        [length, new_length]: [S; 2],
        &[force, ..]: &[S; 4],
        tangent: &[[S; 3]; 4],
    ) -> ([S; 4], [[S; 4]; 4]) {
        let h = S::from_f64(STEP);
        let inertia = S::from_f64(2.0 * MASS / STEP);
        let shorter = (length + new_length).recip();
        let mean = [0, 1].map(|axis| (self.q[axis] + x[axis]) * shorter);
        let normal = [x[0] / new_length, x[1] / new_length];
        let (mut residual, mut matrix) = ([S::zero(); 4], [[S::zero(); 4]; 4]);
        for i in 0..2 {
            let flight = inertia * (x[i] - self.q[i]) - S::from_f64(2.0) * self.p[i];
            residual[i] = flight + h * force * mean[i];
            for j in 0..2 {
                let by_length = (tangent[0][0] - force * shorter) * mean[i];
                matrix[i][j] = h * by_length * normal[j];
            }
            matrix[i][i] += inertia + h * force * shorter;
            matrix[i][2] = h * tangent[0][1] * mean[i];
            matrix[i][3] = h * tangent[0][2] * mean[i];
        }
        (residual, matrix)
    }

    /// The rates of viscous stretch and heat, and their rows of the tangent.
    fn rates(
        &self,
        x: &[S; 4],
        new_length: S,
        &[_, g, theta, entropy]: &[S; 4],
        tangent: &[[S; 3]; 4],
        (residual, matrix): (&mut [S; 4], &mut [[S; 4]; 4]),
    ) {
        let (h, kappa) = (S::from_f64(STEP), S::from_f64(CONDUCTANCE));
        let ([eta], [eta_slope]) = LAW.viscosity(theta);
        let rate = g / eta;
        let slope = rate * eta_slope / eta;
        let cooling = kappa * (S::from_f64(SURROUNDINGS) - theta);
        residual[2] = x[2] - self.gamma - h * rate;
        residual[3] = theta * entropy - h * (g * rate + cooling);
        for k in 0..3 {
            let [dg, dtheta, dentropy] = [tangent[1][k], tangent[2][k], tangent[3][k]];
            let drate = dg / eta - slope * dtheta;
            let dheat = dg * rate + g * drate - kappa * dtheta;
            let rows = [-h * drate, dtheta * entropy + theta * dentropy - h * dheat];
            for (row, value) in [2, 3].into_iter().zip(rows) {
                if k == 0 {
                    matrix[row][0] = value * x[0] / new_length;
                    matrix[row][1] = value * x[1] / new_length;
                } else {
                    matrix[row][k + 1] = value;
                }
            }
        }
        matrix[2][2] += S::one();
    }

    /// The new state.
    fn close(&mut self, x: &[S; 4]) {
        let inertia = S::from_f64(2.0 * MASS / STEP);
        for (axis, &new) in x[..2].iter().enumerate() {
            self.p[axis] = inertia * (new - self.q[axis]) - self.p[axis];
            self.q[axis] = new;
        }
        [self.gamma, self.theta] = [x[2], x[3]];
    }
}

/// `√(x² + y²)`: without the library's care for lengths that over- or underflow when squared.
fn norm<S: Scalar>(x: S, y: S) -> S {
    (x * x + y * y).sqrt()
}

/// Elimination from the last unknown on; heat and creep dominate their rows.
fn solve<S: Scalar>(mut matrix: [[S; 4]; 4], mut right: [S; 4]) -> [S; 4] {
    for pivot in (1..4).rev() {
        let (row, last) = (matrix[pivot], right[pivot]);
        let inverse = row[pivot].recip();
        for i in 0..pivot {
            let factor = matrix[i][pivot] * inverse;
            for j in 0..pivot {
                matrix[i][j] -= factor * row[j];
            }
            right[i] -= factor * last;
        }
    }
    let mut solution = [S::zero(); 4];
    for i in 0..4 {
        let mut sum = right[i];
        for j in 0..i {
            sum -= matrix[i][j] * solution[j];
        }
        solution[i] = sum / matrix[i][i];
    }
    solution
}

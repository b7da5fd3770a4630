//! The cases as systems of ordinary differential equations, each in entropy and in temperature variables.
//!
//! ```text
//! q̇ = p/m,   ṗ = ∓f n,   γ̇ = g/η,   Q = g γ̇ + Σ κ (θ_b − θ)
//! entropy variables:      ṡ = Q/θ,   θ from s by a warm Newton inversion
//! temperature variables:  θ̇ = (Q − θ s_λ λ̇ − θ s_γ γ̇)/c,   λ̇ = n·(v_b − v_a)
//! ```

mod double;
mod single;

use crate::springs::Number;

pub(crate) use double::Double;
pub(crate) use single::Single;

/// What stands for the heat of a spring among the unknowns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Variables {
    /// s, J/K.
    Entropy,
    /// θ, K.
    Temperature,
}

impl Variables {
    /// Both.
    pub(crate) const ALL: [Self; 2] = [Self::Entropy, Self::Temperature];

    /// The name in tables and pictures.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Entropy => "entropy",
            Self::Temperature => "temperature",
        }
    }
}

/// The temperatures found last, K; the single pendulum has one.
pub(crate) type Warm = [f64; 2];

/// `N` ordinary differential equations `ẏ = rates(y)`.
pub(crate) trait System<const N: usize> {
    /// y at t = 0.
    fn start(&self) -> [f64; N];

    /// Where the first inversion begins, K.
    fn warm(&self) -> Warm;

    /// ẏ.
    fn rates<R: Number>(&self, y: &[R; N], warm: &mut Warm) -> [R; N];

    /// E, J.
    fn energy(&self, y: &[f64; N]) -> f64;

    /// S, J/K.
    #[cfg(test)]
    fn entropy(&self, y: &[f64; N]) -> f64;

    /// f of the springs, N.
    #[cfg(test)]
    fn forces(&self, y: &[f64; N]) -> Vec<f64>;

    /// q, p, γ and θ.
    fn state(&self, y: &[f64; N]) -> State;

    /// The sizes that errors of the unknowns are measured by: |q|₂ of the start for q and γ, `momentum`,
    /// kg m/s, for p, θ of the start for θ, and for entropies the heat capacity.
    fn sizes(&self, momentum: f64) -> [f64; N];
}

/// A state, whatever variables it was computed in.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct State {
    /// Components of all q, m.
    pub(crate) positions: Vec<f64>,
    /// Components of all p, kg m/s.
    pub(crate) momenta: Vec<f64>,
    /// K.
    pub(crate) temperatures: Vec<f64>,
    /// m.
    pub(crate) viscous: Vec<f64>,
}

impl State {
    /// How far it is from `exact`: max |Δq|/|q|₂, max |Δp|/|p|₂ and max |Δθ|/θ.
    pub(crate) fn errors(&self, exact: &Self) -> [f64; 3] {
        let share = |values: &[f64], exact: &[f64]| {
            let changes = values
                .iter()
                .zip(exact)
                .map(|(value, exact)| (value - exact).abs());
            changes.fold(0.0, larger) / norm(exact)
        };
        let pairs = self.temperatures.iter().zip(&exact.temperatures);
        let shares = pairs.map(|(value, exact)| (value - exact).abs() / exact);
        [
            share(&self.positions, &exact.positions),
            share(&self.momenta, &exact.momenta),
            shares.fold(0.0, larger),
        ]
    }
}

/// |v|₂.
pub(crate) fn norm(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum::<f64>().sqrt()
}

/// The larger of two numbers, NaN if one of them is.
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

//! The temperature θ̂ for a given entropy, from a guess near it: its accuracy, and the energy evaluated with it.
//!
//! The inversion itself is [`temperature_near`].

use crate::element::conjugates::element::Infeasible;
use crate::element::state::Energy;
use eem_material::free_energy::{Caloric, FreeEnergy};
use eem_material::inversion::temperature_near;
use eem_material::number::scalar::Real;

/// The largest correction of ln θ, in units of √ε, after which the entropy need not be evaluated
/// again. Newton's method in ln θ leaves half the square of the correction, times the slope
/// of ln C over ln θ: ε/32 for C ∝ θ. The last factor, 1 + x in place of eˣ, leaves as much.
pub(super) const LAST_CORRECTION: f64 = 0.25;

/// θ̂ at the configuration of `x`, whose own temperature does not matter; its heat capacity is positive.
#[inline]
pub(crate) fn temperature_at<S: Real, M: FreeEnergy<S>>(
    model: &M,
    x: M::Variables,
    entropy: S,
    guess: S,
) -> Result<S, Infeasible> {
    temperature_of(&model.caloric_at(x), entropy, guess)
}

/// The same, given the caloric quantities as functions of the temperature.
#[inline]
pub(crate) fn temperature_of<S: Real>(
    caloric_at: &impl Fn(S) -> (Caloric<S>, S),
    entropy: S,
    guess: S,
) -> Result<S, Infeasible> {
    let enough = S::from_f64(LAST_CORRECTION) * S::EPSILON.sqrt();
    let found = near(|theta| (caloric_at(theta).0, []), entropy, guess, enough)?;
    Ok(found.0)
}

/// Temperature and energies of a new state, from its entropy.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Recovered<S> {
    /// θ̂, K.
    pub(crate) temperature: S,
    /// ψ, J.
    pub(crate) free_energy: S,
    /// `ψ + θ s`, J.
    pub(crate) energy: Energy<S>,
}

/// θ̂ and the energies of a state that is stored. The last correction of ln θ is at most ε^¾: the error left, half
/// its square times d ln C/d ln θ, is far below a rounding of the entropy. `ψ + θ s` is stationary in θ
/// at fixed s, so that it may be that of the last temperature that was tried.
#[inline]
pub(crate) fn recovered_at<S: Real>(
    mut energy_at: impl FnMut(S) -> (Caloric<S>, S),
    entropy: S,
    guess: S,
) -> Result<Recovered<S>, Infeasible> {
    let root = S::EPSILON.sqrt();
    let with_energy = |theta: S| {
        let (caloric, psi) = energy_at(theta);
        let of_energy = [psi, theta, caloric.heat_capacity, caloric.magnitude];
        (caloric, of_energy)
    };
    let (temperature, [psi, theta, heat_capacity, magnitude]) =
        near(with_energy, entropy, guess, root * root.sqrt())?;
    let caloric = Caloric {
        entropy,
        heat_capacity,
        magnitude,
    };
    Ok(Recovered {
        temperature,
        free_energy: psi,
        energy: Energy::new(psi, [theta, entropy], &caloric),
    })
}

/// θ̂, and what else was evaluated at the last temperature that was tried.
#[inline]
fn near<S: Real, const W: usize>(
    caloric_at: impl FnMut(S) -> (Caloric<S>, [S; W]),
    entropy: S,
    guess: S,
    enough: S,
) -> Result<(S, [S; W]), Infeasible> {
    temperature_near(caloric_at, entropy, guess, enough).map_err(|source| Infeasible::Entropy {
        entropy: entropy.to_f64(),
        source,
    })
}

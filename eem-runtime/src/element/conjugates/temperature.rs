//! The temperature θ̂ for a given entropy, from a guess near it: its accuracy, and the energy evaluated with it.
//!
//! The inversion itself is [`temperature_near`].

use crate::element::conjugates::infeasible::Infeasible;
use crate::element::state::Energy;
use eem_material::arrays::Arrays;
use eem_material::free_energy::Caloric;
use eem_material::inversion::temperature_near;
use eem_material::tabled::Tabled;

/// The largest correction of ln θ, in units of √ε, after which the entropy need not be evaluated
/// again. Newton's method in ln θ leaves half the square of the correction, times the slope
/// of ln C over ln θ: ε/32 for C ∝ θ. The last factor, 1 + x in place of eˣ, leaves as much.
pub(super) const LAST_CORRECTION: f64 = 0.25;

/// θ̂ at the configuration of `x`, whose own temperature does not matter; its heat capacity is positive.
#[inline]
pub(crate) fn temperature_at<A: Arrays>(
    model: &Tabled<A>,
    x: A::Variables,
    entropy: f64,
    guess: f64,
) -> Result<f64, Infeasible> {
    let found = model.temperature_of(&x, [entropy, guess, enough()]);
    found.map_err(|source| Infeasible::Entropy { entropy, source })
}

/// The same, given the caloric quantities as functions of the temperature.
#[inline]
pub(crate) fn temperature_of(
    caloric_at: &impl Fn(f64) -> (Caloric<f64>, f64),
    entropy: f64,
    guess: f64,
) -> Result<f64, Infeasible> {
    let caloric_at = |theta| (caloric_at(theta).0, []);
    let found = near((guess, caloric_at(guess)), caloric_at, entropy, enough())?;
    Ok(found.0)
}

/// The largest last correction of ln θ.
#[inline]
fn enough() -> f64 {
    LAST_CORRECTION * f64::EPSILON.sqrt()
}

/// Temperature and energies of a new state, from its entropy.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Recovered {
    /// θ̂, K.
    pub(crate) temperature: f64,
    /// ψ, J.
    pub(crate) free_energy: f64,
    /// `ψ + θ s`, J.
    pub(crate) energy: Energy,
}

/// θ̂ and the energies of a state that is stored, from a guess at which they are given. The last correction of ln θ is at most ε^¾: the error left, half
/// its square times d ln C/d ln θ, is far below a rounding of the entropy. `ψ + θ s` is stationary in θ
/// at fixed s, so that it may be that of the last temperature that was tried.
#[expect(
    clippy::inline_always,
    reason = "a call costs 0.3 % of a step of a spring"
)]
#[inline(always)]
pub(crate) fn recovered_at(
    (guess, at_guess): (f64, (Caloric<f64>, f64)),
    energy_at: impl Fn(f64) -> (Caloric<f64>, f64),
    entropy: f64,
) -> Result<Recovered, Infeasible> {
    let root = f64::EPSILON.sqrt();
    let of_energy = |theta: f64, (caloric, psi): (Caloric<f64>, f64)| {
        let of_energy = [psi, theta, caloric.heat_capacity, caloric.magnitude];
        (caloric, of_energy)
    };
    let start = (guess, of_energy(guess, at_guess));
    let with_energy = |theta| of_energy(theta, energy_at(theta));
    let (temperature, [psi, theta, heat_capacity, magnitude]) =
        near(start, with_energy, entropy, root * root.sqrt())?;
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
fn near<const W: usize>(
    start: (f64, (Caloric<f64>, [f64; W])),
    caloric_at: impl FnMut(f64) -> (Caloric<f64>, [f64; W]),
    entropy: f64,
    enough: f64,
) -> Result<(f64, [f64; W]), Infeasible> {
    temperature_near(start, caloric_at, entropy, enough)
        .map_err(|source| Infeasible::Entropy { entropy, source })
}

//! A saved state: everything that the next steps depend on, bit for bit.

mod error;
mod outline;
#[cfg(feature = "serde")]
mod scheme_name;

use crate::compensated::{Compensated, Sum};
use crate::newton::NewtonSettings;
use crate::scalar::Real;
use crate::scene::is_positive;
use crate::scheme::Scheme;
use crate::solver::SavedPast;
use crate::state::State;

pub use error::RestoreError;
pub(crate) use outline::Outline;

/// A state of a [`Simulation`](crate::Simulation) to go on from later: values, what rounding took
/// from them, time, step size and Newton settings.
///
/// A run that is resumed from a checkpoint has the same bits as one that was never interrupted. The
/// scene itself is not part of it: models, masses, conductances and loads come from the
/// program that builds the scene again. Functions of time must then depend on nothing else.
///
/// With the feature `serde` it can be written to a file and read back. The text must give back
/// every bit of a float; for `serde_json` that is its feature `float_roundtrip`.
///
/// ```
/// use eem_runtime::{Scene, Scheme, Simulation};
///
/// let build = |scheme, step| {
///     let mut scene = Scene::<2>::new();
///     scene.anchor([0.0, 0.0]);
///     Simulation::new(scene, scheme, step)
/// };
/// let mut run = build(Scheme::EemEntropy, 0.1)?;
/// run.step()?;
/// let saved = run.checkpoint();
///
/// let mut later = build(saved.scheme(), 1.0)?;
/// later.restore(&saved)?;
/// later.step()?;
/// assert_eq!((later.time(), later.step_size()), (0.2, 0.1));
///
/// let mut other = build(Scheme::Midpoint, 0.1)?;
/// assert!(other.restore(&saved).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub struct Checkpoint<S = f64> {
    #[cfg_attr(feature = "serde", serde(with = "scheme_name"))]
    pub(crate) scheme: Scheme,
    pub(crate) outline: Outline,
    pub(crate) step: S,
    pub(crate) newton: NewtonSettings<S>,
    pub(crate) state: State<S>,
    pub(crate) past: SavedPast<S>,
}

impl<S: Copy> Checkpoint<S> {
    /// The scheme of the saved simulation.
    #[must_use]
    pub const fn scheme(&self) -> Scheme {
        self.scheme
    }

    /// The step size of the saved simulation, s.
    #[must_use]
    pub const fn step_size(&self) -> S {
        self.step
    }
}

impl<S: Real> Checkpoint<S> {
    /// An error unless it is one of a simulation of this scheme, outline, state and past.
    pub(crate) fn check(
        &self,
        scheme: Scheme,
        outline: &Outline,
        state: &State<S>,
        past: &SavedPast<S>,
    ) -> Result<(), RestoreError> {
        if self.scheme != scheme {
            return Err(RestoreError::Scheme {
                checkpoint: self.scheme,
                simulation: scheme,
            });
        }
        self.outline.compare(outline)?;
        let (own, other) = (sums(&self.state), sums(state));
        for ((quantity, own), (_, other)) in own.into_iter().zip(other) {
            expect_count(quantity, own.values().len(), other.values().len())?;
            let numbers = own.sums().flat_map(|(value, carry)| [value, carry]);
            expect_all("finite", quantity, numbers, Real::is_finite)?;
        }
        for (own, other) in self.past.forces.iter().zip(&past.forces) {
            expect_count("forces", own.len(), other.len())?;
            expect_all("finite", "forces", own.iter().copied(), Real::is_finite)?;
        }
        let errors = self.past.errors.into_iter();
        expect_all("finite", "forces", errors, Real::is_finite)?;
        for (quantity, sum) in single_sums(&self.state) {
            expect_all(
                "finite",
                quantity,
                [sum.value, sum.carry].into_iter(),
                Real::is_finite,
            )?;
        }
        let (own, other) = (&self.state.temperatures, &state.temperatures);
        expect_count("temperatures", own.len(), other.len())?;
        let positive = "positive and finite";
        expect_all(positive, "temperatures", own.iter().copied(), is_positive)?;
        expect_all(positive, "step size", [self.step].into_iter(), is_positive)
    }
}

/// All lists of sums of a state with their names.
fn sums<S>(state: &State<S>) -> [(&'static str, &Compensated<S>); 5] {
    [
        ("coordinates", &state.positions),
        ("momenta", &state.momenta),
        ("viscous stretches", &state.viscous),
        ("entropies", &state.entropies),
        ("reservoir entropies", &state.reservoir_entropies),
    ]
}

/// All single sums of a state with their names. The pattern makes a new one impossible to forget.
fn single_sums<S: Copy>(state: &State<S>) -> [(&'static str, Sum<S>); 5] {
    let State {
        time,
        positions: _,
        momenta: _,
        viscous: _,
        entropies: _,
        temperatures: _,
        energies: _,
        reservoir_entropies: _,
        work,
        heat,
        thermostat_entropy,
        dissipated,
    } = state;
    [
        ("time", *time),
        ("work", *work),
        ("heat", *heat),
        ("thermostat entropy", *thermostat_entropy),
        ("lost heat", *dissipated),
    ]
}

fn expect_count(
    quantity: &'static str,
    checkpoint: usize,
    simulation: usize,
) -> Result<(), RestoreError> {
    if checkpoint == simulation {
        return Ok(());
    }
    Err(RestoreError::Count {
        quantity,
        checkpoint,
        simulation,
    })
}

fn expect_all<S: Real>(
    required: &'static str,
    quantity: &'static str,
    mut values: impl Iterator<Item = S>,
    is_met: fn(S) -> bool,
) -> Result<(), RestoreError> {
    match values.find(|&value| !is_met(value)) {
        None => Ok(()),
        Some(value) => Err(RestoreError::Value {
            quantity,
            value: value.to_f64(),
            required,
        }),
    }
}

//! A saved state: everything that the next steps depend on, bit for bit.

mod choice;
mod control;
pub(crate) mod error;
mod expect;
mod numbers;
mod outline;
#[cfg(feature = "serde")]
mod scheme_name;
mod seals;

use crate::element::state::State;
use crate::step::explicit::SavedExplicit;
use crate::step::newton::NewtonSettings;
use crate::step::scheme::Scheme;
use crate::step::solver::SavedPast;
use eem_material::number::compensated::{Compensated, Sum};
use eem_material::number::scalar::{Mask, Real, is_positive};

pub(crate) use choice::SavedChoice;
pub(crate) use control::SavedControl;
pub use error::RestoreError;
use expect::{expect_all, expect_count};
pub(crate) use numbers::Numbers;
pub(crate) use outline::Outline;
use seals::Sealed;
pub(crate) use seals::Seals;

/// A saved state of a [`Simulation`](crate::Simulation), to resume it later: values with their compensated rounding,
/// time, step size and settings.
///
/// A resumed run has the same bits as one that was never interrupted. The scene is not part of the checkpoint: your
/// program builds it again, with the same materials, masses, conductances and loads. Functions of time must depend on
/// the time only. Digests of all numbers of the scene detect another scene.
///
/// A checkpoint may come from an edited file. [`restore`](crate::Simulation::restore) rejects states that no run can
/// have: entropies that do not match the temperatures, anchors in wrong places, compensations larger than rounding.
/// Work and heat, the history of step control and the rates of the explicit scheme cannot be edited
/// ([`RestoreError::Edited`]).
///
/// With the feature `serde` it can be written to a file and read back. The format must preserve every bit of a
/// number; `serde_json` does with its feature `float_roundtrip`.
///
/// ```
/// use eem::{Scene, Scheme, Simulation};
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
    pub(crate) numbers: Numbers,
    pub(crate) step: S,
    pub(crate) newton: NewtonSettings<S>,
    /// None while all steps have one size.
    #[cfg_attr(feature = "serde", serde(default = "Option::default"))]
    pub(crate) control: Option<SavedControl<S>>,
    /// Of a scheme that is chosen on the way.
    #[cfg_attr(
        feature = "serde",
        serde(default = "Option::default", skip_serializing_if = "Option::is_none")
    )]
    pub(crate) choice: Option<SavedChoice>,
    pub(crate) state: State<S>,
    pub(crate) past: SavedPast<S>,
    /// Of an explicit scheme; without it, its targets are those of the state.
    #[cfg_attr(
        feature = "serde",
        serde(default = "Option::default", skip_serializing_if = "Option::is_none")
    )]
    pub(crate) explicit: Option<SavedExplicit<S>>,
    pub(crate) seals: Seals,
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
    /// An error unless it is one of a simulation of this scheme, outline, numbers, state and past.
    ///
    /// What it says of elements and anchors is still to be compared with the scene.
    pub(crate) fn check(
        &self,
        scheme: Scheme,
        scene: (&Outline, &Numbers),
        state: &State<S>,
        (past, explicit): (&SavedPast<S>, Option<&SavedExplicit<S>>),
    ) -> Result<(), RestoreError> {
        if self.scheme != scheme {
            return Err(RestoreError::Scheme {
                checkpoint: self.scheme,
                simulation: scheme,
            });
        }
        let (outline, numbers) = scene;
        self.outline.compare(outline)?;
        self.numbers.compare(numbers)?;
        let (own, other) = (sums(&self.state), sums(state));
        for ((quantity, own), (_, other)) in own.into_iter().zip(other) {
            expect_count(quantity, own.values().len(), other.values().len())?;
            check_sums(quantity, own.sums())?;
        }
        for (quantity, Sum { value, carry }) in single_sums(&self.state) {
            check_sums(quantity, [(value, carry)].into_iter())?;
        }
        let time = [self.state.time.value].into_iter();
        expect_all("not negative", "time", time, |time| {
            S::zero().at_most(time).all()
        })?;
        let (own, other) = (&self.state.temperatures, &state.temperatures);
        expect_count("temperatures", own.len(), other.len())?;
        let positive = "positive and finite";
        expect_all(positive, "temperatures", own.iter().copied(), is_positive)?;
        expect_all(positive, "step size", [self.step].into_iter(), is_positive)?;
        if let Some(control) = &self.control {
            let sizes = control.sizes();
            expect_all(
                positive,
                "step size",
                sizes.into_iter().flatten(),
                is_positive,
            )?;
            expect_all("not negative", "step control", control.others(), |value| {
                (S::zero().at_most(value) & value.at_most(S::MAX)).all()
            })?;
        }
        if let Some(saved) = &self.choice {
            let numbers = saved.choice.numbers().map(S::from_f64);
            expect_all("not negative", "choice of a scheme", numbers, |value| {
                (S::zero().at_most(value) & value.at_most(S::MAX)).all()
            })?;
        }
        self.check_past(past)?;
        if let (Some(own), Some(other)) = (&self.explicit, explicit) {
            check_explicit(own, other)?;
        }
        self.seals.check(self.sealed())
    }

    /// The same with digests of what follows from the steps.
    pub(crate) fn sealed_up(self) -> Self {
        let seals = Seals::of(self.sealed());
        Self { seals, ..self }
    }

    /// What follows from the steps.
    fn sealed(&self) -> Sealed<'_, S> {
        Sealed {
            state: &self.state,
            past: &self.past,
            control: self.control.as_ref(),
            choice: self.choice.as_ref(),
            explicit: self.explicit.as_ref(),
        }
    }

    /// Errors of forecasts are sums of squares, which may overflow: then nothing is foretold.
    fn check_past(&self, past: &SavedPast<S>) -> Result<(), RestoreError> {
        for (own, other) in self.past.forces.iter().zip(&past.forces) {
            expect_count("forces", own.len(), other.len())?;
            expect_all("finite", "forces", own.iter().copied(), Real::is_finite)?;
        }
        let errors = self.past.errors.into_iter();
        let quantity = "errors of foretold forces";
        expect_all("not negative", quantity, errors, |error| {
            S::zero().at_most(error).all()
        })
    }
}

/// What an explicit scheme has saved is of the same scene, and finite.
fn check_explicit<S: Real>(
    own: &SavedExplicit<S>,
    other: &SavedExplicit<S>,
) -> Result<(), RestoreError> {
    for ((quantity, own), (_, other)) in own.sums().into_iter().zip(other.sums()) {
        expect_count(quantity, own.len(), other.len())?;
        check_sums(quantity, own.iter().map(|sum| (sum.value, sum.carry)))?;
    }
    for ((quantity, own), (_, other)) in own.lists().into_iter().zip(other.lists()) {
        expect_count(quantity, own.len(), other.len())?;
        expect_all("finite", quantity, own.iter().copied(), Real::is_finite)?;
    }
    let momentum = [own.largest_momentum].into_iter();
    expect_all("not negative", "the largest momentum", momentum, |value| {
        S::zero().at_most(value).all()
    })
}

/// All lists of sums of a state with their names.
fn sums<S>(state: &State<S>) -> [(&'static str, &Compensated<S>); 6] {
    [
        ("coordinates", &state.positions),
        ("momenta", &state.momenta),
        ("velocities", &state.velocities),
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
        velocities: _,
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

/// Sums as additions leave them: finite, and what is still missing of them not more than rounding
/// took from the last addition.
///
/// `TwoSum` leaves at most half a unit in the last place of the value v, which is at most ½ε|v|. Sums
/// so small that this underflows are exact, as is zero: nothing is missing of them.
fn check_sums<S: Real>(
    quantity: &'static str,
    mut sums: impl Iterator<Item = (S, S)> + Clone,
) -> Result<(), RestoreError> {
    let numbers = sums.clone().flat_map(|(value, carry)| [value, carry]);
    expect_all("finite", quantity, numbers, Real::is_finite)?;
    let half = S::from_f64(0.5) * S::EPSILON;
    let is_rest = |value: S, carry: S| carry.abs().at_most(half * value.abs()).all();
    match sums.find(|&(value, carry)| !is_rest(value, carry)) {
        None => Ok(()),
        Some((value, carry)) => Err(RestoreError::Carry {
            quantity,
            value: value.to_f64(),
            carry: carry.to_f64(),
        }),
    }
}

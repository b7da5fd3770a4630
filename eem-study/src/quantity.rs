//! The kinds of quantities of a state, and the differences of two states.

use core::fmt;

use eem_runtime::Simulation;

/// The largest difference of the references for which an error is stated, relative to it.
pub(crate) const DOUBT: f64 = 0.01;

/// A kind of quantity with an error of its own in a study.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum StateQuantity {
    /// q of all masses.
    Positions,
    /// p of all masses.
    Momenta,
    /// θ of all elements that have one.
    Temperatures,
    /// γ of all dashpots.
    ViscousStretches,
}

impl StateQuantity {
    /// All kinds.
    pub const ALL: [Self; 4] = [
        Self::Positions,
        Self::Momenta,
        Self::Temperatures,
        Self::ViscousStretches,
    ];

    /// The symbol: q, p, θ or γ.
    #[must_use]
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Positions => "q",
            Self::Momenta => "p",
            Self::Temperatures => "θ",
            Self::ViscousStretches => "γ",
        }
    }

    /// The place among [`ALL`](Self::ALL).
    pub(crate) const fn index(self) -> usize {
        self as usize
    }
}

impl fmt::Display for StateQuantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Positions => "positions",
            Self::Momenta => "momenta",
            Self::Temperatures => "temperatures",
            Self::ViscousStretches => "viscous stretches",
        })
    }
}

/// A number for each kind of quantity that the scene has.
pub(crate) type PerQuantity = [Option<f64>; 4];

/// A state, for comparison with others of the same scene.
///
/// ```
/// use eem::{EndState, Scene, Scheme, Simulation, StateQuantity};
///
/// // A free mass after 1 s at 2 m/s.
/// let mut scene = Scene::<1>::new();
/// scene.mass(3.0, [1.0], [2.0]);
/// let mut run = Simulation::new(scene, Scheme::EemEntropy, 1.0)?;
/// let start = EndState::of(&run);
/// run.step()?;
/// let end = EndState::of(&run);
/// assert_eq!(end.values(StateQuantity::Positions), [3.0]);
/// assert_eq!(end.values(StateQuantity::Momenta), [6.0]);
/// assert_eq!(start.difference(&end, StateQuantity::Positions), Some(2.0 / 3.0));
/// assert_eq!(start.difference(&end, StateQuantity::Temperatures), None);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct EndState {
    values: [Vec<f64>; 4],
    /// Which viscous variables are strains of solids.
    are_strains: Vec<bool>,
    /// `|q|₂` of all nodes, anchors included, m.
    size: f64,
    /// The largest `|p|₂` on the way to the state, kg m/s.
    largest_momentum: f64,
    /// |q|₂ of all nodes at the start, m, and the largest `m ℓ ω`, kg m/s.
    least_sizes: [f64; 2],
}

impl EndState {
    /// The present state of a simulation.
    #[must_use]
    pub fn of<const D: usize>(run: &Simulation<D>) -> Self {
        Self {
            values: run.values(),
            are_strains: run.viscous_strains(),
            size: run.size_of_positions(),
            largest_momentum: run.largest_momentum(),
            least_sizes: run.least_sizes(),
        }
    }

    /// The same state with the largest `|p|₂` on the way to it, kg m/s, to which errors of momenta are relative. By default
    /// it is that of the state or, with step control, of all steps. A [`Study`](crate::Study) finds it for all its runs.
    #[must_use]
    pub fn with_largest_momentum(self, momentum: f64) -> Self {
        Self {
            largest_momentum: self.largest_momentum.max(momentum),
            ..self
        }
    }

    /// The values of one kind: q (m) and p (kg m/s) of the masses, component by component, θ (K) and γ (m) of
    /// the elements, in the order of creation.
    #[must_use]
    pub fn values(&self, quantity: StateQuantity) -> &[f64] {
        &self.values[quantity.index()]
    }

    /// The relative difference of this state from `exact` in one kind of quantity, in the units of
    /// [`Tolerance`](eem_runtime::Tolerance):
    ///
    /// ```text
    /// max |Δq|/|q|₂,   max |Δp|/max |p|₂,   max |Δθ|/θ,   max |Δγ|/|q|₂
    /// ```
    ///
    /// with the largest component of the difference in the numerator and the Euclidean norm of all components of
    /// `exact` in the denominator, for positions with those of anchors, for momenta the largest norm on the way. Temperatures are
    /// compared one by one, differences of viscous strains of solids with 1. `None` if there is no such quantity, or if the
    /// numbers of values differ. Equal states differ by zero, also if all values vanish.
    ///
    /// A size that vanishes is no unit. As in step control, a difference r is one of scales of at least r L, and r² M for
    /// momenta, with |q|₂ = L of all nodes at the start and the largest M = m ℓ ω of all masses:
    ///
    /// ```text
    /// min(|Δq|/|q|₂, √(|Δq|/L)),   min(|Δp|/max |p|₂, ∛(|Δp|/M))
    /// ```
    #[must_use]
    pub fn difference(&self, exact: &Self, quantity: StateQuantity) -> Option<f64> {
        let [own, values] = [self, exact].map(|state| state.values(quantity));
        if values.is_empty() || own.len() != values.len() {
            return None;
        }
        let [least_length, least_momentum] = exact.least_sizes;
        let relative = |index: usize, part: f64, value: f64| match quantity {
            StateQuantity::Momenta => smaller(
                share(part, exact.largest_momentum),
                (part / least_momentum).cbrt(),
            ),
            StateQuantity::Temperatures => share(part, value.abs()),
            StateQuantity::ViscousStretches if exact.are_strains[index] => part,
            StateQuantity::Positions | StateQuantity::ViscousStretches => {
                smaller(share(part, exact.size), (part / least_length).sqrt())
            }
        };
        let pairs = own.iter().zip(values).enumerate();
        let all = pairs.map(|(index, (own, &value))| relative(index, (own - value).abs(), value));
        Some(all.fold(0.0, larger))
    }

    /// The differences of every kind.
    pub(crate) fn differences(&self, exact: &Self) -> PerQuantity {
        StateQuantity::ALL.map(|quantity| self.difference(exact, quantity))
    }
}

/// A part over a whole; zero if the part is zero.
pub(crate) fn share(part: f64, whole: f64) -> f64 {
    if part > 0.0 || part.is_nan() {
        part / whole
    } else {
        0.0
    }
}

/// A size, or the other one if that is smaller; NaN if the size is.
fn smaller(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

/// The larger of two numbers, NaN if one of them is NaN.
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

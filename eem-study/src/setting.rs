//! Settings of a study: scheme and steps.

use core::fmt;
use core::iter;

use eem_material::number::readable::Readable;
use eem_runtime::Scheme;

/// The sizes of the steps of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum StepChoice {
    /// Constant, s.
    Fixed(f64),
    /// Chosen by step control for this relative tolerance, see [`Tolerance`](eem_runtime::Tolerance).
    Tolerance(f64),
}

/// One run of a [`Study`](crate::Study).
///
/// ```
/// use eem::{Scheme, Setting};
///
/// let setting = Setting::fixed(Scheme::EemEntropy, 0.1);
/// assert_eq!(setting.step(), Some(0.1));
/// assert_eq!(setting.to_string(), "eem-entropy with h = 0.1 s");
///
/// let setting = Setting::controlled(Scheme::EemTemperature, 1e-4);
/// assert_eq!((setting.step(), setting.tolerance()), (None, Some(1e-4)));
/// assert_eq!(setting.to_string(), "eem-temperature at a tolerance of 0.0001");
/// assert_eq!(setting.line(), "eem-temperature, controlled");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Setting {
    /// The scheme.
    pub scheme: Scheme,
    /// The sizes of its steps.
    pub steps: StepChoice,
}

impl Setting {
    const fn new(scheme: Scheme, steps: StepChoice) -> Self {
        Self { scheme, steps }
    }

    /// A scheme with steps of the size `step`, s.
    #[must_use]
    pub const fn fixed(scheme: Scheme, step: f64) -> Self {
        Self::new(scheme, StepChoice::Fixed(step))
    }

    /// `count` settings of a scheme, each step half of the one before: `h, h/2, h/4, …` with h = `largest`, s.
    ///
    /// ```
    /// use eem::{Scheme, Setting};
    ///
    /// let steps = Setting::halved(Scheme::Gauss4, 0.2, 3).filter_map(|setting| setting.step());
    /// assert_eq!(steps.collect::<Vec<_>>(), [0.2, 0.1, 0.05]);
    /// ```
    pub fn halved(scheme: Scheme, largest: f64, count: u32) -> impl Iterator<Item = Self> {
        let steps = iter::successors(Some(largest), |step| Some(0.5 * step));
        let steps = (0..count).zip(steps);
        steps.map(move |(_, step)| Self::fixed(scheme, step))
    }

    /// A scheme with step control for a relative tolerance.
    #[must_use]
    pub const fn controlled(scheme: Scheme, tolerance: f64) -> Self {
        Self::new(scheme, StepChoice::Tolerance(tolerance))
    }

    /// `count` settings of a scheme, each tolerance a tenth of the one before: `r, r/10, r/100, …` with r = `largest`.
    ///
    /// ```
    /// use eem::{Scheme, Setting};
    ///
    /// let settings = Setting::by_decades(Scheme::EemEntropy, 1e-2, 2);
    /// let tolerances: Vec<_> = settings.filter_map(|setting| setting.tolerance()).collect();
    /// assert_eq!(tolerances, [1e-2, 1e-3]);
    /// ```
    pub fn by_decades(scheme: Scheme, largest: f64, count: u32) -> impl Iterator<Item = Self> {
        let divisors = (0..count).map(|decade| 10.0_f64.powi(decade.cast_signed()));
        divisors.map(move |divisor| Self::controlled(scheme, largest / divisor))
    }

    /// The constant step, s; `None` with step control.
    #[must_use]
    pub const fn step(&self) -> Option<f64> {
        match self.steps {
            StepChoice::Fixed(step) => Some(step),
            StepChoice::Tolerance(_) => None,
        }
    }

    /// The tolerance of step control; `None` with constant steps.
    #[must_use]
    pub const fn tolerance(&self) -> Option<f64> {
        match self.steps {
            StepChoice::Fixed(_) => None,
            StepChoice::Tolerance(tolerance) => Some(tolerance),
        }
    }

    /// The name of the curve in a picture: the name of the scheme, and whether it uses step control.
    #[must_use]
    pub fn line(&self) -> String {
        let suffix = match self.steps {
            StepChoice::Fixed(_) => "",
            StepChoice::Tolerance(_) => ", controlled",
        };
        format!("{}{suffix}", self.scheme)
    }
}

impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = self.scheme;
        match self.steps {
            // `Auto` controls its steps by default.
            StepChoice::Fixed(step) if self.scheme == Scheme::Auto => {
                write!(f, "{name} with constant h = {} s", Readable(step))
            }
            StepChoice::Fixed(step) => write!(f, "{name} with h = {} s", Readable(step)),
            StepChoice::Tolerance(relative) => {
                write!(f, "{name} at a tolerance of {}", Readable(relative))
            }
        }
    }
}

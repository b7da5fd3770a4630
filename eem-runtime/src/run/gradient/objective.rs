//! Objectives, which are differentiated: sums of quantities at times, of integrals and of squares of misfits.

use core::ops::Add;

use crate::run::recorder::Quantity;

/// A number that follows from the states of a run, see [`Simulation::gradient`](crate::Simulation::gradient).
///
/// | | |
/// |---|---|
/// | [`at_end`](Self::at_end), [`at`](Self::at) | a quantity at the end, or at the end of another step |
/// | [`integral`](Self::integral) | `Σ ½h (g⁰ + g¹)` over the steps |
/// | [`misfit`](Self::misfit) | `½ Σ ((g(tᵢ) − dᵢ)/σᵢ)²` |
/// | [`time`](Self::time) | the time at the end, s |
/// | [`component`](Self::component), [`times`](Self::times), `+` | one component of a vector; a factor; sums |
#[derive(Debug)]
pub struct Objective<const D: usize> {
    pub(crate) terms: Vec<Term<D>>,
    /// The factor of the time at the end.
    pub(crate) time: f64,
}

/// A quantity with the way in which it counts.
#[derive(Debug)]
pub(crate) struct Term<const D: usize> {
    pub(crate) factor: f64,
    pub(crate) quantity: Quantity<D>,
    pub(crate) component: usize,
    pub(crate) when: When,
}

/// The times at which a quantity counts.
#[derive(Clone, Debug)]
pub(crate) enum When {
    End,
    /// At this time, s.
    At(f64),
    Integral,
    /// Times, data and their standard deviations.
    Misfit(Vec<[f64; 3]>),
}

impl<const D: usize> Objective<D> {
    fn new(quantity: Quantity<D>, when: When) -> Self {
        let term = Term {
            factor: 1.0,
            quantity,
            component: 0,
            when,
        };
        Self {
            terms: vec![term],
            time: 0.0,
        }
    }

    /// A quantity at the end of the run; of a vector the first component.
    #[must_use]
    pub fn at_end(quantity: Quantity<D>) -> Self {
        Self::new(quantity, When::End)
    }

    /// A quantity at a time at which a step ends, s.
    #[must_use]
    pub fn at(time: f64, quantity: Quantity<D>) -> Self {
        Self::new(quantity, When::At(time))
    }

    /// The integral of a quantity over the time of the history, by the trapezoidal rule over its steps.
    #[must_use]
    pub fn integral(quantity: Quantity<D>) -> Self {
        Self::new(quantity, When::Integral)
    }

    /// Half the sum of the squares of `(g(t) − d)/σ` over records (t, d, σ); steps must end at the times, s, and σ be
    /// positive.
    #[must_use]
    pub fn misfit(quantity: Quantity<D>, records: impl IntoIterator<Item = [f64; 3]>) -> Self {
        Self::new(quantity, When::Misfit(records.into_iter().collect()))
    }

    /// The time at the end of the run, s. If an event ends it, [`gradient_at_event`](crate::Simulation::gradient_at_event) finds
    /// the derivatives; otherwise only those by the sizes of steps are not zero.
    #[must_use]
    pub const fn time() -> Self {
        Self {
            terms: Vec::new(),
            time: 1.0,
        }
    }

    /// Takes this component, from 0, of all its vector quantities.
    #[must_use]
    pub fn component(mut self, component: usize) -> Self {
        for term in &mut self.terms {
            term.component = component;
        }
        self
    }

    /// Multiplies it by a factor.
    #[must_use]
    pub fn times(mut self, factor: f64) -> Self {
        for term in &mut self.terms {
            term.factor *= factor;
        }
        self.time *= factor;
        self
    }

    /// Its unit; empty if it is not known, or terms have different ones.
    pub(crate) fn unit(&self) -> String {
        let of_time = (self.time != 0.0).then(|| "s".to_owned());
        let units = self.terms.iter().map(|term| match term.when {
            When::End | When::At(_) => term.quantity.unit().to_owned(),
            When::Integral if term.quantity.unit().is_empty() => String::new(),
            When::Integral => format!("{} s", term.quantity.unit()),
            When::Misfit(_) => "1".to_owned(),
        });
        let mut units = units.chain(of_time);
        let first = units.next().unwrap_or_default();
        if units.all(|unit| unit == first) {
            first
        } else {
            String::new()
        }
    }
}

impl<const D: usize> Add for Objective<D> {
    type Output = Self;

    fn add(mut self, other: Self) -> Self {
        self.terms.extend(other.terms);
        self.time += other.time;
        self
    }
}

//! States of a domain: between the unit cube and the variables of a model.

use core::fmt;

use super::error::DomainError;
use super::state::{DomainPoint, Kind};
use crate::number::readable::Readable;

/// The smallest value found, and its state.
#[derive(Clone, Debug, PartialEq)]
pub struct Least {
    /// The value.
    pub value: f64,
    /// The state.
    pub point: DomainPoint,
}

/// The result of a check without errors.
#[derive(Clone, Debug, PartialEq)]
pub struct DomainReport {
    /// The number of evaluated states.
    pub evaluations: usize,
    /// The smallest heat capacity, J/K or J/(K m³), if the model has a temperature.
    pub heat_capacity: Option<Least>,
    /// The smallest viscosity of each dashpot, N s/m or Pa s.
    pub viscosities: Vec<Least>,
    /// The smallest viscosity of the dashpot in parallel with the spring, N s/m, if there is one.
    pub drag: Option<Least>,
}

impl fmt::Display for DomainReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} states", self.evaluations)?;
        let mut write_least = |quantity: &str, least: &Least, unit: fn(Kind) -> &'static str| {
            let (value, unit) = (Readable(least.value), unit(least.point.kind));
            let point = &least.point;
            write!(
                f,
                "; {quantity} {value:.6} {unit} or more, least at {point}"
            )
        };
        if let Some(least) = &self.heat_capacity {
            write_least("heat capacity", least, Kind::heat_capacity)?;
        }
        for (dashpot, least) in self.viscosities.iter().enumerate() {
            let quantity = format!("viscosity of dashpot {dashpot}");
            write_least(&quantity, least, Kind::viscosity)?;
        }
        if let Some(least) = &self.drag {
            write_least("viscosity of the stretch", least, Kind::viscosity)?;
        }
        Ok(())
    }
}

/// How many variables of each role there are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    pub(super) kind: Kind,
    pub(super) measures: usize,
    pub(super) dashpots: usize,
    pub(super) thermal: bool,
}

impl Shape {
    /// The number of variables of each role.
    fn counts(self) -> [(&'static str, usize); 4] {
        let [stretches, strains] = match self.kind {
            Kind::Spring => [self.measures, 0],
            Kind::Solid => [0, self.measures],
        };
        [
            ("Stretch", stretches),
            ("Strain…", strains),
            ("Viscous", self.dashpots),
            ("Temperature", usize::from(self.thermal)),
        ]
    }

    /// An error unless a domain of shape `given` fits.
    pub(super) fn expect(self, given: Self) -> Result<(), DomainError> {
        for ((role, expected), (_, given)) in self.counts().into_iter().zip(given.counts()) {
            if expected != given {
                return Err(DomainError::Variables {
                    role,
                    expected,
                    given,
                });
            }
        }
        Ok(())
    }
}

/// The map from the unit cube to the states of a domain.
#[derive(Debug)]
pub(super) struct Space {
    shape: Shape,
    ranges: Vec<[f64; 2]>,
}

impl Space {
    /// Checks the intervals.
    pub(super) fn new(shape: Shape, ranges: Vec<[f64; 2]>) -> Result<Self, DomainError> {
        let space = Self { shape, ranges };
        for (index, &[low, high]) in space.ranges.iter().enumerate() {
            let positive = space.is_positive(index);
            let ends = low.is_finite() && high.is_finite() && low <= high;
            if !ends || (positive && low <= 0.0) {
                let kinds = ["finite", "positive and finite"];
                return Err(DomainError::Range {
                    variable: space.variable(index),
                    low,
                    high,
                    kind: kinds[usize::from(positive)],
                });
            }
        }
        Ok(space)
    }

    /// The number of variables.
    pub(super) fn dimension(&self) -> usize {
        self.ranges.len()
    }

    /// The report of the smallest heat capacity and viscosities found. If a spring has more viscosities than dashpots, the
    /// last one is that of the dashpot in parallel; in a solid the last ones are those of a viscous strain.
    pub(super) fn report(&self, evaluations: usize, mut leasts: Vec<Least>) -> DomainReport {
        let shape = self.shape;
        let mut viscosities = leasts.split_off(usize::from(shape.thermal));
        let has_drag = shape.kind == Kind::Spring && viscosities.len() > shape.dashpots;
        let drag = has_drag.then(|| viscosities.pop()).flatten();
        DomainReport {
            evaluations,
            heat_capacity: leasts.pop(),
            viscosities,
            drag,
        }
    }

    /// Whether variable `index` is a length or a temperature, and neither viscous nor a strain.
    fn is_positive(&self, index: usize) -> bool {
        let shape = self.shape;
        let is_measure = index < shape.measures;
        index >= shape.measures + shape.dashpots || is_measure && shape.kind == Kind::Spring
    }

    fn variable(&self, index: usize) -> String {
        let Shape { kind, dashpots, .. } = self.shape;
        match index.checked_sub(self.shape.measures) {
            None => kind.measure(index),
            Some(dashpot) if dashpot < dashpots => {
                format!("{} of dashpot {dashpot}", kind.viscous())
            }
            Some(_) => "temperature".to_owned(),
        }
    }

    /// The state at a point of the unit cube, evenly in the logarithm of positive variables.
    pub(super) fn state(&self, unit: &[f64]) -> Vec<f64> {
        let at = |(index, (&u, &[low, high])): (usize, (&f64, &[f64; 2]))| {
            if u <= 0.0 {
                low
            } else if u >= 1.0 {
                high
            } else if self.is_positive(index) {
                (low * (u * (high / low).ln()).exp()).clamp(low, high)
            } else {
                (low + u * (high - low)).clamp(low, high)
            }
        };
        let pairs = unit.iter().zip(&self.ranges);
        pairs.enumerate().map(at).collect()
    }

    /// A state by roles.
    pub(super) fn point(&self, x: &[f64]) -> DomainPoint {
        let (measures, rest) = x.split_at(self.shape.measures);
        let (viscous, rest) = rest.split_at(self.shape.dashpots);
        DomainPoint {
            measures: measures.to_vec(),
            viscous: viscous.to_vec(),
            temperature: rest.first().copied(),
            kind: self.shape.kind,
        }
    }
}

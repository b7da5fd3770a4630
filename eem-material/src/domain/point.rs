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
        if let Some(Least { value, point }) = &self.heat_capacity {
            write!(
                f,
                "; heat capacity {:.6} {} or more, least at {point}",
                Readable(*value),
                point.kind.heat_capacity()
            )?;
        }
        for (dashpot, Least { value, point }) in self.viscosities.iter().enumerate() {
            write!(
                f,
                "; viscosity of dashpot {dashpot} {:.6} {} or more, least at {point}",
                Readable(*value),
                point.kind.viscosity()
            )?;
        }
        if let Some(Least { value, point }) = &self.drag {
            write!(
                f,
                "; viscosity of the stretch {:.6} {} or more, least at {point}",
                Readable(*value),
                point.kind.viscosity()
            )?;
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
    /// Whether a domain of shape `given` fits.
    pub(super) fn expect(self, given: Self) -> Result<(), DomainError> {
        let counts = |shape: Self| {
            let roles = ["Stretch", "Strain…", "Viscous", "Temperature"];
            let [stretches, strains] = match shape.kind {
                Kind::Spring => [shape.measures, 0],
                Kind::Solid => [0, shape.measures],
            };
            let thermal = usize::from(shape.thermal);
            roles
                .into_iter()
                .zip([stretches, strains, shape.dashpots, thermal])
        };
        for ((role, expected), (_, given)) in counts(self).zip(counts(given)) {
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
                return Err(DomainError::Range {
                    variable: space.variable(index),
                    low,
                    high,
                    kind: if positive {
                        "positive and finite"
                    } else {
                        "finite"
                    },
                });
            }
        }
        Ok(space)
    }

    /// The number of variables.
    pub(super) fn dimension(&self) -> usize {
        self.ranges.len()
    }

    /// Whether there is a temperature.
    pub(super) fn is_thermal(&self) -> bool {
        self.shape.thermal
    }

    /// Whether the last of so many viscosities is that of a dashpot beside a spring. Those of a solid are of its
    /// dashpots, and of the flow of a viscous strain.
    pub(super) fn is_last_drag(&self, viscosities: usize) -> bool {
        self.shape.kind == Kind::Spring && viscosities > self.shape.dashpots
    }

    /// Whether variable `index` is a length or a temperature, and neither viscous nor a strain.
    fn is_positive(&self, index: usize) -> bool {
        let Shape {
            kind,
            measures,
            dashpots,
            ..
        } = self.shape;
        index >= measures + dashpots || (index < measures && kind == Kind::Spring)
    }

    fn variable(&self, index: usize) -> String {
        let Shape {
            kind,
            measures,
            dashpots,
            ..
        } = self.shape;
        match index.checked_sub(measures) {
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

//! A state of a domain.

use core::fmt;

use crate::number::readable::Readable;

/// What a model is one of: names and units of its variables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A length in m, energies in J.
    Spring,
    /// Strains, energies per volume.
    Solid,
}

impl Kind {
    pub(super) fn of(per_volume: bool) -> Self {
        if per_volume {
            Self::Solid
        } else {
            Self::Spring
        }
    }

    pub(super) fn heat_capacity(self) -> &'static str {
        match self {
            Self::Spring => "J/K",
            Self::Solid => "J/(K m³)",
        }
    }

    pub(super) fn viscosity(self) -> &'static str {
        match self {
            Self::Spring => "N s/m",
            Self::Solid => "Pa s",
        }
    }

    /// Measure number `index`, from 0.
    pub(super) fn measure(self, index: usize) -> String {
        match self {
            Self::Spring => "stretch".to_owned(),
            Self::Solid => format!("strain {index}"),
        }
    }

    /// What the viscous variables are.
    pub(super) fn viscous(self) -> &'static str {
        match self {
            Self::Spring => "viscous stretch",
            Self::Solid => "viscous strain",
        }
    }

    fn length(self) -> &'static str {
        match self {
            Self::Spring => " m",
            Self::Solid => "",
        }
    }
}

/// A state, by the roles of its variables.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct DomainPoint {
    /// Measures of the deformation: the stretch of a spring, m, or the strains of a solid.
    pub measures: Vec<f64>,
    /// Viscous stretches of the dashpots, m, or viscous strains.
    pub viscous: Vec<f64>,
    /// The temperature, K, if the model has one.
    pub temperature: Option<f64>,
    pub(super) kind: Kind,
}

impl fmt::Display for DomainPoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (kind, length) = (self.kind, self.kind.length());
        let mut separator = "";
        for (index, value) in self.measures.iter().enumerate() {
            let measure = kind.measure(index);
            write!(f, "{separator}{measure} {}{length}", Readable(*value))?;
            separator = ", ";
        }
        for (dashpot, value) in self.viscous.iter().enumerate() {
            write!(
                f,
                "{separator}{} {}{length} of dashpot {dashpot}",
                kind.viscous(),
                Readable(*value)
            )?;
        }
        match self.temperature {
            Some(theta) => write!(f, "{separator}temperature {} K", Readable(theta)),
            None => Ok(()),
        }
    }
}

//! A state of a domain.

use core::fmt;

use crate::number::readable::Readable;

/// Springs or solids, which differ in names and units.
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

    fn choose(self, of_spring: &'static str, of_solid: &'static str) -> &'static str {
        match self {
            Self::Spring => of_spring,
            Self::Solid => of_solid,
        }
    }

    pub(super) fn heat_capacity(self) -> &'static str {
        self.choose("J/K", "J/(K m³)")
    }

    pub(super) fn viscosity(self) -> &'static str {
        self.choose("N s/m", "Pa s")
    }

    pub(super) fn viscous(self) -> &'static str {
        self.choose("viscous stretch", "viscous strain")
    }

    /// The name of a measure, counted from 0.
    pub(super) fn measure(self, index: usize) -> String {
        match self {
            Self::Spring => "stretch".to_owned(),
            Self::Solid => format!("strain {index}"),
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
        let (kind, unit) = (self.kind, self.kind.choose(" m", ""));
        for (index, value) in self.measures.iter().enumerate() {
            let separator = if index == 0 { "" } else { ", " };
            let measure = kind.measure(index);
            write!(f, "{separator}{measure} {}{unit}", Readable(*value))?;
        }
        for (dashpot, value) in self.viscous.iter().enumerate() {
            let (viscous, value) = (kind.viscous(), Readable(*value));
            write!(f, ", {viscous} {value}{unit} of dashpot {dashpot}")?;
        }
        match self.temperature {
            Some(theta) => write!(f, ", temperature {} K", Readable(theta)),
            None => Ok(()),
        }
    }
}

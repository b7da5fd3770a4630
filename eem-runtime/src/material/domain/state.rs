//! A state of a domain.

use core::fmt;

use crate::number::readable::Readable;

/// A state, by the roles of its variables.
#[derive(Clone, Debug, PartialEq)]
pub struct DomainPoint {
    /// Measures of the deformation: the stretch of a spring, m.
    pub measures: Vec<f64>,
    /// Viscous stretches of the dashpots, m.
    pub viscous: Vec<f64>,
    /// The temperature, K, if the model has one.
    pub temperature: Option<f64>,
}

impl fmt::Display for DomainPoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut separator = "";
        for value in &self.measures {
            write!(f, "{separator}stretch {} m", Readable(*value))?;
            separator = ", ";
        }
        for (dashpot, value) in self.viscous.iter().enumerate() {
            write!(
                f,
                "{separator}viscous stretch {} m of dashpot {dashpot}",
                Readable(*value)
            )?;
        }
        match self.temperature {
            Some(theta) => write!(f, "{separator}temperature {} K", Readable(theta)),
            None => Ok(()),
        }
    }
}

//! Springs of texts in one to three dimensions: the solver is compiled for each of their shapes here and nowhere else, which
//! takes most of the time that the package takes, and is not done again when other parts of it change.

#[cfg(not(feature = "all"))]
use eem::typed::{DampedSpring0, Spring0, ThermalSpring1};
use eem::typed::{Law, LawError};
use eem::{Element, Node, Scene};

/// A scene that takes springs of any law.
pub trait Springs {
    /// Puts a spring between two nodes, see [`Law::add_spring`].
    ///
    /// # Errors
    ///
    /// Those of [`Law::add_spring`].
    fn add_spring(&mut self, law: &Law, nodes: [Node; 2]) -> Result<Element, LawError>;
}

macro_rules! springs {
    ($($dim:literal)*) => {
        $(
            impl Springs for Scene<$dim> {
                #[cfg(feature = "all")]
                fn add_spring(&mut self, law: &Law, nodes: [Node; 2]) -> Result<Element, LawError> {
                    law.add_spring(self, nodes)
                }

                #[cfg(not(feature = "all"))]
                fn add_spring(&mut self, law: &Law, nodes: [Node; 2]) -> Result<Element, LawError> {
                    let elastic: Result<Spring0, _> = law.model();
                    if let Ok(elastic) = elastic {
                        return Ok(self.spring(elastic, nodes));
                    }
                    let damped: Result<DampedSpring0, _> = law.model();
                    if let Ok(damped) = damped {
                        return Ok(self.spring(damped, nodes));
                    }
                    let thermal: ThermalSpring1 = law.model()?;
                    Ok(self.spring(thermal, nodes))
                }
            }
        )*
    };
}

springs!(1 2 3);

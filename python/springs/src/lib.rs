//! Springs of texts in one to three dimensions: the solver is compiled for each of their shapes here and nowhere else, which
//! takes most of the time that the package takes, and is not done again when other parts of it change.

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
                    if let Ok(elastic) = law.model::<f64, 1, 0, 0, 0, 1>() {
                        return Ok(self.spring(elastic, nodes));
                    }
                    if let Ok(damped) = law.model::<f64, 1, 0, 1, 0, 1>() {
                        return Ok(self.spring(damped, nodes));
                    }
                    Ok(self.spring(law.model::<f64, 3, 1, 0, 4, 4>()?, nodes))
                }
            }
        )*
    };
}

springs!(1 2 3);

//! Springs of texts in one to three dimensions: the solver is compiled for each of their types here and nowhere else, which
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
                fn add_spring(&mut self, law: &Law, nodes: [Node; 2]) -> Result<Element, LawError> {
                    law.add_spring(self, nodes)
                }
            }
        )*
    };
}

springs!(1 2 3);

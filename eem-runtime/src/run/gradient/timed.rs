//! Loads that are functions of time.

use core::fmt;

use super::input::{Input, InputOf};
use crate::element::handle::{Element, Node, Reservoir};

/// A load that is a function of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Timed {
    Force(Node),
    Motion(Node),
    Thermostat(Element),
    /// A rocket by its number among those of its node.
    Thrust(Node, usize),
    Oven(Reservoir),
}

impl fmt::Display for Timed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Force(node) => write!(f, "the force on {node}"),
            Self::Motion(node) => write!(f, "the motion of {node}"),
            Self::Thermostat(element) => write!(f, "the temperature of {element}"),
            Self::Thrust(node, _) => write!(f, "the thrust on {node}"),
            Self::Oven(reservoir) => write!(f, "the temperature of {reservoir}"),
        }
    }
}

impl Timed {
    /// Whether an input is a parameter of this load.
    pub(super) fn has<const D: usize>(self, input: &Input<D>) -> bool {
        match (self, &input.of) {
            (Self::Force(own), InputOf::Force(node, _))
            | (Self::Motion(own), InputOf::Motion(node, _)) => own.index == node.index,
            (Self::Thermostat(own), InputOf::Thermostat(element, _)) => {
                own.index() == element.index()
            }
            (Self::Thrust(own, place), InputOf::Thrust(node, rocket, _)) => {
                (own.index, place) == (node.index, *rocket)
            }
            (Self::Oven(own), InputOf::Oven(oven, _)) => own.index == oven.index,
            _ => false,
        }
    }
}

//! Loads that are functions of time, by name.

use core::fmt;

use crate::element::handle::{Element, Node};

/// A load that is a function of time.
///
/// ```
/// use eem::{StepFailure, StepLimit, TimedLoad};
/// use eem::prelude::*;
///
/// // A force without a smallest step in which it is smooth.
/// let mut scene = Scene::<1>::new();
/// let mass = scene.mass(1.0, [1.0], [1.0]);
/// scene.force(mass, |t: f64| [(t.to_bits() % 3) as f64]);
/// let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.1)?;
/// run.control_steps(Tolerance::new(1e-4))?;
/// run.limit_steps([0.02, 1.0])?;
/// let failure = run.run_until(1.0).unwrap_err().failure;
/// let StepFailure::TooSmall { limit, .. } = failure else {
///     return Err("another failure".into());
/// };
/// let load = TimedLoad::Force(mass);
/// assert_eq!((*limit, load.to_string()), (StepLimit::Load { load }, "the force on node 0".into()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum TimedLoad {
    /// A force on a node.
    Force(Node),
    /// The thrust of a rocket at a node.
    Thrust(Node),
    /// The motion of an anchor.
    Motion(Node),
    /// The temperature prescribed on an element.
    Temperature(Element),
    /// The temperature of the reservoir with this index.
    Oven(usize),
}

impl fmt::Display for TimedLoad {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Force(node) => write!(f, "the force on {node}"),
            Self::Thrust(node) => write!(f, "the thrust of the rocket at {node}"),
            Self::Motion(node) => write!(f, "the motion of {node}"),
            Self::Temperature(element) => write!(f, "the temperature prescribed on {element}"),
            Self::Oven(index) => write!(f, "the temperature of reservoir {index}"),
        }
    }
}

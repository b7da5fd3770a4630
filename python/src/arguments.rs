//! Arguments of calls to scenes as acts.

use pyo3::prelude::*;

use crate::act::{Act, Course, Speed};
use crate::built::dashpots;
use crate::handle::{Kind, Node, indices};
use crate::material::Material;
use crate::world::World;
use crate::{error, input};

impl World {
    /// Adds masses and returns the number of the first.
    pub(crate) fn masses(
        &mut self,
        (masses, positions): (Vec<f64>, Vec<f64>),
        [velocity, momentum]: [Option<Vec<f64>>; 2],
    ) -> PyResult<usize> {
        let first = self.lineage.counts[Kind::Node as usize];
        let speed = match (velocity, momentum) {
            (None, None) => Speed::Zero,
            (Some(velocities), None) => Speed::Velocities(velocities),
            (None, Some(momenta)) => Speed::Momenta(momenta),
            (Some(_), Some(_)) => {
                return Err(error::scene(
                    "velocity and momentum are given: give one of them",
                ));
            }
        };
        self.act(Act::Masses {
            masses,
            positions,
            speed,
        })?;
        Ok(first)
    }

    /// Adds springs and returns the number of the first.
    pub(crate) fn springs(
        &mut self,
        material: &Bound<'_, Material>,
        pairs: Vec<[usize; 2]>,
        temperature: Option<&Bound<'_, PyAny>>,
        viscous_stretch: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<usize> {
        let count = pairs.len();
        let first = self.lineage.counts[Kind::Element as usize];
        let temperatures = match temperature {
            Some(given) => input::numbers(given, count, "the temperature")?,
            None => Vec::new(),
        };
        let dashpots = dashpots(&material.get().law);
        let viscous_stretches = match viscous_stretch {
            Some(given) => input::vectors(given, [count, dashpots], "the viscous stretch")?,
            None => Vec::new(),
        };
        let material = self.material(material);
        self.act(Act::Springs {
            material,
            pairs,
            temperatures,
            viscous_stretches,
        })?;
        Ok(first)
    }

    /// A quantity that is a number or a function of time.
    pub(crate) fn course(&mut self, given: &Bound<'_, PyAny>, what: &str) -> PyResult<Course> {
        if given.is_callable() {
            return Ok(Course::Function(self.function(given)));
        }
        Ok(Course::Constant(vec![input::number(given, what)?]))
    }

    /// The two nodes of a spring.
    pub(crate) fn pair(&self, given: &Bound<'_, PyAny>) -> PyResult<[usize; 2]> {
        let (nodes, _) = indices::<Node>(given, &self.lineage)?;
        let count = nodes.len();
        <[usize; 2]>::try_from(nodes)
            .map_err(|_| error::scene(format!("a spring has two nodes, not {count}")))
    }
}

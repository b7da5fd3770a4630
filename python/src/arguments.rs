//! Arguments of calls to scenes as acts, and what they return.

use eem::EquilibriumReport;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::act::{Act, Bulk, Course, Partner, Speed};
use crate::built::dashpots;
use crate::handle::{
    Element, ElementArray, HeatPath, HeatPathArray, Kind, Node, NodeArray, Reservoir,
    ReservoirArray, indices,
};
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

    /// Adds a solid and returns an `eem.Solid`.
    pub(crate) fn solid(
        &mut self,
        py: Python<'_>,
        material: &Bound<'_, Material>,
        [positions, cells]: [&Bound<'_, PyAny>; 2],
        bulk: Bulk,
        [temperature, velocity]: [Option<&Bound<'_, PyAny>>; 2],
    ) -> PyResult<Py<PyAny>> {
        let dim = self.dim;
        let positions = input::rows(positions, dim, "positions")?;
        let count = positions.len() / dim;
        let cells = input::indices(cells, 1 << dim, "cells")?;
        let velocities = velocity.map(|given| input::vectors(given, [count, dim], "the velocity"));
        let temperatures = temperature.map(|given| {
            // As many points as corners, or one for all.
            input::numbers(given, cells.len(), "the temperature")
        });
        let counts = self.lineage.counts;
        let first = counts[Kind::Node as usize];
        let own = cells
            .iter()
            .map(|&node| (first + node).cast_signed() as i64);
        let own = PyArray1::from_iter(py, own).reshape([cells.len() >> dim, 1 << dim])?;
        let material = self.material(material);
        self.act(Act::Solid {
            material,
            positions,
            cells,
            bulk,
            velocities: velocities.transpose()?.unwrap_or_default(),
            temperatures: temperatures.transpose()?.unwrap_or_default(),
        })?;
        let range = |kind: Kind| counts[kind as usize]..self.lineage.counts[kind as usize];
        let nodes = NodeArray::of(self.lineage.own, range(Kind::Node));
        let points = ElementArray::of(self.lineage.own, range(Kind::Element));
        let class = py.import("eem._solid")?.getattr("Solid")?;
        Ok(class.call1((nodes, points, own))?.unbind())
    }

    /// The properties of a solid: density, thickness, conductivity, fibres.
    pub(crate) fn bulk(&self, given: [Option<&Bound<'_, PyAny>>; 4]) -> PyResult<Bulk> {
        let [density, thickness, conductivity, fibres] = given;
        if thickness.is_some() && self.dim != 2 {
            return Err(error::scene("only a solid in the plane has a thickness"));
        }
        let number = |given: Option<&Bound<'_, PyAny>>, what: &str| {
            given.map(|given| input::number(given, what)).transpose()
        };
        let fibres = fibres.map(|given| input::rows(given, self.dim, "fibres"));
        Ok(Bulk {
            density: number(density, "the density")?.unwrap_or(f64::NAN),
            thickness: number(thickness, "the thickness")?.unwrap_or(1.0),
            conductivity: number(conductivity, "the conductivity")?,
            fibres: fibres.transpose()?.unwrap_or_default(),
            lumped: false,
            allow_skew_cells: false,
        })
    }

    /// Adds paths of heat and returns the handle of one, or an array of several.
    pub(crate) fn paths<'py>(
        &mut self,
        py: Python<'py>,
        springs: &Bound<'_, PyAny>,
        partners: &Bound<'_, PyAny>,
        conductance: &Bound<'_, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (elements, is_one) = indices::<Element>(springs, &self.lineage)?;
        let count = elements.len();
        let is_reservoir =
            partners.is_instance_of::<Reservoir>() || partners.is_instance_of::<ReservoirArray>();
        let (partners, is_common) = if is_reservoir {
            let (all, is_common) = indices::<Reservoir>(partners, &self.lineage)?;
            (all.into_iter().map(Partner::Reservoir).collect(), is_common)
        } else {
            let (all, is_common) = indices::<Element>(partners, &self.lineage)?;
            (
                all.into_iter().map(Partner::Element).collect::<Vec<_>>(),
                is_common,
            )
        };
        let partners = if is_common {
            vec![partners[0]; count]
        } else {
            partners
        };
        if partners.len() != count {
            let other = partners.len();
            return Err(error::scene(format!(
                "{count} springs have {other} partners: give one, or one for each"
            )));
        }
        let conductances = input::numbers(conductance, count, "the conductance")?;
        let first = self.lineage.counts[Kind::HeatPath as usize];
        self.act(Act::Paths {
            elements,
            partners,
            conductances,
        })?;
        let own = self.lineage.own;
        Ok(if is_one {
            Bound::new(py, HeatPath::of(own, first))?.into_any()
        } else {
            Bound::new(py, HeatPathArray::of(own, first..first + count))?.into_any()
        })
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

/// How a state at rest was found.
pub(crate) fn as_dict<'py>(
    py: Python<'py>,
    found: &EquilibriumReport,
) -> PyResult<Bound<'py, PyDict>> {
    let report = PyDict::new(py);
    report.set_item("residual", found.residual)?;
    report.set_item("heat", found.heat)?;
    report.set_item("followed", found.followed)?;
    report.set_item("load_steps", found.load_steps)?;
    report.set_item("iterations", found.iterations)?;
    report.set_item("friction_steps", found.friction_steps)?;
    Ok(report)
}

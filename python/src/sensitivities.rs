//! Derivatives along runs: inputs and quantities as Python gives them, and the table as an array.

use eem::{Column, Element, HeatPath, Input, Node, Reservoir, Sensitivities};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyList, PyMapping, PyString, PyTuple};

use crate::built::Parts;
use crate::error;
use crate::function::Function;
use crate::gradient::{Subject, subject};
use crate::handle::{self, indices, one};
use crate::material::Material;
use crate::world::World;

/// An input of a run of any dimension.
enum By {
    /// With its unit, if it has one.
    Parameter(Vec<Element>, [String; 2]),
    Mass(Node),
    Gravity(usize),
    Conductance(HeatPath),
    ReservoirTemperature(Reservoir),
    Position(Node, usize),
    Velocity(Node, usize),
    Temperature(Element),
    ViscousStretch(Element, usize),
    Force(Node, Function),
    Thrust(Node, usize, Function),
    Motion(Node, Function),
    Thermostat(Element, Function),
    Oven(Reservoir, Function),
}

/// An input, and the name and the unit that it was given.
pub(crate) struct Given {
    by: By,
    named: Option<(String, String)>,
}

/// An `eem.Input`: its kind, handle or material or None, name of a parameter, index, function or None, name and unit or None.
type Parsed<'py> = (
    String,
    Bound<'py, PyAny>,
    String,
    usize,
    Option<Py<PyAny>>,
    Option<(String, String)>,
);

impl Given {
    fn of(input: &Bound<'_, PyAny>, world: &World, parts: &Parts) -> PyResult<Self> {
        let Ok(given) = input.getattr("_given") else {
            let kind = input.get_type().name()?;
            let message = format!("an eem.Input is expected, not {kind}");
            return Err(PyTypeError::new_err(message));
        };
        let (kind, of, name, index, function, named): Parsed<'_> = given.extract()?;
        let lineage = &world.lineage;
        let node = || Ok::<_, PyErr>(parts.nodes[one::<handle::Node>(&of, lineage)?]);
        let element = || Ok::<_, PyErr>(parts.elements[one::<handle::Element>(&of, lineage)?]);
        let reservoir =
            || Ok::<_, PyErr>(parts.reservoirs[one::<handle::Reservoir>(&of, lineage)?]);
        let Some(function) = function.map(|one| Function(one.into())) else {
            let by = match &*kind {
                "parameter" => parameter(&of, name, (world, parts))?,
                "mass" => By::Mass(node()?),
                "gravity" => By::Gravity(index),
                "conductance" => {
                    By::Conductance(parts.paths[one::<handle::HeatPath>(&of, lineage)?])
                }
                "reservoir_temperature" => By::ReservoirTemperature(reservoir()?),
                "position" => By::Position(node()?, index),
                "velocity" => By::Velocity(node()?, index),
                "temperature" => By::Temperature(element()?),
                _ => By::ViscousStretch(element()?, index),
            };
            return Ok(Self { by, named });
        };
        let by = match &*kind {
            "force" => By::Force(node()?, function),
            "thrust" => By::Thrust(node()?, index, function),
            "motion" => By::Motion(node()?, function),
            "thermostat" => By::Thermostat(element()?, function),
            _ => By::Oven(reservoir()?, function),
        };
        Ok(Self { by, named })
    }

    /// The input of the library.
    pub(crate) fn input<const D: usize>(&self) -> Input<D> {
        let input = match &self.by {
            By::Parameter(elements, [name, unit]) => {
                let input = Input::parameter_of(elements.iter().copied(), name);
                let shown = input.name();
                input.named(shown, unit)
            }
            By::Mass(node) => Input::mass(*node),
            By::Gravity(axis) => Input::gravity(*axis),
            By::Conductance(path) => Input::conductance(*path),
            By::ReservoirTemperature(reservoir) => Input::reservoir_temperature(*reservoir),
            By::Position(node, axis) => Input::position(*node, *axis),
            By::Velocity(node, axis) => Input::velocity(*node, *axis),
            By::Temperature(element) => Input::temperature(*element),
            By::ViscousStretch(element, dashpot) => Input::viscous_stretch(*element, *dashpot),
            By::Force(node, function) => Input::force(*node, vector(function)),
            By::Thrust(node, rocket, function) => Input::thrust(*node, *rocket, number(function)),
            By::Motion(anchor, function) => Input::motion(*anchor, vector(function)),
            By::Thermostat(element, function) => Input::thermostat(*element, number(function)),
            By::Oven(oven, function) => Input::oven(*oven, number(function)),
        };
        match &self.named {
            Some((name, unit)) => input.named(name, unit),
            None => input,
        }
    }
}

fn number(function: &Function) -> impl Fn(f64) -> f64 + Send + Sync + 'static {
    let function = function.clone();
    move |time| function.number(time)
}

fn vector<const D: usize>(function: &Function) -> impl Fn(f64) -> [f64; D] + Send + Sync + 'static {
    let function = function.clone();
    move |time| function.vector(time)
}

/// A parameter of the springs and points of a material, or of those that are given; one at least.
fn parameter(
    of: &Bound<'_, PyAny>,
    name: String,
    (world, parts): (&World, &Parts),
) -> PyResult<By> {
    let indices = match of.cast::<Material>() {
        Ok(material) => {
            let law = world.law(material)?;
            let all = parts.laws.iter().enumerate();
            all.filter(|(_, own)| **own == law)
                .map(|(index, _)| index)
                .collect()
        }
        Err(_) => indices::<handle::Element>(of, &world.lineage)?.0,
    };
    let Some(&first) = indices.first() else {
        return Err(error::scene(format!(
            "parameter `{name}` of no spring: give one at least"
        )));
    };
    let law = &world.context.laws[parts.laws[first]];
    // `k[3]` is a list of three, `k[0]` one of them.
    let base = |name: &str| name.split('[').next().map(str::to_owned);
    let mut all = law.source().parameters();
    let own = all.find(|(own, _)| base(own) == base(&name));
    let unit = own
        .and_then(|(_, unit)| unit)
        .unwrap_or_default()
        .to_owned();
    let elements = indices.iter().map(|&index| parts.elements[index]);
    Ok(By::Parameter(elements.collect(), [name, unit]))
}

/// The kind of a quantity, its handle or None, and a dashpot.
fn parsed<'py>(given: &Bound<'py, PyAny>) -> PyResult<(String, Bound<'py, PyAny>, usize)> {
    let nothing = given.py().None().into_bound(given.py());
    if given.is_instance_of::<PyString>() {
        return Ok((given.extract()?, nothing, 0));
    }
    let given = given.cast::<PyTuple>()?;
    match given.len() {
        1 => Ok((given.get_item(0)?.extract()?, nothing, 0)),
        2 => {
            let (kind, of) = given.extract()?;
            Ok((kind, of, 0))
        }
        _ => given.extract(),
    }
}

/// What is to be differentiated by what.
pub(crate) struct Asked {
    pub(crate) inputs: Vec<Given>,
    pub(crate) quantities: Vec<(String, Subject)>,
}

impl Asked {
    /// Of `eem.Input`s, and quantities by name: `"energy"`, or a tuple with a handle, and the number of a dashpot.
    pub(crate) fn of(
        inputs: &Bound<'_, PyList>,
        quantities: &Bound<'_, PyMapping>,
        (world, parts): (&World, &Parts),
    ) -> PyResult<Self> {
        let inputs = inputs.iter();
        let inputs = inputs.map(|input| Given::of(&input, world, parts));
        let quantity = |item: Bound<'_, PyAny>| {
            let (name, given): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item.extract()?;
            let (kind, of, dashpot) = parsed(&given).map_err(|_| {
                PyTypeError::new_err(format!(
                    "{name}: a quantity is \"energy\", (\"position\", node) or (\"viscous_stretch\", spring, dashpot), not {given}"
                ))
            })?;
            let subject = subject((&kind, &of, dashpot), &world.lineage, parts)?;
            Ok((name.extract()?, subject))
        };
        Ok(Self {
            inputs: inputs.collect::<PyResult<_>>()?,
            quantities: quantities
                .items()?
                .iter()
                .map(quantity)
                .collect::<PyResult<_>>()?,
        })
    }

    /// An `eem.Sensitivities`.
    pub(crate) fn into_python(
        self,
        py: Python<'_>,
        inputs: &Bound<'_, PyList>,
        found: &Sensitivities,
        dim: usize,
    ) -> PyResult<Py<PyAny>> {
        let (times, columns) = (found.times(), &found.columns()[1..]);
        let names = PyList::new(py, columns.iter().map(Column::name))?;
        let units = PyList::new(py, columns.iter().map(Column::unit))?;
        let values = columns.iter().flat_map(Column::values).copied();
        let values = PyArray1::from_iter(py, values).reshape([columns.len(), times.len()])?;
        // The name of a quantity, and how many components a vector has.
        let components = self.quantities.into_iter();
        let components =
            components.map(|(name, subject)| (name, subject.is_vector().then_some(dim)));
        let components = PyList::new(py, components)?;
        let class = py.import("eem._sensitivities")?.getattr("Sensitivities")?;
        let times = PyArray1::from_slice(py, times);
        let made = class.call1((times, values, names, units, components, inputs))?;
        Ok(made.unbind())
    }
}

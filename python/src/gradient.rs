//! Gradients of runs: objectives as Python gives them, and derivatives as arrays.

use eem::typed::Law;
use eem::{Element, Gradient, GradientError, Node, Objective, Quantity, Reservoir};
use eem_gradients::Gradients;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::built::Parts;
use crate::handle::{self, Handle, Kind, Lineage};
use crate::world::World;
use crate::{error, input};

/// A quantity that has derivatives.
#[derive(Clone, Copy)]
pub(crate) enum Subject {
    Position(Node),
    Velocity(Node),
    Momentum(Node),
    Stretch(Element),
    Temperature(Element),
    ViscousStretch(Element, usize),
    ReservoirEntropy(Reservoir),
    ReservoirHeat(Reservoir),
    KineticEnergy,
    Energy,
}

/// Their names in Python, in the order of [`Subject`].
pub(crate) const QUANTITIES: [&str; 10] = [
    "position",
    "velocity",
    "momentum",
    "stretch",
    "temperature",
    "viscous_stretch",
    "reservoir_entropy",
    "reservoir_heat",
    "kinetic_energy",
    "energy",
];

/// When a quantity counts.
enum When {
    End,
    At(f64),
    Integral,
    Misfit(Vec<[f64; 3]>),
}

/// A term of an objective.
pub(crate) struct Term {
    factor: f64,
    subject: Subject,
    component: usize,
    when: When,
}

/// A term as `eem._gradient.Objective` keeps it: factor, quantity, handle or None, component, dashpot, `end`, `at`, `integral` or
/// `misfit`, rows of times, data and deviations, and the number of components if there are data of all.
type Given<'py> = (
    f64,
    String,
    Bound<'py, PyAny>,
    Option<usize>,
    usize,
    String,
    Bound<'py, PyAny>,
    Option<usize>,
);

/// The terms of an objective.
pub(crate) fn terms(
    objective: &Bound<'_, PyAny>,
    (lineage, parts, dim): (&Lineage, &Parts, usize),
) -> PyResult<Vec<Term>> {
    let Ok(given) = objective.getattr("_terms") else {
        let kind = objective.get_type().name()?;
        let message = format!("an eem.Objective is expected, not {kind}");
        return Err(PyTypeError::new_err(message));
    };
    let given: Vec<Given<'_>> = given.extract()?;
    let term = |(factor, quantity, of, component, dashpot, when, records, axes): Given<'_>| {
        let subject = subject((&quantity, &of, dashpot), lineage, parts)?;
        if let Some(axes) = axes.filter(|&axes| axes != dim) {
            return Err(error::scene(format!(
                "the data of {quantity} have {axes} components, it has {dim}"
            )));
        }
        let rows = || {
            let rows = input::rows(&records, 3, "records")?;
            Ok::<Vec<[f64; 3]>, PyErr>(rows.as_chunks().0.to_vec())
        };
        let when = match &*when {
            "at" => rows()?
                .first()
                .map_or(When::At(f64::NAN), |&[time, ..]| When::At(time)),
            "integral" => When::Integral,
            "misfit" => When::Misfit(rows()?),
            _ => When::End,
        };
        Ok(Term {
            factor,
            subject,
            component: of_vector(&quantity, subject, component, dim)?,
            when,
        })
    };
    given.into_iter().map(term).collect()
}

/// A quantity with its handle.
pub(crate) fn subject(
    (quantity, of, dashpot): (&str, &Bound<'_, PyAny>, usize),
    lineage: &Lineage,
    parts: &Parts,
) -> PyResult<Subject> {
    if dashpot != 0 && quantity != "viscous_stretch" {
        return Err(error::scene(format!(
            "{quantity} has no dashpots: leave {dashpot} out"
        )));
    }
    if matches!(quantity, "kinetic_energy" | "energy") && !of.is_none() {
        let of = of.repr()?;
        return Err(error::scene(format!(
            "{quantity} is that of the scene: leave {of} out"
        )));
    }
    let node = || of_one::<handle::Node, _>(quantity, of, lineage, &parts.nodes);
    let element = || of_one::<handle::Element, _>(quantity, of, lineage, &parts.elements);
    let reservoir = || of_one::<handle::Reservoir, _>(quantity, of, lineage, &parts.reservoirs);
    Ok(match quantity {
        "position" => Subject::Position(node()?),
        "velocity" => Subject::Velocity(node()?),
        "momentum" => Subject::Momentum(node()?),
        "stretch" => Subject::Stretch(element()?),
        "temperature" => Subject::Temperature(element()?),
        "viscous_stretch" => Subject::ViscousStretch(element()?, dashpot),
        "reservoir_entropy" => Subject::ReservoirEntropy(reservoir()?),
        "reservoir_heat" => Subject::ReservoirHeat(reservoir()?),
        "kinetic_energy" => Subject::KineticEnergy,
        "energy" => Subject::Energy,
        other => {
            return Err(error::scene(format!(
                "there are no derivatives of '{other}': take one of {}",
                QUANTITIES.join(", ")
            )));
        }
    })
}

fn of_one<H: Handle, T: Copy>(
    quantity: &str,
    of: &Bound<'_, PyAny>,
    lineage: &Lineage,
    all: &[T],
) -> PyResult<T> {
    if of.is_none() {
        let name = match H::KIND {
            Kind::Element => "spring",
            Kind::Node => "node",
            _ => "reservoir",
        };
        return Err(error::scene(format!(
            "{quantity} of what? Give its {name} after the name of the quantity"
        )));
    }
    Ok(all[handle::one::<H>(of, lineage)?])
}

/// The component, which has to be given of vectors with several.
fn of_vector(
    quantity: &str,
    subject: Subject,
    component: Option<usize>,
    dim: usize,
) -> PyResult<usize> {
    match component {
        None if subject.is_vector() && dim > 1 => Err(error::scene(format!(
            "{quantity} has {dim} components: say which one, counted from 0, with component="
        ))),
        component => Ok(component.unwrap_or(0)),
    }
}

impl Subject {
    pub(crate) const fn is_vector(self) -> bool {
        matches!(
            self,
            Self::Position(_) | Self::Velocity(_) | Self::Momentum(_)
        )
    }

    pub(crate) const fn quantity<const D: usize>(self) -> Quantity<D> {
        match self {
            Self::Position(node) => Quantity::Position(node),
            Self::Velocity(node) => Quantity::Velocity(node),
            Self::Momentum(node) => Quantity::Momentum(node),
            Self::Stretch(element) => Quantity::Stretch(element),
            Self::Temperature(element) => Quantity::Temperature(element),
            Self::ViscousStretch(element, dashpot) => Quantity::ViscousStretch(element, dashpot),
            Self::ReservoirEntropy(reservoir) => Quantity::ReservoirEntropy(reservoir),
            Self::ReservoirHeat(reservoir) => Quantity::ReservoirHeat(reservoir),
            Self::KineticEnergy => Quantity::KineticEnergy,
            Self::Energy => Quantity::TotalEnergy,
        }
    }
}

/// The objective of terms; at least one.
pub(crate) fn objective<const D: usize>(terms: &[Term]) -> Objective<D> {
    let one = |term: &Term| {
        let quantity = term.subject.quantity();
        let objective = match &term.when {
            When::End => Objective::at_end(quantity),
            When::At(time) => Objective::at(*time, quantity),
            When::Integral => Objective::integral(quantity),
            When::Misfit(records) => Objective::misfit(quantity, records.iter().copied()),
        };
        objective.component(term.component).times(term.factor)
    };
    let all = terms.iter().map(one);
    all.reduce(|sum, term| sum + term)
        .unwrap_or_else(|| Objective::time().times(0.0))
}

/// Derivatives by a function of time: of what, of which, which of its rockets; times and values.
type Series = (&'static str, usize, usize, Vec<f64>, Vec<f64>);

/// Value and derivatives, those of many things one after the other.
pub(crate) struct Found {
    value: f64,
    growth: f64,
    arrays: Vec<(&'static str, Vec<f64>)>,
    /// A line where derivatives are large.
    note: Option<String>,
    /// Why there are none by the sizes of steps.
    timed: Option<String>,
    series: Vec<Series>,
}

/// Finds the gradient of a run.
pub(crate) fn gradient<const D: usize>(
    run: &mut impl Gradients<D>,
    terms: &[Term],
    parts: &Parts,
    laws: &[Law],
) -> Result<Found, GradientError> {
    let gradient = run.find_gradient(&objective(terms))?;
    let (mut positions, mut velocities, mut masses) = (Vec::new(), Vec::new(), Vec::new());
    for &node in &parts.nodes {
        positions.extend_from_slice(gradient.by_position(node)?.as_slice());
        velocities.extend_from_slice(gradient.by_velocity(node)?.as_slice());
        masses.push(gradient.by_mass(node)?);
    }
    let names = laws
        .iter()
        .map(|law| law.parameters().map(|(name, _)| name));
    let names: Vec<Vec<&str>> = names.map(Iterator::collect).collect();
    let (mut temperatures, mut viscous, mut parameters) = (Vec::new(), Vec::new(), Vec::new());
    for (index, &element) in parts.elements.iter().enumerate() {
        temperatures.push(if parts.thermal[index] {
            gradient.by_temperature(element)?
        } else {
            f64::NAN
        });
        for dashpot in 0..parts.dashpots[index] {
            viscous.push(gradient.by_viscous_stretch(element, dashpot)?);
        }
        // Of a law with too many parameters there are none.
        let by = names[parts.laws[index]]
            .iter()
            .map(|name| gradient.by_parameter(element, name));
        parameters.extend(by.map(|by| by.unwrap_or(f64::NAN)));
    }
    let conductances = parts
        .paths
        .iter()
        .map(|&path| gradient.by_conductance(path));
    let reservoirs = parts.reservoirs.iter();
    let reservoirs = reservoirs.map(|&one| gradient.by_reservoir_temperature(one));
    let (times, sizes) = gradient
        .by_step_size_at_kept_loads()
        .iter()
        .copied()
        .unzip();
    let shown = gradient.to_string();
    Ok(Found {
        value: gradient.value(),
        growth: gradient.growth(),
        arrays: vec![
            ("position", positions),
            ("velocity", velocities),
            ("mass", masses),
            ("temperature", temperatures),
            ("viscous_stretch", viscous),
            ("parameters", parameters),
            ("conductance", conductances.collect::<Result<_, _>>()?),
            (
                "reservoir_temperature",
                reservoirs.collect::<Result<_, _>>()?,
            ),
            ("gravity", gradient.by_gravity().as_slice().to_vec()),
            ("times", times),
            ("step_size", sizes),
        ],
        note: shown
            .lines()
            .find(|line| !line.starts_with('|'))
            .map(str::to_owned),
        timed: gradient.by_step_size().err().map(|error| error.to_string()),
        series: series(&gradient, parts),
    })
}

/// All derivatives by functions of time.
fn series<const D: usize>(gradient: &Gradient<D>, parts: &Parts) -> Vec<Series> {
    let mut all = Vec::new();
    for (index, &node) in parts.nodes.iter().enumerate() {
        let vectors = [
            ("force", gradient.by_force(node)),
            ("motion", gradient.by_motion(node)),
        ];
        for (of, series) in vectors {
            if let Ok(series) = series {
                let values = series.iter().flat_map(|(_, by)| by.iter().copied());
                let times = series.iter().map(|&(time, _)| time);
                all.push((of, index, 0, times.collect(), values.collect()));
            }
        }
        let rockets = (0..).map_while(|rocket| gradient.by_thrust(node, rocket).ok());
        for (rocket, series) in rockets.enumerate() {
            let (times, values) = series.iter().copied().unzip();
            all.push(("thrust", index, rocket, times, values));
        }
    }
    let held = parts
        .elements
        .iter()
        .map(|&one| gradient.by_thermostat(one));
    let ovens = parts.reservoirs.iter().map(|&one| gradient.by_oven(one));
    let held = held.enumerate().map(|one| ("thermostat", one));
    for (of, (index, series)) in held.chain(ovens.enumerate().map(|one| ("oven", one))) {
        if let Ok(series) = series {
            let (times, values) = series.iter().copied().unzip();
            all.push((of, index, 0, times, values));
        }
    }
    all
}

impl Found {
    /// An `eem.Gradient`.
    pub(crate) fn into_python(
        self,
        py: Python<'_>,
        world: &World,
        parts: &Parts,
    ) -> PyResult<Py<PyAny>> {
        let dim = world.dim;
        let (arrays, series) = (PyDict::new(py), PyDict::new(py));
        for (name, values) in self.arrays {
            let rows = values.len() / dim;
            let array = PyArray1::from_vec(py, values);
            if matches!(name, "position" | "velocity") {
                arrays.set_item(name, array.reshape([rows, dim])?)?;
            } else {
                arrays.set_item(name, array)?;
            }
        }
        for (of, index, rocket, times, values) in self.series {
            let count = times.len();
            let times = PyArray1::from_vec(py, times);
            let values = PyArray1::from_vec(py, values);
            let key = (of, index, rocket);
            if matches!(of, "force" | "motion") {
                series.set_item(key, (times, values.reshape([count, dim])?))?;
            } else {
                series.set_item(key, (times, values))?;
            }
        }
        let materials = PyList::new(py, world.materials.iter().map(|one| one.bind(py)))?;
        let laws = parts.laws.iter().map(|&law| law.cast_signed() as i64);
        let laws = PyArray1::from_iter(py, laws);
        let class = py.import("eem._gradient")?.getattr("Gradient")?;
        let shown = (self.value, self.growth, self.note, self.timed);
        let made = class.call1((
            shown,
            arrays,
            series,
            world.lineage.clone(),
            materials,
            laws,
        ))?;
        Ok(made.unbind())
    }
}

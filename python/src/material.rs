//! `eem.Material`: a free energy as text, with values for its parameters.

use eem::typed::{Law, LawError, Source, compile};
use numpy::{PyArray1, PyArrayDyn, PyArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyString, PyTuple, PyType};

use crate::{error, input};

/// A material: its Helmholtz free energy ψ as text, viscosities, and values of its parameters, with units or without.
///
/// The arguments of ψ have roles: `Stretch` is the length of the spring in m, `Viscous` the extension of a dashpot in
/// series, `Temperature` in K. ψ of a solid is per volume, in J/m³, and has strains: `StrainTrace`, `StrainSquare`,
/// `Dilatation`. A viscosity is given for each dashpot in series by its name, or for the stretch, which is
/// a dashpot beside the spring. A parameter is a number, a list of numbers (`k[0]` in the text), or a pair of these and a
/// unit; if one has a unit, all have one, and the units of the formulas are checked.
///
/// >>> import eem
/// >>> spring = eem.Material("|x: Stretch| 0.5 * k * (x - l).powi(2)", k=(4.0, "N/m"), l=(1.0, "m"))
/// >>> spring.psi([[1.5], [2.0]])
/// array([0.5, 2. ])
/// >>> spring.formulas.get('f').equation
/// 'f = ∂ψ/∂x = k*(x - l)'
#[pyclass(frozen, module = "eem")]
pub(crate) struct Material {
    pub(crate) law: Law,
}

/// A parameter as Python gives it: one value, or those of an array.
struct Given {
    name: String,
    values: Vec<f64>,
    is_array: bool,
    unit: Option<String>,
}

impl Given {
    /// `value`, `[values]`, `(value, unit)` or `([values], unit)`.
    fn new(name: &str, given: &Bound<'_, PyAny>) -> PyResult<Self> {
        let (value, unit) = match given.cast::<PyTuple>() {
            Ok(pair) if pair.len() == 2 && pair.get_item(1)?.is_instance_of::<PyString>() => {
                (pair.get_item(0)?, Some(pair.get_item(1)?.extract()?))
            }
            _ => (given.clone(), None),
        };
        if value.is_instance_of::<PyString>() {
            return Err(PyTypeError::new_err(format!(
                "parameter `{name}` is text: give a number, or a pair of a number and a unit, such as (100.0, \"J\")"
            )));
        }
        let what = format!("parameter `{name}`");
        let array = input::array(&value, &what);
        let array = array.map_err(|error| finite_only(given.py(), error))?;
        if array.shape.len() > 1 {
            return Err(error::material(format!(
                "{what} has {} dimensions, a number or a list is expected",
                array.shape.len()
            )));
        }
        Ok(Self {
            name: name.to_owned(),
            is_array: array.shape.len() == 1,
            values: array.values,
            unit,
        })
    }

    fn declared(&self) -> String {
        if self.is_array {
            format!("{}[{}]", self.name, self.values.len())
        } else {
            self.name.clone()
        }
    }

    fn named_values(&self) -> impl Iterator<Item = (String, f64)> {
        let values = self.values.iter().enumerate();
        values.map(|(index, &value)| {
            let name = if self.is_array {
                format!("{}[{index}]", self.name)
            } else {
                self.name.clone()
            };
            (name, value)
        })
    }
}

/// A number of a material that is not finite is a mistake of the material.
fn finite_only(py: Python<'_>, error: PyErr) -> PyErr {
    let is_scene = |class: &Bound<'_, PyAny>| error.matches(py, class).unwrap_or(false);
    let class = py
        .import("eem._errors")
        .and_then(|module| module.getattr("SceneError"));
    match class {
        Ok(class) if is_scene(&class) => error::material(error.value(py).to_string()),
        _ => error,
    }
}

fn given(values: &Bound<'_, PyDict>) -> PyResult<Vec<Given>> {
    let all = values.iter();
    let all = all.map(|(name, value)| Given::new(name.extract()?, &value));
    all.collect()
}

fn as_pairs(given: &[Given]) -> Vec<(String, f64)> {
    given.iter().flat_map(Given::named_values).collect()
}

fn as_refs(values: &[(String, f64)]) -> Vec<(&str, f64)> {
    values
        .iter()
        .map(|(name, value)| (name.as_str(), *value))
        .collect()
}

impl Material {
    fn compiled(
        py: Python<'_>,
        source: &Source,
        values: &[(String, f64)],
        name: Option<&str>,
    ) -> PyResult<Self> {
        let law = py.detach(|| {
            let compiled = compile(source).map_err(|faults| error::faults(&faults))?;
            let law = Law::new(compiled, &as_refs(values)).map_err(error::law)?;
            match law.check_spring() {
                Ok(()) | Err(LawError::Solid) => {}
                Err(error) => return Err(error::law(error)),
            }
            match name {
                Some(name) => law.named(name).map_err(error::law),
                None => Ok(law),
            }
        })?;
        Ok(Self { law })
    }

    /// The same with other values.
    pub(crate) fn with(&self, values: &Bound<'_, PyDict>) -> PyResult<Law> {
        let given = given(values)?;
        if let Some(one) = given.iter().find(|one| one.unit.is_some()) {
            let name = &one.name;
            let message = format!("parameter `{name}` has its unit already: give the value only");
            return Err(error::material(message));
        }
        let values = as_pairs(&given);
        self.law.with_values(&as_refs(&values)).map_err(error::law)
    }

    /// Rows of states, and whether there was only one.
    fn states(&self, x: &Bound<'_, PyAny>) -> PyResult<(Vec<f64>, Vec<usize>)> {
        let arguments = self.law.compiled().arguments();
        let array = input::array(x, "the state")?;
        let columns = arguments.len();
        let fits = array.shape.last() == Some(&columns);
        let is_number = columns == 1 && array.shape.is_empty();
        if !(fits || is_number) {
            let names: Vec<_> = arguments.iter().map(|argument| &*argument.name).collect();
            return Err(error::scene(format!(
                "the state has the shape {:?}, a last axis of {columns} is expected: {}",
                array.shape,
                names.join(", ")
            )));
        }
        Ok((array.values, array.shape))
    }
}

/// What a pickle contains.
type State = (
    String,
    Vec<(String, String)>,
    Vec<(String, Option<String>)>,
    Vec<(String, f64)>,
    String,
);

#[pymethods]
impl Material {
    #[new]
    #[pyo3(signature = (psi, /, *, viscosity=None, parameters=None, name=None, **values))]
    fn make(
        py: Python<'_>,
        psi: &str,
        viscosity: Option<&Bound<'_, PyDict>>,
        parameters: Option<&Bound<'_, PyDict>>,
        name: Option<&str>,
        values: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let mut all = Vec::new();
        for some in [parameters, values].into_iter().flatten() {
            all.extend(given(some)?);
        }
        let mut source = Source::new(psi);
        for (dashpot, law) in viscosity.into_iter().flatten() {
            source = source.viscosity(dashpot.extract::<String>()?, law.extract::<String>()?);
        }
        for one in &all {
            source = source.parameter(one.declared(), one.unit.as_deref());
        }
        Self::compiled(py, &source, &as_pairs(&all), name)
    }

    #[classmethod]
    fn _restored(
        class: &Bound<'_, PyType>,
        psi: String,
        viscosities: Vec<(String, String)>,
        parameters: Vec<(String, Option<String>)>,
        values: Vec<(String, f64)>,
        name: &str,
    ) -> PyResult<Self> {
        let mut source = Source::new(psi);
        for (dashpot, law) in viscosities {
            source = source.viscosity(dashpot, law);
        }
        for (parameter, unit) in parameters {
            source = source.parameter(parameter, unit.as_deref());
        }
        Self::compiled(class.py(), &source, &values, Some(name))
    }

    fn __reduce__(slf: &Bound<'_, Self>) -> PyResult<(Py<PyAny>, State)> {
        let law = &slf.get().law;
        let source = law.source();
        let owned = |(a, b): (&str, &str)| (a.to_owned(), b.to_owned());
        let parameters = source.parameters();
        let parameters = parameters.map(|(name, unit)| (name.to_owned(), unit.map(str::to_owned)));
        let values = law
            .parameters()
            .map(|(name, value)| (name.to_owned(), value));
        let state = (
            source.free_energy().to_owned(),
            source.viscosities().map(owned).collect(),
            parameters.collect(),
            values.collect(),
            law.name().to_owned(),
        );
        Ok((slf.get_type().getattr("_restored")?.unbind(), state))
    }

    fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __deepcopy__(slf: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        slf
    }

    /// The same with other values of some parameters; the texts are not read again.
    #[pyo3(signature = (**values))]
    fn replace(&self, values: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let law = match values {
            Some(values) => self.with(values)?,
            None => self.law.clone(),
        };
        Ok(Self { law })
    }

    /// The name that messages show.
    #[getter]
    fn name(&self) -> &'static str {
        self.law.name()
    }

    /// The text of the free energy.
    #[getter]
    fn text(&self) -> &str {
        self.law.source().free_energy()
    }

    /// The viscosities by name.
    #[getter]
    fn viscosity<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for (name, law) in self.law.source().viscosities() {
            all.set_item(name, law)?;
        }
        Ok(all)
    }

    /// The values of the parameters, entries of arrays one by one.
    #[getter]
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for (name, value) in self.law.parameters() {
            all.set_item(name, value)?;
        }
        Ok(all)
    }

    /// The units of the parameters; None where none was given.
    #[getter]
    fn units<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for (name, unit) in self.law.source().parameters() {
            all.set_item(name.split('[').next(), unit)?;
        }
        Ok(all)
    }

    /// Name, role and unit of the arguments, in the order of the state.
    #[getter]
    fn arguments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let class = py.import("eem._formulas")?.getattr("Argument")?;
        let all = self.law.compiled().arguments();
        let all = all
            .iter()
            .map(|one| class.call1((&one.name, one.role, &one.unit)));
        PyList::new(py, all.collect::<PyResult<Vec<_>>>()?)
    }

    /// ψ and what follows from it, by symbol: the equation and its unit.
    #[getter]
    fn formulas<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let class = py.import("eem._formulas")?.getattr("Formula")?;
        let formulas = PyDict::new(py);
        for one in self.law.compiled().formulas() {
            let formula = class.call1((&one.symbol, &one.equation, &one.unit))?;
            formulas.set_item(&one.symbol, formula)?;
        }
        Ok(formulas)
    }

    /// ψ of states of the shape (..., variables), in the order of `arguments`, J: an array of the shape (...), or a number.
    fn psi<'py>(&self, py: Python<'py>, x: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let (states, mut shape) = self.states(x)?;
        let found = py
            .detach(|| self.law.free_energies(&states))
            .map_err(error::law)?;
        shape.pop();
        let array: Bound<'py, PyArrayDyn<f64>> = PyArray1::from_vec(py, found).reshape(shape)?;
        // A number instead of an array without axes.
        array.get_item(PyTuple::empty(py))
    }

    /// The derivatives of ψ by the variables at states of the shape (..., variables): force, less the forces of the dashpots,
    /// less the entropy.
    fn gradient<'py>(
        &self,
        py: Python<'py>,
        x: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let (states, shape) = self.states(x)?;
        let found = py
            .detach(|| self.law.gradients(&states))
            .map_err(error::law)?;
        PyArray1::from_vec(py, found).reshape(shape)
    }

    fn _repr_latex_(slf: &Bound<'_, Self>) -> PyResult<String> {
        let latex = slf.py().import("eem._formulas")?.getattr("latex")?;
        latex.call1((slf.getattr("formulas")?,))?.extract()
    }

    fn __repr__(&self) -> String {
        let parameters: Vec<_> = self
            .law
            .parameters()
            .map(|(name, value)| format!("{name}={value:?}"))
            .collect();
        let name = match self.law.name() {
            "Law" => String::new(),
            name => format!("name={name:?}, "),
        };
        format!(
            "Material({:?}, {name}{})",
            self.text(),
            parameters.join(", ")
        )
    }
}

//! `Scene.study`: the cost and the accuracy of schemes for a scene.

use std::cell::RefCell;
use std::ops::ControlFlow;

use eem::{
    Advice, Scene, Setting, StateQuantity, Statement, Study, StudyError, StudyReport, StudyRow,
};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyMapping};

use crate::function::take_raised;
use crate::setting::scheme;
use crate::watch::check_signals;
use crate::world::World;
use crate::{error, input};

/// The names of the kinds of quantities, in the order of [`StateQuantity::ALL`].
pub(crate) const KINDS: [&str; 4] = ["q", "p", "theta", "gamma"];

/// The accuracies that a report has recommendations for, if none are given.
const ACCURACIES: [f64; 3] = [1e-2, 1e-4, 1e-6];

/// What was asked for.
pub(crate) struct Plan {
    duration: f64,
    settings: Vec<Setting>,
    accuracies: Vec<f64>,
    repeats: usize,
    refinement: u32,
}

impl Plan {
    /// With the usual accuracies if none are given; each setting is timed `repeats` times.
    pub(crate) fn new(
        duration: f64,
        settings: Vec<Setting>,
        accuracies: Option<&Bound<'_, PyAny>>,
        (repeats, refinement): (usize, u32),
    ) -> PyResult<Self> {
        Ok(Self {
            duration,
            settings,
            accuracies: input::list(accuracies, "accuracies")?.unwrap_or(ACCURACIES.to_vec()),
            repeats,
            refinement,
        })
    }

    /// Runs everything, without the interpreter. An exception of a function of time, or of the handler of a signal, ends it.
    pub(crate) fn run<const D: usize>(&self, scene: &Scene<D>) -> PyResult<StudyReport> {
        let raised = RefCell::new(None);
        let watch = |_, _| match take_raised().or_else(|| Python::attach(check_signals).err()) {
            Some(error) => {
                raised.replace(Some(error));
                ControlFlow::Break(())
            }
            None => ControlFlow::Continue(()),
        };
        _ = take_raised();
        let found = Study::new(|| scene.clone(), self.duration)
            .settings(self.settings.iter().copied())
            .accuracies(self.accuracies.iter().copied())
            .repeats(self.repeats)
            .refinement(self.refinement)
            .watch(watch)
            .run();
        match raised.into_inner().or_else(take_raised) {
            Some(error) => Err(error),
            None => found.map_err(refusal),
        }
    }

    /// The same of any scene, as an `eem.StudyReport`.
    pub(crate) fn into_python(self, py: Python<'_>, world: &World) -> PyResult<Py<PyAny>> {
        let report = py.detach(|| world.scene.study(&self))?;
        let module = py.import("eem._study")?;
        let class = module.getattr("StudyRow")?;
        let rows = report.rows.iter().map(|row| {
            let fields = fields(py, row)?;
            class.call((), Some(&fields))
        });
        let rows = PyList::new(py, rows.collect::<PyResult<Vec<_>>>()?)?;
        let found = Bound::new(py, Studied { report })?;
        let made = module
            .getattr("StudyReport")?
            .call1((self.duration, rows, found))?;
        Ok(made.unbind())
    }
}

fn refusal(error: StudyError) -> PyErr {
    error::scene(error.to_string())
}

/// The fields of an `eem.StudyRow`.
fn fields<'py>(py: Python<'py>, row: &StudyRow) -> PyResult<Bound<'py, PyDict>> {
    let (fields, refused) = (PyDict::new(py), PyDict::new(py));
    fields.set_item("scheme", row.setting.scheme.name())?;
    fields.set_item("step", row.setting.step())?;
    fields.set_item("tolerance", row.setting.tolerance())?;
    for (name, quantity) in KINDS.into_iter().zip(StateQuantity::ALL) {
        let statement = row.statement(quantity);
        fields.set_item(format!("error_{name}"), statement.stated())?;
        if let Statement::Refused { difference, doubt } = statement {
            refused.set_item(name, (difference, doubt))?;
        }
    }
    fields.set_item("largest_error", row.largest_error().stated())?;
    fields.set_item("refused", refused)?;
    fields.set_item("energy_defect", row.energy_defect)?;
    fields.set_item("step_bound", row.step_bound)?;
    fields.set_item("least_entropy_change", row.least_entropy_change)?;
    fields.set_item("steps", row.steps)?;
    fields.set_item("rejected", row.rejected)?;
    fields.set_item("iterations", row.iterations)?;
    fields.set_item("evaluations", row.evaluations)?;
    fields.set_item("seconds", row.seconds)?;
    fields.set_item("median_seconds", row.median_seconds)?;
    fields.set_item("setup_seconds", row.setup_seconds)?;
    let failure = row.failure.as_ref().map(|error| error::step(error, None));
    fields.set_item("failure", failure)?;
    Ok(fields)
}

/// The report of the library, which an `eem.StudyReport` asks.
#[pyclass(frozen, module = "eem._eem")]
pub(crate) struct Studied {
    report: StudyReport,
}

/// An advice: in words; the numbers of the rows that are the fastest, the fastest that keeps the laws, and the closest if none is
/// accurate enough; the quantity in which the references differ too much, and by how much.
type Advised = (String, [Option<usize>; 3], Option<(&'static str, f64)>);

impl Studied {
    /// The number of a row.
    fn place(&self, row: &StudyRow) -> Option<usize> {
        let rows = &self.report.rows;
        rows.iter().position(|own| std::ptr::eq(own, row))
    }
}

#[pymethods]
impl Studied {
    /// The numbers of the rows that no other one beats in both time and error.
    fn front(&self) -> Vec<usize> {
        let front = self.report.front();
        front.iter().filter_map(|row| self.place(row)).collect()
    }

    /// The observed order of a scheme.
    #[pyo3(name = "order")]
    fn order_of(&self, scheme: &str, quantity: &str) -> PyResult<Option<f64>> {
        let scheme = self::scheme(scheme)?;
        Ok(self.report.order(scheme, kind(quantity)?))
    }

    /// What to take for an accuracy.
    fn recommend(&self, accuracy: f64, quantities: Vec<String>) -> PyResult<Advised> {
        let quantities: Vec<_> = quantities
            .iter()
            .map(|name| kind(name))
            .collect::<PyResult<_>>()?;
        let found = if quantities == StateQuantity::ALL {
            self.report.recommend(accuracy)
        } else {
            self.report.recommend_for(&quantities, accuracy)
        };
        let found = found.map_err(refusal)?;
        let place = |row: Option<&StudyRow>| row.and_then(|row| self.place(row));
        let (rows, refused) = match found.advice {
            Advice::Take { fastest, lawful } => ([place(Some(fastest)), place(lawful), None], None),
            Advice::NoneReaches { closest } => ([None, None, place(closest)], None),
            Advice::Refused { quantity, doubt } => {
                let all = KINDS.into_iter().zip(StateQuantity::ALL);
                let mut own = all.filter(|(_, kind)| *kind == quantity);
                ([None; 3], own.next().map(|(name, _)| (name, doubt)))
            }
            _ => ([None; 3], None),
        };
        Ok((in_python(&found.to_string()), rows, refused))
    }

    /// A line with heads, and one for each row.
    fn csv(&self) -> String {
        let heads = StudyReport::CSV_HEADS.map(str::to_owned);
        let lines = std::iter::once(heads).chain(self.report.csv_rows());
        lines.map(|cells| cells.join(",") + "\n").collect()
    }

    fn __str__(&self) -> String {
        in_python(&self.report.to_string())
    }
}

/// Without what only programs of the library can do.
fn in_python(text: &str) -> String {
    text.replace(
        ", end the runs earlier, or give references of your own",
        ", or end the runs earlier",
    )
}

/// The kind of quantity with this name.
fn kind(name: &str) -> PyResult<StateQuantity> {
    let mut all = KINDS.into_iter().zip(StateQuantity::ALL);
    let own = all.find(|(own, _)| *own == name);
    own.map(|(_, kind)| kind).ok_or_else(|| {
        let known = KINDS.join(", ");
        error::scene(format!(
            "a study has no errors of {name:?}: take one of {known}"
        ))
    })
}

/// Settings: each scheme with each step, then with each tolerance; or `{scheme: {"steps": …, "tolerances": …}}`.
pub(crate) fn settings(
    schemes: &Bound<'_, PyAny>,
    steps: Option<&Bound<'_, PyAny>>,
    tolerances: Option<&Bound<'_, PyAny>>,
) -> PyResult<Vec<Setting>> {
    let mut settings = Vec::new();
    if let Ok(schemes) = schemes.cast::<PyMapping>() {
        if steps.or(tolerances).is_some() {
            return Err(error::scene(
                "each scheme has its own steps or tolerances: leave out steps= and tolerances=",
            ));
        }
        for item in schemes.items()? {
            let (name, own): (String, Bound<'_, PyAny>) = item.extract()?;
            let Ok(own) = own.cast_into::<PyMapping>() else {
                return Err(error::scene(format!(
                    "{name}: give {{\"steps\": …}}, {{\"tolerances\": …}} or both"
                )));
            };
            let mut lists = [None, None];
            for item in own.items()? {
                let (key, list): (String, Bound<'_, PyAny>) = item.extract()?;
                match &*key {
                    "steps" => lists[0] = Some(list),
                    "tolerances" => lists[1] = Some(list),
                    _ => {
                        let message = format!("{name} has no {key:?}: give steps or tolerances");
                        return Err(error::scene(message));
                    }
                }
            }
            add_settings(&mut settings, name, lists.each_ref().map(Option::as_ref))?;
        }
    } else {
        let names: Vec<String> = match schemes.extract() {
            Ok(name) => vec![name],
            Err(_) => schemes.extract()?,
        };
        for name in names {
            add_settings(&mut settings, name, [steps, tolerances])?;
        }
    }
    if settings.is_empty() {
        return Err(error::scene(
            "there is nothing to run: give schemes, and steps= or tolerances=",
        ));
    }
    Ok(settings)
}

/// Adds those of one scheme.
fn add_settings(
    settings: &mut Vec<Setting>,
    name: String,
    [steps, tolerances]: [Option<&Bound<'_, PyAny>>; 2],
) -> PyResult<()> {
    let scheme = scheme(&name)?;
    let steps = input::list(steps, "steps")?.unwrap_or_default();
    let tolerances = input::list(tolerances, "tolerances")?.unwrap_or_default();
    let (steps, tolerances) = (steps.into_iter(), tolerances.into_iter());
    settings.extend(steps.map(|step| Setting::fixed(scheme, step)));
    settings.extend(tolerances.map(|relative| Setting::controlled(scheme, relative)));
    Ok(())
}

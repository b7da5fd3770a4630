//! Numbers from Python: anything that `numpy.asarray` takes, refused if it has another shape or is not finite.

use numpy::{PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::IntoPyDict;

use crate::error;

/// An array of any shape.
pub(crate) struct Array {
    pub(crate) shape: Vec<usize>,
    pub(crate) values: Vec<f64>,
}

/// Finite numbers, whatever their shape is.
pub(crate) fn array(given: &Bound<'_, PyAny>, what: &str) -> PyResult<Array> {
    let py = given.py();
    let options = [("dtype", "float64"), ("order", "C")].into_py_dict(py)?;
    let array = py
        .import("numpy")?
        .call_method("asarray", (given,), Some(&options))?;
    let array: PyReadonlyArrayDyn<'_, f64> = array.extract()?;
    let values = array.as_slice()?.to_vec();
    let shape = array.shape().to_vec();
    if let Some(place) = values.iter().position(|value| !value.is_finite()) {
        let (value, at) = (values[place], placed(place, &shape));
        return Err(error::scene(format!(
            "{what}{at} is {value}, it must be finite"
        )));
    }
    Ok(Array { shape, values })
}

/// `[2, 0]` of a place in an array, nothing of a number.
fn placed(mut place: usize, shape: &[usize]) -> String {
    if shape.is_empty() {
        return String::new();
    }
    let mut indices = Vec::new();
    for length in shape.iter().rev() {
        indices.insert(0, place % length);
        place /= length;
    }
    format!("{indices:?}")
}

fn refuse<T>(what: &str, shape: &[usize], expected: &str) -> PyResult<T> {
    let shape = match shape {
        [] => "a number".to_owned(),
        [one] => format!("({one},)"),
        all => format!(
            "({})",
            all.iter()
                .map(usize::to_string)
                .collect::<Vec<_>>()
                .join(", ")
        ),
    };
    Err(error::scene(format!(
        "{what} has the shape {shape}, {expected} is expected"
    )))
}

/// A vector of this length.
pub(crate) fn vector(given: &Bound<'_, PyAny>, length: usize, what: &str) -> PyResult<Vec<f64>> {
    let array = array(given, what)?;
    if array.shape == [length] {
        return Ok(array.values);
    }
    refuse(what, &array.shape, &format!("({length},)"))
}

/// A number.
pub(crate) fn number(given: &Bound<'_, PyAny>, what: &str) -> PyResult<f64> {
    let array = array(given, what)?;
    match array.shape[..] {
        [] => Ok(array.values[0]),
        _ => refuse(what, &array.shape, "a number"),
    }
}

/// A list of numbers.
pub(crate) fn list(given: Option<&Bound<'_, PyAny>>, what: &str) -> PyResult<Option<Vec<f64>>> {
    let Some(given) = given else {
        return Ok(None);
    };
    let array = array(given, what)?;
    match array.shape[..] {
        [_] => Ok(Some(array.values)),
        _ => refuse(what, &array.shape, "(n,)"),
    }
}

/// The end of a run, or the times of its states.
pub(crate) fn times(until: Option<f64>, times: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<f64>> {
    let (name, times) = match (until, times) {
        (Some(until), None) => ("until", vec![until]),
        (None, Some(times)) => {
            let array = array(times, "times")?;
            if array.shape.len() != 1 || array.values.is_empty() {
                return Err(error::scene("times are a list of at least one number"));
            }
            ("times", array.values)
        }
        _ => {
            return Err(error::scene(
                "give the end `until`, or the `times` of the states",
            ));
        }
    };
    match times.iter().find(|time| !time.is_finite()) {
        Some(time) => Err(error::scene(format!(
            "`{name}`: a time is {time} s, where no run would end; it must be finite"
        ))),
        None => Ok(times),
    }
}

/// Rows of this many indices, `(n, length)`, which are whole numbers from 0 on.
pub(crate) fn indices(given: &Bound<'_, PyAny>, length: usize, what: &str) -> PyResult<Vec<usize>> {
    let py = given.py();
    let whole = [("casting", "same_kind")].into_py_dict(py)?;
    let array = py.import("numpy")?.call_method1("asarray", (given,))?;
    let array = array.call_method("astype", ("int64",), Some(&whole))?;
    let array = py
        .import("numpy")?
        .call_method1("ascontiguousarray", (array,))?;
    let array: PyReadonlyArrayDyn<'_, i64> = array.extract()?;
    match array.shape() {
        [_, columns] if *columns == length => {}
        shape => return refuse(what, shape, &format!("(n, {length})")),
    }
    let all = array.as_slice()?.iter().enumerate();
    all.map(|(place, &index)| {
        usize::try_from(index).map_err(|_| {
            let at = placed(place, array.shape());
            error::scene(format!("{what}{at} is {index}, it is counted from 0"))
        })
    })
    .collect()
}

/// As many vectors as there are, `(n, length)`.
pub(crate) fn rows(given: &Bound<'_, PyAny>, length: usize, what: &str) -> PyResult<Vec<f64>> {
    let array = array(given, what)?;
    match array.shape[..] {
        [_, columns] if columns == length => Ok(array.values),
        _ => refuse(what, &array.shape, &format!("(n, {length})")),
    }
}

/// One number for each of `count`, or one for all.
pub(crate) fn numbers(given: &Bound<'_, PyAny>, count: usize, what: &str) -> PyResult<Vec<f64>> {
    let array = array(given, what)?;
    match array.shape[..] {
        [] => Ok(vec![array.values[0]; count]),
        [own] if own == count => Ok(array.values),
        _ => refuse(what, &array.shape, &format!("({count},) or a number")),
    }
}

/// A vector for each of `count`, or one for all.
pub(crate) fn vectors(
    given: &Bound<'_, PyAny>,
    [count, length]: [usize; 2],
    what: &str,
) -> PyResult<Vec<f64>> {
    let array = array(given, what)?;
    match array.shape[..] {
        [own] if own == length => Ok(array.values.repeat(count)),
        [own, columns] if own == count && columns == length => Ok(array.values),
        _ => refuse(
            what,
            &array.shape,
            &format!("({count}, {length}) or ({length},)"),
        ),
    }
}

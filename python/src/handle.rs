//! Handles as Python sees them: the scene that gave them, and an index.

use numpy::PyArray1;
use pyo3::PyClass;
use pyo3::exceptions::{PyIndexError, PyTypeError};
use pyo3::prelude::*;
use pyo3::pyclass::boolean_struct::True;
use pyo3::types::{PyIterator, PyList, PySlice};

use crate::error;

/// The kinds of handles, in the order of [`Counts`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Node,
    Element,
    Reservoir,
    HeatPath,
}

impl Kind {
    const fn name(self) -> &'static str {
        match self {
            Self::Node => "node",
            Self::Element => "element",
            Self::Reservoir => "reservoir",
            Self::HeatPath => "path of heat",
        }
    }

    const fn one(self) -> &'static str {
        match self {
            Self::Node => "a node",
            Self::Element => "an element",
            Self::Reservoir => "a reservoir",
            Self::HeatPath => "a path of heat",
        }
    }
}

/// How many of each kind a scene has.
pub(crate) type Counts = [usize; 4];

/// Whose handles a scene knows: its own, and those of the scenes it is a copy of, as far as they were copied.
///
/// Scenes are told apart by random numbers, so that handles can be pickled with them.
#[pyclass(frozen, eq, from_py_object, module = "eem._eem")]
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Lineage {
    pub(crate) own: u64,
    pub(crate) counts: Counts,
    copied: Vec<(u64, Counts)>,
}

/// What a lineage consists of.
type Parts = (u64, Counts, Vec<(u64, Counts)>);

impl Lineage {
    pub(crate) fn new(py: Python<'_>) -> PyResult<Self> {
        Ok(Self {
            own: random(py)?,
            counts: [0; 4],
            copied: Vec::new(),
        })
    }

    /// That of a copy, which has this number.
    pub(crate) fn copy(&self, own: u64) -> Self {
        let mut copied = self.copied.clone();
        copied.push((self.own, self.counts));
        Self {
            own,
            copied,
            ..self.clone()
        }
    }

    /// The index of a handle of this kind, with the number of the scene that gave it.
    pub(crate) fn index(&self, kind: Kind, (scene, index): (u64, usize)) -> PyResult<usize> {
        let own = [(self.own, self.counts)];
        let known = own.iter().chain(&self.copied);
        let known = known.filter(|(known, _)| *known == scene);
        if known
            .clone()
            .any(|(_, counts)| index < counts[kind as usize])
        {
            return Ok(index);
        }
        let name = kind.name();
        Err(error::scene(format!(
            "{name} {index} is of another scene: use the handles that this one returned"
        )))
    }

    /// An index that was given as a number.
    pub(crate) fn number(&self, kind: Kind, index: usize) -> PyResult<usize> {
        let count = self.counts[kind as usize];
        if index < count {
            return Ok(index);
        }
        let name = kind.name();
        Err(error::scene(format!(
            "there is no {name} {index}: the scene has {count}, counted from 0"
        )))
    }
}

/// The number of a scene. Python may go on with another thread meanwhile.
pub(crate) fn random(py: Python<'_>) -> PyResult<u64> {
    let bytes = py.import("os")?.call_method1("urandom", (8,))?;
    Ok(u64::from_ne_bytes(bytes.extract()?))
}

#[pymethods]
impl Lineage {
    #[new]
    fn restored(own: u64, counts: Counts, copied: Vec<(u64, Counts)>) -> Self {
        Self {
            own,
            counts,
            copied,
        }
    }

    fn __reduce__(slf: &Bound<'_, Self>) -> (Py<PyAny>, Parts) {
        let Self {
            own,
            counts,
            copied,
        } = slf.get().clone();
        let class = slf.get_type().into_any().unbind();
        (class, (own, counts, copied))
    }

    /// The index of an element.
    fn element(&self, element: &Element) -> PyResult<usize> {
        self.index(Kind::Element, element.id())
    }

    /// The index of a node.
    fn node(&self, node: &Node) -> PyResult<usize> {
        self.index(Kind::Node, node.id())
    }

    /// The index of a node, or those of several as int64; the same for others below.
    fn nodes<'py>(&self, given: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        places::<Node>(given, self)
    }

    fn elements<'py>(&self, given: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        places::<Element>(given, self)
    }

    fn reservoirs<'py>(&self, given: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        places::<Reservoir>(given, self)
    }

    fn paths<'py>(&self, given: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        places::<HeatPath>(given, self)
    }
}

/// The index of one handle, or those of several.
fn places<'py, H: Handle>(
    given: &Bound<'py, PyAny>,
    lineage: &Lineage,
) -> PyResult<Bound<'py, PyAny>> {
    let (indices, is_one) = indices::<H>(given, lineage)?;
    let indices = indices.into_iter().map(|index| index.cast_signed() as i64);
    let array = PyArray1::from_iter(given.py(), indices);
    if is_one {
        array.get_item(0)
    } else {
        Ok(array.into_any())
    }
}

/// A handle of one kind.
pub(crate) trait Handle: PyClass<Frozen = True> + Sync {
    const KIND: Kind;
    type Array: PyClass<Frozen = True> + Sync;

    fn id(&self) -> (u64, usize);

    fn all(array: &Self::Array) -> (u64, &[usize]);
}

macro_rules! handle {
    ($name:ident, $array:ident, $shown:literal, $array_shown:literal, $doc:literal, $array_doc:literal) => {
        #[doc = $doc]
        #[pyclass(frozen, eq, hash, module = "eem")]
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub(crate) struct $name {
            scene: u64,
            index: usize,
        }

        impl $name {
            pub(crate) const fn of(scene: u64, index: usize) -> Self {
                Self { scene, index }
            }

            pub(crate) const fn id(&self) -> (u64, usize) {
                (self.scene, self.index)
            }
        }

        impl Handle for $name {
            const KIND: Kind = Kind::$name;
            type Array = $array;

            fn id(&self) -> (u64, usize) {
                (self.scene, self.index)
            }

            fn all(array: &$array) -> (u64, &[usize]) {
                (array.scene, &array.indices)
            }
        }

        #[pymethods]
        impl $name {
            /// Made when a handle is read from a pickle.
            #[new]
            fn restored(scene: u64, index: usize) -> Self {
                Self { scene, index }
            }

            /// The number in the order of creation, from 0.
            #[getter]
            fn index(&self) -> usize {
                self.index
            }

            fn __index__(&self) -> usize {
                self.index
            }

            fn __repr__(&self) -> String {
                format!(concat!($shown, "({})"), self.index)
            }

            fn __reduce__(slf: &Bound<'_, Self>) -> (Py<PyAny>, (u64, usize)) {
                (slf.get_type().into_any().unbind(), slf.get().id())
            }
        }

        #[doc = $array_doc]
        #[pyclass(frozen, eq, sequence, module = "eem")]
        #[derive(Clone, Debug, PartialEq, Eq)]
        pub(crate) struct $array {
            scene: u64,
            indices: Vec<usize>,
        }

        impl $array {
            pub(crate) fn of(scene: u64, indices: impl IntoIterator<Item = usize>) -> Self {
                let indices = indices.into_iter().collect();
                Self { scene, indices }
            }
        }

        #[pymethods]
        impl $array {
            /// Made when an array is read from a pickle.
            #[new]
            fn restored(scene: u64, indices: Vec<usize>) -> Self {
                Self { scene, indices }
            }

            /// The numbers in the order of creation, from 0, as int64.
            #[getter]
            fn index<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
                let indices = self.indices.iter();
                PyArray1::from_iter(py, indices.map(|&index| index.cast_signed() as i64))
            }

            fn __len__(&self) -> usize {
                self.indices.len()
            }

            fn __getitem__(&self, py: Python<'_>, at: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
                let scene = self.scene;
                if let Ok(slice) = at.cast::<PySlice>() {
                    let indices = chosen(slice, &self.indices)?;
                    return Ok(Py::new(py, Self { scene, indices })?.into_any());
                }
                let index = at_place(at, &self.indices)?;
                Ok(Py::new(py, $name { scene, index })?.into_any())
            }

            fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
                let scene = self.scene;
                let all = self.indices.iter().map(|&index| $name { scene, index });
                let all = all.map(|handle| Bound::new(py, handle));
                PyList::new(py, all.collect::<PyResult<Vec<_>>>()?)?.try_iter()
            }

            fn __repr__(&self) -> String {
                format!(concat!($array_shown, "({:?})"), Shortened(&self.indices))
            }

            fn __reduce__(slf: &Bound<'_, Self>) -> (Py<PyAny>, (u64, Vec<usize>)) {
                let class = slf.get_type().into_any().unbind();
                (class, (slf.get().scene, slf.get().indices.clone()))
            }
        }
    };
}

handle!(
    Node,
    NodeArray,
    "Node",
    "NodeArray",
    "An anchor or a mass of a scene.",
    "Anchors or masses of a scene."
);
handle!(
    Element,
    ElementArray,
    "Element",
    "ElementArray",
    "A spring of a scene.",
    "Springs of a scene."
);
handle!(
    Reservoir,
    ReservoirArray,
    "Reservoir",
    "ReservoirArray",
    "A reservoir of heat of a scene.",
    "Reservoirs of heat of a scene."
);
handle!(
    HeatPath,
    HeatPathArray,
    "HeatPath",
    "HeatPathArray",
    "A path of heat of a scene.",
    "Paths of heat of a scene."
);

/// At most seven numbers are shown.
struct Shortened<'a>(&'a [usize]);

impl std::fmt::Debug for Shortened<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.0 {
            [a, b, c, .., y, z] if self.0.len() > 7 => {
                write!(f, "[{a}, {b}, {c}, ..., {y}, {z}]")
            }
            all => all.fmt(f),
        }
    }
}

fn chosen(slice: &Bound<'_, PySlice>, indices: &[usize]) -> PyResult<Vec<usize>> {
    let length = isize::try_from(indices.len())?;
    let found = slice.indices(length)?;
    let places = (0..found.slicelength.cast_signed()).map(|k| found.start + k * found.step);
    Ok(places.map(|place| indices[place.cast_unsigned()]).collect())
}

fn at_place(at: &Bound<'_, PyAny>, indices: &[usize]) -> PyResult<usize> {
    let place: isize = at.extract()?;
    let length = indices.len().cast_signed();
    let from_start = if place < 0 { place + length } else { place };
    let index = usize::try_from(from_start)
        .ok()
        .and_then(|place| indices.get(place));
    let missing = || PyIndexError::new_err(format!("{place} is outside of the {length} handles"));
    index.copied().ok_or_else(missing)
}

/// The indices of one handle, of an array of them, or of a sequence of handles and numbers; and whether it is one handle.
pub(crate) fn indices<H: Handle>(
    given: &Bound<'_, PyAny>,
    lineage: &Lineage,
) -> PyResult<(Vec<usize>, bool)> {
    if let Ok(handle) = given.cast::<H>() {
        return Ok((vec![lineage.index(H::KIND, handle.get().id())?], true));
    }
    if let Ok(array) = given.cast::<H::Array>() {
        let (scene, all) = H::all(array.get());
        let own = all
            .iter()
            .map(|&index| lineage.index(H::KIND, (scene, index)));
        return Ok((own.collect::<PyResult<_>>()?, false));
    }
    let Ok(items) = given.try_iter() else {
        let kind = given.get_type().name()?;
        return Err(PyTypeError::new_err(format!(
            "{}, or several, are expected, not {kind}",
            H::KIND.one()
        )));
    };
    let items = items.map(|item| one::<H>(&item?, lineage));
    Ok((items.collect::<PyResult<_>>()?, false))
}

/// The index of a handle, or of a number.
pub(crate) fn one<H: Handle>(given: &Bound<'_, PyAny>, lineage: &Lineage) -> PyResult<usize> {
    if let Ok(handle) = given.cast::<H>() {
        return lineage.index(H::KIND, handle.get().id());
    }
    match given.extract() {
        Ok(number) if !is_handle(given) => lineage.number(H::KIND, number),
        _ => {
            let kind = given.get_type().name()?;
            Err(PyTypeError::new_err(format!(
                "{} is expected, not {kind}",
                H::KIND.one()
            )))
        }
    }
}

/// Handles are numbers for Python; one of another kind is none here.
fn is_handle(given: &Bound<'_, PyAny>) -> bool {
    given.is_instance_of::<Node>()
        || given.is_instance_of::<Element>()
        || given.is_instance_of::<Reservoir>()
        || given.is_instance_of::<HeatPath>()
}

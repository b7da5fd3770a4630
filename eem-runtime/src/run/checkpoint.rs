//! Checkpoints: everything that further steps depend on, bit for bit.

mod entries;
pub(crate) mod error;
mod file;
mod lines;
#[cfg(feature = "serde")]
mod scheme_name;

use crate::algebra::indices;
use crate::element::layout::Shape;
use crate::element::masses::Masses;
use crate::element::state::{Energy, State};
use crate::step::automatic::SchemeSelection;
use crate::step::control::{Controller, StepStatistics, Tolerance};
use crate::step::explicit::SavedExplicit;
use crate::step::newton::NewtonSettings;
use crate::step::scheme::Scheme;
use crate::step::solver::SavedPast;
use eem_material::number::digest::Digest;

pub(crate) use error::expect_count;
pub use error::{FormatError, LoadError, RestoreError};

/// A saved state of a [`Simulation`](crate::Simulation), to resume it later: values with their compensated rounding,
/// time, step size and settings.
///
/// A resumed run has the same bits as one that was never interrupted. The scene is not part of the checkpoint: your
/// program builds it again, with the same materials, masses, conductances and loads. Functions of time must depend on
/// the time only. Digests of all numbers of the scene detect another scene.
///
/// A checkpoint may come from an edited file. [`restore`](crate::Simulation::restore) rejects states that no run can
/// have: entropies that do not match the temperatures, anchors in wrong places, compensations larger than rounding.
/// Work and heat, the history of step control and the rates of the explicit scheme cannot be edited
/// ([`RestoreError::Edited`]).
///
/// [`save`](Self::save) writes it to a file, and [`load`](Self::load) reads it with all bits. With the feature `serde` it can be
/// part of other files, whose format must preserve every bit of a number; `serde_json` does with its feature `float_roundtrip`.
///
/// ```
/// use eem::prelude::*;
///
/// let build = |scheme, step| Simulation::new(Scene::<2>::new(), scheme, step);
/// let mut run = build(Scheme::EemEntropy, 0.1)?;
/// run.step()?;
/// let saved = run.checkpoint();
///
/// let mut later = build(saved.scheme(), 1.0)?;
/// later.restore(&saved)?;
/// later.step()?;
/// assert_eq!((later.time(), later.step_size()), (0.2, 0.1));
/// assert!(build(Scheme::Midpoint, 0.1)?.restore(&saved).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub struct Checkpoint {
    #[cfg_attr(feature = "serde", serde(with = "scheme_name"))]
    pub(crate) scheme: Scheme,
    pub(crate) outline: Outline,
    pub(crate) numbers: Numbers,
    pub(crate) step: f64,
    pub(crate) newton: NewtonSettings,
    /// `None` without step control.
    #[cfg_attr(feature = "serde", serde(default = "Option::default"))]
    pub(crate) control: Option<SavedControl>,
    /// For `Scheme::Auto`.
    #[cfg_attr(
        feature = "serde",
        serde(default = "Option::default", skip_serializing_if = "Option::is_none")
    )]
    pub(crate) choice: Option<SavedChoice>,
    pub(crate) state: State,
    pub(crate) energies: SavedEnergies,
    #[cfg_attr(feature = "serde", serde(default = "SavedLoads::default"))]
    pub(crate) loads: SavedLoads,
    pub(crate) past: SavedPast,
    /// For explicit schemes, which otherwise start again from the state.
    #[cfg_attr(
        feature = "serde",
        serde(default = "Option::default", skip_serializing_if = "Option::is_none")
    )]
    pub(crate) explicit: Option<SavedExplicit>,
    /// Digests of the entries that follow from the steps.
    pub(crate) seals: Vec<Digest>,
}

/// What controllers have set: indices of nodes and elements, and their values in N, m/s and K, component by component.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct SavedLoads {
    pub(crate) forced: Vec<usize>,
    pub(crate) forces: Vec<f64>,
    pub(crate) moved: Vec<usize>,
    pub(crate) velocities: Vec<f64>,
    pub(crate) held: Vec<usize>,
    pub(crate) temperatures: Vec<f64>,
}

/// The energies of the elements as the last step evaluated them. Evaluated again, they would differ by rounding, which
/// would enter the certificate of the next step.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct SavedEnergies {
    /// The digest of the state to which they belong.
    pub(crate) of: Digest,
    pub(crate) list: Vec<Energy>,
}

impl SavedEnergies {
    /// All numbers, element after element.
    fn numbers(&self) -> Vec<f64> {
        let mut numbers = Vec::new();
        for energy in &self.list {
            numbers.extend(energy.numbers());
        }
        numbers
    }
}

/// The history of step control.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct SavedControl {
    pub(crate) tolerance: Tolerance,
    pub(crate) controller: Controller,
    pub(crate) statistics: StepStatistics,
    /// The largest `|p|₂` so far, kg m/s.
    pub(crate) largest_momentum: f64,
    /// The limits of the step size, s; zero if the smallest is not set.
    pub(crate) smallest: f64,
    pub(crate) largest: f64,
}

impl SavedControl {
    /// The history before the first step.
    pub(crate) fn new(tolerance: Tolerance) -> Self {
        Self {
            tolerance,
            controller: Controller::new(),
            statistics: StepStatistics::default(),
            largest_momentum: 0.0,
            smallest: 0.0,
            largest: f64::MAX,
        }
    }
}

/// The scheme in use by `Scheme::Auto`, and the history of its selection.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct SavedChoice {
    #[cfg_attr(feature = "serde", serde(with = "scheme_name"))]
    pub(crate) scheme: Scheme,
    /// The scheme before a trial.
    #[cfg_attr(feature = "serde", serde(with = "scheme_name"))]
    pub(crate) previous: Scheme,
    pub(crate) selection: SchemeSelection,
}

impl Checkpoint {
    /// The scheme of the saved simulation.
    #[must_use]
    pub const fn scheme(&self) -> Scheme {
        self.scheme
    }

    /// The step size of the saved simulation, s.
    #[must_use]
    pub const fn step_size(&self) -> f64 {
        self.step
    }
}

impl Checkpoint {
    /// An error unless it can be a checkpoint of the simulation whose present checkpoint is `simulation`. Elements and anchors
    /// are still to be compared with the scene.
    pub(crate) fn check(&self, simulation: &Self) -> Result<(), RestoreError> {
        if self.scheme != simulation.scheme {
            return Err(RestoreError::Scheme {
                checkpoint: self.scheme,
                simulation: simulation.scheme,
            });
        }
        self.outline.compare(&simulation.outline)?;
        self.numbers.compare(&simulation.numbers)?;
        self.check_numbers(simulation)
    }

    /// The same checkpoint with digests of the entries that follow from the steps.
    pub(crate) fn sealed(mut self) -> Self {
        let digests = self.digests().into_iter();
        self.seals = digests.map(|(_, digest)| digest).collect();
        self
    }
}

/// Nodes, elements and reservoirs, without their values.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct Outline {
    pub(crate) dimensions: usize,
    /// Whether each node is an anchor.
    pub(crate) anchors: Vec<bool>,
    pub(crate) elements: Vec<ElementOutline>,
    pub(crate) reservoirs: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct ElementOutline {
    pub(crate) dashpots: usize,
    pub(crate) thermal: bool,
}

/// Digests of all numbers of a scene that a state does not contain.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct Numbers {
    /// Names and values of the parameters, by element.
    pub(crate) materials: Digest,
    pub(crate) masses: Digest,
    pub(crate) conductances: Digest,
    pub(crate) reservoirs: Digest,
    pub(crate) gravity: Digest,
}

impl Outline {
    pub(crate) fn new(
        dimensions: usize,
        masses: &Masses,
        (places, shapes): (&[[u32; 2]], &[Shape]),
        reservoirs: usize,
    ) -> Self {
        let mut elements = Vec::with_capacity(places.len());
        for &place in places {
            let [group, _] = indices(place);
            elements.push(ElementOutline {
                dashpots: shapes[group].dashpots,
                thermal: shapes[group].thermal,
            });
        }
        Self {
            dimensions,
            anchors: masses.iter().map(|mass| mass.is_none()).collect(),
            elements,
            reservoirs,
        }
    }

    /// An error with the first difference from the outline of a simulation.
    fn compare(&self, simulation: &Self) -> Result<(), RestoreError> {
        expect_count("dimensions", self.dimensions, simulation.dimensions)?;
        expect_count("nodes", self.anchors.len(), simulation.anchors.len())?;
        expect_count("elements", self.elements.len(), simulation.elements.len())?;
        expect_count("reservoirs", self.reservoirs, simulation.reservoirs)?;
        let mut nodes = self.anchors.iter().zip(&simulation.anchors);
        if let Some(node) = nodes.position(|(own, other)| own != other) {
            let is_anchor = self.anchors[node];
            return Err(RestoreError::Node { node, is_anchor });
        }
        let elements = self.elements.iter().zip(&simulation.elements);
        for (element, (own, other)) in elements.enumerate() {
            let (checkpoint, simulation) = (own.dashpots, other.dashpots);
            if checkpoint != simulation {
                return Err(RestoreError::Dashpots {
                    element,
                    checkpoint,
                    simulation,
                });
            }
            let in_checkpoint = own.thermal;
            if in_checkpoint != other.thermal {
                return Err(RestoreError::Temperature {
                    element,
                    in_checkpoint,
                });
            }
        }
        Ok(())
    }
}

impl Numbers {
    /// An error with the first kind of numbers that differ from those of a simulation.
    fn compare(&self, simulation: &Self) -> Result<(), RestoreError> {
        let kinds = [
            (
                "parameters of materials",
                self.materials,
                simulation.materials,
            ),
            ("masses", self.masses, simulation.masses),
            ("conductances", self.conductances, simulation.conductances),
            (
                "temperatures of reservoirs",
                self.reservoirs,
                simulation.reservoirs,
            ),
            ("gravity", self.gravity, simulation.gravity),
        ];
        match kinds.into_iter().find(|(_, own, other)| own != other) {
            Some((kind, ..)) => Err(RestoreError::Numbers { kind }),
            None => Ok(()),
        }
    }
}

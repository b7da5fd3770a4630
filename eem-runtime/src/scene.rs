//! A scene as a user describes it: nodes, elements, reservoirs, conductances.
//!
//! Building a scene never fails; [`Simulation::new`](crate::Simulation::new) checks it and returns all errors.

// The documentation shows methods in this order.
mod parts;

mod meshed_solid;

mod act;

mod body_heat;

pub(crate) mod bulk;
mod check;
pub(crate) mod entry;
pub(crate) mod error;
pub(crate) mod loads;
pub(crate) mod plan;
pub(crate) mod refused;
pub(crate) mod solid;
pub(crate) mod solid_error;

use core::any::TypeId;

use crate::element::group::Loose;
use crate::element::handle::Element;
use crate::element::layout::Shape;
use crate::element::lineage::Counts;
use crate::scene::error::SceneError;
use plan::Plan;

/// A scene in `D` dimensions: masses, anchors, springs, solids, reservoirs and loads.
///
/// | first | then | at last |
/// |---|---|---|
/// | [`new`](Self::new) | [`anchor`](Self::anchor), [`mass`](Self::mass), [`spring`](Self::spring), [`solid`](Self::solid) | [`Simulation::new`](crate::Simulation::new) |
/// | | [`set_temperature`](Self::set_temperature), [`reservoir`](Self::reservoir), [`conduct`](Self::conduct) | or first [`equilibrium`](Self::equilibrium) |
/// | | [`set_gravity`](Self::set_gravity), [`force`](Self::force), [`move_anchor`](Self::move_anchor), [`traction`](Self::traction) | |
///
/// ```
/// use eem::Scene;
///
/// let mut scene = Scene::<2>::new();
/// let pivot = scene.anchor([0.0, 0.0]);
/// let bob = scene.mass(1.0, [3.0, 0.0], [0.0, 1.0]);
/// let air = scene.reservoir(300.0);
/// assert_eq!(pivot.to_string(), "node 0");
/// assert_eq!(bob.to_string(), "node 1");
/// assert_eq!(air.to_string(), "reservoir 0");
/// ```
#[derive(Debug)]
pub struct Scene<const D: usize> {
    pub(crate) plan: Plan,
    pub(crate) groups: Vec<Box<dyn Loose<D>>>,
}

impl<const D: usize> Default for Scene<D> {
    fn default() -> Self {
        const {
            assert!(D >= 1, "a scene has at least one dimension");
        }
        Self {
            plan: Plan::empty(D),
            groups: Vec::new(),
        }
    }
}

impl<const D: usize> Scene<D> {
    /// The errors of the calls so far: handles of other scenes, loads on anchors, invalid cells of solids.
    /// [`Simulation::new`](crate::Simulation::new) reports these, too, and checks all numbers.
    ///
    /// ```
    /// use eem::{Scene, SceneError};
    ///
    /// let mut scene = Scene::<1>::new();
    /// let wall = scene.anchor([0.0]);
    /// assert!(scene.errors().is_empty());
    /// scene.dead_load(wall, [1.0]);
    /// assert!(matches!(scene.errors(), [SceneError::WrongKind { .. }]));
    /// ```
    #[must_use]
    pub fn errors(&self) -> &[SceneError] {
        &self.plan.errors
    }

    /// The capabilities of the elements of each group.
    pub(crate) fn shapes(&self) -> Vec<Shape> {
        let mut shapes = Vec::with_capacity(self.groups.len());
        for group in &self.groups {
            shapes.push(group.shape());
        }
        shapes
    }

    /// The index of the group for elements of one type and kind, created if necessary, and the group.
    fn set_of<B: Loose<D>>(
        &mut self,
        kind: (TypeId, u64),
        new: impl FnOnce() -> Box<dyn Loose<D>>,
    ) -> (usize, &mut B) {
        let mut groups = self.groups.iter();
        let same = groups.position(|group| group.as_any().is::<B>() && group.kind() == kind);
        let group = same.unwrap_or_else(|| {
            self.groups.push(new());
            self.groups.len() - 1
        });
        let set = self.groups[group].as_any_mut().downcast_mut();
        let set = set.unwrap_or_else(|| unreachable!("the group has this type"));
        (group, set)
    }

    /// The handle of a valid element.
    pub(crate) fn element_at(&self, index: usize) -> Element {
        self.plan.element_at(index, &self.groups)
    }
}

/// Handles of a scene are valid for its copies too; handles of parts that are added to one of them later are valid only there.
/// Loads are shared: what a closure keeps behind a lock is common to all copies.
///
/// ```
/// use eem::prelude::*;
///
/// let mut scene = Scene::<1>::new();
/// let mass = scene.mass(1.0, [0.0], [2.0]);
/// let mut pushed = scene.clone();
/// pushed.dead_load(mass, [3.0]);
/// for (scene, speed) in [(scene, 2.0), (pushed, 5.0)] {
///     let mut run = Simulation::new(scene, Scheme::EemEntropy, 1.0)?;
///     run.step()?;
///     assert_eq!(run.velocity(mass)?[0], speed);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
impl<const D: usize> Clone for Scene<D> {
    fn clone(&self) -> Self {
        let plan = &self.plan;
        let counts = Counts {
            nodes: plan.entries.nodes.len(),
            elements: plan.entries.elements.len(),
            reservoirs: plan.reservoirs.len(),
            paths: plan.conductors.len(),
        };
        Self {
            plan: Plan {
                lineage: plan.lineage.copy(counts),
                ..plan.clone()
            },
            groups: self.groups.iter().map(|group| group.duplicate()).collect(),
        }
    }
}

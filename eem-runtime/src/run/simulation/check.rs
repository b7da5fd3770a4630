//! Rules for the step size and the scheme of a scene.

use crate::element::handle::{Element, Node};
use crate::scene::Scene;
use crate::scene::error::RocketError;
use crate::scene::error::SceneError;
use crate::step::scheme::{Closing, Scheme};
use eem_material::number::scalar::is_positive;

/// The features of a scene that not every scheme can step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Needs {
    has_solids: bool,
    /// The node of a rocket.
    rocket: Option<Node>,
    /// An element with a dashpot in parallel with its spring.
    drag: Option<Element>,
}

impl Needs {
    /// The features of this scene.
    pub(super) fn of<const D: usize>(scene: &Scene<D>) -> Self {
        let group = |index: usize| scene.groups.get(index);
        let has_drag = |index| group(index).is_some_and(|group| group.shape().drag);
        let drag = scene
            .elements
            .iter()
            .position(|entry| has_drag(entry.group));
        let mut groups = scene.groups.iter();
        Self {
            has_solids: groups.any(|group| !group.shape().is_spring),
            rocket: scene.loads.rockets.first().map(|rocket| rocket.line.node),
            drag: drag.map(|index| scene.element_at(index)),
        }
    }

    /// Whether `Scheme::Auto` chooses only implicit schemes of order 2.
    pub(super) const fn are_implicit(&self) -> bool {
        self.has_solids || self.rocket.is_some() || self.drag.is_some()
    }

    /// An error unless a scheme can step the scene.
    pub(super) fn check(&self, scheme: Scheme) -> Result<(), SceneError> {
        let name = scheme.name();
        if self.has_solids && !scheme.ends_by_increments() {
            let why = if scheme.closing() == Closing::Explicit {
                "so that every stage would solve a large linear system, and their small stiff elements allow only tiny steps"
            } else {
                "and only schemes that take the end of a step from its increments allow that"
            };
            return Err(SceneError::NotForSolids { scheme: name, why });
        }
        if let Some(node) = self.rocket.filter(|_| !scheme.ends_by_increments()) {
            return Err(RocketError::Scheme { scheme: name, node }.into());
        }
        match self.drag.filter(|_| !scheme.takes_drag()) {
            Some(element) => Err(SceneError::NoDrag {
                scheme: name,
                element,
            }),
            None => Ok(()),
        }
    }
}

/// All errors of a scene, the scheme for it and the step.
pub(super) fn check_all<const D: usize>(
    scene: &Scene<D>,
    (scheme, needs): (Scheme, Needs),
    step: f64,
) -> Vec<SceneError> {
    let mut errors = scene.check();
    errors.extend(needs.check(scheme).err());
    errors.extend(check_step(step).err());
    errors
}

/// An error unless a step is positive and finite.
pub(super) fn check_step(step: f64) -> Result<(), SceneError> {
    if is_positive(step) {
        Ok(())
    } else {
        let value = step;
        Err(SceneError::Step { value })
    }
}

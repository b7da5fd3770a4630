//! Rules for the step size and the scheme of a scene.

use crate::scene::Scene;
use crate::scene::error::RocketError;
use crate::scene::error::SceneError;
use crate::step::scheme::{Closing, Scheme};
use eem_material::number::scalar::{Real, is_positive};

/// Whether a scene has what the explicit scheme cannot step: solids, dashpots in parallel with springs, rockets.
pub(super) fn needs_implicit<const D: usize, S: Real>(scene: &Scene<D, S>) -> bool {
    let mut shapes = scene.groups.iter().map(|group| group.shape());
    !scene.loads.rockets.is_empty() || shapes.any(|shape| !shape.is_spring || shape.drag)
}

/// All errors of a scene, the scheme for it and the step.
pub(super) fn check_all<const D: usize, S: Real>(
    scene: &Scene<D, S>,
    scheme: Scheme,
    step: S,
) -> Vec<SceneError> {
    let mut errors = scene.check();
    errors.extend(check_scheme(scene, scheme).err());
    errors.extend(check_step(step).err());
    errors
}

/// An error unless the scheme can step the scene.
fn check_scheme<const D: usize, S: Real>(
    scene: &Scene<D, S>,
    scheme: Scheme,
) -> Result<(), SceneError> {
    let name = scheme.name();
    if !scheme.ends_by_increments() {
        let mut groups = scene.groups.iter();
        if groups.any(|group| !group.shape().is_spring) {
            let why = if scheme.closing() == Closing::Explicit {
                "so that every stage would solve a large linear system, and their small stiff elements allow only tiny steps"
            } else {
                "and only schemes that take the end of a step from its increments allow that"
            };
            return Err(SceneError::NotForSolids { scheme: name, why });
        }
        if let Some(rocket) = scene.loads.rockets.first() {
            let (scheme, node) = (name, rocket.line.node);
            return Err(RocketError::Scheme { scheme, node }.into());
        }
    }
    let group = |index: usize| scene.groups.get(index);
    let has_drag = |index| group(index).is_some_and(|group| group.shape().drag);
    let mut entries = scene.elements.iter();
    match entries.position(|entry| has_drag(entry.group)) {
        Some(index) if !scheme.takes_drag() => Err(SceneError::NoDrag {
            scheme: name,
            element: scene.element_at(index),
        }),
        _ => Ok(()),
    }
}

/// An error unless a step is positive and finite.
pub(super) fn check_step<S: Real>(step: S) -> Result<(), SceneError> {
    if is_positive(step) {
        Ok(())
    } else {
        let value = step.to_f64();
        Err(SceneError::Step { value })
    }
}

//! What a step size, the end of a step and the scheme of solids must be.

use crate::scene::Scene;
use crate::scene::error::SceneError;
use crate::scene::rocket_error::RocketError;
use crate::step::error::StepFailure;
use crate::step::scheme::{Closing, Scheme};
use eem_material::number::scalar::{Real, is_positive};

/// The time at the end of a step is finite.
pub(super) fn check_end<S: Real>(time: S) -> Result<(), StepFailure> {
    if time.is_finite() {
        Ok(())
    } else {
        let value = time.to_f64();
        Err(StepFailure::Time { value })
    }
}

/// Whether there is something in the scene that the explicit scheme does not step: solids, dashpots beside springs,
/// rockets.
pub(super) fn needs_implicit<const D: usize, S: Real>(scene: &Scene<D, S>) -> bool {
    let mut shapes = scene.groups.iter().map(|group| group.shape());
    !scene.loads.rockets.is_empty() || shapes.any(|shape| !shape.is_spring || shape.drag)
}

/// Everything that is wrong with a scene, a scheme for it and a step.
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

/// The scheme can step what is in the scene.
fn check_scheme<const D: usize, S: Real>(
    scene: &Scene<D, S>,
    scheme: Scheme,
) -> Result<(), SceneError> {
    let mut shapes = scene.groups.iter().map(|group| group.shape());
    if shapes.any(|shape| !shape.is_spring) {
        check_solids(scheme)?;
    }
    if let Some(rocket) = scene.loads.rockets.first()
        && !scheme.ends_by_increments()
    {
        let scheme = scheme.name();
        let node = rocket.line.node;
        return Err(RocketError::Scheme { scheme, node }.into());
    }
    let mut entries = scene.elements.iter();
    let has_drag = |group: usize| {
        scene
            .groups
            .get(group)
            .is_some_and(|group| group.shape().drag)
    };
    let with_drag = entries.position(|entry| has_drag(entry.group));
    match with_drag {
        Some(index) if !scheme.takes_drag() => Err(SceneError::NoDrag {
            scheme: scheme.name(),
            element: scene.element_at(index),
        }),
        _ => Ok(()),
    }
}

/// The scheme can step solids, whose masses couple nodes.
fn check_solids(scheme: Scheme) -> Result<(), SceneError> {
    if scheme.ends_by_increments() {
        return Ok(());
    }
    let why = if scheme.closing() == Closing::Explicit {
        "so that every stage would solve a large linear system, and their small stiff elements allow only tiny steps"
    } else {
        "and only schemes that take the end of a step from its increments allow that"
    };
    let scheme = scheme.name();
    Err(SceneError::NotForSolids { scheme, why })
}

/// A step is positive and finite.
pub(super) fn check_step<S: Real>(step: S) -> Result<(), SceneError> {
    if is_positive(step) {
        Ok(())
    } else {
        let value = step.to_f64();
        Err(SceneError::Step { value })
    }
}

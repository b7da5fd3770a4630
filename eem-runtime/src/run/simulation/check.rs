//! What a step size, the end of a step and the scheme of solids must be.

use crate::element::handle::Element;
use crate::number::scalar::{Real, is_positive};
use crate::scene::Scene;
use crate::scene::error::SceneError;
use crate::step::error::StepFailure;
use crate::step::scheme::{Closing, Scheme};

/// The time at the end of a step is finite.
pub(super) fn check_end<S: Real>(time: S) -> Result<(), StepFailure> {
    if time.is_finite() {
        Ok(())
    } else {
        let value = time.to_f64();
        Err(StepFailure::Time { value })
    }
}

/// Whether there is something in the scene that only schemes of second order step: solids, and dashpots beside
/// springs.
pub(super) fn needs_second_order<const D: usize, S: Real>(scene: &Scene<D, S>) -> bool {
    let mut shapes = scene.groups.iter().map(|group| group.shape());
    shapes.any(|shape| !shape.is_spring || shape.drag)
}

/// The scheme can step what is in the scene.
pub(super) fn check_scheme<const D: usize, S: Real>(
    scene: &Scene<D, S>,
    scheme: Scheme,
) -> Result<(), SceneError> {
    let mut shapes = scene.groups.iter().map(|group| group.shape());
    if shapes.any(|shape| !shape.is_spring) {
        check_solids(scheme)?;
    }
    let mut entries = scene.elements.iter();
    let with_drag = entries.position(|entry| scene.groups[entry.group].shape().drag);
    match with_drag {
        Some(index) if !scheme.takes_drag() => Err(SceneError::NoDrag {
            scheme: scheme.name(),
            element: Element {
                scene: scene.id,
                index,
            },
        }),
        _ => Ok(()),
    }
}

/// The scheme can step solids, whose masses couple nodes.
fn check_solids(scheme: Scheme) -> Result<(), SceneError> {
    let name = scheme.name();
    match scheme.closing() {
        Closing::Increments => Ok(()),
        Closing::Explicit => Err(SceneError::ExplicitSolids { scheme: name }),
        Closing::Start | Closing::Stages => Err(SceneError::NotForSolids { scheme: name }),
    }
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

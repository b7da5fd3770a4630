//! Rules for the step size and the scheme of a scene.

use crate::element::handle::{Element, Node};
use crate::scene::Scene;
use crate::scene::error::RocketError;
use crate::scene::error::SceneError;
use crate::step::automatic::FIRST;
use crate::step::control::Tolerance;
use crate::step::features::Feature;
use crate::step::scheme::{Closing, Scheme};

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

    /// The scheme with which a run set to `asked` begins.
    pub(super) fn first(&self, asked: Scheme) -> Scheme {
        let mut first = FIRST.into_iter();
        match asked {
            Scheme::Auto => first.find(|&scheme| self.allows(scheme)).unwrap_or(asked),
            own => own,
        }
    }

    /// Whether a scheme can step the scene.
    pub(super) fn allows(&self, scheme: Scheme) -> bool {
        self.check(scheme).is_ok()
    }

    /// An error unless a scheme can step the scene.
    pub(super) fn check(&self, scheme: Scheme) -> Result<(), SceneError> {
        let name = scheme.name();
        if self.has_solids && !scheme.steps(Feature::Solids) {
            let why = if scheme.closing() == Closing::Explicit {
                "so that every stage would solve a large linear system, and their small stiff elements allow only tiny steps"
            } else {
                "and only schemes that take the end of a step from its increments allow that"
            };
            return Err(SceneError::NotForSolids { scheme: name, why });
        }
        if let Some(node) = self.rocket.filter(|_| !scheme.steps(Feature::Rockets)) {
            return Err(RocketError::Scheme { scheme: name, node }.into());
        }
        let drag = self
            .drag
            .filter(|_| !scheme.steps(Feature::ParallelDashpots));
        match drag {
            Some(element) => Err(SceneError::NoDrag {
                scheme: name,
                element,
            }),
            None => Ok(()),
        }
    }
}

/// The shortest step, s: its square, which the equations of a step contain, is the least normal number, 2⁻¹⁰²².
pub(super) const SHORTEST: f64 = f64::from_bits((1023 - 511) << 52);

/// An error unless a step is finite and at least the shortest one.
pub(super) fn check_step(step: f64) -> Result<(), SceneError> {
    if (SHORTEST..=f64::MAX).contains(&step) {
        Ok(())
    } else {
        let value = step;
        Err(SceneError::Step { value })
    }
}

/// An error unless steps of a scheme, and of the one that it uses first, can be controlled with a tolerance.
pub(super) fn check_tolerance(
    tolerance: &Tolerance,
    (scheme, in_use): (Scheme, Scheme),
) -> Result<(), SceneError> {
    if scheme.may_change_steps() {
        return tolerance.check(in_use.accuracy());
    }
    let scheme = scheme.name();
    Err(SceneError::FixedSteps { scheme })
}

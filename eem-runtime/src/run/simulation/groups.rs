//! The elements of a scene, ready for its scheme.

use crate::element::error::StateError;
use crate::element::group::{Elements, ExplicitGroup, Group, Loose, Placed};
use crate::element::state::State;
use crate::step::scheme::{Closing, Scheme};
use eem_material::number::scalar::Real;

/// The elements of a scene, a group per model.
pub(super) enum Groups<S: Real, const D: usize> {
    /// For Newton's method.
    Newton(Vec<Box<dyn Group<S, D>>>),
    /// For an explicit scheme.
    Explicit(Vec<Box<dyn ExplicitGroup<S, D>>>),
}

impl<S: Real, const D: usize> Groups<S, D> {
    /// Makes elements ready for a scheme.
    pub(super) fn new(
        elements: Vec<Box<dyn Loose<S, D>>>,
        scheme: Scheme,
        placed: Placed<'_>,
    ) -> Self {
        let elements = elements.into_iter();
        if scheme.closing() == Closing::Explicit {
            let groups = elements.map(|elements| elements.build_explicit(placed));
            return Self::Explicit(groups.collect());
        }
        let by = scheme.conjugates();
        Self::Newton(
            elements
                .map(|elements| elements.build(by, placed))
                .collect(),
        )
    }

    /// Finds the entropies of an initial state; says which elements cannot be in it.
    pub(super) fn initialize(&mut self, state: &mut State<S>) -> Vec<StateError> {
        let mut errors = Vec::new();
        let mut refuse = |error| errors.push(error);
        match self {
            Self::Newton(groups) => {
                for group in groups {
                    group.elements_mut().initialize(state, &mut refuse);
                }
            }
            Self::Explicit(groups) => {
                for group in groups {
                    group.elements_mut().initialize(state, &mut refuse);
                }
            }
        }
        errors
    }

    /// All groups.
    pub(super) fn all(&self) -> Vec<&dyn Elements<S, D>> {
        match self {
            Self::Newton(groups) => groups.iter().map(|group| group.elements()).collect(),
            Self::Explicit(groups) => groups.iter().map(|group| group.elements()).collect(),
        }
    }

    /// The elements without a scheme.
    pub(super) fn into_loose(self) -> Vec<Box<dyn Loose<S, D>>> {
        match self {
            Self::Newton(groups) => groups.into_iter().map(Group::into_loose).collect(),
            Self::Explicit(groups) => {
                let groups = groups.into_iter();
                groups.map(ExplicitGroup::into_loose).collect()
            }
        }
    }
}

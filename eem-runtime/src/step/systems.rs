//! The linear systems of a scheme, whose memory is reserved before a scene is changed.

use crate::algebra::memory::{MemoryLimit, TooLarge};
use crate::algebra::pattern::Pattern;
use crate::algebra::system::LinearSystem;
use crate::element::conduction::Conduction;
use crate::element::layout::Layout;
use crate::element::loads::PushLine;
use crate::element::tableau::Ending;
use crate::scene::entry::ElementEntry;
use crate::step::pattern;
use crate::step::scheme::{Closing, Scheme};
use eem_material::number::scalar::Real;

/// The linear systems that a scheme solves in a step.
#[derive(Debug)]
pub(crate) struct Systems<S, const D: usize> {
    /// The system of an iteration.
    pub(crate) tangent: LinearSystem<S, 1>,
    /// The system of a stage, if a scheme ends its steps stage by stage.
    pub(crate) secant: Option<LinearSystem<S, D>>,
}

impl<S: Real, const D: usize> Systems<S, D> {
    /// The systems of a scheme, or an error if one exceeds the memory limit.
    pub(crate) fn new(
        scheme: Scheme,
        (elements, layout): (&[ElementEntry<S>], &Layout),
        conduction: &Conduction<S>,
        rockets: &[PushLine],
        limit: MemoryLimit,
    ) -> Result<Self, TooLarge> {
        let mut pattern = if scheme.closing() == Closing::Explicit {
            Pattern::new(0, |_| {})
        } else {
            pattern::of_tangent(elements, layout, conduction, rockets, D)
        };
        let sets = scheme.sets().len();
        if sets > 1 {
            pattern = pattern.repeated(sets);
        }
        let ending = scheme.tableau().map(|rule| &rule.ending);
        let has_secant = matches!(ending, Some(Ending::StageByStage));
        Ok(Self {
            tangent: LinearSystem::new(&pattern, D, limit)?,
            secant: has_secant
                .then(|| LinearSystem::new(&pattern::of_masses(elements, layout, &[], D), 1, limit))
                .transpose()?,
        })
    }
}

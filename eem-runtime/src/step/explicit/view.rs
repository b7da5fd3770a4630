//! The input of a step.

use core::ops::Deref;

use crate::element::conduction::Conduction;
use crate::element::masses::Masses;
use crate::element::state::State;
use crate::scene::loads::Loads;
use crate::step::control::LeastScales;

/// The input of a step, without loads.
#[derive(Clone, Copy)]
pub(crate) struct View<'a> {
    /// h, s.
    pub(crate) step: f64,
    /// The old state.
    pub(crate) state: &'a State,
    pub(crate) conduction: &'a Conduction,
    pub(crate) masses: &'a Masses,
    pub(crate) least: &'a LeastScales,
}

impl View<'_> {
    /// The time at the end of the step, s.
    #[inline]
    pub(super) fn end(&self) -> f64 {
        self.state.time.value + self.step
    }
}

/// The input of a step.
#[derive(Clone, Copy)]
pub(crate) struct ExplicitView<'a, const D: usize> {
    pub(crate) view: View<'a>,
    pub(crate) loads: &'a Loads<D>,
}

impl<'a, const D: usize> Deref for ExplicitView<'a, D> {
    type Target = View<'a>;

    #[inline]
    fn deref(&self) -> &View<'a> {
        &self.view
    }
}

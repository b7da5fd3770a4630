//! The input of a step.

use crate::element::conduction::Conduction;
use crate::element::masses::Masses;
use crate::element::state::State;
use crate::scene::loads::SceneLoads;
use crate::step::control::LeastScales;

/// The input of a step.
#[derive(Clone, Copy)]
pub(crate) struct View<'a> {
    /// h, s.
    pub(crate) step: f64,
    /// The old state.
    pub(crate) state: &'a State,
    pub(crate) conduction: &'a Conduction,
    pub(crate) loads: &'a SceneLoads,
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

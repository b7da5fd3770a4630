//! What a model evaluates of several springs in one call, ahead of the loop over the springs.

use super::point::Viscosities;
use crate::element::conjugates::{Form, KeptOf};
use eem_material::free_energy::{Caloric, FreeEnergy};

/// Workspace for the springs of a call; empty for other models.
pub(super) struct Ahead<M: FreeEnergy<f64>> {
    pub(super) x: Vec<M::Variables>,
    pub(super) old: Vec<KeptOf<M>>,
    pub(super) corners: Vec<M::Corners>,
    pub(super) forms: Vec<Form<f64, M>>,
    pub(super) responses: Vec<M::Response>,
    pub(super) viscosities: Vec<Viscosities<M>>,
    pub(super) caloric: Vec<(Caloric<f64>, f64)>,
}

impl<M: FreeEnergy<f64>> Ahead<M> {
    pub(super) const fn new() -> Self {
        Self {
            x: Vec::new(),
            old: Vec::new(),
            corners: Vec::new(),
            forms: Vec::new(),
            responses: Vec::new(),
            viscosities: Vec::new(),
            caloric: Vec::new(),
        }
    }

    /// Stores the variables of some springs; returns their number.
    pub(super) fn take(&mut self, x: impl Iterator<Item = M::Variables>) -> usize {
        self.x.clear();
        self.x.extend(x);
        self.x.len()
    }
}

//! The wall between the materials of a group that goes through stages and its nodes.
//!
//! `StagePoints` has the points of all elements and knows no nodes; a [`Geometry`](super::geometry::Geometry) knows no
//! materials. So the first is compiled for each size of arrays, the second once for every kind of element.

use super::point::{LocalStages, Outside};
use crate::element::conduction::InterfaceTemperatures;
use crate::element::error::StateError;
use crate::element::group::points::HasPoints;
use crate::element::group::view::StepView;
use crate::element::kinematics::{MeasureSet, Numbers, PerStrain, QuadraticStrain, StrainMeasures};
use crate::element::state::State;
use crate::element::tableau::MOST_STAGES;
use crate::element::tally::{Reevaluation, Tally};

/// `[f64; number of components of the strain]`.
pub(super) type StrainOf<K, const D: usize> = PerStrain<<K as QuadraticStrain<D>>::Strain>;

/// The points of all elements at the stages. A point is given by its index in the group.
pub(crate) trait StageModels<Q: MeasureSet>: HasPoints<Q> {
    /// See [`StageEquations::unknowns_of`](super::equations::StageEquations::unknowns_of) and `inputs_of`.
    fn unknowns_and_inputs(&self) -> [usize; 2];

    /// Reads the old state, given measures and strain, and starts the trial there.
    fn begin(&mut self, place: usize, old: (&Numbers<Q>, &[f64]), view: &StepView<'_>);

    /// See [`StageEquations::condense`](super::equations::StageEquations::condense).
    fn condense(
        &mut self,
        place: usize,
        local: &mut LocalStages,
        view: &StepView<'_>,
    ) -> Result<(), StateError>;

    /// See [`StageEquations::force`](super::equations::StageEquations::force).
    fn force(&self, place: usize, local: &mut LocalStages, stage_and_force: [usize; 2]) -> f64;

    /// See [`StageEquations::temperature`](super::equations::StageEquations::temperature).
    fn temperature(&self, place: usize, local: &mut LocalStages, set: usize) -> f64;

    /// Starts the next correction of all points, of zero, from the present trial.
    fn hold(&mut self);

    /// Takes and applies the correction of a point; returns the largest in its unit.
    fn correct(&mut self, place: usize, local: &LocalStages) -> f64;

    /// Applies a fraction of the corrections of all points instead.
    fn apply(&mut self, fraction: f64);

    /// See [`StageEquations::close`](super::equations::StageEquations::close).
    fn close(
        &mut self,
        place: usize,
        measures: &Numbers<Q>,
        view_and_outside: (&StepView<'_>, Outside<'_>),
        next_and_tally: (&mut State, &mut Tally),
    ) -> Result<(), StateError>;

    /// Whether the scheme is certified.
    fn is_reevaluated(&self) -> bool;

    /// Adds the energy balance of a point in the last step, given the measures of both states and their increments.
    fn reevaluate(
        &self,
        place: usize,
        of_nodes: ([&Numbers<Q>; 2], &Numbers<Q>),
        ends: [&State; 2],
        reevaluation: &mut Reevaluation,
    );
}

/// Points with projections of the derivatives of the energy along a path.
pub(crate) trait PathModels<G: StrainMeasures>: StageModels<G::Measures> {
    /// Evaluates the model along the path, given the increments of the strain.
    fn evaluate(
        &mut self,
        place: usize,
        strain_rates: &[PerStrain<G>; MOST_STAGES],
        view_and_interface: (&StepView<'_>, &InterfaceTemperatures),
    ) -> Result<(), StateError>;

    /// The conjugates of the strain at a stage.
    fn stress(&self, place: usize, stage: usize) -> PerStrain<G>;

    /// Their sizes, limited by those at the ends of the path.
    fn limited_stress(&self, place: usize, stage: usize) -> PerStrain<G>;

    /// The derivatives of the energy by the strain at the end.
    fn stress_at_end(&self, place: usize) -> PerStrain<G>;

    /// The sizes of the conjugates at all stages, with the conditioning errors of the path, in units of ε.
    fn conditioned_stress(&mut self, place: usize) -> [PerStrain<G>; MOST_STAGES];
}

/// Points with values of the free energy at the stages.
pub(crate) trait ValueModels<Q: MeasureSet>: StageModels<Q> {
    /// Evaluates the model at a stage, at these measures, or at the old ones.
    fn evaluate(
        &mut self,
        place: usize,
        stage_and_measures: (usize, Option<&Numbers<Q>>),
        view_and_interface: (&StepView<'_>, &InterfaceTemperatures),
    ) -> Result<(), StateError>;

    /// Measures and forces of a stage.
    fn measures_and_forces(&self, place: usize, stage: usize) -> [Numbers<Q>; 2];
}

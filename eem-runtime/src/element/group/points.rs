//! The wall between the points of elements and their nodes.
//!
//! Points know their materials and their internal variables, and of the motion of the nodes numbers per measure. Elements know their
//! nodes, and of the points forces per measure. So points are compiled for each size of arrays, in no dimension, and elements for each
//! kind of element and dimension: the two add up and do not multiply.

use core::any::Any;

use super::audit::Misfit;
use super::eliminate::CondensedRow;
#[cfg(feature = "gradients")]
use super::point_step::{
    Direction, PastStep, PerVariable, Reduced, SeeParameters, StepBack, StepWeights, Surroundings,
    Weighed,
};
use super::site::HeatContact;
use super::stiffness::Stiffness;
use super::view::{Before, ElementTotals, ElementView, StepView};
use crate::element::conduction::{Conduction, InterfaceTemperatures};
use crate::element::error::StateError;
use crate::element::handle::Element;
use crate::element::kinematics::{MeasureSet, Numbers};
use crate::element::layout::Slots;
use crate::element::state::{Energy, State};
use crate::element::tally::{Reevaluation, Tally};
use eem_material::free_energy::Array;
use eem_material::number::digest::Digest;

/// Where a point is in the state of a scene: its handle, and the state indices of its internal variables.
pub(crate) type PointPlace = (Element, Slots);

/// The measures of a point, and what else follows from its nodes in a state.
pub(crate) struct Measured<'a, Q: MeasureSet> {
    pub(super) measures: &'a Numbers<Q>,
    /// See [`Kinematics::sizes`](crate::element::kinematics::Kinematics::sizes).
    pub(super) sizes: &'a Numbers<Q>,
    pub(super) state: &'a State,
}

/// The contribution of a point, apart from its nodes.
pub(crate) struct PointGeneric<Q: MeasureSet> {
    pub(super) forces: Numbers<Q>,
    /// g and η of its dashpots in series.
    pub(super) dashpots: Vec<[f64; 2]>,
    /// η of those in parallel.
    pub(super) drags: Vec<f64>,
    pub(super) temperature: f64,
}

/// Points of any scheme.
pub(crate) trait HasPoints<Q: MeasureSet>: Send + Sync {
    /// The points in a state.
    fn in_state(&self) -> &dyn PointsInState<Q>;

    /// The same, mutable.
    fn in_state_mut(&mut self) -> &mut dyn PointsInState<Q>;

    /// Their models, for [`Models::take_back`].
    fn into_models(self: Box<Self>) -> Box<dyn Any>;
}

/// Points in a state. A point is given by its index.
pub(crate) trait PointsInState<Q: MeasureSet>: Send + Sync {
    /// Where a point is in the state of the scene.
    fn place(&self, index: usize) -> PointPlace;

    /// Finds entropy and energy of an initial state, given measures and their sizes.
    fn initialize(
        &mut self,
        index: usize,
        of_nodes: [&Numbers<Q>; 2],
        state: &mut State,
    ) -> Result<(), StateError>;

    /// The energy in a state whose temperature and entropy are known.
    fn energy(&self, index: usize, at: &Measured<'_, Q>) -> Energy;

    /// Adds energy and entropies.
    fn add_totals(
        &self,
        index: usize,
        measures: &Numbers<Q>,
        state: &State,
        totals: &mut ElementTotals,
    );

    /// First measure, first force and energy.
    fn view(&self, index: usize, measures: &Numbers<Q>, state: &State) -> ElementView;

    /// `∂ψ/∂π`.
    fn forces(&self, index: usize, measures: &Numbers<Q>, state: &State) -> Numbers<Q>;

    /// The power that its dashpots turn into heat, W, at these rates of the measures.
    fn dissipation(&self, index: usize, measures_and_rates: [&Numbers<Q>; 2], state: &State)
    -> f64;

    /// Stiffness and rates, given the nodes of its element, and length and slopes of the measures.
    fn stiffness<'a>(
        &self,
        index: usize,
        at: &Measured<'_, Q>,
        of_nodes: (&'a [u32], f64, &Numbers<Q>),
    ) -> Stiffness<'a>;

    /// Replaces the response by the derivatives of the energy in a state.
    fn take_derivatives(&mut self, index: usize, measures: &Numbers<Q>, state: &State);

    /// The contribution of the present response to the GENERIC form.
    fn generic(&self, index: usize) -> PointGeneric<Q>;

    /// The derivatives of the entropy by measures, viscous stretches and temperature in the state of
    /// [`take_derivatives`](Self::take_derivatives).
    fn entropy_slopes(&self, index: usize) -> (Numbers<Q>, Vec<f64>, f64);

    /// Adds its parameters to a digest; before those of the first point, what kind of model it is.
    fn digest(&self, index: usize, is_first: bool, digest: &mut Digest);

    /// An error unless it can be in a state that comes from outside.
    fn audit(&self, index: usize, measures: &Numbers<Q>, state: &State) -> Result<(), Misfit>;

    /// Names and units of the parameters of the model, and whether it has derivatives by them.
    #[cfg(feature = "gradients")]
    fn parameters(&self) -> (&'static [&'static str], &'static [&'static str], bool);

    #[cfg(feature = "gradients")]
    fn parameter(&self, index: usize, parameter: usize) -> f64;

    /// Passes the derivatives of the internal energy with respect to the parameters to `see`.
    #[cfg(feature = "gradients")]
    fn energy_by_parameters(
        &self,
        index: usize,
        measures: &Numbers<Q>,
        state: &State,
        see: &mut SeeParameters<'_>,
    );
}

/// A trial, as points see it.
#[derive(Clone, Copy)]
pub(crate) struct TrialView<'a> {
    pub(super) view: &'a StepView<'a>,
    pub(super) interface: &'a InterfaceTemperatures,
    /// See [`Trial::is_start`](super::view::Trial::is_start).
    pub(super) is_start: bool,
    pub(super) contacts: &'a [HeatContact],
}

/// What nodes tell a point of a trial, and what it answers.
#[derive(Clone, Copy)]
pub(crate) struct Exchange<Q: MeasureSet> {
    /// The measures at which the scheme evaluates.
    pub(super) measures: Numbers<Q>,
    /// Their increments along the motion, less the part of the old state; for Kelvin–Voigt dashpots and schemes in temperature.
    pub(super) increments: Numbers<Q>,
    /// The forces.
    pub(super) forces: Numbers<Q>,
    /// The same as functions of the measures, with the internal variables eliminated.
    pub(super) rows: Q::Per<CondensedRow<Numbers<Q>>>,
    /// The index of its contact if the point conducts heat to others, out of range otherwise; then θ* − Θ as such a function, K.
    pub(super) contact: u32,
    pub(super) heat: CondensedRow<Numbers<Q>>,
    /// `∂r_s/∂Q = −h w/θ*`.
    pub(super) heat_factor: f64,
    /// For classical schemes: the derivatives of the heat balance by the increments.
    pub(super) heat_by_increment: Numbers<Q>,
    /// η of Kelvin–Voigt dashpots.
    pub(super) drags: Numbers<Q>,
}

impl<Q: MeasureSet> Exchange<Q> {
    pub(super) fn none() -> Self {
        let zeros = Numbers::<Q>::filled(0.0);
        Self {
            measures: zeros,
            increments: zeros,
            forces: zeros,
            rows: Q::Per::filled(CondensedRow::none()),
            contact: u32::MAX,
            heat: CondensedRow::none(),
            heat_factor: 0.0,
            heat_by_increment: zeros,
            drags: zeros,
        }
    }
}

/// The end of a step at a point.
#[derive(Clone, Copy)]
pub(crate) struct PointEnd<Q: MeasureSet> {
    pub(super) measures: Numbers<Q>,
    /// For exact schemes: the sizes of the measures at both ends, and the slopes of the new ones.
    pub(super) sizes: [Numbers<Q>; 2],
    pub(super) slopes: Numbers<Q>,
    /// `Σ |Δq|` of its nodes, m, for thorough bounds.
    pub(super) way: f64,
}

/// Points with one set of forces in a step. A point is given by its index.
pub(crate) trait PointSet<Q: MeasureSet>:
    PointsInState<Q> + HasPoints<Q> + PastPoints<Q>
{
    /// The index of the contact of a point, out of range without one.
    #[cfg(feature = "gradients")]
    fn contact(&self, index: usize) -> usize;

    /// Takes that index, and whether it exchanges heat with reservoirs.
    fn connect(&mut self, index: usize, contact: u32, conduction: &Conduction);

    /// Takes over the old state, which has these measures, and starts the trial there.
    fn begin(
        &mut self,
        index: usize,
        view: &StepView<'_>,
        before_and_by_factors: (Option<&Before<'_>>, bool),
        measures: &Numbers<Q>,
    );

    /// Finds in one call what the scheme keeps of the old states of all points, after they have begun.
    fn keep_together(&mut self, view: &StepView<'_>);

    /// The forces of the old state, given `π̇⁰`, of which a scheme takes a part.
    fn take_old_share(
        &mut self,
        index: usize,
        view: &StepView<'_>,
        speeds: &Numbers<Q>,
    ) -> Result<Numbers<Q>, StateError>;

    /// Whether the material evaluates several points in one call.
    fn is_together(&self) -> bool;

    /// Evaluates all points at these measures in one call; what is found is taken by [`linearize`](Self::linearize) or, without
    /// tangents, by [`respond`](Self::respond).
    fn evaluate_together(&mut self, at: &TrialView<'_>, measures: &[Numbers<Q>], has_tangent: bool);

    /// The same for the caloric quantities of new states with these measures, for [`close`](Self::close).
    fn close_together(&mut self, at: &TrialView<'_>, measures: &[Numbers<Q>], next: &mut State);

    /// Evaluates response and tangent, and eliminates the internal variables.
    fn linearize(
        &mut self,
        index: usize,
        at: &TrialView<'_>,
        exchange: &mut Exchange<Q>,
    ) -> Result<(), StateError>;

    /// Evaluates the response.
    fn respond(
        &mut self,
        index: usize,
        at: &TrialView<'_>,
        exchange: &Exchange<Q>,
    ) -> Result<(), StateError>;

    /// Applies the corrections for a global solution, given the changes of the measures, and `δr_s` through the motion alone; returns the
    /// largest in its unit.
    fn correct(
        &mut self,
        index: usize,
        changes: (&Numbers<Q>, f64),
        contacts: &[HeatContact],
        solution: &[[f64; 1]],
    ) -> f64;

    /// Applies a fraction of the last corrections instead.
    fn apply(&mut self, share: f64);

    /// Starts the next correction, of zero, from the present trial.
    fn hold(&mut self);

    /// The forces of the last response.
    fn pull(&self, index: usize) -> Numbers<Q>;

    /// The magnitude of the terms of the force between its nodes, given the sizes, slopes, and sizes of slopes of its measures.
    fn magnitude_of_pull(&self, index: usize, of_nodes: [&Numbers<Q>; 3]) -> f64;

    /// Books the step, finds the new temperature and energy, and judges the step.
    fn close(
        &mut self,
        index: usize,
        at: &TrialView<'_>,
        end: &PointEnd<Q>,
        next_and_tally: (&mut State, &mut Tally),
    ) -> Result<(), StateError>;

    /// Adds the energy balance of the last step, given the measures of both states and their increments.
    fn reevaluate(
        &self,
        index: usize,
        of_nodes: ([&Numbers<Q>; 2], &Numbers<Q>),
        ends: [&State; 2],
        reevaluation: &mut Reevaluation,
    );
}

/// Points in a completed step between two states, for its adjoint and its tangents. Nothing without the feature `gradients`.
pub(crate) trait PastPoints<Q: MeasureSet> {
    /// Returns to the step, whose states have these measures; θ*.
    #[cfg(feature = "gradients")]
    fn find_interface(
        &mut self,
        index: usize,
        step: &PastStep<'_>,
        measures: [&Numbers<Q>; 2],
    ) -> Result<f64, StateError>;

    /// Returns to the step, unless [`find_interface`](Self::find_interface) has, and eliminates the weights of its own equations.
    #[cfg(feature = "gradients")]
    fn condense_transposed(
        &mut self,
        index: usize,
        step: &StepBack<'_>,
        around: (&InterfaceTemperatures, Option<&HeatContact>),
        measures: [&Numbers<Q>; 2],
    ) -> Result<Reduced<Q>, StateError>;

    /// Finds the weights of its equations, given `D*π·w_v`: writes the derivatives by the old internal variables, passes those by the
    /// parameters to `see`, and returns those by the measures; those by the new ones only if they are asked for.
    #[cfg(feature = "gradients")]
    fn weigh(
        &mut self,
        index: usize,
        around: &Surroundings<'_>,
        along_and_by_new: (&Numbers<Q>, bool),
        found: (&mut PerVariable, &mut StepWeights),
        see: &mut SeeParameters<'_>,
    ) -> Weighed<Q>;

    /// Returns to the step, unless [`find_interface`](Self::find_interface) has, and linearizes its equations; with θ*.
    #[cfg(feature = "gradients")]
    fn linearize_past(
        &mut self,
        index: usize,
        step: &PastStep<'_>,
        around: (&InterfaceTemperatures, Option<&HeatContact>),
        measures: [&Numbers<Q>; 2],
    ) -> Result<(Exchange<Q>, f64), StateError>;

    /// The change of the forces of the point that was linearized last, along a direction in which its old measures change by `moved`.
    #[cfg(feature = "gradients")]
    fn push(
        &self,
        index: usize,
        step: &PastStep<'_>,
        around: (&InterfaceTemperatures, Option<&HeatContact>),
        moved: &Numbers<Q>,
        direction: &mut Direction,
    ) -> Result<Numbers<Q>, StateError>;

    /// Finds the changes of its internal variables and of θ*, given those of its measures.
    #[cfg(feature = "gradients")]
    fn follow(
        &self,
        index: usize,
        changes: &Numbers<Q>,
        contact: Option<&HeatContact>,
        direction: &mut Direction,
    );
}

#[cfg(not(feature = "gradients"))]
impl<T, Q: MeasureSet> PastPoints<Q> for T {}

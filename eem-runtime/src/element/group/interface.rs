//! The interface of the elements to the solvers: one dynamic call per group and phase.

use core::any::Any;
use core::fmt::Debug;

use super::explicit::stage::Stage;
use super::explicit::view::ClosingView;
#[cfg(feature = "gradients")]
use super::point_step::{Direction, PastStep, PerVariable, SeeParameters, StepBack, StepWeights};
use super::stiffness::Stiffness;
use super::view::{Along, ElementTotals, ElementView, Old, Placed, Sites, StepView, Trial};
use crate::algebra::system::LinearSystem;
#[cfg(feature = "gradients")]
use crate::element::conduction::InterfaceTemperatures;
use crate::element::conjugates::Conjugates;
use crate::element::error::StateError;
use crate::element::group::audit::Misfit;
use crate::element::group::view::ElementGeneric;
use crate::element::handle::Element;
use crate::element::impulse::Impulses;
use crate::element::kinematics::SolidState;
use crate::element::layout::{Shape, Slots};
use crate::element::state::State;
use crate::element::tally::{Reevaluation, Tally};
use eem_material::number::digest::Digest;
use eem_material::number::scalar::Real;

/// Elements of one model in a state, for any scheme.
pub(crate) trait Elements<S: Real, const D: usize>: Send + Sync {
    /// Finds the entropies and energies of an initial state from its temperatures.
    ///
    /// Calls `refuse` for every element for which the state is inadmissible.
    fn initialize(&mut self, state: &mut State<S>, refuse: &mut dyn FnMut(StateError));

    /// Adds energy and entropy, from their definitions.
    fn add_totals(&self, state: &State<S>, totals: &mut ElementTotals<S>);

    /// `Σ (|ψ| + θ|s| + cθ + Σ|f||π| + Σ|g||γ|)` of a state, J.
    fn energy_terms(&self, state: &State<S>) -> S;

    /// Writes the energies of a state whose temperatures and entropies are known.
    fn find_energies(&self, state: &mut State<S>);

    /// The contributions of the elements to the GENERIC form in a state.
    fn generic_in(&mut self, state: &State<S>) -> Vec<ElementGeneric<S>>;

    /// Passes stiffness and rates of each point in a state to `see`.
    fn stiffness(&self, state: &State<S>, see: &mut dyn FnMut(Stiffness<'_, S>));

    /// The handle of the element at `place`.
    fn handle(&self, place: usize) -> Element;

    /// The nodes of the element at `place`.
    fn nodes(&self, place: usize) -> &[u32];

    /// The names of the parameters of their model; empty for a scheme without an adjoint.
    #[cfg(feature = "gradients")]
    fn parameters(&self) -> &'static [&'static str] {
        &[]
    }

    /// Their units, if the model has units.
    #[cfg(feature = "gradients")]
    fn parameter_units(&self) -> &'static [&'static str] {
        &[]
    }

    /// Whether the model has derivatives with respect to its parameters.
    #[cfg(feature = "gradients")]
    fn has_parameter_derivatives(&self) -> bool {
        false
    }

    /// A parameter of the element at `place`.
    #[cfg(feature = "gradients")]
    fn parameter(&self, _place: usize, _index: usize) -> S {
        S::zero()
    }

    /// The state indices of the internal variables of the element at `place`.
    fn slots(&self, place: usize) -> Slots;

    /// The element at `place` in a state.
    fn inspect(&self, place: usize, state: &State<S>) -> ElementView<S>;

    /// Stress and strain of the element at `place`; `None` for a spring.
    fn solid_state(&self, place: usize, state: &State<S>) -> Option<SolidState<S>>;

    /// The power that the dashpots of the element at `place` turn into heat, W, at these velocities of nodes, m/s.
    fn dissipation(&self, place: usize, state: &State<S>, velocity: &dyn Fn(usize) -> [S; D]) -> S;

    /// Adds the parameters of all elements to a digest.
    fn digest(&self, digest: &mut Digest);

    /// An error unless the elements can be in a state that comes from outside, and its entropies are
    /// those of its temperatures.
    fn audit(&self, state: &State<S>) -> Result<(), Misfit>;
}

/// Elements of one model in an implicit scheme, for any model, kinematics and scheme.
pub(crate) trait Group<S: Real, const D: usize>: Send + Sync {
    /// The elements in a state.
    fn elements(&self) -> &dyn Elements<S, D>;

    /// The same, mutable.
    fn elements_mut(&mut self) -> &mut dyn Elements<S, D>;

    /// The elements without a scheme.
    fn into_loose(self: Box<Self>) -> Box<dyn Loose<S, D>>;

    /// Finds the matrix indices of its elements; called once per scene.
    fn connect(&mut self, sites: &Sites<'_, S, D>);

    /// Takes over the old state, adds its contribution to the nodes, and starts the trial there.
    fn begin(&mut self, view: &StepView<'_, S>, old: &mut Old<'_, S, D>) -> Result<(), StateError>;

    /// Computes everything that depends on the trial state, element by element, and adds residual and
    /// tangent, local unknowns eliminated, to a system if there is one.
    fn evaluate(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        system: Option<&mut LinearSystem<S, 1>>,
    ) -> Result<(), StateError>;

    /// Applies the local corrections for a global solution, except in lanes that have converged; returns the largest,
    /// in units of the measure (viscous stretches) and of the temperature.
    fn correct(&mut self, solution: &[[S; 1]], settled: S::Mask) -> S;

    /// Applies a fraction of the last corrections instead.
    fn apply(&mut self, share: S);

    /// Starts the next correction, of zero, from the present trial.
    fn hold(&mut self);

    /// Adds the nodal impulse `−h F` of the last response, N s, and, where it acts along the gradient of the scheme,
    /// the magnitude of its terms to that of each node.
    fn add_impulse(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        along: Along,
        impulses: &mut Impulses<'_, S, D>,
        magnitudes: &mut [S],
    );

    /// Adds `(h w) A` and `−(h w) A q⁰`, where `A q_i` is the nodal force found at the stage of a set and w
    /// its weight in the rows of the set; moved anchors are taken from the trial. Only for schemes closed stage by stage.
    fn add_secant(
        &mut self,
        _set: usize,
        _: &StepView<'_, S>,
        _: &Trial<S, D>,
        _: &mut LinearSystem<S, D>,
    ) {
    }

    /// Adds the increments of the internal variables and of the reservoirs' entropies to a new state
    /// whose positions are known, and finds its temperatures and energies.
    fn close(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        next: &mut State<S>,
        tally: &mut Tally<S>,
    ) -> Result<(), StateError>;

    /// Adds the energy balances of the elements in the last step, from the old state to a closed one.
    fn reevaluate(&self, ends: [&State<S>; 2], reevaluation: &mut Reevaluation<S>);

    /// The contributions of the elements to the discrete GENERIC form of the last step, between two states; empty for
    /// schemes of several stages.
    fn generic_of_step(&self, ends: [&State<S>; 2]) -> Vec<ElementGeneric<S>>;

    /// Finds the interface temperatures θ* of its points in a completed step, before [`pull_back`](Self::pull_back).
    #[cfg(feature = "gradients")]
    fn find_interfaces(
        &mut self,
        _: &PastStep<'_, S>,
        _: &mut InterfaceTemperatures<S>,
    ) -> Result<(), StateError> {
        Ok(())
    }

    /// Adds the transposed tangent of a completed step, local unknowns eliminated, and the right-hand side to a system.
    /// Like the methods below, only for the energy–entropy–momentum forms.
    #[cfg(feature = "gradients")]
    fn pull_back(
        &mut self,
        _: &StepBack<'_, S>,
        _: &InterfaceTemperatures<S>,
        _: &mut LinearSystem<S, 1>,
    ) -> Result<(), StateError> {
        Ok(())
    }

    /// Adds the derivatives with respect to the old state, given the solution of that system, and passes those with respect
    /// to the parameters of every point to `see`.
    #[cfg(feature = "gradients")]
    fn recover(
        &mut self,
        _: &StepBack<'_, S>,
        _: &InterfaceTemperatures<S>,
        _solution: &[[S; 1]],
        _found: (&mut PerVariable<S>, &mut StepWeights<S>),
        _see: &mut SeeParameters<'_, S>,
    ) {
    }

    /// Adds the tangent of a completed step, local unknowns eliminated, to a system, and the changes with old state,
    /// parameters and heat to the right-hand side of each direction; writes θ* of the points by thermal slot.
    #[cfg(feature = "gradients")]
    fn push_forward(
        &mut self,
        _: &PastStep<'_, S>,
        _: (&InterfaceTemperatures<S>, &mut [S]),
        _: &mut LinearSystem<S, 1>,
        _: &mut [Direction<S>],
    ) -> Result<(), StateError> {
        Ok(())
    }

    /// Finds the changes of the internal variables of the new state, given those of the positions and the solutions.
    #[cfg(feature = "gradients")]
    fn follow(&self, _: &mut [Direction<S>]) {}

    /// Passes the derivatives of the internal energy of every point with respect to its parameters in a state to `see`.
    #[cfg(feature = "gradients")]
    fn energy_by_parameters(&self, _state: &State<S>, _see: &mut SeeParameters<'_, S>) {}
}

/// Elements of one model in an explicit scheme.
pub(crate) trait ExplicitGroup<S: Real, const D: usize>: Send + Sync {
    /// The elements in a state.
    fn elements(&self) -> &dyn Elements<S, D>;

    /// The same, mutable.
    fn elements_mut(&mut self) -> &mut dyn Elements<S, D>;

    /// The elements without a scheme.
    fn into_loose(self: Box<Self>) -> Box<dyn Loose<S, D>>;

    /// Takes the component of each element, and the places of its nodes by component and node; called once per scene.
    fn join(&mut self, component_of: &[u32], place_of: &dyn Fn(u32, u32) -> u32);

    /// Adds the forces and writes the rates at a stage.
    fn rates(&self, stage: &mut Stage<S, D>) -> Result<(), StateError>;

    /// Adds a stage with a weight to the integrals of thermostats, after its rates have been written.
    fn integrate_thermostats(&self, stage: &mut Stage<S, D>, is_start: bool);

    /// Finds temperatures and energies of the open components.
    fn close(&mut self, view: &mut ClosingView<'_, S, D>) -> Result<(), StateError>;

    /// Adds the forces on places at the last closing of these components, and writes `γ̇` and `g γ̇` of their dashpots.
    fn pull(&self, components: &[bool], forces: &mut [[S; D]], creep: &mut [[S; 2]]);

    /// Writes the rates of the closed state, whose temperatures differ little from those of the last [`close`](Self::close).
    fn finish(&self, stage: &mut Stage<S, D>) -> Result<(), StateError>;
}

/// Elements of one model without a scheme, for any model.
pub(crate) trait Loose<S: Real, const D: usize>: Any + Debug + Send + Sync {
    /// The elements, for a downcast to their type.
    fn as_any(&self) -> &dyn Any;

    /// The same, mutable.
    fn as_any_mut(&mut self) -> &mut dyn Any;

    /// Capabilities of the model.
    fn shape(&self) -> Shape;

    /// Number of points of an element.
    #[cfg_attr(
        not(feature = "vtk"),
        expect(dead_code, reason = "pictures are cell by cell")
    )]
    fn points_per_element(&self) -> usize;

    /// The kind of their model; see [`FreeEnergy::kind`](eem_material::FreeEnergy::kind).
    fn kind(&self) -> u64;

    /// The name of their model.
    fn name(&self) -> &'static &'static str;

    /// The first parameter of the point at `place` that is not finite, and its value.
    fn infinite_parameter(&self, place: usize) -> Option<(&'static str, S)>;

    /// A copy of the elements.
    fn duplicate(&self) -> Box<dyn Loose<S, D>>;

    /// The elements, ready to be stepped.
    fn build(self: Box<Self>, by: Conjugates, placed: Placed<'_>) -> Box<dyn Group<S, D>>;

    /// The elements, ready for an explicit scheme.
    fn build_explicit(self: Box<Self>, placed: Placed<'_>) -> Box<dyn ExplicitGroup<S, D>>;
}

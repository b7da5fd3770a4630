//! The interface of the elements to the solvers: one dynamic call per group and phase.

use core::any::{Any, TypeId};
use core::fmt::Debug;

use super::explicit::stage::{Place, Stage};
use super::explicit::view::ClosingView;
#[cfg(feature = "gradients")]
use super::point_step::{Direction, PastStep, PerVariable, SeeParameters, StepBack, StepWeights};
use super::stiffness::Stiffness;
use super::view::{Along, ElementTotals, ElementView, Old, Placed, Sites, StepView, Trial};
use crate::algebra::system::LinearSystem;
#[cfg(feature = "gradients")]
use crate::element::conduction::InterfaceTemperatures;
use crate::element::conjugates::Conjugates;
use crate::element::ends::Ends;
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

/// Elements of one model in a state, for any scheme.
pub(crate) trait Elements: Send + Sync {
    /// Finds the entropies and energies of an initial state from its temperatures.
    ///
    /// Calls `refuse` for every element for which the state is inadmissible.
    fn initialize(&mut self, state: &mut State, refuse: &mut dyn FnMut(StateError));

    /// Adds energy and entropy, from their definitions.
    fn add_totals(&self, state: &State, totals: &mut ElementTotals);

    /// `Σ (|ψ| + θ|s| + cθ + Σ|f||π| + Σ|g||γ|)` of a state, J.
    fn energy_terms(&self, state: &State) -> f64;

    /// Writes the energies of a state whose temperatures and entropies are known.
    fn find_energies(&self, state: &mut State);

    /// Passes the contribution of each point to the GENERIC form in a state to `see`.
    fn generic_in(&mut self, state: &State, see: &mut dyn FnMut(ElementGeneric));

    /// Passes stiffness and rates of each point in a state to `see`.
    fn stiffness(&self, state: &State, see: &mut dyn FnMut(Stiffness<'_>));

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
    fn parameter(&self, _place: usize, _index: usize) -> f64 {
        0.0
    }

    /// Passes the derivatives of the internal energy of every point with respect to its parameters in a state to `see`.
    #[cfg(feature = "gradients")]
    fn energy_by_parameters(&self, state: &State, see: &mut SeeParameters<'_>);

    /// The state indices of the internal variables of the element at `place`.
    fn slots(&self, place: usize) -> Slots;

    /// The element at `place` in a state.
    fn inspect(&self, place: usize, state: &State) -> ElementView;

    /// Stress and strain of the element at `place`; `None` for a spring.
    fn solid_state(&self, place: usize, state: &State) -> Option<SolidState>;

    /// The power that the dashpots of the element at `place` turn into heat, W; `velocity` writes that of a node, m/s.
    fn dissipation(&self, place: usize, state: &State, velocity: &dyn Fn(usize, &mut [f64]))
    -> f64;

    /// Adds the parameters of all elements to a digest.
    fn digest(&self, digest: &mut Digest);

    /// An error unless the elements can be in a state that comes from outside, and its entropies are
    /// those of its temperatures.
    fn audit(&self, state: &State) -> Result<(), Misfit>;
}

/// Elements of one model in an implicit scheme, for any model, kinematics and scheme.
pub(crate) trait Group<const D: usize>: Send + Sync {
    /// The elements in a state.
    fn elements(&self) -> &dyn Elements;

    /// The same, mutable.
    fn elements_mut(&mut self) -> &mut dyn Elements;

    /// The elements without a scheme.
    fn into_loose(self: Box<Self>) -> Box<dyn Loose<D>>;

    /// Finds the matrix indices of its elements; called once per scene.
    fn connect(&mut self, sites: &Sites<'_, D>);

    /// Takes over the old state, adds its contribution to the nodes, and starts the trial there.
    fn begin(&mut self, view: &StepView<'_>, old: &mut Old<'_, D>) -> Result<(), StateError>;

    /// Computes everything that depends on the trial state, element by element, and adds residual and
    /// tangent, local unknowns eliminated, to a system if there is one.
    fn evaluate(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        system: Option<&mut LinearSystem<1>>,
    ) -> Result<(), StateError>;

    /// Applies the local corrections for a global solution and returns the largest,
    /// in units of the measure (viscous stretches) and of the temperature.
    fn correct(&mut self, solution: &[[f64; 1]]) -> f64;

    /// Applies a fraction of the last corrections instead.
    fn apply(&mut self, share: f64);

    /// Starts the next correction, of zero, from the present trial.
    fn hold(&mut self);

    /// Adds the nodal impulse `−h F` of the last response, N s, and, where it acts along the gradient of the scheme,
    /// the magnitude of its terms to that of each node.
    fn add_impulse(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        along: Along,
        impulses: &mut Impulses<'_, D>,
        magnitudes: &mut [f64],
    );

    /// Adds `(h w) A` and `−(h w) A q⁰`, where `A q_i` is the nodal force found at the stage of a set and w
    /// its weight in the rows of the set; moved anchors are taken from the trial. Only for schemes closed stage by stage.
    fn add_secant(&mut self, _set: usize, _: &StepView<'_>, _: &Trial<D>, _: &mut LinearSystem<D>) {
    }

    /// Adds the increments of the internal variables and of the reservoirs' entropies to a new state
    /// whose positions are known, and finds its temperatures and energies.
    fn close(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        next: &mut State,
        tally: &mut Tally,
    ) -> Result<(), StateError>;

    /// Adds the energy balances of the elements in the last step, from the old state to a closed one.
    fn reevaluate(&self, ends: [&State; 2], reevaluation: &mut Reevaluation);

    /// Passes the contribution of each point to the discrete GENERIC form of the last step, between two states, to `see`;
    /// none for schemes of several stages.
    fn generic_of_step(&self, _ends: [&State; 2], _see: &mut dyn FnMut(ElementGeneric)) {}

    /// Finds the interface temperatures θ* of its points in a completed step, before [`pull_back`](Self::pull_back).
    #[cfg(feature = "gradients")]
    fn find_interfaces(
        &mut self,
        _: &PastStep<'_>,
        _: &mut InterfaceTemperatures,
    ) -> Result<(), StateError> {
        Ok(())
    }

    /// Adds the transposed tangent of a completed step, local unknowns eliminated, and the right-hand side to a system.
    /// Like the methods below, only for the energy–entropy–momentum forms.
    #[cfg(feature = "gradients")]
    fn pull_back(
        &mut self,
        _: &StepBack<'_>,
        _: &InterfaceTemperatures,
        _: &mut LinearSystem<1>,
    ) -> Result<(), StateError> {
        Ok(())
    }

    /// Adds the derivatives with respect to the old state, given the solution of that system, and passes those with respect
    /// to the parameters of every point to `see`.
    #[cfg(feature = "gradients")]
    fn recover(
        &mut self,
        _: &StepBack<'_>,
        _: &InterfaceTemperatures,
        _solution: &[[f64; 1]],
        _found: (&mut PerVariable, &mut StepWeights),
        _see: &mut SeeParameters<'_>,
    ) {
    }

    /// Adds the tangent of a completed step, local unknowns eliminated, to a system, and the changes with old state,
    /// parameters and heat to the right-hand side of each direction; writes θ* of the points by thermal slot.
    #[cfg(feature = "gradients")]
    fn push_forward(
        &mut self,
        _: &PastStep<'_>,
        _: (&InterfaceTemperatures, &mut [f64]),
        _: &mut LinearSystem<1>,
        _: &mut [Direction],
    ) -> Result<(), StateError> {
        Ok(())
    }

    /// Finds the changes of the internal variables of the new state, given those of the positions and the solutions.
    #[cfg(feature = "gradients")]
    fn follow(&self, _: &mut [Direction]) {}
}

/// Elements of one model in an explicit scheme.
pub(crate) trait ExplicitGroup<const D: usize>: Send + Sync {
    /// The elements in a state.
    fn elements(&self) -> &dyn Elements;

    /// The same, mutable.
    fn elements_mut(&mut self) -> &mut dyn Elements;

    /// The elements without a scheme.
    fn into_loose(self: Box<Self>) -> Box<dyn Loose<D>>;

    /// Takes the component and the places of the nodes of each element, and the index of the first temperature among the internal
    /// variables; called once per scene.
    fn join(&mut self, elements: (&[u32], &Ends), first_temperature: usize);

    /// Adds the forces and writes the rates at a stage.
    fn rates(&self, places: &mut [Place<D>], stage: &mut Stage) -> Result<(), StateError>;

    /// Adds a stage with a weight to the integrals of thermostats, after its rates have been written.
    fn integrate_thermostats(&self, places: &[Place<D>], stage: &mut Stage, is_start: bool);

    /// Finds temperatures and energies of the open components.
    fn close(&mut self, view: &mut ClosingView<'_, D>) -> Result<(), StateError>;

    /// Adds the forces on places at the last closing of these components, and writes `γ̇` and `g γ̇` of their dashpots.
    fn pull(&self, components: &[bool], forces: &mut [[f64; D]], creep: &mut [[f64; 2]]);

    /// Writes the rates of the closed state, whose temperatures differ little from those of the last [`close`](Self::close).
    fn finish(&self, places: &mut [Place<D>], stage: &mut Stage) -> Result<(), StateError>;
}

/// Elements of one model without a scheme, for any model.
pub(crate) trait Loose<const D: usize>: Any + Debug + Send + Sync {
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

    /// The type and the kind of their model; see [`FreeEnergy::kind`](eem_material::FreeEnergy::kind).
    fn kind(&self) -> (TypeId, u64);

    /// The name of their model.
    fn name(&self) -> &'static &'static str;

    /// The first parameter of the point at `place` that is not finite, and its value.
    fn infinite_parameter(&self, place: usize) -> Option<(&'static str, f64)>;

    /// A copy of the elements.
    fn duplicate(&self) -> Box<dyn Loose<D>>;

    /// The elements, ready to be stepped.
    fn build(self: Box<Self>, by: Conjugates, placed: Placed<'_>) -> Box<dyn Group<D>>;

    /// The elements, ready for an explicit scheme.
    fn build_explicit(self: Box<Self>, placed: Placed<'_>) -> Box<dyn ExplicitGroup<D>>;
}

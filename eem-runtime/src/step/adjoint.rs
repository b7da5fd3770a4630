//! The adjoint of a step of the energy–entropy–momentum forms: from the derivatives of a number by the new state to those by
//! the old state, and the weights that give its derivatives by everything else.
//!
//! A step satisfies `R(x¹, x⁰) = 0` with
//!
//! ```text
//! R_q = Δq − (h/2)(v⁰ + v¹)                        R_γ = η Δγ/h − g*
//! R_v = M Δv + h (Σ (f* + f_d) D*π − f_ext)        R_s = Δs − (h/θ*)(Σ η Δγ²/h² + Σ η_d Δπ²/h² + Σ κ (Θ_b − Θ_a) + Σ κ_r (θ_r − θ*))
//! R_Θ = Θ − θ*                                     R_σ = Δσ − (h/θ_r) Σ κ_r (θ* − θ_r)
//! R_p = θ¹ − θ_p  instead of R_s where a thermostat holds the temperature
//! ```
//!
//! With λ¹ the derivatives by x¹, `(∂R/∂x¹)ᵀ w = λ¹` and `λ⁰ = −(∂R/∂x⁰)ᵀ w`. As in a step, v¹ and the variables of a point are
//! eliminated; what remains has the pattern of the system of a step.

mod rockets;

use core::array;
use core::mem;

use crate::algebra::system::LinearSystem;
use crate::element::conduction::InterfaceTemperatures;
use crate::element::error::StateError;
use crate::element::group::{Group, PastStep, SeeParameters, StepView};
use crate::element::layout::Layout;
use crate::element::masses::Masses;
use crate::element::state::State;
use eem_material::number::scalar::Real;

pub(crate) use crate::element::group::{Costate, StepWeights, Terms};
pub(crate) use rockets::RocketStep;

/// Why a step has no adjoint.
pub(crate) enum NoAdjoint {
    /// Its equations do not determine the new state.
    Singular,
    /// An element cannot be in one of the states.
    State(StateError),
}

impl From<StateError> for NoAdjoint {
    fn from(error: StateError) -> Self {
        Self::State(error)
    }
}

/// The adjoint of one step after the other, with memory for all of them.
#[derive(Debug)]
pub(crate) struct Adjoint<S, const D: usize> {
    nodes: Vec<Inertia<S, D>>,
    pairs: Vec<CoupledInertia<S, D>>,
    /// The interface temperatures of a step, and whether there are any.
    interface: InterfaceTemperatures<S>,
    is_coupled: bool,
    /// `M w_v`.
    momenta: Vec<S>,
    /// The derivatives by the present state, and those by the one after it.
    pub(crate) costate: Costate<S>,
    pub(crate) after: Costate<S>,
    /// The weights of the last step.
    pub(crate) weights: StepWeights<S>,
}

/// A node that moves.
#[derive(Clone, Copy, Debug)]
struct Inertia<S, const D: usize> {
    /// Its first coordinate and unknown, and its diagonal entries.
    coordinate: usize,
    unknown: usize,
    diagonal: [usize; D],
    mass: S,
}

/// The entries of a mass that couples two nodes, in both triangles.
#[derive(Clone, Copy, Debug)]
struct CoupledInertia<S, const D: usize> {
    places: [[usize; D]; 2],
    mass: S,
}

impl<S: Real, const D: usize> Adjoint<S, D> {
    /// From the derivatives by the last state on.
    pub(crate) fn new(
        layout: &Layout,
        masses: &Masses<S>,
        system: &LinearSystem<S, 1>,
        costate: Costate<S>,
    ) -> Self {
        let zeros = |count| vec![S::zero(); count];
        let coordinates = costate.positions.len();
        let place = |row: usize, column: usize| {
            array::from_fn(|axis| system.place(Some(row + axis), Some(column + axis)))
        };
        let nodes = masses.iter().zip(&layout.nodes).enumerate();
        let nodes = nodes.filter_map(|(node, (mass, unknown))| {
            let unknown = (*unknown)?;
            Some(Inertia {
                coordinate: node * D,
                unknown,
                diagonal: place(unknown, unknown),
                mass: mass?,
            })
        });
        let pairs = masses.pairs().iter().filter_map(|pair| {
            let [a, b] = pair.nodes().map(|node| layout.nodes[node]);
            let (a, b) = (a?, b?);
            Some(CoupledInertia {
                places: [place(a, b), place(b, a)],
                mass: pair.mass,
            })
        });
        let is_coupled = layout.coupled.iter().any(Option::is_some);
        Self {
            nodes: nodes.collect(),
            pairs: pairs.collect(),
            interface: InterfaceTemperatures::new(layout.thermal),
            is_coupled,
            momenta: zeros(coordinates),
            weights: StepWeights {
                motion: zeros(coordinates),
                entropies: zeros(layout.thermal),
                held: zeros(layout.thermal),
                temperatures: vec![S::one(); layout.thermal],
                anchors: [zeros(coordinates), zeros(coordinates)],
                by_size: Terms::none(),
            },
            after: costate.clone(),
            costate,
        }
    }

    /// Goes on from the new state of a step, the present one, to its old state. The derivatives by the parameters of each
    /// element in the step are passed to `see`.
    pub(crate) fn step_back(
        &mut self,
        (view, new, held): (StepView<'_, S>, &State<S>, &[bool]),
        (layout, rockets): (&Layout, &[RocketStep<S, D>]),
        groups: &mut [Box<dyn Group<S, D>>],
        system: &mut LinearSystem<S, 1>,
        see: &mut SeeParameters<'_, S>,
    ) -> Result<(), NoAdjoint> {
        mem::swap(&mut self.costate, &mut self.after);
        let step = PastStep {
            view,
            new,
            held,
            by_new: &self.after,
        };
        let interface = &mut self.interface;
        if self.is_coupled {
            for group in &mut *groups {
                group.find_interfaces(&step, interface)?;
            }
        }
        add_inertia((&self.nodes, &self.pairs), view.step, &self.after, system);
        for group in &mut *groups {
            group.pull_back(&step, interface, system)?;
        }
        for rocket in rockets {
            rocket.add_to(layout, system);
        }
        system.solve().map_err(|_| NoAdjoint::Singular)?;
        let solution = system.solution();
        for node in &self.nodes {
            for axis in 0..D {
                self.weights.motion[node.coordinate + axis] = solution[node.unknown + axis][0];
            }
        }
        let momenta = &mut self.momenta;
        view.masses.find_momenta(D, &self.weights.motion, momenta);
        move_back(
            &self.nodes,
            view.step,
            momenta,
            (&self.after, &mut self.costate),
        );
        for anchors in &mut self.weights.anchors {
            anchors.fill(S::zero());
        }
        self.weights.by_size = Terms::none();
        for group in groups {
            let found = (&mut self.costate, &mut self.weights);
            group.recover(&step, interface, solution, found, see);
        }
        for rocket in rockets {
            rocket.subtract(layout, &mut self.costate, &mut self.weights);
        }
        Ok(())
    }
}

/// Starts the system with inertia, and with the derivatives by positions and velocities.
fn add_inertia<S: Real, const D: usize>(
    (nodes, pairs): (&[Inertia<S, D>], &[CoupledInertia<S, D>]),
    step: S,
    after: &Costate<S>,
    system: &mut LinearSystem<S, 1>,
) {
    system.clear();
    let (values, right) = system.parts();
    let per = S::from_f64(2.0) / step;
    for node in nodes {
        for (axis, &place) in node.diagonal.iter().enumerate() {
            let at = node.coordinate + axis;
            values[place] += per * node.mass;
            right[node.unknown + axis][0] += after.positions[at] + per * after.velocities[at];
        }
    }
    for pair in pairs {
        for &place in pair.places.as_flattened() {
            values[place] += per * pair.mass;
        }
    }
}

/// `λ_q⁰ = w_q = (2/h)(M w_v − λ_v)` and `λ_v⁰ = 2M w_v − λ_v` of the masses, given `M w_v`; anchors keep their sums, and have
/// `M w_v` by their old velocities.
fn move_back<S: Real, const D: usize>(
    nodes: &[Inertia<S, D>],
    step: S,
    momenta: &[S],
    (after, before): (&Costate<S>, &mut Costate<S>),
) {
    before.reservoirs.copy_from_slice(&after.reservoirs);
    before.positions.copy_from_slice(&after.positions);
    before.velocities.copy_from_slice(momenta);
    let per = S::from_f64(2.0) / step;
    for node in nodes {
        for at in (node.coordinate..).take(D) {
            let rest = momenta[at] - after.velocities[at];
            before.positions[at] = per * rest;
            before.velocities[at] = momenta[at] + rest;
        }
    }
}

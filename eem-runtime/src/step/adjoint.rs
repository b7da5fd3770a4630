//! The adjoint of a step of the energy–entropy–momentum forms: from the derivatives of a number by the new state to those by
//! the old state, and the weights that give its derivatives by everything else. Its tangents are in `tangents.rs`.
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

mod error;
mod inertia;
mod rockets;
mod tangents;

use core::mem;

use crate::algebra::system::LinearSystem;
use crate::element::conduction::InterfaceTemperatures;
use crate::element::group::{Group, SeeParameters, StepBack};
use crate::element::layout::Layout;
use crate::element::masses::Masses;
use eem_material::number::scalar::Real;

pub(crate) use crate::element::group::{Direction, PastStep, PerVariable, StepWeights, Terms};
pub(crate) use error::NoAdjoint;
use inertia::{Inertia, Moving};
pub(crate) use rockets::RocketStep;
pub(crate) use tangents::{HeatChange, Tangents};

/// The adjoint of one step after the other, with memory for all of them.
#[derive(Debug)]
pub(crate) struct Adjoint<S, const D: usize> {
    inertia: Inertia<S, D>,
    /// The interface temperatures of a step, and whether there are any.
    interface: InterfaceTemperatures<S>,
    is_coupled: bool,
    /// `M w_v`.
    momenta: Vec<S>,
    /// The derivatives by the present state, and those by the one after it.
    pub(crate) costate: PerVariable<S>,
    pub(crate) after: PerVariable<S>,
    /// The weights of the last step.
    pub(crate) weights: StepWeights<S>,
}

impl<S: Real, const D: usize> Adjoint<S, D> {
    /// From the derivatives by the last state on.
    pub(crate) fn new(
        layout: &Layout,
        masses: &Masses<S>,
        system: &LinearSystem<S, 1>,
        costate: PerVariable<S>,
    ) -> Self {
        let zeros = |count| vec![S::zero(); count];
        let coordinates = costate.positions.len();
        let is_coupled = layout.coupled.iter().any(Option::is_some);
        Self {
            inertia: Inertia::new(layout, masses, system),
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
        past: &PastStep<'_, S>,
        (layout, rockets): (&Layout, &[RocketStep<S, D>]),
        groups: &mut [Box<dyn Group<S, D>>],
        system: &mut LinearSystem<S, 1>,
        see: &mut SeeParameters<'_, S>,
    ) -> Result<(), NoAdjoint> {
        mem::swap(&mut self.costate, &mut self.after);
        let view = &past.view;
        let step = StepBack {
            past: *past,
            by_new: &self.after,
        };
        let interface = &mut self.interface;
        if self.is_coupled {
            for group in &mut *groups {
                group.find_interfaces(past, interface)?;
            }
        }
        let Inertia { nodes, .. } = &self.inertia;
        self.inertia.start(view.step, system);
        let per = S::from_f64(2.0) / view.step;
        let (_, right) = system.parts();
        for node in nodes {
            for axis in 0..D {
                let at = node.coordinate + axis;
                right[node.unknown + axis][0] +=
                    self.after.positions[at] + per * self.after.velocities[at];
            }
        }
        for group in &mut *groups {
            group.pull_back(&step, interface, system)?;
        }
        for rocket in rockets {
            rocket.add_to(layout, true, system);
        }
        system.solve().map_err(|_| NoAdjoint::Singular)?;
        let solution = system.solution();
        for node in nodes {
            for axis in 0..D {
                self.weights.motion[node.coordinate + axis] = solution[node.unknown + axis][0];
            }
        }
        let momenta = &mut self.momenta;
        view.masses.find_momenta(D, &self.weights.motion, momenta);
        move_back(nodes, view.step, momenta, (&self.after, &mut self.costate));
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

/// `λ_q⁰ = w_q = (2/h)(M w_v − λ_v)` and `λ_v⁰ = 2M w_v − λ_v` of the masses, given `M w_v`; anchors keep their sums, and have
/// `M w_v` by their old velocities.
fn move_back<S: Real, const D: usize>(
    nodes: &[Moving<S, D>],
    step: S,
    momenta: &[S],
    (after, before): (&PerVariable<S>, &mut PerVariable<S>),
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

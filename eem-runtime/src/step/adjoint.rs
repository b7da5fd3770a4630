//! The adjoint of a step of the energy–entropy–momentum forms: from the derivatives of an objective by the new state to those
//! by the old state, and the weights that give its derivatives by everything else. Its tangents are in `tangents.rs`.
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
//! eliminated; what remains has the pattern of the system of a step,
//!
//! ```text
//! ((2/h) M + K)ᵀ w = b + (2/h) λ_v
//! ```
//!
//! From step to step w changes by O(h), and `M w − λ_v` is O(h), too. As differences of large numbers they would lose digits, and
//! `2/h` would multiply what is lost. So the unknowns are the changes of w since the last step, and `λ_v − M w` is updated by `M` times
//! these.

mod equations;
mod rockets;
mod tangents;

use core::mem;

use crate::algebra::system::LinearSystem;
use crate::element::group::{Group, SeeParameters, StepBack, StepView};
use crate::element::layout::Layout;
use crate::element::masses::Masses;

pub(crate) use crate::element::group::{Direction, PastStep, PerVariable, StepWeights, Terms};
use equations::Equations;
pub(crate) use equations::NoAdjoint;
pub(crate) use rockets::RocketStep;
pub(crate) use tangents::{HeatChange, Tangents};

/// The adjoint of one step after the other, with a workspace for all of them.
#[derive(Debug)]
pub(crate) struct Adjoint<const D: usize> {
    equations: Equations,
    /// `w_v` of the last step for each unknown; 0 unless the unknown is a position.
    last: Vec<[f64; 1]>,
    /// The change of `M w_v` by the last step, and `λ_v − M w_v` with the present λ.
    changes: Vec<f64>,
    rests: Vec<f64>,
    /// The derivatives by the present state, and those by the one after it.
    pub(crate) costate: PerVariable,
    pub(crate) after: PerVariable,
    /// The weights of the last step.
    pub(crate) weights: StepWeights,
}

impl<const D: usize> Adjoint<D> {
    /// Begins with the derivatives by the last state.
    pub(crate) fn new(
        layout: &Layout,
        masses: &Masses,
        system: &LinearSystem<1>,
        costate: PerVariable,
    ) -> Self {
        let zeros = |count| vec![0.0; count];
        let coordinates = costate.positions.len();
        Self {
            equations: Equations::new(D, layout, masses, system),
            last: vec![[0.0]; system.right().len()],
            changes: zeros(coordinates),
            rests: costate.velocities.clone(),
            weights: StepWeights {
                motion: zeros(coordinates),
                entropies: zeros(layout.thermal),
                held: zeros(layout.thermal),
                temperatures: vec![1.0; layout.thermal],
                anchors: [zeros(coordinates), zeros(coordinates)],
                by_size: Terms::none(),
            },
            after: costate.clone(),
            costate,
        }
    }

    /// Goes back from the new state of a step, the present one, to its old state. Passes the derivatives by the parameters of
    /// each element in the step to `see`.
    pub(crate) fn step_back(
        &mut self,
        past: &PastStep<'_>,
        (layout, rockets): (&Layout, &[RocketStep<D>]),
        groups: &mut [Box<dyn Group<D>>],
        system: &mut LinearSystem<1>,
        see: &mut SeeParameters<'_>,
    ) -> Result<(), NoAdjoint> {
        mem::swap(&mut self.costate, &mut self.after);
        let view = &past.view;
        self.equations.find_interfaces(past, groups)?;
        system.clear();
        let by_new = &self.after;
        let step = StepBack {
            past: *past,
            by_new,
        };
        for group in &mut *groups {
            group.pull_back(&step, &self.equations.interface, system)?;
        }
        for rocket in rockets {
            rocket.add_to(layout, true, system);
        }
        system.subtract_product(&self.last);
        self.equations.add_inertia(view.step, system);
        self.find_weights(view, system)?;
        let solution = system.solution();
        for anchors in &mut self.weights.anchors {
            anchors.fill(0.0);
        }
        self.weights.by_size = Terms::none();
        let by_new = &self.after;
        let step = StepBack {
            past: *past,
            by_new,
        };
        for group in groups {
            let found = (&mut self.costate, &mut self.weights);
            group.recover(&step, &self.equations.interface, solution, found, see);
        }
        for rocket in rockets {
            rocket.subtract(layout, &mut self.costate, &mut self.weights);
        }
        Ok(())
    }

    /// Adds a derivative of the objective by a velocity in the present state.
    pub(crate) fn add_by_velocity(&mut self, at: usize, by: f64) {
        self.costate.velocities[at] += by;
        self.rests[at] += by;
    }

    /// Solves the system of a step. For masses, `λ_q⁰ = w_q = (2/h)(M w_v − λ_v)` and `λ_v⁰ = 2M w_v − λ_v`; for anchors,
    /// `λ_q` stays, and `λ_v⁰ = M w_v` comes from the masses of solids.
    fn find_weights(
        &mut self,
        view: &StepView<'_>,
        system: &mut LinearSystem<1>,
    ) -> Result<(), NoAdjoint> {
        let moving = &self.equations.moving;
        let per = 2.0 / view.step;
        let (_, right) = system.parts();
        let (after, rests) = (&self.after, &mut self.rests);
        for of in moving {
            let at = of.coordinate;
            right[of.unknown][0] += after.positions[at] + per * rests[at];
        }
        system.solve()?;
        let motion = &mut self.weights.motion;
        motion.fill(0.0);
        let solution = system.solution_mut();
        for of in moving {
            motion[of.coordinate] = solution[of.unknown][0];
            solution[of.unknown][0] += self.last[of.unknown][0];
            self.last[of.unknown] = solution[of.unknown];
        }
        view.masses.find_momenta(D, motion, &mut self.changes);
        for of in moving {
            motion[of.coordinate] = solution[of.unknown][0];
        }
        let before = &mut self.costate;
        before.reservoirs.copy_from_slice(&after.reservoirs);
        before.positions.copy_from_slice(&after.positions);
        view.masses.find_momenta(D, motion, &mut before.velocities);
        for at in moving.iter().map(|of| of.coordinate) {
            rests[at] = self.changes[at] - rests[at];
            before.positions[at] = per * rests[at];
            before.velocities[at] += rests[at];
        }
        Ok(())
    }
}

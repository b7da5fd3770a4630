//! Old state and trial state of the elements: responses, viscosities, condensed local systems.

use super::member::Member;
use super::pose::{Pose, along, arms, measures_in, points, spread};
use super::{ElementGroup, Old, StepView, Trial, variables};
use crate::error::StateError;
use crate::free_energy::{Array, FreeEnergy};
use crate::handle::Element;
use crate::kinematics::{Arms, Kinematics, Measures};
use crate::scalar::Real;
use crate::scene::is_positive;
use crate::scheme::{ElementScheme, ElementTrial, Placement, Start};

impl<S, M, K, C, const D: usize> ElementGroup<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    /// See [`Group::begin`](super::Group::begin).
    pub(super) fn begin_all(
        &mut self,
        view: &StepView<'_, S>,
        old: &mut Old<'_, S, D>,
    ) -> Result<(), StateError> {
        let positions = points(view.state.positions.values());
        for member in &mut self.members {
            let r0 = arms::<K, S, D>(&member.site.nodes, positions);
            let measures = self.kinematics.measure(&r0);
            member.begin(view, &measures);
            if C::IMPLICIT < 1.0 {
                member.old_share(self.kinematics, view, &r0, old.force)?;
            }
            shorten::<K, S, D>(&member.site.nodes, &measures, old.lengths);
        }
        Ok(())
    }
}

/// Reduces the unit of length of each node to the shortest measure of its elements.
#[inline]
pub(super) fn shorten<K: Kinematics<S, D>, S: Real, const D: usize>(
    nodes: &K::PerNode<usize>,
    measures: &Measures<K, S, D>,
    lengths: &mut [S],
) {
    for &node in nodes.as_ref() {
        let own = measures.as_ref().iter();
        lengths[node] = own.fold(lengths[node], |least, &own| least.minimum(own));
    }
}

impl<S, M, K, C, const D: usize> Member<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    /// Looks at the old state, where the trial starts.
    #[inline]
    fn begin(&mut self, view: &StepView<'_, S>, measures: &Measures<K, S, D>) {
        let x0 = variables::<S, M>(measures.as_ref(), self.slots, view.state);
        let slot = self.slots.thermal;
        let entropy = slot.map(|slot| view.state.entropies.values()[slot]);
        self.start = Start {
            x0,
            entropy: entropy.unwrap_or(S::zero()),
            old: C::old(&self.model, &x0),
        };
        self.x = x0;
        self.entropy_change = S::zero();
        if M::THERMAL {
            let theta = x0[Self::TEMPERATURE];
            self.corners = M::Corners::filled(theta);
            let prescribed = view.prescribed(slot, C::PLACEMENT);
            self.x[Self::TEMPERATURE] = prescribed.unwrap_or(theta);
        }
        self.hold();
    }

    /// The part of rates and nodal forces that the scheme takes from the old state.
    fn old_share(
        &mut self,
        kinematics: K,
        view: &StepView<'_, S>,
        r0: &Arms<K, S, D>,
        old_force: &mut [[S; D]],
    ) -> Result<(), StateError> {
        let share = S::one() - S::from_f64(C::IMPLICIT);
        let x0 = self.start.x0;
        let theta = x0[Self::VARIABLES - 1];
        self.find_viscosities(theta)?;
        let gradient = self.model.gradient(&x0);
        let mut heat = S::zero();
        for k in 0..M::DASHPOTS {
            let index = M::MEASURES + k;
            let g = -gradient[index];
            let rate = g / self.viscosities.0[k];
            self.old_rates[index] = share * rate;
            heat += g * rate;
        }
        if let Some(slot) = self.slots.thermal {
            let temperatures = &view.state.temperatures;
            heat += view.conduction.heat_flow(slot, theta, temperatures).heat;
            self.old_rates[Self::TEMPERATURE] = share * heat / theta;
        }
        let measures0 = measures_in::<K, S, D>(&x0);
        let pose = Pose::new(kinematics, C::PLACEMENT, [r0, r0], measures0);
        if M::THERMAL && C::IN_TEMPERATURE {
            let at_rest = Pose::new(kinematics, Placement::End, [r0, r0], measures0);
            self.find_old_heating(view, &at_rest, heat / theta);
        }
        for (a, row) in pose.direction.as_ref().iter().enumerate() {
            let by_node = spread::<K, S, D>(row);
            for (entry, &node) in by_node.as_ref().iter().zip(self.site.nodes.as_ref()) {
                for (force, &entry) in old_force[node].iter_mut().zip(entry) {
                    *force += share * gradient[a] * entry;
                }
            }
        }
        Ok(())
    }

    /// `(1 − w) θ̇⁰` of a scheme in temperature, which takes the place of `(1 − w) ṡ⁰`.
    fn find_old_heating(&mut self, view: &StepView<'_, S>, pose: &Pose<K, S, D>, entropy_rate: S) {
        let share = S::one() - S::from_f64(C::IMPLICIT);
        let last = Self::TEMPERATURE;
        let (_, hessian) = self.model.hessian(&self.start.x0);
        // ∂s/∂x = −∂²ψ/∂θ∂x
        let slope = |index: usize| -hessian[last][index];
        let velocities = self.old_velocities(view);
        let mut rest = share * entropy_rate;
        for a in 0..M::MEASURES {
            let rate = along::<K, S, D>(&pose.direction[a], &velocities);
            rest -= slope(a) * share * rate;
        }
        for index in M::MEASURES..last {
            rest -= slope(index) * self.old_rates[index];
        }
        self.old_heating = rest / slope(last);
        self.old_rates[last] = S::zero();
    }

    /// The old velocities of the arms; those of anchors are means over the step, m/s.
    fn old_velocities(&self, view: &StepView<'_, S>) -> Arms<K, S, D> {
        let momenta = points::<S, D>(view.state.momenta.values());
        let velocity = |node: usize, axis: usize| match view.masses[node] {
            Some(mass) => momenta[node][axis] / mass,
            None => view.loads.motion::<D>(node)[axis] / view.step,
        };
        let nodes = self.site.nodes.as_ref();
        let mut velocities = Arms::<K, S, D>::filled([S::zero(); D]);
        for (arm, &node) in velocities.as_mut().iter_mut().zip(&nodes[1..]) {
            for (axis, component) in arm.iter_mut().enumerate() {
                *component = velocity(node, axis) - velocity(nodes[0], axis);
            }
        }
        velocities
    }

    /// The motion `r¹ − r⁰ − (1 − w) h ṙ⁰` of the arms.
    fn motion(&self, view: &StepView<'_, S>, trial: &Trial<S, D>) -> Arms<K, S, D> {
        let rest = (S::one() - S::from_f64(C::IMPLICIT)) * view.step;
        let mut motion = arms::<K, S, D>(&self.site.nodes, &trial.displacements);
        let velocities = self.old_velocities(view);
        for (motion, velocity) in motion.as_mut().iter_mut().zip(velocities.as_ref()) {
            for (motion, &velocity) in motion.iter_mut().zip(velocity) {
                *motion -= rest * velocity;
            }
        }
        motion
    }

    /// The response at the trial state, and its tangent if Newton's method goes on from there.
    #[inline]
    pub(super) fn respond(
        &mut self,
        kinematics: K,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        goes_on: bool,
    ) -> Result<Pose<K, S, D>, StateError> {
        let old = points(view.state.positions.values());
        let r0 = arms::<K, S, D>(&self.site.nodes, old);
        let r1 = arms::<K, S, D>(&self.site.nodes, &trial.positions);
        let measures0 = measures_in::<K, S, D>(&self.start.x0);
        let pose = Pose::new(kinematics, C::PLACEMENT, [&r0, &r1], measures0);
        let element = self.element;
        check_measures::<K, S, D>(kinematics, element, &pose.measures)?;
        for (a, &measure) in pose.measures.as_ref().iter().enumerate() {
            self.x[a] = measure;
        }
        self.sensitivity = pose.sensitivity;
        let slot = self.slots.thermal;
        if M::THERMAL && C::FINDS_TEMPERATURE && view.prescribed(slot, C::PLACEMENT).is_none() {
            let theta = C::temperature(&self.model, &self.start, &self.x, self.entropy_change);
            self.x[Self::TEMPERATURE] = theta.map_err(|infeasible| infeasible.of(element))?;
        }
        let mut increments = M::Variables::filled(S::zero());
        let mut by_arm = self.sensitivity;
        if C::IN_TEMPERATURE {
            let motion = self.motion(view, trial);
            let (own, by) = pose.increase(kinematics, C::PLACEMENT, &motion);
            increments = self.increments(&own, view.step);
            by_arm = by;
        }
        let asked = ElementTrial {
            x: &self.x,
            increments: &increments,
        };
        let (model, start) = (&self.model, &self.start);
        let (corners, answer) = (&mut self.corners, &mut self.answer);
        let done = if goes_on {
            C::respond(model, start, &asked, corners, answer)
        } else {
            C::respond_alone(model, start, &asked, corners, answer)
        };
        done.map_err(|infeasible| infeasible.of(element))?;
        if C::IN_TEMPERATURE {
            self.by_increment = combined::<K, S, M, D>(&answer.by_increment, by_arm.as_ref());
        }
        check_response::<S, M>(element, &self.answer.response)?;
        self.find_viscosities(self.temperature())?;
        Ok(pose)
    }

    /// The increments of measures, viscous stretches and temperature, less what the old state
    /// contributes.
    fn increments(&self, measures: &Measures<K, S, D>, step: S) -> M::Variables {
        let mut increments = M::Variables::filled(S::zero());
        let (old, last) = (&self.start.x0, Self::VARIABLES - 1);
        for (a, &increment) in measures.as_ref().iter().enumerate() {
            increments[a] = increment;
        }
        for index in M::MEASURES..last {
            let change = self.x[index] - old[index];
            increments[index] = change - step * self.old_rates[index];
        }
        if M::THERMAL {
            let change = self.new_temperature(old[last]) - old[last];
            increments[last] = change - step * self.old_heating;
        }
        increments
    }
}

/// `Σ_a slope_a ∂Λ_a/∂r¹`.
fn combined<K: Kinematics<S, D>, S: Real, M: FreeEnergy<S>, const D: usize>(
    slopes: &M::Variables,
    by_arm: &[Arms<K, S, D>],
) -> Arms<K, S, D> {
    let mut sum = Arms::<K, S, D>::filled([S::zero(); D]);
    for (&slope, row) in slopes.as_ref().iter().zip(by_arm) {
        for (sum, entry) in sum.as_mut().iter_mut().zip(row.as_ref()) {
            for (sum, &entry) in sum.iter_mut().zip(entry) {
                *sum += slope * entry;
            }
        }
    }
    sum
}

/// The deformation is one that the element can have.
#[inline]
pub(super) fn check_measures<K: Kinematics<S, D>, S: Real, const D: usize>(
    kinematics: K,
    element: Element,
    measures: &Measures<K, S, D>,
) -> Result<(), StateError> {
    let mut measures = measures.as_ref().iter();
    match measures.find(|&&measure| !kinematics.is_admissible(measure)) {
        None => Ok(()),
        Some(measure) => Err(StateError::Stretch {
            element,
            value: measure.to_f64(),
        }),
    }
}

#[inline]
fn check_response<S: Real, M: FreeEnergy<S>>(
    element: Element,
    response: &M::Response,
) -> Result<(), StateError> {
    if M::THERMAL {
        check_temperature(element, response[M::MEASURES + M::DASHPOTS])?;
    }
    let mut values = response.as_ref().iter();
    match values.find(|value| !value.is_finite()) {
        None => Ok(()),
        Some(value) => Err(StateError::NotFinite {
            element,
            quantity: "force or entropy",
            value: value.to_f64(),
        }),
    }
}

/// A temperature is positive and finite.
#[inline]
pub(super) fn check_temperature<S: Real>(element: Element, theta: S) -> Result<(), StateError> {
    if is_positive(theta) {
        return Ok(());
    }
    let value = theta.to_f64();
    Err(StateError::Temperature { element, value })
}

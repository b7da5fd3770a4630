//! What the adjoint of a step needs of a point: its response between two states with the derivatives by both.
//!
//! The response `(f*, g*, θ*, Δs)` of a point is even in its two states, except Δs, which is odd. So its derivative by the
//! old state is the tangent of the form from the new state to the old one, with the row of Δs negated. The same holds for the
//! mean-value gradients of the measures.

use super::arms::measures_in;
use super::element_group::ElementGroup;
use super::member::Member;
use super::point::{Point, temperature_in};
use super::point_step::{PointStep, PointWeights, SeeParameters};
use crate::element::conjugates::{ElementScheme, Start};
use crate::element::error::StateError;
use crate::element::kinematics::{Arms, Blocks, Ends, Gradient, Kinematics};
use crate::element::state::State;
use eem_material::free_energy::{Array, Material};
use eem_material::number::scalar::Real;

/// What a form needs of the old state, and besides the variables.
type Begun<S, M, C> = (
    Start<S, M, <C as ElementScheme<S, M>>::Old>,
    <C as ElementScheme<S, M>>::Memory,
);

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, C: ElementScheme<S, M>, const D: usize>
    ElementGroup<S, M, K, C, D>
{
    /// Every point between two states, in a step of this size.
    pub(super) fn between(
        &self,
        step: S,
        states: [&State<S>; 2],
        see: &mut dyn FnMut(PointStep<S, D>),
    ) -> Result<(), StateError> {
        for member in &self.members {
            for point in member.points.as_ref() {
                see(point.between(member, step, states)?);
            }
        }
        Ok(())
    }

    /// The derivatives by the parameters, with the weights of each point in the order of [`between`](Self::between).
    pub(super) fn by_parameters(
        &self,
        states: [&State<S>; 2],
        weights: &mut dyn Iterator<Item = PointWeights<S>>,
        see: &mut SeeParameters<'_, S>,
    ) -> Result<(), StateError> {
        let members = self.members.iter();
        let points =
            members.flat_map(|member| member.points.as_ref().iter().map(move |p| (member, p)));
        for ((member, point), weights) in points.zip(weights) {
            let [x0, x1] = states.map(|state| point.variables_in(&member.arms_in(state), state));
            let by = point.by_parameters([&x0, &x1], &weights)?;
            see(point.element, by.as_ref());
        }
        Ok(())
    }

    /// The derivatives of the internal energies by the parameters in a state.
    pub(super) fn energy_by_parameters(&self, state: &State<S>, see: &mut SeeParameters<'_, S>) {
        for member in &self.members {
            for point in member.points.as_ref() {
                let x = point.variables_in(&member.arms_in(state), state);
                see(point.element, point.model.energy_by_parameters(&x).as_ref());
            }
        }
    }
}

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, C: ElementScheme<S, M>, const D: usize>
    Point<S, M, K, C, D>
{
    /// The step of the scheme from one state, and what it keeps of both.
    fn start(&self, [x0, x1]: [&M::Variables; 2]) -> Result<Begun<S, M, C>, StateError> {
        let start = Start {
            x0: *x0,
            old: C::old(&self.model, x0, S::zero()),
        };
        let theta = if M::THERMAL {
            x0[Self::TEMPERATURE]
        } else {
            S::one()
        };
        let mut memory = C::memory(theta);
        C::prepare(&self.model, &start, x1, &mut memory)
            .map_err(|infeasible| infeasible.of(self.element))?;
        Ok((start, memory))
    }

    fn between(
        &self,
        member: &Member<S, M, K, C, D>,
        step: S,
        states: [&State<S>; 2],
    ) -> Result<PointStep<S, D>, StateError> {
        let arms = states.map(|state| member.arms_in(state));
        let x = [0, 1].map(|end| self.variables_in(&arms[end], states[end]));
        let form = |from: usize, to: usize| {
            let (start, memory) = self.start([&x[from], &x[to]])?;
            Ok(self.scheme.form(&self.model, &start, &x[to], &memory))
        };
        let (response, by_new) = form(0, 1)?;
        let (_, by_old) = form(1, 0)?;
        let rows = |tangent: &M::Tangent| {
            let rows = tangent.as_ref().iter().map(|row| row.as_ref().to_vec());
            rows.collect::<Vec<_>>()
        };
        let mut slopes = [rows(&by_old), rows(&by_new)];
        if M::THERMAL {
            for entry in &mut slopes[0][Self::ENTROPY] {
                *entry = -*entry;
            }
        }
        let theta = temperature_in::<S, M>(&response);
        let (eta, eta_slope) = self.model.viscosity(theta);
        let (drag, drag_slope) = self.model.drag(theta);
        let change = |index: usize| x[1][index] - x[0][index];
        let extension: Vec<S> = (0..M::MEASURES).map(change).collect();
        let mut force = measures_in::<K, S, D>(&response);
        for (a, eta) in drag.as_ref().iter().enumerate() {
            force[a] += *eta * extension[a] / step;
        }
        let measures = x.map(|x| measures_in::<K, S, D>(&x));
        let ends = |from: usize, to: usize| {
            let (arms, measures) = ([arms[from], arms[to]], [measures[from], measures[to]]);
            Ends::new(&self.kinematics, arms, measures)
        };
        let still = Gradient::<K, S, D>::filled(Arms::<K, S, D>::filled([S::zero(); D]));
        let curvature = |from: usize, to: usize| {
            let ends = ends(from, to);
            let blocks = self.kinematics.discrete_tangent(&ends, &force, &still);
            by_component::<K, S, D>(&blocks)
        };
        let gradient = |end: usize| self.kinematics.gradient(&arms[end], &measures[end]);
        Ok(PointStep {
            nodes: member.site.nodes.as_ref().to_vec(),
            slots: self.slots(),
            temperature: theta,
            slopes,
            gradients: [0, 1].map(|end| by_measure::<K, S, D>(&gradient(end))),
            direction: by_measure::<K, S, D>(&self.kinematics.discrete_gradient(&ends(0, 1))),
            curvature: [curvature(1, 0), curvature(0, 1)],
            creep: (M::MEASURES..M::MEASURES + M::DASHPOTS)
                .map(change)
                .collect(),
            extension,
            viscosities: [eta.as_ref().to_vec(), eta_slope.as_ref().to_vec()],
            drag: [drag.as_ref().to_vec(), drag_slope.as_ref().to_vec()],
        })
    }

    fn by_parameters(
        &self,
        x: [&M::Variables; 2],
        weights: &PointWeights<S>,
    ) -> Result<M::Parameters, StateError> {
        let (_, memory) = self.start(x)?;
        let response: M::Response = filled(&weights.response);
        let theta = weights.temperature;
        let mut sum = self.scheme.form_adjoint(&self.model, x, &memory, &response);
        let viscosities = self
            .model
            .viscosity_adjoint(theta, &filled(&weights.viscosities));
        let drag = self.model.drag_adjoint(theta, &filled(&weights.drag));
        for (at, sum) in sum.as_mut().iter_mut().enumerate() {
            *sum += viscosities[at] + drag[at];
        }
        Ok(sum)
    }
}

/// An array with these first entries, the others zero.
fn filled<S: Real, A: Array<S>>(values: &[S]) -> A {
    let mut array = A::filled(S::zero());
    for (entry, value) in array.as_mut().iter_mut().zip(values) {
        *entry = *value;
    }
    array
}

fn by_measure<K: Kinematics<S, D>, S: Real, const D: usize>(
    gradient: &Gradient<K, S, D>,
) -> Vec<Vec<[S; D]>> {
    let rows = gradient.as_ref().iter();
    rows.map(|row| row.as_ref().to_vec()).collect()
}

/// Blocks of pairs of arms as rows by arm and axis.
fn by_component<K: Kinematics<S, D>, S: Real, const D: usize>(
    blocks: &Blocks<K, S, D>,
) -> Vec<Vec<S>> {
    let mut rows = Vec::new();
    for row in blocks.as_ref() {
        for axis in 0..D {
            let entries = row.as_ref().iter().flat_map(|block| block[axis]);
            rows.push(entries.collect());
        }
    }
    rows
}

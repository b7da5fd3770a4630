//! What the elements contribute to the certificate of a step.

use super::arms::{along, arms_in, measures_in};
use super::member::Member;
use super::point::Point;
use super::site::Contact;
use crate::element::conjugates::ElementScheme;
use crate::element::group::element_group::ElementGroup;
use crate::element::group::view::{StepView, Trial};
use crate::element::kinematics::{Arms, Ends, Kinematics};
use crate::element::recount::Recount;
use crate::element::state::State;
use crate::element::tally::{Care, Received, Tally};
use crate::material::free_energy::{Array, FreeEnergy};
use crate::number::scalar::Real;

impl<S, M, K, C, const D: usize> ElementGroup<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    /// See [`Group::recount`](super::Group::recount).
    pub(super) fn recount_all(&self, ends: [&State<S>; 2], recount: &mut Recount<S>) {
        for member in &self.members {
            for point in member.points.as_ref() {
                let own = point.balance_between(&member.site.nodes, ends);
                let found = Point::<S, M, K, C, D>::change_of(&point.response, &own.increments);
                recount.element(point.element, own.by_values, own.by_differences, found);
            }
        }
    }
}

/// The change of the energy of a point between two states.
pub(super) struct EnergyChange<S: Real, M: FreeEnergy<S>> {
    /// By its values, with the magnitude of their terms, J.
    pub(super) by_values: [S; 2],
    /// By discrete derivatives, J.
    pub(super) by_differences: S,
    /// `(Δλ, Δγ, Δs)`.
    increments: M::Variables,
}

impl<S, M, K, C, const D: usize> Member<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    /// Adds the magnitude of what `h F` is computed from to that of its nodes, N s, given the new arms and
    /// their change:
    ///
    /// ```text
    /// h Σ_π (|∂²π/∂r²| |r| |f*| + |∂π/∂r| Σ |∂f*/∂x_j| |x_j|) (1 + |Δr|/ℓ)
    /// ```
    #[cold]
    pub(super) fn add_magnitude(
        &self,
        h: S,
        [r1, change]: [&Arms<K, S, D>; 2],
        magnitudes: &mut [S],
    ) {
        let mut largest = S::zero();
        for arm in change.as_ref() {
            for component in arm {
                largest = largest.maximum(component.abs());
            }
        }
        for point in self.points.as_ref() {
            let magnitude = h * point.magnitude_of_pull(r1, largest);
            for &node in self.site.nodes.as_ref() {
                magnitudes[node as usize] += magnitude;
            }
        }
    }
}

/// The change of the arms of an element between two states, from what they are stored as.
fn change_between<K: Kinematics<S, D>, S: Real, const D: usize>(
    nodes: &K::PerNode<u32>,
    [old, new]: [&State<S>; 2],
) -> Arms<K, S, D> {
    let mut change = Arms::<K, S, D>::filled([S::zero(); D]);
    let nodes = nodes.as_ref();
    for (arm, &node) in change.as_mut().iter_mut().zip(&nodes[1..]) {
        for (axis, component) in arm.iter_mut().enumerate() {
            let moved = |node: u32| {
                new.positions
                    .change(node as usize * D + axis, &old.positions)
            };
            *component = moved(node) - moved(nodes[0]);
        }
    }
    change
}

/// What the variables of a point are computed from, and what the certificate asks of it.
impl<S, M, K, C, const D: usize> Point<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    /// What the variables of a state with these arms are computed from: times ε, their rounding.
    #[inline]
    fn sizes(&self, r: &Arms<K, S, D>, x: &M::Variables) -> M::Variables {
        let mut sizes = *x;
        let own = self.kinematics.sizes(r, &measures_in::<K, S, D>(x));
        for (a, &size) in own.as_ref().iter().enumerate() {
            sizes[a] = size;
        }
        sizes
    }

    /// The force between its nodes, `Σ |∂π/∂r| |f*|`, N.
    #[inline]
    pub(super) fn largest_pull(&self, r1: &Arms<K, S, D>) -> S {
        let slopes = self.kinematics.slopes(r1, &measures_in::<K, S, D>(&self.x));
        let forces = self.pulls();
        let forces = forces.as_ref().iter().zip(slopes.as_ref());
        forces.fold(S::zero(), |sum, (&force, &slope)| sum + slope * force.abs())
    }

    fn magnitude_of_pull(&self, r1: &Arms<K, S, D>, motion: S) -> S {
        let sizes = self.sizes(r1, &self.x);
        let [old, new] = [&self.start.x0, &self.x].map(measures_in::<K, S, D>);
        let slopes = self.kinematics.slopes(r1, &new);
        let slope_sizes = self.kinematics.slope_sizes(r1, &new);
        let mut sum = S::zero();
        for a in 0..M::MEASURES {
            sum += slope_sizes[a] * self.pull_of_row(a).abs();
            sum += slopes[a] * self.resolution_of_row(a, &sizes);
        }
        let lengths = [old, new].map(|measures| self.kinematics.length(&measures));
        sum * (S::one() + motion / lengths[0].minimum(lengths[1]))
    }

    /// `Σ_j |T_ij| |x_j|`: times ε, what rounding of the variables does to a response.
    fn magnitude_of_row(&self, row: usize, sizes: &M::Variables) -> S {
        let terms = self.slopes[row].as_ref().iter().zip(sizes.as_ref());
        terms.fold(S::zero(), |sum, (&slope, &x)| sum + (slope * x).abs())
    }

    /// The same where the internal variables answer to the rounding of the measures: times ε, to what a
    /// response is known in a state that solves the equations of the element.
    ///
    /// ```text
    /// Σ_j |T_ij| (|x_j| + Σ_a |∂u_j/∂π_a| |π_a|)
    /// ```
    ///
    /// With a small heat capacity c the temperature is known to `ε θ |∂s/∂λ| λ/c`, which is far more than
    /// its own rounding.
    #[cold]
    fn resolution_of_row(&self, row: usize, sizes: &M::Variables) -> S {
        let mut sum = self.magnitude_of_row(row, sizes);
        for a in 0..M::MEASURES {
            let by_measure = &self.condensed.by_measure[a];
            for u in 0..Self::UNKNOWNS {
                let answer = by_measure.get(u) * sizes[a];
                sum += (self.slopes[row][M::MEASURES + u] * answer).abs();
            }
        }
        sum
    }

    /// What its forces contribute to A and, with care, to A⁺, J:
    ///
    /// ```text
    /// |f*|(λ⁰ + λ¹) + Σ |g*|(|γ⁰| + |γ¹|) + ε (|T_λλ| λ² + Σ |T_γγ| γ²)
    /// Σ_ij |T_ij| |x_j| |Δx_i|,     Δx = (Δλ, Δγ, Δs)
    /// ```
    ///
    /// The part with ε is what rounding of a state at the bottom of a well does. The measures of a solid are
    /// ratios, whose sizes have nothing to do with the motion: its forces always need the care.
    #[inline]
    pub(super) fn amplitude(&self, [r0, r1]: [&Arms<K, S, D>; 2], care: Care) -> S {
        let (sizes0, sizes1) = (self.sizes(r0, &self.start.x0), self.sizes(r1, &self.x));
        let mut sum = S::zero();
        for row in 0..M::MEASURES + M::DASHPOTS {
            let size = sizes1[row].abs();
            let rounding = S::EPSILON * size * size;
            sum += self.pull_of_row(row).abs() * (sizes0[row].abs() + size);
            sum += self.slopes[row][row].abs() * rounding;
        }
        if K::IS_SPRING && matches!(care, Care::Quick) {
            return sum;
        }
        sum + self.work_of_arguments(&sizes1)
    }

    #[cold]
    fn work_of_arguments(&self, sizes: &M::Variables) -> S {
        let mut sum = S::zero();
        for row in 0..M::MEASURES + M::DASHPOTS {
            let change = if row < M::MEASURES {
                self.x[row] - self.start.x0[row]
            } else {
                self.creep[row - M::MEASURES]
            };
            sum += self.magnitude_of_row(row, sizes) * change.abs();
        }
        if M::THERMAL {
            let change = self.response[Self::ENTROPY];
            sum += self.magnitude_of_row(Self::TEMPERATURE, sizes) * change.abs();
        }
        sum
    }

    /// What a response is known to, in units of ε.
    #[inline]
    fn known_to(&self, row: usize, r1: &Arms<K, S, D>, care: Care) -> S {
        match care {
            Care::Quick => self.response[row].abs(),
            Care::Thorough => {
                let sizes = self.sizes(r1, &self.x);
                self.response[row].abs() + self.resolution_of_row(row, &sizes)
            }
        }
    }

    /// Judges the balances of the internal variables at the found response, of an element that has
    /// received so much entropy, J/K, and the magnitude of the terms of its energy, J.
    #[inline]
    pub(super) fn judge(
        &self,
        view: &StepView<'_, S>,
        (contact, trial): (Option<&Contact<K, S, D>>, &Trial<S, D>),
        r1: &Arms<K, S, D>,
        (received, magnitude): (Received<S>, S),
        tally: &mut Tally<S>,
    ) {
        for k in 0..M::DASHPOTS {
            if view.phase.heats() {
                let row = M::MEASURES + k;
                let drag = self.viscosities.0[k] * self.creep_rate(k, view);
                let terms = drag.abs() + self.known_to(row, r1, tally.care);
                tally.balance(drag - self.response[row], terms);
            }
        }
        if !M::THERMAL {
            return;
        }
        let theta = self.temperature();
        let taken = theta * self.response[Self::ENTROPY];
        if !self.is_prescribed {
            let terms = magnitude + theta * received.terms;
            tally.balance(taken - theta * received.entropy, terms);
        }
        if contact.is_some()
            && let Some(slot) = self.slots().thermal
        {
            let terms = self.known_to(Self::TEMPERATURE, r1, tally.care);
            tally.balance(trial.seen.values()[slot] - theta, terms);
        }
    }

    /// The change of its energy between two states, given its nodes.
    pub(super) fn balance_between(
        &self,
        nodes: &K::PerNode<u32>,
        ends: [&State<S>; 2],
    ) -> EnergyChange<S, M> {
        let [r0, r1] = ends.map(|state| arms_in::<K, S, D>(nodes, &state.positions));
        let change = change_between::<K, S, D>(nodes, ends);
        let at = self.element.index();
        let by_values = ends[1].energies[at].value - ends[0].energies[at].value;
        let x = [
            self.variables_in(&r0, ends[0]),
            self.variables_in(&r1, ends[1]),
        ];
        let increments = self.increments_between([&r0, &r1], &change, &x, ends);
        let magnitude = x.map(|x| self.model.energy_magnitude(&x));
        EnergyChange {
            by_values: [by_values, magnitude[0] + magnitude[1]],
            by_differences: self.energy_change(&x, &increments),
            increments,
        }
    }

    /// `(Δλ, Δγ, Δs)` between two states, from what they are stored as.
    fn increments_between(
        &self,
        [r0, r1]: [&Arms<K, S, D>; 2],
        change: &Arms<K, S, D>,
        [x0, x1]: &[M::Variables; 2],
        [old, new]: [&State<S>; 2],
    ) -> M::Variables {
        let mut increments = M::Variables::filled(S::zero());
        let ends = Ends {
            r0: *r0,
            r1: *r1,
            measures0: measures_in::<K, S, D>(x0),
            measures1: measures_in::<K, S, D>(x1),
        };
        let gradient = self.kinematics.discrete_gradient(&ends);
        for (a, row) in gradient.as_ref().iter().enumerate() {
            increments[a] = along::<K, S, D>(row, change);
        }
        let slots = self.slots();
        for k in 0..M::DASHPOTS {
            increments[M::MEASURES + k] = new.viscous.change(slots.viscous + k, &old.viscous);
        }
        if let Some(slot) = slots.thermal {
            increments[Self::TEMPERATURE] = new.entropies.change(slot, &old.entropies);
        }
        increments
    }

    /// `f*Δλ − Σ g*Δγ + θ*Δs`, J.
    fn change_of(response: &M::Response, increments: &M::Variables) -> S {
        let mut sum = S::zero();
        for row in 0..Self::VARIABLES {
            let is_dashpot = (M::MEASURES..Self::TEMPERATURE).contains(&row);
            let term = response[row] * increments[row];
            sum += if is_dashpot { -term } else { term };
        }
        sum
    }

    /// `Δe` between two states by discrete derivatives that are formed anew: the values of a free energy
    /// whose terms cancel have more rounding than its differences.
    fn energy_change(&self, [x0, x1]: &[M::Variables; 2], increments: &M::Variables) -> S {
        let old = self.model.temperature_form_old(x0);
        let response = self.model.temperature_form_response(&old, x1);
        Self::change_of(&response, increments)
    }
}

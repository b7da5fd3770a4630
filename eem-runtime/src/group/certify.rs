//! What the elements contribute to the certificate of a step.

use super::arms::{along, arms_in};
use super::member::Member;
use super::site::Contact;
use crate::certificate::{Care, Recount, Tally};
use crate::free_energy::{Array, FreeEnergy};
use crate::group::element_group::ElementGroup;
use crate::group::view::{StepView, Trial};
use crate::kinematics::{Arms, Ends, Kinematics};
use crate::scalar::Real;
use crate::scheme::ElementScheme;
use crate::state::State;

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
            let at = member.element.index;
            let by_values = ends[1].energies[at].value - ends[0].energies[at].value;
            let x = ends.map(|state| member.variables_in(self.kinematics, state));
            let increments = member.increments_between(self.kinematics, &x, ends);
            let by_differences = member.energy_change(&x, &increments);
            let found = Member::<S, M, K, C, D>::change_of(&member.response, &increments);
            let magnitude = x.map(|x| member.model.energy_magnitude(&x));
            let by_values = [by_values, magnitude[0] + magnitude[1]];
            recount.element(member.element, by_values, by_differences, found);
        }
    }
}

impl<S, M, K, C, const D: usize> Member<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    /// Adds the magnitude of what `h F` is computed from to that of its nodes, N s, given the change of
    /// the arms:
    ///
    /// ```text
    /// h (|f*| + Σ |∂f*/∂x_j| |x_j|) (1 + |Δr|/λ)
    /// ```
    #[cold]
    pub(super) fn add_magnitude(&self, h: S, change: &Arms<K, S, D>, magnitudes: &mut [S]) {
        let mut sum = S::zero();
        for a in 0..M::MEASURES {
            sum += self.response[a].abs() + self.resolution_of_row(a);
        }
        let mut largest = S::zero();
        for arm in change.as_ref() {
            for component in arm {
                largest = largest.maximum(component.abs());
            }
        }
        let shortest = self.start.x0[0].minimum(self.x[0]);
        let magnitude = h * sum * (S::one() + largest / shortest);
        for &node in self.site.nodes.as_ref() {
            magnitudes[node as usize] += magnitude;
        }
    }

    /// `Σ_j |T_ij| |x_j|`: times ε, what rounding of the variables does to a response.
    fn magnitude_of_row(&self, row: usize) -> S {
        let terms = self.slopes[row].as_ref().iter().zip(self.x.as_ref());
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
    fn resolution_of_row(&self, row: usize) -> S {
        let mut sum = self.magnitude_of_row(row);
        for a in 0..M::MEASURES {
            let by_measure = &self.condensed.by_measure[a];
            for u in 0..Self::UNKNOWNS {
                let answer = by_measure.get(u) * self.x[a];
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
    /// The part with ε is what rounding of a state at the bottom of a well does.
    #[inline]
    pub(super) fn amplitude(&self, care: Care) -> S {
        let (x0, x1) = (&self.start.x0, &self.x);
        let mut sum = S::zero();
        for row in 0..M::MEASURES + M::DASHPOTS {
            let size = x1[row].abs();
            let rounding = S::EPSILON * size * size;
            sum += self.response[row].abs() * (x0[row].abs() + size);
            sum += self.slopes[row][row].abs() * rounding;
        }
        match care {
            Care::Quick => sum,
            Care::Thorough => sum + self.work_of_arguments(),
        }
    }

    #[cold]
    fn work_of_arguments(&self) -> S {
        let mut sum = S::zero();
        for row in 0..M::MEASURES + M::DASHPOTS {
            let change = if row < M::MEASURES {
                self.x[row] - self.start.x0[row]
            } else {
                self.creep[row - M::MEASURES]
            };
            sum += self.magnitude_of_row(row) * change.abs();
        }
        if M::THERMAL {
            let change = self.response[Self::ENTROPY];
            sum += self.magnitude_of_row(Self::TEMPERATURE) * change.abs();
        }
        sum
    }

    /// What a response is known to, in units of ε.
    #[inline]
    fn known_to(&self, row: usize, care: Care) -> S {
        match care {
            Care::Quick => self.response[row].abs(),
            Care::Thorough => self.response[row].abs() + self.resolution_of_row(row),
        }
    }

    /// Judges the balances of the internal variables at the found response, of an element that has
    /// received so much entropy, J/K, and the magnitude of the terms of its energy, J.
    #[inline]
    pub(super) fn judge(
        &self,
        view: &StepView<'_, S>,
        (contact, trial): (Option<&Contact<K, S, D>>, &Trial<S, D>),
        [received, magnitude]: [S; 2],
        tally: &mut Tally<S>,
    ) {
        for k in 0..M::DASHPOTS {
            if view.phase.heats() {
                let row = M::MEASURES + k;
                let drag = self.viscosities.0[k] * self.creep_rate(k, view);
                let terms = drag.abs() + self.known_to(row, tally.care);
                tally.balance(drag - self.response[row], terms);
            }
        }
        if !M::THERMAL {
            return;
        }
        let theta = self.temperature();
        let taken = theta * self.response[Self::ENTROPY];
        if !self.is_prescribed {
            tally.balance(taken - theta * received, magnitude);
        }
        if contact.is_some()
            && let Some(slot) = self.slots().thermal
        {
            let terms = self.known_to(Self::TEMPERATURE, tally.care);
            tally.balance(trial.seen.values()[slot] - theta, terms);
        }
    }

    /// `(Δλ, Δγ, Δs)` between two states, from what they are stored as.
    fn increments_between(
        &self,
        kinematics: K,
        [x0, x1]: &[M::Variables; 2],
        [old, new]: [&State<S>; 2],
    ) -> M::Variables {
        let mut increments = M::Variables::filled(S::zero());
        let [r0, r1] = [old, new].map(|s| arms_in::<K, S, D>(&self.site.nodes, &s.positions));
        let ends = Ends {
            r0,
            r1,
            measures0: super::arms::measures_in::<K, S, D>(x0),
            measures1: super::arms::measures_in::<K, S, D>(x1),
        };
        let mut change = Arms::<K, S, D>::filled([S::zero(); D]);
        let nodes = self.site.nodes.as_ref();
        for (arm, &node) in change.as_mut().iter_mut().zip(&nodes[1..]) {
            for (axis, component) in arm.iter_mut().enumerate() {
                let moved = |node: u32| {
                    new.positions
                        .change(node as usize * D + axis, &old.positions)
                };
                *component = moved(node) - moved(nodes[0]);
            }
        }
        let gradient = kinematics.discrete_gradient(&ends);
        for (a, row) in gradient.as_ref().iter().enumerate() {
            increments[a] = along::<K, S, D>(row, &change);
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

//! From the solution of the global system to the internal variables of the elements.

use super::member::Member;
use super::pose::along;
use super::site::{Contact, Site};
use super::{ElementGroup, StepView};
use crate::free_energy::{Array, FreeEnergy};
use crate::kinematics::{Arms, Kinematics};
use crate::scalar::Real;
use crate::scheme::ElementScheme;

impl<S, M, K, C, const D: usize> ElementGroup<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    /// See [`Group::correct`](super::Group::correct).
    pub(super) fn correct_all(&mut self, view: &StepView<'_, S>, solution: &[[S; 1]]) -> S {
        let mut largest = S::zero();
        for member in &mut self.members {
            let contact = member.site.contact.map(|at| &self.contacts[at]);
            let update = member.correct(view, contact, solution);
            largest = largest.maximum(update);
        }
        largest
    }
}

impl<S, M, K, C, const D: usize> Member<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    /// Finds the corrections of the local unknowns; the largest in their units.
    #[inline]
    fn correct(
        &mut self,
        view: &StepView<'_, S>,
        contact: Option<&Contact<K, S, D>>,
        solution: &[[S; 1]],
    ) -> S {
        let motion = self.site.motion_in(solution);
        let mut heat = contact.map_or(S::zero(), |contact| {
            self.heat_factor(view) * contact.heat(solution)
        });
        if C::IN_TEMPERATURE {
            heat += along::<K, S, D>(&self.by_increment, &motion);
        }
        let mut correction = M::Variables::filled(S::zero());
        for a in 0..M::MEASURES {
            correction[a] = along::<K, S, D>(&self.sensitivity[a], &motion);
        }
        for u in 0..Self::UNKNOWNS {
            let mut change = self.condensed.constant[u] + self.condensed.by_heat[u] * heat;
            for a in 0..M::MEASURES {
                change += self.condensed.by_measure[u][a] * correction[a];
            }
            correction[M::MEASURES + u] = -change;
        }
        self.previous = self.x;
        self.correction = correction;
        if M::THERMAL && C::FINDS_TEMPERATURE {
            self.previous_entropy_change = self.answer.response[Self::ENTROPY];
            let row = &self.answer.tangent[Self::ENTROPY];
            let terms = row.as_ref().iter().zip(correction.as_ref());
            self.entropy_correction = terms.fold(S::zero(), |sum, (&a, &b)| sum + a * b);
        }
        let mut largest = S::zero();
        for index in M::MEASURES..Self::TEMPERATURE {
            let scaled = correction[index] / self.start.x0[0];
            largest = largest.maximum(scaled.abs());
        }
        if M::THERMAL {
            let scaled = correction[Self::TEMPERATURE] / self.x[Self::TEMPERATURE];
            largest = largest.maximum(scaled.abs());
        }
        largest
    }
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> Site<K, S, D> {
    /// The corrections of the arms.
    #[inline]
    pub(super) fn motion_in(&self, solution: &[[S; 1]]) -> Arms<K, S, D> {
        let mut motion = Arms::<K, S, D>::filled([S::zero(); D]);
        let rows = self.rows.as_ref();
        let first = &solution[rows[0]..][..D];
        for (arm, &row) in motion.as_mut().iter_mut().zip(&rows[1..]) {
            let other = &solution[row..][..D];
            for axis in 0..D {
                arm[axis] = other[axis][0] - first[axis][0];
            }
        }
        motion
    }
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> Contact<K, S, D> {
    /// `Σ κ (δΘ_partner − δΘ)`, W.
    #[inline]
    fn heat(&self, solution: &[[S; 1]]) -> S {
        let own = solution[self.unknown][0];
        self.partners.iter().fold(S::zero(), |sum, partner| {
            sum + partner.conductance * (solution[partner.unknown][0] - own)
        })
    }
}

//! From the elements to the global system.

use super::arms::{add_scaled, scale};
use super::point::Point;
use super::pose::Pose;
use super::site::{Contact, Site};
use crate::element::conjugates::{ElementScheme, Form};
use crate::element::group::view::Trial;
use crate::element::kinematics::{Arms, Blocks, Gradient, Kinematics, Measures};
use crate::material::free_energy::{Array, FreeEnergy};
use crate::number::scalar::Real;

/// Where an element writes.
pub(super) struct Target<'a, K: Kinematics<S, D>, S: Real, const D: usize> {
    pub(super) values: &'a mut [S],
    pub(super) right: &'a mut [[S; 1]],
    pub(super) site: &'a Site<K, S, D>,
    pub(super) contact: Option<&'a Contact<K, S, D>>,
}

/// What the points of an element add to the momentum balances of its nodes.
pub(super) struct Momentum<K: Kinematics<S, D>, S: Real, const D: usize> {
    /// `h w Gᵀ f*`, with the internal variables eliminated, N s.
    pub(super) pull: Arms<K, S, D>,
    /// Its derivatives.
    pub(super) blocks: Blocks<K, S, D>,
}

/// A response with the internal variables eliminated: `value + Σ_a by_measure_a δπ_a − by_heat δr_s`.
struct CondensedRow<K: Kinematics<S, D>, S: Real, const D: usize> {
    value: S,
    by_measure: Measures<K, S, D>,
    by_heat: S,
}

impl<S, M, K, C, const D: usize> Point<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    #[inline]
    fn condensed_row(
        &self,
        row: usize,
        (response, tangent): &Form<S, M>,
        is_coupled: bool,
    ) -> CondensedRow<K, S, D> {
        let mut condensed = CondensedRow::<K, S, D> {
            value: response[row],
            by_measure: Measures::<K, S, D>::filled(S::zero()),
            by_heat: S::zero(),
        };
        for a in 0..M::MEASURES {
            condensed.by_measure[a] = tangent[row][a];
        }
        for u in 0..Self::UNKNOWNS {
            let by_unknown = tangent[row][M::MEASURES + u];
            condensed.value -= by_unknown * self.condensed.constant.get(u);
            for a in 0..M::MEASURES {
                condensed.by_measure[a] -= by_unknown * self.condensed.by_measure[a].get(u);
            }
            if Self::depends_on_heat(is_coupled) {
                condensed.by_heat += by_unknown * self.condensed.by_heat.get(u);
            }
        }
        condensed
    }

    /// The derivative of a condensed response by the new arms, times a factor.
    #[inline]
    fn by_arm(&self, row: &CondensedRow<K, S, D>, factor: S) -> Arms<K, S, D> {
        let mut sum = self.sensitivity[0];
        scale::<K, S, D>(&mut sum, factor * row.by_measure[0]);
        for a in 1..M::MEASURES {
            let by = factor * row.by_measure[a];
            add_scaled::<K, S, D>(&mut sum, by, &self.sensitivity[a]);
        }
        if C::IN_TEMPERATURE || (M::THERMAL && Self::HAS_RATES) {
            for at_point in self.single.as_ref() {
                let by = -factor * row.by_heat;
                add_scaled::<K, S, D>(&mut sum, by, &at_point.by_increment);
            }
        }
        sum
    }

    /// Adds the impulse `h w Gᵀ f*` on the nodes and its derivatives by them to those of the points before;
    /// the derivatives by seen temperatures go to their places.
    #[inline]
    pub(super) fn add_momentum(
        &self,
        step: S,
        pose: &Pose<K, S, D>,
        (form, by_rate): (&Form<S, M>, Option<&Gradient<K, S, D>>),
        target: &mut Target<'_, K, S, D>,
        sum: &mut Option<Momentum<K, S, D>>,
    ) {
        let impulse = step * S::from_f64(C::IMPLICIT);
        let mut forces = Measures::<K, S, D>::filled(S::zero());
        let mut forces_by_arm = pose.direction;
        let mut values = forces;
        for a in 0..M::MEASURES {
            let row = self.condensed_row(a, form, target.contact.is_some());
            forces[a] = impulse * form.0[a];
            forces_by_arm[a] = self.by_arm(&row, impulse);
            if let Some(by_rate) = by_rate
                && a < Self::DRAGS
            {
                let by = self.force_by_rate(a, step.recip(), impulse, by_rate);
                add_scaled::<K, S, D>(&mut forces_by_arm[a], S::one(), &by);
            }
            values[a] = impulse * row.value;
            if M::THERMAL
                && let Some(contact) = target.contact
            {
                let mut heat = pose.direction[a];
                let factor = impulse * row.by_heat * self.condensed.heat_factor;
                scale::<K, S, D>(&mut heat, -factor);
                contact.add_partners(target.site, &heat, target.values);
            }
        }
        let (kinematics, at) = (&self.kinematics, C::PLACEMENT);
        let pull = pose.pull(kinematics, at, &values);
        match sum {
            // Springs have one point, and no sum.
            None => {
                *sum = Some(Momentum {
                    pull,
                    blocks: pose.tangent(kinematics, at, &forces, &forces_by_arm),
                });
            }
            Some(sum) => {
                add_scaled::<K, S, D>(&mut sum.pull, S::one(), &pull);
                let blocks = &mut sum.blocks;
                pose.add_tangent(kinematics, at, (&forces, &forces_by_arm), blocks);
            }
        }
    }

    /// The equation `Θ − θ* = 0` of an element whose temperature neighbours see.
    #[inline]
    pub(super) fn assemble_temperature(
        &self,
        trial: &Trial<S, D>,
        form: &Form<S, M>,
        target: &mut Target<'_, K, S, D>,
    ) {
        let (Some(contact), Some(slot)) = (target.contact, self.slots().thermal) else {
            return;
        };
        let row = self.condensed_row(Self::TEMPERATURE, form, true);
        let seen = trial.seen.values()[slot];
        target.right[contact.unknown as usize][0] += row.value - seen;
        let by_arm = self.by_arm(&row, S::one());
        target
            .site
            .subtract_arms(&by_arm, &contact.row, target.values);
        let heat = row.by_heat * self.condensed.heat_factor;
        let mut diagonal = S::one();
        for partner in &contact.partners {
            let entry = heat * partner.conductance;
            target.values[partner.entry as usize] += entry;
            diagonal -= entry;
        }
        target.values[contact.diagonal as usize] += diagonal;
    }
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> Site<K, S, D> {
    /// Adds what the points of the element add to the balances of its nodes.
    #[expect(
        clippy::inline_always,
        reason = "a call of its own costs 2 % of a step"
    )]
    #[inline(always)]
    pub(super) fn add_momentum(
        &self,
        momentum: &Momentum<K, S, D>,
        right: &mut [S],
        values: &mut [S],
    ) {
        self.subtract_arms(&momentum.pull, &self.rows, right);
        for (i, row) in momentum.blocks.as_ref().iter().enumerate() {
            for (j, block) in row.as_ref().iter().enumerate() {
                self.add_block([i + 1, j + 1], block, values);
            }
        }
    }
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> Contact<K, S, D> {
    /// Adds the derivatives of something per arm times `Σ κ (Θ_partner − Θ)` to the rows of the nodes.
    #[inline]
    fn add_partners(&self, site: &Site<K, S, D>, arms: &Arms<K, S, D>, values: &mut [S]) {
        let mut sum = S::zero();
        for partner in &self.partners {
            let mut by_partner = *arms;
            scale::<K, S, D>(&mut by_partner, partner.conductance);
            sum += partner.conductance;
            site.add_column(&partner.column, &by_partner, values);
        }
        let mut by_own = *arms;
        scale::<K, S, D>(&mut by_own, -sum);
        site.add_column(&self.column, &by_own, values);
    }
}

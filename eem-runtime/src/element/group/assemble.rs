//! What a point adds to the share of its element in the global system.

use super::arms::{add_scaled, scale};
use super::point::Point;
use super::pose::Pose;
use super::share::{Heat, Momentum};
use crate::element::conjugates::{ElementScheme, Form};
use crate::element::group::view::Trial;
use crate::element::kinematics::{Arms, Gradient, Kinematics, Measures};
use eem_material::free_energy::{Array, Material};
use eem_material::number::scalar::Real;

/// A response with the internal variables eliminated: `value + Σ_a by_measure_a δπ_a − by_heat δr_s`.
struct CondensedRow<K: Kinematics<S, D>, S: Real, const D: usize> {
    value: S,
    by_measure: Measures<K, S, D>,
    by_heat: S,
}

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, C: ElementScheme<S, M>, const D: usize>
    Point<S, M, K, C, D>
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
            if self.depends_on_heat(is_coupled) {
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
        if self.scheme.is_in_temperature() || (M::THERMAL && Self::HAS_RATES) {
            for at_point in self.single.as_ref() {
                let by = -factor * row.by_heat;
                add_scaled::<K, S, D>(&mut sum, by, &at_point.by_increment);
            }
        }
        sum
    }

    /// Adds the impulse `h w Gᵀ f*` on the nodes and its derivatives to those of the points before, and the
    /// derivative by heat from other points to `heat`, if the point receives any.
    #[inline]
    pub(super) fn add_momentum(
        &self,
        step: S,
        pose: &Pose<K, S, D>,
        (form, by_rate): (&Form<S, M>, Option<&Gradient<K, S, D>>),
        heat: &mut Option<Heat<K, S, D>>,
        sum: &mut Option<Momentum<K, S, D>>,
    ) {
        let impulse = step * S::from_f64(self.scheme.implicit());
        let mut forces = Measures::<K, S, D>::filled(S::zero());
        let mut forces_by_arm = pose.direction;
        let mut values = forces;
        for a in 0..M::MEASURES {
            let row = self.condensed_row(a, form, heat.is_some());
            forces[a] = impulse * form.0[a];
            forces_by_arm[a] = self.by_arm(&row, impulse);
            if let Some(by_rate) = by_rate
                && a < Self::DRAGS
            {
                let by = self.force_by_rate(a, step.recip(), impulse, by_rate);
                add_scaled::<K, S, D>(&mut forces_by_arm[a], S::one(), &by);
            }
            values[a] = impulse * row.value;
            if let Some(heat) = heat {
                let by_heat = impulse * row.by_heat * self.condensed.heat_factor;
                add_scaled::<K, S, D>(&mut heat.pull, -by_heat, &pose.direction[a]);
            }
        }
        let (kinematics, at) = (&self.kinematics, self.scheme.placement());
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

    /// The equation `Θ − θ* = 0` of a point whose temperature neighbours see.
    #[inline]
    pub(super) fn heat(&self, trial: &Trial<S, D>, form: &Form<S, M>) -> Heat<K, S, D> {
        let row = self.condensed_row(Self::TEMPERATURE, form, true);
        let seen = trial.seen.values()[self.slots().thermal.unwrap_or_default()];
        Heat {
            residual: row.value - seen,
            by_arm: self.by_arm(&row, S::one()),
            slope: row.by_heat * self.condensed.heat_factor,
            pull: Arms::<K, S, D>::filled([S::zero(); D]),
        }
    }
}

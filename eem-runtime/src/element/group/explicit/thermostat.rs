//! The part of the heat of thermostats that depends on the course of their temperature.

use crate::element::group::arms::along;
use crate::element::group::explicit::point::ExplicitPoint;
use crate::element::group::explicit::rates::arms_of;
use crate::element::group::explicit::stage::{Place, Stage};
use crate::element::kinematics::Kinematics;
use eem_material::free_energy::Material;

impl<M: Material, K: Kinematics<D>, const D: usize> ExplicitPoint<M, K, D> {
    /// Adds the present stage to the integrals of its [thermostat](crate::element::group::explicit::stage::Thermostat).
    #[cold]
    pub(super) fn integrate_thermostat(
        &self,
        slot: usize,
        (places, stage): (&[Place<D>], &mut Stage),
        is_start: bool,
    ) {
        let (theta, thermostat) = (stage.theta(slot), &stage.thermostats[slot]);
        let last = thermostat.last;
        #[expect(
            clippy::float_cmp,
            reason = "a temperature that is held is the same number"
        )]
        if theta == last {
            return;
        }
        let r = arms_of::<K, D>(&self.nodes, places, Place::q);
        let measures = self.kinematics.measure(&r);
        let gradient = self.kinematics.gradient(&r, &measures);
        let motion = arms_of::<K, D>(&self.nodes, places, Place::velocity);
        let x = self.variables_at(&measures, stage, theta);
        let at_last = self.variables_at(&measures, stage, last);
        let (own, other) = (
            self.model.rates(&x).forces,
            self.model.rates(&at_last).forces,
        );
        let mut rate = thermostat.excess(theta) * thermostat.received;
        for a in 0..M::MEASURES {
            rate += (own[a] - other[a]) * along::<K, D>(&gradient[a], &motion);
        }
        for k in 0..self.model.dashpots() {
            let at = M::MEASURES + k;
            rate -= (own[at] - other[at]) * stage.inner_rates[self.viscous(k)];
        }
        let (weight, thermostat) = (stage.weight, &mut stage.thermostats[slot]);
        thermostat.sum += weight * rate;
        if is_start {
            thermostat.warming = self.model.free_energy(&at_last) - self.model.free_energy(&x);
        }
    }
}

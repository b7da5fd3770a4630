//! Forces and rates of elements at a stage.
//!
//! ```text
//! γ̇ = g/η,     Q = Σ g γ̇ + heat that flows in,     θ̇ = (Q − θ (s_λ λ̇ + Σ s_γ γ̇))/c
//! ```

use crate::algebra::vector;
use crate::element::conjugates::Infeasible;
use crate::element::error::StateError;
use crate::element::group::arms::{add_scaled, scale};
use crate::element::group::explicit::closed::Found;
use crate::element::group::explicit::point::ExplicitPoint;
use crate::element::group::explicit::stage::{Place, Stage};
use crate::element::kinematics::{Arms, Kinematics, MeasureSet, Measures};
use eem_material::free_energy::{Array, Material, Rates};
use eem_material::number::scalar::is_positive;

/// The arms of an element, or their rates.
#[inline]
pub(super) fn arms_of<K: Kinematics<D>, const D: usize>(
    nodes: &K::PerNode<u32>,
    places: &[Place<D>],
    of: impl Fn(&Place<D>) -> &[f64; D],
) -> Arms<K, D> {
    let first = of(&places[nodes[0] as usize]);
    let mut arms = Arms::<K, D>::filled([0.0; D]);
    for (index, arm) in arms.as_mut().iter_mut().enumerate() {
        let other = of(&places[nodes[index + 1] as usize]);
        *arm = vector(|axis| other[axis] - first[axis]);
    }
    arms
}

/// `Σ_i g_i · w_i` over the arms. The sums begin with −0, to which a number is added without an instruction: whether nothing moves at
/// the speed 0 or −0 changes no rate, as no heat is −0.
#[inline]
fn speed_along<K: Kinematics<D>, const D: usize>(
    gradient: &Arms<K, D>,
    motion: &Arms<K, D>,
) -> f64 {
    let mut speed = -0.0;
    for (g, w) in gradient.as_ref().iter().zip(motion.as_ref()) {
        let mut own = -0.0;
        for axis in 0..D {
            own += g[axis] * w[axis];
        }
        speed += own;
    }
    speed
}

/// Whether a number is finite. By its magnitude, which takes fewer instructions than by its bits.
#[inline]
fn is_number(value: f64) -> bool {
    value.abs() <= f64::MAX
}

impl<M: Material, K: Kinematics<D>, const D: usize> ExplicitPoint<M, K, D> {
    /// Adds its forces and writes its rates at a stage; returns whether they are valid.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "called in the hottest loop")]
    pub(super) fn add_rates(&self, places: &mut [Place<D>], stage: &mut Stage) -> bool {
        let r = arms_of::<K, D>(&self.nodes, places, Place::q);
        let measures = self.kinematics.measure(&r);
        let found = self.found_at(&r, &measures, stage);
        let is_sound = self.write_rates(&found, (&mut *places, &mut *stage));
        is_sound && self.kinematics.is_admissible(&r, &measures)
    }

    #[inline(always)]
    #[expect(clippy::inline_always, reason = "what was found stays in registers")]
    fn found_at(&self, r: &Arms<K, D>, measures: &Measures<K, D>, stage: &Stage) -> Found<M, K, D> {
        let theta = self.temperature_in(stage);
        // Called first: a call of `exp` would spill the registers used below.
        let viscosities = match M::DASHPOTS {
            0 => M::Viscosities::filled(0.0),
            _ => self.model.viscosity(theta).0,
        };
        Found {
            theta,
            rates: self.model.rates(&self.variables_at(measures, stage, theta)),
            viscosities,
            gradient: self.kinematics.gradient(r, measures),
        }
    }

    /// The variables at a stage with these measures.
    #[inline]
    pub(super) fn variables_at(
        &self,
        measures: &Measures<K, D>,
        stage: &Stage,
        theta: f64,
    ) -> M::Variables {
        let mut x = M::Variables::filled(0.0);
        for (a, &measure) in measures.as_ref().iter().enumerate() {
            x[a] = measure;
        }
        for k in 0..self.model.dashpots() {
            x[M::MEASURES + k] = stage.inner[self.viscous(k)];
        }
        if self.model.is_thermal() {
            x[Self::TEMPERATURE] = theta;
        }
        x
    }

    /// Adds its forces on the nodes, and writes its rates; returns whether all are finite.
    #[inline(always)]
    #[expect(
        clippy::inline_always,
        reason = "what was found stays in registers, and there are two callers"
    )]
    pub(super) fn write_rates(
        &self,
        found: &Found<M, K, D>,
        (places, stage): (&mut [Place<D>], &mut Stage),
    ) -> bool {
        let (at, nodes, is_thermal) = (self.temperature(), self.nodes, self.model.is_thermal());
        let motion = arms_of::<K, D>(&nodes, places, Place::velocity);
        let Rates { forces, slopes } = &found.rates;
        let mut pull = found.gradient[0];
        scale::<K, D>(&mut pull, forces[0]);
        let speed = speed_along::<K, D>(&found.gradient[0], &motion);
        let (mut power, mut drift) = (forces[0] * speed, slopes[0] * speed);
        for a in 1..M::MEASURES {
            add_scaled::<K, D>(&mut pull, forces[a], &found.gradient[a]);
            let speed = speed_along::<K, D>(&found.gradient[a], &motion);
            power += forces[a] * speed;
            drift += slopes[a] * speed;
        }
        for (index, arm) in pull.as_ref().iter().enumerate() {
            places[nodes[index + 1] as usize].push(arm);
            places[nodes[0] as usize].pull(arm);
        }
        let flow = if is_thermal {
            stage.inner_rates[at]
        } else {
            0.0
        };
        let (mut heat, mut is_sound) = (flow, true);
        let per_theta = if is_thermal && M::DASHPOTS > 0 {
            found.theta.recip()
        } else {
            1.0
        };
        for k in 0..self.model.dashpots() {
            let g = forces[M::MEASURES + k];
            let creep = g / found.viscosities[k];
            stage.inner_rates[self.viscous(k)] = creep;
            let power = g * creep;
            stage.productions[self.viscous(k)].add(stage.weight, power * per_theta);
            if stage.has_heats {
                stage.add_heat(self.viscous(k), power);
            }
            heat += power;
            drift += slopes[M::MEASURES + k] * creep;
            is_sound &= found.viscosities[k] > 0.0;
            // With temperature, θ̇ contains the heat of the dashpot and is checked itself.
            is_sound &= is_thermal || is_number(creep);
        }
        if !is_thermal {
            return is_sound && is_number(power);
        }
        let capacity = forces[Self::TEMPERATURE];
        let heating = (heat - found.theta * drift) / capacity;
        stage.inner_rates[at] = heating;
        if stage.has_thermostats {
            stage.receive(at, heat);
        }
        is_sound &= is_number(heating);
        let is_stable = capacity > 0.0 && found.theta > 0.0;
        is_sound && is_stable
    }

    /// The error of an element that has no valid rates.
    #[cold]
    pub(super) fn refuse(&self, (places, stage): (&[Place<D>], &Stage)) -> StateError {
        let (element, is_thermal) = (self.element, self.model.is_thermal());
        let r = &arms_of::<K, D>(&self.nodes, places, Place::q);
        let measures = self.kinematics.measure(r);
        if !self.kinematics.is_admissible(r, &measures) {
            return self.kinematics.refusal(element, r);
        }
        let found = self.found_at(r, &measures, stage);
        let theta = found.theta;
        if is_thermal && !is_positive(theta) {
            let value = theta;
            return StateError::Temperature { element, value };
        }
        if is_thermal
            && let Err(infeasible) =
                Infeasible::unless_stable(found.rates.forces[Self::TEMPERATURE], theta)
        {
            return infeasible.of(element);
        }
        let viscosities = found.viscosities.as_ref()[..self.model.dashpots()].iter();
        for (dashpot, &eta) in viscosities.enumerate() {
            if !is_positive(eta) {
                return StateError::Viscosity {
                    element,
                    dashpot,
                    value: eta,
                    unit: K::Measures::VISCOSITY_UNIT,
                    temperature: is_thermal.then_some(theta),
                };
            }
        }
        StateError::NotFinite {
            element,
            quantity: "rate of change",
            value: found.rates.forces[0],
        }
    }
}

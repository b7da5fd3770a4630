//! The closing of a step: energy and angular momentum back at their targets, without loss of entropy.
//!
//! J is restored by a rigid rotation ω of the velocities. The defect d = E − E(q, p, γ, s) of the energy then goes
//! into the first of three corrections that can take it:
//!
//! | correction | change | condition |
//! |---|---|---|
//! | heat | every spring scales the entropy that it has produced itself by 1 + ε | `\|ε\|` ≤ 0.003 |
//! | motion | p += a p′, with the momentum p′ relative to the rigid rotation | p′ carries a twentieth of D |
//! | shape | p, q, γ and the conducted heat move along the gradient of E, by α = d/D | `\|α\|` < 0.1 |
//!
//! D = 2 T′ + h² Σ |F|²/m + h g²/η + 2hκ (θ₁ − θ₀)²/(θ₀ + θ₁) is the rate of E along that gradient. The library has
//! two more corrections, for steady rotation and rest; here such a step is rejected.

use super::ROUNDING;
use super::inertia::Inertia;
use super::model::{Edge, Pendulum, Point, angular_momentum, cross, edges, kinetic_energy, vector};
use super::quadrature::{Entropies, Production};
use super::stages::{add_forces, gamma_of, temperatures};

/// Largest relative change of the produced entropies.
const MOST_HEAT: f64 = 0.003;
/// Changes of ln θ up to which the second order is exact to rounding.
const SMALL_HEAT: f64 = 2e-8;
/// Part of D that the internal motion has to carry.
const LEAST_MOTION: f64 = 0.05;
/// Largest α.
const MOST_SHAPE: f64 = 0.1;
/// Corrections by heat and by shape, and all.
const MOST_TURNS: [usize; 3] = [3, 5, 10];

/// What every closed state has.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Target {
    /// E, J.
    pub(super) energy: f64,
    /// J, N m s.
    pub(super) momentum: [f64; 3],
    /// Σ (|e| + θ (|s| + c)) at the start, J: rounding of the energy is relative to it.
    pub(super) size: f64,
}

/// A state in the course of its closing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Closing<const N: usize> {
    pub(super) y: [f64; N],
    pub(super) entropies: Entropies,
    pub(super) edges: [Edge; 2],
    pub(super) points: [Point; 2],
    /// Of the springs and the reservoir, J.
    potential: f64,
    /// What each spring has produced itself, J/K.
    produced: [f64; 2],
}

/// p′, the momentum relative to the rigid rotation ω, its kinetic energy T′, and ω.
struct Motion<const N: usize> {
    momenta: [f64; N],
    energy: f64,
    rotation: [f64; 3],
}

impl<const N: usize> Closing<N> {
    pub(super) fn new(y: [f64; N], entropies: Entropies) -> Self {
        Self {
            y,
            entropies,
            edges: [Edge::default(); 2],
            points: [Point::default(); 2],
            potential: 0.0,
            produced: [0.0; 2],
        }
    }

    /// Evaluates springs at (λ, γ, s): θ and `potential`. False if one of them has no admissible state.
    #[inline(always)]
    pub(super) fn evaluate<C: Pendulum<N, X>, const X: usize>(&mut self) -> bool {
        self.edges = edges::<C, N, X>(&self.y);
        self.potential = 0.0;
        let mut is_admissible = true;
        for spring in 0..C::COUNT {
            let gamma = gamma_of::<C, N, X>(&self.y, spring);
            let guess = self.y[C::THETA + spring];
            let entropy = self.entropies.value[spring];
            let length = self.edges[spring].length;
            let point = C::at_entropy(spring, length, gamma, entropy, guess);
            self.y[C::THETA + spring] = point.theta;
            self.potential += point.energy;
            is_admissible &= point.is_admissible();
            self.points[spring] = point;
        }
        if C::HAS_RESERVOIR {
            self.potential += C::RESERVOIR * self.entropies.value[1];
        }
        is_admissible & self.potential.is_finite()
    }

    /// The target that this state has itself.
    pub(super) fn own_target<C: Pendulum<N, X>, const X: usize>(&self) -> Target {
        let mut size = 0.0;
        for (point, entropy) in self.points.iter().zip(self.entropies.value).take(C::COUNT) {
            size += point.theta * (entropy.abs() + point.capacity) + point.energy.abs();
        }
        Target {
            energy: self.potential + kinetic_energy::<C, N, X>(&self.y),
            momentum: angular_momentum::<C, N, X>(&self.y),
            size,
        }
    }

    /// Closes the state after a step of size h; the relative defect that it had, or nothing if it cannot be closed.
    #[inline(always)]
    pub(super) fn close<C: Pendulum<N, X>, const X: usize>(
        &mut self,
        h: f64,
        target: &Target,
        production: Production,
    ) -> Option<f64> {
        let [heats, shapes, turns] = MOST_TURNS;
        let (mut first_defect, mut is_heated, mut is_evaluated) = (0.0, false, false);
        for turn in 0..turns {
            if !is_evaluated && !self.evaluate::<C, X>() {
                return None;
            }
            is_evaluated = false;
            if turn == 0 {
                self.distribute::<C, X>(production);
            }
            let inertia = Inertia::of::<C, N, X>(&self.y);
            self.restore_momentum::<C, X>(&inertia, target);
            let kinetic = kinetic_energy::<C, N, X>(&self.y);
            let defect = target.energy - self.potential - kinetic;
            let size = target.energy.abs() + kinetic + target.size;
            if turn == 0 {
                first_defect = defect.abs() / size;
            }
            if defect.abs() <= 2.0 * ROUNDING * size {
                return Some(first_defect);
            }
            let mut producible = 0.0;
            for (produced, point) in self.produced.iter().zip(&self.points).take(C::COUNT) {
                producible += produced * point.theta;
            }
            if turn < heats && defect.abs() <= MOST_HEAT * producible {
                is_evaluated = self.heat::<C, X>(defect / producible);
                is_heated = true;
                continue;
            }
            let motion = self.motion::<C, X>(&inertia);
            if is_heated && defect.abs() <= 1e-9 * motion.energy {
                self.scale_motion::<C, X>(&motion, defect);
                return Some(first_defect);
            }
            let forces = self.effective_forces::<C, X>(&motion);
            let twice = 2.0 * motion.energy;
            let rate = twice + self.rest_of_gradient::<C, X>(h, &forces);
            let alpha = defect / rate;
            if alpha.abs() < MOST_SHAPE && twice >= LEAST_MOTION * rate && defect > -motion.energy {
                self.scale_motion::<C, X>(&motion, defect);
                return Some(first_defect);
            }
            if alpha.abs() < MOST_SHAPE && turn < shapes {
                self.shape::<C, X>(h, alpha, &motion, &forces);
                continue;
            }
            let is_rounding = defect.abs() <= 16.0 * ROUNDING * size;
            return is_rounding.then_some(first_defect);
        }
        None
    }

    /// Gives each spring what it has produced: of the conduction between two springs in proportion to c.
    #[inline(always)]
    fn distribute<C: Pendulum<N, X>, const X: usize>(&mut self, production: Production) {
        let conduction = production.by_conduction;
        self.produced[0] = production.by_dashpot;
        if C::HAS_RESERVOIR {
            self.produced[0] += conduction;
        } else {
            let [near, far] = self.points.map(|point| point.capacity);
            let weight = near / (near + far);
            self.produced[0] += weight * conduction;
            self.produced[1] += (1.0 - weight) * conduction;
        }
    }

    /// p += m ω × q with I ω = the lack of J; once more in space, where the first time leaves some rounding.
    #[inline(always)]
    fn restore_momentum<C: Pendulum<N, X>, const X: usize>(
        &mut self,
        inertia: &Inertia,
        target: &Target,
    ) {
        for _ in 0..C::DIMENSION - 1 {
            let momentum = angular_momentum::<C, N, X>(&self.y);
            let mut lacking = target.momentum;
            for (lacking, momentum) in lacking.iter_mut().zip(momentum) {
                *lacking -= momentum;
            }
            let rotation = inertia.solve(lacking);
            for mass in 0..C::COUNT {
                let velocity = cross(rotation, vector::<C, N, X>(&self.y, 0, mass));
                for (d, velocity) in velocity.into_iter().enumerate().take(C::DIMENSION) {
                    self.y[C::P + C::DIMENSION * mass + d] += C::MASSES[mass] * velocity;
                }
            }
        }
    }

    /// Scales the produced entropies by 1 + ε, with θ (1 + r + r²/2) where a spring's ln θ changes by r. If all r are
    /// small, energy and forces follow without another evaluation, and the result is true.
    #[inline(always)]
    fn heat<C: Pendulum<N, X>, const X: usize>(&mut self, epsilon: f64) -> bool {
        let mut is_small = true;
        let (mut changes, mut relative) = ([0.0; 2], [0.0; 2]);
        for spring in 0..C::COUNT {
            changes[spring] = self.produced[spring] * epsilon;
            relative[spring] = changes[spring] / self.points[spring].capacity;
            is_small &= relative[spring].abs() < SMALL_HEAT;
        }
        let mut gained = 0.0;
        for spring in 0..C::COUNT {
            let (change, r) = (changes[spring], relative[spring]);
            let point = &mut self.points[spring];
            let warming = point.theta * r * (1.0 + 0.5 * r);
            let theta = point.theta + warming;
            if change != 0.0 {
                self.entropies.add(spring, change);
                self.produced[spring] += change;
            }
            self.y[C::THETA + spring] = theta;
            if is_small {
                gained += point.theta * change * (1.0 + 0.5 * r);
                point.theta = theta;
                point.force -= point.entropy_by_lambda * warming;
                point.dashpot_force += point.entropy_by_gamma * warming;
            }
        }
        if is_small {
            self.potential += gained;
        }
        is_small
    }

    #[inline(always)]
    fn motion<C: Pendulum<N, X>, const X: usize>(&self, inertia: &Inertia) -> Motion<N> {
        let rotation = inertia.solve(angular_momentum::<C, N, X>(&self.y));
        let (mut momenta, mut energy) = ([0.0; N], 0.0);
        for mass in 0..C::COUNT {
            let velocity = cross(rotation, vector::<C, N, X>(&self.y, 0, mass));
            let mut squared = 0.0;
            for (d, velocity) in velocity.into_iter().enumerate().take(C::DIMENSION) {
                let i = C::DIMENSION * mass + d;
                momenta[i] = self.y[C::P + i] - C::MASSES[mass] * velocity;
                squared += momenta[i] * momenta[i];
            }
            energy += squared * (0.5 / C::MASSES[mass]);
        }
        Motion {
            momenta,
            energy,
            rotation,
        }
    }

    /// p += a p′ with T′ ((1 + a)² − 1) = d: exact, and J stays, as p′ has none.
    #[inline(always)]
    fn scale_motion<C: Pendulum<N, X>, const X: usize>(&mut self, motion: &Motion<N>, defect: f64) {
        let x = defect / motion.energy;
        let scale = x / (1.0 + (1.0 + x).sqrt());
        for i in 0..C::P {
            self.y[C::P + i] += scale * motion.momenta[i];
        }
    }

    /// F − m ω × (ω × q): minus the gradient of E in q at constant J, N.
    #[inline(always)]
    fn effective_forces<C: Pendulum<N, X>, const X: usize>(&self, motion: &Motion<N>) -> [f64; N] {
        let mut forces = [0.0; N];
        for (spring, (edge, point)) in self.edges.iter().zip(&self.points).enumerate() {
            if spring < C::COUNT {
                add_forces::<C, N, X>(&mut forces, spring, edge, point.force);
            }
        }
        for mass in 0..C::COUNT {
            let velocity = cross(motion.rotation, vector::<C, N, X>(&self.y, 0, mass));
            let acceleration = cross(motion.rotation, velocity);
            for (d, acceleration) in acceleration.into_iter().enumerate().take(C::DIMENSION) {
                forces[C::DIMENSION * mass + d] -= C::MASSES[mass] * acceleration;
            }
        }
        forces
    }

    /// h² Σ |F|²/m + h g²/η + 2hκ (θ₁ − θ₀)²/(θ₀ + θ₁), J.
    #[inline(always)]
    fn rest_of_gradient<C: Pendulum<N, X>, const X: usize>(
        &self,
        h: f64,
        forces: &[f64; N],
    ) -> f64 {
        let mut by_shape = 0.0;
        for (i, force) in forces.iter().enumerate().take(C::P) {
            by_shape += force * force / C::MASSES[i / C::DIMENSION];
        }
        let mut by_heat = 0.0;
        if C::DASHPOTS > 0 {
            let point = &self.points[0];
            by_heat += h * point.dashpot_force * point.dashpot_force / point.viscosity;
        }
        let [near, far] = temperatures::<C, N, X>(&self.points);
        let difference = far - near;
        by_heat += 2.0 * h * C::CONDUCTANCE * difference * difference / (far + near);
        h * h * by_shape + by_heat
    }

    /// Moves p, q, γ and the conducted heat along the gradient of E.
    #[inline(always)]
    fn shape<C: Pendulum<N, X>, const X: usize>(
        &mut self,
        h: f64,
        alpha: f64,
        motion: &Motion<N>,
        forces: &[f64; N],
    ) {
        for (i, (momentum, force)) in motion.momenta.iter().zip(forces).enumerate().take(C::P) {
            self.y[C::P + i] += alpha * momentum;
            self.y[i] -= alpha * h * h * force / C::MASSES[i / C::DIMENSION];
        }
        if C::DASHPOTS > 0 {
            let point = &self.points[0];
            self.y[C::GAMMA] -= alpha * h * point.dashpot_force / point.viscosity;
        }
        let [near, far] = temperatures::<C, N, X>(&self.points);
        let change = 2.0 * alpha * h * C::CONDUCTANCE * (near - far) / (far + near);
        self.entropies.add(0, change);
        self.entropies.add(1, -change);
    }
}

/// exp(x) for the change x of ln θ in an iteration.
#[inline(always)]
pub(super) fn temperature_factor(x: f64) -> f64 {
    if x.abs() < 1e-3 {
        1.0 + x * (1.0 + x * (0.5 + x * (1.0 / 6.0 + x * (1.0 / 24.0))))
    } else {
        x.exp()
    }
}

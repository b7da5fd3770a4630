//! Integrals over a step by the weights of its stages.

use super::Explicit;
use super::components::Support;
use super::memory::{LoadSums, Sample};
use super::tableau::{POSITIVE_WEIGHTS, STAGES, WEIGHTED, WEIGHTS};
use super::vector::{add, difference, dot, moment};
use crate::element::group::points;
use crate::number::scalar::Real;

/// Both weights of each stage, if it has weights.
const BOTH_WEIGHTS: [Option<[f64; 2]>; STAGES] = {
    let mut all = [None; STAGES];
    let mut at = 0;
    while at < WEIGHTED.len() {
        all[WEIGHTED[at]] = Some([WEIGHTS[at], POSITIVE_WEIGHTS[at]]);
        at += 1;
    }
    all
};

impl<S: Real, const D: usize> Explicit<S, D> {
    /// Adds a stage to all integrals, at the present stage vector.
    pub(super) fn gather(&mut self, stage: usize, h: S) {
        let Some([weight, positive]) = BOTH_WEIGHTS[stage] else {
            return;
        };
        if stage == 0 {
            self.quadrature.clear();
        }
        let weights = [h * S::from_f64(weight), h * S::from_f64(positive)];
        let y = if stage == 0 { &self.y0 } else { &self.y };
        let temperatures = &y[self.offsets.temperatures..self.offsets.size];
        // Those of reservoirs are known.
        let slots = self.offsets.reservoirs - self.offsets.temperatures;
        for slot in 0..slots {
            self.per_theta[slot] = temperatures[slot].recip();
        }
        for (index, path) in self.components.paths.iter().enumerate() {
            let [a, b] = path.ends.map(|end| end as usize);
            let drop = temperatures[b] - temperatures[a];
            let flow = path.conductance * drop * self.per_theta[a];
            self.quadrature.paths[index].add(weights, flow, flow * drop * self.per_theta[b]);
        }
        let [weight, _] = weights;
        let sample = if stage == 0 { &self.start } else { &self.end };
        for (index, &slot) in self.dashpot_slots.iter().enumerate() {
            let power = weight * sample.powers[index];
            self.quadrature.dashpots[index] += power * self.per_theta[slot as usize];
        }
        for (sum, &supply) in self.quadrature.supply.iter_mut().zip(&sample.supply) {
            *sum += weight * supply;
        }
        if !self.quadrature.loads.is_empty() {
            self.gather_loads(stage, weight);
        }
    }

    /// Work, impulse and torque of loads and moved anchors.
    fn gather_loads(&mut self, stage: usize, weight: S) {
        // Taken out, as all else is read.
        let mut loads = core::mem::take(&mut self.quadrature.loads);
        let sample = if stage == 0 { &self.start } else { &self.end };
        let y = if stage == 0 { &self.y0 } else { &self.y };
        let positions = points::<S, D>(&y[..self.offsets.momenta]);
        let momenta = points::<S, D>(&y[self.offsets.momenta..self.offsets.viscous]);
        let velocities = &self.rates(stage)[..self.offsets.momenta];
        let velocities = points::<S, D>(velocities);
        for (sums, component) in loads.iter_mut().zip(&self.components.all) {
            let origin = match component.support {
                Support::Free => self.center(component, positions),
                Support::Anchor(place) => positions[place],
                Support::Several => [S::zero(); D],
            };
            let mut momentum = [S::zero(); D];
            for place in component.masses.clone() {
                let arm = difference(&positions[place], &origin);
                let node = self.components.nodes[place] as usize;
                sums.add(
                    weight,
                    [&arm, &velocities[place]],
                    sample.load(node, component.support),
                );
                add(&mut momentum, S::one(), &momenta[place]);
            }
            if let Support::Anchor(place) = component.support {
                // The angular momentum is about the anchor, wherever it goes.
                let change = moment(&velocities[place], &momentum);
                add(&mut sums.torque, -weight, &change);
            }
        }
        for (anchor, (place, _)) in self.components.anchors().enumerate() {
            let component = self.components.of_place[place] as usize;
            loads[component].work -= weight * dot(&sample.reactions[anchor], &velocities[place]);
        }
        self.quadrature.loads = loads;
    }
}

impl<S: Real, const D: usize> Sample<S, D> {
    /// On a node the force that does work, what changes the linear and what the angular momentum, N. Weights
    /// have no torque about the centre of mass.
    fn load(&self, node: usize, support: Support) -> [[S; D]; 3] {
        let zero = [S::zero(); D];
        let of = |loads: &[S]| points::<S, D>(loads).get(node).copied().unwrap_or(zero);
        let (force, load) = (of(&self.forces), of(&self.loads));
        let turning = if support == Support::Free {
            force
        } else {
            load
        };
        [force, load, turning]
    }
}

impl<S: Real, const D: usize> LoadSums<S, D> {
    #[inline]
    fn add(
        &mut self,
        weight: S,
        [arm, velocity]: [&[S; D]; 2],
        [force, load, turning]: [[S; D]; 3],
    ) {
        self.work += weight * dot(&force, velocity);
        add(&mut self.impulse, weight, &load);
        add(&mut self.torque, weight, &moment(arm, &turning));
    }
}

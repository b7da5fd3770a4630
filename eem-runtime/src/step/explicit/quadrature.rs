//! Integrals over a step by the weights of its stages.

use super::Explicit;
use super::components::Support;
use super::memory::{LoadSums, Sample};
use super::tableau::{STAGES, WEIGHTED, WEIGHTS};
use super::vector::{Origin, add, dot};
use crate::algebra::bivector::Bivector;
use crate::element::group::points;
use eem_material::number::scalar::Real;

/// Which of the stages with weights each stage is.
const WEIGHT_OF: [Option<usize>; STAGES] = {
    let mut all = [None; STAGES];
    let mut at = 0;
    while at < WEIGHTED.len() {
        all[WEIGHTED[at]] = Some(at);
        at += 1;
    }
    all
};

impl<S: Real, const D: usize> Explicit<S, D> {
    /// Keeps of a stage what paths and dashpots produce from, and adds it to all integrals of loads, at the
    /// present stage vector.
    #[inline]
    pub(super) fn gather(&mut self, stage: usize, h: S) {
        let Some(at) = WEIGHT_OF[stage] else {
            return;
        };
        let (y, sample) = if stage == 0 {
            (&self.y0, &self.start)
        } else {
            (&self.y, &self.end)
        };
        let quadrature = &mut self.quadrature;
        let temperatures = &y[self.offsets.temperatures..self.offsets.reservoirs];
        for (kept, &theta) in quadrature.temperatures.iter_mut().zip(temperatures) {
            kept[at] = theta;
        }
        for (kept, &power) in quadrature.powers.iter_mut().zip(&sample.powers) {
            kept[at] = power;
        }
        if quadrature.is_closed() {
            return;
        }
        if stage == 0 {
            quadrature.clear();
        }
        let weight = h * S::from_f64(WEIGHTS[at]);
        for (sum, &supply) in quadrature.supply.iter_mut().zip(&sample.supply) {
            *sum += weight * supply;
        }
        if !self.quadrature.loads.is_empty() {
            self.gather_loads(stage, weight);
        }
    }

    /// Work, impulse and torque of loads and moved anchors.
    #[inline(never)]
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
            let origin = self.origin_in(component, positions);
            let origin = origin.unwrap_or(Origin::at(&[S::zero(); D]));
            let mut momentum = [S::zero(); D];
            for place in component.masses.clone() {
                let arm = origin.arm(&positions[place]);
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
                let change = Bivector::wedge(&velocities[place], &momentum);
                sums.torque.add(-weight, &change);
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
        self.torque.add(weight, &Bivector::wedge(arm, &turning));
    }
}

//! The contribution of the nodes to the certificate of a step: kinetic energy, work and momenta.

use crate::algebra::bivector::Bivector;
use crate::algebra::scaled;
use crate::element::group::points;
use crate::element::state::State;
use eem_material::number::compensated::Total;
use eem_material::number::scalar::Scalar;

/// The contribution of the motion of the nodes to a certificate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion<const D: usize> {
    /// The conserved momenta, and their reference point, m.
    pub(crate) kept: Kept<D>,
    /// `Σ v̄·Δp − work`, J.
    pub(super) energy: Total,
    /// T of both ends, and the magnitude of the work of loads and supports, J.
    pub(super) kinetic: f64,
    pub(super) works: f64,
    /// `W_r`, the work of the residuals of the momentum balances, if bounds are thorough, J.
    pub(super) residual_work: f64,
    /// `Σ (Δp − hF)` of the loads F, and `Σ |p|`, kg m/s.
    pub(super) linear: [f64; D],
    pub(super) momenta: f64,
    /// `Σ (q_m − o) × (Δp − hF) + Δq × p_m`, and `Σ |q_m − o||p|` with |q| where that is larger, kg m²/s.
    pub(super) angular: Bivector<f64, D>,
    pub(super) moments: f64,
    /// The largest `|q_m − o|`, m.
    pub(super) farthest: f64,
}

/// The momenta that a scene conserves apart from its loads.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Kept<const D: usize> {
    /// None: with several anchors, moved anchors, or a scheme that does not prove its laws.
    None,
    /// With one anchor at this place: the angular momentum about it.
    Angular([f64; D]),
    /// Without anchors: both, about the origin.
    Both,
}

/// The motion of a node in a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NodeStep<'a, const D: usize> {
    pub(crate) speeds: Speeds<D>,
    /// q⁰, m.
    pub(crate) position: &'a [f64; D],
    /// p⁰, kg m/s.
    pub(crate) momentum: &'a [f64; D],
    /// Δq, m.
    pub(crate) displacement: &'a [f64; D],
    /// Δp, kg m/s.
    pub(crate) impulse: &'a [f64; D],
}

/// The velocity of a node.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Speeds<const D: usize> {
    /// `1/m`, 1/kg: `v = p/m`.
    OfMass(f64),
    /// v⁰ and Δv, m/s, where masses couple nodes.
    Given { old: [f64; D], change: [f64; D] },
}

impl<'a, const D: usize> NodeStep<'a, D> {
    /// From an old state.
    #[inline]
    pub(crate) fn new(
        (old, node): (&'a State, usize),
        speeds: Speeds<D>,
        displacement: &'a [f64; D],
        impulse: &'a [f64; D],
    ) -> Self {
        Self {
            speeds,
            position: &points(old.positions.values())[node],
            momentum: &points(old.momenta.values())[node],
            displacement,
            impulse,
        }
    }

    /// `v̄·Δp` and `½(|v⁰·p⁰| + |v¹·p¹|)`, J.
    #[inline]
    pub(crate) fn energies(&self) -> [f64; 2] {
        let (mut gain, mut size) = (0.0, 0.0);
        match &self.speeds {
            Speeds::OfMass(per_mass) => {
                for (&p, &change) in self.momentum.iter().zip(self.impulse) {
                    let end = p + change;
                    gain += (p + 0.5 * change) * change;
                    size += p * p + end * end;
                }
                [gain * *per_mass, 0.5 * size * *per_mass]
            }
            Speeds::Given { old, change } => {
                for axis in 0..D {
                    let (v, p) = (old[axis], self.momentum[axis]);
                    gain += (v + 0.5 * change[axis]) * self.impulse[axis];
                    let end = (v + change[axis]) * (p + self.impulse[axis]);
                    size += (v * p).abs() + end.abs();
                }
                [gain, 0.5 * size]
            }
        }
    }

    /// `|p¹·Δv|` with the terms of Δv, m/s: times ε, the energy of the rounding of the new velocity, J.
    #[cold]
    pub(crate) fn energy_of_rounding(&self, terms: &[f64; D]) -> f64 {
        let mut energy = 0.0;
        let momenta = self.momentum.iter().zip(self.impulse);
        for ((&momentum, &impulse), &terms) in momenta.zip(terms) {
            energy += ((momentum + impulse) * terms).abs();
        }
        energy
    }
}

impl<const D: usize> Motion<D> {
    #[inline]
    pub(crate) fn new(kept: Kept<D>) -> Self {
        Self {
            kept,
            energy: Total::default(),
            kinetic: 0.0,
            works: 0.0,
            residual_work: 0.0,
            linear: [0.0; D],
            momenta: 0.0,
            angular: Bivector::zero(),
            moments: 0.0,
            farthest: 0.0,
        }
    }

    /// Adds a moving node, with the force of its loads if there are any, N.
    #[inline]
    pub(crate) fn see(&mut self, node: &NodeStep<'_, D>, force: Option<&[f64; D]>, step: f64) {
        let [gain, size] = node.energies();
        self.energy.add(gain);
        self.kinetic += size;
        if let Some(origin) = self.origin() {
            let load = force.map_or([0.0; D], |force| scaled(step, force));
            self.see_momenta(node, &load, &origin);
        }
        if let Some(force) = force {
            for (&force, &displacement) in force.iter().zip(node.displacement) {
                self.work(force * displacement);
            }
        }
    }

    /// Adds the work of a load or a support, J.
    #[inline]
    pub(crate) fn work(&mut self, work: f64) {
        self.energy.add(-work);
        self.works += work.abs();
    }

    /// Adds the work of what the momentum balance of a node lacks, N s, over its displacement in a step of this size.
    #[cold]
    pub(crate) fn fall_short(
        &mut self,
        residual: &[f64; D],
        displacement: &[f64; D],
        per_step: f64,
    ) {
        for (&residual, &displacement) in residual.iter().zip(displacement) {
            self.residual_work += residual * per_step * displacement;
        }
    }

    /// Adds the impulse of a load, N s, on a node with this displacement from its old position.
    pub(crate) fn push(&mut self, [position, displacement]: [&[f64; D]; 2], impulse: &[f64; D]) {
        let Some(origin) = self.origin() else {
            return;
        };
        let mut arm = [0.0; D];
        let (mut length, mut size) = (0.0, 0.0);
        for axis in 0..D {
            arm[axis] = (position[axis] - origin[axis]) + displacement[axis];
            self.linear[axis] -= impulse[axis];
            length += arm[axis].abs();
            size += impulse[axis].abs();
        }
        self.momenta += size;
        self.moments += length * size;
        self.angular.add(-1.0, &Bivector::wedge(&arm, impulse));
    }

    /// The point about which the angular momentum is kept.
    #[inline]
    fn origin(&self) -> Option<[f64; D]> {
        match self.kept {
            Kept::None => None,
            Kept::Angular(origin) => Some(origin),
            Kept::Both => Some([0.0; D]),
        }
    }

    #[inline]
    fn see_momenta(&mut self, node: &NodeStep<'_, D>, load: &[f64; D], origin: &[f64; D]) {
        let (mut arm, mut mean, mut net) = ([0.0; D], [0.0; D], [0.0; D]);
        let (mut length, mut size) = (0.0, 0.0);
        for axis in 0..D {
            let (p, change) = (node.momentum[axis], node.impulse[axis]);
            arm[axis] = (node.position[axis] - origin[axis]) + 0.5 * node.displacement[axis];
            mean[axis] = p + 0.5 * change;
            net[axis] = change - load[axis];
            self.linear[axis] += net[axis];
            // Positions, and with them arms, are rounded to ε of their coordinates.
            let extent = Scalar::maximum(arm[axis].abs(), node.position[axis].abs());
            length += extent + node.displacement[axis].abs();
            size += p.abs() + (p + change).abs() + load[axis].abs();
        }
        self.farthest = Scalar::maximum(self.farthest, length);
        self.momenta += size;
        self.moments += length * size;
        let mut change = Bivector::wedge(&arm, &net);
        change.add(1.0, &Bivector::wedge(node.displacement, &mean));
        self.angular.add(1.0, &change);
    }
}

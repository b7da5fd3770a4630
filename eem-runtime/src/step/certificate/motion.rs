//! The contribution of the nodes to the certificate of a step: kinetic energy, work and momenta.

use crate::algebra::bivector::Bivector;
use eem_material::number::compensated::Total;
use eem_material::number::scalar::Real;

/// The contribution of the motion of the nodes to a certificate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion<S, const D: usize> {
    /// The conserved momenta, and their reference point, m.
    pub(crate) kept: Kept<S, D>,
    /// `Σ v̄·Δp − work`, J.
    pub(super) energy: Total<S>,
    /// T of both ends, and the magnitude of the work of loads and supports, J.
    pub(super) kinetic: S,
    pub(super) works: S,
    /// `W_r`, the work of the residuals of the momentum balances, if bounds are thorough, J.
    pub(super) residual_work: S,
    /// `Σ (Δp − hF)` of the loads F, and `Σ |p|`, kg m/s.
    pub(super) linear: [S; D],
    pub(super) momenta: S,
    /// `Σ (q_m − o) × (Δp − hF) + Δq × p_m`, and `Σ |q_m − o||p|`, kg m²/s.
    pub(super) angular: Bivector<S, D>,
    pub(super) moments: S,
    /// The largest `|q_m − o|`, m.
    pub(super) farthest: S,
}

/// The momenta that a scene conserves apart from its loads.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Kept<S, const D: usize> {
    /// None: with several anchors, moved anchors, or a scheme that does not prove its laws.
    None,
    /// With one anchor at this place: the angular momentum about it.
    Angular([S; D]),
    /// Without anchors: both, about the origin.
    Both,
}

/// The motion of a node in a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NodeStep<'a, S, const D: usize> {
    pub(crate) speeds: Speeds<S, D>,
    /// q⁰, m.
    pub(crate) position: &'a [S; D],
    /// p⁰, kg m/s.
    pub(crate) momentum: &'a [S; D],
    /// Δq, m.
    pub(crate) displacement: &'a [S; D],
    /// Δp, kg m/s.
    pub(crate) impulse: &'a [S; D],
}

/// The velocity of a node.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Speeds<S, const D: usize> {
    /// `1/m`, 1/kg: `v = p/m`.
    OfMass(S),
    /// v⁰ and Δv, m/s, where masses couple nodes.
    Given { old: [S; D], change: [S; D] },
}

impl<S: Real, const D: usize> NodeStep<'_, S, D> {
    /// `v̄·Δp` and `½(|v⁰·p⁰| + |v¹·p¹|)`, J.
    #[inline]
    pub(crate) fn energies(&self) -> [S; 2] {
        let half = S::from_f64(0.5);
        let (mut gain, mut size) = (S::zero(), S::zero());
        match &self.speeds {
            Speeds::OfMass(per_mass) => {
                for (&p, &change) in self.momentum.iter().zip(self.impulse) {
                    let end = p + change;
                    gain += (p + half * change) * change;
                    size += p * p + end * end;
                }
                [gain * *per_mass, half * size * *per_mass]
            }
            Speeds::Given { old, change } => {
                for axis in 0..D {
                    let (v, p) = (old[axis], self.momentum[axis]);
                    gain += (v + half * change[axis]) * self.impulse[axis];
                    let end = (v + change[axis]) * (p + self.impulse[axis]);
                    size += (v * p).abs() + end.abs();
                }
                [gain, half * size]
            }
        }
    }

    /// `|p¹·Δv|` with the terms of Δv, m/s: times ε, the energy of the rounding of the new velocity, J.
    #[cold]
    pub(crate) fn energy_of_rounding(&self, terms: &[S; D]) -> S {
        let mut energy = S::zero();
        let momenta = self.momentum.iter().zip(self.impulse);
        for ((&momentum, &impulse), &terms) in momenta.zip(terms) {
            energy += ((momentum + impulse) * terms).abs();
        }
        energy
    }
}

impl<S: Real, const D: usize> Motion<S, D> {
    pub(crate) fn new(kept: Kept<S, D>) -> Self {
        let zero = S::zero();
        Self {
            kept,
            energy: Total::default(),
            kinetic: zero,
            works: zero,
            residual_work: zero,
            linear: [zero; D],
            momenta: zero,
            angular: Bivector::zero(),
            moments: zero,
            farthest: zero,
        }
    }

    /// Adds a moving node, with the force of its loads if there are any, N.
    #[inline]
    pub(crate) fn see(&mut self, node: &NodeStep<'_, S, D>, force: Option<&[S; D]>, step: S) {
        let [gain, size] = node.energies();
        self.energy.add(gain);
        self.kinetic += size;
        if D > 0 && !matches!(self.kept, Kept::None) {
            let load = force.map(|force| force.map(|force| step * force));
            self.see_momenta(node, &load.unwrap_or([S::zero(); D]));
        }
        if let Some(force) = force {
            for (&force, &displacement) in force.iter().zip(node.displacement) {
                self.work(force * displacement);
            }
        }
    }

    /// Adds the work of a load or a support, J.
    #[inline]
    pub(crate) fn work(&mut self, work: S) {
        self.energy.add(-work);
        self.works += work.abs();
    }

    /// Adds the work of what the momentum balance of a node lacks, N s, over its displacement in a step of this size.
    #[cold]
    pub(crate) fn fall_short(&mut self, residual: &[S; D], displacement: &[S; D], per_step: S) {
        for (&residual, &displacement) in residual.iter().zip(displacement) {
            self.residual_work += residual * per_step * displacement;
        }
    }

    /// Adds the impulse of a load, N s, on a node with this displacement from its old position.
    pub(crate) fn push(&mut self, [position, displacement]: [&[S; D]; 2], impulse: &[S; D]) {
        let origin = match self.kept {
            Kept::None => return,
            Kept::Angular(origin) => origin,
            Kept::Both => [S::zero(); D],
        };
        let mut arm = [S::zero(); D];
        let (mut length, mut size) = (S::zero(), S::zero());
        for axis in 0..D {
            arm[axis] = (position[axis] - origin[axis]) + displacement[axis];
            self.linear[axis] -= impulse[axis];
            length += arm[axis].abs();
            size += impulse[axis].abs();
        }
        self.momenta += size;
        self.moments += length * size;
        self.angular.add(-S::one(), &Bivector::wedge(&arm, impulse));
    }

    fn see_momenta(&mut self, node: &NodeStep<'_, S, D>, load: &[S; D]) {
        let half = S::from_f64(0.5);
        let origin = match self.kept {
            Kept::Angular(origin) => origin,
            Kept::None | Kept::Both => [S::zero(); D],
        };
        let (mut arm, mut mean, mut net) = ([S::zero(); D], [S::zero(); D], [S::zero(); D]);
        let (mut length, mut size) = (S::zero(), S::zero());
        for axis in 0..D {
            let (p, change) = (node.momentum[axis], node.impulse[axis]);
            arm[axis] = (node.position[axis] - origin[axis]) + half * node.displacement[axis];
            mean[axis] = p + half * change;
            net[axis] = change - load[axis];
            self.linear[axis] += net[axis];
            length += arm[axis].abs() + node.displacement[axis].abs();
            size += p.abs() + (p + change).abs() + load[axis].abs();
        }
        self.farthest = self.farthest.maximum(length);
        self.momenta += size;
        self.moments += length * size;
        let mut change = Bivector::wedge(&arm, &net);
        change.add(S::one(), &Bivector::wedge(node.displacement, &mean));
        self.angular.add(S::one(), &change);
    }
}

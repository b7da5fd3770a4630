//! The kinematic quantities of one element at a trial state.

use super::arms::{along, dot, mean, scale};
use crate::element::conjugates::Placement;
use crate::element::kinematics::{Arms, Blocks, Ends, Gradient, Kinematics, Measures, add_blocks};
use eem_material::free_energy::Array;
use eem_material::number::scalar::Real;

/// Gradients of an element in the configurations that its scheme uses.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose<K: Kinematics<S, D>, S: Real, const D: usize> {
    /// Old and new configuration; for a scheme at the midpoint the mean is in place of the new one.
    ends: Ends<K, S, D>,
    /// The gradient along which the forces act.
    pub(super) direction: Gradient<K, S, D>,
    /// The derivative of the measures that the scheme uses with respect to the new arms.
    pub(super) sensitivity: Gradient<K, S, D>,
}

/// The arms in the configuration that a scheme uses, the new one or the mean.
#[inline]
pub(super) fn placed_arms<K: Kinematics<S, D>, S: Real, const D: usize>(
    at: Placement,
    r0: &Arms<K, S, D>,
    r1: Arms<K, S, D>,
) -> Arms<K, S, D> {
    match at {
        Placement::Middle => mean::<K, S, D>(r0, &r1),
        Placement::Ends | Placement::End | Placement::Start => r1,
    }
}

/// The measures that a scheme uses: those of its configuration, or their means with the old ones.
#[inline]
pub(super) fn placed_measures<K: Kinematics<S, D>, S: Real, const D: usize>(
    at: Placement,
    measures0: &Measures<K, S, D>,
    mut measures1: Measures<K, S, D>,
) -> Measures<K, S, D> {
    if at == Placement::Start {
        for (measure, &old) in measures1.as_mut().iter_mut().zip(measures0.as_ref()) {
            *measure = S::from_f64(0.5) * (old + *measure);
        }
    }
    measures1
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> Pose<K, S, D> {
    /// Between the old configuration and the one that the scheme uses.
    #[inline]
    pub(super) fn new(kinematics: &K, at: Placement, ends: Ends<K, S, D>) -> Self {
        let gradient = kinematics.new_gradient(&ends);
        let (direction, sensitivity) = match at {
            Placement::Ends => (kinematics.discrete_gradient(&ends), gradient),
            Placement::End => (gradient, gradient),
            Placement::Middle => (gradient, halved::<K, S, D>(gradient)),
            Placement::Start => {
                let old = kinematics.gradient(&ends.r0, &ends.measures0);
                (old, halved::<K, S, D>(gradient))
            }
        };
        Self {
            ends,
            direction,
            sensitivity,
        }
    }

    /// The same from arms alone.
    pub(super) fn between(
        kinematics: &K,
        at: Placement,
        [r0, r1]: [&Arms<K, S, D>; 2],
        measures0: Measures<K, S, D>,
    ) -> Self {
        let r1 = placed_arms::<K, S, D>(at, r0, *r1);
        let measures = [measures0, kinematics.measure(&r1)];
        Self::new(kinematics, at, Ends::new(kinematics, [*r0, r1], measures))
    }

    /// `Σ_a f_a direction_a`.
    #[inline]
    pub(super) fn pull(
        &self,
        kinematics: &K,
        at: Placement,
        force: &Measures<K, S, D>,
    ) -> Arms<K, S, D> {
        if at == Placement::Ends {
            return kinematics.pull(&self.ends, &self.direction, force);
        }
        let Ends {
            r0,
            r1,
            measures0,
            measures1,
            ..
        } = self.ends;
        let (r, measures) = match at {
            Placement::Ends | Placement::End | Placement::Middle => (r1, measures1),
            Placement::Start => (r0, measures0),
        };
        let ends = Ends::new(kinematics, [r; 2], [measures; 2]);
        kinematics.pull(&ends, &self.direction, force)
    }

    /// The derivative of `Σ_a f_a direction_a` with respect to the new arms, given that of the forces.
    #[inline]
    pub(super) fn tangent(
        &self,
        kinematics: &K,
        at: Placement,
        force: &Measures<K, S, D>,
        force_by_arm: &Gradient<K, S, D>,
    ) -> Blocks<K, S, D> {
        if at == Placement::Ends {
            return kinematics.discrete_tangent(&self.ends, force, force_by_arm);
        }
        let mut blocks = self.curvature(kinematics, at, force);
        let pairs = self.direction.as_ref().iter().zip(force_by_arm.as_ref());
        for (direction, by_arm) in pairs {
            for (i, direction) in direction.as_ref().iter().enumerate() {
                for (j, by) in by_arm.as_ref().iter().enumerate() {
                    for (entries, &along) in blocks[i][j].iter_mut().zip(direction) {
                        for (entry, &by) in entries.iter_mut().zip(by) {
                            *entry += along * by;
                        }
                    }
                }
            }
        }
        blocks
    }

    /// Adds [`tangent`](Self::tangent) to a sum.
    #[inline]
    pub(super) fn add_tangent(
        &self,
        kinematics: &K,
        at: Placement,
        (force, force_by_arm): (&Measures<K, S, D>, &Gradient<K, S, D>),
        sum: &mut Blocks<K, S, D>,
    ) {
        if at == Placement::Ends {
            return kinematics.add_discrete_tangent(&self.ends, force, force_by_arm, sum);
        }
        let own = self.tangent(kinematics, at, force, force_by_arm);
        add_blocks::<K, S, D>(sum, &own);
    }

    /// `Σ_a f_a ∂(direction_a)/∂r¹`.
    #[inline]
    fn curvature(
        &self,
        kinematics: &K,
        at: Placement,
        force: &Measures<K, S, D>,
    ) -> Blocks<K, S, D> {
        let Ends { r1, measures1, .. } = &self.ends;
        match at {
            Placement::Ends => {
                let nowhere = Arms::<K, S, D>::filled([S::zero(); D]);
                let constant = Gradient::<K, S, D>::filled(nowhere);
                kinematics.discrete_tangent(&self.ends, force, &constant)
            }
            Placement::End => kinematics.curvature(r1, measures1, force),
            Placement::Middle => {
                let mut half = *force;
                for force in half.as_mut() {
                    *force *= S::from_f64(0.5);
                }
                kinematics.curvature(r1, measures1, &half)
            }
            Placement::Start => no_blocks::<K, S, D>(),
        }
    }

    /// The increments `Λ_a = direction_a · w` for a motion `w` of the arms with `∂w/∂r¹ = 1`, and their derivatives.
    #[inline]
    pub(super) fn increase(
        &self,
        kinematics: &K,
        at: Placement,
        motion: &Arms<K, S, D>,
    ) -> (Measures<K, S, D>, Gradient<K, S, D>) {
        let mut increments = Measures::<K, S, D>::filled(S::zero());
        let mut by_arm = self.direction;
        for a in 0..Measures::<K, S, D>::LEN {
            let mut unit = Measures::<K, S, D>::filled(S::zero());
            unit[a] = S::one();
            increments[a] = along::<K, S, D>(&self.direction[a], motion);
            let blocks = self.curvature(kinematics, at, &unit);
            for (entry, row) in by_arm[a].as_mut().iter_mut().zip(blocks.as_ref()) {
                for (block, moved) in row.as_ref().iter().zip(motion.as_ref()) {
                    for (entry, row) in entry.iter_mut().zip(block) {
                        *entry += dot(row, moved);
                    }
                }
            }
        }
        (increments, by_arm)
    }
}

/// Multiplies a gradient by ½, exactly.
#[inline]
fn halved<K: Kinematics<S, D>, S: Real, const D: usize>(
    mut gradient: Gradient<K, S, D>,
) -> Gradient<K, S, D> {
    for row in gradient.as_mut() {
        scale::<K, S, D>(row, S::from_f64(0.5));
    }
    gradient
}

#[inline]
fn no_blocks<K: Kinematics<S, D>, S: Real, const D: usize>() -> Blocks<K, S, D> {
    Blocks::<K, S, D>::filled(K::PerArm::filled([[S::zero(); D]; D]))
}

//! The kinematic quantities of one element at a trial state.

use super::arms::{along, dot, mean, scale};
use crate::element::conjugates::Placement;
use crate::element::kinematics::{Arms, Blocks, Ends, Gradient, Kinematics, Measures, add_blocks};
use eem_material::free_energy::Array;

/// Gradients of an element in the configurations that its scheme uses.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose<K: Kinematics<D>, const D: usize> {
    /// Old and new configuration; for a scheme at the midpoint the mean is in place of the new one.
    ends: Ends<K, D>,
    /// The gradient along which the forces act.
    pub(super) direction: Gradient<K, D>,
    /// The derivative of the measures that the scheme uses with respect to the new arms.
    pub(super) sensitivity: Gradient<K, D>,
}

/// The arms in the configuration that a scheme uses, the new one or the mean.
#[inline]
pub(super) fn placed_arms<K: Kinematics<D>, const D: usize>(
    at: Placement,
    r0: &Arms<K, D>,
    r1: Arms<K, D>,
) -> Arms<K, D> {
    match at {
        Placement::Middle => mean::<K, D>(r0, &r1),
        Placement::Ends | Placement::End | Placement::Start => r1,
    }
}

/// The measures that a scheme uses: those of its configuration, or their means with the old ones.
#[inline]
pub(super) fn placed_measures<K: Kinematics<D>, const D: usize>(
    at: Placement,
    measures0: &Measures<K, D>,
    mut measures1: Measures<K, D>,
) -> Measures<K, D> {
    if at == Placement::Start {
        for (measure, &old) in measures1.as_mut().iter_mut().zip(measures0.as_ref()) {
            *measure = 0.5 * (old + *measure);
        }
    }
    measures1
}

impl<K: Kinematics<D>, const D: usize> Pose<K, D> {
    /// Between the old configuration and the one that the scheme uses.
    #[inline]
    pub(super) fn new(kinematics: &K, at: Placement, ends: Ends<K, D>) -> Self {
        let gradient = kinematics.new_gradient(&ends);
        let (direction, sensitivity) = match at {
            Placement::Ends => (kinematics.discrete_gradient(&ends), gradient),
            Placement::End => (gradient, gradient),
            Placement::Middle => (gradient, halved::<K, D>(gradient)),
            Placement::Start => {
                let old = kinematics.gradient(&ends.r0, &ends.measures0);
                (old, halved::<K, D>(gradient))
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
        [r0, r1]: [&Arms<K, D>; 2],
        measures0: Measures<K, D>,
    ) -> Self {
        let r1 = placed_arms::<K, D>(at, r0, *r1);
        let measures = [measures0, kinematics.measure(&r1)];
        Self::new(kinematics, at, Ends::new(kinematics, [*r0, r1], measures))
    }

    /// `Σ_a f_a direction_a`.
    #[inline]
    pub(super) fn pull(&self, kinematics: &K, at: Placement, force: &Measures<K, D>) -> Arms<K, D> {
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
        force: &Measures<K, D>,
        force_by_arm: &Gradient<K, D>,
    ) -> Blocks<K, D> {
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
        (force, force_by_arm): (&Measures<K, D>, &Gradient<K, D>),
        sum: &mut Blocks<K, D>,
    ) {
        if at == Placement::Ends {
            return kinematics.add_discrete_tangent(&self.ends, force, force_by_arm, sum);
        }
        let own = self.tangent(kinematics, at, force, force_by_arm);
        add_blocks::<K, D>(sum, &own);
    }

    /// `Σ_a f_a ∂(direction_a)/∂r¹`.
    #[inline]
    fn curvature(&self, kinematics: &K, at: Placement, force: &Measures<K, D>) -> Blocks<K, D> {
        let Ends { r1, measures1, .. } = &self.ends;
        match at {
            Placement::Ends => {
                let nowhere = Arms::<K, D>::filled([0.0; D]);
                let constant = Gradient::<K, D>::filled(nowhere);
                kinematics.discrete_tangent(&self.ends, force, &constant)
            }
            Placement::End => kinematics.curvature(r1, measures1, force),
            Placement::Middle => {
                let mut half = *force;
                for force in half.as_mut() {
                    *force *= 0.5;
                }
                kinematics.curvature(r1, measures1, &half)
            }
            Placement::Start => no_blocks::<K, D>(),
        }
    }

    /// The increments `Λ_a = direction_a · w` for a motion `w` of the arms with `∂w/∂r¹ = 1`, and their derivatives.
    #[inline]
    pub(super) fn increase(
        &self,
        kinematics: &K,
        at: Placement,
        motion: &Arms<K, D>,
    ) -> (Measures<K, D>, Gradient<K, D>) {
        let mut increments = Measures::<K, D>::filled(0.0);
        let mut by_arm = self.direction;
        for a in 0..Measures::<K, D>::LEN {
            let mut unit = Measures::<K, D>::filled(0.0);
            unit[a] = 1.0;
            increments[a] = along::<K, D>(&self.direction[a], motion);
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
fn halved<K: Kinematics<D>, const D: usize>(mut gradient: Gradient<K, D>) -> Gradient<K, D> {
    for row in gradient.as_mut() {
        scale::<K, D>(row, 0.5);
    }
    gradient
}

#[inline]
fn no_blocks<K: Kinematics<D>, const D: usize>() -> Blocks<K, D> {
    Blocks::<K, D>::filled(K::PerArm::filled([[0.0; D]; D]))
}

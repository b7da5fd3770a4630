//! The momenta of a component are put back by a rigid motion.

use super::super::Explicit;
use super::super::components::{Component, Support};
use super::super::vector::{Eliminated, Inertia, add, difference, dot, length, spin};
use crate::element::group::points;
use crate::number::scalar::{Mask, Real, unless};

/// The rigid part of the motion of a component.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rigid<S, const D: usize> {
    /// The anchor or the centre of mass, m, and its velocity where it is that of the masses, m/s.
    pub(super) origin: [S; D],
    pub(super) velocity: [S; D],
    /// ω, 1/s.
    pub(super) omega: [S; 3],
}

/// A component that turns like a rigid body.
#[derive(Clone, Copy, Debug)]
struct Body<S, const D: usize> {
    /// The anchor or the centre of mass, m.
    origin: [S; D],
    /// About it; none where nothing turns.
    inertia: Option<Eliminated<S>>,
}

impl<S: Real, const D: usize> Body<S, D> {
    /// The motion with these momenta.
    fn motion(
        &self,
        component: &Component<S>,
        (linear, angular): (&[S; D], &[S; 3]),
    ) -> Rigid<S, D> {
        let is_free = component.support == Support::Free;
        let turning = self.inertia.map(|inertia| inertia.solve::<D>(*angular));
        let zero = S::zero();
        Rigid {
            origin: self.origin,
            velocity: linear.map(|p| if is_free { p / component.mass } else { zero }),
            omega: turning.unwrap_or([zero; 3]),
        }
    }
}

impl<S: Real, const D: usize> Explicit<S, D> {
    /// Turns a single mass on an anchor so that its arm is perpendicular to its angular momentum: no
    /// momentum gives it one along its arm. Of several numbers it turns only some.
    pub(super) fn turn_single_mass(&mut self, index: usize, which: S::Mask) {
        let component = &self.components.all[index];
        let Support::Anchor(anchor) = component.support else {
            return;
        };
        if D != 3 || component.masses.len() != 1 {
            return;
        }
        let place = component.masses.start;
        let offsets = self.offsets;
        let (positions, momenta) = self.y[..offsets.viscous].split_at_mut(offsets.momenta);
        let positions = positions.as_chunks_mut::<D>().0;
        let momentum = &mut momenta.as_chunks_mut::<D>().0[place];
        let target = self.new_books.targets[index].angular.map(|sum| sum.value);
        let origin = positions[anchor];
        let arm = difference(&positions[place], &origin);
        let [along, far] = [length(&target), length(&arm)];
        let axis = target.map(|component| component / along);
        let direction = arm.map(|component| component / far);
        let elevation = (0..D).fold(S::zero(), |sum, i| sum + axis[i] * direction[i]);
        let turn = spin(&axis, &direction);
        let sine = length(&turn);
        let zero = S::zero();
        let is_turning = zero.less(along) & zero.less(far) & zero.less(sine) & which;
        if !is_turning.any() {
            return;
        }
        // About J × q, by the elevation of the arm above the plane that it has to be in.
        let mut about = [S::zero(); 3];
        for (about, &turn) in about.iter_mut().zip(&turn) {
            *about = turn / sine;
        }
        let angle = elevation.atan2(sine);
        let turned = rotated(&arm, &about, angle);
        let position = positions[place];
        positions[place] =
            core::array::from_fn(|i| S::select(is_turning, origin[i] + turned[i], position[i]));
        let turned = rotated(momentum, &about, angle);
        *momentum = core::array::from_fn(|i| S::select(is_turning, turned[i], momentum[i]));
    }

    /// The rigid motion that has these momenta, less what the component has already.
    pub(super) fn rigid(
        &self,
        component: &Component<S>,
        momenta: (&[S; D], &[S; 3]),
    ) -> Rigid<S, D> {
        self.body(component).motion(component, momenta)
    }

    /// A component as it would turn as a rigid body.
    fn body(&self, component: &Component<S>) -> Body<S, D> {
        let positions = points::<S, D>(&self.y[..self.offsets.momenta]);
        let mut body = Body {
            origin: [S::zero(); D],
            inertia: None,
        };
        match component.support {
            Support::Free => body.origin = self.center(component, positions),
            Support::Anchor(place) => body.origin = positions[place],
            Support::Several => return body,
        }
        let is_free_mass = component.support == Support::Free && component.masses.len() == 1;
        if D < 2 || is_free_mass {
            return body;
        }
        let mut inertia = Inertia::none();
        let is_single = D == 3 && component.masses.len() == 1;
        for place in component.masses.clone() {
            let arm = difference(&positions[place], &body.origin);
            if is_single {
                inertia.add_sphere(self.masses[place] * dot(&arm, &arm));
            } else {
                inertia.add(self.masses[place], &arm);
            }
        }
        body.inertia = Some(inertia.eliminate::<D>());
        body
    }

    /// Adds a rigid motion to the momenta that do not wait.
    fn add_rigid(&mut self, index: usize, rigid: &Rigid<S, D>) {
        let component = &self.components.all[index];
        let waits = self.scratch.waits[index];
        let offsets = self.offsets;
        let (positions, momenta) = self.y[..offsets.viscous].split_at_mut(offsets.momenta);
        let positions = points::<S, D>(positions);
        let momenta = momenta.as_chunks_mut::<D>().0;
        for place in component.masses.clone() {
            let arm = difference(&positions[place], &rigid.origin);
            let turning = spin(&rigid.omega, &arm);
            let mut momentum = momenta[place];
            add(&mut momentum, self.masses[place], &rigid.velocity);
            add(&mut momentum, self.masses[place], &turning);
            momenta[place] =
                core::array::from_fn(|i| unless(waits, momenta[place][i], momentum[i]));
        }
    }

    /// Puts the momenta back to their targets; in space twice, since the first correction may be large
    /// beside its rounding.
    pub(super) fn restore_momenta(&mut self, index: usize) {
        if self.components.all[index].support == Support::Several {
            return;
        }
        let body = self.body(&self.components.all[index]);
        for _ in 0..if D == 3 { 2 } else { 1 } {
            let component = &self.components.all[index];
            let (linear, angular) = self.momenta_of(component);
            let target = &self.new_books.targets[index];
            let mut missing = [S::zero(); D];
            let sums = target.linear.iter().zip(linear);
            for (missing, (sum, found)) in missing.iter_mut().zip(sums) {
                *missing = (sum.value - found) + sum.carry;
            }
            let lacking: [S; 3] = core::array::from_fn(|axis| {
                let sum = target.angular[axis];
                (sum.value - angular[axis]) + sum.carry
            });
            let rigid = body.motion(component, (&missing, &lacking));
            self.add_rigid(index, &rigid);
        }
    }
}

/// A vector turned about a unit vector (Rodrigues).
pub(super) fn rotated<S: Real, const D: usize>(r: &[S; D], about: &[S; 3], angle: S) -> [S; D] {
    let (sine, half) = (angle.sin(), (S::from_f64(0.5) * angle).sin());
    // 1 − cos, without cancellation.
    let versine = (half + half) * half;
    let turned = spin(about, r);
    let again = spin(about, &turned);
    let mut result = *r;
    add(&mut result, sine, &turned);
    add(&mut result, versine, &again);
    result
}

#[cfg(test)]
mod tests {
    use super::super::super::vector::moment;
    use super::*;

    #[test]
    fn a_quarter_turn() {
        let turned = rotated(
            &[1.0, 0.0, 2.0],
            &[0.0, 0.0, 1.0],
            core::f64::consts::FRAC_PI_2,
        );
        let expected = [0.0, 1.0, 2.0];
        assert!(
            length(&difference(&turned, &expected)) < 1e-15,
            "{turned:?}"
        );
        let flat = rotated(&[1.0, 2.0], &[0.0, 0.0, -1.0], core::f64::consts::PI);
        assert!(
            length(&difference(&flat, &[-1.0, -2.0])) < 1e-15,
            "{flat:?}"
        );
    }

    #[test]
    fn moments_of_vectors_are_perpendicular() {
        let (r, p) = ([1.0_f64, 2.0, 3.0], [-0.5, 0.3, 0.9]);
        let momentum = moment(&r, &p);
        assert!(dot(&momentum, &r).abs() < 1e-15);
    }
}

//! The momenta of a body are put back to their targets by a rigid motion.

use super::super::Explicit;
use super::super::components::{Component, Support};
use super::super::inertia::turning::turning;
use super::super::inertia::{Inertia, Moments, WEAK};
use super::super::vector::{Origin, add, dot, size};
use crate::algebra::bivector::Bivector;
use crate::element::group::points;
use eem_material::number::compensated::Sum;
use eem_material::number::scalar::{MOST_LANES, Mask, Real, unless};

/// Roundings of `Σ |q||p|` that are left to the momenta: positions turn only for more.
const OWN_ROUNDINGS: f64 = 2.0;

/// Corrections of momenta after the first one.
const MOST_CORRECTIONS: usize = 3;

/// Rotations of a body in a closing. In four dimensions and more, several planes may be without inertia, and principal
/// axes are known to ε over the gap of their moments, so that the correction of one plane spoils another.
const fn most_turns<const D: usize>() -> usize {
    if D < 4 { 1 } else { 3 }
}

/// The rigid part of the motion of a component.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rigid<S, const D: usize> {
    /// The anchor or the centre of mass, m, and its velocity where it is that of the masses, m/s.
    pub(super) origin: Origin<S, D>,
    pub(super) velocity: [S; D],
    /// The angular velocity, 1/s.
    pub(super) omega: Bivector<S, D>,
}

/// A component as a rigid body.
#[derive(Clone, Copy, Debug)]
struct Body<S, const D: usize> {
    /// The anchor or the centre of mass, m.
    origin: Origin<S, D>,
    /// About it; none where nothing turns.
    inertia: Option<Inertia<S, D>>,
}

impl<S: Real, const D: usize> Body<S, D> {
    /// The motion with these momenta.
    fn motion(
        &self,
        component: &Component<S>,
        (linear, angular): (&[S; D], &Bivector<S, D>),
    ) -> Rigid<S, D> {
        let turning = self.inertia.as_ref();
        let turning = turning.map(|inertia| inertia.solve(angular));
        Rigid {
            origin: self.origin,
            velocity: component.velocity(linear),
            omega: turning.unwrap_or(Bivector::zero()),
        }
    }
}

impl<S: Real, const D: usize> Explicit<S, D> {
    /// The rigid motion of a component with the momenta that it has.
    pub(super) fn rigid(&self, component: &Component<S>) -> Rigid<S, D> {
        let body = self.body(component);
        let (linear, angular) = self.momenta_about(component, &body.origin);
        body.motion(component, (&linear, &angular))
    }

    /// A component as it would turn as a rigid body.
    fn body(&self, component: &Component<S>) -> Body<S, D> {
        let positions = points::<S, D>(&self.y[..self.offsets.momenta]);
        let origin = self.origin(component);
        let mut body = Body {
            origin: origin.unwrap_or(Origin::at(&[S::zero(); D])),
            inertia: None,
        };
        let lonely = match component.support {
            Support::Free => 1,
            Support::Anchor(_) => 0,
            Support::Several => return body,
        };
        let count = component.masses.len();
        if D < 2 || count <= lonely {
            return body;
        }
        let arm = |place: usize| body.origin.arm(&positions[place]);
        body.inertia = Some(if count == lonely + 1 {
            // The other mass of a pair is on the same line through the centre.
            let moment = component.masses.clone().fold(S::zero(), |sum, place| {
                let arm = arm(place);
                sum + self.masses[place] * dot(&arm, &arm)
            });
            Inertia::of_line(&arm(component.masses.start), moment)
        } else {
            Inertia::of_body(self.moments(component, &body.origin))
        });
        body
    }

    fn moments(&self, component: &Component<S>, origin: &Origin<S, D>) -> Moments<S, D> {
        let positions = points::<S, D>(&self.y[..self.offsets.momenta]);
        let mut moments = Moments::none();
        for place in component.masses.clone() {
            let arm = origin.arm(&positions[place]);
            moments.add(self.masses[place], &arm);
        }
        moments
    }

    /// Adds a rigid motion to the momenta, except for numbers that wait.
    fn add_rigid(&mut self, index: usize, rigid: &Rigid<S, D>, waits: S::Mask) {
        let component = &self.components.all[index];
        let offsets = self.offsets;
        let (positions, momenta) = self.y[..offsets.viscous].split_at_mut(offsets.momenta);
        let positions = points::<S, D>(positions);
        let momenta = momenta.as_chunks_mut::<D>().0;
        for place in component.masses.clone() {
            let arm = rigid.origin.arm(&positions[place]);
            let turning = rigid.omega.turn(&arm);
            let mut momentum = momenta[place];
            add(&mut momentum, self.masses[place], &rigid.velocity);
            add(&mut momentum, self.masses[place], &turning);
            momenta[place] =
                core::array::from_fn(|i| unless(waits, momenta[place][i], momentum[i]));
        }
    }

    /// Puts the momenta back to their targets; in space again where the rounding of a correction matters.
    /// Positions turn where momenta alone cannot do it.
    pub(super) fn restore_momenta(&mut self, index: usize) {
        if self.components.all[index].support == Support::Several {
            return;
        }
        let mut waits = self.scratch.waits[index];
        for _ in 0..most_turns::<D>() {
            waits = self.approach_momenta(index, waits);
            if waits.all() {
                return;
            }
        }
    }

    /// A rotation of the body where it is needed, and corrections of its momenta, except for numbers that wait; then
    /// those wait, too, whose momenta are right to their rounding.
    fn approach_momenta(&mut self, index: usize, waits: S::Mask) -> S::Mask {
        let mut body = self.body(&self.components.all[index]);
        let is_weak = match &body.inertia {
            Some(Inertia::Line { along, .. }) => self.leaves_plane(index, (&body.origin, along)),
            Some(Inertia::Principal(_) | Inertia::Lanes(_)) => true,
            _ => false,
        };
        if is_weak && self.turn_body(index, &body, waits) {
            body = self.body(&self.components.all[index]);
        }
        let mut angular = self.correct_momenta(index, &body, waits);
        if D < 3 {
            return waits;
        }
        let [_, terms] = self.momentum_terms(index, &body.origin);
        let mut correct = waits;
        for _ in 0..MOST_CORRECTIONS {
            // The rotation is known to ε/WEAK of itself.
            correct = correct | angular.largest().at_most(S::from_f64(WEAK) * terms);
            if correct.all() {
                break;
            }
            angular = self.correct_momenta(index, &body, correct);
        }
        if D < 4 {
            return waits;
        }
        let (_, left) = self.missing_momenta(index, &body.origin);
        waits
            | left
                .largest()
                .at_most(self.own_rounding(index, &body.origin))
    }

    /// Adds the rigid motion with what the momenta lack, except for numbers that wait; the angular momentum that they
    /// lacked.
    fn correct_momenta(
        &mut self,
        index: usize,
        body: &Body<S, D>,
        waits: S::Mask,
    ) -> Bivector<S, D> {
        let component = &self.components.all[index];
        let (linear, angular) = self.missing_momenta(index, &body.origin);
        let rigid = body.motion(component, (&linear, &angular));
        self.add_rigid(index, &rigid, waits);
        angular
    }

    /// What linear and angular momentum of a component lack.
    pub(in super::super) fn missing_momenta(
        &self,
        index: usize,
        origin: &Origin<S, D>,
    ) -> ([S; D], Bivector<S, D>) {
        let (linear, angular) = self.momenta_about(&self.components.all[index], origin);
        let target = &self.new_books.targets[index];
        let linear = core::array::from_fn(|axis| target.linear[axis].beyond(linear[axis]));
        let angular = target.angular.zip(&angular, S::zero(), Sum::beyond);
        (linear, angular)
    }

    /// `Σ |p|` and `Σ |q||p|` of a component by sums of magnitudes, with coordinates q or arms about a point, whichever
    /// are larger: positions are rounded to ε of their coordinates.
    pub(in super::super) fn momentum_terms(&self, index: usize, origin: &Origin<S, D>) -> [S; 2] {
        let positions = points::<S, D>(&self.y[..self.offsets.momenta]);
        let momenta = points::<S, D>(&self.y[self.offsets.momenta..self.offsets.viscous]);
        let masses = self.components.all[index].masses.clone();
        masses.fold([S::zero(); 2], |[linear, angular], place| {
            let momentum = size(&momenta[place]);
            let arm = size(&origin.arm(&positions[place]));
            let arm = arm.maximum(size(&positions[place]));
            [linear + momentum, angular + arm * momentum]
        })
    }

    /// Whether the angular momentum that masses on a line have to get has a part in planes across the line, which no
    /// momentum gives them.
    fn leaves_plane(&self, index: usize, (origin, along): (&Origin<S, D>, &[S; D])) -> bool {
        let target = self.angular_target(index);
        let mut across = target;
        across.add(-S::one(), &Bivector::wedge(along, &target.turn(along)));
        !across
            .largest()
            .at_most(self.own_rounding(index, origin))
            .all()
    }

    /// The angular momentum that is left to the momenta.
    fn own_rounding(&self, index: usize, origin: &Origin<S, D>) -> S {
        let [_, terms] = self.momentum_terms(index, origin);
        S::from_f64(OWN_ROUNDINGS) * S::EPSILON * terms
    }

    fn angular_target(&self, index: usize) -> Bivector<S, D> {
        let target = &self.new_books.targets[index].angular;
        target.map(S::zero(), |sum| sum.value)
    }

    /// Turns positions and momenta of a component, except for numbers that wait, so that its momenta can be put back;
    /// whether it has turned.
    #[cold]
    fn turn_body(&mut self, index: usize, body: &Body<S, D>, waits: S::Mask) -> bool {
        let (component, origin) = (&self.components.all[index], &body.origin);
        let (linear, present) = self.momenta_about(component, origin);
        let target = self.angular_target(index);
        let rounding = self.own_rounding(index, origin);
        let moves = S::select(waits, S::zero(), S::one());
        let change = |lane: usize| {
            if moves.lane(lane) < 1.0 {
                return None;
            }
            let of_lane = |momentum: &Bivector<S, D>| momentum.map(0.0, |j| j.lane(lane));
            let momenta = [&of_lane(&present), &of_lane(&target)];
            let own = match body.inertia {
                Some(Inertia::Principal(principal)) => Inertia::Principal(principal),
                _ => Inertia::of_body(self.moments(component, origin).lane(lane)),
            };
            match own {
                Inertia::Principal(principal) => turning(&principal, momenta, rounding.lane(lane)),
                // Nothing is weak: the momenta do it, as they do for this lane alone.
                _ => None,
            }
        };
        let changes: [_; MOST_LANES] = core::array::from_fn(|lane| {
            let is_lane = lane < S::LANES;
            is_lane.then(|| change(lane)).flatten()
        });
        if changes.iter().all(Option::is_none) {
            return false;
        }
        let change: [[S; D]; D] = core::array::from_fn(|i| {
            core::array::from_fn(|j| S::pack(|lane| changes[lane].map_or(0.0, |by| by[i][j])))
        });
        let velocity = component.velocity(&linear);
        let (masses, offsets) = (component.masses.clone(), self.offsets);
        let (positions, momenta) = self.y[..offsets.viscous].split_at_mut(offsets.momenta);
        let positions = positions.as_chunks_mut::<D>().0;
        let momenta = momenta.as_chunks_mut::<D>().0;
        for place in masses {
            let arm = origin.arm(&positions[place]);
            let mut own = momenta[place];
            add(&mut own, -self.masses[place], &velocity);
            for (row, change) in change.iter().enumerate() {
                positions[place][row] += dot(change, &arm);
                momenta[place][row] += dot(change, &own);
            }
        }
        true
    }
}

//! Correction of the momenta of a body to their targets, by a rigid motion.

use super::super::Explicit;
use super::super::components::{Component, Support};
use super::super::inertia::turning::turning;
use super::super::inertia::{Inertia, Moments, WEAK};
use super::super::memory::{Momenta, Motion, farther, momenta_of};
use super::super::origin::Origin;
use super::energy::add_motion;
use crate::algebra::bivector::Bivector;
use crate::algebra::{add, dot, size};
use crate::element::group::Place;

/// Defects up to this many roundings of `Σ |q||p|` are corrected by momenta; only for larger ones positions are
/// rotated.
const OWN_ROUNDINGS: f64 = 2.0;

/// Corrections of momenta after the first one.
const MOST_CORRECTIONS: usize = 3;

/// The rigid part of the motion of a component.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rigid<const D: usize> {
    /// The anchor or the centre of mass, m, and the velocity of the centre of mass, m/s; zero with an anchor.
    pub(super) origin: Origin<D>,
    pub(super) velocity: [f64; D],
    /// The angular velocity, 1/s.
    pub(super) omega: Bivector<f64, D>,
}

/// A component as a rigid body.
#[derive(Clone, Copy, Debug)]
struct Body<const D: usize> {
    /// The anchor or the centre of mass, m.
    origin: Origin<D>,
    /// About `origin`; `None` if the component cannot turn, or no momentum is conserved.
    inertia: Option<Inertia<D>>,
}

impl<const D: usize> Body<D> {
    /// The rigid motion with these momenta.
    #[inline]
    fn motion(&self, component: &Component, momenta: &Momenta<D>) -> Rigid<D> {
        Rigid {
            origin: self.origin,
            velocity: component.velocity(&momenta.linear),
            omega: match &self.inertia {
                Some(inertia) => inertia.solve(&momenta.angular),
                None => Bivector::zero(),
            },
        }
    }
}

impl<const D: usize> Explicit<D> {
    /// The rigid motion of a component with its present momenta.
    pub(super) fn rigid(&self, index: usize) -> Rigid<D> {
        let component = &self.components.all[index];
        self.body(component).motion(component, &self.momenta[index])
    }

    /// A component as a rigid body.
    #[inline]
    fn body(&self, component: &Component) -> Body<D> {
        let mut body = Body {
            origin: Origin::of(&self.places, component),
            inertia: None,
        };
        let without_arm = match component.support {
            Support::Free => 1,
            Support::Anchor(_) => 0,
            Support::Several => return body,
        };
        let count = component.masses.len();
        if D < 2 || count <= without_arm {
            return body;
        }
        let masses = &self.places[component.masses.clone()];
        let arm = |place: &Place<D>| body.origin.arm(place.q());
        body.inertia = Some(if count == without_arm + 1 {
            // The other mass of a pair is on the same line through the centre.
            let mut moment = 0.0;
            for place in masses {
                let arm = arm(place);
                moment += place.mass * dot(&arm, &arm);
            }
            Inertia::of_line(&arm(&masses[0]), moment)
        } else {
            Inertia::of_body(self.moments(component, &body.origin))
        });
        body
    }

    fn moments(&self, component: &Component, origin: &Origin<D>) -> Moments<D> {
        let mut moments = Moments::none();
        for place in &self.places[component.masses.clone()] {
            moments.add(place.mass, &origin.arm(place.q()));
        }
        moments
    }

    /// Adds a rigid motion to the momenta and updates the sums over the masses.
    #[inline]
    fn add_rigid(&mut self, index: usize, rigid: &Rigid<D>) {
        let masses = self.components.all[index].masses.clone();
        let (mut momenta, mut motion) = (Momenta::none(), Motion::default());
        for place in &mut self.places[masses] {
            let arm = rigid.origin.arm(place.q());
            let turning = rigid.omega.turn(&arm);
            let momentum = &mut place.now[1];
            for axis in 0..D {
                momentum[axis] += place.mass * (rigid.velocity[axis] + turning[axis]);
            }
            add_motion(place, &arm, (&mut momenta, &mut motion));
        }
        (self.momenta[index], self.accounts.motions[index]) = (momenta, motion);
    }

    /// Corrects the momenta to their targets; in space repeatedly if the rounding of a correction matters. Positions
    /// are rotated if momenta alone cannot do it.
    #[inline]
    pub(super) fn restore_momenta(&mut self, index: usize) {
        if self.components.all[index].support == Support::Several {
            self.look_at_motion(index);
            return;
        }
        // The energy is summed with the corrected momenta.
        let component = &self.accounts.components.all[index];
        let origin = Origin::of(&self.places, component);
        let (mut momenta, mut motion) = (Momenta::none(), Motion::default());
        for place in &self.places[component.masses.clone()] {
            let (q, p, arm) = (place.q(), place.p(), origin.arm(place.q()));
            momenta.add(p, &arm);
            // Only rotations in space ask how well they are known before a correction.
            if D > 2 {
                motion.add_terms([q, p], &arm);
            }
        }
        (self.momenta[index], self.accounts.motions[index]) = (momenta, motion);
        // In four dimensions and more, several planes may be without inertia, and principal axes are known to ε over the gap of
        // their moments, so that the correction of one plane spoils another.
        let most = if D < 4 { 1 } else { 3 };
        for _ in 0..most {
            if self.approach_momenta(index) {
                return;
            }
        }
    }

    /// Rotates the body if needed and corrects its momenta. Returns whether they are known to be accurate to rounding.
    #[inline]
    fn approach_momenta(&mut self, index: usize) -> bool {
        let mut body = self.body(&self.components.all[index]);
        // Known when it is compiled, so that rotations are for space only.
        if const { D > 2 } {
            let is_weak = match &body.inertia {
                Some(Inertia::Line { along, .. }) => self.leaves_plane(index, along),
                Some(Inertia::Principal(_)) => true,
                _ => false,
            };
            if is_weak && self.turn_body(index, &body) {
                self.look_at_motion(index);
                body = self.body(&self.components.all[index]);
            }
        }
        for _ in 0..=MOST_CORRECTIONS {
            let missing = self.missing_momenta(index);
            let rigid = body.motion(&self.components.all[index], &missing);
            self.add_rigid(index, &rigid);
            let [_, terms] = self.motions[index].terms;
            // The rotation is known to ε/WEAK of itself.
            if D < 3 || missing.angular.largest() <= WEAK * terms {
                break;
            }
        }
        if D < 4 {
            return false;
        }
        let left = self.missing_momenta(index).angular;
        left.largest() <= self.own_rounding(index)
    }

    /// The defects of the momenta of a component.
    #[inline]
    pub(in super::super) fn missing_momenta(&self, index: usize) -> Momenta<D> {
        let targets = &self.books.momenta[momenta_of(index, D)];
        let mut missing = self.momenta[index];
        missing.change(|at, own| targets[at].beyond(own));
        missing
    }

    /// Whether the target of masses on a line has an angular momentum in planes perpendicular to the line, which no
    /// momenta of the masses can give.
    fn leaves_plane(&self, index: usize, along: &[f64; D]) -> bool {
        let target = self.angular_target(index);
        let mut across = target;
        across.add(-1.0, &Bivector::wedge(along, &target.turn(along)));
        let off = across.largest();
        !(off <= self.own_rounding(index)) && !(off <= self.rounding_of_target(index))
    }

    /// The largest defect of the angular momentum that is corrected by momenta alone.
    fn own_rounding(&self, index: usize) -> f64 {
        let [_, terms] = self.motions[index].terms;
        OWN_ROUNDINGS * f64::EPSILON * (terms + self.scratch.progress[index].moment)
    }

    /// The same with the rounding at the start of the step, where the target may be that of much larger momenta.
    #[cold]
    fn rounding_of_target(&self, index: usize) -> f64 {
        self.own_rounding(index) + OWN_ROUNDINGS * f64::EPSILON * self.moment_at_start(index)
    }

    /// `Σ |q||p|` at the start of the step, as in the [terms](Motion::terms) of its end.
    #[cold]
    pub(in super::super) fn moment_at_start(&self, index: usize) -> f64 {
        let component = &self.components.all[index];
        let origin = Origin::of(&self.places, component);
        let mut sum = 0.0;
        for place in &self.places[component.masses.clone()] {
            let [q, p] = &place.past.start;
            sum += farther(&origin.arm(q), q) * size(p);
        }
        sum
    }

    pub(in super::super) fn angular_target(&self, index: usize) -> Bivector<f64, D> {
        let targets = &self.books.momenta[momenta_of(index, D)];
        let mut momenta = Momenta::none();
        momenta.change(|at, _| targets[at].value);
        momenta.angular
    }

    /// Rotates positions and momenta of a component, so that its momenta can be corrected; returns whether it did.
    #[cold]
    fn turn_body(&mut self, index: usize, body: &Body<D>) -> bool {
        let (component, origin) = (&self.components.all[index], &body.origin);
        let inertia = match body.inertia {
            Some(Inertia::Principal(_)) => body.inertia,
            _ => Some(Inertia::of_body(self.moments(component, origin))),
        };
        let Some(Inertia::Principal(principal)) = inertia else {
            // No inertia is weak: the momenta alone are corrected.
            return false;
        };
        let Momenta { linear, angular } = &self.momenta[index];
        let momenta = [angular, &self.angular_target(index)];
        let Some(change) = turning(&principal, momenta, self.rounding_of_target(index)) else {
            return false;
        };
        let velocity = component.velocity(linear);
        let masses = component.masses.clone();
        for place in &mut self.places[masses] {
            let arm = origin.arm(place.q());
            let mut own = *place.p();
            add(&mut own, -place.mass, &velocity);
            for (row, change) in change.iter().enumerate() {
                place.now[0][row] += dot(change, &arm);
                place.now[1][row] += dot(change, &own);
            }
        }
        true
    }
}

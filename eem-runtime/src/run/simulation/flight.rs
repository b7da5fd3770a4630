//! Flights: steps to another branch of solutions, which the estimate from two halves does not see.
//!
//! The equations of a step that is long beside a vibration have several solutions. Where all is at rest but for a velocity v that the
//! tolerance does not see, and `h v` exceeds the way to a mirror image of the scene, such as r⁰ → −r⁰ of a spring, a flight to it is one:
//! lengths and energies are the same, and forces along `r⁰ + r¹` do not stop it. The whole step and one of its halves may take it together,
//! so that their ends agree.
//!
//! Then the other half moves next to nothing. A scheme of order p follows polynomials of the degree p, of which `1/(2ᵖ − 1)` of the way in
//! the second half is made in the first, if they begin at rest; so less than that tells a flight from a motion. Under loads the mirror
//! image is not at rest, and the other half may end the fall to it. What has flown along its own line has passed its other end, which
//! tells, too. Where vibrations are resolved, the estimate sees it, and a mass may fly through its anchor.

use core::f64::consts::TAU;

use super::Simulation;
use crate::algebra::vector;
use crate::element::group::points;
use crate::step::control::{Scales, norm};
use eem_material::number::scalar::Scalar;

/// The least way of one end of an element from the other that may be a flight, in units of their distance: that to a mirror image in a
/// line at 7° to a spring. A motion that turns round in the middle of one half makes no way there and `(h Ω)²/4` of its amplitude in
/// the other, with its angular frequency Ω: less than this in accurate steps of order 2.
const LEAST_WAY: f64 = 0.25;

/// A straight way at less than this share of its length from the other end is one along the line of an element: a turn by 151°. In accurate
/// steps order 6 turns by up to 2.6 rad in a half, at a tolerance of 1e-2.
const NEAREST: f64 = 0.25;

impl<const D: usize> Simulation<D> {
    /// Whether the last step, made in two halves by a scheme of this order, flies with an element that vibrates faster than a half lasts.
    pub(super) fn flies(&self, size: f64, scales: &Scales<'_>, order: f64) -> bool {
        // After a step the next state is the one before it.
        let states = [scales.before(), &self.next, &self.state];
        let states = states.map(|state| points::<D>(state.positions.values()));
        let share = (order.exp2() - 1.0).recip();
        let flies = |[a, b]: [usize; 2]| {
            let arms = states.map(|at| vector(|axis| at[b][axis] - at[a][axis]));
            let [start, middle, end]: [[f64; D]; 3] = arms;
            let way = |from: [f64; D], to: [f64; D]| norm((0..D).map(|axis| to[axis] - from[axis]));
            let (first, second) = (way(start, middle), way(middle, end));
            let most = Scalar::maximum(first, second);
            let least = Scalar::maximum(LEAST_WAY * way([0.0; D], start), scales.position());
            let stands = Scalar::minimum(first, second) < share * most;
            least < most && (stands || passes(start, middle) || passes(middle, end))
        };
        let mut elements = self.places.iter();
        let may_fly = elements.any(|&[group, place]| {
            let elements = self.stepper.elements(group as usize);
            arms(elements.nodes(place as usize)).any(flies)
        });
        may_fly
            && self.stepper.all().any(|group| {
                let mut is_found = false;
                group.stiffness(scales.before(), &mut |point| {
                    is_found |= arms(point.nodes).any(|arm| {
                        let mobilities =
                            arm.map(|node| self.masses.get(node).map_or(0.0, f64::recip));
                        let [a, b] = mobilities;
                        let rate = (point.elastic * (a + b)).sqrt();
                        0.5 * size * rate > TAU && flies(arm)
                    });
                });
                is_found
            })
    }
}

/// Whether the straight way of an arm passes its other end nearer than [`NEAREST`] of its lengths before and after.
fn passes<const D: usize>(from: [f64; D], to: [f64; D]) -> bool {
    let dot = |a: [f64; D], b: [f64; D]| (0..D).map(|axis| a[axis] * b[axis]).sum::<f64>();
    let way = vector(|axis| to[axis] - from[axis]);
    let share = -dot(from, way) / dot(way, way);
    let nearest = vector(|axis| from[axis] + share * way[axis]);
    let least = Scalar::minimum(dot(from, from), dot(to, to));
    0.0 < share && share < 1.0 && dot(nearest, nearest) < NEAREST * NEAREST * least
}

/// The first node of an element with each of the others.
fn arms(nodes: &[u32]) -> impl Iterator<Item = [usize; 2]> {
    let pairs = nodes.iter().skip(1).map(|&other| [nodes[0], other]);
    pairs.map(|pair| pair.map(|node| node as usize))
}

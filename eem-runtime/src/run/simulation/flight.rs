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
use crate::step::control::{Scales, length, norm};
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
        let start = points::<D>(scales.before().positions.values());
        let middle = points::<D>(self.next.positions.values());
        let end = points::<D>(self.state.positions.values());
        let (share, least) = ((order.exp2() - 1.0).recip(), scales.position());
        let flies = |[a, b]: [usize; 2]| {
            let arm = |at: &[[f64; D]]| vector::<f64, D>(|axis| at[b][axis] - at[a][axis]);
            is_flight([&arm(start), &arm(middle), &arm(end)], share, least)
        };
        let mut elements = self.places.iter();
        let may_fly = elements.any(|&[group, place]| {
            let elements = self.stepper.elements(group as usize);
            arms(elements.nodes(place as usize)).any(flies)
        });
        let mobility = |node: usize| self.masses.get(node).map_or(0.0, f64::recip);
        may_fly
            && self.stepper.all().any(|group| {
                let mut is_found = false;
                group.stiffness(scales.before(), &mut |point| {
                    is_found |= arms(point.nodes).any(|arm| {
                        let rate = (point.elastic * (mobility(arm[0]) + mobility(arm[1]))).sqrt();
                        0.5 * size * rate > TAU && flies(arm)
                    });
                });
                is_found
            })
    }
}

/// Whether an arm flies, given it at the start, in the middle and at the end of a step: it makes less than a share of its way in one half
/// or passes its other end, and more than this way, m.
fn is_flight([start, middle, end]: [&[f64]; 3], share: f64, least: f64) -> bool {
    let way = |from: &[f64], to: &[f64]| norm(to.iter().zip(from).map(|(to, from)| to - from));
    let (first, second) = (way(start, middle), way(middle, end));
    let most = Scalar::maximum(first, second);
    let least = Scalar::maximum(LEAST_WAY * length(start), least);
    let stands = Scalar::minimum(first, second) < share * most;
    least < most && (stands || passes(start, middle) || passes(middle, end))
}

/// Whether the straight way of an arm passes its other end nearer than [`NEAREST`] of its lengths before and after.
fn passes(from: &[f64], to: &[f64]) -> bool {
    let sum = |of: &dyn Fn(f64, f64) -> f64| {
        let ends = from.iter().zip(to);
        ends.map(|(&from, &to)| of(from, to)).sum::<f64>()
    };
    let way = sum(&|from, to| (to - from) * (to - from));
    let share = -sum(&|from, to| from * (to - from)) / way;
    let nearest = sum(&|from, to| (from + share * (to - from)) * (from + share * (to - from)));
    let least = Scalar::minimum(sum(&|from, _| from * from), sum(&|_, to| to * to));
    0.0 < share && share < 1.0 && nearest < NEAREST * NEAREST * least
}

/// The first node of an element with each of the others.
fn arms(nodes: &[u32]) -> impl Iterator<Item = [usize; 2]> {
    let others = nodes.iter().skip(1);
    others.map(|&other| [nodes[0] as usize, other as usize])
}

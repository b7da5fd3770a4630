//! Rockets in the adjoint and in the tangents of a step: `h F n(r_m)` in the momentum balance of the node that is pushed.

use crate::algebra::system::LinearSystem;
use crate::algebra::vector;
use crate::element::group::{Direction, PerVariable, StepWeights, points};
use crate::element::layout::Layout;
use crate::element::loads::PushLine;
use crate::element::state::State;
use crate::step::line::Line;

/// A rocket in a step.
#[derive(Clone, Debug)]
pub(crate) struct RocketStep<const D: usize> {
    line: PushLine,
    /// n in the middle of the step.
    pub(crate) direction: [f64; D],
    /// `½ h F (1 − n nᵀ)/|r|`, the derivative of its impulse with respect to the head in either state, N s/m; with
    /// respect to the tail it is the negative.
    turning: [[f64; D]; D],
}

impl<const D: usize> RocketStep<D> {
    /// A rocket with the impulse `h F` in the step between two states.
    pub(crate) fn new(line: PushLine, impulse: f64, states: [&State; 2]) -> Self {
        let arm: [f64; D] = vector(|axis| {
            let arms = states.map(|state| {
                let positions = points::<D>(state.positions.values());
                positions[line.head.index][axis] - positions[line.tail.index][axis]
            });
            0.5 * (arms[0] + arms[1])
        });
        let along = Line::along(&arm);
        Self {
            line,
            direction: along.direction,
            turning: along.turning(0.5 * impulse),
        }
    }

    /// Tail and head, with the signs of the derivatives of the arm.
    fn ends(&self) -> [(usize, f64); 2] {
        let PushLine { tail, head, .. } = self.line;
        [(tail.index, -1.0), (head.index, 1.0)]
    }

    /// Subtracts the derivatives with respect to the new state from the matrix, or from the transposed one.
    pub(super) fn add_to(
        &self,
        layout: &Layout,
        is_transposed: bool,
        system: &mut LinearSystem<1>,
    ) {
        let Some(pushed) = layout.nodes[self.line.node.index] else {
            return;
        };
        for (end, sign) in self.ends() {
            let Some(first) = layout.nodes[end] else {
                continue;
            };
            for (axis, turning) in self.turning.iter().enumerate() {
                for (other, &turning) in turning.iter().enumerate() {
                    let (row, column) = (Some(pushed + axis), Some(first + other));
                    let place = if is_transposed {
                        system.place(column, row)
                    } else {
                        system.place(row, column)
                    };
                    system.parts().0[place] -= sign * turning;
                }
            }
        }
    }

    /// Adds the change of the impulse with its line, in both states, to the right-hand side of a direction.
    pub(super) fn push(&self, layout: &Layout, direction: &mut Direction) {
        let Some(pushed) = layout.nodes[self.line.node.index] else {
            return;
        };
        for (end, sign) in self.ends() {
            for (axis, turning) in self.turning.iter().enumerate() {
                for (other, &turning) in turning.iter().enumerate() {
                    let at = end * D + other;
                    let moved = direction.old.positions[at] + direction.new.positions[at];
                    direction.right[pushed + axis][0] += sign * turning * moved;
                }
            }
        }
    }

    /// Subtracts `(∂R/∂q)ᵀ w` at both ends of its line, which is the same for both states. For an anchor, whose position
    /// is no unknown, both are subtracted at the old position, and one from each of `weights.anchors`.
    pub(super) fn subtract(
        &self,
        layout: &Layout,
        by_old: &mut PerVariable,
        weights: &mut StepWeights,
    ) {
        let node = self.line.node.index;
        let w: [f64; D] = vector(|axis| weights.motion[node * D + axis]);
        for (end, sign) in self.ends() {
            for axis in 0..D {
                let rows = self.turning.iter().zip(w);
                let sum = rows.fold(0.0, |sum, (row, w)| sum + row[axis] * w);
                let (at, by) = (end * D + axis, -sign * sum);
                by_old.positions[at] -= by;
                if layout.nodes[end].is_none() {
                    by_old.positions[at] -= by;
                    for anchors in &mut weights.anchors {
                        anchors[at] -= by;
                    }
                }
            }
        }
    }
}

//! Rockets: forces of a given size along a line that turns with the scene.
//!
//! ```text
//! f = F(t) n,   n = r/|r|,   r = q_head − q_tail      at the stages, or t and q means over the step
//! ∂n/∂q = (1 − n nᵀ)(∂q_head − ∂q_tail)/|r|
//! ```

use crate::algebra::system::LinearSystem;
use crate::algebra::{add, dot, hypot};
use crate::element::error::StateError;
use crate::element::group::StepView;
use crate::element::impulse::Impulses;
use crate::element::loads::{Push, PushLine, StepLoads};
use crate::element::tableau::Tableau;
use eem_material::number::scalar::is_positive;

/// The rockets of a scene. Vectors are stored component after component, so that this is compiled once for all dimensions.
#[derive(Debug)]
pub(super) struct Rockets {
    dimension: usize,
    all: Vec<Rocket>,
    /// The stages of the scheme; without stages, rockets push along their line in the middle of the step.
    rule: Option<&'static Tableau>,
    /// The forces last found at a trial, per stage and node, N; no nodes without rockets.
    forces: Vec<Vec<f64>>,
    /// Memory for a direction.
    direction: Vec<f64>,
}

/// A rocket, with the indices of its rows and matrix entries.
#[derive(Clone, Debug)]
struct Rocket {
    line: PushLine,
    /// The first row of the node that it pushes in each set of unknowns.
    rows: Vec<usize>,
    /// The tangent entries in the rows of that node and the columns of tail and head, by set of the rows, set of the
    /// columns, row, column, tail or head.
    places: Vec<usize>,
}

/// The index of the row of an unknown of a node in a set, or of the entry with such a column, given axes.
pub(super) type Indices<'a> = (
    &'a dyn Fn(usize, [usize; 2]) -> usize,
    &'a dyn Fn([usize; 2], [[usize; 2]; 2]) -> usize,
);

impl Rockets {
    /// The rockets of a scene with this number of nodes, for a scheme with these stages.
    pub(super) fn new(
        rule: Option<&'static Tableau>,
        loads: &StepLoads,
        [dimension, nodes]: [usize; 2],
        (row, place): Indices<'_>,
    ) -> Self {
        let sets = rule.map_or(1, Tableau::sets);
        let mut all = Vec::with_capacity(loads.pushes.len());
        for push in &loads.pushes {
            let line = push.line;
            let node = line.node.index;
            let (mut rows, mut places) = (Vec::new(), Vec::new());
            for set in 0..sets {
                rows.push(row(set, [node, 0]));
                for columns in 0..sets {
                    for axes in 0..dimension * dimension {
                        let [down, along] = [axes / dimension, axes % dimension];
                        for end in [line.tail.index, line.head.index] {
                            places.push(place([set, columns], [[node, down], [end, along]]));
                        }
                    }
                }
            }
            all.push(Rocket { line, rows, places });
        }
        let stages = rule.map_or(1, Tableau::stages);
        let nodes = if all.is_empty() { 0 } else { nodes };
        Self {
            dimension,
            all,
            rule,
            forces: vec![vec![0.0; dimension * nodes]; stages],
            direction: vec![0.0; dimension],
        }
    }

    /// Whether the scene has no rockets.
    pub(super) fn are_none(&self) -> bool {
        self.all.is_empty()
    }

    /// Adds the forces of rockets last found at a stage to a load on a node, N.
    #[inline]
    pub(super) fn add_to<const D: usize>(
        &self,
        mut load: [f64; D],
        [stage, node]: [usize; 2],
    ) -> [f64; D] {
        if !self.are_none() {
            add(&mut load, 1.0, &self.forces[stage][D * node..]);
        }
        load
    }

    /// Finds the forces at a trial with displacements per stage, and adds them to the system of an iteration if there is one.
    #[cold]
    pub(super) fn evaluate<'a>(
        &mut self,
        view: &StepView<'_>,
        displacements: &dyn Fn(usize) -> &'a [f64],
        mut system: Option<&mut LinearSystem<1>>,
    ) -> Result<(), StateError> {
        let sets = self.rule.map_or(1, Tableau::sets);
        for (stage, forces) in self.forces.iter_mut().enumerate() {
            forces.fill(0.0);
            let (loads, share) = match self.rule {
                None if view.phase.is_at_rest() => (view.loads, 1.0),
                None => (view.loads, 0.5),
                Some(_) => (&view.stages[stage], 1.0),
            };
            for (rocket, &Push { thrust, .. }) in self.all.iter().zip(&loads.pushes) {
                let direction = &mut self.direction[..];
                let length = rocket.point(view, displacements(stage), share, direction)?;
                add(
                    &mut forces[self.dimension * rocket.line.node.index..],
                    thrust,
                    direction,
                );
                let Some(system) = system.as_deref_mut() else {
                    continue;
                };
                for set in 0..sets {
                    let weight = self.rule.map_or(1.0, |rule| rule.positions[set][stage]);
                    let impulse = weight * (view.step * thrust);
                    let turning = share * impulse / length;
                    rocket.add_to([set, stage], system, direction, [impulse, turning]);
                }
            }
        }
        Ok(())
    }

    /// Adds `h f` at a stage to the impulses, and its magnitude to `magnitudes`.
    #[inline]
    pub(super) fn add_impulses<const D: usize>(
        &self,
        (stage, step): (usize, f64),
        impulses: &mut Impulses<'_, D>,
        magnitudes: &mut [f64],
    ) {
        for (node, force) in self.forces[stage].chunks_exact(D).enumerate() {
            add(impulses.of(node), step, force);
            if let Some(magnitude) = magnitudes.get_mut(node) {
                for force in force {
                    *magnitude += (step * force).abs();
                }
            }
        }
    }
}

impl Rocket {
    /// Finds the direction n of the rocket after this fraction of the displacements; returns |r|.
    fn point(
        &self,
        view: &StepView<'_>,
        moved: &[f64],
        share: f64,
        direction: &mut [f64],
    ) -> Result<f64, StateError> {
        let PushLine { node, tail, head } = self.line;
        let [from, to] = [tail, head].map(|end| end.index * direction.len());
        let positions = view.state.positions.values();
        for (axis, arm) in direction.iter_mut().enumerate() {
            let turned = moved[to + axis] - moved[from + axis];
            *arm = (positions[to + axis] - positions[from + axis]) + share * turned;
        }
        let length = dot(direction, direction).sqrt();
        if !is_positive(length) {
            return Err(StateError::NoDirection {
                node,
                tail,
                head,
                value: hypot(direction),
            });
        }
        for arm in direction {
            *arm /= length;
        }
        Ok(length)
    }

    /// Adds an impulse in a direction to the right-hand side of the rows of a set, and its negative derivative with respect to the
    /// nodes in another set, `(1 − n nᵀ)` times a number, to the tangent.
    fn add_to(
        &self,
        [rows, columns]: [usize; 2],
        system: &mut LinearSystem<1>,
        direction: &[f64],
        [impulse, turning]: [f64; 2],
    ) {
        let d = direction.len();
        let (values, right) = system.parts();
        let places = self.places[2 * d * d * (rows * self.rows.len() + columns)..].chunks_exact(2);
        for (axes, places) in (0..d * d).zip(places) {
            let [row, column] = [axes / d, axes % d];
            if column == 0 {
                right[self.rows[rows] + row][0] += impulse * direction[row];
            }
            let own = if row == column { 1.0 } else { 0.0 };
            let entry = turning * (own - direction[row] * direction[column]);
            values[places[0]] += entry;
            values[places[1]] -= entry;
        }
    }
}

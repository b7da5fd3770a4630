//! Rockets: forces of a given size along a line that turns with the scene.
//!
//! ```text
//! f = F(t) n,   n = r/|r|,   r = q_head − q_tail      at the stages, or t and q means over the step
//! ∂n/∂q = (1 − n nᵀ)(∂q_head − ∂q_tail)/|r|
//! ```

use crate::algebra::system::LinearSystem;
use crate::algebra::{add, hypot, scaled, vector};
use crate::element::error::StateError;
use crate::element::group::{Sites, StepView, Trial, points};
use crate::element::impulse::Impulses;
use crate::element::loads::{Push, PushLine, StepLoads};
use crate::element::tableau::{MOST_SETS, Tableau};
use crate::step::line::Line;
use eem_material::number::scalar::is_positive;

/// The rockets of a scene.
#[derive(Debug)]
pub(super) struct Rockets<const D: usize> {
    all: Vec<Rocket<D>>,
    /// The stages of the scheme; without stages, rockets push along their line in the middle of the step.
    rule: Option<&'static Tableau>,
    /// The forces last found at a trial, per stage and node, N; no nodes without rockets.
    forces: Vec<Vec<[f64; D]>>,
}

/// A rocket, with the indices of its rows and matrix entries.
#[derive(Clone, Copy, Debug)]
struct Rocket<const D: usize> {
    line: PushLine,
    /// The first row of the node that it pushes in each set of unknowns.
    rows: [usize; MOST_SETS],
    /// The tangent entries in the rows of that node and the columns of tail and head, by set of the rows, set of the
    /// columns, tail or head, row and column.
    places: [[[[[usize; D]; D]; 2]; MOST_SETS]; MOST_SETS],
}

impl<const D: usize> Rockets<D> {
    /// The rockets of a scene, for a scheme with these stages.
    pub(super) fn new(
        rule: Option<&'static Tableau>,
        loads: &StepLoads,
        nodes: usize,
        sites: &Sites<'_, D>,
    ) -> Self {
        let sets = rule.map_or(1, Tableau::sets);
        let unknown = |node: usize, axis: usize| sites.layout.nodes[node].map(|first| first + axis);
        let mut all = Vec::with_capacity(loads.pushes.len());
        for push in &loads.pushes {
            let PushLine { node, tail, head } = push.line;
            // Indices of sets beyond the last are never used.
            let mut rocket = Rocket {
                line: push.line,
                rows: [0; MOST_SETS],
                places: [[[[[0; D]; D]; 2]; MOST_SETS]; MOST_SETS],
            };
            for (rows, columns) in (0..sets * sets).map(|pair| (pair / sets, pair % sets)) {
                let sites = sites.of_sets([rows, columns]);
                if rows == columns {
                    rocket.rows[rows] = sites.row(unknown(node.index, 0));
                }
                for (places, end) in rocket.places[rows][columns].iter_mut().zip([tail, head]) {
                    for (row, places) in places.iter_mut().enumerate() {
                        let row = unknown(node.index, row);
                        *places = vector(|column| sites.place(row, unknown(end.index, column)));
                    }
                }
            }
            all.push(rocket);
        }
        let stages = rule.map_or(1, Tableau::stages);
        let nodes = if all.is_empty() { 0 } else { nodes };
        Self {
            all,
            rule,
            forces: vec![vec![[0.0; D]; nodes]; stages],
        }
    }

    /// Whether the scene has no rockets.
    pub(super) fn are_none(&self) -> bool {
        self.all.is_empty()
    }

    /// Adds the forces of rockets last found at a stage to a load on a node, N.
    #[inline]
    pub(super) fn add_to(&self, load: [f64; D], [stage, node]: [usize; 2]) -> [f64; D] {
        if self.are_none() {
            return load;
        }
        let force = &self.forces[stage][node];
        vector(|axis| load[axis] + force[axis])
    }

    /// Finds the forces at a trial, and adds them to the system of an iteration if there is one.
    #[inline]
    pub(super) fn evaluate(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        system: Option<&mut LinearSystem<1>>,
    ) -> Result<(), StateError> {
        if self.are_none() || !view.phase.moves() {
            return Ok(());
        }
        self.evaluate_all(view, trial, system)
    }

    fn evaluate_all(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        mut system: Option<&mut LinearSystem<1>>,
    ) -> Result<(), StateError> {
        for (stage, forces) in self.forces.iter_mut().enumerate() {
            forces.fill([0.0; D]);
            let (loads, share) = match self.rule {
                None if view.phase.is_at_rest() => (view.loads, 1.0),
                None => (view.loads, 0.5),
                Some(_) => (&view.stages[stage], 1.0),
            };
            for (rocket, &Push { thrust, .. }) in self.all.iter().zip(&loads.pushes) {
                let line = rocket.line_at(view, trial.displacements_of_set(stage), share)?;
                let node = rocket.line.node.index;
                add(&mut forces[node], thrust, &line.direction);
                let Some(system) = system.as_deref_mut() else {
                    continue;
                };
                for set in 0..trial.sets {
                    let weight = self.rule.map_or(1.0, |rule| rule.positions[set][stage]);
                    let impulse = weight * (view.step * thrust);
                    let turning = line.turning(share * impulse);
                    let impulse = scaled(impulse, &line.direction);
                    rocket.add_to([set, stage], system, (&impulse, &turning));
                }
            }
        }
        Ok(())
    }

    /// Adds `h f` at a stage to the impulses, and its magnitude to `magnitudes`.
    #[inline]
    pub(super) fn add_impulses(
        &self,
        (stage, step): (usize, f64),
        impulses: &mut Impulses<'_, D>,
        magnitudes: &mut [f64],
    ) {
        for (node, force) in self.forces[stage].iter().enumerate() {
            add(impulses.of(node), step, force);
            if let Some(magnitude) = magnitudes.get_mut(node) {
                for force in force {
                    *magnitude += (step * force).abs();
                }
            }
        }
    }
}

impl<const D: usize> Rocket<D> {
    /// The line of the rocket after this fraction of the displacements.
    fn line_at(
        &self,
        view: &StepView<'_>,
        moved: &[[f64; D]],
        share: f64,
    ) -> Result<Line<D>, StateError> {
        let PushLine { node, tail, head } = self.line;
        let [from, to] = [tail.index, head.index];
        let positions = points::<D>(view.state.positions.values());
        let arm: [f64; D] = vector(|axis| {
            let turned = moved[to][axis] - moved[from][axis];
            (positions[to][axis] - positions[from][axis]) + share * turned
        });
        let line = Line::along(&arm);
        if !is_positive(line.length) {
            return Err(StateError::NoDirection {
                node,
                tail,
                head,
                value: hypot(&arm),
            });
        }
        Ok(line)
    }

    /// Adds an impulse to the right-hand side of the rows of a set, and its negative derivative with respect to the nodes
    /// in another set to the tangent.
    fn add_to(
        &self,
        [rows, columns]: [usize; 2],
        system: &mut LinearSystem<1>,
        (impulse, turning): (&[f64; D], &[[f64; D]; D]),
    ) {
        let (values, right) = system.parts();
        let places = &self.places[rows][columns];
        for axis in 0..D {
            right[self.rows[rows] + axis][0] += impulse[axis];
            for column in 0..D {
                let [tail, head] = [places[0][axis][column], places[1][axis][column]];
                values[tail] += turning[axis][column];
                values[head] -= turning[axis][column];
            }
        }
    }
}

//! Rockets: forces of a given size along a line that turns with the scene.
//!
//! ```text
//! f = F(t_m) n,   n = r_m/|r_m|,   r_m = mean of q_head − q_tail over the step
//! ∂n/∂q¹ = (1 − n nᵀ)(∂q¹_head − ∂q¹_tail)/(2|r_m|)
//! ```

use core::array;

use crate::algebra::system::LinearSystem;
use crate::element::error::StateError;
use crate::element::group::{Sites, StepView, Trial, points};
use crate::element::impulse::Impulses;
use crate::element::loads::{Push, PushLine, StepLoads, point};
use crate::number::compact::compact;
use crate::number::scalar::{Real, is_positive};

/// The rockets of a scene.
#[derive(Debug)]
pub(super) struct Rockets<S, const D: usize> {
    all: Vec<Rocket<D>>,
    /// What was last found at a trial, per coordinate, N; empty without rockets.
    forces: Vec<S>,
}

/// Where a rocket writes.
#[derive(Clone, Copy, Debug)]
struct Rocket<const D: usize> {
    line: PushLine,
    /// The first row of the node that it pushes.
    row: u32,
    /// The entries of that node in the tangent, row by row, in the columns of tail and head.
    places: [[[u32; D]; D]; 2],
}

/// A line through a step.
struct Line<S, const D: usize> {
    /// n.
    direction: [S; D],
    /// `|r_m|`, m.
    length: S,
}

impl<S: Real, const D: usize> Rockets<S, D> {
    /// Those of a scheme with one set of unknowns.
    pub(super) fn new(loads: &StepLoads<S>, nodes: usize, sites: &Sites<'_, S, D>) -> Self {
        let unknown = |node: usize, axis: usize| sites.layout.nodes[node].map(|first| first + axis);
        let rockets = loads.pushes.iter().map(|push| {
            let PushLine { node, tail, head } = push.line;
            let place = |end: usize| {
                array::from_fn(|row| {
                    array::from_fn(|column| {
                        compact(sites.place(unknown(node.index, row), unknown(end, column)))
                    })
                })
            };
            Rocket {
                line: push.line,
                row: compact(sites.row(unknown(node.index, 0))),
                places: [tail.index, head.index].map(place),
            }
        });
        let all: Vec<_> = rockets.collect();
        let coordinates = if all.is_empty() { 0 } else { nodes * D };
        Self {
            all,
            forces: vec![S::zero(); coordinates],
        }
    }

    /// Whether there are none.
    pub(super) fn are_none(&self) -> bool {
        self.all.is_empty()
    }

    /// A load on a node with the force that was last found there, N.
    #[inline]
    pub(super) fn add_to(&self, load: [S; D], node: usize) -> [S; D] {
        let force = point::<S, D>(&self.forces, node);
        array::from_fn(|axis| load[axis] + force[axis])
    }

    /// Finds the forces at a trial, and adds them to the system of an iteration if there is one.
    #[inline]
    pub(super) fn evaluate(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        system: Option<&mut LinearSystem<S, 1>>,
    ) -> Result<(), StateError> {
        if self.are_none() || !view.phase.moves() {
            return Ok(());
        }
        self.evaluate_all(view, trial, system)
    }

    fn evaluate_all(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        mut system: Option<&mut LinearSystem<S, 1>>,
    ) -> Result<(), StateError> {
        self.forces.fill(S::zero());
        let forces = self.forces.as_chunks_mut::<D>().0;
        for (rocket, &Push { thrust, .. }) in self.all.iter().zip(&view.loads.pushes) {
            let line = rocket.mean_line(view, trial)?;
            let node = rocket.line.node.index;
            for (sum, force) in forces[node].iter_mut().zip(line.push(thrust)) {
                *sum += force;
            }
            if let Some(system) = system.as_deref_mut() {
                let impulse = view.step * thrust;
                rocket.add_to(system, &line.push(impulse), &line.turning(impulse));
            }
        }
        Ok(())
    }

    /// Adds `h f` to the impulses, and the magnitude of what it is computed from.
    #[inline]
    pub(super) fn add_impulses(
        &self,
        step: S,
        impulses: &mut Impulses<'_, S, D>,
        magnitudes: &mut [S],
    ) {
        let forces = self.forces.as_chunks::<D>().0;
        for (node, force) in forces.iter().enumerate() {
            for (impulse, &force) in impulses.of(node).iter_mut().zip(force) {
                *impulse += step * force;
                if let Some(magnitude) = magnitudes.get_mut(node) {
                    *magnitude += (step * force).abs();
                }
            }
        }
    }
}

impl<const D: usize> Rocket<D> {
    /// The mean line of a step.
    fn mean_line<S: Real>(
        &self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
    ) -> Result<Line<S, D>, StateError> {
        let half = S::from_f64(0.5);
        let PushLine { node, tail, head } = self.line;
        let [from, to] = [tail.index, head.index];
        let positions = points::<S, D>(view.state.positions.values());
        let moved = &trial.displacements;
        let mean: [S; D] = array::from_fn(|axis| {
            let turned = moved[to][axis] - moved[from][axis];
            (positions[to][axis] - positions[from][axis]) + half * turned
        });
        let square = mean.iter().fold(S::zero(), |sum, &r| sum + r * r);
        if !is_positive(square) {
            let length = mean.iter().fold(S::zero(), |length, &r| length.hypot(r));
            return Err(StateError::NoDirection {
                node,
                tail,
                head,
                value: length.to_f64(),
            });
        }
        let length = square.sqrt();
        Ok(Line {
            direction: mean.map(|r| r / length),
            length,
        })
    }

    /// Adds `h f` to the right-hand side and `−h ∂f/∂q¹` to the tangent.
    fn add_to<S: Real>(
        &self,
        system: &mut LinearSystem<S, 1>,
        impulse: &[S; D],
        turning: &[[S; D]; D],
    ) {
        let (values, right) = system.parts();
        for axis in 0..D {
            right[self.row as usize + axis][0] += impulse[axis];
            for column in 0..D {
                let [tail, head] = self.places.map(|places| places[axis][column] as usize);
                values[tail] += turning[axis][column];
                values[head] -= turning[axis][column];
            }
        }
    }
}

impl<S: Real, const D: usize> Line<S, D> {
    /// `F n`.
    fn push(&self, thrust: S) -> [S; D] {
        self.direction.map(|n| thrust * n)
    }

    /// `h F (1 − n nᵀ)/(2|r_m|)` of an impulse hF.
    fn turning(&self, impulse: S) -> [[S; D]; D] {
        let size = impulse / (self.length + self.length);
        let n = &self.direction;
        array::from_fn(|row| {
            array::from_fn(|column| {
                let own = if row == column { S::one() } else { S::zero() };
                size * (own - n[row] * n[column])
            })
        })
    }
}

//! The way back through a history: what is carried from step to step.

use super::derivatives::{Of, Passage};
use crate::element::conduction::Partner;
use crate::run::gradient::objective::Objective;
use crate::run::gradient::result::{Gradient, OfElement};
use crate::run::gradient::series::Series;
use crate::run::gradient::timed::Timed;
use crate::run::simulation::Simulation;
use crate::step::adjoint::{Adjoint, PerVariable, Terms};
use nalgebra::SVector;

/// The way back through a history.
pub(super) struct Way<const D: usize> {
    pub(super) passage: Passage<D>,
    pub(super) paths: Vec<(usize, Partner)>,
    /// The anchors that masses couple with other nodes, and whether they are moved.
    pub(super) anchors: Vec<(usize, bool)>,
    /// The derivatives of the present step by the velocities of moved anchors at its end, where masses couple them with
    /// others, and by the temperatures of reservoirs.
    pub(super) by_speeds: Vec<(usize, SVector<f64, D>)>,
    pub(super) by_reservoirs: Vec<f64>,
    /// The adjoint, with the derivatives by the present state.
    pub(super) adjoint: Adjoint<D>,
    /// The derivative by the size of the step before the present state, as far as the objective itself contains this size.
    pub(super) by_size: f64,
    /// The terms of the derivative by the size of the last step.
    pub(super) last: Option<Terms>,
    pub(super) found: Gradient<D>,
}

/// Objectives with factors. The value of the first one is that of the gradient.
pub(super) type Weighted<'a, const D: usize> = &'a [(f64, &'a Objective<D>)];

/// Adds a derivative by a state variable to those by the present state, or one by an input to those by inputs.
pub(super) fn add_to<const D: usize>(
    (adjoint, found): (&mut Adjoint<D>, &mut Gradient<D>),
    of: Of<'_>,
    by: f64,
) {
    let costate = &mut adjoint.costate;
    match of {
        Of::Position(at) => costate.positions[at] += by,
        Of::Velocity(at) => adjoint.add_by_velocity(at, by),
        Of::Viscous(slot) => costate.viscous[slot] += by,
        Of::Temperature(slot) => costate.temperatures[slot] += by,
        Of::Entropy(index) => costate.reservoirs[index] += by,
        Of::Mass(node) => found.masses[node] += by,
        Of::Pair(place) => found.pairs[place].1 += by,
        Of::Gravity(axis) => found.gravity[axis] += by,
        Of::Reservoir(index) => found.reservoirs[index] += by,
        Of::Parameters(element, values) => add(&mut found.elements[element].values, by, values),
    }
}

/// Adds `factor values` to `sum`.
pub(super) fn add(sum: &mut [f64], factor: f64, values: &[f64]) {
    for (sum, &value) in sum.iter_mut().zip(values) {
        *sum += factor * value;
    }
}

impl<const D: usize> Simulation<D> {
    /// A gradient of zeros, to which the derivatives of each step are added, with the names of all parameters.
    pub(super) fn no_gradient(&self, passage: &Passage<D>) -> Gradient<D> {
        let nodes = self.masses.len();
        let reservoirs = self.conduction.reservoirs.len();
        let elements = self.places.iter().map(|&[group, at]| {
            let of_group = self.stepper.elements(group as usize);
            let names = of_group.parameters();
            OfElement {
                element: of_group.handle(at as usize),
                slots: of_group.slots(at as usize),
                dashpots: self.shapes[group as usize].dashpots,
                names,
                units: of_group.parameter_units(),
                viscous_unit: self.viscous_unit(group as usize),
                values: vec![0.0; names.len()],
            }
        });
        let (mut vectors, mut numbers, mut timed) = (Vec::new(), Vec::new(), Vec::new());
        for (load, is_function) in self.timed_loads() {
            if is_function {
                timed.push(load);
            }
            match load {
                Timed::Force(_) | Timed::Motion(_) => vectors.push((load, Series(Vec::new()))),
                _ => numbers.push((load, Series(Vec::new()))),
            }
        }
        // Several forces on a node have one series.
        vectors.sort_by_key(|(load, _)| load.key());
        vectors.dedup_by_key(|(load, _)| load.key());
        Gradient {
            scene: self.scene.clone(),
            value: 0.0,
            unit: String::new(),
            growth: 1.0,
            start: PerVariable::zero(nodes * D, &passage.layout, reservoirs),
            moving: (0..nodes)
                .filter(|&node| self.masses.get(node).is_some())
                .collect(),
            masses: vec![0.0; nodes],
            pairs: passage.pairs.iter().map(|&nodes| (nodes, 0.0)).collect(),
            gravity: SVector::from_element(0.0),
            conductances: vec![0.0; self.conduction.path_ends().len()],
            reservoirs: vec![0.0; reservoirs],
            elements: elements.collect(),
            sizes: Vec::new(),
            started: self.time(),
            timed,
            vectors,
            numbers,
        }
    }

    /// All loads whose values in the course of time are inputs, and whether they are functions of time.
    pub(super) fn timed_loads(&self) -> Vec<(Timed, bool)> {
        let (loads, mut all) = (&self.loads, Vec::new());
        for (node, course) in &loads.forces {
            all.push((Timed::Force(*node), course.function().is_some()));
        }
        for (anchor, course) in &loads.motions {
            all.push((Timed::Motion(*anchor), course.function().is_some()));
        }
        for (element, course) in &loads.temperatures {
            all.push((Timed::Thermostat(*element), course.function().is_some()));
        }
        for (place, rocket) in loads.rockets.iter().enumerate() {
            let node = rocket.line.node;
            let before = loads.rockets[..place].iter();
            let before = before.filter(|other| other.line.node == node).count();
            all.push((Timed::Thrust(node, before), true));
        }
        for (oven, _) in &loads.ovens {
            all.push((Timed::Oven(self.scene.reservoir(*oven)), true));
        }
        all
    }
}

//! The derivatives of a step by its inputs, from the weights of its equations.

use std::collections::BTreeSet;

use super::derivatives::{Of, Passage, viscous_unit};
use crate::algebra::add;
use crate::element::conduction::Partner;
use crate::element::group::Elements;
use crate::element::layout::Shape;
use crate::element::loads::point;
use crate::element::state::State;
use crate::run::gradient::input::{Objective, Timed};
use crate::run::gradient::result::{Gradient, OfElement};
use crate::run::gradient::series::{Series, dot};
use crate::run::simulation::Simulation;
use crate::scene::loads::Course;
use crate::step::adjoint::{Adjoint, PerVariable, RocketStep, Terms};
use nalgebra::SVector;

/// A step that was made: its size, its old state and its new one.
pub(super) type Made<'a> = (f64, [&'a State; 2]);

/// The velocity of a moved anchor at the end of a step, from the cubic through four positions,
/// `q̇ = Σ weight (q_end − q_k)/(2h)`: the time of `q_k` in thirds of the step, and its weight.
pub(super) const CUBIC: [(f64, f64); 3] = [(2.0, 18.0), (1.0, -9.0), (0.0, 2.0)];

fn vector<const D: usize>(values: &[f64], node: usize) -> SVector<f64, D> {
    point(values, node).into()
}

impl<const D: usize> Simulation<D> {
    /// Finds the rockets of a step and the temperatures of ovens in it.
    pub(super) fn find_loads(&self, (h, [old, new]): Made<'_>, passage: &mut Passage<D>) {
        let middle = old.time.value + 0.5 * h;
        for (index, temperature) in &self.run.loads.ovens {
            passage.conduction.reservoirs[*index] = temperature(middle);
        }
        passage.rockets.clear();
        for rocket in &self.run.loads.rockets {
            let impulse = h * (rocket.thrust)(middle);
            let rocket = RocketStep::new(rocket.line, impulse, [old, new]);
            passage.rockets.push(rocket);
        }
    }

    /// Finds the derivatives by the velocities of moved anchors at the end of a step, and drops those by the old velocities of
    /// anchors that do not move.
    pub(super) fn find_by_speeds(way: &mut Way<D>) {
        way.by_speeds.clear();
        let adjoint = &mut way.adjoint;
        for &(node, is_moved) in &way.anchors {
            if is_moved {
                let [old, new] =
                    [&adjoint.costate, &adjoint.after].map(|by| vector(&by.velocities, node));
                way.by_speeds.push((node, new - old));
            } else {
                adjoint.costate.velocities[node * D..][..D].fill(0.0);
            }
        }
    }

    /// `Δv − h g` of a node, m/s: the change of its velocity without gravity. Where masses couple nodes, `mass` is not used.
    pub(super) fn pushed(&self, (h, states): Made<'_>, node: usize, mass: f64) -> SVector<f64, D> {
        let [old, new] = states.map(|state| state.velocity::<D>(node, mass));
        SVector::from_fn(|axis, _| new[axis] - old[axis] - h * self.run.loads.gravity[axis])
    }

    /// Adds the derivatives of a step by masses, gravity, conductances and temperatures of reservoirs.
    pub(super) fn add_step(&self, made: Made<'_>, way: &mut Way<D>) {
        let (h, [old, _]) = made;
        let (weights, found) = (&way.adjoint.weights, &mut way.found);
        for (node, mass) in self.run.masses.iter().enumerate() {
            let Some(mass) = mass else { continue };
            let weight = vector::<D>(&weights.motion, node);
            found.masses[node] -= dot(&weight, &self.pushed(made, node, mass));
            found.gravity += weight * (h * way.passage.sums[node]);
        }
        for ([i, j], by) in &mut found.pairs {
            let [w_i, w_j] = [*i, *j].map(|node| vector::<D>(&weights.motion, node));
            let [of_i, of_j] = [*i, *j].map(|node| self.pushed(made, node, 1.0));
            *by -= dot(&w_i, &of_j) + dot(&w_j, &of_i);
        }
        let theta = &weights.temperatures;
        let per_theta = |slot: usize| weights.entropies[slot] / theta[slot];
        let by_new = &way.adjoint.after.reservoirs;
        let of_heat = |at: usize| by_new[at] / way.passage.conduction.reservoirs[at];
        let by_reservoirs = &mut way.by_reservoirs;
        by_reservoirs.fill(0.0);
        for (slot, &own) in theta.iter().enumerate() {
            for link in way.passage.conduction.links(slot) {
                if let Partner::Reservoir(at) = link.partner {
                    let outer = way.passage.conduction.reservoirs[at];
                    by_reservoirs[at] +=
                        h * link.conductance * (per_theta(slot) - of_heat(at) * own / outer);
                }
            }
        }
        for (sum, &by) in found.reservoirs.iter_mut().zip(&*by_reservoirs) {
            *sum += by;
        }
        let middle = old.time.value + 0.5 * h;
        for (load, series) in &mut found.numbers {
            if let Timed::Oven(oven) = load {
                series.0.push((middle, by_reservoirs[oven.index]));
            }
        }
        for (sum, &(slot, partner)) in found.conductances.iter_mut().zip(&way.paths) {
            *sum += match partner {
                Partner::Slot(other) => {
                    h * (theta[other] - theta[slot]) * (per_theta(slot) - per_theta(other))
                }
                Partner::Reservoir(at) => {
                    let outer = way.passage.conduction.reservoirs[at];
                    h * (outer - theta[slot]) * (per_theta(slot) - of_heat(at))
                }
            };
        }
    }

    /// Appends the derivatives of a step by the values of functions of time, the last value first.
    pub(super) fn add_series(&self, (h, [old, new]): Made<'_>, way: &mut Way<D>) {
        let (start, end) = (old.time.value, new.time.value);
        let middle = start + 0.5 * h;
        let (weights, found) = (&way.adjoint.weights, &mut way.found);
        let mut rockets = way.passage.rockets.iter();
        for (load, series) in &mut found.numbers {
            match load {
                Timed::Thrust(node, _) => {
                    let weight = vector::<D>(&weights.motion, node.index);
                    if let Some(rocket) = rockets.next() {
                        let by = dot(&weight, &rocket.direction.into());
                        series.0.push((middle, by * h));
                    }
                }
                Timed::Thermostat(element) => {
                    if let Some(slot) = self.run.slots(*element).thermal {
                        series.0.push((end, weights.held[slot]));
                    }
                }
                _ => {}
            }
        }
        for (load, series) in &mut found.vectors {
            let Timed::Motion(anchor) = load else {
                if let Timed::Force(node) = load {
                    let weight = vector::<D>(&weights.motion, node.index);
                    series.0.push((middle, weight * h));
                }
                continue;
            };
            let node = anchor.index;
            let [mut by_old, mut by_new] =
                [0, 1].map(|side| vector::<D>(&weights.anchors[side], node));
            let at_end = series.len().checked_sub(1);
            if let Some((_, by)) = way.by_speeds.iter().find(|(own, _)| *own == node) {
                for (thirds, weight) in CUBIC {
                    let own = by * (0.5 * weight / h);
                    by_new += own;
                    if thirds > 0.0 {
                        let at = start + thirds * (h / 3.0);
                        series.0.push((at, -own));
                    } else {
                        by_old -= own;
                    }
                }
            }
            if let Some(at_end) = at_end {
                series.0[at_end].1 += by_new;
            }
            series.0.push((start, by_old));
        }
    }

    /// Appends the derivative of a step by its size, with the values of functions of time kept:
    ///
    /// ```text
    /// (v¹·λ_v⁰ − v⁰·λ_v¹)/h + λ_X·ΔX/h + Σ λ_σ (1/θ_r) Σ κ_r (θ* − θ_r)        and the terms of the points
    /// ```
    ///
    /// with the positions X of anchors whose velocity a controller has set. Moved anchors that masses couple with other nodes add
    /// `Δv·M w_v/h`; if their motion is a function, its velocity v¹ is a difference over h, which adds `−v¹·∂J/∂v¹/h`.
    pub(super) fn add_size(&self, (h, [old, new]): Made<'_>, way: &mut Way<D>) {
        let (by_old, by_new) = (&way.adjoint.costate, &way.adjoint.after);
        let weights = &way.adjoint.weights;
        let mut terms = weights.by_size;
        terms.add(way.by_size);
        for (node, mass) in self.run.masses.iter().enumerate() {
            let Some(mass) = mass else { continue };
            let [v0, v1] = [old, new].map(|state| state.velocity::<D>(node, mass));
            for (axis, at) in (node * D..(node + 1) * D).enumerate() {
                terms.add(v1[axis] * by_old.velocities[at] / h);
                terms.add(-v0[axis] * by_new.velocities[at] / h);
            }
        }
        for (node, motion) in &self.run.loads.motions {
            let node = node.index;
            let is_set = matches!(motion, Course::Set(_));
            let by_speed = way.by_speeds.iter().find(|(own, _)| *own == node);
            for (axis, at) in (node * D..(node + 1) * D).enumerate() {
                if is_set {
                    let moved = [old, new].map(|state| state.positions.values()[at]);
                    let by = by_new.positions[at] + weights.anchors[1][at];
                    terms.add_change(by / h, moved);
                }
                if let Some((_, by_speed)) = by_speed {
                    let speeds = [old, new].map(|state| state.velocities.values()[at]);
                    terms.add_change(by_old.velocities[at] / h, speeds);
                    if !is_set {
                        terms.add(-by_speed[axis] * speeds[1] / h);
                    }
                }
            }
        }
        for (slot, &own) in weights.temperatures.iter().enumerate() {
            for link in way.passage.conduction.links(slot) {
                if let Partner::Reservoir(at) = link.partner {
                    let outer = way.passage.conduction.reservoirs[at];
                    let of_heat = by_new.reservoirs[at] / outer;
                    terms.add(of_heat * link.conductance * (own - outer));
                }
            }
        }
        way.found.sizes.push((new.time.value, terms.sum));
        way.last.get_or_insert(terms);
    }
}

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

impl<const D: usize> Simulation<D> {
    /// All elements in the order of creation: the capabilities of their group, the group, and their index there.
    pub(super) fn all_elements(&self) -> impl Iterator<Item = (Shape, &dyn Elements, usize)> {
        let stepper = &self.run.stepper;
        let places = self.run.all_places();
        places.map(move |([group, place], shape)| (shape, stepper.elements(group), place))
    }

    /// A gradient of zeros, to which the derivatives of each step are added, with the names of all parameters.
    pub(super) fn no_gradient(&self, passage: &Passage<D>) -> Gradient<D> {
        let nodes = self.run.masses.len();
        let reservoirs = self.run.conduction.reservoirs.len();
        let elements = self.all_elements().map(|(shape, group, place)| OfElement {
            element: group.handle(place),
            slots: group.slots(place),
            dashpots: shape.dashpots,
            names: group.parameters(),
            units: group.parameter_units(),
            viscous_unit: viscous_unit(&shape),
            values: vec![0.0; group.parameters().len()],
        });
        let (mut vectors, mut numbers, mut timed) = (Vec::new(), Vec::new(), Vec::new());
        let mut forced = BTreeSet::new();
        for (load, is_function) in self.timed_loads() {
            if is_function {
                timed.push(load);
            }
            match load {
                // Several forces on a node have one series.
                Timed::Force(node) if !forced.insert(node.index) => {}
                Timed::Force(_) | Timed::Motion(_) => vectors.push((load, Series(Vec::new()))),
                _ => numbers.push((load, Series(Vec::new()))),
            }
        }
        Gradient {
            scene: self.run.scene.clone(),
            value: 0.0,
            unit: String::new(),
            growth: 1.0,
            start: PerVariable::zero(nodes * D, &passage.layout, reservoirs),
            moving: (0..nodes)
                .filter(|&node| self.run.masses.get(node).is_some())
                .collect(),
            masses: vec![0.0; nodes],
            pairs: passage.pairs.iter().map(|&nodes| (nodes, 0.0)).collect(),
            gravity: SVector::from_element(0.0),
            conductances: vec![0.0; self.run.conduction.path_ends().len()],
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
        let (loads, mut all) = (&self.run.loads, Vec::new());
        for (node, course) in &loads.forces {
            all.push((Timed::Force(*node), course.function().is_some()));
        }
        for (anchor, course) in &loads.motions {
            all.push((Timed::Motion(*anchor), course.function().is_some()));
        }
        for (element, course) in &loads.temperatures {
            all.push((Timed::Thermostat(*element), course.function().is_some()));
        }
        let mut rockets = vec![0; self.run.masses.len()];
        for rocket in &loads.rockets {
            let node = rocket.line.node;
            all.push((Timed::Thrust(node, rockets[node.index]), true));
            rockets[node.index] += 1;
        }
        for (oven, _) in &loads.ovens {
            all.push((Timed::Oven(self.run.scene.reservoir(*oven)), true));
        }
        all
    }
}

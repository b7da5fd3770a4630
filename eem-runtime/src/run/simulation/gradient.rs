//! The gradient of a run: the adjoint of its steps, from the last to the first.

mod seeds;

use core::mem;
use std::collections::BTreeSet;

use super::Simulation;
use super::stepper::{Parts, Stepper};
use crate::element::conduction::Partner;
use crate::element::layout::Layout;
use crate::element::state::State;
use crate::run::gradient::error::GradientError;
use crate::run::gradient::history::{History, Kept, KeptStep};
use crate::run::gradient::objective::Objective;
use crate::run::gradient::result::{Gradient, OfElement, Series};
use crate::scene::error::SceneError;
use crate::step::adjoint::{Costate, Place, StepWeights};
use crate::step::control::norm;
use crate::step::scheme::Scheme;
use eem_material::number::scalar::Real;
use nalgebra::SVector;

/// # Gradients
impl<const D: usize, S: Real> Simulation<D, S> {
    /// Keeps the states of all further steps for [`gradient`](Self::gradient). It costs memory and changes no bit.
    pub fn keep_history(&mut self, history: History) {
        self.history = Some(Box::new(Kept::new(&self.state, history)));
    }

    /// Keeps the step that was just made.
    pub(super) fn keep_step(&mut self, size: S) {
        if let Some(history) = &mut self.history {
            history.keep(size, self.in_use, [&self.next, &self.state]);
        }
    }

    /// The derivatives of an objective by all inputs of the run since [`keep_history`](Self::keep_history): parameters of
    /// materials, masses, gravity, conductances, temperatures of reservoirs, and the state at the start.
    ///
    /// They are those of the steps that were made, with their sizes kept, to rounding times the growth of errors along the
    /// motion. All of them together cost a few runs, however many inputs there are.
    ///
    /// # Errors
    ///
    /// [`GradientError`]: for steps of other schemes than [`Scheme::EemTemperature`] or [`Scheme::EemEntropy`]; for moved
    /// anchors beside solids with consistent mass, rockets and ovens; without a history, or with one that does not end at the
    /// present state; for a quantity without derivatives or a time at which no step ends. Nothing has changed then.
    ///
    /// ```
    /// use eem::prelude::*;
    /// use eem::{History, Objective};
    ///
    /// #[derive(FreeEnergy)]
    /// #[free_energy(|lambda: Stretch| 0.5 * stiffness * (lambda - 1.0).powi(2))]
    /// struct Spring { stiffness: f64 }
    ///
    /// let mut scene = Scene::<1>::new();
    /// let mass = scene.mass(1.0, [1.1], [0.0]);
    /// let ends = [scene.anchor([0.0]), mass];
    /// let spring = scene.spring(Spring { stiffness: 4.0 }, ends);
    /// let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.001)?;
    /// run.keep_history(History::default());
    /// run.run_until(1.0)?;
    ///
    /// // q = 1 + 0.1 cos(ωt) with ω² = k/m = 4/s².
    /// let gradient = run.gradient(&Objective::at_end(Quantity::Position(mass)))?;
    /// let by_position = 2.0_f64.cos();
    /// assert!((gradient.by_position(mass)?[0] - by_position).abs() < 1e-6);
    /// let by_stiffness = -0.1 * 2.0_f64.sin() / 4.0;
    /// assert!((gradient.by_parameter(spring, "stiffness")? - by_stiffness).abs() < 1e-7);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn gradient(
        &mut self,
        objective: &Objective<D, S>,
    ) -> Result<Gradient<D, S>, GradientError> {
        let Some(mut kept) = self.history.take() else {
            return Err(GradientError::NoHistory);
        };
        kept.return_to(self.time());
        let found = self.gradient_of(&kept, objective);
        self.history = Some(kept);
        found
    }

    fn gradient_of(
        &mut self,
        kept: &Kept<S>,
        objective: &Objective<D, S>,
    ) -> Result<Gradient<D, S>, GradientError> {
        self.check_gradient(kept)?;
        let (value, seeds) = self.seeds(kept, objective)?;
        let layout = self.numbering();
        let mut found = self.no_gradient(value, &layout);
        let mut costate = mem::replace(&mut found.start, Costate::zero(0, &layout, 0));
        let mut held = vec![false; layout.thermal];
        for (element, _) in &self.loads.temperatures {
            if let Some(slot) = layout.elements[element.index()].thermal {
                held[slot] = true;
            }
        }
        let paths = self.conduction.path_ends();
        let ends = self.ends();
        let parts = Parts {
            scheme: self.in_use,
            masses: &self.masses,
            elements: &ends,
            layout: &layout,
            conduction: &self.conduction,
            loads: &self.loads,
        };
        let systems = parts.systems(self.automatic.memory_limit);
        let mut system = systems.map_err(SceneError::from)?.tangent;
        self.add_seeds(
            kept,
            (kept.steps.len(), &seeds),
            objective,
            (&layout, &mut costate, &mut found),
        )?;
        let at_end = self.effect(&costate, kept.state(kept.steps.len()));
        let mut largest = at_end;
        for (index, step) in kept.steps.iter().enumerate().rev() {
            let states = [kept.state(index), &step.state];
            let mut points = Vec::new();
            let Stepper::Newton(newton) = &self.stepper else {
                continue;
            };
            for group in &newton.groups {
                group.between(step.step, states, &mut |point| points.push(point))?;
            }
            let time = step.state.time.value.to_f64();
            let place = Place {
                layout: &layout,
                conduction: &self.conduction,
                masses: &self.masses,
                held: &held,
            };
            let solved = place.solve(step.step, &points, &costate, &mut system);
            let (old, mut weights) = solved.map_err(|_| GradientError::Singular { time })?;
            if old.numbers().any(|number| !number.is_finite()) {
                return Err(GradientError::NotFinite { time });
            }
            self.add_step((step, states[0]), (&paths, &costate), &weights, &mut found);
            Self::add_series((step, states[0]), (&layout, &weights), &mut found);
            let mut of_points = mem::take(&mut weights.points).into_iter();
            for group in &newton.groups {
                group.by_parameters(states, &mut of_points, &mut |element, values| {
                    add(
                        &mut found.elements[element.index()].values,
                        S::one(),
                        values,
                    );
                })?;
            }
            costate = old;
            largest = largest.max(self.effect(&costate, states[0]));
            self.add_seeds(
                kept,
                (index, &seeds),
                objective,
                (&layout, &mut costate, &mut found),
            )?;
        }
        found.start = costate;
        found.growth = if at_end > 0.0 { largest / at_end } else { 1.0 };
        for (_, series) in found.forces.iter_mut().chain(&mut found.motions) {
            series.reverse();
        }
        for (_, series) in &mut found.temperatures {
            series.reverse();
        }
        Ok(found)
    }

    /// An error unless all steps of the history have an adjoint.
    fn check_gradient(&self, kept: &Kept<S>) -> Result<(), GradientError> {
        let loads = &self.loads;
        for (is_there, what) in [
            (
                !loads.motions.is_empty() && self.masses.are_coupled(),
                "moved anchors beside solids with consistent mass",
            ),
            (!loads.rockets.is_empty(), "rockets"),
            (!loads.ovens.is_empty(), "ovens"),
            (S::LANES > 1, "several numbers in one"),
        ] {
            if is_there {
                return Err(GradientError::NotDifferentiable { what });
            }
        }
        let steps = kept.steps.iter();
        let schemes = steps.map(|step| (step.scheme, step.state.time.value));
        for (scheme, time) in schemes.clone().chain([(self.in_use, self.time())]) {
            if !matches!(scheme, Scheme::EemTemperature | Scheme::EemEntropy) {
                let (scheme, time) = (scheme.name(), time.to_f64());
                return Err(GradientError::NoAdjoint { scheme, time });
            }
        }
        let is_whole = kept.ends_in(&self.state);
        if !is_whole && kept.is_full() {
            return Err(GradientError::HistoryTooLarge {
                steps: kept.steps.len(),
                needed: kept.needed,
                allowed: kept.allowed,
            });
        }
        let mut others = schemes.filter(|&(scheme, _)| scheme != self.in_use);
        let other = others.next().map(|(_, time)| time);
        match other.or_else(|| (!is_whole).then(|| kept.time())) {
            Some(time) => Err(GradientError::HistoryBroken {
                time: time.to_f64(),
            }),
            None => Ok(()),
        }
    }

    /// What a relative change of a state does to the objective, `|λ_q||q| + |λ_v||v| + |λ_γ||q| + |λ_θ||θ|`.
    fn effect(&self, costate: &Costate<S>, state: &State<S>) -> f64 {
        let norm = |values: &[S]| norm(values.iter().copied()).to_f64();
        let velocities: Vec<S> = self.velocities_in(state);
        let length = norm(state.positions.values());
        norm(&costate.positions) * length
            + norm(&costate.velocities) * norm(&velocities)
            + norm(&costate.viscous) * length
            + norm(&costate.temperatures) * norm(&state.temperatures)
    }

    /// A gradient of zeros, with the names of all parameters.
    fn no_gradient(&self, value: f64, layout: &Layout) -> Gradient<D, S> {
        let coordinates = self.masses.len() * D;
        let mut elements = Vec::with_capacity(self.places.len());
        for (index, &[group, at]) in self.places.iter().enumerate() {
            let of_group = self.stepper.elements(group as usize);
            let element = of_group.handle(at as usize);
            let names = of_group.parameters();
            elements.push(OfElement {
                element,
                slots: layout.elements[index],
                dashpots: self.shapes[group as usize].dashpots,
                names,
                values: vec![S::zero(); names.len()],
            });
        }
        Gradient {
            scene: self.scene.clone(),
            value,
            growth: 1.0,
            start: Costate::zero(coordinates, layout, self.conduction.reservoirs.len()),
            masses: vec![S::zero(); self.masses.len()],
            gravity: SVector::from_element(S::zero()),
            conductances: vec![S::zero(); self.conduction.path_ends().len()],
            reservoirs: vec![S::zero(); self.conduction.reservoirs.len()],
            elements,
            forces: empty(self.loads.forces.iter().map(|(node, _)| node.index)),
            motions: empty(self.loads.motions.iter().map(|(node, _)| node.index)),
            temperatures: empty(self.loads.temperatures.iter().map(|(own, _)| own.index())),
        }
    }

    /// The derivatives by the values of functions of time in a step; from the last one on.
    fn add_series(
        (step, old): (&KeptStep<S>, &State<S>),
        (layout, weights): (&Layout, &StepWeights<S>),
        found: &mut Gradient<D, S>,
    ) {
        let (h, start, end) = (step.step, old.time.value, step.state.time.value);
        let vector =
            |values: &[S], node: usize| SVector::<S, D>::from_fn(|axis, _| values[node * D + axis]);
        for (node, series) in &mut found.forces {
            let middle = start + S::from_f64(0.5) * h;
            series.push((middle, vector(&weights.motion, *node) * h));
        }
        for (node, series) in &mut found.motions {
            let [by_old, by_new] = [0, 1].map(|side| vector(&weights.anchors[side], *node));
            if let Some((_, last)) = series.last_mut() {
                *last += by_new;
            }
            series.push((start, by_old));
        }
        for (element, series) in &mut found.temperatures {
            if let Some(slot) = layout.elements[*element].thermal {
                series.push((end, weights.held[slot]));
            }
        }
    }

    /// The derivatives of a step by masses, gravity, conductances and temperatures of reservoirs.
    fn add_step(
        &self,
        (step, old): (&KeptStep<S>, &State<S>),
        (paths, costate): (&[(usize, Partner)], &Costate<S>),
        weights: &StepWeights<S>,
        found: &mut Gradient<D, S>,
    ) {
        let h = step.step;
        let sums = self.masses.weights();
        for (node, mass) in self.masses.iter().enumerate() {
            let Some(mass) = mass else { continue };
            let [old, new] = [old, &step.state].map(|state| state.velocity::<D>(node, mass));
            for axis in 0..D {
                let weight = weights.motion[node * D + axis];
                let fall = h * self.loads.gravity[axis];
                found.masses[node] -= weight * (new[axis] - old[axis] - fall);
                found.gravity[axis] += h * sums[node] * weight;
            }
        }
        let theta = &weights.temperatures;
        let per_theta = |slot: usize| weights.entropies[slot] / theta[slot];
        for (slot, &own) in theta.iter().enumerate() {
            for link in self.conduction.links(slot) {
                if let Partner::Reservoir(at) = link.partner {
                    let outer = self.conduction.reservoirs[at];
                    let of_heat = costate.reservoirs[at] / outer;
                    found.reservoirs[at] +=
                        h * link.conductance * (per_theta(slot) - of_heat * own / outer);
                }
            }
        }
        for (sum, &(slot, partner)) in found.conductances.iter_mut().zip(paths) {
            *sum += match partner {
                Partner::Slot(other) => {
                    h * (theta[other] - theta[slot]) * (per_theta(slot) - per_theta(other))
                }
                Partner::Reservoir(at) => {
                    let outer = self.conduction.reservoirs[at];
                    let of_heat = costate.reservoirs[at] / outer;
                    h * (outer - theta[slot]) * (per_theta(slot) - of_heat)
                }
            };
        }
    }
}

/// Series for these indices, each once.
fn empty<T, S>(indices: impl Iterator<Item = usize>) -> Vec<(usize, Series<T, S>)> {
    let indices: BTreeSet<usize> = indices.collect();
    indices
        .into_iter()
        .map(|index| (index, Vec::new()))
        .collect()
}

/// `sum + factor values`.
fn add<S: Real>(sum: &mut [S], factor: S, values: &[S]) {
    for (sum, &value) in sum.iter_mut().zip(values) {
        *sum += factor * value;
    }
}

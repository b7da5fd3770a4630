//! The derivatives of a quantity by a state and, at that state, by the inputs.

use crate::element::conduction::Conduction;
use crate::element::group::ElementGeneric;
use crate::element::handle::Node;
use crate::element::layout::{Layout, Shape};
use crate::element::loads::point;
use crate::element::masses::MassPair;
use crate::element::state::State;
use crate::run::gradient::error::GradientError;
use crate::run::gradient::series::dot;
use crate::run::recorder::Quantity;
use crate::run::simulation::Simulation;
use crate::run::simulation::stepper::Stepper;
use crate::step::adjoint::RocketStep;
use nalgebra::SVector;

/// What a quantity depends on: coordinates, slots of a state and reservoirs, and inputs.
#[derive(Clone, Copy, Debug)]
pub(super) enum Of<'a> {
    Position(usize),
    Velocity(usize),
    Viscous(usize),
    Temperature(usize),
    /// The entropy of a reservoir.
    Entropy(usize),
    /// The mass of a node.
    Mass(usize),
    /// The mass of a pair of nodes, by its index in [`Passage::pairs`].
    Pair(usize),
    /// A component of gravity.
    Gravity(usize),
    /// The temperature of a reservoir.
    Reservoir(usize),
    /// The parameters of an element, with the derivative by each, still without the factor passed to [`See`].
    Parameters(usize, &'a [f64]),
}

/// A function that receives derivatives.
type See<'a> = dyn FnMut(Of<'_>, f64) + 'a;

/// The scene on a way through a history.
pub(super) struct Passage<const D: usize> {
    pub(super) layout: Layout,
    /// Sums of the rows of the mass matrix, kg.
    pub(super) sums: Vec<f64>,
    /// The nodes of the masses of pairs and of anchors, in order.
    pub(super) pairs: Vec<[usize; 2]>,
    /// The heat that elements without a temperature have lost until the end, J.
    lost_heat: f64,
    /// Whether a thermostat prescribes the temperature, by thermal slot.
    pub(super) held: Vec<bool>,
    /// The conduction, with the temperatures of ovens in the present step.
    pub(super) conduction: Conduction,
    /// The rockets in the present step.
    pub(super) rockets: Vec<RocketStep<D>>,
}

impl<const D: usize> Simulation<D> {
    pub(super) fn passage(&self) -> Passage<D> {
        let layout = self.run.numbering();
        let mut held = vec![false; layout.thermal];
        for (element, _) in &self.run.loads.temperatures {
            if let Some(slot) = self.run.slots(*element).thermal {
                held[slot] = true;
            }
        }
        let pairs = self.run.masses.pairs().iter().chain(self.run.masses.held());
        let mut pairs: Vec<_> = pairs.map(MassPair::nodes).collect();
        pairs.sort_unstable();
        Passage {
            layout,
            sums: self.run.masses.weights().into_owned(),
            pairs,
            lost_heat: self.run.state.dissipated.value,
            held,
            conduction: self.run.conduction.clone(),
            rockets: Vec::new(),
        }
    }

    /// Passes the derivatives of a component of a quantity in a state, times a weight, to a function.
    pub(super) fn see_derivatives(
        &mut self,
        (state, weight): (&State, f64),
        (quantity, component): (&Quantity<D>, usize),
        passage: &Passage<D>,
        see: &mut See<'_>,
    ) -> Result<(), GradientError> {
        let at = |node: &Node| node.index * D + component;
        match quantity {
            Quantity::Position(node) => see(Of::Position(at(node)), weight),
            Quantity::Velocity(node) if self.run.masses.get(node.index).is_some() => {
                see(Of::Velocity(at(node)), weight);
            }
            Quantity::Momentum(node) if !self.run.masses.are_coupled() => {
                if let Some(mass) = self.run.masses.get(node.index) {
                    see(Of::Velocity(at(node)), weight * mass);
                    let velocity = state.velocity::<D>(node.index, mass)[component];
                    see(Of::Mass(node.index), weight * velocity);
                }
            }
            Quantity::Stretch(element) => {
                let [group, place] = self.run.place(*element);
                let &[a, b] = self.run.stepper.elements(group).nodes(place) else {
                    return Err(no_derivative(quantity));
                };
                let [a, b] = [a, b].map(|node| node as usize);
                let arm = position::<D>(state, b) - position(state, a);
                let length = dot(&arm, &arm).sqrt();
                for axis in 0..D {
                    let entry = weight * arm[axis] / length;
                    see(Of::Position(b * D + axis), entry);
                    see(Of::Position(a * D + axis), -entry);
                }
            }
            Quantity::ViscousStretch(element, dashpot) => {
                see(
                    Of::Viscous(self.run.slots(*element).viscous + dashpot),
                    weight,
                );
            }
            Quantity::Temperature(element) => {
                if let Some(slot) = self.run.slots(*element).thermal {
                    see(Of::Temperature(slot), weight);
                }
            }
            Quantity::ReservoirEntropy(reservoir) => see(Of::Entropy(reservoir.index), weight),
            Quantity::ReservoirHeat(reservoir) => {
                self.see_heat((state, weight), reservoir.index, see);
            }
            Quantity::KineticEnergy => self.see_kinetic((state, weight), passage, see),
            Quantity::TotalEnergy => {
                if passage.lost_heat != 0.0 {
                    let heat = passage.lost_heat;
                    return Err(GradientError::LostHeat { heat });
                }
                self.see_kinetic((state, weight), passage, see);
                self.see_potential((state, weight), passage, see);
                self.see_internal((state, weight), see);
                for index in 0..self.run.conduction.reservoirs.len() {
                    self.see_heat((state, weight), index, see);
                }
            }
            other => return Err(no_derivative(other)),
        }
        Ok(())
    }

    /// The heat of a reservoir, `θ_r σ_r`; none for an oven: what it gives is booked as heat after each step.
    fn see_heat(&self, (state, weight): (&State, f64), index: usize, see: &mut See<'_>) {
        if self.run.is_oven(index) {
            return;
        }
        let entropy = state.reservoir_entropies.values()[index];
        see(
            Of::Entropy(index),
            weight * self.run.conduction.reservoirs[index],
        );
        see(Of::Reservoir(index), weight * entropy);
    }

    /// `½ vᵀ M v`.
    fn see_kinetic(&self, (state, weight): (&State, f64), passage: &Passage<D>, see: &mut See<'_>) {
        let momenta = state.momenta.values();
        for (node, mass) in self.run.masses.iter().enumerate() {
            let Some(mass) = mass else { continue };
            let velocity = state.velocity::<D>(node, mass);
            for (speed, at) in velocity.into_iter().zip(node * D..) {
                see(Of::Velocity(at), weight * momenta[at]);
                see(Of::Mass(node), weight * 0.5 * speed * speed);
            }
        }
        if !self.run.masses.are_coupled() {
            return;
        }
        for (node, _) in &self.run.loads.motions {
            for at in (0..D).map(|axis| node.index * D + axis) {
                see(Of::Velocity(at), weight * momenta[at]);
            }
        }
        let velocity = |node: usize| SVector::from(state.velocity::<D>(node, 1.0));
        for (place, &[i, j]) in passage.pairs.iter().enumerate() {
            let share = if i == j { 0.5 } else { 1.0 };
            let by = share * dot(&velocity(i), &velocity(j));
            see(Of::Pair(place), weight * by);
        }
    }

    /// `−Σ m g·q`, with the sums of the rows of the mass matrix.
    fn see_potential(
        &self,
        (state, weight): (&State, f64),
        passage: &Passage<D>,
        see: &mut See<'_>,
    ) {
        let gravity = SVector::<f64, D>::from_fn(|axis, _| self.run.loads.gravity[axis]);
        for (node, &sum) in passage.sums.iter().enumerate() {
            let position = position(state, node);
            for axis in 0..D {
                see(
                    Of::Position(node * D + axis),
                    -(weight * sum * gravity[axis]),
                );
                see(Of::Gravity(axis), -(position[axis] * (weight * sum)));
            }
            if self.run.masses.get(node).is_some() {
                see(Of::Mass(node), -(weight * dot(&gravity, &position)));
            }
        }
        for (at, &[i, j]) in passage.pairs.iter().enumerate() {
            let mut own = position(state, i);
            if i != j {
                own += position(state, j);
            }
            see(Of::Pair(at), -(weight * dot(&gravity, &own)));
        }
    }

    /// `Σ e` of all elements.
    fn see_internal(&mut self, (state, weight): (&State, f64), see: &mut See<'_>) {
        // The elements are evaluated elsewhere than at the ends of their last step.
        self.run.has_stepped = false;
        let Stepper::Newton(newton) = self.run.stepper.of_mut::<D>() else {
            return;
        };
        for group in &mut newton.groups {
            let mut see_element = |element| see_energy(&element, weight, see);
            (group.elements_mut()).generic_in(state, &mut see_element);
            group
                .elements()
                .energy_by_parameters(state, &mut |element, values| {
                    see(Of::Parameters(element.index(), values), weight);
                });
        }
    }
}

/// The derivatives of an internal energy as a function of positions, γ and θ: `∂e = f ∂π − g ∂γ + θ ∂s`.
fn see_energy(element: &ElementGeneric, weight: f64, see: &mut See<'_>) {
    for &(at, force) in &element.forces {
        see(Of::Position(at), weight * force);
    }
    for &(slot, force, _) in &element.dashpots {
        see(Of::Viscous(slot), -(weight * force));
    }
    let (Some((_, theta)), Some(entropy)) = (element.temperature, &element.entropy) else {
        return;
    };
    let weight = weight * theta;
    for &(at, slope) in &entropy.by_position {
        see(Of::Position(at), weight * slope);
    }
    for &(slot, slope) in &entropy.by_viscous {
        see(Of::Viscous(slot), weight * slope);
    }
    see(
        Of::Temperature(entropy.slot),
        weight * entropy.by_temperature,
    );
}

#[cold]
fn no_derivative<const D: usize>(quantity: &Quantity<D>) -> GradientError {
    let quantity = quantity.kind();
    GradientError::NoDerivative { quantity }
}

/// The position of a node in a state.
fn position<const D: usize>(state: &State, node: usize) -> SVector<f64, D> {
    point(state.positions.values(), node).into()
}

/// The unit of the viscous stretches of elements with these capabilities.
pub(super) const fn viscous_unit(shape: &Shape) -> &'static str {
    if shape.viscous_unit.is_empty() {
        "1"
    } else {
        shape.viscous_unit
    }
}

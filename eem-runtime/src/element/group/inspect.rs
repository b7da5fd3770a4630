//! Values of the elements in a state, computed from the definitions and not taken from the last step.

use super::arms::measures_in;
use super::interface::Elements;
use super::placed::PlacedPoint;
use super::point::Point;
use super::stiffness::{Stiffness, stiffness_of};
use crate::element::conjugates::{Infeasible, Placement};
use crate::element::error::StateError;
use crate::element::group::audit::Misfit;
use crate::element::group::element_group::ElementGroup;
use crate::element::group::view::{ElementGeneric, ElementTotals, ElementView};
use crate::element::handle::Element;
use crate::element::kinematics::{Arms, Kinematics, MeasureSet, SolidState};
use crate::element::layout::Slots;
use crate::element::state::{Energy, State};
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;
use eem_material::number::digest::Digest;
use eem_material::tabled::Tabled;

impl<A: Arrays, K: Kinematics<D>, const D: usize> Elements<D> for ElementGroup<A, K, D> {
    fn initialize(&mut self, state: &mut State, refuse: &mut dyn FnMut(StateError)) {
        for member in &mut self.members {
            let r = member.arms_in(state);
            for point in member.points.as_mut() {
                if let Err(error) = point.initialize(&r, state) {
                    refuse(error);
                }
            }
        }
    }

    fn find_energies(&self, state: &mut State) {
        for member in &self.members {
            let r = member.arms_in(state);
            for point in member.points.as_ref() {
                state.energies[point.element.index()] = point.energy_in(&r, state);
            }
        }
    }

    fn energy_terms(&self, state: &State) -> f64 {
        let mut sum = 0.0;
        for member in &self.members {
            let r = member.arms_in(state);
            for point in member.points.as_ref() {
                sum += point.energy_in(&r, state).terms;
            }
        }
        sum
    }

    fn add_totals(&self, state: &State, totals: &mut ElementTotals) {
        for member in &self.members {
            let r = member.arms_in(state);
            for point in member.points.as_ref() {
                let x = point.variables_in(&r, state);
                totals.energy.add(point.internal_energy(&x, state));
                if let Some(slot) = point.slots().thermal {
                    totals.entropy.add_sum(state.entropies.sum(slot));
                    let caloric = point.model.caloric(&x);
                    totals.entropy_of_state.add(caloric.entropy);
                }
            }
        }
    }

    fn inspect(&self, place: usize, state: &State) -> ElementView {
        let (member, point) = self.at(place);
        let point = &member.points.as_ref()[point];
        let x = point.variables_in(&member.arms_in(state), state);
        ElementView {
            measure: x[0],
            force: point.model.gradient(&x)[0],
            internal_energy: point.internal_energy(&x, state),
        }
    }

    fn solid_state(&self, place: usize, state: &State) -> Option<SolidState> {
        let (member, point) = self.at(place);
        let point = &member.points.as_ref()[point];
        let r = member.arms_in(state);
        let gradient = point.model.gradient(&point.variables_in(&r, state));
        let force = measures_in::<K::Measures>(&gradient);
        point.kinematics.solid_state(&r, &force)
    }

    fn dissipation(
        &self,
        place: usize,
        state: &State,
        velocity: &dyn Fn(usize) -> [f64; D],
    ) -> f64 {
        let (member, point) = self.at(place);
        let point = &member.points.as_ref()[point];
        let r = member.arms_in(state);
        let x = point.variables_in(&r, state);
        let mut power = point.power_in_series(&x);
        if const { !Point::<A, K::Measures>::MAY_HAVE_DRAG } {
            return power;
        }
        let (drags, _) = point.model.drag(x[A::Variables::LEN - 1]);
        let nodes = member.site.nodes.as_ref();
        let first = velocity(nodes[0] as usize);
        for (a, &drag) in drags.as_ref().iter().enumerate() {
            let slopes = K::gradient(&point.kinematics, &r, &measures_in::<K::Measures>(&x));
            let mut rate = 0.0;
            for (&node, slope) in nodes[1..].iter().zip(slopes[a].as_ref()) {
                for (axis, speed) in velocity(node as usize).into_iter().enumerate() {
                    rate += slope[axis] * (speed - first[axis]);
                }
            }
            power += drag * rate * rate;
        }
        power
    }

    fn stiffness(&self, state: &State, see: &mut dyn FnMut(Stiffness<'_>)) {
        for member in &self.members {
            let (nodes, r) = (member.site.nodes.as_ref(), member.arms_in(state));
            for point in member.points.as_ref() {
                let x = point.variables_in(&r, state);
                let measures = measures_in::<K::Measures>(&x);
                let kinematics = &point.kinematics;
                let length = kinematics.length(&measures);
                let slopes = kinematics.slopes(&r, &measures);
                let sizes = kinematics.sizes(&r, &measures);
                let of = (&point.model, nodes, point.slots());
                let sizes = (length, &slopes, &sizes);
                see(stiffness_of::<A, K::Measures>(of, &x, sizes));
            }
        }
    }

    fn handle(&self, place: usize) -> Element {
        let (member, point) = self.at(place);
        member.points.as_ref()[point].element
    }

    fn nodes(&self, place: usize) -> &[u32] {
        let (member, _) = self.at(place);
        member.site.nodes.as_ref()
    }

    fn slots(&self, place: usize) -> Slots {
        let (member, point) = self.at(place);
        member.points.as_ref()[point].slots()
    }

    fn generic_in(&mut self, state: &State, see: &mut dyn FnMut(ElementGeneric)) {
        for member in &mut self.members {
            let r = member.arms_in(state);
            for point in member.points.as_mut() {
                point.take_derivatives(&r, state);
                let at = (Placement::End, [&r, &r]);
                see(ElementGeneric {
                    entropy: point.entropy_slopes(&member.site.nodes, at),
                    ..point.generic(&member.site.nodes, at)
                });
            }
        }
    }

    #[cfg(feature = "gradients")]
    fn parameters(&self) -> &'static [&'static str] {
        // Elements of a group are of one kind.
        let first = self.points().next();
        first.map_or(&[], |point| point.model.parameter_names())
    }

    #[cfg(feature = "gradients")]
    fn parameter_units(&self) -> &'static [&'static str] {
        let first = self.points().next();
        first.map_or(&[], |point| point.model.facts().parameter_units)
    }

    #[cfg(feature = "gradients")]
    fn has_parameter_derivatives(&self) -> bool {
        let first = self.points().next();
        first.is_some_and(|point| point.model.facts().has_parameter_derivatives)
    }

    #[cfg(feature = "gradients")]
    fn parameter(&self, place: usize, index: usize) -> f64 {
        let (member, point) = self.at(place);
        member.points.as_ref()[point].model.parameter(index)
    }

    fn digest(&self, digest: &mut Digest) {
        // Elements of a group are of one kind.
        if let Some(first) = self.points().next() {
            digest_kind(&first.model, digest);
        }
        for point in self.points() {
            point.point.digest(digest);
            point
                .kinematics
                .numbers(&mut |number| digest.number(number));
        }
    }

    fn audit(&self, state: &State) -> Result<(), Misfit> {
        for member in &self.members {
            let r = member.arms_in(state);
            for point in member.points.as_ref() {
                let x = point.locate(&r, state)?;
                point.audit_response(&x)?;
                point.audit_entropy(&x, state)?;
            }
        }
        Ok(())
    }
}

impl<A: Arrays, K: Kinematics<D>, const D: usize> PlacedPoint<A, K, D> {
    /// Finds entropy and energy in an initial state with these arms.
    fn initialize(&mut self, r: &Arms<K, D>, state: &mut State) -> Result<(), StateError> {
        let x = self.locate(r, state)?;
        let mut energy = self.point.initialize(&x, state)?;
        self.add_bounds(r, &x, &mut energy);
        state.energies[self.element.index()] = energy;
        Ok(())
    }

    /// The energy in a state with these arms whose temperature and entropy are known.
    fn energy_in(&self, r: &Arms<K, D>, state: &State) -> Energy {
        let x = self.variables_in(r, state);
        let mut energy = self.point.energy_in(&x, state);
        self.add_bounds(r, &x, &mut energy);
        energy
    }
}

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// Finds the entropy of an initial state, whose variables are given; returns its energy.
    fn initialize(&mut self, x: &A::Variables, state: &mut State) -> Result<Energy, StateError> {
        let slot = self.slots().thermal;
        let theta = slot.map_or(0.0, |slot| state.temperatures[slot]);
        self.find_viscosities(theta)?;
        self.find_drag_viscosity(theta)?;
        let caloric = self.model.caloric(x);
        let energy = self.energy_at(x, caloric)?;
        check_gradient::<A>(self.element, &self.model.gradient(x))?;
        if let Some(slot) = slot {
            Infeasible::unless_stable(caloric.heat_capacity, theta)
                .map_err(|infeasible| infeasible.of(self.element))?;
            state.entropies.set(slot, caloric.entropy);
        }
        Ok(energy)
    }

    /// The power that its dashpots in series turn into heat, W.
    fn power_in_series(&self, x: &A::Variables) -> f64 {
        let gradient = self.model.gradient(x);
        let (viscosities, _) = self.model.viscosity(x[A::Variables::LEN - 1]);
        (0..self.dashpots()).fold(0.0, |power, dashpot| {
            let g = gradient[A::MEASURES + dashpot];
            power + g * g / viscosities[dashpot]
        })
    }

    /// Adds its parameters.
    fn digest(&self, digest: &mut Digest) {
        digest.count(self.element.index());
        for index in 0..self.model.facts().parameter_count {
            digest.number(self.model.parameter(index));
        }
    }

    /// The energy in a state whose temperature and entropy are known.
    fn energy_in(&self, x: &A::Variables, state: &State) -> Energy {
        let psi = self.model.free_energy(x);
        let Some(slot) = self.slots().thermal else {
            return Energy::without_temperature(psi);
        };
        let theta = state.temperatures[slot];
        let entropy = state.entropies.values()[slot];
        Energy::new(psi, [theta, entropy], &self.model.caloric(x))
    }

    /// `ψ + θ s` with the stored entropy, J.
    fn internal_energy(&self, x: &A::Variables, state: &State) -> f64 {
        let psi = self.model.free_energy(x);
        match self.slots().thermal {
            Some(slot) => psi + state.temperatures[slot] * state.entropies.values()[slot],
            None => psi,
        }
    }
}

/// Adds the kind of a model, or the names of its parameters.
fn digest_kind<A: Arrays>(model: &Tabled<A>, digest: &mut Digest) {
    let kind = model.facts().kind;
    if kind != 0 {
        return digest.bytes(&kind.to_le_bytes());
    }
    for name in model.parameter_names() {
        digest.bytes(name.as_bytes());
        digest.bytes(&[0]);
    }
}

/// An error unless forces and entropy of an initial state are finite; those of later states are checked with a response.
fn check_gradient<A: Arrays>(element: Element, gradient: &A::Variables) -> Result<(), StateError> {
    match gradient
        .as_ref()
        .iter()
        .position(|slope| !slope.is_finite())
    {
        None => Ok(()),
        Some(index) => Err(StateError::NotFinite {
            element,
            quantity: if index < A::MEASURES {
                "force"
            } else if index < A::MEASURES + A::DASHPOTS {
                "dashpot force"
            } else {
                "entropy"
            },
            value: gradient.as_ref()[index],
        }),
    }
}

//! Elements in a state: their measures from the nodes, and values of their points.

use core::any::Any;

use super::interface::Elements;
use super::member::{Block, LooseElement, Member};
use super::placed::{PlacedPoint, admissible};
#[cfg(feature = "gradients")]
use super::point_step::SeeParameters;
use super::points::{HasPoints, Measured, PointsInState};
use super::stiffness::Stiffness;
use crate::element::conjugates::{OneSet, Placement};
use crate::element::error::StateError;
use crate::element::group::audit::Misfit;
use crate::element::group::view::{ElementGeneric, ElementTotals, ElementView, Placed};
use crate::element::handle::Element;
use crate::element::kinematics::{Arms, Kinematics, Measures, SolidState};
use crate::element::layout::Slots;
use crate::element::state::{Energy, State};
use eem_material::free_energy::Array;
use eem_material::number::digest::Digest;

/// The elements of a group, in blocks.
pub(crate) struct Blocks<K: Kinematics<D>, P: ?Sized, const D: usize> {
    pub(super) blocks: Vec<Block<K, P, D>>,
    /// How many points each has, except the last.
    pub(super) points_per_block: usize,
}

/// Receives the points of a block, the index of a point there, its element and its geometry.
type See<'a, K, const D: usize> = dyn FnMut(
        &dyn PointsInState<<K as Kinematics<D>>::Measures>,
        usize,
        &Member<K, D>,
        &PlacedPoint<K, D>,
    ) + 'a;

/// The same with the arms of the element.
type SeeIn<'a, K, const D: usize> = dyn FnMut(
        &dyn PointsInState<<K as Kinematics<D>>::Measures>,
        usize,
        &PlacedPoint<K, D>,
        (&Member<K, D>, &Arms<K, D>),
    ) + 'a;

impl<K: Kinematics<D>, P: ?Sized + HasPoints<K::Measures>, const D: usize> Blocks<K, P, D> {
    /// Where the point with this index in the group is: the points of its block and its index there, its element, and its geometry.
    pub(super) fn at(
        &self,
        place: usize,
    ) -> (
        &dyn PointsInState<K::Measures>,
        usize,
        &Member<K, D>,
        &PlacedPoint<K, D>,
    ) {
        let index = place % self.points_per_block;
        let block = &self.blocks[place / self.points_per_block];
        let member = &block.members[index / Member::<K, D>::POINTS];
        let point = &member.points.as_ref()[index % Member::<K, D>::POINTS];
        (block.points.in_state(), index, member, point)
    }

    fn each(&self, see: &mut See<'_, K, D>) {
        for block in &self.blocks {
            each_of(&block.members, block.points.in_state(), see);
        }
    }

    /// Passes the arms in a state, too.
    fn each_in(&self, state: &State, see: &mut SeeIn<'_, K, D>) {
        self.each(&mut |points, index, member, point| {
            see(points, index, point, (member, &member.arms_in(state)));
        });
    }
}

fn each_of<K: Kinematics<D>, const D: usize>(
    members: &[Member<K, D>],
    points: &dyn PointsInState<K::Measures>,
    see: &mut See<'_, K, D>,
) {
    let mut index = 0;
    for member in members {
        for point in member.points.as_ref() {
            see(points, index, member, point);
            index += 1;
        }
    }
}

impl<K: Kinematics<D>, P: ?Sized + HasPoints<K::Measures>, const D: usize> Elements
    for Blocks<K, P, D>
{
    fn initialize(&mut self, state: &mut State, refuse: &mut dyn FnMut(StateError)) {
        for block in &mut self.blocks {
            initialize(&block.members, block.points.in_state_mut(), state, refuse);
        }
    }

    fn find_energies(&self, state: &mut State) {
        self.each(&mut |points, index, member, point| {
            let r = member.arms_in(state);
            let (element, _) = points.place(index);
            state.energies[element.index()] = energy(points, index, point, (&r, state));
        });
    }

    fn energy_terms(&self, state: &State) -> f64 {
        let mut sum = 0.0;
        self.each_in(state, &mut |points, index, point, (_, r)| {
            sum += energy(points, index, point, (r, state)).terms;
        });
        sum
    }

    fn add_totals(&self, state: &State, totals: &mut ElementTotals) {
        self.each_in(state, &mut |points, index, point, (_, r)| {
            points.add_totals(index, &point.kinematics.measure(r), state, totals);
        });
    }

    fn inspect(&self, place: usize, state: &State) -> ElementView {
        let (points, index, member, point) = self.at(place);
        let measures = point.kinematics.measure(&member.arms_in(state));
        points.view(index, &measures, state)
    }

    fn solid_state(&self, place: usize, state: &State) -> Option<SolidState> {
        let (points, index, member, point) = self.at(place);
        let r = member.arms_in(state);
        let force = points.forces(index, &point.kinematics.measure(&r), state);
        point.kinematics.solid_state(&r, &force)
    }

    fn dissipation(
        &self,
        place: usize,
        state: &State,
        velocity: &dyn Fn(usize, &mut [f64]),
    ) -> f64 {
        let (points, index, member, point) = self.at(place);
        let r = member.arms_in(state);
        let measures = point.kinematics.measure(&r);
        let slopes = point.kinematics.gradient(&r, &measures);
        let mut velocities = K::PerNode::filled([0.0; D]);
        let nodes = member.site.nodes.as_ref().iter();
        for (velocities, &node) in velocities.as_mut().iter_mut().zip(nodes) {
            velocity(node as usize, velocities);
        }
        let [first, others @ ..] = velocities.as_ref() else {
            unreachable!("an element has nodes")
        };
        let mut rates = Measures::<K, D>::filled(0.0);
        for (rate, slopes) in rates.as_mut().iter_mut().zip(slopes.as_ref()) {
            for (velocity, slope) in others.iter().zip(slopes.as_ref()) {
                for axis in 0..D {
                    *rate += slope[axis] * (velocity[axis] - first[axis]);
                }
            }
        }
        points.dissipation(index, [&measures, &rates], state)
    }

    fn stiffness(&self, state: &State, see: &mut dyn FnMut(Stiffness<'_>)) {
        self.each_in(state, &mut |points, index, point, (member, r)| {
            let kinematics = &point.kinematics;
            let measures = kinematics.measure(r);
            let at = Measured {
                measures: &measures,
                sizes: &kinematics.sizes(r, &measures),
                state,
            };
            let slopes = kinematics.slopes(r, &measures);
            let nodes = member.site.nodes.as_ref();
            let length = kinematics.length(&measures);
            see(points.stiffness(index, &at, (nodes, length, &slopes)));
        });
    }

    fn handle(&self, place: usize) -> Element {
        let (points, index, ..) = self.at(place);
        points.place(index).0
    }

    fn nodes(&self, place: usize) -> &[u32] {
        let (_, _, member, _) = self.at(place);
        member.site.nodes.as_ref()
    }

    fn slots(&self, place: usize) -> Slots {
        let (points, index, ..) = self.at(place);
        points.place(index).1
    }

    fn generic_in(&mut self, state: &State, see: &mut dyn FnMut(ElementGeneric)) {
        for block in &mut self.blocks {
            generic_in(&block.members, block.points.in_state_mut(), state, see);
        }
    }

    #[cfg(feature = "gradients")]
    fn parameters(&self) -> &'static [&'static str] {
        self.blocks
            .first()
            .map_or(&[], |first| first.points.in_state().parameters().0)
    }

    #[cfg(feature = "gradients")]
    fn parameter_units(&self) -> &'static [&'static str] {
        self.blocks
            .first()
            .map_or(&[], |first| first.points.in_state().parameters().1)
    }

    #[cfg(feature = "gradients")]
    fn has_parameter_derivatives(&self) -> bool {
        let first = self.blocks.first();
        first.is_some_and(|first| first.points.in_state().parameters().2)
    }

    #[cfg(feature = "gradients")]
    fn parameter(&self, place: usize, parameter: usize) -> f64 {
        let (points, index, ..) = self.at(place);
        points.parameter(index, parameter)
    }

    #[cfg(feature = "gradients")]
    fn energy_by_parameters(&self, state: &State, see: &mut SeeParameters<'_>) {
        self.each_in(state, &mut |points, index, point, (_, r)| {
            let measures = point.kinematics.measure(r);
            points.energy_by_parameters(index, &measures, state, see);
        });
    }

    fn digest(&self, digest: &mut Digest) {
        let mut is_first = true;
        self.each(&mut |points, index, _, point| {
            points.digest(index, is_first, digest);
            point
                .kinematics
                .numbers(&mut |number| digest.number(number));
            is_first = false;
        });
    }

    fn audit(&self, state: &State) -> Result<(), Misfit> {
        let mut found = Ok(());
        self.each_in(state, &mut |points, index, point, (_, r)| {
            if found.is_ok() {
                let (element, _) = points.place(index);
                let measures = admissible(&point.kinematics, element, r).map_err(Misfit::from);
                found = measures.and_then(|measures| points.audit(index, &measures, state));
            }
        });
        found
    }
}

/// Finds entropies and energies of an initial state; see [`Elements::initialize`].
fn initialize<K: Kinematics<D>, const D: usize>(
    members: &[Member<K, D>],
    points: &mut dyn PointsInState<K::Measures>,
    state: &mut State,
    refuse: &mut dyn FnMut(StateError),
) {
    let mut index = 0;
    for member in members {
        let r = member.arms_in(state);
        for point in member.points.as_ref() {
            let (element, _) = points.place(index);
            let outcome = admissible(&point.kinematics, element, &r).and_then(|measures| {
                let sizes = point.kinematics.sizes(&r, &measures);
                points.initialize(index, [&measures, &sizes], state)
            });
            if let Err(error) = outcome {
                refuse(error);
            }
            index += 1;
        }
    }
}

/// See [`Elements::generic_in`].
fn generic_in<K: Kinematics<D>, const D: usize>(
    members: &[Member<K, D>],
    points: &mut dyn PointsInState<K::Measures>,
    state: &State,
    see: &mut dyn FnMut(ElementGeneric),
) {
    let mut index = 0;
    for member in members {
        let (r, nodes) = (member.arms_in(state), &member.site.nodes);
        for point in member.points.as_ref() {
            points.take_derivatives(index, &point.kinematics.measure(&r), state);
            let (_, slots) = points.place(index);
            let slopes = (points.entropy_slopes(index), slots);
            let of_point = (points.generic(index), slots);
            see(ElementGeneric {
                entropy: point.entropy_slopes(nodes, &r, slopes),
                ..point.generic(nodes, (Placement::End, [&r, &r]), of_point)
            });
            index += 1;
        }
    }
}

/// The energy of a point in a state with these arms, whose temperature and entropy are known.
fn energy<K: Kinematics<D>, const D: usize>(
    points: &dyn PointsInState<K::Measures>,
    index: usize,
    point: &PlacedPoint<K, D>,
    (r, state): (&Arms<K, D>, &State),
) -> Energy {
    let measures = point.kinematics.measure(r);
    let sizes = point.kinematics.sizes(r, &measures);
    points.energy(
        index,
        &Measured {
            measures: &measures,
            sizes: &sizes,
            state,
        },
    )
}

impl<K: Kinematics<D>, P: ?Sized + HasPoints<K::Measures>, const D: usize> Blocks<K, P, D> {
    /// The elements without a scheme; `take_back` receives their models.
    pub(super) fn into_loose(
        self,
        take_back: &mut dyn FnMut(Box<dyn Any>),
    ) -> Vec<LooseElement<K, D>> {
        let mut elements = Vec::new();
        for block in self.blocks {
            for (first, member) in block.elements() {
                let (element, _) = block.points.in_state().place(first);
                elements.push((element, member.kinematics()));
            }
            take_back(block.points.into_models());
        }
        elements
    }

    /// Those of elements that a scheme steps, with the sets of their points.
    pub(super) fn new(
        scheme: OneSet,
        elements: &[LooseElement<K, D>],
        sets: Vec<Box<P>>,
        (per_block, placed): (usize, Placed<'_>),
    ) -> Self {
        let mut blocks = Vec::with_capacity(sets.len());
        for (elements, points) in elements.chunks(per_block).zip(sets) {
            let mut members = Vec::with_capacity(elements.len());
            for element in elements {
                members.push(Member::new(scheme, element, placed));
            }
            blocks.push(Block { members, points });
        }
        Self {
            blocks,
            points_per_block: per_block * Member::<K, D>::POINTS,
        }
    }
}

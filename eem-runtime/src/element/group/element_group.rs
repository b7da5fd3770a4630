//! The elements of one model, with one set of forces in a step.

use super::elements::Blocks;
use super::interface::{Elements, Group, Loose};
use super::loose::{LooseElements, MakeExplicit};
use super::member::{Member, places};
use super::placed::OfGroup;
#[cfg(feature = "gradients")]
use super::point_step::{Direction, PastStep, PerVariable, SeeParameters, StepBack, StepWeights};
use super::points::{Changes, Exchange, Models, PointEnd, PointSet};
use super::share::{Contacts, Share};
use super::site::{ContactSite, Site};
use super::view::{Along, Old, Placed, Sites, StepView, Trial};
use crate::algebra::system::LinearSystem;
#[cfg(feature = "gradients")]
use crate::element::conduction::InterfaceTemperatures;
use crate::element::conjugates::{Any, Exact, Family, OneSet};
use crate::element::error::StateError;
use crate::element::group::view::ElementGeneric;
use crate::element::impulse::Impulses;
use crate::element::kinematics::{Kinematics, Measures, QuadraticStrain};
use crate::element::state::State;
use crate::element::tally::{Reevaluation, Tally};
use eem_material::free_energy::{Array, MOST_TOGETHER};
use eem_material::number::compact::compact;
use eem_material::number::scalar::Scalar;

/// Elements of one model with the kinematics `K`.
pub(crate) struct ElementGroup<K: QuadraticStrain<D>, const D: usize> {
    pub(super) of: OfGroup,
    pub(super) elements: Blocks<K, dyn PointSet<K::Measures>, D>,
    pub(super) contacts: Contacts<K, D>,
    /// The list of models, empty while they are in the blocks.
    models: Box<dyn Models<K::Strain>>,
    make_explicit: MakeExplicit<D>,
    /// See [`Old::by_factors`].
    by_factors: bool,
    /// Workspace for a block.
    pub(super) room: Room<K, D>,
    /// Workspace for elements with many points, a round of elements at a time.
    pub(super) shares: Vec<Share<K, D>>,
}

/// Workspace for the points of a block.
pub(super) struct Room<K: Kinematics<D>, const D: usize> {
    pub(super) exchange: Vec<Exchange<K::Measures>>,
    pub(super) measures: Vec<Measures<K, D>>,
    pub(super) changes: Vec<Changes<K::Measures>>,
    pub(super) ends: Vec<PointEnd<K::Measures>>,
}

/// How many elements are in a block: of springs as many as are evaluated in one call, of others one.
fn elements_per_block<K: Kinematics<D>, const D: usize>() -> usize {
    if Member::<K, D>::POINTS == 1 {
        MOST_TOGETHER
    } else {
        1
    }
}

impl<K: QuadraticStrain<D>, const D: usize> ElementGroup<K, D> {
    pub(crate) fn new(scheme: OneSet, mut loose: LooseElements<K, D>, placed: Placed<'_>) -> Self {
        let shape = loose.models.shape();
        let of = OfGroup {
            scheme,
            has_drag: shape.drag,
            is_thermal: shape.thermal,
            has_unknowns: shape.thermal || shape.dashpots > 0,
        };
        let per_block = elements_per_block::<K, D>();
        let per_set = per_block * Member::<K, D>::POINTS;
        let all = places::<K, D>(&loose.elements, placed);
        let sets = loose.models.points(scheme, &all, per_set);
        let mut members = Vec::with_capacity(loose.elements.len());
        for element in &loose.elements {
            members.push(Member::new(scheme, element, placed));
        }
        let room = per_set.min(all.len());
        let none = Measures::<K, D>::filled(0.0);
        let end = PointEnd {
            measures: none,
            sizes: [none; 2],
            slopes: none,
            way: 0.0,
        };
        let changes = Changes {
            measures: none,
            heat: 0.0,
        };
        Self {
            of,
            elements: Blocks::new(members, sets, per_block),
            contacts: Contacts::none(),
            models: loose.models,
            make_explicit: loose.make_explicit,
            by_factors: false,
            room: Room {
                exchange: vec![Exchange::none(); room],
                measures: vec![none; room],
                changes: vec![changes; room],
                ends: vec![end; room],
            },
            shares: Vec::new(),
        }
    }

    /// The elements without the scheme.
    fn into_loose_elements(self) -> LooseElements<K, D> {
        let mut models = self.models;
        let mut take_back = |own| models.take_back(own);
        let elements = self.elements.into_loose(&mut take_back);
        LooseElements {
            elements,
            models,
            make_explicit: self.make_explicit,
        }
    }
}

/// The functions of a step, for a family of schemes.
impl<K: QuadraticStrain<D>, const D: usize> ElementGroup<K, D> {
    fn evaluate_as<C: Family>(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        system: Option<&mut LinearSystem<1>>,
    ) -> Result<(), StateError> {
        match system {
            Some(system) => self.linearize::<C>((view, trial), system),
            None => self.respond::<C>((view, trial)),
        }
    }

    fn begin_as<C: Family>(
        &mut self,
        view: &StepView<'_>,
        old: &mut Old<'_, D>,
    ) -> Result<(), StateError> {
        self.by_factors = old.by_factors;
        for block in &mut self.elements.blocks {
            let how = (view, self.by_factors);
            block.begin::<C>(&self.of, how, old, &mut self.room.measures)?;
        }
        Ok(())
    }
}

impl<K: QuadraticStrain<D>, const D: usize> Group<D> for ElementGroup<K, D> {
    fn elements(&self) -> &dyn Elements<D> {
        &self.elements
    }

    fn elements_mut(&mut self) -> &mut dyn Elements<D> {
        &mut self.elements
    }

    fn into_loose(self: Box<Self>) -> Box<dyn Loose<D>> {
        Box::new(self.into_loose_elements())
    }

    fn connect(&mut self, sites: &Sites<'_, D>) {
        self.contacts = Contacts::none();
        for block in &mut self.elements.blocks {
            let mut index = 0;
            for member in &mut block.members {
                let nodes = member.site.nodes;
                member.site = Site::new(nodes, sites);
                for point in member.points.as_mut() {
                    let (_, slots) = block.points.place(index);
                    point.contact = u32::MAX;
                    if let Some((heat, site)) = ContactSite::new(&nodes, slots.thermal, sites) {
                        point.contact = compact(self.contacts.heat.len());
                        self.contacts.heat.push(heat);
                        self.contacts.sites.push(site);
                    }
                    (block.points).connect(index, point.contact, sites.conduction);
                    index += 1;
                }
            }
        }
    }

    fn begin(&mut self, view: &StepView<'_>, old: &mut Old<'_, D>) -> Result<(), StateError> {
        match self.of.scheme {
            OneSet::Exact(_) => self.begin_as::<Exact>(view, old),
            _ => self.begin_as::<Any>(view, old),
        }
    }

    fn evaluate(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        system: Option<&mut LinearSystem<1>>,
    ) -> Result<(), StateError> {
        match self.of.scheme {
            OneSet::Exact(_) => self.evaluate_as::<Exact>(view, trial, system),
            _ => self.evaluate_as::<Any>(view, trial, system),
        }
    }

    fn correct(&mut self, solution: &[[f64; 1]]) -> f64 {
        let mut largest = 0.0;
        if !self.of.has_unknowns {
            return largest;
        }
        for block in &mut self.elements.blocks {
            let update = block.correct(&self.contacts, solution, &mut self.room.changes);
            largest = Scalar::maximum(largest, update);
        }
        largest
    }

    fn apply(&mut self, share: f64) {
        for block in &mut self.elements.blocks {
            block.points.apply(share);
        }
    }

    fn hold(&mut self) {
        for block in &mut self.elements.blocks {
            block.points.hold();
        }
    }

    fn add_impulse(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        along: Along,
        impulses: &mut Impulses<'_, D>,
        magnitudes: &mut [f64],
    ) {
        for block in &self.elements.blocks {
            let forces = &mut self.room.measures;
            let at = (view, trial);
            block.add_impulse(&self.of, at, along, forces, (impulses, magnitudes));
        }
    }

    fn close(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        next: &mut State,
        tally: &mut Tally,
    ) -> Result<(), StateError> {
        for block in &mut self.elements.blocks {
            let (at, ends) = ((view, trial), &mut self.room.ends);
            block.close(&self.of, at, &self.contacts, ends, (next, tally))?;
        }
        Ok(())
    }

    fn reevaluate(&self, ends: [&State; 2], reevaluation: &mut Reevaluation) {
        for block in &self.elements.blocks {
            for (first, member) in block.elements() {
                for (index, point) in (first..).zip(member.points.as_ref()) {
                    let (measures, increments) = point.increments_between(&member.site.nodes, ends);
                    let of_nodes = (measures.each_ref(), &increments);
                    (block.points).reevaluate(index, of_nodes, ends, reevaluation);
                }
            }
        }
    }

    fn generic_of_step(&self, ends: [&State; 2], see: &mut dyn FnMut(ElementGeneric)) {
        let at = self.of.scheme.placement();
        for block in &self.elements.blocks {
            for (first, member) in block.elements() {
                let [r0, r1] = [member.arms_in(ends[0]), member.arms_in(ends[1])];
                for (index, point) in (first..).zip(member.points.as_ref()) {
                    let (_, slots) = block.points.place(index);
                    let of_point = (block.points.generic(index), slots);
                    see(point.generic(&member.site.nodes, (at, [&r0, &r1]), of_point));
                }
            }
        }
    }

    #[cfg(feature = "gradients")]
    fn find_interfaces(
        &mut self,
        step: &PastStep<'_>,
        interface: &mut InterfaceTemperatures,
    ) -> Result<(), StateError> {
        Self::find_interfaces(self, step, interface)
    }

    #[cfg(feature = "gradients")]
    fn pull_back(
        &mut self,
        step: &StepBack<'_>,
        interface: &InterfaceTemperatures,
        system: &mut LinearSystem<1>,
    ) -> Result<(), StateError> {
        Self::pull_back(self, step, interface, system)
    }

    #[cfg(feature = "gradients")]
    fn recover(
        &mut self,
        step: &StepBack<'_>,
        interface: &InterfaceTemperatures,
        solution: &[[f64; 1]],
        found: (&mut PerVariable, &mut StepWeights),
        see: &mut SeeParameters<'_>,
    ) {
        Self::recover(self, step, interface, solution, found, see);
    }

    #[cfg(feature = "gradients")]
    fn push_forward(
        &mut self,
        step: &PastStep<'_>,
        temperatures: (&InterfaceTemperatures, &mut [f64]),
        system: &mut LinearSystem<1>,
        directions: &mut [Direction],
    ) -> Result<(), StateError> {
        Self::push_forward(self, step, temperatures, system, directions)
    }

    #[cfg(feature = "gradients")]
    fn follow(&self, directions: &mut [Direction]) {
        Self::follow(self, directions);
    }
}

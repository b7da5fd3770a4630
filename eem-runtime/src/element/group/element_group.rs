//! The elements of one model, with one set of forces in a step.

use core::marker::PhantomData;

use super::elements::Blocks;
use super::interface::{Elements, Group, Loose};
use super::loose::LooseElements;
use super::member::{Member, places};
use super::model_points::ModelPoints;
use super::placed::OfGroup;
#[cfg(feature = "gradients")]
use super::point_step::{Direction, PastStep, PerVariable, SeeParameters, StepBack, StepWeights};
use super::points::PointSet;
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
use crate::element::kinematics::{Kinematics, Length, QuadraticStrain, Stretch};
use crate::element::state::State;
use crate::element::tally::{Reevaluation, Tally};
use eem_material::arrays::Arrays;
use eem_material::free_energy::MOST_TOGETHER;
use eem_material::number::compact::compact;

/// Elements of one model with the kinematics `K`, with points `P` and schemes of the family `C`.
///
/// Mostly the points are behind a table, and of any family. For exact schemes and the springs that are met most often they are
/// not, so that a step is compiled as a whole: it takes 10 % fewer instructions.
pub(crate) struct ElementGroup<K, P, C, const D: usize>
where
    K: QuadraticStrain<D>,
    P: ?Sized,
{
    pub(super) of: OfGroup,
    pub(super) elements: Blocks<K, P, D>,
    pub(super) contacts: Contacts<K, D>,
    /// Kinematics and models are in the blocks.
    loose: LooseElements<K, D>,
    /// Workspace for elements with many points, a round of elements at a time.
    pub(super) shares: Vec<Share<K, D>>,
    family: PhantomData<C>,
}

/// Elements whose points are behind a table.
pub(crate) type AnyElements<K, const D: usize> =
    ElementGroup<K, dyn PointSet<<K as Kinematics<D>>::Measures>, Any, D>;

/// Springs in exact schemes whose points are not.
pub(crate) type ExactSprings<A, const D: usize> =
    ElementGroup<Stretch<D>, ModelPoints<A, Length, Exact>, Exact, D>;

impl<K: QuadraticStrain<D>, const D: usize> AnyElements<K, D> {
    /// Springs are in blocks of as many as are evaluated in one call, others one by one.
    pub(crate) fn new(scheme: OneSet, mut loose: LooseElements<K, D>, placed: Placed<'_>) -> Self {
        let per_block = if Member::<K, D>::POINTS == 1 {
            MOST_TOGETHER
        } else {
            1
        };
        let per_set = per_block * Member::<K, D>::POINTS;
        let of = OfGroup::new(scheme, &loose.models.shape());
        let sets = {
            let mut places = places::<K, D>(&loose.elements, placed);
            loose.models.points(scheme, &mut places, per_set)
        };
        Self::with(of, loose, (sets, per_block), placed)
    }
}

impl<A: Arrays, const D: usize> ExactSprings<A, D> {
    /// In one block.
    pub(crate) fn new(
        scheme: OneSet,
        mut loose: LooseElements<Stretch<D>, D>,
        placed: Placed<'_>,
    ) -> Self {
        let of = OfGroup::new(scheme, &loose.models.shape());
        let models = loose.take_models::<A>();
        let count = models.len();
        let points = {
            let mut places = places::<Stretch<D>, D>(&loose.elements, placed);
            ModelPoints::new(scheme, (&mut models.into_iter(), &mut places, count))
        };
        let sets = (vec![Box::new(points)], count.max(1));
        Self::with(of, loose, sets, placed)
    }
}

impl<K, P, C, const D: usize> ElementGroup<K, P, C, D>
where
    K: QuadraticStrain<D>,
    P: ?Sized + PointSet<K::Measures>,
    C: Family,
{
    /// Elements whose models have been given to these sets of points.
    fn with(
        of: OfGroup,
        loose: LooseElements<K, D>,
        (sets, per_block): (Vec<Box<P>>, usize),
        placed: Placed<'_>,
    ) -> Self {
        let how = (per_block, placed);
        Self {
            of,
            elements: Blocks::new(of.scheme, &loose.elements, sets, how),
            contacts: Contacts::none(),
            loose: loose.without_elements(),
            shares: Vec::new(),
            family: PhantomData,
        }
    }
}

impl<K, P, C, const D: usize> Group<D> for ElementGroup<K, P, C, D>
where
    K: QuadraticStrain<D>,
    P: ?Sized + PointSet<K::Measures>,
    C: Family,
{
    fn elements(&self) -> &dyn Elements {
        &self.elements
    }

    fn elements_mut(&mut self) -> &mut dyn Elements {
        &mut self.elements
    }

    fn into_loose(self: Box<Self>) -> Box<dyn Loose<D>> {
        let mut loose = self.loose;
        let mut take_back = |own| loose.models.take_back(own);
        loose.elements = self.elements.into_loose(&mut take_back);
        Box::new(loose)
    }

    fn connect(&mut self, sites: &Sites<'_, D>) {
        self.contacts = Contacts::none();
        for block in &mut self.elements.blocks {
            let mut index = 0;
            for member in &mut block.members {
                let nodes = member.site.nodes;
                member.site = Site::new(nodes, sites);
                for _ in 0..Member::<K, D>::POINTS {
                    let (_, slots) = block.points.place(index);
                    let mut contact = u32::MAX;
                    if let Some((heat, site)) = ContactSite::new(&nodes, slots.thermal, sites) {
                        contact = compact(self.contacts.heat.len());
                        self.contacts.heat.push(heat);
                        self.contacts.sites.push(site);
                    }
                    (block.points).connect(index, contact, sites.conduction);
                    index += 1;
                }
            }
        }
    }

    fn begin(&mut self, view: &StepView<'_>, old: &mut Old<'_, D>) -> Result<(), StateError> {
        for block in &mut self.elements.blocks {
            block.begin::<C>(self.of, view, old)?;
        }
        Ok(())
    }

    fn evaluate(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        system: Option<&mut LinearSystem<1>>,
    ) -> Result<(), StateError> {
        match system {
            Some(system) => self.linearize((view, trial), system),
            None => self.respond((view, trial)),
        }
    }

    fn correct(&mut self, solution: &[[f64; 1]]) -> f64 {
        let mut largest = 0.0;
        if !self.of.has_unknowns {
            return largest;
        }
        for block in &mut self.elements.blocks {
            largest = block.correct::<C>(&self.contacts, solution, largest);
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
            let target = (&mut *impulses, &mut *magnitudes);
            block.add_impulse::<C>(self.of, (view, trial), along, target);
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
            let books = (&mut *next, &mut *tally);
            block.close::<C>(self.of, (view, trial), &self.contacts, books)?;
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

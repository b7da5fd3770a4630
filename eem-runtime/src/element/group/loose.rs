//! Elements of one model without a scheme, while a scene is built or its scheme is changed.

use core::any::{Any, TypeId};
use core::fmt;
use core::mem;

use super::element_group::AnyElements;
use super::interface::{ExplicitGroup, Group, Loose};
use super::member::{LooseElement, Member, places};
use super::model_points::ModelPoints;
use super::points::{Models, PointPlace, PointSet};
use super::stages::{
    PathModels, PointPath, Projections, StageGroup, StagePoints, StageValues, ValueModels, Values,
};
use super::view::Placed;
use crate::element::conjugates::{Any as AnyScheme, Conjugates, OneSet};
use crate::element::kinematics::{MeasureSet, Points, QuadraticStrain, StrainMeasures};
use crate::element::layout::Shape;
use crate::element::tableau::Tableau;
use eem_material::arrays::Arrays;
use eem_material::tabled::Tabled;

/// Makes the group of an explicit scheme.
pub(crate) type MakeExplicit<const D: usize> =
    fn(Box<dyn Loose<D>>, Placed<'_>) -> Box<dyn ExplicitGroup<D>>;

/// Elements of one model with the kinematics `K`.
pub(crate) struct LooseElements<K: QuadraticStrain<D>, const D: usize> {
    pub(crate) elements: Vec<LooseElement<K, D>>,
    /// Of all points.
    pub(crate) models: Box<dyn Models<K::Strain>>,
    /// Explicit schemes are compiled for each material: a call of a table takes a good part of their time.
    pub(super) make_explicit: MakeExplicit<D>,
    /// Makes the group of an exact scheme, if its steps are compiled as a whole.
    make_exact: Option<MakeExact<K, D>>,
}

/// See [`LooseElements::make_exact`].
pub(crate) type MakeExact<K, const D: usize> =
    fn(OneSet, LooseElements<K, D>, Placed<'_>) -> Box<dyn Group<D>>;

impl<K: QuadraticStrain<D>, const D: usize> LooseElements<K, D> {
    /// No elements yet, of models in the arrays `A`.
    pub(crate) fn new<A: Arrays>(
        make_explicit: MakeExplicit<D>,
        make_exact: Option<MakeExact<K, D>>,
    ) -> Self {
        Self {
            elements: Vec::new(),
            models: Box::new(ModelList::<A> { models: Vec::new() }),
            make_explicit,
            make_exact,
        }
    }

    /// Its models.
    ///
    /// # Panics
    ///
    /// If they have other arrays.
    pub(super) fn take_models<A: Arrays>(&mut self) -> Vec<Tabled<A>> {
        mem::take(&mut self.list::<A>().models)
    }

    /// The same without its elements.
    pub(super) fn without_elements(mut self) -> Self {
        self.elements = Vec::new();
        self
    }

    fn list<A: Arrays>(&mut self) -> &mut ModelList<A> {
        let list = self.models.as_any_mut().downcast_mut();
        list.unwrap_or_else(|| unreachable!("the models of a group are of one kind"))
    }

    /// Adds an element, with a model for each of its points; returns the index of its first point.
    ///
    /// # Panics
    ///
    /// If these models have other arrays.
    pub(crate) fn push<A: Arrays>(
        &mut self,
        element: LooseElement<K, D>,
        models: impl IntoIterator<Item = Tabled<A>>,
    ) -> usize {
        let list = self.list::<A>();
        let place = list.models.len();
        list.models.extend(models);
        self.elements.push(element);
        place
    }
}

impl<K: QuadraticStrain<D>, const D: usize> Loose<D> for LooseElements<K, D> {
    fn as_any(&self) -> &dyn Any {
        self
    }

    fn as_any_mut(&mut self) -> &mut dyn Any {
        self
    }

    fn shape(&self) -> Shape {
        self.models.shape()
    }

    fn points_per_element(&self) -> usize {
        Member::<K, D>::POINTS
    }

    fn kind(&self) -> (TypeId, u64) {
        self.models.kind()
    }

    fn name(&self) -> &'static &'static str {
        self.models.name()
    }

    fn infinite_parameter(&self, place: usize) -> Option<(&'static str, f64)> {
        self.models.infinite_parameter(place)
    }

    fn duplicate(&self) -> Box<dyn Loose<D>> {
        let mut elements = Vec::with_capacity(self.elements.len());
        for (first, points) in &self.elements {
            let of_point = |point: usize| points.as_ref()[point];
            elements.push((*first, K::PerPoint::from_fn(of_point)));
        }
        Box::new(Self {
            elements,
            models: self.models.duplicate(),
            make_explicit: self.make_explicit,
            make_exact: self.make_exact,
        })
    }

    fn build(mut self: Box<Self>, by: Conjugates, placed: Placed<'_>) -> Box<dyn Group<D>> {
        match by {
            Conjugates::One(scheme) => match self.make_exact {
                Some(make) if matches!(scheme, OneSet::Exact(_)) && !self.models.is_together() => {
                    make(scheme, *self, placed)
                }
                _ => Box::new(AnyElements::new(scheme, *self, placed)),
            },
            Conjugates::Stages(rule) if rule.path.is_some() => {
                let places = places::<K, D>(&self.elements, placed);
                let mut strains = Vec::with_capacity(places.len());
                for (_, points) in &self.elements {
                    for kinematics in points.as_ref() {
                        strains.push(kinematics.strain_measures());
                    }
                }
                let points = self.models.on_path(rule, &places, &strains);
                Box::new(StageGroup::<K, Projections<K, D>, D>::new(
                    rule, *self, points, placed,
                ))
            }
            // Not compiled for solids, which these schemes refuse.
            Conjugates::Stages(rule) if K::Measures::IS_SPRING => {
                let places = places::<K, D>(&self.elements, placed);
                let points = self.models.at_stages(rule, &places);
                Box::new(StageGroup::<K, Values<K, D>, D>::new(
                    rule, *self, points, placed,
                ))
            }
            Conjugates::Stages(_) => unreachable!("they are refused in scenes with solids"),
        }
    }

    fn build_explicit(self: Box<Self>, placed: Placed<'_>) -> Box<dyn ExplicitGroup<D>> {
        (self.make_explicit)(self, placed)
    }
}

impl<K: QuadraticStrain<D>, const D: usize> fmt::Debug for LooseElements<K, D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = self.models.name();
        write!(f, "{} elements of {name}", self.elements.len())
    }
}

/// The models of points, in the arrays `A`.
pub(crate) struct ModelList<A: Arrays> {
    pub(super) models: Vec<Tabled<A>>,
}

impl<A: Arrays, G: StrainMeasures> Models<G> for ModelList<A> {
    fn as_any(&self) -> &dyn Any {
        self
    }

    fn as_any_mut(&mut self) -> &mut dyn Any {
        self
    }

    fn shape(&self) -> Shape {
        // They are of one kind.
        let model = self.models.first();
        Shape {
            dashpots: model.map_or(0, Tabled::dashpots),
            thermal: model.is_some_and(Tabled::is_thermal),
            drag: model.map_or(0, Tabled::drags) > 0,
            is_spring: G::Measures::IS_SPRING,
            viscous_strain: model.map_or(0, Tabled::viscous_strain),
            viscous_unit: G::Measures::VISCOUS_UNIT,
        }
    }

    fn kind(&self) -> (TypeId, u64) {
        let first = self.models.first();
        first.map_or((TypeId::of::<A>(), 0), identity)
    }

    fn name(&self) -> &'static &'static str {
        let first = self.models.first();
        first.map_or(&"material", |model| model.facts().model)
    }

    fn infinite_parameter(&self, index: usize) -> Option<(&'static str, f64)> {
        let model = &self.models[index];
        for (index, &name) in model.parameter_names().iter().enumerate() {
            let value = model.parameter(index);
            if !value.is_finite() {
                return Some((name, value));
            }
        }
        None
    }

    fn is_together(&self) -> bool {
        let first = self.models.first().and_then(|model| model.together());
        first.is_some_and(|together| together.least() <= self.models.len())
    }

    fn duplicate(&self) -> Box<dyn Models<G>> {
        let mut models = Vec::with_capacity(self.models.len());
        for model in &self.models {
            models.push(model.duplicate());
        }
        Box::new(Self { models })
    }

    fn take_back(&mut self, models: Box<dyn Any>) {
        let models = models.downcast::<Vec<Tabled<A>>>();
        let models = models.unwrap_or_else(|_| unreachable!("the models were of this list"));
        self.models.extend(*models);
    }

    fn points(
        &mut self,
        scheme: OneSet,
        places: &[PointPlace],
        per_set: usize,
    ) -> Vec<Box<dyn PointSet<G::Measures>>> {
        let mut models = mem::take(&mut self.models).into_iter();
        let mut sets: Vec<Box<dyn PointSet<G::Measures>>> = Vec::new();
        for places in places.chunks(per_set.max(1)) {
            let points = ModelPoints::<A, G::Measures, AnyScheme>::new(scheme, &mut models, places);
            sets.push(Box::new(points));
        }
        sets
    }

    fn on_path(
        &mut self,
        rule: &'static Tableau,
        places: &[PointPlace],
        strains: &[G],
    ) -> Box<dyn PathModels<G>> {
        let mut strains = strains.iter();
        let models = mem::take(&mut self.models);
        Box::new(StagePoints::new(rule, models, places, &mut |point| {
            let own = strains.next().copied();
            let own = own.unwrap_or_else(|| unreachable!("there is one per point"));
            PointPath::<A, G>::new(own, point)
        }))
    }

    fn at_stages(
        &mut self,
        rule: &'static Tableau,
        places: &[PointPlace],
    ) -> Box<dyn ValueModels<G::Measures>> {
        let models = mem::take(&mut self.models);
        if const { !G::Measures::IS_SPRING } {
            unreachable!("not compiled for solids, which these schemes refuse")
        }
        let points = StagePoints::new(rule, models, places, &mut StageValues::<A>::new);
        Box::new(points)
    }
}

/// The type and the kind of a model.
pub(crate) fn identity<A: Arrays>(model: &Tabled<A>) -> (TypeId, u64) {
    (model.as_any().type_id(), model.facts().kind)
}

//! Groups of elements for a scheme.

use core::any::{Any, TypeId};

use super::element_group::ElementGroup;
use super::interface::{ExplicitGroup, Group, Loose};
use super::loose::LooseElements;
use super::stages::{Projections, Source, StageGroup, Values};
use super::view::Placed;
use crate::element::conjugates::Conjugates;
use crate::element::kinematics::{MeasureSet, QuadraticStrain};
use crate::element::layout::Shape;
use crate::element::tableau::Tableau;
use eem_material::free_energy::Material;

impl<M: Material, K: QuadraticStrain<D>, const D: usize> Loose<D> for LooseElements<M, K, D> {
    fn as_any(&self) -> &dyn Any {
        self
    }

    fn as_any_mut(&mut self) -> &mut dyn Any {
        self
    }

    fn shape(&self) -> Shape {
        self.shape_of_all()
    }

    fn points_per_element(&self) -> usize {
        Self::POINTS
    }

    fn kind(&self) -> (TypeId, u64) {
        let model = self.model();
        model.map_or((TypeId::of::<M>(), 0), identity)
    }

    fn name(&self) -> &'static &'static str {
        self.model().map_or(&M::MODEL, M::model)
    }

    fn infinite_parameter(&self, place: usize) -> Option<(&'static str, f64)> {
        self.infinite_parameter_at(place)
    }

    fn duplicate(&self) -> Box<dyn Loose<D>> {
        Box::new(self.duplicate_all())
    }

    fn build(self: Box<Self>, by: Conjugates, placed: Placed<'_>) -> Box<dyn Group<D>> {
        match by {
            Conjugates::One(scheme) => Box::new(ElementGroup::new(scheme, *self, placed)),
            Conjugates::Stages(rule) if rule.path.is_some() => {
                staged::<M, K, Projections<M, K, D>, D>(rule, *self, placed)
            }
            // Not compiled for solids, which these schemes refuse.
            Conjugates::Stages(rule) if K::Measures::IS_SPRING => {
                staged::<M, K, Values<M, K, D>, D>(rule, *self, placed)
            }
            Conjugates::Stages(_) => unreachable!("they are refused in scenes with solids"),
        }
    }

    fn build_explicit(self: Box<Self>, placed: Placed<'_>) -> Box<dyn ExplicitGroup<D>> {
        (self.make_explicit)(self, placed)
    }
}

/// The group of a scheme that goes through stages, with conjugates of `C`.
fn staged<M: Material, K: QuadraticStrain<D>, C: Source<M, K, D>, const D: usize>(
    rule: &'static Tableau,
    elements: LooseElements<M, K, D>,
    placed: Placed<'_>,
) -> Box<dyn Group<D>> {
    Box::new(StageGroup::<M, K, C, D>::new(rule, elements, placed))
}

/// The type and the kind of a model.
pub(crate) fn identity<M: Material>(model: &M) -> (TypeId, u64) {
    (model.as_any().type_id(), model.kind())
}

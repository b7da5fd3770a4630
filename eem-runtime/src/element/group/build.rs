//! Groups of elements for a scheme.

use core::any::{Any, TypeId};

use super::element_group::ElementGroup;
use super::interface::{ExplicitGroup, Group, Loose};
use super::loose::LooseElements;
use super::stages::{OfMaterial, PointPath, Projections, StageGroup, StageValues, Values};
use super::view::Placed;
use crate::element::conjugates::Conjugates;
use crate::element::kinematics::{MeasureSet, QuadraticStrain};
use crate::element::layout::Shape;
use eem_material::arrays::Arrays;
use eem_material::tabled::Tabled;

impl<A: Arrays, K: QuadraticStrain<D>, const D: usize> Loose<D> for LooseElements<A, K, D> {
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
        model.map_or((TypeId::of::<A>(), 0), identity)
    }

    fn name(&self) -> &'static &'static str {
        self.model()
            .map_or(&"material", |model| model.facts().model)
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
                let models = OfMaterial::new(rule, *self, placed, |kinematics: &K, point| {
                    PointPath::new(kinematics.strain_measures(), point)
                });
                Box::new(StageGroup::<K, Projections<K, D>, D>::new(
                    rule,
                    Box::new(models),
                ))
            }
            // Not compiled for solids, which these schemes refuse.
            Conjugates::Stages(rule) if K::Measures::IS_SPRING => {
                let models =
                    OfMaterial::new(rule, *self, placed, |_, point| StageValues::new(point));
                Box::new(StageGroup::<K, Values<K, D>, D>::new(
                    rule,
                    Box::new(models),
                ))
            }
            Conjugates::Stages(_) => unreachable!("they are refused in scenes with solids"),
        }
    }

    fn build_explicit(self: Box<Self>, placed: Placed<'_>) -> Box<dyn ExplicitGroup<D>> {
        (self.make_explicit)(self, placed)
    }
}

/// The type and the kind of a model.
pub(crate) fn identity<A: Arrays>(model: &Tabled<A>) -> (TypeId, u64) {
    (model.as_any().type_id(), model.facts().kind)
}

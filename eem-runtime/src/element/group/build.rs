//! Groups of elements for a scheme.

use core::any::{Any, TypeId};

use super::element_group::AnyElements;
use super::interface::{ExplicitGroup, Group, Loose};
use super::loose::LooseElements;
use super::member::{Member, places};
use super::stages::{Projections, StageGroup, Values};
use super::view::Placed;
use crate::element::conjugates::{Conjugates, OneSet};
use crate::element::kinematics::{MeasureSet, Points, QuadraticStrain};
use crate::element::layout::Shape;

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
                let mut strains = Vec::new();
                for (_, points) in &self.elements {
                    for kinematics in points.as_ref() {
                        strains.push(kinematics.strain_measures());
                    }
                }
                let points = {
                    let mut places = places::<K, D>(&self.elements, placed);
                    self.models.on_path(rule, &mut places, &strains)
                };
                Box::new(StageGroup::<K, Projections<K, D>, D>::new(
                    rule, *self, points, placed,
                ))
            }
            // Not compiled for solids, which these schemes refuse.
            Conjugates::Stages(rule) if K::Measures::IS_SPRING => {
                let points = {
                    let mut places = places::<K, D>(&self.elements, placed);
                    self.models.at_stages(rule, &mut places)
                };
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

//! The models of points that have no scheme yet, in arrays of one kind.

use core::any::{Any, TypeId};
use core::mem;

use super::model_points::ModelPoints;
use super::models::Models;
use super::points::{PointPlace, PointSet};
use super::stages::models::{PathModels, ValueModels};
use super::stages::projection::path::PointPath;
use super::stages::stage_points::StagePoints;
use super::stages::values::local::StageValues;
use crate::element::conjugates::{Any as AnyScheme, OneSet};
use crate::element::kinematics::{MeasureSet, StrainMeasures};
use crate::element::layout::Shape;
use crate::element::tableau::Tableau;
use eem_material::arrays::Arrays;
use eem_material::tabled::Tabled;

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
        places: &mut dyn Iterator<Item = PointPlace>,
        per_set: usize,
    ) -> Vec<Box<dyn PointSet<G::Measures>>> {
        let mut left = self.models.len();
        let mut models = mem::take(&mut self.models).into_iter();
        let mut sets: Vec<Box<dyn PointSet<G::Measures>>> = Vec::new();
        while left > 0 {
            let count = left.min(per_set);
            let these = (&mut models as _, &mut &mut *places as _, count);
            let points = ModelPoints::<A, G::Measures, AnyScheme>::new(scheme, these);
            sets.push(Box::new(points));
            left -= count;
        }
        sets
    }

    fn on_path(
        &mut self,
        rule: &'static Tableau,
        places: &mut dyn Iterator<Item = PointPlace>,
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
        places: &mut dyn Iterator<Item = PointPlace>,
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

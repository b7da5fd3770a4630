//! The models of points that have no scheme yet.

use core::any::{Any, TypeId};

use super::points::{PointPlace, PointSet};
use super::stages::models::{PathModels, ValueModels};
use crate::element::conjugates::OneSet;
use crate::element::kinematics::StrainMeasures;
use crate::element::layout::Shape;
use crate::element::tableau::Tableau;

/// Models of points that have no scheme yet. `G` are the measures of a point as functions of its strain.
pub(crate) trait Models<G: StrainMeasures>: Any + Send + Sync {
    /// The models, for a downcast to their type.
    fn as_any(&self) -> &dyn Any;

    /// The same, mutable.
    fn as_any_mut(&mut self) -> &mut dyn Any;

    /// Their capabilities.
    fn shape(&self) -> Shape;

    /// Their type and kind; see [`FreeEnergy::kind`](eem_material::FreeEnergy::kind).
    fn kind(&self) -> (TypeId, u64);

    /// Their name.
    fn name(&self) -> &'static &'static str;

    /// The first parameter of a model that is not finite, and its value.
    fn infinite_parameter(&self, index: usize) -> Option<(&'static str, f64)>;

    /// Whether several of them may be evaluated in one call.
    fn is_together(&self) -> bool;

    fn duplicate(&self) -> Box<dyn Models<G>>;

    /// Takes models back from points.
    ///
    /// # Panics
    ///
    /// If they are of another type.
    fn take_back(&mut self, models: Box<dyn Any>);

    /// Gives its models to points with one set of forces in a step, in sets of so many.
    fn points(
        &mut self,
        scheme: OneSet,
        places: &mut dyn Iterator<Item = PointPlace>,
        per_set: usize,
    ) -> Vec<Box<dyn PointSet<G::Measures>>>;

    /// Gives its models to points on a path through the stages of a step.
    fn on_path(
        &mut self,
        rule: &'static Tableau,
        places: &mut dyn Iterator<Item = PointPlace>,
        strains: &[G],
    ) -> Box<dyn PathModels<G>>;

    /// Gives its models to points with values at the stages of a step.
    fn at_stages(
        &mut self,
        rule: &'static Tableau,
        places: &mut dyn Iterator<Item = PointPlace>,
    ) -> Box<dyn ValueModels<G::Measures>>;
}

//! Elements of one model without a scheme, while a scene is built or its scheme is changed.

use core::fmt;

use super::interface::{ExplicitGroup, Loose};
use super::view::Placed;
use crate::element::handle::Element;
use crate::element::kinematics::{Kinematics, MeasureSet, Points};
use crate::element::layout::Shape;
use eem_material::arrays::Arrays;
use eem_material::tabled::Tabled;

/// Model and kinematics of the points of an element.
pub(crate) type Parts<A, K, const D: usize> = <K as Kinematics<D>>::PerPoint<(Tabled<A>, K)>;

/// Makes the group of an explicit scheme.
pub(crate) type MakeExplicit<const D: usize> =
    fn(Box<dyn Loose<D>>, Placed<'_>) -> Box<dyn ExplicitGroup<D>>;

/// Elements of the model `A` with the kinematics `K`, each with the handle of its first point.
pub(crate) struct LooseElements<A: Arrays, K: Kinematics<D>, const D: usize> {
    pub(crate) elements: Vec<(Element, Parts<A, K, D>)>,
    /// Explicit schemes are compiled for each material: a call of a table takes a good part of their time.
    pub(super) make_explicit: MakeExplicit<D>,
}

impl<A: Arrays, K: Kinematics<D>, const D: usize> LooseElements<A, K, D> {
    pub(super) const POINTS: usize = K::PerPoint::<(Tabled<A>, K)>::LEN;

    /// No elements yet.
    pub(crate) fn new(make_explicit: MakeExplicit<D>) -> Self {
        Self {
            elements: Vec::new(),
            make_explicit,
        }
    }

    /// The model of the first point; those of all points have its kind and name.
    pub(super) fn model(&self) -> Option<&Tabled<A>> {
        let (_, points) = self.elements.first()?;
        Some(&points.as_ref().first()?.0)
    }

    /// Number of points.
    pub(crate) fn points(&self) -> usize {
        Self::POINTS * self.elements.len()
    }

    /// Capabilities of the model.
    pub(super) fn shape_of_all(&self) -> Shape {
        let model = self.model();
        Shape {
            dashpots: model.map_or(0, Tabled::dashpots),
            thermal: model.is_some_and(Tabled::is_thermal),
            drag: model.map_or(0, Tabled::drags) > 0,
            is_spring: K::Measures::IS_SPRING,
            viscous_strain: model.map_or(0, Tabled::viscous_strain),
            viscous_unit: K::Measures::VISCOUS_UNIT,
        }
    }

    /// See [`Loose::infinite_parameter`](super::Loose::infinite_parameter).
    pub(super) fn infinite_parameter_at(&self, place: usize) -> Option<(&'static str, f64)> {
        let (_, points) = &self.elements[place / Self::POINTS];
        let (model, _) = &points.as_ref()[place % Self::POINTS];
        for (index, &name) in model.parameter_names().iter().enumerate() {
            let value = model.parameter(index);
            if !value.is_finite() {
                return Some((name, value));
            }
        }
        None
    }

    /// A copy of the elements.
    pub(super) fn duplicate_all(&self) -> Self {
        let mut elements = Vec::with_capacity(self.elements.len());
        for (first, points) in &self.elements {
            let copy = |point: usize| {
                let (model, kinematics) = &points.as_ref()[point];
                (model.duplicate(), *kinematics)
            };
            elements.push((*first, K::PerPoint::from_fn(copy)));
        }
        Self {
            elements,
            make_explicit: self.make_explicit,
        }
    }
}

impl<A: Arrays, K: Kinematics<D>, const D: usize> fmt::Debug for LooseElements<A, K, D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = self
            .model()
            .map_or(&"material", |model| model.facts().model);
        write!(f, "{} elements of {name}", self.elements.len())
    }
}

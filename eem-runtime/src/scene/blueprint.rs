//! The elements of one model in a scene, before a scheme is chosen.

use core::any::Any;
use core::fmt::{self, Debug};

use crate::element::conjugates::{
    Conjugates, EemEntropy, EemTemperature, ElementScheme, Midpoint, MidpointTemperature,
    Trapezoidal, TrapezoidalTemperature, Variational,
};
use crate::element::group::{
    ElementGroup, ExplicitGroup, FreeGroup, Group, Placed, Projections, Source, StageGroup, Values,
};
use crate::element::handle::Element;
use crate::element::kinematics::Kinematics;
use crate::element::layout::Shape;
use crate::element::tableau::Tableau;
use crate::material::free_energy::{Array, FreeEnergy};
use crate::number::scalar::Real;
use crate::scene::error::SceneError;

/// A set of elements of one model, whatever the model is.
pub(crate) trait Blueprint<S: Real, const D: usize>: Any + Debug + Send + Sync {
    fn as_any(&self) -> &dyn Any;
    fn as_any_mut(&mut self) -> &mut dyn Any;
    /// Number of elements.
    fn len(&self) -> usize;
    fn shape(&self) -> Shape;
    /// All parameters of the element at `place` are finite.
    fn check_parameters(&self, place: usize, element: Element) -> Result<(), SceneError>;
    /// The elements, ready to be stepped.
    fn build(self: Box<Self>, by: Conjugates, placed: Placed<'_>) -> Box<dyn Group<S, D>>;
    /// The elements, ready for an explicit scheme.
    fn build_explicit(self: Box<Self>, placed: Placed<'_>) -> Box<dyn ExplicitGroup<S, D>>;
}

/// Elements of `P` points each, of the model `M` with the kinematics `K`.
pub(crate) struct ElementSet<M, K, const P: usize> {
    /// By the handles of their first points.
    elements: Vec<(Element, [(M, K); P])>,
}

impl<M, K, const P: usize> ElementSet<M, K, P> {
    /// An empty set.
    pub(crate) fn new() -> Self {
        Self {
            elements: Vec::new(),
        }
    }

    /// Adds an element, which consists of these points.
    pub(crate) fn push(&mut self, first: Element, points: [(M, K); P]) {
        self.elements.push((first, points));
    }
}

impl<M, K, const P: usize> Debug for ElementSet<M, K, P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = core::any::type_name::<M>();
        write!(f, "{} elements of {name}", self.elements.len())
    }
}

impl<S, M, K, const P: usize, const D: usize> Blueprint<S, D> for ElementSet<M, K, P>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    fn as_any(&self) -> &dyn Any {
        self
    }

    fn as_any_mut(&mut self) -> &mut dyn Any {
        self
    }

    fn len(&self) -> usize {
        P * self.elements.len()
    }

    fn shape(&self) -> Shape {
        Shape {
            dashpots: M::DASHPOTS,
            thermal: M::THERMAL,
            drag: M::Drag::LEN > 0,
            is_spring: K::IS_SPRING,
            viscous_unit: K::VISCOUS_UNIT,
        }
    }

    fn check_parameters(&self, place: usize, element: Element) -> Result<(), SceneError> {
        let (_, points) = &self.elements[place / P];
        let (model, _) = &points[place % P];
        for (index, &parameter) in M::PARAMETERS.iter().enumerate() {
            let value = model.parameter(index);
            if !value.is_finite() {
                let value = value.to_f64();
                return Err(SceneError::Parameter {
                    element,
                    parameter,
                    value,
                });
            }
        }
        Ok(())
    }

    fn build(self: Box<Self>, by: Conjugates, placed: Placed<'_>) -> Box<dyn Group<S, D>> {
        let group = match by {
            Conjugates::EntropyForm => boxed::<S, M, K, EemEntropy, P, D>,
            Conjugates::TemperatureForm => boxed::<S, M, K, EemTemperature, P, D>,
            Conjugates::MeanMeasures => boxed::<S, M, K, Variational, P, D>,
            Conjugates::Midpoint => boxed::<S, M, K, Midpoint, P, D>,
            Conjugates::MidpointTemperature => boxed::<S, M, K, MidpointTemperature, P, D>,
            Conjugates::End => boxed::<S, M, K, Trapezoidal, P, D>,
            Conjugates::EndTemperature => boxed::<S, M, K, TrapezoidalTemperature, P, D>,
            Conjugates::Stages(rule) if rule.path.is_some() => {
                return staged::<S, M, K, Projections<S, M, K, D>, P, D>(
                    rule,
                    self.elements,
                    placed,
                );
            }
            Conjugates::Stages(rule) => {
                return staged::<S, M, K, Values<S, M, K, D>, P, D>(rule, self.elements, placed);
            }
        };
        group(self.elements, placed)
    }

    fn build_explicit(self: Box<Self>, placed: Placed<'_>) -> Box<dyn ExplicitGroup<S, D>> {
        Box::new(FreeGroup::<S, M, K, D>::new(self.elements, placed))
    }
}

/// The group of a scheme with one set of forces.
fn boxed<S, M, K, C, const P: usize, const D: usize>(
    elements: Vec<(Element, [(M, K); P])>,
    placed: Placed<'_>,
) -> Box<dyn Group<S, D>>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    Box::new(ElementGroup::<S, M, K, C, D>::new(elements, placed))
}

/// The group of a scheme that goes through stages, with conjugates of `C`.
fn staged<S, M, K, C, const P: usize, const D: usize>(
    rule: &'static Tableau,
    elements: Vec<(Element, [(M, K); P])>,
    placed: Placed<'_>,
) -> Box<dyn Group<S, D>>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: Source<S, M, K, D>,
{
    Box::new(StageGroup::<S, M, K, C, D>::new(rule, elements, placed))
}

//! The elements of one model in a scene, before a scheme is chosen.

use core::any::Any;
use core::fmt::{self, Debug};

use crate::element::conjugates::{
    Conjugates, EemEntropy, EemTemperature, ElementScheme, Midpoint, MidpointTemperature,
    Trapezoidal, TrapezoidalTemperature, Variational,
};
use crate::element::group::{ElementGroup, Group, Placed, StageGroup};
use crate::element::handle::Element;
use crate::element::kinematics::{Kinematics, Quad4};
use crate::element::layout::Shape;
use crate::material::free_energy::FreeEnergy;
use crate::material::point_energy::PointEnergy;
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
}

/// Elements of the model `M` with the kinematics `K`, which have one point each.
pub(crate) struct ModelSet<M, K> {
    kinematics: K,
    models: Vec<(Element, M)>,
}

impl<M, K> ModelSet<M, K> {
    /// An empty set.
    pub(crate) fn new(kinematics: K) -> Self {
        Self {
            kinematics,
            models: Vec::new(),
        }
    }

    /// Adds an element.
    pub(crate) fn push(&mut self, model: M, element: Element) {
        self.models.push((element, model));
    }
}

impl<M, K> Debug for ModelSet<M, K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = core::any::type_name::<M>();
        write!(f, "{} elements of {name}", self.models.len())
    }
}

impl<S, M, K, const D: usize> Blueprint<S, D> for ModelSet<M, K>
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
        self.models.len()
    }

    fn shape(&self) -> Shape {
        Shape {
            dashpots: M::DASHPOTS,
            thermal: M::THERMAL,
            is_spring: true,
            viscous_unit: K::VISCOUS_UNIT,
        }
    }

    fn check_parameters(&self, place: usize, element: Element) -> Result<(), SceneError> {
        parameters_are_finite(&self.models[place].1, element)
    }

    fn build(self: Box<Self>, by: Conjugates, placed: Placed<'_>) -> Box<dyn Group<S, D>> {
        let Self { kinematics, models } = *self;
        let parts = models.into_iter();
        let parts = parts.map(|(element, model)| (element, [(model, kinematics)]));
        let parts = parts.collect();
        let group = match by {
            Conjugates::EntropyForm => boxed::<S, M, K, EemEntropy, [(M, K); 1], D>,
            Conjugates::TemperatureForm => boxed::<S, M, K, EemTemperature, [(M, K); 1], D>,
            Conjugates::MeanMeasures => boxed::<S, M, K, Variational, [(M, K); 1], D>,
            Conjugates::Midpoint => boxed::<S, M, K, Midpoint, [(M, K); 1], D>,
            Conjugates::MidpointTemperature => {
                boxed::<S, M, K, MidpointTemperature, [(M, K); 1], D>
            }
            Conjugates::End => boxed::<S, M, K, Trapezoidal, [(M, K); 1], D>,
            Conjugates::EndTemperature => boxed::<S, M, K, TrapezoidalTemperature, [(M, K); 1], D>,
            Conjugates::Stages(rule) => {
                return Box::new(StageGroup::<S, M, K, D>::new(rule, parts, placed));
            }
        };
        group(parts, placed)
    }
}

/// All parameters of a model are finite.
fn parameters_are_finite<S: Real, M: FreeEnergy<S>>(
    model: &M,
    element: Element,
) -> Result<(), SceneError> {
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

/// A quadrilateral: what each of its points consists of.
type QuadPoints<S, M, const N: usize> = [(PointEnergy<S, M>, Quad4<S, N>); 4];

/// Quadrilaterals of the model `M`, of N measures of strain.
pub(crate) struct QuadSet<S: Real, M, const N: usize> {
    /// Their first points, by handle.
    quads: Vec<(Element, QuadPoints<S, M, N>)>,
}

impl<S: Real, M: FreeEnergy<S>, const N: usize> QuadSet<S, M, N> {
    /// An empty set.
    pub(crate) fn new() -> Self {
        Self { quads: Vec::new() }
    }

    /// Adds a quadrilateral.
    pub(crate) fn push(&mut self, model: &M, points: [Quad4<S, N>; 4], first: Element)
    where
        M: Clone,
    {
        let points = points.map(|point| (PointEnergy::new(model.clone(), point.volume()), point));
        self.quads.push((first, points));
    }
}

impl<S: Real, M, const N: usize> Debug for QuadSet<S, M, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = core::any::type_name::<M>();
        write!(f, "{} quadrilaterals of {name}", self.quads.len())
    }
}

impl<S, M, const N: usize> Blueprint<S, 2> for QuadSet<S, M, N>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
{
    fn as_any(&self) -> &dyn Any {
        self
    }

    fn as_any_mut(&mut self) -> &mut dyn Any {
        self
    }

    fn len(&self) -> usize {
        4 * self.quads.len()
    }

    fn shape(&self) -> Shape {
        Shape {
            dashpots: M::DASHPOTS,
            thermal: M::THERMAL,
            is_spring: false,
            viscous_unit: <Quad4<S, N> as Kinematics<S, 2>>::VISCOUS_UNIT,
        }
    }

    fn check_parameters(&self, place: usize, element: Element) -> Result<(), SceneError> {
        let (_, points) = &self.quads[place / 4];
        parameters_are_finite(&points[place % 4].0, element)
    }

    fn build(self: Box<Self>, by: Conjugates, placed: Placed<'_>) -> Box<dyn Group<S, 2>> {
        let group = match by {
            Conjugates::EntropyForm => quads::<S, M, N, EemEntropy>,
            Conjugates::TemperatureForm => quads::<S, M, N, EemTemperature>,
            Conjugates::Midpoint => quads::<S, M, N, Midpoint>,
            Conjugates::MidpointTemperature => quads::<S, M, N, MidpointTemperature>,
            Conjugates::End => quads::<S, M, N, Trapezoidal>,
            Conjugates::EndTemperature => quads::<S, M, N, TrapezoidalTemperature>,
            Conjugates::MeanMeasures | Conjugates::Stages(_) => {
                unreachable!("schemes that do not close by increments are refused for solids")
            }
        };
        group(self.quads, placed)
    }
}

/// Quadrilaterals with a scheme.
fn quads<S, M, const N: usize, C>(
    parts: Vec<(Element, QuadPoints<S, M, N>)>,
    placed: Placed<'_>,
) -> Box<dyn Group<S, 2>>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    C: ElementScheme<S, PointEnergy<S, M>>,
{
    boxed::<S, PointEnergy<S, M>, Quad4<S, N>, C, _, 2>(parts, placed)
}

/// The group of a scheme with one set of forces.
fn boxed<S, M, K, C, P, const D: usize>(
    parts: Vec<(Element, P)>,
    placed: Placed<'_>,
) -> Box<dyn Group<S, D>>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
    P: IntoIterator<Item = (M, K)>,
{
    Box::new(ElementGroup::<S, M, K, C, D>::new(parts, placed))
}

//! The elements of one model in a scene, before a scheme is chosen.

use core::any::Any;
use core::fmt::{self, Debug};

use crate::error::SceneError;
use crate::free_energy::FreeEnergy;
use crate::group::{ElementGroup, Group, Placed, StageGroup};
use crate::handle::Element;
use crate::kinematics::Kinematics;
use crate::layout::Shape;
use crate::scalar::Real;
use crate::scheme::{
    EemEntropy, EemTemperature, ElementScheme, Midpoint, MidpointTemperature, Scheme, Trapezoidal,
    TrapezoidalTemperature, Variational,
};

/// A set of elements of one model, whatever the model is.
pub(crate) trait Blueprint<S: Real, const D: usize>: Any + Debug + Send + Sync {
    fn as_any(&self) -> &dyn Any;
    fn as_any_mut(&mut self) -> &mut dyn Any;
    /// Number of elements.
    fn len(&self) -> usize;
    fn shape(&self) -> Shape;
    /// All parameters of the element at `place` are finite.
    fn check_parameters(&self, place: usize, element: Element) -> Result<(), SceneError>;
    /// The elements, ready to be stepped by `scheme`.
    fn build(self: Box<Self>, scheme: Scheme, placed: Placed<'_>) -> Box<dyn Group<S, D>>;
}

/// Elements of the model `M` with the kinematics `K`.
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
        }
    }

    fn check_parameters(&self, place: usize, element: Element) -> Result<(), SceneError> {
        for (index, &parameter) in M::PARAMETERS.iter().enumerate() {
            let value = self.models[place].1.parameter(index);
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

    fn build(self: Box<Self>, scheme: Scheme, placed: Placed<'_>) -> Box<dyn Group<S, D>> {
        let Self { kinematics, models } = *self;
        if let Some(rule) = scheme.tableau() {
            let group = StageGroup::<S, M, K, D>::new(rule, kinematics, models, placed);
            return Box::new(group);
        }
        let group = match scheme {
            Scheme::EemEntropy | Scheme::Staggered => boxed::<S, M, K, EemEntropy, D>,
            Scheme::EemTemperature => boxed::<S, M, K, EemTemperature, D>,
            Scheme::Variational | Scheme::Variational4 => boxed::<S, M, K, Variational, D>,
            Scheme::MidpointTemperature => boxed::<S, M, K, MidpointTemperature, D>,
            Scheme::TrapezoidalTemperature => boxed::<S, M, K, TrapezoidalTemperature, D>,
            Scheme::Midpoint | Scheme::Gauss4 => boxed::<S, M, K, Midpoint, D>,
            Scheme::Trapezoidal => boxed::<S, M, K, Trapezoidal, D>,
        };
        group(kinematics, models, placed)
    }
}

/// The group of a scheme with one set of forces.
fn boxed<S, M, K, C, const D: usize>(
    kinematics: K,
    models: Vec<(Element, M)>,
    placed: Placed<'_>,
) -> Box<dyn Group<S, D>>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    Box::new(ElementGroup::<S, M, K, C, D>::new(
        kinematics, models, placed,
    ))
}

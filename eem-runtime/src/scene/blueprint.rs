//! The elements of one model in a scene, before a scheme is chosen.

use core::any::Any;
use core::fmt::{self, Debug};

use crate::element::group::{Loose, LooseElements};
use crate::element::handle::Element;
use crate::element::kinematics::{Kinematics, Points};
use crate::element::layout::Shape;
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
    /// The elements, for which a scheme is chosen.
    fn into_loose(self: Box<Self>) -> Box<dyn Loose<S, D>>;
}

/// Elements of the model `M` with the kinematics `K`.
pub(crate) struct ElementSet<S: Real, M: Send + Sync, K: Kinematics<S, D>, const D: usize> {
    loose: LooseElements<S, M, K, D>,
}

impl<S: Real, M: Send + Sync, K: Kinematics<S, D>, const D: usize> ElementSet<S, M, K, D> {
    const POINTS: usize = K::PerPoint::<(M, K)>::LEN;

    /// An empty set.
    pub(crate) fn new() -> Self {
        let elements = Vec::new();
        Self {
            loose: LooseElements { elements },
        }
    }

    /// Adds an element, which consists of these points.
    pub(crate) fn push(&mut self, first: Element, points: K::PerPoint<(M, K)>) {
        self.loose.elements.push((first, points));
    }
}

impl<S, M, K, const D: usize> Debug for ElementSet<S, M, K, D>
where
    S: Real,
    M: Send + Sync,
    K: Kinematics<S, D>,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = core::any::type_name::<M>();
        write!(f, "{} elements of {name}", self.loose.elements.len())
    }
}

impl<S, M, K, const D: usize> Blueprint<S, D> for ElementSet<S, M, K, D>
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
        Self::POINTS * self.loose.elements.len()
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
        let (_, points) = &self.loose.elements[place / Self::POINTS];
        let (model, _) = &points.as_ref()[place % Self::POINTS];
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

    fn into_loose(self: Box<Self>) -> Box<dyn Loose<S, D>> {
        Box::new(self.loose)
    }
}

//! Elements of one model that no scheme steps: of a scene that is still being built, or between two schemes.

use crate::element::handle::Element;
use crate::element::kinematics::Kinematics;
use crate::number::scalar::Real;

/// What the points of an element consist of.
pub(crate) type Parts<S, M, K, const D: usize> = <K as Kinematics<S, D>>::PerPoint<(M, K)>;

/// Elements of the model `M` with the kinematics `K`, by the handles of their first points.
pub(crate) struct LooseElements<S, M, K, const D: usize>
where
    S: Real,
    M: Send + Sync,
    K: Kinematics<S, D>,
{
    pub(crate) elements: Vec<(Element, Parts<S, M, K, D>)>,
}

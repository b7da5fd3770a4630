//! Elements of one model without a scheme, while a scene is built or its scheme is changed.

use core::fmt;
use core::mem;

use super::interface::{ExplicitGroup, Group, Loose};
use super::member::LooseElement;
use super::model_list::ModelList;
use super::models::Models;
use super::view::Placed;
use crate::element::conjugates::OneSet;
use crate::element::kinematics::QuadraticStrain;
use eem_material::arrays::Arrays;
use eem_material::tabled::Tabled;

/// Makes the group of an explicit scheme.
pub(crate) type MakeExplicit<const D: usize> =
    fn(Box<dyn Loose<D>>, Placed<'_>) -> Box<dyn ExplicitGroup<D>>;

/// Elements of one model with the kinematics `K`.
pub(crate) struct LooseElements<K: QuadraticStrain<D>, const D: usize> {
    pub(crate) elements: Vec<LooseElement<K, D>>,
    /// Of all points.
    pub(crate) models: Box<dyn Models<K::Strain>>,
    /// Explicit schemes are compiled for each material: a call of a table takes a good part of their time.
    pub(super) make_explicit: MakeExplicit<D>,
    /// Makes the group of an exact scheme, if its steps are compiled as a whole.
    pub(super) make_exact: Option<MakeExact<K, D>>,
}

/// See [`LooseElements::make_exact`].
pub(crate) type MakeExact<K, const D: usize> =
    fn(OneSet, LooseElements<K, D>, Placed<'_>) -> Box<dyn Group<D>>;

impl<K: QuadraticStrain<D>, const D: usize> LooseElements<K, D> {
    /// No elements yet, of models in the arrays `A`.
    pub(crate) fn new<A: Arrays>(
        make_explicit: MakeExplicit<D>,
        make_exact: Option<MakeExact<K, D>>,
    ) -> Self {
        Self {
            elements: Vec::new(),
            models: Box::new(ModelList::<A> { models: Vec::new() }),
            make_explicit,
            make_exact,
        }
    }

    /// Its models.
    ///
    /// # Panics
    ///
    /// If they have other arrays.
    pub(super) fn take_models<A: Arrays>(&mut self) -> Vec<Tabled<A>> {
        mem::take(&mut self.list::<A>().models)
    }

    /// The same without its elements.
    pub(super) fn without_elements(mut self) -> Self {
        self.elements = Vec::new();
        self
    }

    fn list<A: Arrays>(&mut self) -> &mut ModelList<A> {
        let list = self.models.as_any_mut().downcast_mut();
        list.unwrap_or_else(|| unreachable!("the models of a group are of one kind"))
    }

    /// Adds an element, with a model for each of its points; returns the index of its first point.
    ///
    /// # Panics
    ///
    /// If these models have other arrays.
    pub(crate) fn push<A: Arrays>(
        &mut self,
        element: LooseElement<K, D>,
        models: impl IntoIterator<Item = Tabled<A>>,
    ) -> usize {
        let list = self.list::<A>();
        let place = list.models.len();
        list.models.extend(models);
        self.elements.push(element);
        place
    }
}

impl<K: QuadraticStrain<D>, const D: usize> fmt::Debug for LooseElements<K, D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = self.models.name();
        write!(f, "{} elements of {name}", self.elements.len())
    }
}

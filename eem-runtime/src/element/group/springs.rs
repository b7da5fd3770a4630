//! Springs, compiled with this crate in one to three dimensions.

#[cfg(not(test))]
use core::any::Any;

use super::element_group::ExactSprings;
use super::explicit::{ExplicitElements, ExplicitPoint};
use super::interface::{ExplicitGroup, Loose};
use super::loose::{LooseElements, MakeExact, MakeExplicit};
use super::model_list::ModelList;
use super::view::Placed;
use crate::element::kinematics::Stretch;
use eem_material::arrays::{Arrays, SpringArrays};
use eem_material::free_energy::Material;

/// Arrays of springs without temperature and dashpots.
pub(crate) type Elastic = SpringArrays<1, 0, 0, 0, 1, 4>;

/// With a temperature and without dashpots.
pub(crate) type Warm = SpringArrays<2, 0, 0, 2, 3, 16>;

/// With a temperature and a dashpot in series.
pub(crate) type Viscous = SpringArrays<3, 1, 0, 4, 4, 24>;

/// With room for a temperature, two dashpots in series and one in parallel.
pub(crate) type Damped = SpringArrays<4, 2, 1, 6, 5, 32>;

/// With room for a temperature, eight dashpots in series and one in parallel. Compiled in the program that has such springs.
pub(crate) type ManyDashpots = SpringArrays<10, 8, 1, 18, 11, 32>;

/// Makes a group without elements.
pub(crate) type NewGroup<const D: usize> = fn(MakeExplicit<D>) -> Box<dyn Loose<D>>;

/// The groups of springs in one dimension.
pub(crate) struct Springs<const D: usize> {
    pub(crate) elastic: NewGroup<D>,
    pub(crate) warm: NewGroup<D>,
    pub(crate) viscous: NewGroup<D>,
    pub(crate) damped: NewGroup<D>,
}

#[cfg(not(test))]
static LINE: Springs<1> = Springs::HERE;
#[cfg(not(test))]
static PLANE: Springs<2> = Springs::HERE;
#[cfg(not(test))]
static SPACE: Springs<3> = Springs::HERE;

/// A group of springs with these arrays.
pub(crate) fn group_of<A: Arrays, const D: usize>(
    make_explicit: MakeExplicit<D>,
) -> Box<dyn Loose<D>> {
    Box::new(LooseElements::<Stretch<D>, D>::new::<A>(
        make_explicit,
        None,
    ))
}

/// The same, with steps of exact schemes that are compiled as a whole.
fn fast_group_of<A: Arrays, const D: usize>(make_explicit: MakeExplicit<D>) -> Box<dyn Loose<D>> {
    let make_exact: MakeExact<Stretch<D>, D> =
        |scheme, loose, placed| Box::new(ExactSprings::<A, D>::new(scheme, loose, placed));
    Box::new(LooseElements::<Stretch<D>, D>::new::<A>(
        make_explicit,
        Some(make_exact),
    ))
}

impl<const D: usize> Springs<D> {
    /// Compiled where they are used.
    const HERE: Self = Self {
        elastic: group_of::<Elastic, D>,
        warm: fast_group_of::<Warm, D>,
        viscous: fast_group_of::<Viscous, D>,
        damped: group_of::<Damped, D>,
    };

    /// Those of this crate if it has them. A branch that a constant rules out is not compiled.
    #[inline]
    pub(crate) fn get() -> &'static Self {
        #[cfg(not(test))]
        if const { 1 <= D && D <= 3 } {
            return of_dimension(D, [&LINE, &PLANE, &SPACE]);
        }
        const { &Self::HERE }
    }
}

/// The table of a dimension, one of those for one to three, by its own type.
///
/// # Panics
///
/// If that is not the type of the table.
#[cfg(not(test))]
#[inline]
#[must_use]
pub fn of_dimension<T: Any>(dimension: usize, tables: [&'static dyn Any; 3]) -> &'static T {
    let table = tables[dimension - 1].downcast_ref();
    table.expect("the dimension is that of the table")
}

/// Springs of the material `M` in an explicit scheme, given those behind tables.
pub(crate) fn explicit<M: Material, A: Arrays, const D: usize>(
    loose: Box<dyn Loose<D>>,
    placed: Placed<'_>,
) -> Box<dyn ExplicitGroup<D>> {
    let all = loose
        .as_any()
        .downcast_ref::<LooseElements<Stretch<D>, D>>();
    let all = all.unwrap_or_else(|| unreachable!("the group has made this function known"));
    let models = all.models.as_any().downcast_ref::<ModelList<A>>();
    let models = models.unwrap_or_else(|| unreachable!("the models of a group are of one type"));
    let elements = all.elements.iter().zip(&models.models);
    let points = elements.map(|((element, [stretch]), model)| {
        let model = model.as_any().downcast_ref::<M>();
        let model = model.unwrap_or_else(|| unreachable!("as above"));
        let slots = placed.layout.elements[element.index()];
        ExplicitPoint::new((*element, slots), model.duplicate(), *stretch)
    });
    let points = points.collect();
    Box::new(ExplicitElements::new(points, loose, placed))
}

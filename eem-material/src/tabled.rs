//! A material behind its table.

use core::any::Any;
use core::ops::Deref;

use crate::arrays::{Arrays, ArraysOf};
use crate::formulas::Formulas;
use crate::free_energy::{Array, Material};
use crate::with_room::WithRoom;

/// A material behind its table.
///
/// If the arrays have room for a dashpot in parallel, it may be missing, as dashpots in series and the temperature may.
pub struct Tabled<A: Arrays> {
    formulas: Box<dyn Formulas<A>>,
    has_constant_capacity: bool,
    is_thermal: bool,
    dashpots: u16,
    drags: u16,
    viscous_strain: u16,
}

impl<A: Arrays> Tabled<A> {
    /// Whether the materials may lack some of the variables.
    const HAS_ROOM: bool = A::Drag::LEN > 0;

    /// Whether a material has these arrays.
    #[must_use]
    pub const fn is_for<M: Material>() -> bool {
        M::MEASURES == A::MEASURES
            && !M::PER_VOLUME
            && M::DASHPOTS == A::DASHPOTS
            && M::THERMAL == A::THERMAL
            && M::Viscosities::LEN == A::Viscosities::LEN
            && M::Drag::LEN == A::Drag::LEN
            && M::Variables::LEN == A::Variables::LEN
            && M::Corners::LEN == A::Corners::LEN
            && M::Response::LEN == A::Response::LEN
    }

    /// A material that [has these arrays](Self::is_for); P is that of its measures.
    #[must_use]
    pub fn new<M: Material, P: Array<f64>>(material: M) -> Self {
        let formulas: Box<dyn Formulas<ArraysOf<M, P, A::Kept>>> = Box::new(material);
        let mut formulas = Some(formulas);
        // The same type by another name.
        let same: &mut dyn Any = &mut formulas;
        let same: Option<&mut Option<Box<dyn Formulas<A>>>> = same.downcast_mut();
        let Some(formulas) = same.and_then(Option::take) else {
            unreachable!("materials with these numbers of variables have this table")
        };
        let facts = formulas.facts();
        Self {
            formulas,
            has_constant_capacity: facts.has_constant_capacity,
            is_thermal: facts.is_thermal,
            dashpots: small(facts.dashpots),
            drags: small(facts.drags),
            viscous_strain: small(facts.viscous_strain),
        }
    }
}

impl<A: Arrays> Tabled<A> {
    /// Whether these arrays are for springs that may lack variables, and a material has no more variables than they.
    #[must_use]
    pub const fn has_room_for<M: Material>() -> bool {
        Self::HAS_ROOM && WithRoom::<M, A>::FITS
    }

    /// A material [for which there is room](Self::has_room_for).
    #[must_use]
    pub fn with_room<M: Material, P: Array<f64>>(material: M) -> Self {
        if const { Self::is_for::<M>() } {
            Self::new::<M, P>(material)
        } else {
            Self::new::<_, P>(WithRoom::<M, A>::new(material))
        }
    }
}

impl<A: Arrays> Deref for Tabled<A> {
    type Target = dyn Formulas<A>;

    #[inline]
    fn deref(&self) -> &Self::Target {
        &*self.formulas
    }
}

impl<A: Arrays> Tabled<A> {
    /// A copy for a copy of the scene.
    #[must_use]
    pub fn duplicate(&self) -> Self {
        Self {
            formulas: self.formulas.duplicate(),
            ..*self
        }
    }

    /// Number of dashpots in series.
    #[inline]
    #[must_use]
    pub fn dashpots(&self) -> usize {
        if Self::HAS_ROOM {
            self.dashpots.into()
        } else {
            A::DASHPOTS
        }
    }

    /// Number of dashpots in parallel.
    #[inline]
    #[must_use]
    pub fn drags(&self) -> usize {
        if Self::HAS_ROOM { self.drags.into() } else { 0 }
    }

    /// Whether there is a temperature.
    #[inline]
    #[must_use]
    pub fn is_thermal(&self) -> bool {
        A::THERMAL && (!Self::HAS_ROOM || self.is_thermal)
    }

    /// The number of dashpots, the last ones, that are components of a viscous strain.
    #[must_use]
    pub fn viscous_strain(&self) -> usize {
        self.viscous_strain.into()
    }

    /// Whether the heat capacity does not depend on the temperature.
    #[inline]
    #[must_use]
    pub fn has_constant_capacity(&self) -> bool {
        self.has_constant_capacity
    }
}

/// A number of dashpots, or of components of a viscous strain.
fn small(number: usize) -> u16 {
    let small = u16::try_from(number);
    small.unwrap_or_else(|_| unreachable!("a matrix with 2³² entries does not fit the memory"))
}

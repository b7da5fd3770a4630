//! The numbers of a scene, as the sparse elimination reads and writes them: in double precision.

use core::marker::PhantomData;

use eem_sparse::Precision;

use eem_material::number::scalar::Real;

/// The numbers of a scene, as the sparse elimination reads and writes them.
#[derive(Clone, Copy)]
pub(super) struct Stored<S>(PhantomData<S>);

impl<S: Real> Precision for Stored<S> {
    type Number = S;

    #[inline]
    fn widen(number: S) -> f64 {
        number.to_f64()
    }

    #[inline]
    fn narrow(value: f64) -> S {
        S::from_f64(value)
    }
}

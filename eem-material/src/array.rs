//! Arrays whose length is known only to their type.

use core::fmt::Debug;
use core::ops::{Index, IndexMut};

/// A fixed-size array, named only by its element type.
///
/// Implemented for `[T; N]`. The lengths of the arrays of a model depend on its variables, so the trait
/// [`FreeEnergy`](crate::free_energy::FreeEnergy) leaves them to associated types.
///
/// ```
/// use eem::Array;
///
/// let row = <[f64; 3]>::filled(2.0);
/// assert_eq!(<[f64; 3] as Array<f64>>::LEN, 3);
/// assert_eq!(row.as_ref().iter().sum::<f64>(), 6.0);
/// ```
pub trait Array<T>:
    Entry + AsRef<[T]> + AsMut<[T]> + Index<usize, Output = T> + IndexMut<usize>
{
    /// The number of elements.
    const LEN: usize;

    /// The array with `value` everywhere.
    fn filled(value: T) -> Self;

    /// The array at the beginning of a slice that is at least as long.
    fn beginning_of(slice: &[T]) -> &Self;

    /// The array with the first `count` elements of another one, and its own beyond.
    #[must_use]
    #[inline]
    fn beginning_as(mut self, other: &Self, count: usize) -> Self
    where
        T: Copy,
    {
        for index in 0..Self::LEN {
            if index < count {
                self[index] = other[index];
            }
        }
        self
    }
}

/// Elements of an array. Implemented for every type that qualifies.
pub trait Entry: Copy + Debug + Send + Sync + 'static {}

impl<T: Copy + Debug + Send + Sync + 'static> Entry for T {}

impl<T: Entry, const N: usize> Array<T> for [T; N] {
    const LEN: usize = N;

    #[inline]
    fn filled(value: T) -> Self {
        [value; N]
    }

    #[inline]
    fn beginning_of(slice: &[T]) -> &Self {
        slice.first_chunk().expect("the slice is long enough")
    }
}

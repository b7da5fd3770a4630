//! How numbers are stored; all arithmetic is in double precision.

/// The type of the entries, right-hand sides and solutions, and its conversion.
///
/// Implemented for `f64` and `f32`. A program with number types of its own implements it for a marker
/// type, as the number type need not be known to this crate.
///
/// ```
/// use eem_sparse::Precision;
///
/// assert_eq!(f32::widen(0.5), 0.5_f64);
/// assert_eq!(f32::narrow(0.1_f64), 0.1_f32);
/// ```
pub trait Precision: Copy + Send + Sync {
    /// What is stored.
    type Number: Copy + Send + Sync;

    /// The number in double precision, without an error.
    fn widen(number: Self::Number) -> f64;

    /// The nearest number that can be stored.
    fn narrow(value: f64) -> Self::Number;
}

impl Precision for f64 {
    type Number = Self;

    #[inline]
    fn widen(number: Self) -> f64 {
        number
    }

    #[inline]
    fn narrow(value: f64) -> Self {
        value
    }
}

impl Precision for f32 {
    type Number = Self;

    #[inline]
    fn widen(number: Self) -> f64 {
        f64::from(number)
    }

    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "rounding is the purpose")]
    fn narrow(value: f64) -> Self {
        value as Self
    }
}

//! Numbers: what is stepped, sums to twice the precision, and the kernels of divided differences.

pub(crate) mod compact;
pub(crate) mod compensated;
pub(crate) mod derivative;
pub(crate) mod digest;
pub mod kernel;
#[cfg(feature = "lanes")]
pub(crate) mod lanes;
pub(crate) mod readable;
pub(crate) mod scalar;

//! Numbers: scalar types, sums to twice the precision, and the kernels of divided differences.

pub mod compact;
pub mod compensated;
pub mod derivative;
pub mod digest;
pub mod kernel;
pub mod readable;
pub mod scalar;

//! Which entries of a matrix can differ from zero: all of them where systems are dense.

#[cfg(not(feature = "sparse"))]
mod full;

#[cfg(feature = "sparse")]
pub(crate) use eem_sparse::Pattern;
#[cfg(not(feature = "sparse"))]
pub(crate) use full::Pattern;

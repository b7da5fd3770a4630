//! The numbers of schemes that go through stages.

pub(crate) mod gauss_4;
pub(crate) mod variational_4;

//! The coefficients of the schemes with stages.

pub(crate) mod eem_entropy_4;
pub(crate) mod eem_entropy_6;
pub(crate) mod gauss_4;
pub(crate) mod variational_4;

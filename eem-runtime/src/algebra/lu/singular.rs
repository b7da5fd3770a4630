//! What an elimination cannot do.

/// A matrix that has no usable pivot in some column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Singular;

//! The shapes of the cells of solids: shape functions and rule of integration, a file each.

mod hex20;
mod hex8;
mod interpolation;
mod quad4;
mod quad8;
pub(super) mod rule;

pub use hex8::Hex8;
pub use hex20::Hex20;
pub use interpolation::Shape;
pub use quad4::Quad4;
pub use quad8::Quad8;

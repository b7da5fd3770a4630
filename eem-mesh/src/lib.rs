//! Meshes of solids: shapes of cells, their functions and integrals, and files of Gmsh.
//!
//! Part of `eem`, which names everything in here that a user needs. Where to change what:
//!
//! | to | look in |
//! |---|---|
//! | add a shape of cell | `shape.rs` |
//! | change the algebra of tensors | `tensor.rs` |
//! | change how masses or volumes are integrated | `integrals.rs` |
//! | make a mesh of a new kind of region | `mesh/grid.rs`, `mesh/polygon.rs` |
//! | reject a mesh | `mesh/check.rs`; messages in `mesh/error.rs` |
//! | select faces, or conduct heat through them | `mesh/boundary.rs`, `mesh/network.rs` |
//! | read more from files of Gmsh | `gmsh/file.rs` |

#[cfg(feature = "gmsh")]
mod gmsh;
#[doc(hidden)]
pub mod integrals;
#[doc(hidden)]
pub mod memory;
mod mesh;
mod shape;
#[doc(hidden)]
pub mod tensor;

#[cfg(feature = "gmsh")]
pub use gmsh::{LineFault, Msh, MshError};
pub use mesh::{Face, Mesh, MeshError, Outline};
#[doc(hidden)]
pub use mesh::{Skewness, SubFace, distance, facing, per_node};
pub use shape::{Hex8, Hex20, Points, Quad4, Quad8, Shape};

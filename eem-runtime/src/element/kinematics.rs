//! Measures of the deformation of an element from the positions of its nodes.
//!
//! A measure `π(q)` is a function of a quantity that is at most quadratic in the positions: the stretch is the root
//! of `λ² = r·r`, a Green–Lagrange strain is quadratic. For such measures the mean-value gradient
//!
//! ```text
//! D*π = ∂π(q⁰, q¹):   D*π (q¹ − q⁰) = π¹ − π⁰   exactly
//! ```
//!
//! is linear in the mean position `q_m`.
//!
//! Measures do not change in a translation. So an element is described by its *arms*, the edge vectors from its
//! first node to the others,
//!
//! ```text
//! r_i = q_i − q_0,   ∂π/∂q_i = ∂π/∂r_i,   ∂π/∂q_0 = −Σ_i ∂π/∂r_i
//! ```
//!
//! and the force `Σ f_a D*π_a` on node i is `Σ_j A_ij r_m,j` with a symmetric matrix A of numbers, one
//! per pair of arms, that depends only on `f` and on the strains at both ends (`π⁰` and `π¹` of a spring).

mod between;
mod measures;
mod solid;
mod solid_measures;
mod solid_state;
mod solid_strain;
mod stiffness;
mod strain;
mod stretch;

#[doc(inline)]
pub use eem_mesh::{Hex8, Hex20, Points, Quad4, Quad8, Shape};
pub use measures::{
    Arms, Blocks, Ends, Gradient, Kinematics, Length, MeasureSet, Measures, StrainSet, Weights,
};
pub(crate) use measures::{
    MeasuresOf, Numbers, PerStrain, QuadraticStrain, StrainMatrix, StrainMeasures, StrainSlopes,
    add_blocks,
};
pub use solid::SolidPoint;
pub use solid_state::SolidState;
pub use strain::{Measure, Strain, StrainEnergy};
pub use stretch::Stretch;

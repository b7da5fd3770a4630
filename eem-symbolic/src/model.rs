//! From one free energy to all programs of a constitutive law.

use crate::graph::{ExprId, Graph, Symbol};
use crate::program::Program;

/// A free energy ψ(x; parameters) and its dashpots, x = (measures …, dashpots …, temperature).
#[derive(Clone, Debug)]
pub struct Model {
    /// The graph that holds all expressions.
    pub graph: Graph,
    /// Kinematic measures λ_a, a = 1 … M.
    pub measures: Vec<Symbol>,
    /// Viscous stretches γ_k, k = 1 … K.
    pub dashpots: Vec<Symbol>,
    /// Absolute temperature θ, if the model has one.
    pub temperature: Option<Symbol>,
    /// The parameters that the expressions may mention.
    pub parameters: Vec<Symbol>,
    /// Free energy ψ.
    pub psi: ExprId,
    /// One viscosity η_k per dashpot, a function of the parameters and θ.
    pub viscosities: Vec<ExprId>,
}

/// Everything that a constitutive law computes, scheduled.
///
/// N = M + K + T is the number of variables, T = 1 if there is a temperature and 0 otherwise;
/// R = M + K + 2 T is the number of algorithmic quantities. Inputs are the parameters followed by x;
/// in the two algorithmic forms the parameters, x⁰, x¹ and the corner temperatures.
#[derive(Clone, Debug, PartialEq)]
pub struct Programs {
    /// `[ψ]`.
    pub free_energy: Program,
    /// `[∂ψ/∂x_i]`.
    pub gradient: Program,
    /// `[∂ψ/∂x_i …, ∂²ψ/∂x_i∂x_j …]`, the Hessian by rows.
    pub hessian: Program,
    /// `[e]`, ψ itself without a temperature.
    pub internal_energy: Program,
    /// `[s, θ ∂s/∂θ, Σ |terms of s|]`; none without a temperature.
    pub caloric: Option<Program>,
    /// `[η_k …, dη_k/dθ …]`, inputs parameters and θ (if there is one); none without dashpots.
    pub viscosity: Option<Program>,
    /// `[f*_a …, g*_k …, θ*, Δs]` followed by the R×N tangent by rows, in entropy form.
    pub entropy_form: Program,
    /// The same outputs in temperature form, without corners; none without a temperature.
    pub temperature_form: Option<Program>,
}

/// The constitutive law in print.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Formulas {
    /// ψ.
    pub free_energy: String,
    /// s = −∂ψ/∂θ.
    pub entropy: Option<String>,
    /// e = ψ + θ s.
    pub internal_energy: String,
    /// f_a = ∂ψ/∂λ_a.
    pub forces: Vec<String>,
    /// g_k = −∂ψ/∂γ_k.
    pub dashpot_forces: Vec<String>,
    /// c = θ ∂s/∂θ.
    pub heat_capacity: Option<String>,
    /// η_k.
    pub viscosities: Vec<String>,
}

impl Model {
    /// All programs of the law.
    #[must_use]
    pub fn programs(&self) -> Programs {
        todo!()
    }

    /// All formulas of the law.
    #[must_use]
    pub fn formulas(&self) -> Formulas {
        todo!()
    }
}

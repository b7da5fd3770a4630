//! From one free energy to all programs of a constitutive law.

mod difference_formulas;
mod point;

use crate::diff::diff;
use crate::discrete::{self, Step};
use crate::display::format;
use crate::graph::Graph;
use crate::node::{ExprId, Symbol};
use crate::program::Program;
use crate::verify_error::VerifyError;
pub use difference_formulas::DifferenceFormula;
use point::{PointPrograms, heat_capacity};

/// A free energy ψ(x; parameters) and its dashpots, x = (measures …, dashpots …, temperature).
#[derive(Clone, Debug)]
pub struct Model {
    /// The graph that holds all expressions.
    pub graph: Graph,
    /// Kinematic measures `λ_a`, a = 1 … M.
    pub measures: Vec<Symbol>,
    /// Viscous stretches `γ_k`, k = 1 … K.
    pub dashpots: Vec<Symbol>,
    /// Absolute temperature θ, if the model has one.
    pub temperature: Option<Symbol>,
    /// The parameters that the expressions may mention.
    pub parameters: Vec<Symbol>,
    /// Free energy ψ.
    pub psi: ExprId,
    /// One viscosity `η_k` per dashpot, a function of the parameters and θ.
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
    /// `[magnitude of ψ]`: times 8 ε a bound of the rounding error of `free_energy`; see
    /// [`magnitude`](crate::magnitude()).
    pub energy_magnitude: Program,
    /// `[∂ψ/∂x_i]`.
    pub gradient: Program,
    /// `[∂ψ/∂x_i …, ∂²ψ/∂x_i∂x_j …]`, the Hessian by rows.
    pub hessian: Program,
    /// `[e]`, ψ itself without a temperature.
    pub internal_energy: Program,
    /// `[s, θ ∂s/∂θ, Σ |terms of s|]`; none without a temperature.
    pub caloric: Option<Program>,
    /// The same outputs and ψ, everything that does not depend on θ at
    /// [`Stage::Old`](crate::Stage::Old).
    pub caloric_at: Option<Program>,
    /// `[∂²s/∂x_i∂x_j …]` by rows; none without a temperature.
    pub entropy_hessian: Option<Program>,
    /// `[η_k …, dη_k/dθ …]`, inputs parameters and θ (if there is one); none without dashpots.
    pub viscosity: Option<Program>,
    /// `[f*_a …, g*_k …, θ*, Δs]` followed by the R×N tangent by rows, in entropy form.
    pub entropy_form: Program,
    /// The same outputs in temperature form, without corners; none without a temperature.
    pub temperature_form: Option<Program>,
}

impl Programs {
    /// Checks all programs; see [`Program::verify`].
    ///
    /// # Errors
    ///
    /// [`VerifyError::NonFiniteConstant`] if a derivative has a factor that does not fit an `f64`.
    pub fn verify(&self) -> Result<(), VerifyError> {
        let always = [
            &self.free_energy,
            &self.energy_magnitude,
            &self.gradient,
            &self.hessian,
            &self.internal_energy,
            &self.entropy_form,
        ];
        let sometimes = [
            &self.caloric,
            &self.caloric_at,
            &self.entropy_hessian,
            &self.viscosity,
            &self.temperature_form,
        ];
        let sometimes = sometimes.into_iter().flatten();
        always
            .into_iter()
            .chain(sometimes)
            .try_for_each(Program::verify)
    }
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
    /// `f_a = ∂ψ/∂λ_a`.
    pub forces: Vec<String>,
    /// `g_k = −∂ψ/∂γ_k`.
    pub dashpot_forces: Vec<String>,
    /// c = θ ∂s/∂θ.
    pub heat_capacity: Option<String>,
    /// `η_k`.
    pub viscosities: Vec<String>,
}

impl Model {
    /// x: measures, dashpots, temperature.
    #[must_use]
    pub fn variables(&self) -> Vec<Symbol> {
        let mechanical = self.measures.iter().chain(&self.dashpots);
        mechanical.chain(&self.temperature).copied().collect()
    }

    /// All programs of the law.
    #[must_use]
    pub fn programs(&self) -> Programs {
        let mut point = PointPrograms::new(self);
        Programs {
            free_energy: point.free_energy(),
            energy_magnitude: point.energy_magnitude(),
            gradient: point.gradient(),
            hessian: point.hessian(),
            internal_energy: point.internal_energy(),
            caloric: self.temperature.map(|theta| point.caloric(theta)),
            caloric_at: self.temperature.map(|theta| point.caloric_at(theta)),
            entropy_hessian: self.temperature.map(|theta| point.entropy_hessian(theta)),
            viscosity: (!self.dashpots.is_empty()).then(|| point.viscosity()),
            entropy_form: self.entropy_form(),
            temperature_form: self.temperature.map(|_| self.temperature_form()),
        }
    }

    fn entropy_form(&self) -> Program {
        let mut step = Step::new(self, true);
        let form = match self.temperature {
            Some(_) => discrete::entropy_form(&mut step),
            None => discrete::elastic_form(&mut step),
        };
        step.program(&form)
    }

    fn temperature_form(&self) -> Program {
        let mut step = Step::new(self, false);
        let form = discrete::temperature_form(&mut step);
        step.program(&form)
    }

    /// All formulas of the law.
    #[must_use]
    pub fn formulas(&self) -> Formulas {
        let mut graph = self.graph.clone();
        let (mut forces, mut dashpot_forces) = (Vec::new(), Vec::new());
        for &lambda in &self.measures {
            let force = diff(&mut graph, self.psi, lambda);
            forces.push(format(&graph, force));
        }
        for &gamma in &self.dashpots {
            let slope = diff(&mut graph, self.psi, gamma);
            let force = graph.neg(slope);
            dashpot_forces.push(format(&graph, force));
        }
        let caloric = self.temperature.map(|theta| {
            let entropy = self.entropy(&mut graph, theta);
            let capacity = heat_capacity(&mut graph, entropy, theta);
            (format(&graph, entropy), format(&graph, capacity))
        });
        let (entropy, heat_capacity) = caloric.unzip();
        let energy = self.internal_energy(&mut graph);
        Formulas {
            free_energy: format(&graph, self.psi),
            entropy,
            internal_energy: format(&graph, energy),
            forces,
            dashpot_forces,
            heat_capacity,
            viscosities: self
                .viscosities
                .iter()
                .map(|&law| format(&graph, law))
                .collect(),
        }
    }
}

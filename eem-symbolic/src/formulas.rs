//! The formulas of a constitutive law as text.

use crate::diff::diff;
use crate::display::format;
use crate::model::{Model, heat_capacity};

/// The formulas of a constitutive law as text.
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
    /// η of the dashpot in parallel with the spring, if there is one.
    pub drag: Option<String>,
}

impl Model {
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
            drag: self.drag.map(|law| format(&graph, law)),
        }
    }
}

//! The divided differences that discrete derivatives are made of, as text.

use crate::display::format;
use crate::divided_difference::divided_difference;
use crate::model::Model;

/// The divided difference of a potential along an edge between two states.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DifferenceFormula {
    /// The potential F: `"ψ"`, `"e"` or `"s"`.
    pub potential: &'static str,
    /// The variable that changes along the edge; all others stay.
    pub variable: String,
    /// `F[x⁰, x¹]`, a formula of both values of the variable, marked by `⁰` and `¹`.
    pub formula: String,
}

impl Model {
    /// The divided differences of the model, one potential and one variable after the other.
    ///
    /// ```text
    /// F[x⁰, x¹] = (F(x¹) − F(x⁰))/(x¹ − x⁰)
    /// ```
    ///
    /// of ψ and s along measures and viscous variables, of e and s along the temperature: discrete
    /// derivatives are means of these over the edges between the two states of a step.
    ///
    /// ```
    /// use eem_symbolic::{Graph, Model};
    ///
    /// let mut graph = Graph::new();
    /// let (k, x) = (graph.symbol("k"), graph.symbol("x"));
    /// let (stiffness, length) = (graph.variable(k), graph.variable(x));
    /// let square = graph.powi(length, 2);
    /// let psi = graph.mul(stiffness, square);
    /// let model = Model {
    ///     graph,
    ///     measures: vec![x],
    ///     strains: vec![],
    ///     dashpots: vec![],
    ///     temperature: None,
    ///     parameters: vec![k],
    ///     psi,
    ///     viscosities: vec![],
    ///     drag: None,
    /// };
    /// assert_eq!(model.difference_formulas()[0].formula, "k*(x⁰ + x¹)");
    /// ```
    #[must_use]
    pub fn difference_formulas(&self) -> Vec<DifferenceFormula> {
        let mut graph = self.graph.clone();
        let energy = self.internal_energy(&mut graph);
        let entropy = self
            .temperature
            .map(|theta| self.entropy(&mut graph, theta));
        let mut formulas = Vec::new();
        for x in self.variables() {
            let variable = graph.name(x).to_owned();
            let ends = ["⁰", "¹"].map(|mark| graph.version(x, &format!("{variable}{mark}")));
            let [a, b] = ends.map(|end| graph.variable(end));
            let first = if self.temperature == Some(x) {
                ("e", energy)
            } else {
                ("ψ", self.psi)
            };
            let potentials = [Some(first), entropy.map(|entropy| ("s", entropy))];
            for (potential, e) in potentials.into_iter().flatten() {
                let difference = divided_difference(&mut graph, e, x, a, b);
                formulas.push(DifferenceFormula {
                    potential,
                    variable: variable.clone(),
                    formula: format(&graph, difference),
                });
            }
        }
        formulas
    }
}

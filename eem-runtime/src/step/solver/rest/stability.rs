//! Whether a state at rest is stable, and the motion against which there is least stiffness.

use super::system::ROUNDINGS;
use super::{AtRest, LONG, Softest};
use crate::algebra::{dot, hypot, largest};
use crate::step::error::StepFailure;
use eem_material::number::compact::compact;

/// The shift is at most four times the smallest that makes K positive definite, so that, relative to an unstable motion,
/// motions of positive stiffness fall to 3/4 or less in each iteration.
const INVERSE_ITERATIONS: usize = 60;

impl Softest {
    /// The part of these forces of all moving nodes along the motion, as a share of them.
    pub(crate) fn share_of(&self, forces: &[f64]) -> f64 {
        dot(forces, &self.motion).abs() / (hypot(forces) * hypot(&self.motion))
    }
}

/// A vector of moving nodes, times D.
fn weighted(dimension: usize, x: &[f64], sizes: &[f64]) -> Vec<f64> {
    let x = x.iter().enumerate();
    x.map(|(row, x)| x * sizes[row / dimension]).collect()
}

/// Quasi-random numbers, a vector with a component along every motion.
fn mixed(rows: usize) -> Vec<f64> {
    (1..=compact(rows))
        .map(|row| (f64::from(row) * 0.618_033_988_749_895).fract() + 0.1)
        .collect()
}

impl AtRest<'_> {
    /// Whether the tangent is positive definite beyond rounding.
    pub(crate) fn is_stable(&mut self) -> bool {
        let rounding = self.rounding();
        let is_stable = self.judge(-rounding);
        // The test has overwritten the system.
        self.renew().is_ok() && is_stable
    }

    /// The motion against which there is least stiffness, by inverse iteration.
    pub(crate) fn softest(&mut self) -> Option<Softest> {
        let rounding = self.rounding();
        let mut shift = rounding;
        while !self.judge(shift) {
            shift *= 4.0;
            if !shift.is_finite() {
                return None;
            }
        }
        let sizes = self.sizes.clone();
        let mut x = mixed(self.first.len());
        let mut relative = 0.0;
        for _ in 0..INVERSE_ITERATIONS {
            self.assemble_alone(shift).ok()?;
            let right = weighted(self.dimension, &x, &sizes);
            self.set_right(&right);
            self.search.tangent_mut().solve().ok()?;
            let found = self.solution();
            // (K + shift D) y = D x gives 1/(λ + shift) = xᵀ D y / xᵀ D x.
            relative = dot(&right, &x) / dot(&right, &found) - shift;
            let most = largest(&found);
            x = found.iter().map(|x| x / most).collect();
        }
        let weighted = weighted(self.dimension, &x, &sizes);
        let stiffness = relative * (dot(&weighted, &x) / LONG) / dot(&x, &x);
        let nodes = self.nodes.iter();
        Some(Softest {
            nodes: nodes.map(|node| node.node).collect(),
            motion: x,
            stiffness,
            relative,
            rounding,
        })
    }

    /// Assembles the symmetric part of K plus a shift in units of D.
    fn assemble_alone(&mut self, shift: f64) -> Result<(), StepFailure> {
        self.renew()?;
        if !self.search.is_symmetric() {
            self.search.tangent_mut().symmetrize();
        }
        self.shift(shift);
        Ok(())
    }

    fn judge(&mut self, shift: f64) -> bool {
        self.assemble_alone(shift).is_ok()
            && self.search.tangent_mut().solve_and_judge() == Ok(true)
    }

    /// What rounding may contribute to eigenvalues of K, relative to D: entries have the rounding of element
    /// contributions, whose arms are known to ε wherever the origin is, and the elimination adds one rounding per unknown.
    fn rounding(&self) -> f64 {
        let unknowns = f64::from(compact(self.first.len()));
        f64::EPSILON * (ROUNDINGS + unknowns)
    }
}

//! General powers: rational exponents become products, everything else stays one node.

use crate::graph::Graph;
use crate::node::{ExprId, Node};
use crate::number::Number;

impl Graph {
    /// `base ^ exponent`.
    ///
    /// Laws: rational constant exponents are those of [`Graph::power_product`]; `1 ^ h = 1`.
    /// Any other power is defined for a positive base, as `f64::powf` computes it, and
    /// `(g^h)^k = g^(h·k)` is not applied.
    pub fn power(&mut self, base: ExprId, exponent: ExprId) -> ExprId {
        if let Some(Number::Exact(exponent)) = self.as_number(exponent) {
            return self.power_product(&[(base, exponent)]);
        }
        if self.as_number(base) == Some(Number::ONE) {
            return base;
        }
        self.intern(Node::Power(base, exponent))
    }
}

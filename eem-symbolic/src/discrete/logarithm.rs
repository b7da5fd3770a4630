//! Logarithms of the new state from those of the old one, without a call of the library.
//!
//! ```text
//! ln(c b) = ln(c a) + (b − a) ln[a, b]
//! ```
//!
//! with a and c of the old state. Where b is a variable inside of a logarithm, the algorithmic
//! quantities contain the divided difference anyway, and the logarithm at a is computed once per
//! step. The error is a few ulp of 1, as that of `ln(c b)` of a rounded argument is, or a few
//! ulp of `ln(c a)` if that is larger.

use std::collections::{BTreeMap, BTreeSet};

use super::step::Step;
use crate::function::Function;
use crate::graph::Graph;
use crate::node::{ExprId, Kernel, Node};
use crate::number::Rational;
use crate::schedule::Dependence;

/// A logarithm, and the factors of its argument that depend on the new state.
type Moving = (Function, Vec<(ExprId, Rational)>);

/// `f(x)` where x depends on the new state.
struct Logarithm {
    value: ExprId,
    function: Function,
    argument: ExprId,
    moving: Moving,
}

/// `f[a, b]` between the old and the new state.
struct Bridge {
    old: ExprId,
    new: ExprId,
    difference: ExprId,
}

impl Step {
    /// Logarithms that the outputs contain, each with an equal expression that calls no function of
    /// the new state.
    pub(super) fn carried_logarithms(&mut self, outputs: &[ExprId]) -> Vec<(ExprId, ExprId)> {
        let (logarithms, bridges) = self.logarithms(outputs);
        let mut carried = Vec::new();
        for logarithm in logarithms {
            let Some(bridge) = bridges.get(&logarithm.moving) else {
                continue;
            };
            let factor = self.graph.div(logarithm.argument, bridge.new);
            let start = self.graph.mul(factor, bridge.old);
            let start = self.graph.apply(logarithm.function, start);
            let increment = self.graph.sub(bridge.new, bridge.old);
            let increment = self.name(increment);
            let change = self.graph.mul(increment, bridge.difference);
            let end = self.graph.add(start, change);
            carried.push((logarithm.value, self.name(end)));
        }
        carried
    }

    fn logarithms(&self, outputs: &[ExprId]) -> (Vec<Logarithm>, BTreeMap<Moving, Bridge>) {
        let symbols: BTreeSet<_> = self.new.iter().chain(&self.corners).copied().collect();
        let schedule = self.schedule();
        let new = Dependence::new(&schedule, &symbols, outputs);
        let (mut logarithms, mut bridges) = (Vec::new(), BTreeMap::new());
        for &value in new.reached().iter().filter(|&&e| new.on(e)) {
            match *self.graph.node(value) {
                Node::Apply(function, argument) if is_logarithm(function) => {
                    logarithms.push(Logarithm {
                        value,
                        function,
                        argument,
                        moving: (function, moving(&self.graph, &new, argument)),
                    });
                }
                Node::DividedDifference(Kernel::Function(function), a, b)
                    if is_logarithm(function) && new.on(a) != new.on(b) =>
                {
                    let (old, new_end) = if new.on(a) { (b, a) } else { (a, b) };
                    let key = (function, moving(&self.graph, &new, new_end));
                    bridges.entry(key).or_insert(Bridge {
                        old,
                        new: new_end,
                        difference: value,
                    });
                }
                _ => {}
            }
        }
        (logarithms, bridges)
    }
}

fn is_logarithm(function: Function) -> bool {
    matches!(function, Function::Ln | Function::Log2 | Function::Log10)
}

fn moving(graph: &Graph, new: &Dependence<'_>, e: ExprId) -> Vec<(ExprId, Rational)> {
    let e = graph.as_scaled(e).map_or(e, |(_, term)| term);
    match graph.node(e) {
        Node::Product(factors) => {
            let factors = factors.iter().filter(|(base, _)| new.on(*base));
            factors.copied().collect()
        }
        _ => vec![(e, Rational::ONE)],
    }
}

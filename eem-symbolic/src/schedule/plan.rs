//! The order in which products and sums are evaluated so that they share the most partial results.
//!
//! Factors or terms that depend on parameters alone are combined first, coefficients included, and
//! computed once per step. The order of the others is left to [`Sharing`].

use std::collections::{BTreeSet, HashMap};

use super::context::Schedule;
use super::dependence::Dependence;
use super::sharing::{Entry, Sharing, Token};
use crate::node::{ExprId, Node, Symbol};
use crate::number::{Number, Rational};

/// A factor of a product, or all its factors that depend on parameters alone.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Factor {
    /// `base ^ exponent` that depends on a state.
    Power(ExprId, Rational),
    /// `coefficient · Π base ^ exponent` of parameters.
    Hoisted(Number, Vec<(ExprId, Rational)>),
}

/// A term of a sum, or all its terms that depend on parameters alone.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Term {
    /// `coefficient · term` with a positive coefficient.
    Scaled(Number, ExprId),
    /// `constant + Σ coefficient · term` of parameters.
    Hoisted(Number, Vec<(Number, ExprId)>),
}

/// Lists of operands L (factors or terms) of products or sums K, by tokens. Maps are looked up, never iterated.
#[derive(Debug)]
pub(super) struct Operands<K, L> {
    pub(super) sharing: Sharing,
    tokens: HashMap<L, Token>,
    leaves: Vec<Option<L>>,
    lists: HashMap<K, usize>,
}

impl<K: Eq + std::hash::Hash, L: Clone + Eq + std::hash::Hash> Operands<K, L> {
    fn new() -> Self {
        Self {
            sharing: Sharing::default(),
            tokens: HashMap::new(),
            leaves: Vec::new(),
            lists: HashMap::new(),
        }
    }

    fn entry(&mut self, leaf: L, negative: bool) -> Entry {
        let token = if let Some(&token) = self.tokens.get(&leaf) {
            token
        } else {
            let token = self.sharing.token();
            self.leaves.push(Some(leaf.clone()));
            self.tokens.insert(leaf, token);
            token
        };
        Entry { token, negative }
    }

    /// The entries of the product or sum `key`, if it has been planned.
    pub(super) fn entries(&self, key: &K) -> Option<Vec<Entry>> {
        let list = *self.lists.get(key)?;
        Some(self.sharing.entries(list).to_vec())
    }

    /// The operand of a token that is not a pair.
    pub(super) fn leaf(&self, token: Token) -> Option<&L> {
        self.leaves.get(token)?.as_ref()
    }
}

/// Which operands are combined first, for all outputs of a program.
#[derive(Debug)]
pub(super) struct Plan {
    /// Products times positive coefficients.
    pub(super) products: Operands<(Number, ExprId), Factor>,
    pub(super) sums: Operands<ExprId, Term>,
    /// Arguments of functions; quotients among them are divided as a whole.
    pub(super) arguments: BTreeSet<ExprId>,
}

impl Plan {
    /// Plans everything that the roots depend on; `new` are the inputs that are not parameters.
    pub(super) fn new(schedule: &Schedule<'_>, new: &BTreeSet<Symbol>, roots: &[ExprId]) -> Self {
        let mut plan = Self {
            products: Operands::new(),
            sums: Operands::new(),
            arguments: BTreeSet::new(),
        };
        let dependence = Dependence::new(schedule, new, roots);
        for &e in dependence.reached() {
            plan.look_at(&dependence, e);
        }
        for &root in roots {
            plan.product(&dependence, Number::ONE, root);
        }
        plan.products.sharing.solve();
        plan.sums.sharing.solve();
        plan
    }

    /// The planned factors of `coefficient · e`; `None` for an argument of a function, which is
    /// divided as a whole.
    pub(super) fn factors(&self, coefficient: Number, e: ExprId) -> Option<Vec<Entry>> {
        if coefficient == Number::ONE && self.arguments.contains(&e) {
            return None;
        }
        self.products.entries(&(coefficient, e))
    }

    fn look_at(&mut self, dependence: &Dependence<'_>, e: ExprId) {
        let graph = dependence.schedule.graph;
        let resolved = dependence.schedule.locals.resolve(graph, e);
        if resolved != e {
            self.product(dependence, Number::ONE, resolved);
            return;
        }
        if let Node::Sum { constant, terms } = graph.node(e) {
            for &(coefficient, term) in terms {
                self.product(dependence, coefficient.abs(), term);
            }
            self.sum(dependence, e, *constant, terms);
            return;
        }
        let of_function = !matches!(graph.node(e), Node::Product(_) | Node::PairSum(..));
        graph.node(e).for_each_operand(|operand| {
            if of_function {
                self.arguments.insert(operand);
            } else {
                self.product(dependence, Number::ONE, operand);
            }
        });
    }

    /// Plans `coefficient · e` if e is a product that depends on a state.
    fn product(&mut self, dependence: &Dependence<'_>, coefficient: Number, e: ExprId) {
        let Node::Product(factors) = dependence.schedule.graph.node(e) else {
            return;
        };
        let key = (coefficient, e);
        if !dependence.on(e) || self.products.lists.contains_key(&key) {
            return;
        }
        let (new, old): (Vec<_>, Vec<_>) =
            factors.iter().partition(|(base, _)| dependence.on(*base));
        let mut entries = Vec::with_capacity(new.len() + 1);
        if !old.is_empty() || coefficient != Number::ONE {
            let hoisted = Factor::Hoisted(coefficient, old);
            entries.push(self.products.entry(hoisted, false));
        }
        for (base, exponent) in new {
            let power = Factor::Power(base, exponent);
            entries.push(self.products.entry(power, false));
        }
        let list = self.products.sharing.list(entries);
        self.products.lists.insert(key, list);
    }

    /// Plans a sum that depends on a state.
    fn sum(
        &mut self,
        dependence: &Dependence<'_>,
        e: ExprId,
        constant: Number,
        terms: &[(Number, ExprId)],
    ) {
        if !dependence.on(e) {
            return;
        }
        let (new, old): (Vec<_>, Vec<_>) = terms.iter().partition(|(_, term)| dependence.on(*term));
        let mut entries = Vec::with_capacity(new.len() + 1);
        let mut single = Vec::new();
        if let ([term], true) = (&old[..], constant.is_zero()) {
            single.push(*term);
        } else if !old.is_empty() || !constant.is_zero() {
            entries.push(self.sums.entry(Term::Hoisted(constant, old), false));
        }
        for (coefficient, term) in single.into_iter().chain(new) {
            let leaf = Term::Scaled(coefficient.abs(), term);
            entries.push(self.sums.entry(leaf, coefficient.is_negative()));
        }
        let list = self.sums.sharing.list(entries);
        self.sums.lists.insert(e, list);
    }
}

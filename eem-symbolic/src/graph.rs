//! The hash-consed graph: equal canonical nodes have one id, and operands are older than their users.

use std::collections::HashMap;

use crate::function::Function;
use crate::node::{ExprId, Node, Symbol};
use crate::number::Number;

/// Expressions that share their subexpressions.
///
/// The constructors are the only way to build a node; they own the canonical form. Every law they
/// apply holds wherever the left-hand side is defined (`θ·θ⁻¹ = 1` extends it to θ = 0). Ids of one
/// graph mean nothing in another, except in a clone.
///
/// ```
/// use eem_symbolic::Graph;
///
/// let mut graph = Graph::new();
/// let theta = graph.symbol("theta");
/// let theta = graph.variable(theta);
/// let inverse = graph.recip(theta);
/// let one = graph.mul(theta, inverse);
/// assert_eq!(graph.as_number(one), Some(1.0.into()));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Graph {
    entries: Vec<Entry>,
    ids: HashMap<Node, ExprId>,
    /// Nodes with the first version in place of each symbol; their operands are shapes, too.
    shapes: HashMap<Node, ExprId>,
    symbols: Vec<SymbolEntry>,
    names: HashMap<String, Symbol>,
}

#[derive(Clone, Debug)]
struct Entry {
    node: Node,
    shape: ExprId,
    /// Length of the longest path down to a leaf.
    height: u32,
    /// The symbols that occur in the node, one bit each.
    symbols: Box<[u64]>,
}

#[derive(Clone, Debug)]
struct SymbolEntry {
    name: String,
    /// The symbol of which this one is a version; itself if it is the first.
    first: Symbol,
    version: u32,
}

impl Graph {
    /// A graph without expressions.
    #[must_use]
    pub fn new() -> Self {
        Graph::default()
    }

    /// The symbol of that name; created when the name is new.
    pub fn symbol(&mut self, name: &str) -> Symbol {
        let fresh = Symbol(next_index(self.symbols.len()));
        self.insert_symbol(name, fresh, 0)
    }

    /// Another version of the same quantity, say λ at the end of a step next to λ at its beginning.
    ///
    /// Versions are neighbours in the structural order: replacing one by another changes no order
    /// of operations, so that an expression is evaluated alike at both ends of a step. If the name
    /// exists already, its symbol is returned as it is.
    pub fn version(&mut self, of: Symbol, name: &str) -> Symbol {
        let first = self.symbols[of.index()].first;
        let versions = self
            .symbols
            .iter()
            .filter(|entry| entry.first == first)
            .count();
        self.insert_symbol(name, first, next_index(versions))
    }

    fn insert_symbol(&mut self, name: &str, first: Symbol, version: u32) -> Symbol {
        if let Some(&symbol) = self.names.get(name) {
            return symbol;
        }
        let symbol = Symbol(next_index(self.symbols.len()));
        self.symbols.push(SymbolEntry {
            name: name.to_owned(),
            first,
            version,
        });
        self.names.insert(name.to_owned(), symbol);
        symbol
    }

    /// The name that the symbol was created with.
    #[must_use]
    pub fn name(&self, symbol: Symbol) -> &str {
        &self.symbols[symbol.index()].name
    }

    /// The symbol as an expression.
    pub fn variable(&mut self, symbol: Symbol) -> ExprId {
        self.intern(Node::Variable(symbol))
    }

    /// A constant.
    pub fn number(&mut self, number: impl Into<Number>) -> ExprId {
        self.intern(Node::Number(number.into()))
    }

    /// An integer constant.
    pub fn integer(&mut self, value: i64) -> ExprId {
        self.number(value)
    }

    /// `function(x)`; exact values such as `ln 1 = 0` are folded, others never.
    pub fn apply(&mut self, function: Function, x: ExprId) -> ExprId {
        match self
            .as_number(x)
            .and_then(|argument| function.exact_value(argument))
        {
            Some(value) => self.number(value),
            None => self.intern(Node::Apply(function, x)),
        }
    }

    /// The node of an expression.
    #[must_use]
    pub fn node(&self, e: ExprId) -> &Node {
        &self.entries[e.index()].node
    }

    /// The value of an expression that is a constant.
    #[must_use]
    pub fn as_number(&self, e: ExprId) -> Option<Number> {
        if let Node::Number(number) = self.node(e) {
            Some(*number)
        } else {
            None
        }
    }

    /// Whether the symbol occurs in the expression.
    #[must_use]
    pub fn depends_on(&self, e: ExprId, symbol: Symbol) -> bool {
        let (word, bit) = position(symbol);
        self.entries[e.index()]
            .symbols
            .get(word)
            .is_some_and(|bits| bits & bit != 0)
    }

    /// Number of distinct nodes in the expression.
    #[must_use]
    pub fn size(&self, e: ExprId) -> usize {
        self.reachable(e, |_| true).len()
    }

    /// The distinct nodes of the expression for which `keep` holds, operands before their users.
    ///
    /// The search descends only into nodes for which `keep` holds, without recursion.
    pub(crate) fn reachable(&self, e: ExprId, keep: impl Fn(ExprId) -> bool) -> Vec<ExprId> {
        let mut seen = vec![false; e.index() + 1];
        let mut pending = vec![e];
        let mut found = Vec::new();
        while let Some(id) = pending.pop() {
            if !std::mem::replace(&mut seen[id.index()], true) && keep(id) {
                found.push(id);
                self.node(id)
                    .for_each_operand(|operand| pending.push(operand));
            }
        }
        found.sort_unstable();
        found
    }

    /// The nodes of the expression in which one of the symbols occurs, operands before users.
    pub(crate) fn dependents(&self, e: ExprId, symbols: &[Symbol]) -> Vec<ExprId> {
        self.reachable(e, |id| {
            symbols.iter().any(|&symbol| self.depends_on(id, symbol))
        })
    }

    /// The shape of an expression: equal for expressions that differ in versions of symbols only.
    pub(crate) fn shape(&self, e: ExprId) -> ExprId {
        self.entries[e.index()].shape
    }

    /// Length of the longest path from the expression down to a leaf.
    pub(crate) fn height(&self, e: ExprId) -> u32 {
        self.entries[e.index()].height
    }

    /// Rank of a symbol in the structural order: first by quantity, then by version.
    pub(crate) fn rank(&self, symbol: Symbol) -> (Symbol, u32) {
        let entry = &self.symbols[symbol.index()];
        (entry.first, entry.version)
    }

    /// The id of a node that is in canonical form.
    pub(crate) fn intern(&mut self, node: Node) -> ExprId {
        if let Some(&id) = self.ids.get(&node) {
            return id;
        }
        let id = ExprId(next_index(self.entries.len()));
        let fresh = ExprId(next_index(self.shapes.len()));
        let shape = node.map(
            |symbol| self.symbols[symbol.index()].first,
            |operand| self.entries[operand.index()].shape,
        );
        let shape = *self.shapes.entry(shape).or_insert(fresh);
        let symbols = self.symbols_of(&node);
        let mut height = 0;
        node.for_each_operand(|operand| height = height.max(self.height(operand) + 1));
        self.entries.push(Entry {
            node: node.clone(),
            shape,
            height,
            symbols,
        });
        self.ids.insert(node, id);
        id
    }

    fn symbols_of(&self, node: &Node) -> Box<[u64]> {
        let mut bits = Vec::new();
        let mut unite = |words: &[u64]| {
            bits.resize(bits.len().max(words.len()), 0);
            bits.iter_mut()
                .zip(words)
                .for_each(|(bit, word)| *bit |= word);
        };
        if let Node::Variable(symbol) = node {
            let (word, bit) = position(*symbol);
            let mut words = vec![0; word + 1];
            words[word] = bit;
            unite(&words);
        }
        node.for_each_operand(|operand| unite(&self.entries[operand.index()].symbols));
        bits.into_boxed_slice()
    }
}

/// Word and bit of a symbol in a set of symbols.
fn position(symbol: Symbol) -> (usize, u64) {
    (symbol.index() / 64, 1 << (symbol.index() % 64))
}

/// The index of the next element of a list of `len`.
fn next_index(len: usize) -> u32 {
    u32::try_from(len).expect("a graph has fewer than 2^32 nodes")
}

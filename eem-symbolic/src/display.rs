//! Expressions as text: names as the user wrote them, `*` never omitted, parentheses only where needed.

mod fraction;
mod render;
mod text;

use std::collections::{HashMap, HashSet};
use std::fmt::Write as _;

use crate::graph::Graph;
use crate::node::{ExprId, Node};
use render::render;
use text::Text;

/// Expressions of more nodes than this, repetitions counted, are abbreviated: about a screen.
const SPELLED_OUT: u64 = 500;

/// The expression as a formula.
///
/// Powers are written `^`, square roots `sqrt`, functions by [`Function::name`], divided
/// differences `f[a, b]` and `f[a, b, b]`. Sums begin with a positive term if there is one;
/// factors of a negative power form the denominator.
///
/// A formula of more than 500 operations and operands names repeated parts, as in `t1*t1 + t1 where t1 = …`,
/// one definition per line, so that the length of the text follows the size of the graph.
///
/// [`Function::name`]: crate::Function::name
///
/// ```
/// use eem_symbolic::{Graph, format};
///
/// let mut graph = Graph::new();
/// let (k, x) = (graph.symbol("k"), graph.symbol("x"));
/// let (k, x) = (graph.variable(k), graph.variable(x));
/// let (half, one) = (graph.number(0.5), graph.integer(1));
/// let stretch = graph.sub(x, one);
/// let square = graph.powi(stretch, 2);
/// let psi = graph.product(&[half, k, square]);
/// assert_eq!(format(&graph, psi), "0.5*k*(x - 1)^2");
/// ```
#[must_use]
pub fn format(graph: &Graph, e: ExprId) -> String {
    let nodes = graph.reachable(e, |_| true);
    let named = repeated(graph, e, &nodes);
    let mut texts = HashMap::new();
    let mut definitions = String::new();
    for &id in &nodes {
        let text = render(graph, id, &texts);
        if named.contains(&id) {
            let name = format!("t{}", definitions.lines().count() + 1);
            let _ = write!(definitions, "\n{name} = {}", text.text);
            texts.insert(id, Text::atom(name));
        } else {
            texts.insert(id, text);
        }
    }
    let formula = texts.remove(&e).map(|text| text.text).unwrap_or_default();
    if definitions.is_empty() {
        formula
    } else {
        format!("{formula}\nwhere{definitions}")
    }
}

/// The subexpressions that get a name: none in a short formula, every repeated one in a long one.
fn repeated(graph: &Graph, e: ExprId, nodes: &[ExprId]) -> HashSet<ExprId> {
    let mut lengths: HashMap<ExprId, u64> = HashMap::new();
    let mut uses: HashMap<ExprId, u32> = HashMap::new();
    for &id in nodes {
        let mut length: u64 = 1;
        graph.node(id).for_each_operand(|operand| {
            length = length.saturating_add(lengths[&operand]);
            *uses.entry(operand).or_default() += 1;
        });
        lengths.insert(id, length);
    }
    if lengths[&e] <= SPELLED_OUT {
        return HashSet::new();
    }
    let leaf = |id: &ExprId| matches!(graph.node(*id), Node::Number(_) | Node::Variable(_));
    nodes
        .iter()
        .copied()
        .filter(|id| uses.get(id).is_some_and(|&n| n > 1) && !leaf(id))
        .collect()
}

//! Breaks formulas into lines.

/// Columns of a line in a formula block.
const WIDTH: usize = 96;
/// Columns by which the second line of a formula is indented.
const INDENT: usize = 4;

/// A formula in lines; a long one comes with a list of definitions, one per line.
pub(super) fn lines(formula: &str) -> Vec<String> {
    let mut lines = Vec::new();
    for line in formula.lines() {
        wrap(line, &mut lines);
    }
    lines
}

/// Appends a formula, broken in front of operators into lines of at most [`WIDTH`] columns where
/// possible: outside of parentheses rather than inside, sums rather than products, late rather than
/// early. What is deeper in parentheses is indented more.
fn wrap(formula: &str, lines: &mut Vec<String>) {
    let mut rest: Vec<char> = formula.chars().collect();
    let (mut indent, mut depth) = (0, 0);
    while rest.len() > WIDTH {
        let Some(Break {
            deeper,
            product,
            at,
        }) = break_point(&rest, indent)
        else {
            break;
        };
        depth += deeper;
        indent = INDENT * usize::try_from(1 + depth).unwrap_or(1);
        if product {
            indent += INDENT / 2;
        }
        lines.push(rest[..at].iter().collect());
        let tail = rest.split_off(at).into_iter().skip_while(|&c| c == ' ');
        // The operator leads the next line.
        rest = vec![' '; indent];
        rest.extend(tail);
    }
    lines.push(rest.into_iter().collect());
}

/// A place to break a line.
#[derive(Clone, Copy)]
struct Break {
    /// Number of parentheses open there, minus the number at the start.
    deeper: i32,
    /// Whether it is in front of `*`, not of `+` or `-`.
    product: bool,
    at: usize,
}

/// The best place to break a line; the first one if all are too late.
fn break_point(line: &[char], indent: usize) -> Option<Break> {
    let mut deeper = 0;
    let mut best: Option<Break> = None;
    for at in indent + 1..line.len() {
        if at > WIDTH && best.is_some() {
            break;
        }
        let product = match line[at..] {
            [' ', '+' | '-', ' ', ..] => false,
            ['*', ..] => true,
            [c, ..] => {
                deeper += i32::from("([".contains(c)) - i32::from(")]".contains(c));
                continue;
            }
            [] => break,
        };
        // In the first half of a line, break outside of parentheses only; before `*`, not in the first
        // quarter.
        let early = if product { 4 * at <= WIDTH } else { false };
        let late = 2 * at > WIDTH;
        let better = |best: Break| (deeper, product) <= (best.deeper, best.product);
        if (late || (deeper <= 0 && !early)) && best.is_none_or(better) {
            best = Some(Break {
                deeper,
                product,
                at,
            });
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::{WIDTH, wrap};

    #[test]
    fn long_formulas_are_broken_at_operators() {
        let terms: Vec<String> = (0..60).map(|i| format!("term{i}")).collect();
        let formula = terms.join(" + ");
        let mut lines = Vec::new();
        wrap(&formula, &mut lines);
        assert!(lines.len() > 1);
        assert!(lines.iter().all(|line| line.chars().count() <= WIDTH));
        let words: Vec<&str> = lines
            .iter()
            .flat_map(|line| line.split_whitespace())
            .collect();
        assert_eq!(words.join(" "), formula);
    }
}

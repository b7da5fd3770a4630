//! Finds what a user most likely meant by a name that does not exist.

/// The candidate with the smallest edit distance to `name`, if it is close enough to be a slip.
///
/// Close enough is one edit per three letters, at least one; letters that differ in case only
/// count as equal. The first of equally close candidates wins, so that the answer does not depend
/// on anything but the order of the candidates.
pub(crate) fn nearest<'c>(
    name: &str,
    candidates: impl IntoIterator<Item = &'c str>,
) -> Option<&'c str> {
    let limit = (name.chars().count() / 3).max(1);
    candidates
        .into_iter()
        .map(|candidate| (edit_distance(name, candidate), candidate))
        .filter(|&(distance, candidate)| distance <= limit && distance < candidate.chars().count())
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}

/// Number of insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`
/// (optimal string alignment distance), upper and lower case being equal.
fn edit_distance(a: &str, b: &str) -> usize {
    let a: Vec<char> = a.to_lowercase().chars().collect();
    let b: Vec<char> = b.to_lowercase().chars().collect();
    let mut before = vec![0; b.len() + 1];
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i; b.len() + 1];
        for j in 1..=b.len() {
            let substitution = last[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            row[j] = substitution.min(last[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                row[j] = row[j].min(before[j - 2] + 1);
            }
        }
        before = last;
        last = row;
    }
    last[b.len()]
}

#[cfg(test)]
mod tests {
    use super::{edit_distance, nearest};

    #[test]
    fn edit_distance_counts_edits_and_swaps() {
        assert_eq!(edit_distance("lambda", "lambda"), 0);
        assert_eq!(edit_distance("lamda", "lambda"), 1);
        assert_eq!(edit_distance("labmda", "lambda"), 1);
        assert_eq!(edit_distance("Lambda", "lambda"), 0);
        assert_eq!(edit_distance("", "ln"), 2);
    }

    #[test]
    fn slips_are_found_and_other_words_are_not() {
        let names = ["stiffness", "theta", "theta_ref", "mu"];
        assert_eq!(nearest("stifness", names), Some("stiffness"));
        assert_eq!(nearest("tehta", names), Some("theta"));
        assert_eq!(nearest("Mu", names), Some("mu"));
        assert_eq!(nearest("capacity", names), None);
        assert_eq!(nearest("x", names), None);
    }
}

//! Sets of members as ranges of their places in the ascending order of ids.

use std::ops::Range;

/// A set of places: ranges in ascending order that do not touch.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Places(Vec<Range<usize>>);

impl Places {
    /// One range.
    pub(crate) fn one(range: Range<usize>) -> Self {
        Self::new(Vec::from([range]))
    }

    /// The union of ranges in any order.
    pub(crate) fn new(mut ranges: Vec<Range<usize>>) -> Self {
        ranges.retain(|range| !range.is_empty());
        ranges.sort_by_key(|range| range.start);
        let mut joined: Vec<Range<usize>> = Vec::new();
        for range in ranges {
            match joined.last_mut() {
                Some(last) if range.start <= last.end => last.end = last.end.max(range.end),
                _ => joined.push(range),
            }
        }
        Self(joined)
    }

    /// How many there are.
    pub(crate) fn count(&self) -> usize {
        self.0.iter().map(Range::len).sum()
    }

    /// Those that are in `self` and not in `other`.
    pub(crate) fn without(&self, other: &Self) -> Self {
        let mut left = Vec::new();
        let mut others = other.0.iter().peekable();
        for range in &self.0 {
            let mut start = range.start;
            while let Some(hole) = others.peek().filter(|hole| hole.start < range.end) {
                if hole.start > start {
                    left.push(start..hole.start);
                }
                start = start.max(hole.end);
                if hole.end > range.end {
                    break;
                }
                others.next();
            }
            if start < range.end {
                left.push(start..range.end);
            }
        }
        Self(left)
    }

    /// Those that are in both.
    pub(crate) fn within(&self, other: &Self) -> Self {
        self.without(&self.without(other))
    }

    /// Whether some place of a range is among them.
    pub(crate) fn touches(&self, range: &Range<usize>) -> bool {
        let after = self.0.partition_point(|own| own.end <= range.start);
        self.0.get(after).is_some_and(|own| own.start < range.end)
    }

    /// The ranges in ascending order.
    pub(crate) fn ranges(&self) -> &[Range<usize>] {
        &self.0
    }

    /// Each place in ascending order.
    pub(crate) fn iter(&self) -> impl Iterator<Item = usize> + '_ {
        self.0.iter().cloned().flatten()
    }
}

/// Adds a place to ranges in ascending order.
pub(crate) fn extend(ranges: &mut Vec<Range<usize>>, place: usize) {
    match ranges.last_mut() {
        Some(last) if last.end == place => last.end += 1,
        _ => ranges.push(place..place + 1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_are_those_of_their_elements() {
        // All sets of eight elements against all others, as bits.
        let set = |bits: u32| {
            let elements = (0..8).filter(|&place| bits >> place & 1 == 1);
            Places::new(elements.map(|place| place..place + 1).collect())
        };
        for one in 0..256 {
            for other in 0..256 {
                assert_eq!(set(one).without(&set(other)), set(one & !other));
                assert_eq!(set(one).within(&set(other)), set(one & other));
            }
            assert_eq!(set(one).count(), one.count_ones() as usize);
            for (start, end) in [(0, 1), (2, 5), (3, 8)] {
                let some = (start..end).any(|place| one >> place & 1 == 1);
                assert_eq!(set(one).touches(&(start..end)), some);
            }
            let back = set(one).iter().fold(0, |bits, place| bits | 1 << place);
            assert_eq!(back, one);
        }
    }
}

//! Which members a process runs.

use std::fmt;
use std::ops::Range;

use crate::error::SweepError;
use crate::inputs::Inputs;
use crate::places::Places;

/// The most ids of a list, which is kept in memory: 128 MB.
const LONGEST: u64 = 1 << 24;

/// The members that a process runs. Results and merged tables do not depend on it.
///
/// ```
/// use eem::sweep::Selection;
///
/// assert_eq!(Selection::shard("2/8")?, Selection::Shard { index: 2, count: 8 });
/// assert_eq!(Selection::range("10..20")?, Selection::Range(10..20));
/// assert_eq!(Selection::list("3,7,10-12")?, Selection::Members(vec![3, 7, 10, 11, 12]));
/// # Ok::<(), String>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Selection {
    /// All members.
    #[default]
    All,
    /// One of `count` shards of equal size, to within one member; counted from 0.
    Shard {
        /// The index of the shard.
        index: u64,
        /// The number of shards.
        count: u64,
    },
    /// The members whose ids are in a range.
    Range(Range<u64>),
    /// The members with these ids.
    Members(Vec<u64>),
}

impl Selection {
    /// The shard `i/n`, counted from 0.
    ///
    /// # Errors
    ///
    /// The expected form.
    pub fn shard(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').map(|(i, n)| (i.parse(), n.parse()));
        match numbers {
            Some((Ok(index), Ok(count))) if index < count => Ok(Self::Shard { index, count }),
            Some((Ok(index), Ok(count))) => Err(SweepError::NoShard { index, count }.to_string()),
            _ => Err("expected i/n with i from 0 to n - 1, for example 0/8".to_owned()),
        }
    }

    /// The ids from `a` to below `b`, from `a..b`.
    ///
    /// # Errors
    ///
    /// The expected form.
    pub fn range(text: &str) -> Result<Self, String> {
        let numbers = text.split_once("..").map(|(a, b)| (a.parse(), b.parse()));
        match numbers {
            Some((Ok(start), Ok(end))) if start < end => Ok(Self::Range(start..end)),
            _ => Err("expected a..b with a < b, for example 0..1000".to_owned()),
        }
    }

    /// Ids and inclusive ranges of ids, as in Slurm and `cut`.
    ///
    /// # Errors
    ///
    /// The expected form.
    pub fn list(text: &str) -> Result<Self, String> {
        let mut ids = Vec::new();
        for piece in text.split(',') {
            let (first, last) = piece.split_once('-').unwrap_or((piece, piece));
            match (first.trim().parse::<u64>(), last.trim().parse::<u64>()) {
                (Ok(first), Ok(last)) if first <= last => {
                    if last - first >= LONGEST - ids.len() as u64 {
                        return Err(format!(
                            "`{piece}`: a list has at most {LONGEST} ids; choose more by a range, a..b"
                        ));
                    }
                    ids.extend(first..=last);
                }
                _ => return Err(format!("`{piece}`: expected ids, for example 3,7,10-12")),
            }
        }
        ids.sort_unstable();
        ids.dedup();
        Ok(Self::Members(ids))
    }

    /// The places of the members.
    pub(crate) fn places(&self, inputs: &Inputs) -> Result<Places, SweepError> {
        let members = inputs.members();
        let places = match self {
            Self::All => Places::one(0..members),
            &Self::Shard { index, count } => {
                if index >= count {
                    return Err(SweepError::NoShard { index, count });
                }
                let bound = |shard: u64| {
                    let place = u128::from(shard) * members as u128 / u128::from(count);
                    usize::try_from(place).unwrap_or(members)
                };
                Places::one(bound(index)..bound(index + 1))
            }
            &Self::Range(Range { start, end }) => {
                let places = inputs.place(start)..inputs.place(end);
                if places.is_empty() {
                    return Err(SweepError::NoMembers {
                        start,
                        end,
                        first: inputs.id(0),
                        last: inputs.id(members - 1),
                    });
                }
                Places::one(places)
            }
            Self::Members(ids) => {
                let place = |&member: &u64| {
                    let place = inputs.place(member);
                    if place < members && inputs.id(place) == member {
                        return Ok(place..place + 1);
                    }
                    Err(SweepError::UnknownMember {
                        member,
                        first: inputs.id(0),
                        last: inputs.id(members - 1),
                    })
                };
                Places::new(ids.iter().map(place).collect::<Result<_, _>>()?)
            }
        };
        Ok(places)
    }
}

/// A name for files: `shard-2-of-8`.
impl fmt::Display for Selection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::All => f.write_str("all"),
            Self::Shard { index, count } => write!(f, "shard-{index}-of-{count}"),
            Self::Range(range) => write!(f, "range-{}-{}", range.start, range.end),
            Self::Members(ids) => {
                let first = ids.first().copied().unwrap_or_default();
                let last = ids.last().copied().unwrap_or_default();
                write!(f, "members-{first}-{last}-{}", ids.len())
            }
        }
    }
}

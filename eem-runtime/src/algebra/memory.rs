//! The check, before memory is reserved, that linear systems fit in it: the size of the factors is known from the pattern.

use eem_mesh::memory::available_for;

/// The most memory that a linear system may take.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MemoryLimit(Option<u64>);

/// A linear system needs more memory than available or allowed.
///
/// ```
/// let refused = eem::TooLarge {
///     unknowns: 300,
///     needed: 720_000,
///     available: Some(500_000),
/// };
/// assert!(refused.to_string().contains("720000 bytes, and 500000 are available"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the tangent of {unknowns} unknowns and its factors take {needed} bytes, {}: use fewer cells, cells with fewer nodes, a larger limit (`Scene::limit_memory`) or a machine with more memory",
    available.map_or_else(|| "which the system refuses".to_owned(), |most| format!("and {most} are available"))
)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub struct TooLarge {
    /// Rows of the matrix.
    pub unknowns: usize,
    /// Memory needed by the matrix and its factors, bytes.
    pub needed: u64,
    /// Memory available, or the [limit](crate::Scene::limit_memory), bytes; `None` if the allocation failed
    /// although there seemed to be enough.
    pub available: Option<u64>,
}

impl MemoryLimit {
    /// The memory that the machine has available.
    pub(crate) const NONE: Self = Self(None);

    /// A limit in bytes, whatever the machine has; `None` stands for the memory it has available.
    pub(crate) const fn new(bytes: Option<u64>) -> Self {
        Self(bytes)
    }

    /// An error if a system of this many unknowns needs more bytes than the limit.
    pub(crate) fn check(self, unknowns: usize, needed: u64) -> Result<(), TooLarge> {
        let available = self.0.or_else(|| available_for(needed));
        match available {
            Some(most) if needed > most => Err(TooLarge {
                unknowns,
                needed,
                available,
            }),
            _ => Ok(()),
        }
    }
}

/// The size of rows times columns of numbers, bytes.
pub(crate) fn bytes([rows, columns]: [usize; 2]) -> u64 {
    let numbers = rows.saturating_mul(columns);
    u64::try_from(numbers.saturating_mul(size_of::<f64>())).unwrap_or(u64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_is_the_most_that_is_taken() {
        let limit = MemoryLimit::new(Some(800));
        assert_eq!(bytes([10, 10]), 800);
        assert_eq!(limit.check(10, 800), Ok(()));
        let refused = TooLarge {
            unknowns: 10,
            needed: 801,
            available: Some(800),
        };
        assert_eq!(limit.check(10, 801), Err(refused));
    }

    // More than any machine has.
    #[test]
    #[cfg(feature = "sparse")]
    fn large_systems_are_compared_with_the_memory_of_the_machine() {
        assert_eq!(MemoryLimit::NONE.check(1, 1 << 28), Ok(()));
        assert!(MemoryLimit::NONE.check(1, u64::MAX).is_err());
    }
}

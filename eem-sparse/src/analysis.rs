//! The order of elimination of a pattern, and the memory that its factors need, before it is reserved.

use crate::branch::Branch;
use crate::division::Division;
use crate::error::Error;
use crate::fronts::{Extent, Fronts};
use crate::pattern::Pattern;

/// A pattern that has been ordered and analysed.
///
/// ```
/// use eem_sparse::{Analysis, Pattern, Solver};
///
/// let chain = Pattern::new(40, |pair| (1..40).for_each(|at| pair(at - 1, at)));
/// let analysis = Analysis::new(&chain)?;
/// assert!(analysis.bytes() >= 118 * 8);
/// assert_eq!(Solver::reserve(analysis)?.factor_entries(), 118);
/// # Ok::<(), eem_sparse::Error>(())
/// ```
#[derive(Debug)]
pub struct Analysis {
    pub(crate) pattern: Pattern,
    pub(crate) fronts: Fronts,
}

impl Analysis {
    /// Orders and analyses a pattern.
    ///
    /// # Errors
    ///
    /// [`Error::OutOfMemory`].
    pub fn new(pattern: &Pattern) -> Result<Self, Error> {
        Ok(Self {
            fronts: Fronts::new(pattern).ok_or(Error::OutOfMemory)?,
            pattern: pattern.clone(),
        })
    }

    /// The memory of the factors and of the elimination that finds them, bytes: all that grows faster than the
    /// pattern.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        let (fronts, length) = (&self.fronts, self.pattern.block_length());
        let Extent { lower, upper, .. } = fronts.extent(0..fronts.len(), length);
        let stacks = Branch::stacks(fronts, &Division::new(fronts, length), length);
        let numbers = u64::try_from(lower.saturating_add(upper).saturating_add(stacks));
        numbers.unwrap_or(u64::MAX).saturating_mul(NUMBER)
    }
}

/// Bytes of a number.
const NUMBER: u64 = 8;

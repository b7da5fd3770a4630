//! The sparsity pattern of a matrix; without the feature `sparse` a stand-in in which every entry can differ from zero.

#[cfg(feature = "sparse")]
pub(crate) use eem_sparse::Pattern;
#[cfg(not(feature = "sparse"))]
pub(crate) use full::Pattern;

#[cfg(not(feature = "sparse"))]
mod full {
    use core::convert::Infallible;

    /// A full matrix, of which only the number of unknowns matters.
    #[derive(Debug)]
    pub(crate) struct Pattern {
        unknowns: usize,
    }

    impl Pattern {
        /// A matrix of this many unknowns, whichever of them are coupled.
        pub(crate) fn new(unknowns: usize, _: impl Fn(&mut dyn FnMut(usize, usize))) -> Self {
            Self { unknowns }
        }

        /// The pattern with a block of `length` rows for each entry.
        #[expect(
            clippy::unnecessary_wraps,
            reason = "the sparse pattern has blocks of a few sizes only"
        )]
        pub(crate) fn in_blocks(self, length: usize) -> Result<Self, Infallible> {
            let unknowns = self.unknowns * length;
            Ok(Self { unknowns })
        }

        /// The pattern for several sets of the unknowns.
        pub(crate) fn repeated(self, sets: usize) -> Self {
            let unknowns = sets * self.unknowns;
            Self { unknowns }
        }

        /// Number of rows and of columns.
        pub(crate) fn unknowns(&self) -> usize {
            self.unknowns
        }
    }
}

//! Linear systems: small ones by dense elimination, large ones by `eem-sparse`.

pub(crate) mod bivector;
pub(crate) mod jacobi;
pub(crate) mod lu;
pub(crate) mod memory;
pub(crate) mod pattern;
pub(crate) mod system;
pub(crate) mod threads;

/// The vector with these entries: `core::array::from_fn` for numbers, in a tenth of its code.
#[inline]
pub(crate) fn vector<T: Copy + Default, const N: usize>(
    mut entry: impl FnMut(usize) -> T,
) -> [T; N] {
    let mut all = [T::default(); N];
    for (index, number) in all.iter_mut().enumerate() {
        *number = entry(index);
    }
    all
}

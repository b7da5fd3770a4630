//! Contributions of an element go to their places in the global systems; anchors have none.

use super::site::Site;
use crate::element::kinematics::{Arms, Kinematics};
use crate::number::scalar::Real;

impl<K: Kinematics<S, D>, S: Real, const D: usize> Site<K, S, D> {
    /// Subtracts something per arm from what begins at the place of its node, and adds it to what
    /// begins at that of the first node.
    #[inline]
    pub(super) fn subtract_arms(
        &self,
        arms: &Arms<K, S, D>,
        places: &K::PerNode<u32>,
        target: &mut [S],
    ) {
        for (i, arm) in arms.as_ref().iter().enumerate() {
            if self.is_mass[i + 1] {
                subtract(target, places[i + 1] as usize, arm);
            }
            if self.is_mass[0] {
                let entries = run_mut::<_, D>(target, places[0] as usize);
                for (sum, &entry) in entries.iter_mut().zip(arm) {
                    *sum += entry;
                }
            }
        }
    }

    /// Adds the block of the arms to two nodes: to the rows and columns of the nodes, and with the
    /// other sign to those of the first node.
    #[inline]
    pub(super) fn add_block(&self, [i, j]: [usize; 2], block: &[[S; D]; D], values: &mut [S]) {
        if self.is_mass[i] && self.is_mass[j] {
            self.add_rows(values, [i, j], block);
        }
        if self.is_mass[0] {
            self.add_rows(values, [0, 0], block);
            if self.is_mass[i] {
                self.subtract_rows(values, [i, 0], block);
            }
            if self.is_mass[j] {
                self.subtract_rows(values, [0, j], block);
            }
        }
    }

    /// Adds to the block of two nodes, row by row.
    #[inline]
    fn add_rows(&self, values: &mut [S], [i, j]: [usize; 2], block: &[[S; D]; D]) {
        let mut place = self.blocks[i][j] as usize;
        for entries in block {
            for (value, &entry) in run_mut::<_, D>(values, place).iter_mut().zip(entries) {
                *value += entry;
            }
            place += self.strides[i] as usize;
        }
    }

    /// Subtracts from the block of two nodes, row by row.
    #[inline]
    fn subtract_rows(&self, values: &mut [S], [i, j]: [usize; 2], block: &[[S; D]; D]) {
        let mut place = self.blocks[i][j] as usize;
        for entries in block {
            subtract(values, place, entries);
            place += self.strides[i] as usize;
        }
    }

    /// Adds to a column, given by the entries of the first row of each node, something per arm, and
    /// subtracts it from the rows of the first node.
    #[expect(clippy::inline_always, reason = "a few numbers in registers")]
    #[inline(always)]
    pub(super) fn add_column(
        &self,
        column: &K::PerNode<u32>,
        arms: &Arms<K, S, D>,
        values: &mut [S],
    ) {
        for (i, arm) in arms.as_ref().iter().enumerate() {
            if self.is_mass[i + 1] {
                let mut place = column[i + 1] as usize;
                for &entry in arm {
                    values[place] += entry;
                    place += self.strides[i + 1] as usize;
                }
            }
            if self.is_mass[0] {
                let mut place = column[0] as usize;
                for &entry in arm {
                    values[place] -= entry;
                    place += self.strides[0] as usize;
                }
            }
        }
    }
}

/// Subtracts from consecutive entries.
#[inline]
pub(super) fn subtract<S: Real, const D: usize>(values: &mut [S], place: usize, entries: &[S; D]) {
    for (value, &entry) in run_mut::<_, D>(values, place).iter_mut().zip(entries) {
        *value -= entry;
    }
}

/// `D` consecutive entries, with one comparison.
#[inline]
pub(super) fn run<T, const D: usize>(entries: &[T], first: usize) -> &[T; D] {
    match entries.get(first..first + D).map(TryInto::try_into) {
        Some(Ok(run)) => run,
        _ => not_from_the_system(),
    }
}

/// The same, to be written.
#[inline]
fn run_mut<T, const D: usize>(entries: &mut [T], first: usize) -> &mut [T; D] {
    match entries.get_mut(first..first + D).map(TryInto::try_into) {
        Some(Ok(run)) => run,
        _ => not_from_the_system(),
    }
}

#[cold]
fn not_from_the_system() -> ! {
    unreachable!("places and rows come from the system, which has them")
}

//! Columns of numbers from and for the caller: all of them have to be finite.

use crate::error::{Error, Operand};

/// A column of right-hand sides, which lie row by row.
#[derive(Clone, Copy)]
pub(crate) struct Column<'a> {
    pub(crate) rows: &'a [f64],
    /// The number of columns, and which of them it is.
    pub(crate) width: usize,
    pub(crate) at: usize,
}

impl Column<'_> {
    /// The numbers of a node.
    #[inline]
    pub(crate) fn of<const L: usize>(self, node: usize) -> [f64; L] {
        let mut numbers = [0.0; L];
        for (at, number) in numbers.iter_mut().enumerate() {
            *number = self.rows[(node * L + at) * self.width + self.at];
        }
        numbers
    }

    /// All numbers in the order of elimination.
    pub(crate) fn copy_to<const L: usize>(self, x: &mut [[f64; L]], order: &[u32]) {
        for (x, &node) in x.iter_mut().zip(order) {
            *x = self.of(node as usize);
        }
    }
}

/// An error with the position of the first number that is not finite.
pub(crate) fn all_finite(
    what: Operand,
    mut numbers: impl Iterator<Item = f64>,
) -> Result<(), Error> {
    match numbers.position(|number| !number.is_finite()) {
        Some(position) => Err(Error::NotFinite { what, position }),
        None => Ok(()),
    }
}

/// Writes a solution in the order of elimination to a column of `right`, of this width, in that of the unknowns.
pub(crate) fn store<const L: usize>(
    x: &[[f64; L]],
    order: &[u32],
    (right, width, column): (&mut [f64], usize, usize),
) -> Result<(), Error> {
    if !x.as_flattened().iter().all(|x| x.is_finite()) {
        let mut natural = order.iter().zip(x);
        let found = natural.find_map(|(&node, x)| {
            let at = x.iter().position(|x| !x.is_finite())?;
            Some(node as usize * L + at)
        });
        return Err(Error::NotFinite {
            what: Operand::Solution,
            position: found.unwrap_or(0),
        });
    }
    for (x, &node) in x.iter().zip(order) {
        for (at, &x) in x.iter().enumerate() {
            right[(node as usize * L + at) * width + column] = x;
        }
    }
    Ok(())
}

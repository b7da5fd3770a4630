//! Columns of numbers from and for the caller: all of them have to be finite.

use crate::error::{Error, Operand};

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

/// Writes a solution in the order of elimination to a column in that of the unknowns.
pub(crate) fn store<const W: usize, const L: usize>(
    x: &[[f64; L]],
    order: &[u32],
    (right, column): (&mut [[f64; W]], usize),
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
        let rows = &mut right[node as usize * L..][..L];
        for (row, &x) in rows.iter_mut().zip(x) {
            row[column] = x;
        }
    }
    Ok(())
}

//! One matrix with any number of right-hand sides, and its products.

use super::{LinearSystem, MOST_FIXED, Storage};
use crate::algebra::lu::{self, Singular};

impl LinearSystem<1> {
    /// Replaces B by `B − A x`.
    pub(crate) fn subtract_product(&mut self, x: &[[f64; 1]]) {
        let n = self.unknowns;
        let values = &self.values;
        let rows = self.right[..n].iter_mut().enumerate();
        #[cfg(feature = "sparse")]
        if let Storage::Sparse(sparse) = &self.storage {
            for (row, [right]) in rows {
                for (place, column) in sparse.pattern().entries_of(row) {
                    *right -= values[place] * x[column][0];
                }
            }
            return;
        }
        for (row, [right]) in rows {
            for (&value, [x]) in values[row * n..].iter().zip(&x[..n]) {
                *right -= value * *x;
            }
        }
    }

    /// Overwrites right-hand sides with their solutions, except the scratch rows of anchors, and A with zeros. A is
    /// eliminated once, or, with at most [`MOST_FIXED`] unknowns, once for every four right-hand sides.
    pub(crate) fn solve_each<'a>(
        &mut self,
        columns: impl Iterator<Item = &'a mut Vec<[f64; 1]>>,
    ) -> Result<(), Singular> {
        let n = self.unknowns;
        let mut columns = columns.map(|column| &mut column[..n]);
        let values = &mut self.values;
        match &mut self.storage {
            Storage::Fixed { .. } => solve_fixed_each(n, &mut values[..n * n], &mut columns)?,
            Storage::Dense { pivots } => {
                let values = &mut values[..n * n];
                lu::factor(values, pivots)?;
                columns.for_each(|column| lu::solve(values, pivots, column));
                values.fill(0.0);
            }
            #[cfg(feature = "sparse")]
            Storage::Sparse(sparse) => {
                let values = &mut values[..sparse.pattern().entries()];
                let mut factored = sparse.factor(values).map_err(|_| Singular)?;
                columns.try_for_each(|column| {
                    let solved = factored.solve(column);
                    solved.map(drop).map_err(|_| Singular)
                })?;
                values.fill(0.0);
            }
        }
        self.is_clear = true;
        Ok(())
    }
}

/// Overwrites right-hand sides with their solutions, four at a time.
fn solve_fixed_each<'a>(
    unknowns: usize,
    values: &mut [f64],
    columns: &mut impl Iterator<Item = &'a mut [[f64; 1]]>,
) -> Result<(), Singular> {
    const AT_ONCE: usize = 4;
    let mut matrix = [0.0; MOST_FIXED * MOST_FIXED];
    let matrix = &mut matrix[..values.len()];
    matrix.copy_from_slice(values);
    loop {
        let mut some: [Option<&'a mut [[f64; 1]]>; AT_ONCE] =
            core::array::from_fn(|_| columns.next());
        if some[0].is_none() {
            values.fill(0.0);
            return Ok(());
        }
        let mut right = [[0.0; AT_ONCE]; MOST_FIXED];
        for (place, column) in some.iter().enumerate() {
            for (row, value) in right
                .iter_mut()
                .zip(column.iter().flat_map(|own| own.iter()))
            {
                row[place] = value[0];
            }
        }
        values.copy_from_slice(matrix);
        let given = right;
        match unknowns {
            1 => lu::solve_one(values, &given, &mut right)?,
            2 => lu::solve_two(values, &given, &mut right)?,
            _ => lu::solve_fixed(unknowns, values, &mut right[..unknowns])?,
        }
        for (place, column) in some.iter_mut().enumerate() {
            for (row, value) in right
                .iter()
                .zip(column.iter_mut().flat_map(|own| own.iter_mut()))
            {
                value[0] = row[place];
            }
        }
    }
}

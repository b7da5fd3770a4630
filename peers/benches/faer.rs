//! Time and memory of this crate beside the sparse LU of `faer`; see the table in `README.md`.

#![allow(clippy::unwrap_used, reason = "a benchmark fails by panicking")]

#[path = "faer/plain.rs"]
mod plain;
#[path = "../../eem-sparse/tests/support/mod.rs"]
mod support;

use divan::{AllocProfiler, Bencher};
use eem_sparse::Solver;
use plain::{Order, Plain};
use support::{Matrix, Random, lattice, pattern};

#[global_allocator]
static ALLOCATOR: AllocProfiler = AllocProfiler::system();

fn main() {
    divan::main();
}

/// What is solved. Matrices are unsymmetric and diagonally dominant.
#[derive(Clone, Copy, Debug)]
enum Case {
    /// 100,000 nodes in a row, 2 unknowns each.
    Chain,
    /// 316 × 316 nodes with four neighbours, 2 unknowns each.
    Lattice,
    /// 21³ nodes of 20³ hexahedra, with 26 neighbours, 3 unknowns each.
    Hexahedra,
}

const CASES: [Case; 3] = [Case::Chain, Case::Lattice, Case::Hexahedra];

impl Case {
    fn matrix(self) -> Matrix {
        match self {
            Self::Chain => grid([100_000, 1]),
            Self::Lattice => grid([316, 316]),
            Self::Hexahedra => lattice([21, 21, 21], 3),
        }
    }
}

/// A grid in which each node is coupled with four neighbours, 2 unknowns per node.
fn grid([columns, rows]: [usize; 2]) -> Matrix {
    let near = move |node: usize| {
        let column = node % columns;
        let mut near = Vec::new();
        near.extend(node.checked_sub(columns));
        near.extend((column > 0).then(|| node - 1));
        near.push(node);
        near.extend((column + 1 < columns).then_some(node + 1));
        near.extend((node + columns < columns * rows).then_some(node + columns));
        near
    };
    let mut random = Random::new(1);
    Matrix::new(pattern(columns * rows, 2, near), near, |_, _| {
        random.digit()
    })
    .dominant()
}

/// This crate.
#[divan::bench_group(sample_count = 3, sample_size = 1)]
mod ours {
    use super::{Bencher, CASES, Case, Solver};

    #[divan::bench(args = CASES)]
    fn analyse(bencher: Bencher<'_, '_>, case: Case) {
        let matrix = case.matrix();
        bencher.bench_local(|| Solver::new(&matrix.pattern).unwrap());
    }

    #[divan::bench(args = CASES)]
    fn factor(bencher: Bencher<'_, '_>, case: Case) {
        let matrix = case.matrix();
        let values = matrix.values();
        let mut solver = Solver::new(&matrix.pattern).unwrap();
        // The first factorisation touches the memory for the first time.
        solver.factor(&values).unwrap();
        bencher.bench_local(|| {
            solver.factor(&values).unwrap();
        });
    }

    #[divan::bench(args = CASES)]
    fn solve(bencher: Bencher<'_, '_>, case: Case) {
        let matrix = case.matrix();
        let values = matrix.values();
        let mut solver = Solver::new(&matrix.pattern).unwrap();
        let mut factored = solver.factor(&values).unwrap();
        let mut right = vec![[1.0]; matrix.pattern.unknowns()];
        bencher.bench_local(|| factored.solve(&mut right).unwrap());
    }
}

/// `faer` with its order COLAMD.
#[divan::bench_group(sample_count = 3, sample_size = 1)]
mod faer_colamd {
    use super::{Bencher, CASES, Case, Order, Plain};

    #[divan::bench(args = CASES)]
    fn analyse(bencher: Bencher<'_, '_>, case: Case) {
        let plain = Plain::new(&case.matrix(), Order::Colamd);
        bencher.bench_local(|| plain.analyse());
    }

    #[divan::bench(args = CASES)]
    fn factor(bencher: Bencher<'_, '_>, case: Case) {
        super::factor(bencher, case, Order::Colamd);
    }

    #[divan::bench(args = CASES)]
    fn solve(bencher: Bencher<'_, '_>, case: Case) {
        super::solve(bencher, case, Order::Colamd);
    }
}

/// `faer` with minimum degree on the symmetric pattern.
#[divan::bench_group(sample_count = 3, sample_size = 1)]
mod faer_amd {
    use super::{Bencher, CASES, Case, Order};

    #[divan::bench(args = CASES)]
    fn factor(bencher: Bencher<'_, '_>, case: Case) {
        super::factor(bencher, case, Order::Amd);
    }

    #[divan::bench(args = CASES)]
    fn solve(bencher: Bencher<'_, '_>, case: Case) {
        super::solve(bencher, case, Order::Amd);
    }
}

/// `faer` with the order of this crate.
#[divan::bench_group(sample_count = 3, sample_size = 1)]
mod faer_our_order {
    use super::{Bencher, CASES, Case, Order};

    #[divan::bench(args = CASES)]
    fn factor(bencher: Bencher<'_, '_>, case: Case) {
        super::factor(bencher, case, Order::Ours);
    }

    #[divan::bench(args = CASES)]
    fn solve(bencher: Bencher<'_, '_>, case: Case) {
        super::solve(bencher, case, Order::Ours);
    }
}

fn factor(bencher: Bencher<'_, '_>, case: Case, order: Order) {
    let mut plain = Plain::new(&case.matrix(), order);
    bencher.bench_local(|| plain.factor());
}

fn solve(bencher: Bencher<'_, '_>, case: Case, order: Order) {
    let mut plain = Plain::new(&case.matrix(), order);
    plain.factor();
    let mut right = vec![1.0; plain.unknowns()];
    bencher.bench_local(|| plain.solve(&mut right));
}

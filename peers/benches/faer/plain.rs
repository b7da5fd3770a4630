//! The sparse LU of `faer`, analysed once and factored many times, with any order of columns.

use eem_sparse::Solver;
use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::perm::{Perm, PermRef};
use faer::sparse::linalg::lu::supernodal::{
    self, SupernodalLu, SymbolicSupernodalLu, factorize_supernodal_numeric_lu,
    factorize_supernodal_numeric_lu_scratch, factorize_supernodal_symbolic_lu,
    factorize_supernodal_symbolic_lu_scratch,
};
use faer::sparse::linalg::lu::{LuSymbolicParams, SymbolicLu, factorize_symbolic_lu};
use faer::sparse::linalg::{SymbolicSupernodalParams, amd, qr};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Conj, MatMut, Par, Spec};

use super::support::Matrix;

/// Which order of columns.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Order {
    Colamd,
    Amd,
    Ours,
}

/// A matrix, its analysis and its factors.
pub(crate) struct Plain {
    matrix: SparseColMat<u32, f64>,
    transposed: SparseColMat<u32, f64>,
    columns: Perm<u32>,
    symbolic: SymbolicSupernodalLu<u32>,
    rows: [Vec<u32>; 2],
    lu: SupernodalLu<u32, f64>,
}

fn par() -> Par {
    if cfg!(feature = "parallel") {
        Par::rayon(0)
    } else {
        Par::Seq
    }
}

impl Plain {
    pub(crate) fn new(matrix: &Matrix, order: Order) -> Self {
        let unknowns = matrix.pattern.unknowns();
        let index = |at: usize| u32::try_from(at).unwrap();
        let triplets = matrix.entries.iter();
        let triplets: Vec<_> = triplets
            .map(|&(row, column, entry)| Triplet::new(index(row), index(column), entry))
            .collect();
        let mirrored: Vec<_> = triplets
            .iter()
            .map(|entry| Triplet::new(entry.col, entry.row, entry.val))
            .collect();
        let a = SparseColMat::try_new_from_triplets(unknowns, unknowns, &triplets).unwrap();
        let transposed =
            SparseColMat::try_new_from_triplets(unknowns, unknowns, &mirrored).unwrap();
        let columns = columns(matrix, &a, order);
        let symbolic = symbolic(&a, &transposed, columns.as_ref());
        Self {
            matrix: a,
            transposed,
            columns,
            symbolic,
            rows: [vec![0; unknowns], vec![0; unknowns]],
            lu: SupernodalLu::new(),
        }
    }

    /// The analysis with COLAMD.
    pub(crate) fn analyse(&self) -> SymbolicLu<u32> {
        factorize_symbolic_lu(self.matrix.symbolic(), LuSymbolicParams::default()).unwrap()
    }

    pub(crate) fn unknowns(&self) -> usize {
        self.matrix.nrows()
    }

    pub(crate) fn factor(&mut self) {
        let scratch =
            factorize_supernodal_numeric_lu_scratch::<u32, f64>(&self.symbolic, Spec::default());
        let [forward, inverse] = &mut self.rows;
        factorize_supernodal_numeric_lu(
            forward,
            inverse,
            &mut self.lu,
            self.matrix.as_ref(),
            self.transposed.as_ref(),
            self.columns.as_ref(),
            &self.symbolic,
            par(),
            MemStack::new(&mut MemBuffer::new(scratch)),
            Spec::default(),
        )
        .unwrap();
    }

    pub(crate) fn solve(&self, right: &mut [f64]) {
        let unknowns = self.unknowns();
        let scratch = supernodal::solve_in_place_scratch::<u32, f64>(unknowns, 1, par());
        let [forward, inverse] = &self.rows;
        self.lu.solve_in_place_with_conj(
            PermRef::new_checked(forward, inverse, unknowns),
            self.columns.as_ref(),
            Conj::No,
            MatMut::from_column_major_slice_mut(right, unknowns, 1),
            par(),
            MemStack::new(&mut MemBuffer::new(scratch)),
        );
    }
}

/// The order of columns.
fn columns(matrix: &Matrix, a: &SparseColMat<u32, f64>, order: Order) -> Perm<u32> {
    let unknowns = a.nrows();
    let (mut forward, mut inverse) = (vec![0; unknowns], vec![0; unknowns]);
    match order {
        Order::Colamd => {
            let lu = factorize_symbolic_lu(a.symbolic(), LuSymbolicParams::default()).unwrap();
            forward.copy_from_slice(lu.col_perm().arrays().0);
        }
        Order::Amd => {
            let scratch = amd::order_scratch::<u32>(unknowns, matrix.entries.len());
            let mut memory = MemBuffer::new(scratch);
            let (control, memory) = (amd::Control::default(), MemStack::new(&mut memory));
            amd::order(&mut forward, &mut inverse, a.symbolic(), control, memory).unwrap();
        }
        Order::Ours => {
            let length = u32::try_from(matrix.pattern.block_length()).unwrap();
            let solver = Solver::new(&matrix.pattern).unwrap();
            let nodes = solver.order().iter();
            let order = nodes.flat_map(|node| node * length..(node + 1) * length);
            forward = order.collect();
        }
    }
    for (place, &column) in (0..).zip(&forward) {
        inverse[column as usize] = place;
    }
    Perm::new_checked(forward.into(), inverse.into(), unknowns)
}

/// The analysis that `faer` makes for its own order.
fn symbolic(
    a: &SparseColMat<u32, f64>,
    transposed: &SparseColMat<u32, f64>,
    columns: PermRef<'_, u32>,
) -> SymbolicSupernodalLu<u32> {
    let unknowns = a.nrows();
    let tree = StackReq::new::<u32>(unknowns).array(8);
    let analysis = factorize_supernodal_symbolic_lu_scratch::<u32>(unknowns, unknowns);
    let mut memory = MemBuffer::new(tree.or(analysis));
    let mut etree = vec![0; unknowns];
    let mut post = vec![0; unknowns];
    let (mut counts, mut first) = (vec![0; unknowns], vec![0; unknowns]);
    let memory = MemStack::new(&mut memory);
    let etree = qr::col_etree(a.symbolic(), Some(columns), &mut etree, memory);
    qr::postorder(&mut post, etree, memory);
    qr::column_counts_ata(
        &mut counts,
        &mut first,
        transposed.symbolic(),
        Some(columns),
        etree,
        &post,
        memory,
    );
    factorize_supernodal_symbolic_lu(
        a.symbolic(),
        Some(columns),
        &first,
        etree,
        &counts,
        memory,
        SymbolicSupernodalParams::default(),
    )
    .unwrap()
}

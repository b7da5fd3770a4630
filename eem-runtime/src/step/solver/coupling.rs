//! Masses that couple nodes: the off-diagonal part of the mass matrix.
//!
//! ```text
//! Δp_a = Σ_b (2 M_ab/h)(Δq_b − h v⁰_b) + Σ_m M_am Δv_m,     v¹ = 2Δq/h − v⁰
//! ```
//!
//! for moving nodes b and moved anchors m. The velocities of m come from its prescribed motion and not from the
//! positions alone, so that they do not oscillate from step to step.

use super::balance::Balance;
use crate::algebra::{add, indices};
use crate::element::group::{StepView, Trial};
use crate::element::masses::Masses;
use crate::element::tableau::{MOST_SETS, MOST_STAGES, Path, Tableau};
use eem_material::number::compact::compact;
use eem_material::number::scalar::Scalar;

/// The masses that couple nodes of a scene, with the indices of their matrix entries. Vectors are stored component after
/// component, so that this is compiled once for all dimensions.
#[derive(Debug)]
pub(super) struct Coupling {
    dimension: usize,
    /// The pairs of moving nodes.
    pairs: Vec<CoupledPair>,
    /// Their entries of the tangent, set after set: rows of the first node, then rows of the second.
    places: Vec<u32>,
    /// One per moving node that is coupled to moved anchors.
    drives: Vec<Drive>,
    /// The masses of the moving nodes, kg; empty unless masses couple nodes, like the next two.
    masses: Vec<f64>,
    /// The vectors by which masses are multiplied, and their magnitudes, per moving node.
    pub(super) factors: Vec<f64>,
    /// `Δp` of the moving nodes, and the magnitude of its terms, N s.
    impulses: Vec<f64>,
    /// Memory for vectors at the stages.
    changes: Vec<f64>,
}

/// `Σ_m M_am Δv_m` of a moving node a that is coupled to moved anchors m, and the magnitude of its terms, N s.
#[derive(Clone, Debug)]
struct Drive {
    /// The index of the node among the moving nodes.
    node: usize,
    /// The anchors with their masses, kg.
    anchors: Vec<(usize, f64)>,
    /// In the rows of each set of unknowns, and in the whole step.
    sums: Vec<f64>,
}

/// Two coupled moving nodes, by their indices among the moving nodes.
#[derive(Clone, Copy, Debug)]
struct CoupledPair {
    nodes: [u32; 2],
    /// kg.
    mass: f64,
}

impl Coupling {
    /// The coupling of a scene with these unknowns of nodes and this number of sets of them, given the moved anchors in ascending
    /// order; `place` returns the index of the matrix entry of two unknowns of a set.
    pub(super) fn new(
        dimension: usize,
        masses: &Masses,
        moved: &[usize],
        (unknowns, sets): (&[Option<usize>], usize),
        place: &dyn Fn(usize, [usize; 2]) -> usize,
    ) -> Self {
        let mut pairs = Vec::with_capacity(masses.pairs().len());
        let mut places = Vec::with_capacity(2 * dimension * sets * masses.pairs().len());
        for set in 0..sets {
            for pair in masses.pairs() {
                let [a, b] = pair.nodes();
                let (Some(a), Some(b)) = (unknowns[a], unknowns[b]) else {
                    continue;
                };
                for [row, column] in [[a, b], [b, a]] {
                    for axis in 0..dimension {
                        places.push(compact(place(set, [row + axis, column + axis])));
                    }
                }
                if set == 0 {
                    pairs.push(CoupledPair {
                        nodes: [compact(a / dimension), compact(b / dimension)],
                        mass: pair.mass,
                    });
                }
            }
        }
        let mut own = Vec::with_capacity(masses.len());
        own.extend(masses.iter().flatten());
        let has_held = !masses.held().is_empty();
        let mut driven = vec![Vec::new(); if has_held { own.len() } else { 0 }];
        for pair in masses.held() {
            let [a, b] = pair.nodes();
            for [node, moves] in [[a, b], [b, a]] {
                if let Some(first) = unknowns[node]
                    && moved.binary_search(&moves).is_ok()
                {
                    driven[first / dimension].push((moves, pair.mass));
                }
            }
        }
        let mut drives = Vec::new();
        for (node, anchors) in driven.into_iter().enumerate() {
            if !anchors.is_empty() {
                drives.push(Drive {
                    node,
                    anchors,
                    sums: vec![0.0; 2 * dimension * (MOST_SETS + 1)],
                });
            }
        }
        if pairs.is_empty() && drives.is_empty() {
            own = Vec::new();
        }
        let vectors = vec![0.0; 2 * dimension * own.len()];
        Self {
            dimension,
            pairs,
            places,
            drives,
            masses: own,
            factors: vectors.clone(),
            impulses: vectors,
            changes: vec![0.0; dimension * MOST_STAGES],
        }
    }

    /// Finds the impulses of moved anchors on the nodes coupled to them in a step.
    pub(super) fn drive(&mut self, rule: Option<&Tableau>, view: &StepView<'_>) {
        let vector = 2 * self.dimension;
        for drive in &mut self.drives {
            drive.sums.fill(0.0);
            let (of_sets, of_step) = drive.sums.split_at_mut(MOST_SETS * vector);
            for &(moved, mass) in drive.anchors.iter().filter(|_| view.phase.moves()) {
                let change = &mut self.changes[..self.dimension];
                for (axis, change) in change.iter_mut().enumerate() {
                    let at = moved * self.dimension + axis;
                    let speed = view.loads.speeds.get(at).copied().unwrap_or(0.0);
                    *change = speed - view.state.velocities.values()[at];
                }
                add_to(of_step, mass, change);
                let Some((rule, path)) = rule.and_then(|rule| Some((rule, rule.path?))) else {
                    add_to(&mut of_sets[..vector], mass, change);
                    continue;
                };
                find_changes(&path, moved, view, &mut self.changes);
                for (set, rates) in rule.rates.iter().enumerate() {
                    let per_time = rule.times[set].recip();
                    let sums = &mut of_sets[set * vector..][..vector];
                    for (&rate, change) in rates.iter().zip(self.changes.chunks(self.dimension)) {
                        add_to(sums, mass * (rate * per_time), change);
                    }
                }
            }
        }
    }

    /// Whether no masses couple nodes.
    pub(super) fn is_none(&self) -> bool {
        self.impulses.is_empty()
    }

    /// The tolerance of the last update: the usual one, and at most ε^¾ with coupled masses.
    ///
    /// The forces of a stiff body are `(ωh)²` times its inertia, and so enlarge the error u² that an update u leaves; the
    /// result has to be below ε. With `u = ε^¾`, `(ωh)²` may be ε^−½.
    pub(super) fn tolerance(&self, usual: f64) -> f64 {
        if self.is_none() {
            return usual;
        }
        let root = f64::EPSILON.sqrt();
        Scalar::minimum(usual, root * root.sqrt())
    }

    /// Whether an update may have stopped falling because of rounding. With coupled masses it must be at most ε^⅝:
    /// momenta are judged relative to the impulses, which in a stiff body would hide the error of a larger update.
    pub(super) fn may_be_rounding(&self, update: f64) -> bool {
        let root = f64::EPSILON.sqrt();
        self.is_none() || update <= root * root.sqrt().sqrt()
    }

    /// Adds inertia times the factors to residual and tangent of a set, whose rows begin with the given ones, as a
    /// [`Balance`] does on the diagonal.
    pub(super) fn balance<const D: usize>(
        &self,
        set: usize,
        inertia_per_mass: f64,
        values: &mut [f64],
        right: &mut [f64],
    ) {
        let (places, right) = (self.places.as_chunks::<D>().0, right.as_chunks_mut::<D>().0);
        let (places, factors) = (places.as_chunks::<2>().0, self.factors.as_chunks::<D>().0);
        for (pair, places) in self.pairs.iter().zip(&places[set * self.pairs.len()..]) {
            let [a, b] = indices(pair.nodes);
            let inertia = pair.mass * inertia_per_mass;
            for &place in places.as_flattened() {
                values[place as usize] += inertia;
            }
            for [own, other] in [[a, b], [b, a]] {
                add(&mut right[own], -inertia, &factors[2 * other]);
            }
        }
        for drive in &self.drives {
            let impulses = &drive.sums.as_chunks::<D>().0[2 * set];
            add(&mut right[drive.node], -1.0, impulses);
        }
    }

    /// Finds `Δp` of all nodes from the factors: their displacements beyond flight in a set, or the changes of their velocities in the
    /// step, m/s.
    pub(super) fn find_impulses(&mut self, set: Option<usize>, inertia_per_mass: f64) {
        let (d, vector) = (self.dimension, 2 * self.dimension);
        let factors = self.factors.chunks_exact(vector);
        let impulses = self.impulses.chunks_exact_mut(vector);
        for ((&mass, factors), impulses) in self.masses.iter().zip(factors).zip(impulses) {
            let inertia = mass * inertia_per_mass;
            for (impulse, factor) in impulses.iter_mut().zip(factors) {
                *impulse = factor * inertia;
            }
        }
        for pair in &self.pairs {
            let [a, b] = indices(pair.nodes);
            let inertia = pair.mass * inertia_per_mass;
            for [own, other] in [[a, b], [b, a]] {
                let (factors, sizes) = self.factors[vector * other..][..vector].split_at(d);
                let (sums, terms) = self.impulses[vector * own..][..vector].split_at_mut(d);
                add(sums, inertia, factors);
                // Masses between corners and middles of edges are negative.
                add(terms, inertia.abs(), sizes);
            }
        }
        for drive in &self.drives {
            let more = &drive.sums[vector * set.unwrap_or(MOST_SETS)..][..vector];
            add(&mut self.impulses[vector * drive.node..], 1.0, more);
        }
    }

    /// `Δp` of a moving node as last found, and the magnitude of its terms, N s; `None` unless masses couple nodes.
    #[inline]
    pub(super) fn found<const D: usize>(&self, moving: usize) -> Option<[&[f64; D]; 2]> {
        if self.is_none() {
            return None;
        }
        let vectors = self.impulses.as_chunks::<D>().0;
        Some([&vectors[2 * moving], &vectors[2 * moving + 1]])
    }

    /// `Δp` of a moving node at the trial, and the magnitude of its terms, N s; where masses couple nodes, as last found.
    #[inline]
    pub(super) fn impulse<const D: usize>(
        &self,
        (moving, node): (usize, &Balance<D>),
        trial: &Trial<D>,
    ) -> [[f64; D]; 2] {
        match self.found(moving) {
            Some([&impulse, &terms]) => [impulse, terms],
            None => node.impulse(node.moved(trial)),
        }
    }
}

/// Adds the impulse of a mass, kg, whose velocity changes, m/s, and the magnitude of its terms.
fn add_to(sums: &mut [f64], mass: f64, change: &[f64]) {
    let (sums, terms) = sums.split_at_mut(change.len());
    add(sums, mass, change);
    for (term, change) in terms.iter_mut().zip(change) {
        *term += mass.abs() * change.abs();
    }
}

/// Finds the change of the velocity of a moved anchor from the old state to each stage, m/s, from its velocities at the
/// supports of a path.
pub(super) fn find_changes(path: &Path, node: usize, view: &StepView<'_>, changes: &mut [f64]) {
    let dimension = changes.len() / MOST_STAGES;
    changes.fill(0.0);
    let stages = changes.chunks_exact_mut(dimension);
    for (change, shares) in stages.zip(path.supports.to_stages) {
        for (axis, change) in change.iter_mut().enumerate() {
            let at = node * dimension + axis;
            let old = view.state.velocities.values()[at];
            for (&share, support) in shares.iter().zip(view.stages) {
                let speed = support.speeds.get(at).copied().unwrap_or(0.0);
                *change += share * (speed - old);
            }
        }
    }
}

//! Masses that couple nodes: the off-diagonal part of the mass matrix.
//!
//! ```text
//! Δp_a = Σ_b (2 M_ab/h)(Δq_b − h v⁰_b) + Σ_m M_am Δv_m,     v¹ = 2Δq/h − v⁰
//! ```
//!
//! for moving nodes b and moved anchors m. The velocities of m come from its prescribed motion and not from the
//! positions alone, so that they do not oscillate from step to step.

use super::balance::Balance;
use crate::algebra::{add, combined, difference, indices, vector};
use crate::element::group::{Sites, StepView, Trial};
use crate::element::masses::Masses;
use crate::element::tableau::{MOST_SETS, MOST_STAGES, Path, Tableau};
use eem_material::number::compact::compact;
use eem_material::number::scalar::Scalar;

/// The masses that couple nodes of a scene, with the indices of their matrix entries.
#[derive(Debug)]
pub(super) struct Coupling<const D: usize> {
    /// The pairs of moving nodes.
    pairs: Vec<CoupledPair>,
    /// Their entries of the tangent, set after set: rows of the first node, then rows of the second.
    places: Vec<[[u32; D]; 2]>,
    /// One per moving node that is coupled to moved anchors.
    drives: Vec<Drive<D>>,
    /// `Δp` of the moving nodes, and the magnitude of its terms, N s; empty unless masses couple nodes.
    impulses: Vec<[[f64; D]; 2]>,
}

/// `Σ_m M_am Δv_m` of a moving node a that is coupled to moved anchors m, and the magnitude of its terms, N s.
#[derive(Clone, Debug)]
struct Drive<const D: usize> {
    /// The index of the node among the moving nodes.
    node: usize,
    /// The anchors with their masses, kg.
    anchors: Vec<(usize, f64)>,
    /// In the rows of each set of unknowns.
    of_sets: [[[f64; D]; 2]; MOST_SETS],
    /// In the whole step.
    of_step: [[f64; D]; 2],
}

/// Two coupled moving nodes, by their indices among the moving nodes.
#[derive(Clone, Copy, Debug)]
struct CoupledPair {
    nodes: [u32; 2],
    /// kg.
    mass: f64,
}

impl CoupledPair {
    fn indices(&self) -> [usize; 2] {
        indices(self.nodes)
    }
}

impl<const D: usize> Coupling<D> {
    /// The coupling of a scene with this number of sets of unknowns, given the moved anchors in ascending order.
    pub(super) fn new(
        masses: &Masses,
        moved: &[usize],
        (sites, sets): (&Sites<'_, D>, usize),
    ) -> Self {
        let unknowns = &sites.layout.nodes;
        let mut pairs = Vec::with_capacity(masses.pairs().len());
        let mut places = Vec::with_capacity(sets * masses.pairs().len());
        for set in 0..sets {
            let sites = sites.of_sets([set, set]);
            for pair in masses.pairs() {
                let [a, b] = pair.nodes();
                let (Some(a), Some(b)) = (unknowns[a], unknowns[b]) else {
                    continue;
                };
                let place = |row: usize, column: usize| {
                    vector(|axis| compact(sites.place(Some(row + axis), Some(column + axis))))
                };
                places.push([place(a, b), place(b, a)]);
                if set == 0 {
                    pairs.push(CoupledPair {
                        nodes: [compact(a / D), compact(b / D)],
                        mass: pair.mass,
                    });
                }
            }
        }
        let moving = masses.iter().flatten().count();
        let has_held = !masses.held().is_empty();
        let mut driven = vec![Vec::new(); if has_held { moving } else { 0 }];
        for pair in masses.held() {
            let [a, b] = pair.nodes();
            for [node, moves] in [[a, b], [b, a]] {
                if let Some(first) = unknowns[node]
                    && moved.binary_search(&moves).is_ok()
                {
                    driven[first / D].push((moves, pair.mass));
                }
            }
        }
        let still = [[0.0; D]; 2];
        let mut drives = Vec::new();
        for (node, anchors) in driven.into_iter().enumerate() {
            if !anchors.is_empty() {
                drives.push(Drive {
                    node,
                    anchors,
                    of_sets: [still; MOST_SETS],
                    of_step: still,
                });
            }
        }
        let is_coupled = !pairs.is_empty() || !drives.is_empty();
        Self {
            pairs,
            places,
            drives,
            impulses: vec![still; if is_coupled { moving } else { 0 }],
        }
    }

    /// Finds the impulses of moved anchors on the nodes coupled to them in a step.
    pub(super) fn drive(&mut self, rule: Option<&Tableau>, view: &StepView<'_>) {
        for drive in &mut self.drives {
            let still = [[0.0; D]; 2];
            (drive.of_sets, drive.of_step) = ([still; MOST_SETS], still);
            for &(moved, mass) in drive.anchors.iter().filter(|_| view.phase.moves()) {
                let change = view.change_of_speed::<D>(moved);
                add_to(&mut drive.of_step, mass, &change);
                let Some((rule, path)) = rule.and_then(|rule| Some((rule, rule.path?))) else {
                    add_to(&mut drive.of_sets[0], mass, &change);
                    continue;
                };
                let changes = changes_at_stages(&path, moved, view);
                for (set, rates) in rule.rates.iter().enumerate() {
                    let per_time = rule.times[set].recip();
                    for (&rate, change) in rates.iter().zip(&changes) {
                        let share = mass * (rate * per_time);
                        add_to(&mut drive.of_sets[set], share, change);
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

    /// Adds inertia to residual and tangent of a set at a trial, as a [`Balance`] does on the diagonal.
    pub(super) fn balance(
        &self,
        set: usize,
        (nodes, trial): (&[Balance<D>], &Trial<D>),
        inertia_per_mass: f64,
        values: &mut [f64],
        right: &mut [[f64; 1]],
    ) {
        let places = &self.places[set * self.pairs.len()..];
        for (pair, places) in self.pairs.iter().zip(places) {
            let [a, b] = pair.indices();
            let inertia = pair.mass * inertia_per_mass;
            for &place in places.as_flattened() {
                values[place as usize] += inertia;
            }
            for [own, other] in [[a, b], [b, a]] {
                let change = nodes[other].change(trial);
                add(nodes[own].rows_mut(right), -inertia, &change);
            }
        }
        for drive in &self.drives {
            let [impulses, _] = drive.of_sets[set];
            let rows = nodes[drive.node].rows_mut(right);
            add(rows, -1.0, &impulses);
        }
    }

    /// Finds `Δp` of all nodes of a set at a trial, if masses couple them.
    pub(super) fn find_impulses(
        &mut self,
        set: usize,
        (nodes, trial): (&[Balance<D>], &Trial<D>),
        inertia_per_mass: f64,
    ) {
        self.multiply(nodes, inertia_per_mass, &|node| {
            let [moved, _] = node.moved(trial);
            [node.change(trial), sizes_of(moved)]
        });
        for drive in &self.drives {
            let more = drive.of_sets[set].as_flattened();
            add(self.impulses[drive.node].as_flattened_mut(), 1.0, more);
        }
    }

    /// Finds `Δp` of all nodes from the changes of their velocities in a step, m/s, by node, if masses couple them.
    pub(super) fn find_impulses_of_step(&mut self, nodes: &[Balance<D>], changes: &[[f64; D]]) {
        self.multiply(nodes, 1.0, &|node| {
            let change = changes[node.node];
            [change, sizes_of(&change)]
        });
        for drive in &self.drives {
            let more = drive.of_step.as_flattened();
            add(self.impulses[drive.node].as_flattened_mut(), 1.0, more);
        }
    }

    /// Sets the impulses to a factor times the mass matrix times a vector of nodes, with the magnitudes of the terms;
    /// `entries` returns those of a node and their magnitudes. Does nothing unless masses couple nodes.
    fn multiply(
        &mut self,
        nodes: &[Balance<D>],
        factor: f64,
        entries: &dyn Fn(&Balance<D>) -> [[f64; D]; 2],
    ) {
        for (node, impulse) in nodes.iter().zip(&mut self.impulses) {
            let inertia = node.mass * factor;
            *impulse = entries(node);
            for entry in impulse.as_flattened_mut() {
                *entry *= inertia;
            }
        }
        for pair in &self.pairs {
            let [a, b] = pair.indices();
            let inertia = pair.mass * factor;
            for [own, other] in [[a, b], [b, a]] {
                let [entries, sizes] = entries(&nodes[other]);
                let [sums, terms] = &mut self.impulses[own];
                add(sums, inertia, &entries);
                // Masses between corners and middles of edges are negative.
                add(terms, inertia.abs(), &sizes);
            }
        }
    }

    /// `Δp` of a moving node as last found, and the magnitude of its terms, N s; `None` unless masses couple nodes.
    pub(super) fn found(&self, moving: usize) -> Option<&[[f64; D]; 2]> {
        self.impulses.get(moving)
    }

    /// `Δp` of a moving node at the trial, and the magnitude of its terms, N s; where masses couple nodes, as last found.
    #[inline]
    pub(super) fn impulse(
        &self,
        (moving, node): (usize, &Balance<D>),
        trial: &Trial<D>,
    ) -> [[f64; D]; 2] {
        if let Some(found) = self.found(moving) {
            return *found;
        }
        node.impulse(node.moved(trial))
    }
}

/// Adds the impulse of a mass, kg, whose velocity changes, m/s, and the magnitude of its terms.
fn add_to<const D: usize>([sum, terms]: &mut [[f64; D]; 2], mass: f64, change: &[f64; D]) {
    add(sum, mass, change);
    add(terms, mass.abs(), &sizes_of(change));
}

fn sizes_of<const D: usize>(a: &[f64; D]) -> [f64; D] {
    vector(|axis| a[axis].abs())
}

/// The change of the velocity of a moved anchor from the old state to each stage, m/s, from its velocities at the
/// supports of a path.
pub(super) fn changes_at_stages<const D: usize>(
    path: &Path,
    node: usize,
    view: &StepView<'_>,
) -> [[f64; D]; MOST_STAGES] {
    let [old, _] = view.state.velocities.point::<D>(node);
    let mut changes = [[0.0; D]; MOST_STAGES];
    for (change, shares) in changes.iter_mut().zip(path.supports.to_stages) {
        let supports = view.stages.iter();
        *change = combined(shares, supports.map(|of| difference(&of.speed(node), old)));
    }
    changes
}

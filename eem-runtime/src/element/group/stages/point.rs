//! One element at the stages of a step, and one of its points: the elimination of internal variables, and heat.
//!
//! The local unknowns u of a point, `γ…` and then `Θ` set after set, depend on the rest of the scene through the inputs y:
//! measures (or increments of the strain), and heat from other elements. Solved, their equations are
//! `δu = −(c + Σ_j by_j δy_j)`, stored as the constant c followed by the columns `by_j`.
//!
//! Heat between elements is a function of the coupled interface temperatures Θ,
//!
//! ```text
//! Q_i = Σ κ (θ_i,partner − θ_i),   θ_i = Σ_k t_ik Θ_k
//! ```
//!
//! except that an element with a thermostat has the prescribed `θ_i`.

use super::site::{PerPair, StageContact, StageSite};
use crate::algebra::lu::{self, Singular};
use crate::algebra::vector;
use crate::element::conduction::{InterfaceTemperatures, Partner};
use crate::element::group::arms::{add_scaled, arms_in, change_in_set};
use crate::element::group::site::{HeatContact, HeatPath};
use crate::element::group::view::{StepView, Trial};
use crate::element::handle::Element;
use crate::element::kinematics::{Arms, Kinematics};
use crate::element::tableau::{MOST_SETS, MOST_STAGES, Tableau};
use eem_material::free_energy::Array;

/// An element, whose points have the [geometry](super::geometry::Geometry) `G`.
pub(crate) struct StageMember<K: Kinematics<D>, G, const D: usize> {
    pub(super) site: StageSite<K, D>,
    /// On the heap: cells with many points are large.
    pub(super) points: Vec<StagedPoint<K, G, D>>,
}

/// A point of an element.
pub(crate) struct StagedPoint<K: Kinematics<D>, G, const D: usize> {
    /// Its index among the models of the group.
    pub(super) place: usize,
    pub(super) element: Element,
    /// Its thermal slot.
    pub(super) slot: Option<usize>,
    pub(super) geometry: G,
    /// The matrix indices of its coupled interface temperatures, if it conducts heat to other elements.
    pub(super) contacts: Option<PerPair<StageContact<K, D>>>,
}

/// A point of an element, apart from its nodes and its conjugates.
pub(crate) struct StagePoint {
    pub(super) rule: &'static Tableau,
    /// Number of dashpots in series, and whether there is a temperature.
    pub(super) dashpots: usize,
    pub(super) is_thermal: bool,
    /// s⁰, J/K; zero without temperature.
    pub(super) entropy: f64,
    /// The temperatures of a thermostat at the stages, or at the supports of the path, K.
    pub(super) prescribed: Option<[f64; MOST_STAGES]>,
    /// The unit of viscous stretches.
    pub(super) viscous_unit: f64,
    /// The solved local system, see [`LocalStages`].
    pub(super) solved: Vec<f64>,
}

/// The paths of heat to other elements of each set, if there are any, and the interface temperatures.
pub(super) type Outside<'a> = (
    Option<[&'a [HeatPath]; MOST_SETS]>,
    &'a InterfaceTemperatures,
);

/// The arms of an element at a trial, m.
pub(crate) struct StageArms<K: Kinematics<D>, const D: usize> {
    pub(super) old: Arms<K, D>,
    /// Their changes at the stage of each set of unknowns.
    pub(super) changes: [Arms<K, D>; MOST_SETS],
}

impl<K: Kinematics<D>, const D: usize> StageArms<K, D> {
    /// The arms of the element with these nodes.
    pub(super) fn new(
        rule: &Tableau,
        nodes: &K::PerNode<u32>,
        (view, trial): (&StepView<'_>, &Trial<D>),
    ) -> Self {
        let mut changes = [Arms::<K, D>::filled([0.0; D]); MOST_SETS];
        for (set, change) in changes.iter_mut().enumerate().take(rule.sets()) {
            *change = change_in_set::<K, D>(nodes, trial, set);
        }
        let old = arms_in::<K, D>(nodes, &view.state.positions);
        Self { old, changes }
    }

    /// The arms at the stage of a set of unknowns.
    pub(super) fn of_set(&self, set: usize) -> Arms<K, D> {
        let mut r = self.changes[set];
        add_scaled::<K, D>(&mut r, 1.0, &self.old);
        r
    }
}

/// Workspace for the local systems of one group.
#[derive(Clone, Debug)]
pub(crate) struct LocalStages {
    /// `∂r/∂u`, row-major.
    pub(super) matrix: Vec<f64>,
    pivots: Vec<usize>,
    /// The derivatives of one quantity with respect to the local unknowns.
    pub(super) by_unknown: Vec<f64>,
    /// Its change at constant inputs, zero before the elimination of the local unknowns, then its derivatives with respect
    /// to the inputs.
    pub(super) row: Vec<f64>,
    /// Changes of the inputs.
    pub(super) inputs: Vec<f64>,
}

impl LocalStages {
    pub(super) fn new(unknowns: usize, inputs: usize) -> Self {
        let zeros = |length: usize| vec![0.0; length];
        Self {
            matrix: zeros(unknowns * unknowns),
            pivots: vec![0; unknowns],
            by_unknown: zeros(unknowns),
            row: zeros(1 + inputs),
            inputs: zeros(inputs),
        }
    }

    /// Number of local unknowns.
    pub(super) fn unknowns(&self) -> usize {
        self.pivots.len()
    }

    /// Starts another quantity.
    pub(super) fn clear_row(&mut self) {
        self.by_unknown.fill(0.0);
        self.row.fill(0.0);
    }

    /// The change of a local unknown that follows from the solved local system and the changes of the inputs.
    pub(super) fn change(&self, solved: &[f64], unknown: usize) -> f64 {
        let columns = solved[self.unknowns()..].chunks_exact(self.unknowns());
        let terms = columns.zip(&self.inputs);
        terms.fold(-solved[unknown], |change, (column, &input)| {
            change - column[unknown] * input
        })
    }
}

impl StagePoint {
    /// Reads the old state, given the unit of viscous stretches and the thermal slot.
    pub(super) fn begin(&mut self, unit: f64, slot: Option<usize>, view: &StepView<'_>) {
        self.viscous_unit = unit;
        if let Some(slot) = slot {
            self.entropy = view.state.entropies.values()[slot];
            self.prescribed = view.prescribed_at_stages(slot);
        }
    }

    /// Adds a multiple of the quantity in the row to an equation.
    pub(super) fn add_row(&mut self, local: &mut LocalStages, equation: usize, factor: f64) {
        let unknowns = local.unknowns();
        let columns = self.solved.chunks_exact_mut(unknowns).zip(&local.row);
        for (column, &entry) in columns.skip(1) {
            column[equation] += factor * entry;
        }
        let row = local.matrix[equation * unknowns..].iter_mut();
        for (sum, &entry) in row.zip(&local.by_unknown) {
            *sum += factor * entry;
        }
    }

    /// Solves the local equations.
    pub(super) fn solve(&mut self, local: &mut LocalStages) -> Result<(), Singular> {
        lu::factor(&mut local.matrix, &mut local.pivots)?;
        for column in self.solved.chunks_exact_mut(local.unknowns()) {
            lu::solve::<1>(&local.matrix, &local.pivots, column.as_chunks_mut().0);
        }
        Ok(())
    }

    /// Eliminates the local unknowns from the quantity in the row.
    pub(super) fn eliminate(&self, local: &mut LocalStages) {
        if local.by_unknown.is_empty() {
            return;
        }
        let solved = self.solved.chunks_exact(local.by_unknown.len());
        for (entry, solved) in local.row.iter_mut().zip(solved) {
            let pairs = local.by_unknown.iter().zip(solved);
            *entry -= pairs.fold(0.0, |sum, (&a, &b)| sum + a * b);
        }
    }

    /// Q at a stage of the element with a thermal slot, W.
    pub(super) fn heat_received(
        &self,
        stage: usize,
        slot: usize,
        (view, interface): (&StepView<'_>, &InterfaceTemperatures),
    ) -> f64 {
        let (rule, mut heat) = (self.rule, 0.0);
        for link in view.conduction.links(slot) {
            let Partner::Slot(partner) = link.partner else {
                continue;
            };
            let mut drop = excess(rule, stage, partner, view) - excess(rule, stage, slot, view);
            for (set, &share) in rule.temperatures[stage].iter().enumerate() {
                let [near, far] = [slot, partner].map(|slot| interface.of_set(rule, set, slot));
                drop += share * interface.drop(near, far);
            }
            heat += link.conductance * drop;
        }
        heat
    }
}

impl<K: Kinematics<D>, G, const D: usize> StagedPoint<K, G, D> {
    /// The change of Q at a stage that follows from a global solution, W.
    pub(super) fn heat_change(&self, rule: &Tableau, stage: usize, solution: &[[f64; 1]]) -> f64 {
        let mut change = 0.0;
        let contacts = self.contacts.iter().flatten().enumerate();
        for (set, contacts) in contacts.take(rule.sets()) {
            let share = rule.share(stage, set);
            let near = solution[contacts[set].0.unknown as usize][0];
            for path in &contacts[set].0.paths {
                let far = solution[path.unknown as usize][0];
                change += share * path.conductance * (far - near);
            }
        }
        change
    }
}

/// The paths of heat of each set.
pub(super) fn paths_of<K: Kinematics<D>, const D: usize>(
    contacts: &PerPair<StageContact<K, D>>,
) -> [&[HeatPath]; MOST_SETS] {
    vector(|set| &contacts[set][set].0.paths[..])
}

impl InterfaceTemperatures {
    /// The index of a thermal slot in a set of a rule.
    pub(super) fn of_set(&self, rule: &Tableau, set: usize, slot: usize) -> usize {
        set * (self.values().len() / rule.sets()) + slot
    }
}

/// The difference of a prescribed temperature at a stage and the combination of interface temperatures there, K.
fn excess(rule: &Tableau, stage: usize, slot: usize, view: &StepView<'_>) -> f64 {
    let Some(prescribed) = view.prescribed_at_stages(slot) else {
        return 0.0;
    };
    let shares = rule.temperatures[stage].iter().zip(rule.entropies);
    shares.fold(prescribed[stage], |rest, (&share, balance)| {
        rest - share * prescribed[balance.unknown]
    })
}

impl HeatContact {
    /// `Σ κ`, W/K.
    pub(super) fn conductance(&self) -> f64 {
        let paths = self.paths.iter();
        paths.fold(0.0, |sum, path| sum + path.conductance)
    }
}

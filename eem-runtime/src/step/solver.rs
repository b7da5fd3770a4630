//! One step of a whole scene: Newton's method, until the step closed from its trial state proves its laws.

mod balance;
mod begin;
mod closing;
mod converge;
mod coupling;
mod iteration;
mod kept_factors;
mod past;
pub(crate) mod rest;
mod rockets;
mod stages;
mod starts;

use crate::algebra::system::LinearSystem;
use crate::element::conduction::Conduction;
use crate::element::error::StateError;
use crate::element::group::{Group, Sites, StepView, Trial};
use crate::element::handle::Element;
use crate::element::layout::Layout;
use crate::element::loads::StepLoads;
use crate::element::masses::Masses;
use crate::element::tableau::UnknownSet;
use crate::step::certificate::Certificate;
use crate::step::scheme::Scheme;
use crate::step::systems::Systems;
use balance::{Balance, Interface};
use coupling::Coupling;

pub(crate) use crate::step::newton::Effort;
use kept_factors::KeptFactors;
use past::Past;
pub(crate) use past::SavedPast;
use rockets::Rockets;
use stages::Stages;

/// Workspace of a step. Later steps depend only on the history in `past`.
#[derive(Debug)]
pub(crate) struct Solver<const D: usize> {
    scheme: Scheme,
    /// The sets of unknowns.
    sets: Vec<UnknownSet>,
    /// The nodes that move, in the order of their unknowns, set after set.
    nodes: Vec<Balance<D>>,
    /// The masses that couple these nodes.
    coupling: Coupling,
    rockets: Rockets,
    /// The coupled interface temperatures, set after set.
    interfaces: Vec<Interface>,
    /// The system of an iteration.
    tangent: LinearSystem<1>,
    factors: KeptFactors,
    trial: Trial<D>,
    /// Workspace of schemes with stages.
    stages: Option<Stages<D>>,
    /// The part of the nodal forces that depends on the old state and the loads only, N; empty if there is none.
    old_force: Vec<[f64; D]>,
    past: Past<D>,
    /// The unit of length of each node: its shortest element in the old state, m; `f64::MAX` without elements.
    lengths: Vec<f64>,
    /// Whether other initial guesses remain, so that an attempt may be given up early.
    has_other_starts: bool,
    /// Whether the last attempt was.
    is_given_up: bool,
    /// The nodes that are anchors.
    anchors: Vec<usize>,
    /// The magnitude of the terms of the impulses on each node, N s; empty unless needed.
    magnitudes: Vec<f64>,
    /// The largest residual of the momentum balances where the step was closed, N s.
    final_residual: f64,
    /// The certificate of the last closed step.
    certificate: Certificate,
    /// The error because of which the last update was not applied in full.
    obstacle: Option<StateError>,
    /// The element with the largest defect of its own energy balance, when elements were last evaluated for it.
    worst: Option<Element>,
    /// How often all elements have been evaluated at a trial state.
    evaluations: u64,
}

/// The search for the new state of a step: the solver with the elements and the data of the step.
pub(crate) struct Search<'a, const D: usize> {
    solver: &'a mut Solver<D>,
    groups: &'a mut [Box<dyn Group<D>>],
    view: &'a StepView<'a>,
}

/// Whether there are nodal forces that do not depend on the trial; forces at stages do not count.
fn has_old_forces(scheme: Scheme, loads: &StepLoads) -> bool {
    scheme.has_old_forces() || (loads.has_total_force() && scheme.tableau().is_none())
}

/// How many viscous stretches and temperatures are predicted: all by exact schemes with one set of forces in a step.
fn predicted(scheme: Scheme, layout: &Layout) -> [usize; 2] {
    let predicts = scheme.is_exact() && scheme.tableau().is_none() && !scheme.is_split();
    if predicts {
        [layout.viscous, layout.thermal]
    } else {
        [0; 2]
    }
}

impl<const D: usize> Solver<D> {
    pub(crate) fn new(
        scheme: Scheme,
        systems: Systems<D>,
        masses: &Masses,
        layout: &Layout,
        conduction: &Conduction,
        loads: &StepLoads,
    ) -> Self {
        let sets = scheme.sets();
        let Systems { tangent, secant } = systems;
        let rule = scheme.tableau();
        let stages = rule.map(|rule| Stages::new(rule, secant, masses));
        let sites = Sites {
            layout,
            conduction,
            tangent: &tangent,
            secant: stages.as_ref().and_then(|stages| stages.secant.as_ref()),
            sets: [0; 2],
        };
        let nodes_with = |needed: bool| if needed { masses.len() } else { 0 };
        // Not more than there are: they are a good part of what a long chain takes.
        let mut nodes = Vec::with_capacity(sets.len() * masses.iter().flatten().count());
        let coupled = layout.coupled.iter().flatten().count();
        let mut interfaces = Vec::with_capacity(sets.len() * coupled);
        for set in 0..sets.len() {
            let sites = sites.of_sets([set, set]);
            Balance::add_all(masses, &sites, &mut nodes);
            Interface::add_all(&sites, &mut interfaces);
        }
        let unknowns = (&layout.nodes[..], sets.len());
        let coupling = Coupling::new(D, masses, &loads.moved, unknowns, &|set, [row, column]| {
            let sites = sites.of_sets([set, set]);
            sites.place(Some(row), Some(column))
        });
        let unknown = |[node, axis]: [usize; 2]| layout.nodes[node].map(|first| first + axis);
        let rockets = Rockets::new(
            scheme.tableau(),
            loads,
            [D, masses.len()],
            (
                &|set, row| sites.of_sets([set, set]).row(unknown(row)),
                &|sets, [row, column]| sites.of_sets(sets).place(unknown(row), unknown(column)),
            ),
        );
        // Without conduction between elements there are no interface temperatures.
        let slots = layout.thermal * usize::from(!interfaces.is_empty());
        Self {
            scheme,
            past: Past::none(masses.len(), predicted(scheme, layout)),
            nodes,
            coupling,
            rockets,
            interfaces,
            factors: KeptFactors::new(&tangent),
            tangent,
            trial: Trial::new(sets.len(), masses.len(), slots),
            sets,
            stages,
            old_force: vec![[0.0; D]; nodes_with(has_old_forces(scheme, loads))],
            lengths: vec![1.0; masses.len()],
            has_other_starts: false,
            is_given_up: false,
            anchors: masses.anchors().collect(),
            magnitudes: Vec::with_capacity(nodes_with(scheme.is_exact())),
            final_residual: 0.0,
            certificate: Certificate::default(),
            obstacle: None,
            worst: None,
            evaluations: 0,
        }
    }

    fn search<'a>(
        &'a mut self,
        groups: &'a mut [Box<dyn Group<D>>],
        view: &'a StepView<'a>,
    ) -> Search<'a, D> {
        Search {
            solver: self,
            groups,
            view,
        }
    }

    /// Whether its eliminations keep nothing between steps, so that it can be [renewed](Self::renew).
    pub(crate) fn is_renewable(&self) -> bool {
        self.tangent.is_fixed() && self.secant().is_none_or(LinearSystem::is_fixed)
    }

    fn secant(&self) -> Option<&LinearSystem<D>> {
        self.stages.as_ref()?.secant.as_ref()
    }

    /// Makes it that of another scene with these masses, which differs in numbers only: the same nodes move, masses do not couple
    /// them, and the only load, in both scenes or in none, is gravity.
    pub(crate) fn renew(&mut self, masses: &Masses) {
        for node in &mut self.nodes {
            node.set_mass(masses);
        }
        self.past.clear();
        self.evaluations = 0;
    }

    /// Number of sets of unknowns.
    pub(crate) const fn sets(&self) -> usize {
        self.sets.len()
    }

    /// How often all elements have been evaluated at a trial state, at all its stages.
    pub(crate) const fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// The system of an iteration; nothing in it outlives a step.
    #[cfg(feature = "gradients")]
    pub(crate) const fn tangent_mut(&mut self) -> &mut LinearSystem<1> {
        &mut self.tangent
    }

    /// The data from which the matrix indices of elements follow.
    pub(crate) fn sites<'a>(
        &'a self,
        layout: &'a Layout,
        conduction: &'a Conduction,
    ) -> Sites<'a, D> {
        Sites {
            layout,
            conduction,
            tangent: &self.tangent,
            secant: self.secant(),
            sets: [0; 2],
        }
    }
}

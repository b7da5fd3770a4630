//! One step of a whole scene through three stages: Newton's method, then the closing evaluation.
//!
//! What [`Solver`](super::Solver) is to the schemes with one set of forces per step this is to
//! [`Scheme::Variational4`]; they converge, follow a solution and give up alike. The start is free
//! flight.

mod assemble;
mod closing;
mod linearize;

use core::array;

use super::begin::inverse_length;
use super::places::{MovingNode, Seen, moving, seen};
use super::{CONTINUATION_STEPS, Effort, HALVINGS, Iteration};
use crate::certificate::Certificate;
use crate::conduction::Conduction;
use crate::error::{StateError, StepFailure};
use crate::group::{Sites, StageGroup, StageTrial, StageView, points};
use crate::layout::Layout;
use crate::loads::{Loads, StepLoads};
use crate::masses::Masses;
use crate::newton::is_last;
use crate::pattern::Pattern;
use crate::scalar::{Mask, Real};
use crate::scene::ElementEntry;
use crate::scheme::Scheme;
use crate::state::State;
use crate::system::LinearSystem;

/// A scene that is stepped through stages.
pub(crate) struct Staged<S: Real, const D: usize> {
    pub(crate) groups: Vec<Box<dyn StageGroup<S, D>>>,
    pub(crate) solver: StageSolver<S, D>,
    /// What acts at the times of the stages of the next step.
    pub(crate) loads: [StepLoads<S>; 3],
}

impl<S: Real, const D: usize> Staged<S, D> {
    pub(crate) fn new(
        mut groups: Vec<Box<dyn StageGroup<S, D>>>,
        masses: &Masses<S>,
        elements: &[ElementEntry<S>],
        layout: &Layout,
        conduction: &Conduction<S>,
        loads: &Loads<S, D>,
    ) -> Self {
        let stage = || StepLoads::new(masses.len() * D, layout, loads);
        let pattern = Pattern::of_tangent(elements, layout, conduction, D).doubled();
        let tangent = LinearSystem::new(&pattern, D);
        let secant = LinearSystem::new(&Pattern::of_secant(elements, layout, D), 1);
        let shifts = [0, layout.unknowns];
        let quarters = shifts.map(|down| {
            shifts.map(|right| Sites {
                layout,
                conduction,
                tangent: &tangent,
                secant: Some(&secant),
                shift: [down, right],
            })
        });
        for group in &mut groups {
            group.connect(&quarters);
        }
        let halves = [&quarters[0][0], &quarters[1][1]];
        let moving = halves.map(|sites| moving(masses, sites));
        let seen = halves.map(|sites| seen(sites));
        Self {
            groups,
            solver: StageSolver::new(
                moving,
                seen,
                tangent,
                secant,
                [masses.len(), layout.thermal],
            ),
            loads: [stage(), stage(), stage()],
        }
    }

    /// Evaluates the loads at the start, the middle and the end of the step from `time` by `step`.
    pub(crate) fn evaluate_loads(
        &mut self,
        loads: &Loads<S, D>,
        masses: &Masses<S>,
        [time, step]: [S; 2],
        q0: &[S],
    ) -> Result<(), StepFailure> {
        let times = [time, time + S::from_f64(0.5) * step, time + step];
        for (stage, time) in self.loads.iter_mut().zip(times) {
            let span = [time, S::zero()];
            stage.evaluate(loads, masses, Scheme::Variational4, span, q0)?;
        }
        Ok(())
    }
}

/// Working memory of a step; nothing in it outlives the step.
///
/// Pairs are those of the two halves of the unknowns: displacements of the middle with the seen
/// temperatures of the start, displacements and seen temperatures of the end.
#[derive(Debug)]
pub(crate) struct StageSolver<S, const D: usize> {
    /// The nodes that move.
    masses: [Vec<MovingNode<S, D>>; 2],
    /// The rows of the temperatures that neighbours see, and their thermal slots.
    seen: [Vec<Seen>; 2],
    /// Half the number of unknowns.
    half: usize,
    /// The system of an iteration.
    tangent: LinearSystem<S, 1>,
    /// The system of the closing solution for the middle.
    secant: LinearSystem<S, D>,
    trial: StageTrial<S, D>,
    /// Displacements and seen temperatures before the last update, and the update.
    previous: [(Vec<[S; D]>, Vec<S>); 2],
    correction: [(Vec<[S; D]>, Vec<S>); 2],
    /// Loads less forces of the elements at the stages, N.
    forces: [Vec<[S; D]>; 3],
    /// The reciprocal of the unit of length of each node: its shortest element in the old state;
    /// 1 m without.
    per_length: Vec<S>,
    /// What kept the last update from being applied in full.
    obstacle: Option<StateError>,
}

impl<S: Real, const D: usize> StageSolver<S, D> {
    fn new(
        masses: [Vec<MovingNode<S, D>>; 2],
        seen: [Vec<Seen>; 2],
        tangent: LinearSystem<S, 1>,
        secant: LinearSystem<S, D>,
        [nodes, slots]: [usize; 2],
    ) -> Self {
        let points = || vec![[S::zero(); D]; nodes];
        let temperatures = || vec![S::zero(); slots];
        let halves = [(); 2].map(|()| (points(), temperatures()));
        Self {
            masses,
            seen,
            half: tangent.unknowns() / 2,
            tangent,
            secant,
            trial: StageTrial {
                displacements: [(); 2].map(|()| points()),
                positions: [(); 3].map(|()| points()),
                seen_temperatures: [(); 3].map(|()| temperatures()),
            },
            previous: halves.clone(),
            correction: halves,
            forces: [(); 3].map(|()| points()),
            per_length: vec![S::one(); nodes],
            obstacle: None,
        }
    }

    /// The state after the step.
    pub(crate) fn solve(
        &mut self,
        groups: &mut [Box<dyn StageGroup<S, D>>],
        view: &StageView<'_, S>,
        effort: &mut Effort<S>,
        next: &mut State<S>,
    ) -> Result<Certificate<S>, StepFailure> {
        if let Err(failure) = self.start_and_converge(groups, view, effort) {
            self.follow(groups, view, effort).map_err(|_| failure)?;
        }
        if let Some(&last) = effort.history.last() {
            effort.conclude(last.residual);
        }
        let certificate = self.close(groups, view, next)?;
        certificate.unless_infinite(next.time.value)?;
        Ok(certificate)
    }

    fn start_and_converge(
        &mut self,
        groups: &mut [Box<dyn StageGroup<S, D>>],
        view: &StageView<'_, S>,
        effort: &mut Effort<S>,
    ) -> Result<(), StepFailure> {
        self.begin(groups, view);
        let share = self.advance(groups, view)?;
        self.converge(groups, view, share, effort)
    }

    /// The solution for growing parts of the step, each starting from the one before.
    fn follow(
        &mut self,
        groups: &mut [Box<dyn StageGroup<S, D>>],
        view: &StageView<'_, S>,
        effort: &mut Effort<S>,
    ) -> Result<(), StepFailure> {
        let number = |part: u8| S::from_f64(f64::from(part));
        for part in 1..=CONTINUATION_STEPS {
            let shorter = StageView {
                step: view.step * number(part) / number(CONTINUATION_STEPS),
                ..*view
            };
            if part == 1 {
                self.start_and_converge(groups, &shorter, effort)?;
            } else {
                self.extrapolate(groups, number(part) / number(part - 1));
                let share = self.advance(groups, &shorter)?;
                self.converge(groups, &shorter, share, effort)?;
            }
        }
        Ok(())
    }

    /// Makes displacements larger by a factor and leaves everything else.
    fn extrapolate(&mut self, groups: &mut [Box<dyn StageGroup<S, D>>], factor: S) {
        self.remember();
        let growth = factor - S::one();
        for (half, masses) in self.masses.iter().enumerate() {
            let (from, by) = (&self.previous[half], &mut self.correction[half]);
            for mass in masses {
                by.0[mass.node()] = from.0[mass.node()].map(|component| growth * component);
            }
            by.1.fill(S::zero());
        }
        for group in groups {
            group.hold();
        }
    }

    /// Newton's method from the trial stages, which were reached by the given share of a correction.
    fn converge(
        &mut self,
        groups: &mut [Box<dyn StageGroup<S, D>>],
        view: &StageView<'_, S>,
        mut share: S,
        effort: &mut Effort<S>,
    ) -> Result<(), StepFailure> {
        let mut before = None;
        for _ in 0..effort.settings.max_iterations {
            let residual = self.assemble(groups, view);
            let solved = self.tangent.solve();
            solved.map_err(|_| StepFailure::SingularTangent)?;
            let update = self.correct(groups, view);
            effort.history.push(Iteration { residual, update });
            if !update.is_finite() {
                break;
            }
            let full = share.equal(S::one()).all();
            share = self.advance(groups, view)?;
            let is_full = share.equal(S::one()).all();
            let before = before.replace(update).filter(|_| full);
            let is_last = is_last(update, before, effort.settings.tolerance);
            if is_full && is_last.all() {
                return Ok(());
            }
        }
        Err(match self.obstacle.take() {
            Some(obstacle) => obstacle.into(),
            None => StepFailure::NotConverged {
                update: before.map_or(f64::NAN, Real::to_f64),
            },
        })
    }

    /// Starts at the old state, with free flight as the first correction.
    fn begin(&mut self, groups: &mut [Box<dyn StageGroup<S, D>>], view: &StageView<'_, S>) {
        self.per_length.fill(S::MAX);
        for group in groups.iter_mut() {
            group.begin(view, &mut self.per_length);
        }
        for length in &mut self.per_length {
            *length = inverse_length(*length);
        }
        let old = points::<S, D>(view.state.positions.values());
        let trial = &mut self.trial;
        trial.positions[0].copy_from_slice(old);
        for (half, loads) in view.loads[1..].iter().enumerate() {
            let displacements = trial.displacements[half].iter_mut().enumerate();
            let positions = trial.positions[1 + half].iter_mut().zip(old);
            for ((node, displacement), (position, old)) in displacements.zip(positions) {
                *displacement = loads.motion(node);
                *position = array::from_fn(|axis| old[axis] + displacement[axis]);
            }
        }
        for (seen, loads) in trial.seen_temperatures.iter_mut().zip(view.loads) {
            seen.copy_from_slice(&view.state.temperatures);
            for (slot, seen) in seen.iter_mut().enumerate() {
                *seen = loads
                    .prescribed(slot)
                    .map_or(*seen, |prescribed| prescribed.end);
            }
        }
        self.remember();
        let momenta = points::<S, D>(view.state.momenta.values());
        for (half, share) in [0.5, 1.0].map(S::from_f64).into_iter().enumerate() {
            for mass in &self.masses[half] {
                let mobility = share * view.step / mass.mass;
                let flight = momenta[mass.node()].map(|momentum| mobility * momentum);
                self.correction[half].0[mass.node()] = flight;
            }
            self.correction[half].1.fill(S::zero());
        }
    }

    fn remember(&mut self) {
        for (half, (displacements, seen)) in self.previous.iter_mut().enumerate() {
            displacements.copy_from_slice(&self.trial.displacements[half]);
            seen.copy_from_slice(&self.trial.seen_temperatures[2 * half]);
        }
    }

    /// Applies the correction, or as much of it as leaves every element in admissible states, and
    /// evaluates there. Returns the share that was applied.
    fn advance(
        &mut self,
        groups: &mut [Box<dyn StageGroup<S, D>>],
        view: &StageView<'_, S>,
    ) -> Result<S, StepFailure> {
        let mut share = S::one();
        let mut halvings = 0;
        self.obstacle = None;
        loop {
            self.apply(share, view);
            for group in groups.iter_mut() {
                group.apply(share);
            }
            let trial = &self.trial;
            match groups
                .iter_mut()
                .try_for_each(|group| group.evaluate(view, trial))
            {
                Ok(()) => return Ok(share),
                Err(error) if halvings == HALVINGS => return Err(error.into()),
                Err(error) => {
                    self.obstacle = Some(error);
                    share *= S::from_f64(0.5);
                    halvings += 1;
                }
            }
        }
    }

    /// The trial a share of the correction away from where it was.
    fn apply(&mut self, share: S, view: &StageView<'_, S>) {
        let trial = &mut self.trial;
        let old = points::<S, D>(view.state.positions.values());
        for (half, masses) in self.masses.iter().enumerate() {
            let (from, by) = (&self.previous[half], &self.correction[half]);
            for node in masses.iter().map(MovingNode::node) {
                let (from, by, old) = (&from.0[node], &by.0[node], &old[node]);
                let moved: [S; D] = array::from_fn(|axis| from[axis] + share * by[axis]);
                trial.displacements[half][node] = moved;
                trial.positions[1 + half][node] = array::from_fn(|axis| old[axis] + moved[axis]);
            }
            for &Seen { slot, .. } in &self.seen[half] {
                trial.seen_temperatures[2 * half][slot] = from.1[slot] + share * by.1[slot];
            }
        }
        let [start, middle, end] = &mut trial.seen_temperatures;
        for &Seen { slot, .. } in &self.seen[0] {
            let prescribed = view.loads[1].prescribed(slot);
            let mean = S::from_f64(0.5) * (start[slot] + end[slot]);
            middle[slot] = prescribed.map_or(mean, |prescribed| prescribed.end);
        }
    }
}

//! The stages of a step: stage vectors, their rates, and the integrals of productions.

use super::accounts::Accounts;
use super::tableau::{
    ERROR_3, ERROR_5, ROW_1, ROW_2, ROW_3, ROW_4, ROW_5, ROW_6, ROW_7, ROW_8, ROW_9, ROW_10,
    ROW_11, STAGES, TIMES, WEIGHTED, WEIGHTS,
};
use super::{Explicit, View};
use crate::element::error::StateError;
use crate::element::group::{Combination, Past, Stage};
use crate::step::error::StepFailure;

/// The row of the rates of each stage: those of stages 1 and 2 are needed by the next two stages only, and the last two
/// stages reuse their rows.
const ROWS: [usize; STAGES] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 2, 1];

/// The rows of the stages with weights.
const WEIGHTED_ROWS: [usize; 8] = [0, 5, 6, 7, 8, 9, ROWS[10], ROWS[11]];

/// The index of each stage among the stages with weights.
const WEIGHT_OF: [Option<usize>; STAGES] = {
    let mut all = [None; STAGES];
    let mut at = 0;
    while at < WEIGHTED.len() {
        all[WEIGHTED[at]] = Some(at);
        at += 1;
    }
    all
};

/// `Σ E k` of both estimates.
#[inline]
pub(super) fn errors<const N: usize, const P: usize>(past: &Past<N, P>) -> [[[f64; N]; P]; 2] {
    [
        past.combined((&WEIGHTED_ROWS, &ERROR_5)),
        past.combined((&WEIGHTED_ROWS, &ERROR_3)),
    ]
}

/// `Σ a k` for one of so many variables, whose rates are one row after the other.
pub(super) fn combined(
    a: &[f64; WEIGHTED.len()],
    (rates, variables, index): (&[f64], usize, usize),
) -> f64 {
    let mut sum = a[0] * rates[WEIGHTED_ROWS[0] * variables + index];
    for term in 1..a.len() {
        sum += a[term] * rates[WEIGHTED_ROWS[term] * variables + index];
    }
    sum
}

/// The same as [`combine`](Explicit::combine) for the internal variables.
#[inline(always)]
#[expect(
    clippy::inline_always,
    reason = "rows and coefficients are constants of the caller"
)]
fn combine_inner(stage: &mut Stage, last: usize, h: f64, terms: Combination<'_>) {
    let inner = stage.inner.as_chunks_mut().0.as_chunks_mut().0;
    let rates = stage.inner_rates.as_chunks_mut().0.as_chunks_mut().0;
    let pairs = inner.iter_mut().zip(rates).zip(&mut stage.inner_past);
    for ((now, rates), past) in pairs {
        if last == 0 {
            past.start = *now;
        }
        *now = past.advance(rates, h, terms);
        *rates = [[0.0]; 2];
    }
}

impl Accounts {
    /// Initialises the rates of temperatures with the heat that flows along paths.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "as above")]
    fn conduct(&mut self, weight: Option<usize>) {
        if self.components.paths.is_empty() {
            return;
        }
        let theta = &self.stage.inner[self.stage.temperatures..];
        let rates = &mut self.stage.inner_rates[self.stage.temperatures..][..theta.len()];
        for path in &mut self.components.paths {
            let [a, b] = path.ends;
            let [near, far] = [theta[a], theta[b]];
            let flow = path.conductance * (far - near);
            rates[a] += flow;
            // That of a reservoir is not used.
            rates[b] -= flow;
            if let Some(at) = weight {
                (path.temperatures[0][at], path.temperatures[1][at]) = (near, far);
            }
        }
    }
}

impl<const D: usize> Explicit<D> {
    /// Goes through all stages to the end of the step, before it is closed.
    pub(super) fn go_through_stages(&mut self, view: &View<'_>) -> Result<(), StepFailure> {
        self.stage(view, 1, (&[0], &ROW_1))?;
        self.stage(view, 2, (&[0, 1], &ROW_2))?;
        self.stage(view, 3, (&[0, 2], &ROW_3))?;
        self.stage(view, 4, (&[0, 2, 3], &ROW_4))?;
        self.stage(view, 5, (&[0, 3, 4], &ROW_5))?;
        self.stage(view, 6, (&[0, 3, 4, 5], &ROW_6))?;
        self.stage(view, 7, (&[0, 3, 4, 5, 6], &ROW_7))?;
        self.stage(view, 8, (&[0, 3, 4, 5, 6, 7], &ROW_8))?;
        self.stage(view, 9, (&[0, 3, 4, 5, 6, 7, 8], &ROW_9))?;
        self.stage(view, 10, (&[0, 3, 4, 5, 6, 7, 8, 9], &ROW_10))?;
        self.stage(view, 11, (&[0, 3, 4, 5, 6, 7, 8, 9, ROWS[10]], &ROW_11))?;
        self.combine(STAGES - 1, view.step, (&WEIGHTED_ROWS, &WEIGHTS));
        if self.is_driven {
            self.move_to(STAGES - 1);
        }
        Ok(())
    }

    /// Goes to a stage and finds its rates.
    #[inline(always)]
    #[expect(
        clippy::inline_always,
        reason = "stages and coefficients are constants of the caller"
    )]
    fn stage(
        &mut self,
        view: &View<'_>,
        stage: usize,
        terms: Combination<'_>,
    ) -> Result<(), StepFailure> {
        self.combine(stage - 1, view.step, terms);
        if self.is_driven {
            self.drive(view, stage)?;
        }
        Ok(self.find_rates(WEIGHT_OF[stage])?)
    }

    /// Stores the rates of the last stage, moves to `y = y⁰ + h Σ a k` with the rates of some rows, and initialises the
    /// rates there.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "as above")]
    fn combine(&mut self, last: usize, h: f64, terms: Combination<'_>) {
        for place in &mut self.places[..self.accounts.components.masses] {
            if last == 0 {
                place.past.start = place.now;
            }
            place.now = place.past.advance(&place.rates, h, terms);
            place.begin_rates();
        }
        combine_inner(&mut self.accounts.stage, last, h, terms);
    }

    /// Sets what is prescribed at a stage, and the loads.
    fn drive(&mut self, view: &View<'_>, stage: usize) -> Result<(), StepFailure> {
        self.move_to(stage);
        let share = TIMES[stage];
        self.evaluate_loads(view, view.state.time.value + share * view.step)
    }

    /// Initialises the forces on masses with loads and weights, at a time if they depend on it.
    #[inline]
    pub(super) fn evaluate_loads(&mut self, view: &View<'_>, time: f64) -> Result<(), StepFailure> {
        if !self.loads.has_total_force() {
            return Ok(());
        }
        if self.has_functions {
            let time = view.loads.inside([view.state.time.value, view.step], time);
            let loads = &mut self.accounts.loads;
            loads.evaluate_forces_at(view.loads, view.masses, time)?;
        }
        self.apply_loads();
        Ok(())
    }

    /// Initialises the forces on masses with the loads.
    fn apply_loads(&mut self) {
        let components = &self.accounts.components;
        for at in 0..components.masses {
            let load = self.accounts.loads.total_force(components.nodes[at]);
            self.places[at].rates[1] = load;
        }
    }

    /// Completes the rates of a stage, and adds its contribution to the integrals of the step.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "as above")]
    pub(super) fn find_rates(&mut self, weight: Option<usize>) -> Result<(), StateError> {
        self.stage.weight = weight.map_or(0.0, |at| WEIGHTS[at]);
        self.conduct(weight);
        for group in &self.groups {
            group.rates(&mut self.places, &mut self.accounts.stage)?;
        }
        self.accounts.evaluations += 1;
        if self.is_driven
            && let Some(at) = weight
        {
            if self.stage.has_thermostats {
                self.integrate_thermostats(false);
            }
            self.integrate_outside(at);
        }
        Ok(())
    }

    /// Finds the rates of the closed state.
    #[inline]
    pub(super) fn finish(&mut self) -> Result<(), StepFailure> {
        for place in &mut self.places[..self.accounts.components.masses] {
            place.begin_rates();
        }
        self.stage.inner_rates.fill(0.0);
        if self.loads.has_total_force() {
            self.apply_loads();
        }
        if self.is_driven {
            self.move_to(STAGES - 1);
        }
        self.stage.weight = 0.0;
        self.conduct(Some(0));
        for group in &self.groups {
            group.finish(&mut self.places, &mut self.accounts.stage)?;
        }
        Ok(())
    }
}

//! Conjugates that are values of the free energy at the stages.

mod at_stage;
mod closing;
mod evaluate;
mod local;

use super::local::LocalStages;
use super::member::{StageArms, StagePoint, StatePoint};
use super::source::Source;
use crate::element::error::StateError;
use crate::element::group::arms::{add_scaled, along, measures_in};
use crate::element::group::point::grown;
use crate::element::group::point::variables;
use crate::element::group::view::{StepView, Trial};
use crate::element::kinematics::{Arms, Blocks, Gradient, Kinematics, Weights};
use crate::element::state::State;
use crate::element::tableau::{MOST_SETS, MOST_STAGES, Tableau};
use crate::element::tally::Tally;
use at_stage::AtStage;
use eem_material::free_energy::{Array, FreeEnergy, Material};
use eem_material::number::scalar::Real;

/// The variables at the stages, and what the model says there.
pub(crate) struct Values<S: Real, M: FreeEnergy<S>, K: Kinematics<S, D>, const D: usize> {
    /// The trial variables `(π, γ, θ)` at the stages.
    x: [M::Variables; MOST_STAGES],
    /// The same before the last correction, and the correction; temperatures only at the stages whose
    /// temperatures are unknowns.
    previous: [M::Variables; MOST_STAGES],
    correction: [M::Variables; MOST_STAGES],
    /// What the model says there.
    points: [AtStage<S, M>; MOST_STAGES],
    /// `∂π/∂r` there.
    gradients: [Gradient<K, S, D>; MOST_STAGES],
    /// The entropy that dashpots and conduction gave it in the step, J/K.
    entropy_received: S,
}

/// A point with such conjugates.
pub(super) type ValuesPoint<S, M, K, const D: usize> = StagePoint<S, M, K, Values<S, M, K, D>, D>;

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, const D: usize> Source<S, M, K, D>
    for Values<S, M, K, D>
{
    const FORCES: usize = M::MEASURES;

    type Bases = ();

    fn new() -> Self {
        let zeros = [M::Variables::filled(S::zero()); MOST_STAGES];
        let nowhere = Arms::<K, S, D>::filled([S::zero(); D]);
        Self {
            x: zeros,
            previous: zeros,
            correction: zeros,
            points: [(); MOST_STAGES].map(|()| AtStage::zero()),
            gradients: [Gradient::<K, S, D>::filled(nowhere); MOST_STAGES],
            entropy_received: S::zero(),
        }
    }

    fn begin(
        point: &mut ValuesPoint<S, M, K, D>,
        in_state: &StatePoint<S, M, K, D>,
        view: &StepView<'_, S>,
        r0: &Arms<K, S, D>,
    ) {
        let measures = point.kinematics.measure(r0);
        let gradient = point.kinematics.gradient(r0, &measures);
        let x = variables::<S, M>(measures.as_ref(), in_state.slots(), view.state);
        point.own.gradients = [gradient; MOST_STAGES];
        point.own.x = [x; MOST_STAGES];
        let prescribed = point.prescribed.into_iter().flatten();
        for (x, theta) in point.own.x.iter_mut().zip(prescribed) {
            x[M::Variables::LEN - 1] = theta;
        }
    }

    fn evaluate(
        point: &mut ValuesPoint<S, M, K, D>,
        in_state: &mut StatePoint<S, M, K, D>,
        rule: &Tableau,
        (view, trial): (&StepView<'_, S>, &Trial<S, D>),
        arms: &StageArms<K, S, D>,
    ) -> Result<(), StateError> {
        point.evaluate_stages(in_state, rule, (view, trial), arms)
    }

    fn write_equations(
        point: &mut ValuesPoint<S, M, K, D>,
        _: &StatePoint<S, M, K, D>,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        view: &StepView<'_, S>,
    ) -> Result<(), StateError> {
        point.write_stages(rule, local, view.step);
        Ok(())
    }

    fn force(
        point: &ValuesPoint<S, M, K, D>,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        [stage, measure]: [usize; 2],
    ) -> S {
        let at_stage = &point.own.points[stage];
        point.eliminate(rule, local, stage, &at_stage.hessian[measure]);
        at_stage.gradient[measure]
    }

    fn bases(_: &ValuesPoint<S, M, K, D>, _: &Tableau) {}

    fn direction<'a>(
        point: &'a ValuesPoint<S, M, K, D>,
        (): &'a (),
        [stage, measure]: [usize; 2],
    ) -> &'a Arms<K, S, D> {
        &point.own.gradients[stage].as_ref()[measure]
    }

    fn turn(
        point: &ValuesPoint<S, M, K, D>,
        rule: &Tableau,
        set: usize,
        arms: &StageArms<K, S, D>,
    ) -> Blocks<K, S, D> {
        let stage = rule.stage_of(set);
        let r = arms.of_set(set);
        let measures = measures_in::<K, S, D>(&point.own.x[stage]);
        let forces = measures_in::<K, S, D>(&point.own.points[stage].gradient);
        point.kinematics.curvature(&r, &measures, &forces)
    }

    fn temperature(
        point: &ValuesPoint<S, M, K, D>,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        set: usize,
    ) -> S {
        let mut by = M::Variables::filled(S::zero());
        by[M::Variables::LEN - 1] = S::one();
        let stage = rule.entropies[set].unknown;
        point.eliminate(rule, local, stage, &by);
        point.temperature(stage)
    }

    fn by_arms(
        point: &ValuesPoint<S, M, K, D>,
        (): &(),
        rule: &Tableau,
        local: &LocalStages<S>,
    ) -> [Arms<K, S, D>; MOST_SETS] {
        let measures = local.row[1..].chunks_exact(M::MEASURES);
        let mut by_arm = [Arms::<K, S, D>::filled([S::zero(); D]); MOST_SETS];
        let sets = by_arm.iter_mut().take(rule.sets()).zip(measures);
        for (set, (sum, measures)) in sets.enumerate() {
            let rows = point.own.gradients[rule.stage_of(set)].as_ref().iter();
            for (row, &by) in rows.zip(measures) {
                add_scaled::<K, S, D>(sum, by, row);
            }
        }
        by_arm
    }

    fn inputs(
        point: &ValuesPoint<S, M, K, D>,
        rule: &Tableau,
        motions: &[Arms<K, S, D>; MOST_SETS],
        inputs: &mut [S],
    ) {
        for (set, measures) in inputs.chunks_exact_mut(M::MEASURES).enumerate() {
            let rows = point.own.gradients[rule.stage_of(set)].as_ref().iter();
            for (input, row) in measures.iter_mut().zip(rows) {
                *input = along::<K, S, D>(row, &motions[set]);
            }
        }
    }

    fn hold(point: &mut ValuesPoint<S, M, K, D>) {
        point.own.previous = point.own.x;
        point.own.correction = [M::Variables::filled(S::zero()); MOST_STAGES];
    }

    fn correct(point: &mut ValuesPoint<S, M, K, D>, rule: &Tableau, local: &LocalStages<S>) -> S {
        let last = M::Variables::LEN - 1;
        let mut largest = S::zero();
        for u in 0..local.unknowns() {
            let change = local.change(&point.solved, u);
            let creeping = rule.sets() * M::DASHPOTS;
            let (stage, index, scale) = if u < creeping {
                let stage = rule.stage_of(u / M::DASHPOTS);
                (stage, M::MEASURES + u % M::DASHPOTS, point.viscous_unit)
            } else {
                let stage = rule.entropies[u - creeping].unknown;
                (stage, last, point.temperature(stage))
            };
            point.own.correction[stage][index] = change;
            largest = largest.maximum((change / scale).abs());
        }
        largest
    }

    /// Viscous stretches linearly, temperatures in their logarithms, so that they stay positive.
    fn apply(point: &mut ValuesPoint<S, M, K, D>, rule: &Tableau, share: S) {
        let (last, is_given) = (M::Variables::LEN - 1, point.prescribed.is_some());
        let own = &mut point.own;
        for stage in rule.known..rule.stages() {
            for index in M::MEASURES..M::MEASURES + M::DASHPOTS {
                let change = share * own.correction[stage][index];
                own.x[stage][index] = own.previous[stage][index] + change;
            }
        }
        if !M::THERMAL || is_given {
            return;
        }
        for stage in rule.entropies.iter().map(|balance| balance.unknown) {
            let change = share * own.correction[stage][last];
            own.x[stage][last] = grown(own.previous[stage][last], change);
        }
        for (stage, shares) in rule.temperatures.iter().enumerate() {
            let terms = shares.iter().zip(rule.entropies);
            let mean = terms.fold(S::zero(), |sum, (&share, balance)| {
                sum + S::from_f64(share) * own.x[balance.unknown][last]
            });
            own.x[stage][last] = mean;
        }
    }

    fn pull(
        point: &ValuesPoint<S, M, K, D>,
        rule: &Tableau,
        stage: usize,
        arms: &StageArms<K, S, D>,
    ) -> K::PerNode<[S; D]> {
        point.pull(rule, stage, arms)
    }

    fn secant(point: &ValuesPoint<S, M, K, D>, stage: usize) -> Weights<K, S, D> {
        point.secant(stage)
    }

    fn close(
        point: &mut ValuesPoint<S, M, K, D>,
        in_state: &mut StatePoint<S, M, K, D>,
        rule: &Tableau,
        (view, _, r1): (&StepView<'_, S>, &Trial<S, D>, &Arms<K, S, D>),
        next: &mut State<S>,
        _: &mut Tally<S>,
    ) -> Result<(), StateError> {
        point.book(rule, in_state.slots(), view, next);
        let near = point.temperature(rule.stages() - 1);
        if let Some(entropy) = in_state.settle(r1, view, near, next)? {
            point.book_thermostat(rule, view.step, entropy, next);
        }
        Ok(())
    }
}

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, const D: usize> ValuesPoint<S, M, K, D> {
    /// The temperature of a stage, K; only for elements that have one.
    fn temperature(&self, stage: usize) -> S {
        self.own.x[stage][M::Variables::LEN - 1]
    }
}

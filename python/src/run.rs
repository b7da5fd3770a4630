//! A run whose dimension is known when the program runs.

use std::ops::ControlFlow;
use std::sync::{Arc, Mutex};

use eem::{
    Checkpoint, Element, GradientError, History, Node, RestoreError, RunEnd, SceneError, Scheme,
    Sensitivities, Simulation, StepError, StepReport, StepStatistics, Tolerance,
};

use eem::nalgebra::Matrix3;
use eem::typed::Law;
use eem_gradients::Gradients;

use crate::built::Parts;
use crate::gradient::{Found, Term, gradient, objective};
use crate::record::entries;
use crate::sensitivities::{Asked, Given};
use crate::watch::Watch;

/// Sees a run after each step.
pub(crate) type Observer<'a> =
    &'a mut dyn FnMut(&dyn AnyRun, &StepReport) -> Result<ControlFlow<()>, SceneError>;

/// Why a run has ended early.
pub(crate) enum Stop {
    Step(StepError),
    /// A quantity that was to be recorded does not exist.
    Scene(SceneError),
}

/// A run that is given back, and why.
pub(crate) type Unchanged = (Box<dyn AnyRun>, SceneError);

/// A simulation of any dimension.
pub(crate) trait AnyRun: Send {
    fn time(&self) -> f64;
    fn scheme(&self) -> Scheme;
    fn scheme_in_use(&self) -> Scheme;
    fn step_size(&self) -> f64;
    fn set_step_size(&mut self, step: f64) -> Result<(), SceneError>;
    fn step(&mut self) -> Result<StepReport, StepError>;
    fn run_until(&mut self, end: f64, observer: Observer<'_>) -> Result<RunEnd, Stop>;
    fn add_position(&self, node: Node, to: &mut Vec<f64>) -> Result<(), SceneError>;
    fn add_momentum(&self, node: Node, to: &mut Vec<f64>) -> Result<(), SceneError>;
    fn temperature(&self, element: Element) -> Result<f64, SceneError>;
    fn entropy(&self, element: Element) -> Result<f64, SceneError>;
    fn internal_energy(&self, element: Element) -> Result<f64, SceneError>;
    fn stretch(&self, element: Element) -> Result<f64, SceneError>;
    fn force(&self, element: Element) -> Result<f64, SceneError>;
    fn viscous_stretch(&self, element: Element, dashpot: usize) -> Result<f64, SceneError>;
    /// Cauchy's stress, and Green and Lagrange's strain, of a point of a solid, by rows.
    fn stress(&self, point: Element) -> Result<[f64; 9], SceneError>;
    fn strain(&self, point: Element) -> Result<[f64; 9], SceneError>;
    /// The entries of the ledger in the order of [`LEDGER`](crate::record::LEDGER), and both momenta.
    fn add_ledger(&self, to: &mut Vec<f64>);
    fn worst_step(&self) -> Option<&StepReport>;
    /// Why the result may mislead, if anything speaks for it.
    fn warning(&self) -> Option<String>;
    fn set_force(&mut self, node: Node, force: &[f64]) -> Result<(), SceneError>;
    fn set_motion(&mut self, anchor: Node, velocity: &[f64]) -> Result<(), SceneError>;
    fn set_temperature(&mut self, element: Element, temperature: f64) -> Result<(), SceneError>;
    fn control_steps(&mut self, tolerance: Tolerance) -> Result<(), SceneError>;
    fn fix_steps(&mut self);
    fn limit_steps(&mut self, limits: [f64; 2]) -> Result<(), SceneError>;
    fn step_statistics(&self) -> Option<StepStatistics>;
    fn checkpoint(&self) -> Checkpoint;
    fn restore(&mut self, checkpoint: &Checkpoint) -> Result<(), RestoreError>;
    fn with_scheme(self: Box<Self>, scheme: Scheme) -> Result<Box<dyn AnyRun>, Unchanged>;
    fn keep_history(&mut self, history: History);
    /// Looks for signals in the steps of gradients.
    fn watch_gradients(&mut self, watch: Arc<Mutex<Watch>>);
    fn gradient(
        &mut self,
        terms: &[Term],
        parts: &Parts,
        laws: &[Law],
    ) -> Result<Found, GradientError>;
    fn check_gradient(&mut self, terms: &[Term]) -> Result<(), GradientError>;
    fn sensitivities(&mut self, asked: &Asked) -> Result<Sensitivities, GradientError>;
}

impl<const D: usize> AnyRun for Simulation<D>
where
    Self: Gradients<D>,
{
    fn time(&self) -> f64 {
        self.time()
    }

    fn scheme(&self) -> Scheme {
        self.scheme()
    }

    fn scheme_in_use(&self) -> Scheme {
        self.scheme_in_use()
    }

    fn step_size(&self) -> f64 {
        self.step_size()
    }

    fn set_step_size(&mut self, step: f64) -> Result<(), SceneError> {
        self.set_step_size(step)
    }

    fn step(&mut self) -> Result<StepReport, StepError> {
        self.step()
    }

    fn run_until(&mut self, end: f64, observer: Observer<'_>) -> Result<RunEnd, Stop> {
        let mut wrong = None;
        let ended = self.run_until_with(end, |run, report| {
            observer(run, report).unwrap_or_else(|error| {
                wrong = Some(error);
                ControlFlow::Break(())
            })
        });
        match wrong {
            Some(error) => Err(Stop::Scene(error)),
            None => ended.map_err(Stop::Step),
        }
    }

    fn add_position(&self, node: Node, to: &mut Vec<f64>) -> Result<(), SceneError> {
        to.extend_from_slice(self.position(node)?.as_slice());
        Ok(())
    }

    fn add_momentum(&self, node: Node, to: &mut Vec<f64>) -> Result<(), SceneError> {
        to.extend_from_slice(self.momentum(node)?.as_slice());
        Ok(())
    }

    fn temperature(&self, element: Element) -> Result<f64, SceneError> {
        self.temperature(element)
    }

    fn entropy(&self, element: Element) -> Result<f64, SceneError> {
        self.entropy(element)
    }

    fn internal_energy(&self, element: Element) -> Result<f64, SceneError> {
        self.internal_energy(element)
    }

    fn stretch(&self, element: Element) -> Result<f64, SceneError> {
        self.stretch(element)
    }

    fn force(&self, element: Element) -> Result<f64, SceneError> {
        self.force(element)
    }

    fn viscous_stretch(&self, element: Element, dashpot: usize) -> Result<f64, SceneError> {
        self.viscous_stretch(element, dashpot)
    }

    fn stress(&self, point: Element) -> Result<[f64; 9], SceneError> {
        Ok(by_rows(&self.solid_state(point)?.stress))
    }

    fn strain(&self, point: Element) -> Result<[f64; 9], SceneError> {
        Ok(by_rows(&self.solid_state(point)?.strain))
    }

    fn add_ledger(&self, to: &mut Vec<f64>) {
        let ledger = self.ledger();
        to.extend(entries(&ledger));
        to.extend_from_slice(ledger.linear_momentum.as_slice());
        to.extend_from_slice(ledger.angular_momentum.as_slice());
    }

    fn worst_step(&self) -> Option<&StepReport> {
        self.worst_step()
    }

    fn warning(&self) -> Option<String> {
        Some(self.warning()?.to_string())
    }

    fn set_force(&mut self, node: Node, force: &[f64]) -> Result<(), SceneError> {
        self.set_force(node, fixed(force))
    }

    fn set_motion(&mut self, anchor: Node, velocity: &[f64]) -> Result<(), SceneError> {
        self.set_motion(anchor, fixed(velocity))
    }

    fn set_temperature(&mut self, element: Element, temperature: f64) -> Result<(), SceneError> {
        self.set_temperature_of(element, temperature)
    }

    fn control_steps(&mut self, tolerance: Tolerance) -> Result<(), SceneError> {
        self.control_steps(tolerance)
    }

    fn fix_steps(&mut self) {
        self.fix_steps();
    }

    fn limit_steps(&mut self, limits: [f64; 2]) -> Result<(), SceneError> {
        self.limit_steps(limits)
    }

    fn step_statistics(&self) -> Option<StepStatistics> {
        self.step_statistics()
    }

    fn checkpoint(&self) -> Checkpoint {
        self.checkpoint()
    }

    fn restore(&mut self, checkpoint: &Checkpoint) -> Result<(), RestoreError> {
        self.restore(checkpoint)
    }

    fn with_scheme(self: Box<Self>, scheme: Scheme) -> Result<Box<dyn AnyRun>, Unchanged> {
        match (*self).with_scheme(scheme) {
            Ok(run) => Ok(Box::new(run)),
            Err(refused) => {
                let error = refused.error().clone();
                Err((Box::new(refused.into_run()), error))
            }
        }
    }

    fn keep_history(&mut self, history: History) {
        self.keep_history(history);
    }

    fn watch_gradients(&mut self, watch: Arc<Mutex<Watch>>) {
        self.watch_gradients(move || match watch.lock() {
            Ok(mut watch) => watch.look(),
            Err(_) => ControlFlow::Break(()),
        });
    }

    fn gradient(
        &mut self,
        terms: &[Term],
        parts: &Parts,
        laws: &[Law],
    ) -> Result<Found, GradientError> {
        gradient(self, terms, parts, laws)
    }

    fn check_gradient(&mut self, terms: &[Term]) -> Result<(), GradientError> {
        self.confirm_gradient(&objective(terms))
    }

    fn sensitivities(&mut self, asked: &Asked) -> Result<Sensitivities, GradientError> {
        let inputs: Vec<_> = asked.inputs.iter().map(Given::input).collect();
        let quantities = asked.quantities.iter();
        let quantities = quantities.map(|(name, subject)| (name.clone(), subject.quantity()));
        self.find_sensitivities(&inputs, quantities.collect())
    }
}

fn by_rows(tensor: &Matrix3<f64>) -> [f64; 9] {
    std::array::from_fn(|entry| tensor[(entry / 3, entry % 3)])
}

/// A vector whose length was checked.
fn fixed<const D: usize>(values: &[f64]) -> [f64; D] {
    values.try_into().unwrap_or([f64::NAN; D])
}

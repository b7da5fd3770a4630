//! Whether a step may be taken at a trial state.

use super::Solver;
use super::progress::{Conclusion, Progress, Target};
use crate::element::group::{Group, StepView};
use crate::step::error::StepFailure;
use crate::step::law::Law;
use eem_material::number::scalar::{Mask, Real};

impl<S: Real, const D: usize> Solver<S, D> {
    /// Closes the step at a trial where the elements have been evaluated, and judges it.
    pub(super) fn conclude(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        target: &mut Target<'_, S>,
        progress: &mut Progress<S>,
    ) -> Conclusion<S> {
        let Target::State(next) = target else {
            return Conclusion::Found(None);
        };
        let certificate = match self.close(groups, view, next) {
            Ok(certificate) => certificate,
            Err(failure) => {
                progress.draw(S::MAX);
                if !self.scheme.is_exact() || S::LANES > 1 || progress.is_over() {
                    return Conclusion::Refused(failure);
                }
                return Conclusion::Open(S::Mask::none());
            }
        };
        if !self.scheme.is_exact() {
            return match certificate.unless_infinite(next.time.value) {
                Ok(()) => Conclusion::Found(Some(certificate)),
                Err(failure) => Conclusion::Refused(failure),
            };
        }
        if certificate.is_enough().all() {
            return Conclusion::Found(Some(certificate));
        }
        if S::LANES > 1 {
            progress.draws += 1;
            if !progress.is_over() {
                return Conclusion::Open(certificate.is_enough());
            }
        } else {
            progress.draw(self.final_residual);
            let is_settled = progress.has_stopped() && certificate.is_lawful();
            if !is_settled && !progress.is_over() {
                return Conclusion::Open(S::Mask::none());
            }
        }
        if !certificate.is_balanced() || S::LANES > 1 {
            return Conclusion::Refused(StepFailure::NotConverged {
                update: progress.last.to_f64(),
            });
        }
        match certificate.broken_law() {
            None => Conclusion::Found(Some(certificate)),
            Some((law, sizes)) => {
                let element = self.worst.filter(|_| law == Law::Energy);
                let time = view.state.time.value + view.step;
                Conclusion::Refused(law.not_kept(sizes, element, time))
            }
        }
    }

    /// The tangent at a trial where only responses have been evaluated, for another iteration.
    #[cold]
    pub(super) fn linearize_again(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) -> Result<(), StepFailure> {
        self.factors.renew();
        self.balance(view);
        self.evaluate(groups, view, true)?;
        Ok(())
    }
}

//! Proof of a step: the defects of all laws in the closed state must be rounding.

use core::mem;

use super::accounts::Accounts;
use super::bodies::Bodies;
use super::closing::FROZEN;
use super::components::Support;
use super::memory::momenta_of;
use super::{Explicit, View};
use crate::algebra::{dot, largest};
use crate::element::group::UnkeptEntropy;
use crate::step::certificate::is_wide;
use crate::step::error::StepFailure;
use crate::step::law::Law;
use crate::step::outcome::Outcome;
use eem_material::number::compensated::Total;
use eem_material::number::scalar::Scalar;

/// Roundings of the magnitude of the energy that a step may be off by, as in the certificate.
const ROUNDINGS: f64 = 64.0;

impl Accounts {
    /// Adds the energy of a component in the new state to what the [`outcome`](Self::outcome) asks for; an error unless its defect is
    /// rounding.
    #[inline]
    fn prove_energy(
        &mut self,
        index: usize,
        [residue, forgiven, counted, own]: &mut [f64; 4],
        time: f64,
    ) -> Result<(), StepFailure> {
        let present = self.scratch.progress[index].present;
        let [defect, magnitude] = present.unwrap_or_else(|| self.defect_of(index));
        let progress = &self.scratch.progress[index];
        let magnitude = magnitude + FROZEN / ROUNDINGS * progress.granularity;
        // What the bound of the step counts with the energies of both ends.
        let values = FROZEN / ROUNDINGS * progress.values;
        let bound = ROUNDINGS * f64::EPSILON * (magnitude + values);
        expect(Law::Energy, [progress.debt - defect, bound], time)?;
        *residue -= defect;
        if self.is_driven && progress.is_forgiven {
            // The rounding of this step is not that of later ones.
            self.books.targets[index].energy.add(-defect);
            *forgiven += defect;
        }
        let energy = &self.scratch.energies[index];
        *counted += magnitude + energy.excess;
        *own += self.motions[index].kinetic + energy.terms;
        Ok(())
    }

    /// Keeps the sums of a step, and proves that no entropy is lost: the residue of the energy, the part of it that is no residue of later
    /// steps, the contribution to the bound, and the terms of the energies; the last two at the start of the step, too.
    fn outcome(
        &mut self,
        correction: f64,
        [residue, forgiven, counted, own]: [f64; 4],
        ([old, mut terms], time): ([f64; 2], f64),
    ) -> Result<Outcome, StepFailure> {
        let rounding = ROUNDINGS * f64::EPSILON;
        terms += own;
        let mut bound = rounding * (old + counted);
        let old_residue = mem::replace(&mut self.books.residue, residue + forgiven);
        if self.books.terms.is_none() {
            // After a restart the terms are not those of the step that left the old residue.
            bound += old_residue.abs();
        }
        self.books.terms = Some([counted, own]);
        let (mut production, mut least) = (Total::default(), self.scratch.least);
        for progress in &self.scratch.progress {
            production.add_total(progress.production);
            if progress.least < f64::MAX {
                // The factor is rounded to ε of what was produced before the closing.
                let closed = progress.least * progress.factor;
                let closed = Scalar::minimum(closed, progress.production.value());
                least = Scalar::minimum(least, closed);
            }
        }
        let least_production = if least < f64::MAX { least } else { 0.0 };
        let lost = Scalar::minimum(least_production, 0.0);
        expect(Law::Production, [lost, 0.0], time)?;
        Ok(Outcome {
            defect: residue - old_residue,
            bound,
            is_bound_wide: is_wide(bound, terms),
            production: production.value(),
            least_production,
            // Steps beyond relaxation times are not stable.
            unresolved: 0,
            correction,
        })
    }

    /// The magnitude by which the state at the start of a step enters the bound of the energy, and its energy terms, J.
    #[cold]
    fn terms_at_start(&self, bodies: &dyn Bodies) -> [f64; 2] {
        let [mut motion, mut potential] = [0.0; 2];
        for at in 0..self.components.masses {
            let place = bodies.at(at);
            let [q, p] = place.start;
            motion += 0.5 * dot(p, p) * place.per_mass;
            for (force, q) in place.force.iter().zip(q) {
                potential += (force * q).abs();
            }
        }
        let [mut counted, mut terms] = [motion + potential, motion];
        for energy in &bodies.view().state.energies {
            counted += energy.magnitude + energy.excess;
            terms += energy.terms;
        }
        [counted, terms]
    }
}

impl<const D: usize> Explicit<D> {
    /// An error unless all defects, from the energies of the state, are rounding.
    #[inline]
    pub(super) fn prove(
        &mut self,
        correction: f64,
        view: &View<'_>,
    ) -> Result<Outcome, StepFailure> {
        let time = view.end();
        if let Some(UnkeptEntropy { element, sizes }) = self.scratch.unkept {
            return Err(Law::KeptEntropy.not_kept(sizes, Some(element), time));
        }
        let mut sums = [0.0; 4];
        for index in 0..self.components.all.len() {
            self.prove_energy(index, &mut sums, time)?;
            self.prove_momenta(index, time)?;
        }
        let start = self.books.terms.unwrap_or_else(|| {
            let (accounts, bodies) = self.parts(view);
            accounts.terms_at_start(&bodies)
        });
        self.accounts.outcome(correction, sums, (start, time))
    }

    /// An error unless the conserved momenta of a component are their targets, in all planes.
    #[inline]
    fn prove_momenta(&mut self, index: usize, time: f64) -> Result<(), StepFailure> {
        let support = self.components.all[index].support;
        if support == Support::Several {
            return Ok(());
        }
        let rounding = ROUNDINGS * f64::EPSILON;
        let missing = self.missing_momenta(index);
        // Sums of magnitudes are at most √D times a length.
        let [momenta, moments] = self.motions[index].terms;
        let mut dimension = 0.0;
        for _ in 0..D {
            dimension += 1.0;
        }
        if support == Support::Free {
            let bound = rounding * (momenta / dimension.sqrt());
            expect(Law::LinearMomentum, [largest(&missing.linear), bound], time)?;
        }
        let own = rounding * (moments / dimension);
        let left = missing.angular.largest();
        let mut bound = own + rounding * (self.scratch.progress[index].moment / dimension);
        if !(left <= own) {
            bound += rounding * (self.moment_at_start(index) / dimension);
        }
        expect(Law::AngularMomentum, [left, bound], time)?;
        // What momenta cannot correct, as those of masses on a line, which have no angular momentum along the line. Where it is the
        // rounding of this step, it is no defect of later ones: by their smaller momenta it would not be explained. Nor where it is more
        // than half the digits of J, for example of masses that are pushed along a line: a later step would turn them by it over J.
        let is_half_of_digits =
            || left > f64::EPSILON.sqrt() * self.angular_target(index).largest();
        if left > own || (D > 2 && is_half_of_digits()) {
            let targets = &mut self.books.momenta[momenta_of(index, D)];
            missing.each(&mut |at, left| {
                if at >= D {
                    targets[at].add(-left);
                }
            });
        }
        Ok(())
    }
}

/// An error if the defect of a law exceeds its bound or is NaN.
#[inline]
fn expect(law: Law, [defect, bound]: [f64; 2], time: f64) -> Result<(), StepFailure> {
    if defect.abs() <= bound {
        return Ok(());
    }
    Err(law.not_kept([defect, bound], None, time))
}

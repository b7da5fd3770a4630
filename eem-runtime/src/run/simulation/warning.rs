//! Warnings: what steps that keep all laws leave unsaid.

use core::fmt;
use std::collections::BTreeSet;

use super::Simulation;
use super::memory::Unresolved;
use crate::element::handle::Element;
use crate::step::newton::StepReport;
use crate::step::scheme::Scheme;
use eem_material::number::scalar::Real;

/// Steps that keep all laws, but may mislead. See [`Simulation::warning`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Warning {
    /// Conduction or dashpots relax faster than the steps resolve. The scheme does not damp them: differences of temperatures and
    /// stretches of dashpots alternate or stay, and do not decay.
    Unresolved {
        /// The element that relaxes fastest at present.
        element: Element,
        /// Its relaxation time, s.
        relaxation: f64,
        /// The largest step that did not resolve a relaxation, s.
        step: f64,
        /// The number of such steps.
        steps: u64,
        /// The scheme of the last of them.
        scheme: Scheme,
    },
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self::Unresolved {
            element,
            relaxation,
            step,
            steps,
            scheme,
        } = self;
        let most = 2.0 * relaxation;
        write!(
            f,
            "{steps} steps of up to {step:e} s do not resolve fast conduction or dashpots, which alternate or stay with {scheme} \
             instead of decaying. {element} relaxes in {relaxation:e} s: use eem-damped, or steps below {most:e} s"
        )
    }
}

impl<const D: usize, S: Real> Simulation<D, S> {
    /// Notes a step that did not resolve a relaxation.
    #[cold]
    pub(super) fn note_unresolved(&mut self, report: &StepReport<S>) {
        if self.in_use.is_damped() {
            return;
        }
        let largest = self.unresolved.largest.maximum(report.step);
        self.unresolved = Unresolved {
            steps: self.unresolved.steps + 1,
            largest,
            scheme: self.in_use,
        };
    }

    /// Why the result of the steps so far may mislead although every one has kept its laws; `None` if nothing speaks for it, and in
    /// lanes.
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// #[derive(FreeEnergy)]
    /// #[free_energy(|lambda: Stretch, theta: Temperature| {
    ///     0.5 * (lambda - 1).powi(2) + c * (theta - theta * ln(theta / 300))
    /// })]
    /// struct Body { c: f64 }
    ///
    /// let scene = || {
    ///     let mut scene = Scene::<1>::new();
    ///     let ends = [scene.anchor([0.0]), scene.anchor([1.0])];
    ///     let [hot, cold] = [373.15, 273.15].map(|theta| {
    ///         let body = scene.spring(Body { c: 15.0 }, ends);
    ///         scene.set_temperature(body, theta);
    ///         body
    ///     });
    ///     scene.conduct(hot, cold, 1e6);
    ///     (scene, hot)
    /// };
    /// let (undamped, hot) = scene();
    /// let mut run = Simulation::new(undamped, Scheme::EemTemperature, 1.0)?;
    /// run.run_until(100.0)?;
    /// // The bodies have exchanged their temperatures a hundred times.
    /// assert!((run.temperature(hot)? - 373.00).abs() < 0.01);
    /// let warning = run.warning().expect("1 s is far above the relaxation time of 7.5e-6 s");
    /// assert!(warning.to_string().contains("relaxes in 7.5e-6 s: use eem-damped"), "{warning}");
    ///
    /// let (damped, hot) = scene();
    /// let mut run = Simulation::new(damped, Scheme::EemDamped, 1.0)?;
    /// run.run_until(100.0)?;
    /// assert!((run.temperature(hot)? - 323.15).abs() < 1e-9);
    /// assert_eq!(run.warning(), None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn warning(&self) -> Option<Warning> {
        let Unresolved {
            steps,
            largest,
            scheme,
        } = self.unresolved;
        if steps == 0 {
            return None;
        }
        let held = self.loads.temperatures.iter();
        let held: BTreeSet<usize> = held.map(|(element, _)| element.index()).collect();
        let all = 0..self.places.len();
        let finite = all.map(|index| (self.relaxation(index, held.contains(&index)), index));
        let finite = finite.filter(|(relaxation, _)| relaxation.is_finite());
        let (relaxation, index) = finite.min_by(|(a, _), (b, _)| a.total_cmp(b))?;
        let [group, place] = self.places[index];
        let elements = self.stepper.elements(group as usize);
        Some(Warning::Unresolved {
            element: elements.handle(place as usize),
            relaxation,
            step: largest.to_f64(),
            steps,
            scheme,
        })
    }

    /// The relaxation time of an element in the present state, s: that of its conduction, `c/(2 Σ κ to elements + Σ κ to
    /// reservoirs)` unless its temperature is prescribed, or that of a dashpot if that is shorter.
    fn relaxation(&self, index: usize, is_held: bool) -> f64 {
        let [group, place] = self.places[index];
        let elements = self.stepper.elements(group as usize);
        let mut time = elements.relaxation(place as usize, &self.state).to_f64();
        let slot = elements.slots(place as usize).thermal;
        if let Some(slot) = slot.filter(|_| !is_held) {
            let conductance = self.conduction.settling(slot).to_f64();
            let heat_capacity = self.state.energies[index].heat_capacity.to_f64();
            time = time.min(0.5 * heat_capacity / conductance);
        }
        time
    }
}

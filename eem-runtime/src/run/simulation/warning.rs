//! Warnings: what steps that keep all laws leave unsaid.

use core::fmt;

use super::memory::Unresolved;
use super::{Run, Simulation};
use crate::algebra::ascending;
use crate::element::handle::Element;
use crate::step::scheme::Scheme;
use eem_material::number::scalar::Scalar;

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
            "steps of up to {step:.3e} s ({steps} so far) do not resolve fast conduction or dashpots, which alternate or stay with \
             {scheme} instead of decaying. {element} relaxes in {relaxation:.3e} s: use eem-damped, a tolerance, or steps below \
             {most:.3e} s"
        )
    }
}

impl<const D: usize> Simulation<D> {
    /// Why the result of the steps so far may mislead although every one has kept its laws; `None` if nothing speaks for it,
    /// and while a tolerance [controls](Self::control_steps) the steps: then their errors are known.
    ///
    /// ```
    /// use eem::materials::ThermoelasticSpring;
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<1>::new();
    /// let ends = [scene.anchor([0.0]), scene.anchor([1.0])];
    /// let [hot, cold] = [373.15, 273.15].map(|theta| {
    ///     let body = ThermoelasticSpring { stiffness: 1.0, coupling: 0.0, capacity: 15.0, natural_length: 1.0, theta_ref: 300.0 };
    ///     let body = scene.spring(body, ends);
    ///     scene.set_temperature(body, theta);
    ///     body
    /// });
    /// scene.conduct(hot, cold, 1e6);
    /// let mut run = Simulation::new(scene, Scheme::EemTemperature, 1.0)?;
    /// run.run_until(100.0)?;
    /// // The bodies have exchanged their temperatures a hundred times.
    /// assert!((run.temperature(hot)? - 373.00).abs() < 0.01);
    /// let warning = run.warning().expect("1 s is far above the relaxation time of 7.5e-6 s");
    /// assert!(warning.to_string().contains("relaxes in 7.500e-6 s: use eem-damped"), "{warning}");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn warning(&self) -> Option<Warning> {
        let seen = self.run.unresolved;
        if seen.steps == 0 || self.run.control.is_some() {
            return None;
        }
        let (relaxation, element) = self.run.fastest_relaxation()?;
        Some(Warning::Unresolved {
            element,
            relaxation,
            step: seen.largest,
            steps: seen.steps,
            scheme: seen.scheme,
        })
    }
}

impl Run {
    /// Notes that the last step did not resolve a relaxation.
    #[cold]
    pub(super) fn note_unresolved(&mut self) {
        let report = &self.report;
        let largest = Scalar::maximum(self.unresolved.largest, report.step);
        self.unresolved = Unresolved {
            steps: self.unresolved.steps + 1,
            points: self.unresolved.points + report.unresolved as u64,
            last: report.unresolved,
            largest,
            scheme: self.in_use,
        };
    }

    /// The shortest relaxation time in the present state, s, and its element: of a dashpot, or `c/(2 Σ κ to elements + Σ κ to
    /// reservoirs)` of a conduction unless a thermostat prescribes the temperature.
    pub(super) fn fastest_relaxation(&self) -> Option<(f64, Element)> {
        let held = self.loads.temperatures.iter();
        let held = ascending(held.map(|(element, _)| element.index()).collect());
        let mut fastest: Option<(f64, Element)> = None;
        self.stepper.stiffness(&self.state, &mut |place, point| {
            let element = self.stepper.handle(place);
            let mut rate = point.relaxation;
            if let Some((slot, capacity)) = point.capacity
                && held.binary_search(&element.index()).is_err()
            {
                let settling = self.conduction.settling(slot);
                rate = rate.max(2.0 * settling / capacity);
            }
            let time = rate.recip();
            if time.is_finite() && fastest.is_none_or(|(least, _)| time < least) {
                fastest = Some((time, element));
            }
        });
        fastest
    }
}

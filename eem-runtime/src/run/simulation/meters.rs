//! Sums of the heat that dashpots dissipate, the entropy that elements produce, and the heat that paths conduct.

use core::sync::atomic::Ordering;

use super::{Run, Simulation};
use crate::element::handle::{Element, HeatPath};
use crate::element::meters::{Meters, total};
use crate::run::checkpoint::{RestoreError, expect_count};
use crate::scene::error::SceneError;
use eem_material::number::compensated::Sum;

/// # Dissipation and heat
///
/// The sums begin with [`meter_heat`](Self::meter_heat), or with a [`Recorder`](crate::Recorder) of such quantities.
impl<const D: usize> Simulation<D> {
    /// Begins the sums of dissipation, entropy production and conducted heat, if they have not begun.
    ///
    /// They are exactly what the steps book, also under step control and by [`Scheme::Auto`](crate::Scheme::Auto), and part of
    /// checkpoints.
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// #[derive(FreeEnergy)]
    /// #[free_energy(|lambda: Stretch, gamma: Viscous| {
    ///     0.5 * k * (lambda - 1).powi(2) + 0.5 * mu * (lambda - 1 - gamma).powi(2)
    /// })]
    /// #[viscosity(gamma = eta)]
    /// struct Maxwell { k: f64, mu: f64, eta: f64 }
    ///
    /// let mut scene = Scene::<1>::new();
    /// let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.2], [0.0])];
    /// let damper = scene.spring(Maxwell { k: 4.0, mu: 10.0, eta: 2.0 }, ends);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// run.meter_heat();
    /// run.run_until(5.0)?;
    /// // Its heat leaves the scene.
    /// assert!((run.dissipation(damper)? - run.ledger().lost_heat).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn meter_heat(&mut self) {
        self.request_meters();
        self.run.begin_meters();
    }

    /// Begins the sums at the next step.
    pub(crate) fn request_meters(&self) {
        self.run.wants_meters.store(true, Ordering::Relaxed);
    }

    /// A sum, zero before the sums began, if the scheme closes its balances, by which it is defined.
    fn meter(&self, sum: impl FnOnce(&Meters) -> Sum) -> Result<Sum, SceneError> {
        if !self.run.in_use.is_exact() {
            let scheme = self.run.in_use.name();
            return Err(SceneError::NotMetered { scheme });
        }
        let meters = Some(&self.run.state.meters).filter(|meters| meters.are_on);
        Ok(meters.map_or(Sum::new(0.0), sum))
    }

    /// The heat that the dashpots of an element have dissipated since the sums began, J; zero before.
    ///
    /// A step books `η γ̇² h` for a dashpot; the explicit scheme books the integral of `g γ̇` over its stages.
    ///
    /// # Errors
    ///
    /// For a foreign handle; [`SceneError::NotMetered`] for a scheme without exact balances.
    pub fn dissipation(&self, element: Element) -> Result<f64, SceneError> {
        Ok(self.dissipation_sum(element)?.value)
    }

    pub(crate) fn dissipation_sum(&self, element: Element) -> Result<Sum, SceneError> {
        self.run.expect_own(&element)?;
        self.meter(|meters| {
            let first = self.run.slots(element).viscous;
            let in_series = first..first + self.run.shape(element).dashpots;
            let all = in_series.chain([self.run.layout.viscous + element.index()]);
            total(all.map(|dashpot| meters.dissipated.sum(dashpot)))
        })
    }

    /// The heat that one dashpot (from 0) of an element has dissipated since the sums began, J; zero before. The dashpots in
    /// parallel with the spring count as one, the last; the components of a viscous strain come before it.
    ///
    /// # Errors
    ///
    /// As [`dissipation`](Self::dissipation); [`SceneError::NoSuchDashpot`].
    pub fn dissipation_of(&self, element: Element, dashpot: usize) -> Result<f64, SceneError> {
        Ok(self.dissipation_sum_of(element, dashpot)?.value)
    }

    pub(crate) fn dissipation_sum_of(
        &self,
        element: Element,
        dashpot: usize,
    ) -> Result<Sum, SceneError> {
        self.run.expect_own(&element)?;
        let shape = self.run.shape(element);
        let dashpots = shape.dashpots + usize::from(shape.drag);
        SceneError::expect_dashpot(element, dashpot, dashpots)?;
        let index = if dashpot < shape.dashpots {
            self.run.slots(element).viscous + dashpot
        } else {
            self.run.layout.viscous + element.index()
        };
        self.meter(|meters| meters.dissipated.sum(index))
    }

    /// The entropy that an element has produced since the sums began, J/K; zero before: that of its dashpots, of its paths of
    /// heat to reservoirs, and half of that of its paths to other elements, which count the other half.
    ///
    /// # Errors
    ///
    /// As [`dissipation`](Self::dissipation); [`SceneError::NotThermal`] if the element has no temperature.
    pub fn produced_entropy(&self, element: Element) -> Result<f64, SceneError> {
        Ok(self.produced_sum(element)?.value)
    }

    pub(crate) fn produced_sum(&self, element: Element) -> Result<Sum, SceneError> {
        let slot = self.run.thermal_slot(element)?;
        self.meter(|meters| meters.produced.sum(slot))
    }

    /// The heat that a path has brought to the element with which it was [made](crate::Scene::conduct), from its partner, since
    /// the sums began, J; zero before.
    ///
    /// # Errors
    ///
    /// As [`dissipation`](Self::dissipation).
    pub fn conducted_heat(&self, path: HeatPath) -> Result<f64, SceneError> {
        Ok(self.conducted_sum(path)?.value)
    }

    pub(crate) fn conducted_sum(&self, path: HeatPath) -> Result<Sum, SceneError> {
        self.run.expect_own(&path)?;
        self.meter(|meters| {
            let (link, is_second) = self.run.conduction.path(path.index);
            let Sum { value, carry } = meters.conducted.sum(link);
            let sign = if is_second { -1.0 } else { 1.0 };
            Sum {
                value: sign * value,
                carry: sign * carry,
            }
        })
    }
}

impl Run {
    /// Begins the sums if they are wanted and have not begun.
    #[inline]
    pub(super) fn begin_meters(&mut self) {
        if self.wants_meters.load(Ordering::Relaxed) && !self.state.meters.are_on {
            self.state.meters = Meters::new(self.meter_counts());
        }
    }

    /// The numbers of sums: of dissipation, entropy production and conducted heat.
    fn meter_counts(&self) -> [usize; 3] {
        let dashpots = self.layout.viscous + self.places.len();
        [dashpots, self.layout.thermal, self.conduction.count()]
    }

    /// An error unless a checkpoint has as many sums as this simulation.
    pub(super) fn audit_meters(&self, meters: &Meters) -> Result<(), RestoreError> {
        let expected = if meters.are_on {
            self.meter_counts()
        } else {
            [0; 3]
        };
        let names = ["heat of dashpots", "entropy production", "conducted heat"];
        let own = meters.counts();
        for (index, quantity) in names.into_iter().enumerate() {
            expect_count(quantity, own[index], expected[index])?;
        }
        Ok(())
    }
}

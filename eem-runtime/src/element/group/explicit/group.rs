//! The elements of one model in an explicit scheme.

use crate::element::conjugates::{Conjugates, OneSet, PointRule};
use crate::element::ends::Ends;
use crate::element::error::StateError;
use crate::element::group::explicit::closed::Closed;
use crate::element::group::explicit::point::ExplicitPoint;
use crate::element::group::explicit::stage::{Place, Stage};
use crate::element::group::explicit::view::ClosingView;
use crate::element::group::interface::{Elements, ExplicitGroup, Group, Loose};
use crate::element::group::view::Placed;
use crate::element::kinematics::Kinematics;
use eem_material::free_energy::Material;

/// Springs of the model `M` with the kinematics `K`. Their forces follow from the state alone.
pub(crate) struct ExplicitElements<M: Material, K: Kinematics<D>, const D: usize> {
    points: Vec<ExplicitPoint<M, K, D>>,
    /// Per element: its last evaluation in a closing.
    closed: Vec<Closed<M, K, D>>,
    /// The elements in a state, whose models may be behind a table.
    all: Box<dyn Group<D>>,
}

impl<M: Material, K: Kinematics<D>, const D: usize> ExplicitElements<M, K, D> {
    /// The springs `points`, which are all of `loose`.
    pub(crate) fn new(
        points: Vec<ExplicitPoint<M, K, D>>,
        loose: Box<dyn Loose<D>>,
        placed: Placed<'_>,
    ) -> Self {
        let rule = OneSet::Point(PointRule::Variational);
        Self {
            closed: points.iter().map(|_| Closed::none()).collect(),
            points,
            all: loose.build(Conjugates::One(rule), placed),
        }
    }
}

impl<M: Material, K: Kinematics<D>, const D: usize> ExplicitGroup<D> for ExplicitElements<M, K, D> {
    fn elements(&self) -> &dyn Elements {
        self.all.elements()
    }

    fn elements_mut(&mut self) -> &mut dyn Elements {
        self.all.elements_mut()
    }

    fn into_loose(self: Box<Self>) -> Box<dyn Loose<D>> {
        self.all.into_loose()
    }

    fn join(&mut self, (component_of, places): (&[u32], &Ends), first_temperature: usize) {
        for point in &mut self.points {
            let element = point.element.index();
            let places = places.of(element);
            point.join((component_of[element], places), first_temperature);
        }
    }

    fn rates(&self, places: &mut [Place<D>], stage: &mut Stage) -> Result<(), StateError> {
        // Known from here on, so that an index is checked once for both.
        assert!(
            stage.inner.len() == stage.inner_rates.len(),
            "each internal variable has a rate"
        );
        for point in &self.points {
            if !point.add_rates(places, stage) {
                return Err(point.refuse((places, stage)));
            }
        }
        Ok(())
    }

    fn integrate_thermostats(&self, places: &[Place<D>], stage: &mut Stage, is_start: bool) {
        for point in &self.points {
            let held = point.slot().filter(|&slot| stage.is_held(slot));
            if let Some(slot) = held {
                point.integrate_thermostat(slot, (places, stage), is_start);
            }
        }
    }

    fn close(&mut self, view: &mut ClosingView<'_, D>) -> Result<(), StateError> {
        for (point, closed) in self.points.iter().zip(&mut self.closed) {
            if view.open[point.component as usize] {
                point.close_at(view, closed)?;
            }
        }
        Ok(())
    }

    fn pull(&self, components: &[bool], forces: &mut [[f64; D]], creep: &mut [[f64; 2]]) {
        for (point, closed) in self.points.iter().zip(&self.closed) {
            if components[point.component as usize] {
                point.pull_at(closed, (forces, creep));
            }
        }
    }

    fn finish(&self, places: &mut [Place<D>], stage: &mut Stage) -> Result<(), StateError> {
        for (point, closed) in self.points.iter().zip(&self.closed) {
            let theta = point.temperature_in(stage);
            let found = closed.at(theta, point.model.dashpots());
            if !point.write_rates(&found, (&mut *places, &mut *stage)) {
                return Err(point.refuse((places, stage)));
            }
        }
        Ok(())
    }
}

//! The least value of `J = A/A₁ + w R/R₁` for each weight w.

use std::error::Error;

use eem::Scheme;

use super::balance;
use super::ride::{Design, Ride, Slopes, drive};
use eem_studies::claims::Claims;
use eem_studies::least::{self, Point};
use eem_studies::progress::Progress;
use eem_studies::time_grid::TimeGrid;

/// Iterations of the optimiser for a weight, and the change of J at which it ends.
const ITERATIONS: u64 = 30;
const CHANGE: f64 = 1e-11;

/// Runs that all weights take, about.
const RUNS: usize = 150;

/// By how much designs nearby differ in the logarithm of an unknown.
const NEARBY: f64 = 0.02;

/// What all runs have in common.
pub(crate) struct Runs {
    scheme: Scheme,
    grid: TimeGrid,
    /// The car as it was.
    pub(crate) first: Ride,
    count: usize,
    progress: Progress,
    /// Every run keeps the laws.
    pub(crate) claims: Claims,
}

/// The best design for a weight.
#[derive(Clone, Debug)]
pub(crate) struct Best {
    pub(crate) weight: f64,
    pub(crate) design: Design,
    pub(crate) objective: f64,
    pub(crate) ride: Ride,
    /// Runs that it took.
    pub(crate) runs: usize,
}

impl Runs {
    /// With the car as it was.
    pub(crate) fn start(scheme: Scheme, grid: TimeGrid) -> Result<Self, Box<dyn Error>> {
        let (first, _) = drive(scheme, grid, Design::FIRST, None)?;
        let mut claims = Claims::default();
        balance::check(&first.record, &mut claims);
        Ok(Self {
            scheme,
            grid,
            first,
            count: 1,
            progress: Progress::new("runs", RUNS),
            claims,
        })
    }

    /// `∂J/∂A` and `∂J/∂R`.
    fn slopes(&self, weight: f64) -> Slopes {
        let Ride {
            acceleration, room, ..
        } = self.first;
        [acceleration.powi(-2), weight * room.powi(-2)]
    }

    /// J of a design; with its gradient, or zeros.
    fn run(
        &mut self,
        weight: f64,
        design: Design,
        has_gradient: bool,
    ) -> Result<Point<Ride>, Box<dyn Error>> {
        let slopes = self.slopes(weight);
        let asked = has_gradient.then_some(slopes);
        let (ride, gradient) = drive(self.scheme, self.grid, design, asked)?;
        balance::check(&ride.record, &mut self.claims);
        self.count += 1;
        self.progress.advance(self.count);
        let [by_acceleration, by_room] = slopes;
        Ok(Point {
            place: design.0.to_vec(),
            value: by_acceleration * ride.acceleration.powi(2) + by_room * ride.room.powi(2),
            gradient: gradient.to_vec(),
            of: ride,
        })
    }

    /// The best design for a weight, from another one.
    pub(crate) fn best(&mut self, weight: f64, start: Design) -> Result<Best, Box<dyn Error>> {
        let first = self.run(weight, start, true)?;
        let found = least::search(first, (ITERATIONS, CHANGE), |place| {
            self.run(weight, Design([place[0], place[1]]), true)
        })?;
        let best = least::least(&found).ok_or("nothing was run")?;
        Ok(Best {
            weight,
            design: Design([best.place[0], best.place[1]]),
            objective: best.value,
            ride: best.of.clone(),
            runs: found.len(),
        })
    }

    /// The least J of designs that differ a little in one unknown.
    pub(crate) fn least_nearby(&mut self, best: &Best) -> Result<f64, Box<dyn Error>> {
        let mut least = f64::INFINITY;
        for unknown in [0, 1] {
            for change in [-NEARBY, NEARBY] {
                let mut design = best.design;
                design.0[unknown] += change;
                least = least.min(self.run(best.weight, design, false)?.value);
            }
        }
        Ok(least)
    }
}

//! The least value of `J = A/A₁ + w R/R₁` for each weight w.

use std::cell::{Cell, RefCell};
use std::error::Error;

use argmin::core::{CostFunction, Error as ArgminError, Executor, Gradient, State};
use argmin::solver::linesearch::MoreThuenteLineSearch;
use argmin::solver::quasinewton::LBFGS;
use eem::Scheme;

use super::ride::{Design, Ride, Slopes, drive};
use eem_studies::progress::Progress;
use eem_studies::record::Record;
use eem_studies::time_grid::TimeGrid;

/// Iterations of the optimiser for a weight, and the change of J at which it ends.
const ITERATIONS: u64 = 30;
const CHANGE: f64 = 1e-11;

/// By how much designs nearby differ in the logarithm of an unknown.
const NEARBY: f64 = 0.02;

/// All runs so far.
pub(crate) struct Runs {
    scheme: Scheme,
    grid: TimeGrid,
    first: Ride,
    made: RefCell<Vec<Record>>,
    progress: RefCell<Progress>,
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

/// Runs for one weight; the last point is remembered, as the optimiser asks for its value and for its gradient.
struct Weighted<'a> {
    runs: &'a Runs,
    weight: f64,
    last: RefCell<Option<Point>>,
    count: Cell<usize>,
}

/// A design with value and gradient.
struct Point {
    place: Vec<f64>,
    value: f64,
    gradient: [f64; 2],
}

impl Runs {
    /// With the car as it was.
    pub(crate) fn start(scheme: Scheme, grid: TimeGrid) -> Result<Self, Box<dyn Error>> {
        let (first, _) = drive(scheme, grid, Design::FIRST, None)?;
        Ok(Self {
            scheme,
            grid,
            made: RefCell::new(vec![first.record.clone()]),
            first,
            progress: RefCell::new(Progress::new("runs", 100)),
        })
    }

    /// The car as it was.
    pub(crate) const fn first(&self) -> &Ride {
        &self.first
    }

    /// The records of all runs.
    pub(crate) fn records(&self) -> Vec<Record> {
        self.made.borrow().clone()
    }

    /// `∂J/∂A` and `∂J/∂R`.
    fn slopes(&self, weight: f64) -> Slopes {
        let Ride {
            acceleration, room, ..
        } = self.first;
        [acceleration.powi(-2), weight * room.powi(-2)]
    }

    fn objective(&self, weight: f64, ride: &Ride) -> f64 {
        let [by_acceleration, by_room] = self.slopes(weight);
        by_acceleration * ride.acceleration.powi(2) + by_room * ride.room.powi(2)
    }

    fn note(&self, record: Record) {
        let mut made = self.made.borrow_mut();
        made.push(record);
        self.progress.borrow_mut().advance(made.len());
    }

    /// The best design for a weight, from another one.
    pub(crate) fn best(&mut self, weight: f64, start: Design) -> Result<Best, Box<dyn Error>> {
        let problem = Weighted {
            runs: self,
            weight,
            last: RefCell::new(None),
            count: Cell::new(0),
        };
        let search = LBFGS::new(MoreThuenteLineSearch::new(), 5)
            .with_tolerance_grad(1e-9)?
            .with_tolerance_cost(CHANGE)?;
        let found = Executor::new(&problem, search)
            .configure(|state| state.param(start.0.to_vec()).max_iters(ITERATIONS))
            .run()?;
        let best = found
            .state()
            .get_best_param()
            .ok_or("no design was found")?;
        let design = Design([best[0], best[1]]);
        let runs = problem.count.get();
        let (ride, _) = drive(self.scheme, self.grid, design, None)?;
        Ok(Best {
            weight,
            design,
            objective: self.objective(weight, &ride),
            ride,
            runs,
        })
    }

    /// The least J of designs that differ a little in one unknown.
    pub(crate) fn least_nearby(&self, best: &Best) -> Result<f64, Box<dyn Error>> {
        let mut least = f64::INFINITY;
        for unknown in [0, 1] {
            for change in [-NEARBY, NEARBY] {
                let mut design = best.design;
                design.0[unknown] += change;
                let (ride, _) = drive(self.scheme, self.grid, design, None)?;
                least = least.min(self.objective(best.weight, &ride));
            }
        }
        Ok(least)
    }
}

impl Weighted<'_> {
    /// What `of` says of value and gradient at a point.
    fn at<T>(&self, point: &[f64], of: impl Fn(f64, &[f64]) -> T) -> Result<T, ArgminError> {
        let mut last = self.last.borrow_mut();
        if let Some(known) = last.as_ref().filter(|known| known.place == point) {
            return Ok(of(known.value, &known.gradient));
        }
        let Self { runs, weight, .. } = *self;
        let design = Design([point[0], point[1]]);
        let found = drive(runs.scheme, runs.grid, design, Some(runs.slopes(weight)));
        let (ride, gradient) = found.map_err(|error| ArgminError::msg(error.to_string()))?;
        let value = runs.objective(weight, &ride);
        runs.note(ride.record);
        self.count.set(self.count.get() + 1);
        let said = of(value, &gradient);
        *last = Some(Point {
            place: point.to_vec(),
            value,
            gradient,
        });
        Ok(said)
    }
}

impl CostFunction for &Weighted<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, point: &Vec<f64>) -> Result<f64, ArgminError> {
        self.at(point, |value, _| value)
    }
}

impl Gradient for &Weighted<'_> {
    type Param = Vec<f64>;
    type Gradient = Vec<f64>;

    fn gradient(&self, point: &Vec<f64>) -> Result<Vec<f64>, ArgminError> {
        self.at(point, |_, by| by.to_vec())
    }
}

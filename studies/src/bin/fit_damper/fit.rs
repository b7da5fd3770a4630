//! Least squares: the optimiser, and what it asks for, which is one run with its tangents per point.

use std::cell::RefCell;
use std::error::Error;

use argmin::core::{
    CostFunction, Error as ArgminError, Executor, Gradient, Hessian, IterState, KV, Problem,
    Solver, State, TerminationReason, TerminationStatus,
};
use argmin::solver::trustregion::{Steihaug, TrustRegion};
use eem::nalgebra::Matrix3;

use super::drive::{self, Drive, Laws, Logs};
use super::recording::Recording;
use eem_studies::time_grid::TimeGrid;

/// Steps of the optimiser; a dozen is usual.
const MOST_STEPS: u64 = 60;

/// The optimiser stops where no unknown would move by more than this many of its standard deviations if the others
/// stayed.
const CLOSE: f64 = 1e-3;

/// First radius of trust, and the largest one, in logarithms.
const RADIUS: [f64; 2] = [0.3, 1.0];

/// The ride, and what was recorded of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Data<'a> {
    pub(crate) grid: TimeGrid,
    pub(crate) recording: &'a Recording,
}

/// The model near a point.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    pub(crate) logs: Logs,
    pub(crate) drive: Drive,
    /// Derivatives of the residuals by the logarithm of each unknown.
    pub(crate) jacobian: [Vec<f64>; 3],
}

impl Point {
    /// One run, and the derivatives of its steps.
    fn new(data: Data<'_>, logs: Logs, laws: &RefCell<Laws>) -> Result<Self, ArgminError> {
        let (drive, changes) = drive::follow(data.grid, &logs).map_err(ArgminError::from_boxed)?;
        laws.replace_with(|worst| worst.and(drive.laws));
        let jacobian = changes.map(|change| data.recording.in_deviations(&change));
        Ok(Self {
            logs,
            drive,
            jacobian,
        })
    }

    /// The matrix `JᵀJ`.
    pub(crate) fn normal_matrix(&self) -> Matrix3<f64> {
        Matrix3::from_fn(|i, j| dot(&self.jacobian[i], &self.jacobian[j]))
    }

    /// The covariance (JᵀJ)⁻¹ of the logarithms that a fit finds here, if the recording tells of all of them.
    pub(crate) fn covariance(&self) -> Option<Matrix3<f64>> {
        self.normal_matrix().try_inverse()
    }
}

/// r → ½ |r|² with the derivatives Jᵀr and, as Gauss and Newton have it, `JᵀJ`.
struct Misfit<'a> {
    data: Data<'a>,
    /// The last point that was asked for.
    point: RefCell<Option<Point>>,
    laws: RefCell<Laws>,
    points: RefCell<usize>,
}

impl Misfit<'_> {
    /// What `of` says of the point, which is run unless it is the last one.
    fn at<T>(&self, logs: &[f64], of: impl Fn(&Point) -> T) -> Result<T, ArgminError> {
        let mut wanted = Logs::default();
        wanted.copy_from_slice(logs);
        let is_it = |point: &&Point| point.logs.map(f64::to_bits) == wanted.map(f64::to_bits);
        let mut last = self.point.borrow_mut();
        if let Some(point) = last.as_ref().filter(is_it) {
            return Ok(of(point));
        }
        *self.points.borrow_mut() += 1;
        let point = last.insert(Point::new(self.data, wanted, &self.laws)?);
        Ok(of(point))
    }

    fn residuals(&self, point: &Point) -> Vec<f64> {
        self.data.recording.residuals(&point.drive)
    }
}

impl CostFunction for Misfit<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, logs: &Vec<f64>) -> Result<f64, ArgminError> {
        self.at(logs, |point| {
            let residuals = self.residuals(point);
            0.5 * dot(&residuals, &residuals)
        })
    }
}

impl Gradient for Misfit<'_> {
    type Param = Vec<f64>;
    type Gradient = Vec<f64>;

    fn gradient(&self, logs: &Vec<f64>) -> Result<Vec<f64>, ArgminError> {
        self.at(logs, |point| {
            let residuals = self.residuals(point);
            let columns = point.jacobian.iter();
            columns.map(|column| dot(column, &residuals)).collect()
        })
    }
}

impl Hessian for Misfit<'_> {
    type Param = Vec<f64>;
    type Hessian = Vec<Vec<f64>>;

    fn hessian(&self, logs: &Vec<f64>) -> Result<Vec<Vec<f64>>, ArgminError> {
        self.at(logs, |point| {
            let matrix = point.normal_matrix();
            let row = |i| (0..3).map(|j| matrix[(i, j)]).collect();
            (0..3).map(row).collect()
        })
    }
}

type Region = TrustRegion<Steihaug<Vec<f64>, f64>, f64>;
type Iterate = IterState<Vec<f64>, Vec<f64>, (), Vec<Vec<f64>>, (), f64>;

/// The trust region of `argmin`, which has no end of its own.
struct UntilClose(Region);

impl Solver<Misfit<'_>, Iterate> for UntilClose {
    fn name(&self) -> &'static str {
        "trust region"
    }

    fn init(
        &mut self,
        problem: &mut Problem<Misfit<'_>>,
        state: Iterate,
    ) -> Result<(Iterate, Option<KV>), ArgminError> {
        self.0.init(problem, state)
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<Misfit<'_>>,
        state: Iterate,
    ) -> Result<(Iterate, Option<KV>), ArgminError> {
        self.0.next_iter(problem, state)
    }

    fn terminate(&mut self, state: &Iterate) -> TerminationStatus {
        let (Some(gradient), Some(hessian)) = (state.get_gradient(), state.get_hessian()) else {
            return TerminationStatus::NotTerminated;
        };
        let is_close = |i: usize| gradient[i].abs() <= CLOSE * hessian[i][i].sqrt();
        if (0..3).all(is_close) {
            TerminationStatus::Terminated(TerminationReason::SolverConverged)
        } else {
            TerminationStatus::NotTerminated
        }
    }
}

/// What a fit has found.
#[derive(Clone, Debug)]
pub(crate) struct Fit {
    pub(crate) point: Point,
    /// χ², the sum of the squared residuals.
    pub(crate) misfit: f64,
    /// Whether the optimiser says so.
    pub(crate) converged: bool,
    pub(crate) steps: u64,
    /// Points at which the car was driven, with tangents.
    pub(crate) points: usize,
    /// Of all runs.
    pub(crate) laws: Laws,
}

impl Fit {
    /// Fits the model to the data from these logarithms on.
    pub(crate) fn from(data: Data<'_>, start: Logs) -> Result<Self, Box<dyn Error>> {
        Self::run(data, start, None)
    }

    /// Fits other data of the same ride from a point on, which need not be run again.
    pub(crate) fn again(data: Data<'_>, start: &Point) -> Result<Self, Box<dyn Error>> {
        Self::run(data, start.logs, Some(start.clone()))
    }

    fn run(data: Data<'_>, start: Logs, point: Option<Point>) -> Result<Self, Box<dyn Error>> {
        let misfit = Misfit {
            data,
            point: RefCell::new(point),
            laws: RefCell::new(Laws::NONE),
            points: RefCell::new(0),
        };
        let [radius, largest] = RADIUS;
        let region = TrustRegion::new(Steihaug::new().with_max_iters(20));
        let region = region.with_radius(radius)?.with_max_radius(largest)?;
        let executor = Executor::new(misfit, UntilClose(region));
        let result = executor
            .configure(|state| state.param(start.to_vec()).max_iters(MOST_STEPS))
            .run()?;
        let (state, mut problem) = (result.state, result.problem);
        let found = state.get_best_param().ok_or("no point was reached")?;
        let misfit = problem
            .take_problem()
            .ok_or("the optimiser lost the data")?;
        let point = misfit.at(found, Clone::clone)?;
        let converged = TerminationReason::SolverConverged;
        Ok(Self {
            misfit: 2.0 * misfit.cost(found)?,
            point,
            converged: state.get_termination_reason() == Some(&converged),
            steps: state.get_iter(),
            points: misfit.points.into_inner(),
            laws: misfit.laws.into_inner(),
        })
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

//! The least value of a function, given its gradient: L-BFGS of the crate `argmin`, in which each point is evaluated once.

use std::cell::RefCell;
use std::error::Error;

use argmin::core::{CostFunction, Error as ArgminError, Executor, Gradient};
use argmin::solver::linesearch::MoreThuenteLineSearch;
use argmin::solver::quasinewton::LBFGS;

/// A point at which a function was evaluated.
#[derive(Clone, Debug)]
pub struct Point<T> {
    /// The arguments.
    pub place: Vec<f64>,
    /// The value there.
    pub value: f64,
    /// The derivatives by the arguments.
    pub gradient: Vec<f64>,
    /// What else is known there.
    pub of: T,
}

/// Updates that the optimiser remembers.
const MEMORY: usize = 10;

/// Points by a function that evaluates others.
struct Known<T, F>(RefCell<(Vec<Point<T>>, F)>);

/// Searches from a point, for so many iterations at most or until one changes the value by less than so much. Returns all points in
/// their order, that one first.
///
/// # Errors
///
/// That of `evaluate`, or of the optimiser.
pub fn search<T, F>(
    first: Point<T>,
    (iterations, change): (u64, f64),
    evaluate: F,
) -> Result<Vec<Point<T>>, Box<dyn Error>>
where
    F: FnMut(&[f64]) -> Result<Point<T>, Box<dyn Error>>,
{
    let start = first.place.clone();
    let known = Known(RefCell::new((vec![first], evaluate)));
    let solver = LBFGS::new(MoreThuenteLineSearch::new(), MEMORY).with_tolerance_cost(change)?;
    Executor::new(&known, solver)
        .configure(|state| state.param(start).max_iters(iterations))
        .run()?;
    let (points, _) = known.0.into_inner();
    Ok(points)
}

/// The point with the least value.
pub fn least<T>(points: &[Point<T>]) -> Option<&Point<T>> {
    points.iter().min_by(|a, b| a.value.total_cmp(&b.value))
}

impl<T, F: FnMut(&[f64]) -> Result<Point<T>, Box<dyn Error>>> Known<T, F> {
    /// What `of` says of a point, which is evaluated unless it has been.
    fn at<R>(&self, place: &[f64], of: impl Fn(&Point<T>) -> R) -> Result<R, ArgminError> {
        let (points, evaluate) = &mut *self.0.borrow_mut();
        if let Some(point) = points.iter().find(|point| point.place == place) {
            return Ok(of(point));
        }
        let point = evaluate(place).map_err(|error| ArgminError::msg(error.to_string()))?;
        let said = of(&point);
        points.push(point);
        Ok(said)
    }
}

impl<T, F: FnMut(&[f64]) -> Result<Point<T>, Box<dyn Error>>> CostFunction for &Known<T, F> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, place: &Vec<f64>) -> Result<f64, ArgminError> {
        self.at(place, |point| point.value)
    }
}

impl<T, F: FnMut(&[f64]) -> Result<Point<T>, Box<dyn Error>>> Gradient for &Known<T, F> {
    type Param = Vec<f64>;
    type Gradient = Vec<f64>;

    fn gradient(&self, place: &Vec<f64>) -> Result<Vec<f64>, ArgminError> {
        self.at(place, |point| point.gradient.clone())
    }
}

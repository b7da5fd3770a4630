//! Columns about many points of solids at once. A handle that is not of the scene would show as not a number.

use eem::prelude::*;

/// The least temperature of some points, K.
pub fn coldest<const D: usize>(points: &[Element]) -> Quantity<D> {
    chosen_temperature(points, |a, b| if a.is_nan() || a < b { a } else { b })
}

/// The largest temperature of some points, K.
pub fn warmest<const D: usize>(points: &[Element]) -> Quantity<D> {
    chosen_temperature(points, |a, b| if a.is_nan() || a > b { a } else { b })
}

fn chosen_temperature<const D: usize>(
    points: &[Element],
    choose: fn(f64, f64) -> f64,
) -> Quantity<D> {
    let points = points.to_vec();
    Quantity::custom_in("K", move |run: &Simulation<D>| {
        let temperature = |&point| run.temperature(point).unwrap_or(f64::NAN);
        let temperatures = points.iter().map(temperature);
        temperatures.reduce(choose).unwrap_or(f64::NAN)
    })
}

/// The mean of a quantity over some points, each of which counts alike.
pub fn mean<const D: usize>(
    points: &[Element],
    unit: &'static str,
    of: fn(&Simulation<D>, Element) -> Result<f64, SceneError>,
) -> Quantity<D> {
    let points = points.to_vec();
    Quantity::custom_in(unit, move |run: &Simulation<D>| {
        let values = points.iter().map(|&point| of(run, point));
        mean_of(values).unwrap_or(f64::NAN)
    })
}

/// The mean of some values, unless one is missing.
pub fn mean_of(values: impl Iterator<Item = Result<f64, SceneError>>) -> Result<f64, SceneError> {
    let (mut sum, mut count) = (0.0, 0.0);
    for value in values {
        sum += value?;
        count += 1.0;
    }
    Ok(sum / count)
}

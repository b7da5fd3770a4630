//! The figures that judge a recorded run, computed from its columns alone.

use std::time::Duration;

use super::record::Record;

/// Two recorded times closer than this (s) are the same time; accumulated steps differ by rounding.
pub const TIME_TOLERANCE: f64 = 1e-9;

/// Relative energy defect beyond which a run has broken down, whether or not it goes on.
pub const BREAKDOWN: f64 = 0.05;

/// What a run is judged by. A quantity that the record has no column for is `None`.
#[derive(Clone, Copy, Debug)]
pub struct Statistics {
    /// First time (s) at which the energy is off by more than [`BREAKDOWN`].
    pub breakdown: Option<f64>,
    /// max |E − E₀| / |E₀|.
    pub energy_defect: Option<f64>,
    /// min (Sₙ₊₁ − Sₙ) in J/K; the second law asks for ≥ 0.
    pub entropy_increment: Option<f64>,
    /// The same in units in the last place of S.
    pub entropy_increment_ulps: Option<f64>,
    /// max |J − J₀| / |J₀|, in the Euclidean norm when J has components.
    pub angular_momentum_defect: Option<f64>,
    /// Mean Newton iterations of a completed step.
    pub newton_iterations: Option<f64>,
    /// Mean wall time of a completed step.
    pub time_per_step: Option<Duration>,
}

impl Statistics {
    /// The figures of `record`.
    pub fn of(record: &Record) -> Self {
        let iterations = record
            .column("newton_iterations")
            .map(|own| own.iter().sum());
        let energy = record.vectors(|name| name == "energy");
        let entropy = record.column("entropy");
        Self {
            breakdown: first_energy_beyond(record, BREAKDOWN).map(|row| record.time(row)),
            energy_defect: largest(defects(&energy)),
            entropy_increment: smallest_increment(entropy, |_| 1.0),
            entropy_increment_ulps: smallest_increment(entropy, ulp),
            angular_momentum_defect: largest(defects(&record.vectors(is_angular_momentum))),
            newton_iterations: iterations.and_then(|sum| mean(sum, record.steps())),
            time_per_step: u32::try_from(record.steps())
                .ok()
                .and_then(|steps| record.elapsed.checked_div(steps)),
        }
    }
}

/// The first row whose energy is off by more than the share `defect` of the initial energy.
pub fn first_energy_beyond(record: &Record, defect: f64) -> Option<usize> {
    let energy = record.vectors(|name| name == "energy");
    defects(&energy).position(|own| own.is_nan() || own > defect)
}

/// Root mean square of |q − q*| over the common times, divided by that of |q*|,
/// all positions together; `None` when the records share no time after the start.
pub fn position_error(record: &Record, exact: &Record) -> Option<f64> {
    let is_position = |name: &str| name.starts_with('q');
    let (times, exact_times) = (record.column("time")?, exact.column("time")?);
    let (positions, exact_positions) = (record.vectors(is_position), exact.vectors(is_position));
    let (mut difference, mut size) = (0.0, 0.0);
    for (time, q) in times.iter().zip(&positions).skip(1) {
        let later = exact_times.partition_point(|exact| *exact < time - TIME_TOLERANCE);
        let Some(same) = exact_times.get(later) else {
            break;
        };
        if (same - time).abs() <= TIME_TOLERANCE {
            let exact = &exact_positions[later];
            difference += distance(q, exact).powi(2);
            size += norm(exact).powi(2);
        }
    }
    (size > 0.0).then(|| (difference / size).sqrt())
}

/// The points of a curve over time minus those of the exact curve at the same times; a point whose
/// time the exact curve does not have is left out.
pub fn deviations(curve: &[(f64, f64)], exact: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let deviation = |&(time, value): &(f64, f64)| {
        let later = exact.partition_point(|(exact, _)| *exact < time - TIME_TOLERANCE);
        let &(same, exact) = exact.get(later)?;
        ((same - time).abs() <= TIME_TOLERANCE).then_some((time, value - exact))
    };
    curve.iter().filter_map(deviation).collect()
}

/// The largest |E − E₀| / |E₀| so far, over time from the first step on.
pub fn energy_defects(record: &Record) -> Vec<(f64, f64)> {
    largest_so_far(record, &record.vectors(|name| name == "energy"))
}

/// The largest |J − J₀| / |J₀| so far, in the Euclidean norm when J has components, over time from
/// the first step on.
pub fn angular_momentum_defects(record: &Record) -> Vec<(f64, f64)> {
    largest_so_far(record, &record.vectors(is_angular_momentum))
}

/// max |J − J(t₀)| from the first state at or after a time t₀ (s) on; `None` when no step was made since.
pub fn momentum_change(record: &Record, since: f64) -> Option<f64> {
    let all = record.vectors(is_angular_momentum);
    let (first, later) = all.get(first_row(record, since)..)?.split_first()?;
    largest(later.iter().map(|own| distance(own, first)))
}

/// The first row at or after a time (s).
pub fn first_row(record: &Record, time: f64) -> usize {
    let times = record.times();
    times.partition_point(|&own| own < time - TIME_TOLERANCE)
}

fn largest_so_far(record: &Record, vectors: &[Vec<f64>]) -> Vec<(f64, f64)> {
    let so_far = defects(vectors).scan(0.0_f64, |largest, defect| {
        *largest = largest.max(defect);
        Some(*largest)
    });
    record.over_time(so_far).split_off(1)
}

fn is_angular_momentum(column: &str) -> bool {
    column == "angular_momentum" || column.starts_with("angular_momentum_")
}

/// |v − v₀| / |v₀| for every v; nothing without components or where v₀ vanishes.
fn defects(vectors: &[Vec<f64>]) -> impl Iterator<Item = f64> {
    let first = vectors.first().filter(|first| norm(first) > 0.0);
    first.into_iter().flat_map(move |first| {
        let defect = move |vector: &Vec<f64>| distance(vector, first) / norm(first);
        vectors.iter().map(defect)
    })
}

/// The largest value; not a number when one of them is not.
pub fn largest(values: impl Iterator<Item = f64>) -> Option<f64> {
    let larger = |a: f64, b: f64| if a.is_nan() || a > b { a } else { b };
    values.reduce(larger)
}

/// The mean of so many values with that sum; `None` when there are none.
fn mean(sum: f64, count: usize) -> Option<f64> {
    let count = u32::try_from(count).ok().filter(|&count| count > 0)?;
    Some(sum / f64::from(count))
}

/// The smallest increment from one value to the next, in units of `unit` of the old one.
fn smallest_increment(values: Option<&[f64]>, unit: fn(f64) -> f64) -> Option<f64> {
    let decrement = |pair: &[f64]| (pair[0] - pair[1]) / unit(pair[0]);
    largest(values?.windows(2).map(decrement)).map(|decrement| 0.0 - decrement)
}

/// The distance from |value| to the next larger double.
fn ulp(value: f64) -> f64 {
    value.abs().next_up() - value.abs()
}

fn norm(vector: &[f64]) -> f64 {
    vector.iter().map(|value| value * value).sum::<f64>().sqrt()
}

/// |a − b|.
pub fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b) * (a - b))
        .sum::<f64>()
        .sqrt()
}

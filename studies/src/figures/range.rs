//! Axis ranges that trusted curves decide and that a run which blows up cannot destroy.

use std::ops::Range;

/// One in so many points of an untrusted curve may lie outside the range on either side.
const OUTLIERS: usize = 20;

/// An untrusted curve widens the range on either side by at most this many times the trusted
/// curves' span …
const SPANS: f64 = 1.5;

/// … or by this share of their mean magnitude, whichever is more: a conserved quantity has
/// no span.
const MAGNITUDES: f64 = 1.0;

/// Smallest span shown, as a share of the magnitude: rounding is not blown up to fill a picture.
const LEAST_SPAN: f64 = 0.001;

/// Empty margin on either side as a share of the span.
const MARGIN: f64 = 0.05;

/// The range of one axis, from the coordinates of the trusted and the other curves.
pub(super) fn axis(trusted: &[f64], others: &[Vec<f64>]) -> Range<f64> {
    let mut bounds = bulk(trusted, |_| 0);
    let allowed = bounds.map(|(low, high)| {
        let reach = (SPANS * (high - low)).max(MAGNITUDES * f64::midpoint(low, high).abs());
        (low - reach, high + reach)
    });
    for curve in others {
        let Some((low, high)) = bulk(curve, |count| count / OUTLIERS) else {
            continue;
        };
        let (least, most) = allowed.unwrap_or((low, high));
        let (lowest, highest) = bounds.unwrap_or((low, high));
        bounds = Some((lowest.min(low.max(least)), highest.max(high.min(most))));
    }
    let (low, high) = bounds.unwrap_or((0.0, 1.0));
    padded(low, high)
}

/// Smallest and largest of the finite values after dropping so many outliers on either side.
fn bulk(values: &[f64], outliers: impl Fn(usize) -> usize) -> Option<(f64, f64)> {
    let mut values: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    values.sort_by(f64::total_cmp);
    let dropped = outliers(values.len());
    let kept = values.get(dropped..values.len() - dropped)?;
    Some((*kept.first()?, *kept.last()?))
}

fn padded(low: f64, high: f64) -> Range<f64> {
    let magnitude = low.abs().max(high.abs());
    let least = if magnitude > 0.0 {
        LEAST_SPAN * magnitude
    } else {
        1.0
    };
    let missing = (least - (high - low)).max(0.0);
    let margin = 0.5 * missing + MARGIN * (high - low).max(least);
    low - margin..high + margin
}

/// Widens one of the ranges so that a unit is as long on both axes of a picture whose plotting
/// area is `aspect` times as wide as high.
pub(super) fn equal_scales(
    x: &Range<f64>,
    y: &Range<f64>,
    aspect: f64,
) -> (Range<f64>, Range<f64>) {
    let (width, height) = (x.end - x.start, y.end - y.start);
    (widened(x, aspect * height), widened(y, width / aspect))
}

/// The range with the same middle and at least that span.
pub(super) fn widened(range: &Range<f64>, span: f64) -> Range<f64> {
    let middle = f64::midpoint(range.start, range.end);
    let half = 0.5 * span.max(range.end - range.start);
    middle - half..middle + half
}

//! Numbers at the axes: as many decimals as the range needs, powers of ten for tiny and huge.

use std::ops::Range;

/// Magnitudes outside of this interval are written with a power of ten.
const PLAIN: Range<f64> = 1e-3..1e6;

/// Formats the ticks of an axis with that range.
pub(super) fn formatter(range: &Range<f64>) -> impl Fn(&f64) -> String + use<> {
    let magnitude = range.start.abs().max(range.end.abs());
    let span = range.end - range.start;
    // Ticks are about a tenth of the span apart and have the form 1, 2 or 5 times a power of ten.
    let exponent = (span / 10.0).log10().floor();
    move |value| {
        if value.abs() < 1e-6 * span {
            "0".to_owned()
        } else if PLAIN.contains(&magnitude) {
            format!("{value:.*}", decimals(exponent))
        } else {
            format!(
                "{value:.*e}",
                decimals(exponent - magnitude.log10().floor())
            )
        }
    }
}

/// Decimals of a number that is a multiple of 10^exponent.
fn decimals(exponent: f64) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 0 and 15"
    )]
    let decimals = (-exponent).clamp(0.0, 15.0) as usize;
    decimals
}

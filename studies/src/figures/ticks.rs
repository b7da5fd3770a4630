//! Numbers at the axes: as many decimals as the range needs, powers of ten for tiny and huge.

use std::ops::Range;

/// Magnitudes outside of this interval are written with a power of ten.
const PLAIN: Range<f64> = 1e-3..1e6;

/// The number `value` at an evenly divided axis with that range.
pub(super) fn even(range: &Range<f64>, value: f64) -> String {
    let magnitude = range.start.abs().max(range.end.abs());
    let span = range.end - range.start;
    // Ticks are about a tenth of the span apart and have the form 1, 2 or 5 times a power of ten.
    let exponent = (span / 10.0).log10().floor();
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

/// The number whose decimal logarithm is `place`; it has one digit that is not zero. `is_plain`
/// allows to write it without a power of ten.
pub(super) fn logarithmic(place: f64, is_plain: bool) -> String {
    // Rounding must not turn 10⁻³ into 9.99…·10⁻⁴.
    let exponent = (place + 1e-6).floor();
    let digit = 10.0_f64.powf(place - exponent).round();
    let power = 10.0_f64.powf(exponent);
    if is_plain && PLAIN.contains(&(power * (1.0 + 1e-6))) {
        format!("{:.*}", decimals(exponent), digit * power)
    } else if digit > 1.0 {
        format!("{digit}·10{}", superscript(exponent))
    } else {
        format!("10{}", superscript(exponent))
    }
}

/// A whole number, raised.
fn superscript(number: f64) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raise = |character: char| match character.to_digit(10) {
        Some(digit) => RAISED[digit as usize],
        None => '⁻',
    };
    number.to_string().chars().map(raise).collect()
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

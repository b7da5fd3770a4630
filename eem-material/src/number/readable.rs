//! Numbers in messages: short, and read back to the same number.

use core::fmt;

/// Magnitudes that are printed without an exponent: at most three zeros after the point and six
/// digits before it.
const PLAIN: core::ops::Range<f64> = 1e-4..1e6;

/// A number as error messages print it: the fewest digits that give back the same `f64`, with an exponent outside of 1e-4 …
/// 1e6. A precision (`{:.6}`) is the number of digits after the point, of the mantissa if there is an exponent.
#[derive(Clone, Copy, Debug)]
pub struct Readable(pub f64);

impl fmt::Display for Readable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(value) = self;
        let is_plain = PLAIN.contains(&value.abs()) || value.abs() <= 0.0 || !value.is_finite();
        if is_plain {
            fmt::Display::fmt(value, f)
        } else {
            fmt::LowerExp::fmt(value, f)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Readable;

    #[test]
    fn numbers_are_short_and_read_back_to_themselves() {
        for (value, text) in [
            (0.0, "0"),
            (-0.0, "-0"),
            (0.1, "0.1"),
            (-3.0, "-3"),
            (1e-4, "0.0001"),
            (9.9e-5, "9.9e-5"),
            (999_999.5, "999999.5"),
            (1e6, "1e6"),
            (-1e300, "-1e300"),
            (5e-324, "5e-324"),
            (1.0 / 3.0 * 1e-9, "3.333333333333333e-10"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(Readable(value).to_string(), text);
            assert_eq!(text.parse::<f64>().map(f64::to_bits), Ok(value.to_bits()));
        }
        assert_eq!(Readable(f64::NAN).to_string(), "NaN");
    }

    #[test]
    fn a_precision_is_kept_in_both_forms() {
        assert_eq!(format!("{:.2}", Readable(2.0)), "2.00");
        assert_eq!(format!("{:.2}", Readable(2e300)), "2.00e300");
    }
}

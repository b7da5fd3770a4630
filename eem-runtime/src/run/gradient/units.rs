//! Units of derivatives, as text.

/// The unit of the derivative of a number by another, given their units; empty where one of them is unknown. The unit of a
/// number without unit is `1`.
///
/// It is the quotient as it stands: `m/(N/m)` and not `m²/N`.
pub(crate) fn quotient(of: &str, by: &str) -> String {
    match (of, by) {
        ("", _) | (_, "") => String::new(),
        (of, "1") => of.to_owned(),
        (of, by) if of == by => "1".to_owned(),
        (of, by) => format!(
            "{}/{}",
            grouped(of, &['/']),
            grouped(by, &['/', ' ', '*', '·'])
        ),
    }
}

/// A unit in parentheses if it has one of these signs.
fn grouped(unit: &str, signs: &[char]) -> String {
    if unit.contains(signs) {
        format!("({unit})")
    } else {
        unit.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::quotient;

    #[test]
    fn quotients_can_be_read_one_way() {
        for (of, by, expected) in [
            ("K", "N m", "K/(N m)"),
            ("m", "N/m", "m/(N/m)"),
            ("J/K", "kg", "(J/K)/kg"),
            ("m", "m", "1"),
            ("m", "1", "m"),
            ("1", "kg", "1/kg"),
            ("", "kg", ""),
            ("m", "", ""),
        ] {
            assert_eq!(quotient(of, by), expected);
        }
    }
}

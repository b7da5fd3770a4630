//! The symbols of units and prefixes. A symbol has one meaning; units with an offset or an irrational
//! scale have no symbol.

use super::{Base, Unit};
use crate::nearest::nearest;

/// A unit with a symbol.
struct Row {
    symbols: &'static [&'static str],
    /// The English name, for suggestions.
    name: &'static str,
    /// Exponents of [`Base::SI`].
    exponents: [i64; 7],
    /// Exponents of 2, 3 and 5 in the scale.
    scale: [i64; 3],
    prefixes: bool,
}

const fn si(symbols: &'static [&'static str], name: &'static str, exponents: [i64; 7]) -> Row {
    Row {
        symbols,
        name,
        exponents,
        scale: [0; 3],
        prefixes: true,
    }
}

/// Base units, derived units with a name, and units that may be used with the SI.
const ROWS: [Row; 34] = [
    //                                 m  kg  s  A  K mol cd
    si(&["m"], "metre", [1, 0, 0, 0, 0, 0, 0]),
    Row {
        scale: [-3, 0, -3],
        ..si(&["g"], "gram", [0, 1, 0, 0, 0, 0, 0])
    },
    si(&["s"], "second", [0, 0, 1, 0, 0, 0, 0]),
    si(&["A"], "ampere", [0, 0, 0, 1, 0, 0, 0]),
    si(&["K"], "kelvin", [0, 0, 0, 0, 1, 0, 0]),
    si(&["mol"], "mole", [0, 0, 0, 0, 0, 1, 0]),
    si(&["cd"], "candela", [0, 0, 0, 0, 0, 0, 1]),
    si(&["rad"], "radian", [0, 0, 0, 0, 0, 0, 0]),
    si(&["sr"], "steradian", [0, 0, 0, 0, 0, 0, 0]),
    si(&["Hz"], "hertz", [0, 0, -1, 0, 0, 0, 0]),
    si(&["N"], "newton", [1, 1, -2, 0, 0, 0, 0]),
    si(&["Pa"], "pascal", [-1, 1, -2, 0, 0, 0, 0]),
    si(&["J"], "joule", [2, 1, -2, 0, 0, 0, 0]),
    si(&["W"], "watt", [2, 1, -3, 0, 0, 0, 0]),
    si(&["C"], "coulomb", [0, 0, 1, 1, 0, 0, 0]),
    si(&["V"], "volt", [2, 1, -3, -1, 0, 0, 0]),
    si(&["F"], "farad", [-2, -1, 4, 2, 0, 0, 0]),
    // The Greek letter, the sign for ohm, and a word for keyboards without either.
    si(&["Ω", "\u{2126}", "ohm"], "ohm", [2, 1, -3, -2, 0, 0, 0]),
    si(&["S"], "siemens", [-2, -1, 3, 2, 0, 0, 0]),
    si(&["Wb"], "weber", [2, 1, -2, -1, 0, 0, 0]),
    si(&["T"], "tesla", [0, 1, -2, -1, 0, 0, 0]),
    si(&["H"], "henry", [2, 1, -2, -2, 0, 0, 0]),
    si(&["lm"], "lumen", [0, 0, 0, 0, 0, 0, 1]),
    si(&["lx"], "lux", [-2, 0, 0, 0, 0, 0, 1]),
    si(&["Bq"], "becquerel", [0, 0, -1, 0, 0, 0, 0]),
    si(&["Gy"], "gray", [2, 0, -2, 0, 0, 0, 0]),
    si(&["Sv"], "sievert", [2, 0, -2, 0, 0, 0, 0]),
    si(&["kat"], "katal", [0, 0, -1, 0, 0, 1, 0]),
    // 60 s, 60 min, 24 h
    Row {
        scale: [2, 1, 1],
        prefixes: false,
        ..si(&["min"], "minute", [0, 0, 1, 0, 0, 0, 0])
    },
    Row {
        scale: [4, 2, 2],
        prefixes: false,
        ..si(&["h"], "hour", [0, 0, 1, 0, 0, 0, 0])
    },
    Row {
        scale: [7, 3, 2],
        prefixes: false,
        ..si(&["d"], "day", [0, 0, 1, 0, 0, 0, 0])
    },
    // 10⁻³ m³, 10³ kg, 10⁵ Pa
    Row {
        scale: [-3, 0, -3],
        ..si(&["L", "l"], "litre", [3, 0, 0, 0, 0, 0, 0])
    },
    Row {
        scale: [3, 0, 3],
        ..si(&["t"], "tonne", [0, 1, 0, 0, 0, 0, 0])
    },
    Row {
        scale: [5, 0, 5],
        ..si(&["bar"], "bar", [-1, 1, -2, 0, 0, 0, 0])
    },
];

/// The prefixes and their powers of ten.
pub(super) const PREFIXES: [(&str, i64); 26] = [
    ("da", 1),
    ("h", 2),
    ("k", 3),
    ("M", 6),
    ("G", 9),
    ("T", 12),
    ("P", 15),
    ("E", 18),
    ("Z", 21),
    ("Y", 24),
    ("R", 27),
    ("Q", 30),
    ("d", -1),
    ("c", -2),
    ("m", -3),
    // The Greek letter, the sign for micro, and a letter of any keyboard.
    ("μ", -6),
    ("\u{b5}", -6),
    ("u", -6),
    ("n", -9),
    ("p", -12),
    ("f", -15),
    ("a", -18),
    ("z", -21),
    ("y", -24),
    ("r", -27),
    ("q", -30),
];

/// What `symbol` stands for: a unit or a prefixed unit; the whole symbol first, so that `min` is a
/// minute and `cd` a candela.
pub(crate) fn lookup(symbol: &str) -> Option<Unit> {
    if let Some(row) = row(symbol) {
        return row.unit(0);
    }
    let mut prefixed = PREFIXES.iter().filter_map(|&(prefix, power)| {
        let row = row(symbol.strip_prefix(prefix)?)?;
        row.prefixes.then(|| row.unit(power)).flatten()
    });
    prefixed.next()
}

fn row(symbol: &str) -> Option<&'static Row> {
    ROWS.iter().find(|row| row.symbols.contains(&symbol))
}

impl Row {
    fn unit(&self, power_of_ten: i64) -> Option<Unit> {
        let primes = Base::PRIMES.iter().zip(self.scale);
        let scale = primes.map(|(&(base, _), exponent)| (base, exponent));
        let dimension = Base::SI.into_iter().zip(self.exponents);
        let ten = Unit::of([(Base::Two, power_of_ten), (Base::Five, power_of_ten)]);
        Unit::of(dimension.chain(scale)).times(&ten)
    }
}

/// What to write instead of a symbol that is not in the table.
pub(crate) fn advice(symbol: &str) -> String {
    if let Some(advice) = refused(symbol) {
        return advice.to_owned();
    }
    let letters = symbol.trim_end_matches(|c: char| c.is_ascii_digit());
    let digits = &symbol[letters.len()..];
    if !digits.is_empty() && lookup(letters).is_some() {
        return format!("a power is written `{letters}^{digits}`");
    }
    if let Some((left, right)) = two_units(symbol) {
        return format!("did you mean the product `{left} {right}`?");
    }
    let lower = symbol.to_lowercase();
    let singular = lower.strip_suffix('s').unwrap_or(&lower);
    let named = ROWS
        .iter()
        .find(|row| [lower.as_str(), singular].contains(&row.name));
    if let Some(row) = named {
        return format!("did you mean `{}`?", row.symbols[0]);
    }
    if singular == "meter" {
        return "did you mean `m`?".to_owned();
    }
    let symbols = ROWS.iter().flat_map(|row| row.symbols).copied();
    let prefixed = [
        "kg", "mm", "km", "ms", "kN", "kJ", "kPa", "MPa", "GPa", "kW", "mW", "mJ", "mN",
    ];
    match nearest(symbol, symbols.chain(prefixed)) {
        Some(nearest) => format!("did you mean `{nearest}`?"),
        None => {
            "known are the units of the SI with their prefixes, `min`, `h`, `d`, `L`, `t` and `bar`"
                .to_owned()
        }
    }
}

/// Units that exist and cannot be used.
fn refused(symbol: &str) -> Option<&'static str> {
    Some(match symbol {
        "°C" | "degC" | "℃" | "°F" | "degF" => {
            "its zero is not that of the absolute temperature: give the value in `K`"
        }
        "deg" | "°" | "grad" => "its scale is irrational: give the value in `rad`, which is 1",
        "%" | "ppm" => "the unit of what is dimensionless is `1`",
        "kp" | "kgf" | "lbf" | "dyn" => "give the value in `N`",
        "eV" | "cal" | "kcal" | "erg" | "BTU" => "give the value in `J`",
        "atm" | "psi" | "Torr" | "mmHg" => "give the value in `Pa`",
        "in" | "ft" | "Å" => "give the value in `m`",
        "lb" | "oz" => "give the value in `kg`",
        "hp" | "PS" => "give the value in `W`",
        _ => return None,
    })
}

/// `Nm` as `N` and `m`, if it can be read so.
fn two_units(symbol: &str) -> Option<(&str, &str)> {
    let splits = symbol
        .char_indices()
        .skip(1)
        .map(|(at, _)| symbol.split_at(at));
    let mut both = splits.filter(|(left, right)| lookup(left).is_some() && lookup(right).is_some());
    both.next()
}

#[cfg(test)]
mod tests {
    use super::{PREFIXES, ROWS, advice, lookup};
    use crate::unit::{Base, Unit};

    #[test]
    fn a_symbol_has_one_meaning() {
        let all: Vec<&str> = ROWS.iter().flat_map(|row| row.symbols).copied().collect();
        for (i, symbol) in all.iter().enumerate() {
            assert!(!all[..i].contains(symbol), "{symbol}");
        }
        for (i, (prefix, _)) in PREFIXES.iter().enumerate() {
            assert!(
                PREFIXES[..i].iter().all(|(other, _)| other != prefix),
                "{prefix}"
            );
        }
    }

    #[test]
    fn derived_units_are_products_of_others() {
        let product =
            |left: &str, right: &str| lookup(left).unwrap().times(&lookup(right).unwrap());
        let equal = [
            ("J", "N", "m"),
            ("C", "A", "s"),
            ("Wb", "V", "s"),
            ("V", "Ω", "A"),
            ("C", "F", "V"),
            ("Wb", "H", "A"),
            ("A", "S", "V"),
            ("J", "W", "s"),
            ("lm", "cd", "sr"),
            ("mol", "kat", "s"),
        ];
        for (unit, left, right) in equal {
            assert_eq!(
                lookup(unit),
                product(left, right),
                "{unit} = {left} {right}"
            );
        }
    }

    #[test]
    fn whole_symbols_come_before_prefixes() {
        assert_eq!(lookup("cd"), Some(Unit::of([(Base::Candela, 1)])));
        assert_eq!(lookup("min").unwrap().coherent(), lookup("s").unwrap());
        assert_eq!(lookup("kg"), Some(Unit::of([(Base::Kilogram, 1)])));
        assert_eq!(lookup("t"), lookup("Mg"));
        assert_eq!(
            lookup("mL"),
            lookup("cm")
                .unwrap()
                .power(eem_symbolic::Rational::integer(3))
        );
        assert_eq!(lookup("kmin"), None);
        assert_eq!(lookup("kkg"), None);
        assert_eq!(lookup("k"), None);
    }

    #[test]
    fn advice_reads_what_was_meant() {
        assert_eq!(advice("Nm"), "did you mean the product `N m`?");
        assert_eq!(advice("m2"), "a power is written `m^2`");
        assert_eq!(advice("Joules"), "did you mean `J`?");
        assert_eq!(advice("meters"), "did you mean `m`?");
        assert_eq!(advice("j"), "did you mean `J`?");
        assert!(advice("°C").contains("`K`"));
        assert!(advice("wibble").starts_with("known are"));
    }
}

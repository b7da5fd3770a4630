//! Prints units as a person would: `N s/m`, not `kg/s`; what is printed can be read again.

use std::fmt::{self, Display, Formatter};

use eem_symbolic::Rational;

use super::table::{self, PREFIXES};
use super::{Base, Unit};

/// Symbols of [`Base::SI`].
const SYMBOLS: [&str; 7] = ["m", "kg", "s", "A", "K", "mol", "cd"];

/// Units that stand for a product of base units in print, the preferred of equal length first.
const NAMED: [&str; 11] = ["N", "J", "Pa", "W", "V", "C", "F", "S", "Ω", "Wb", "T"];

/// From this power of ten a scale is printed with an exponent.
const LARGE_SCALE: f64 = 1e7;

/// `symbol^exponent`
type Factor = (String, Rational);

impl Display for Unit {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let scale = self.scale();
        let mut factors = factors(&self.coherent());
        if scale.is_one() || with_prefix(&scale, &mut factors) {
            return f.write_str(&text(&factors));
        }
        f.write_str(&self.expanded())
    }
}

impl Unit {
    /// The unit with its scale as a number: `1000 N/m` for kN/m, `1000` for m/mm.
    pub(crate) fn expanded(&self) -> String {
        let scale = number(&self.scale());
        let coherent = self.coherent();
        if coherent.is_one() {
            return scale;
        }
        format!("{scale} {}", text(&factors(&coherent)))
    }
}

/// The shortest product for a unit without scale; of equally short ones the first.
fn factors(unit: &Unit) -> Vec<Factor> {
    let mut best = base_factors(unit);
    let mut least = cost(&best);
    for named in NAMED {
        let Some(factors) = factors_with(unit, named) else {
            continue;
        };
        let cost = cost(&factors);
        if cost < least {
            (best, least) = (factors, cost);
        }
    }
    best
}

/// The product with a power of `named` that leaves no kilograms, or no amperes if `named` has no kilograms.
fn factors_with(unit: &Unit, named: &str) -> Option<Vec<Factor>> {
    let derived = table::lookup(named)?;
    let mut pivots = [Base::Kilogram, Base::Ampere].into_iter();
    let pivot = pivots.find(|&base| !derived.exponent(base).is_zero())?;
    let exponent = unit.exponent(pivot).checked_div(derived.exponent(pivot))?;
    if exponent.is_zero() {
        return None;
    }
    let rest = unit.over(&derived.power(exponent)?)?;
    let mut factors = vec![(named.to_owned(), exponent)];
    factors.extend(base_factors(&rest));
    Some(factors)
}

fn base_factors(unit: &Unit) -> Vec<Factor> {
    let powers = Base::SI.into_iter().zip(SYMBOLS);
    let powers = powers.map(|(base, symbol)| (symbol.to_owned(), unit.exponent(base)));
    powers.filter(|(_, exponent)| !exponent.is_zero()).collect()
}

/// How long a product reads: the sum of the exponents, with weights that make it `N s/m` and not
/// `kg/s`, but `kg/m` and not `Pa s^2`, and `S` instead of `1/Ω`.
fn cost(factors: &[Factor]) -> f64 {
    let cost = |(symbol, exponent): &Factor| {
        let exponent = exponent.to_f64();
        match symbol.as_str() {
            "kg" => 3.0 * exponent.abs(),
            "s" if exponent > 0.0 => 1.5 * exponent,
            named if NAMED.contains(&named) && exponent < 0.0 => 0.5 - exponent,
            _ => exponent.abs(),
        }
    };
    factors.iter().map(cost).sum()
}

/// Puts the scale into a prefix of one of the factors, if there is a prefix for it.
fn with_prefix(scale: &Unit, factors: &mut [Factor]) -> bool {
    let ten = scale.exponent(Base::Two);
    if scale.exponent(Base::Five) != ten || !scale.exponent(Base::Three).is_zero() {
        return false;
    }
    for (symbol, exponent) in factors {
        let power = ten.checked_div(*exponent);
        let prefix = PREFIXES
            .iter()
            .find(|&&(_, of)| power == Some(Rational::integer(of)));
        if let (Some((prefix, _)), true) = (prefix, symbol != "kg") {
            symbol.insert_str(0, prefix);
            return true;
        }
    }
    false
}

fn text(factors: &[Factor]) -> String {
    let side = |divisor: bool| {
        let factors = factors.iter();
        let factors = factors.filter(move |(_, e)| e.is_negative() == divisor);
        let factors = factors.map(|(symbol, e)| power(symbol, if divisor { -*e } else { *e }));
        factors.collect::<Vec<String>>()
    };
    let (above, below) = (side(false), side(true));
    let above = if above.is_empty() {
        "1".to_owned()
    } else {
        above.join(" ")
    };
    match below.as_slice() {
        [] => above,
        [only] => format!("{above}/{only}"),
        below => format!("{above}/({})", below.join(" ")),
    }
}

fn power(symbol: &str, exponent: Rational) -> String {
    let (n, d) = (exponent.numerator(), exponent.denominator());
    match (n, d) {
        (1, 1) => symbol.to_owned(),
        (_, 1) => format!("{symbol}^{n}"),
        _ => format!("{symbol}^({n}/{d})"),
    }
}

/// A scale as a number.
fn number(scale: &Unit) -> String {
    let value = |(base, prime): (Base, i64)| {
        let exponent = scale.exponent(base).to_i32()?;
        Rational::integer(prime).checked_powi(exponent)
    };
    let values = Base::PRIMES.into_iter().map(value);
    let product = values.reduce(|product, value| product?.checked_mul(value?));
    let Some(product) = product.flatten() else {
        let powers = Base::PRIMES.into_iter();
        let powers = powers.map(|(base, prime)| (prime.to_string(), scale.exponent(base)));
        return text(&powers.filter(|(_, e)| !e.is_zero()).collect::<Vec<_>>());
    };
    if scale.exponent(Base::Three).is_negative() {
        return format!("{}/{}", product.numerator(), product.denominator());
    }
    let value = product.to_f64();
    if value >= LARGE_SCALE || value < LARGE_SCALE.recip() {
        format!("{value:e}")
    } else {
        format!("{value}")
    }
}

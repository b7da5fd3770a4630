//! Units as vectors of exact exponents: products of units add them, and equal units are equal.
//!
//! The scale of a unit is kept the same way, as the exponents of its prime factors: a kilonewton
//! per metre is `2³ 5³ kg s⁻²`. Powers of ten, minutes and hours have no other prime factors, and
//! roots and products of scales stay exact. The unknown unit of a field is one more base.

mod display;
pub(crate) mod table;

use std::collections::BTreeMap;

use eem_symbolic::Rational;

/// What a unit has powers of: base units, prime numbers and the unknown units of fields.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Base {
    Metre,
    Kilogram,
    Second,
    Ampere,
    Kelvin,
    Mole,
    Candela,
    /// The prime factor 2 of the scale.
    Two,
    /// The prime factor 3 of the scale.
    Three,
    /// The prime factor 5 of the scale.
    Five,
    /// The unknown unit of a field, by index.
    Field(usize),
}

impl Base {
    /// The base units of the SI.
    pub(crate) const SI: [Self; 7] = [
        Self::Metre,
        Self::Kilogram,
        Self::Second,
        Self::Ampere,
        Self::Kelvin,
        Self::Mole,
        Self::Candela,
    ];

    /// The prime factors of scales, and the bases that count them.
    pub(crate) const PRIMES: [(Self, i64); 3] = [(Self::Two, 2), (Self::Three, 3), (Self::Five, 5)];

    fn is_prime(self) -> bool {
        Self::PRIMES.iter().any(|&(base, _)| base == self)
    }
}

/// A product of powers of [bases](Base).
///
/// Operations return `None` if an exponent does not fit 128-bit rationals.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Unit {
    /// No exponent is zero. Filled one by one: `collect` would be compiled with a sort for each iterator.
    exponents: BTreeMap<Base, Rational>,
}

impl Unit {
    /// 1, the unit of dimensionless quantities.
    pub(crate) fn one() -> Self {
        Self::default()
    }

    /// `baseⁿ …`
    pub(crate) fn of(powers: impl IntoIterator<Item = (Base, i64)>) -> Self {
        let mut unit = Self::one();
        for (base, exponent) in powers {
            if exponent != 0 {
                unit.exponents.insert(base, Rational::integer(exponent));
            }
        }
        unit
    }

    /// The unknown unit of field `index`.
    pub(crate) fn unknown(index: usize) -> Self {
        Self::of([(Base::Field(index), 1)])
    }

    /// m
    pub(crate) fn metre() -> Self {
        Self::of([(Base::Metre, 1)])
    }

    /// K
    pub(crate) fn kelvin() -> Self {
        Self::of([(Base::Kelvin, 1)])
    }

    /// Whether this is the unit of dimensionless quantities.
    pub(crate) fn is_one(&self) -> bool {
        self.exponents.is_empty()
    }

    /// The exponent of `base`.
    pub(crate) fn exponent(&self, base: Base) -> Rational {
        let exponent = self.exponents.get(&base);
        exponent.copied().unwrap_or(Rational::ZERO)
    }

    /// The product of two units.
    pub(crate) fn times(&self, other: &Self) -> Option<Self> {
        let mut product = self.clone();
        for (&base, &exponent) in &other.exponents {
            let sum = product.exponent(base).checked_add(exponent)?;
            if sum.is_zero() {
                product.exponents.remove(&base);
            } else {
                product.exponents.insert(base, sum);
            }
        }
        Some(product)
    }

    /// The quotient of two units.
    pub(crate) fn over(&self, other: &Self) -> Option<Self> {
        self.times(&other.power(Rational::MINUS_ONE)?)
    }

    /// A power of the unit.
    pub(crate) fn power(&self, exponent: Rational) -> Option<Self> {
        if exponent.is_zero() {
            return Some(Self::one());
        }
        let mut power = self.clone();
        for own in power.exponents.values_mut() {
            *own = own.checked_mul(exponent)?;
        }
        Some(power)
    }

    /// The size of the unit in its coherent SI unit: 1000 for kN/m.
    pub(crate) fn scale(&self) -> Self {
        self.part(Base::is_prime)
    }

    /// The unit without its scale.
    pub(crate) fn coherent(&self) -> Self {
        self.part(|base| !base.is_prime())
    }

    /// The first field whose unknown unit is a factor.
    pub(crate) fn first_unknown(&self) -> Option<usize> {
        self.unknowns().next()
    }

    /// The fields whose unknown units are factors.
    pub(crate) fn unknowns(&self) -> impl Iterator<Item = usize> {
        self.exponents.keys().filter_map(|base| match base {
            Base::Field(index) => Some(*index),
            _ => None,
        })
    }

    fn part(&self, belongs: impl Fn(Base) -> bool) -> Self {
        let mut part = Self::one();
        for (&base, &exponent) in &self.exponents {
            if belongs(base) {
                part.exponents.insert(base, exponent);
            }
        }
        part
    }
}

#[cfg(test)]
mod tests {
    use eem_symbolic::Rational;

    use super::{Base, Unit};

    #[test]
    fn roots_and_powers_are_exact() {
        let kilonewton_per_metre = Unit::of([
            (Base::Two, 3),
            (Base::Five, 3),
            (Base::Kilogram, 1),
            (Base::Second, -2),
        ]);
        let root = kilonewton_per_metre.power(Rational::HALF).unwrap();
        assert_eq!(root.exponent(Base::Two), Rational::new(3, 2).unwrap());
        assert_eq!(root.times(&root), Some(kilonewton_per_metre.clone()));
        assert_eq!(
            kilonewton_per_metre.over(&kilonewton_per_metre),
            Some(Unit::one())
        );
        assert_eq!(
            kilonewton_per_metre.power(Rational::ZERO),
            Some(Unit::one())
        );
    }

    #[test]
    fn a_unit_is_its_scale_times_its_coherent_unit() {
        let minute_metre = Unit::of([
            (Base::Two, 2),
            (Base::Three, 1),
            (Base::Five, 1),
            (Base::Metre, 1),
            (Base::Second, 1),
        ]);
        let (scale, coherent) = (minute_metre.scale(), minute_metre.coherent());
        assert_eq!(coherent, Unit::of([(Base::Metre, 1), (Base::Second, 1)]));
        assert_eq!(scale.times(&coherent), Some(minute_metre));
    }

    #[test]
    fn exponents_that_do_not_fit_are_nothing() {
        let large = Rational::integer(i64::MAX);
        let once = Unit::metre().power(large).unwrap();
        let twice = once.power(large).unwrap();
        assert_eq!(twice.power(large), None);
    }
}

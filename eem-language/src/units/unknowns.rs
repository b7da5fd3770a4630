//! Finds the units of fields that declare none, from the formulas.
//!
//! Every rule says that two units are equal. As units are vectors of exponents, this is a linear
//! equation for the unknown ones; it is solved for one of them as soon as it is met (Kennedy 1996,
//! *Programming languages and dimensions*, for rational exponents).

use std::collections::BTreeMap;

use crate::unit::{Base, Unit};

/// The units of fields that declare none, as far as they have been determined.
#[derive(Debug, Default)]
pub(super) struct Unknowns {
    /// A unit may have unknowns of its own, but none that was solved before.
    solved: BTreeMap<usize, Unit>,
}

impl Unknowns {
    /// `unit` in terms of the unknowns that are not solved yet.
    pub(super) fn resolve(&self, unit: &Unit) -> Option<Unit> {
        let mut unit = unit.clone();
        while let Some(index) = self.first_solved(&unit) {
            let exponent = unit.exponent(Base::Field(index));
            let known = self.solved.get(&index)?.power(exponent)?;
            let rest = unit.over(&Unit::unknown(index).power(exponent)?)?;
            unit = rest.times(&known)?;
        }
        Some(unit)
    }

    fn first_solved(&self, unit: &Unit) -> Option<usize> {
        let mut unknowns = unit.unknowns();
        unknowns.find(|index| self.solved.contains_key(index))
    }

    /// Learns that two units are equal, if one of them has an unknown.
    pub(super) fn equate(&mut self, left: &Unit, right: &Unit) -> Option<()> {
        let ratio = self.resolve(&left.over(right)?)?;
        let Some(index) = ratio.first_unknown() else {
            return Some(());
        };
        // unknown^e · rest = 1
        let exponent = ratio.exponent(Base::Field(index));
        let rest = ratio.over(&Unit::unknown(index).power(exponent)?)?;
        let minus_one = eem_symbolic::Rational::MINUS_ONE;
        let unit = rest.power(minus_one.checked_div(exponent)?)?;
        self.solved.insert(index, unit);
        Some(())
    }

    /// The unit of field `index`, if the formula determines it.
    pub(super) fn unit(&self, index: usize) -> Option<Unit> {
        let unit = self.resolve(&Unit::unknown(index))?;
        unit.first_unknown().is_none().then_some(unit)
    }
}

#[cfg(test)]
mod tests {
    use super::{Unit, Unknowns};
    use crate::units::grammar;

    #[test]
    fn equations_in_any_order_determine_units() {
        let (a, b, c) = (Unit::unknown(0), Unit::unknown(1), Unit::unknown(2));
        let joule = grammar::parse("J").unwrap();
        let mut unknowns = Unknowns::default();
        // a b = c, c = J, a = K
        unknowns.equate(&a.times(&b).unwrap(), &c).unwrap();
        assert_eq!(unknowns.unit(0), None);
        unknowns.equate(&c, &joule).unwrap();
        unknowns.equate(&a, &Unit::kelvin()).unwrap();
        assert_eq!(unknowns.unit(0), Some(Unit::kelvin()));
        assert_eq!(unknowns.unit(1), joule.over(&Unit::kelvin()));
        assert_eq!(unknowns.unit(2), Some(joule));
    }
}

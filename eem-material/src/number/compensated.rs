//! Compensated sums, which store the rounding errors of their additions.

use crate::number::kernel::two_sum;

/// Accumulated quantities, each with the rounding error of all its additions so far.
///
/// The value plus the carry is the sum to twice the precision, so that the state after a million
/// steps carries the rounding of one (Kahan 1965; `TwoSum`, Knuth 1969).
#[derive(Clone, Debug, PartialEq)]
pub struct Compensated {
    values: Vec<f64>,
    carries: Vec<f64>,
}

/// No sums.
impl Default for Compensated {
    fn default() -> Self {
        Self {
            values: Vec::new(),
            carries: Vec::new(),
        }
    }
}

impl Compensated {
    /// Sums that start at `values`, exactly.
    #[must_use]
    pub fn new(values: Vec<f64>) -> Self {
        let carries = vec![0.0; values.len()];
        Self { values, carries }
    }

    /// Sums as they were stored; `None` unless there are as many carries as values.
    #[must_use]
    pub fn of(values: Vec<f64>, carries: Vec<f64>) -> Option<Self> {
        (values.len() == carries.len()).then_some(Self { values, carries })
    }

    /// The sums, rounded.
    #[inline]
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Every sum with its carry.
    pub fn sums(&self) -> impl Iterator<Item = (f64, f64)> + Clone + '_ {
        let carries = self.carries.iter().copied();
        self.values.iter().copied().zip(carries)
    }

    /// One sum.
    #[inline]
    #[must_use]
    pub fn sum(&self, index: usize) -> Sum {
        Sum {
            value: self.values[index],
            carry: self.carries[index],
        }
    }

    /// Restarts one sum at `value`.
    #[inline]
    pub fn set(&mut self, index: usize, value: f64) {
        self.values[index] = value;
        self.carries[index] = 0.0;
    }

    /// Restarts the sums of one point of `D` coordinates.
    #[inline]
    pub fn set_point<const D: usize>(&mut self, point: usize, values: &[f64; D]) {
        self.values.as_chunks_mut().0[point] = *values;
        self.carries.as_chunks_mut().0[point] = [0.0; D];
    }

    /// Replaces all sums, exactly.
    pub fn write(&mut self, values: impl FnOnce(&mut [f64])) {
        values(&mut self.values);
        self.carries.fill(0.0);
    }

    /// Sets one sum to that of `old` plus an increment.
    #[inline]
    pub fn advance(&mut self, index: usize, old: &Self, increment: f64) {
        let sum = old.sum(index).plus(increment);
        (self.values[index], self.carries[index]) = (sum.value, sum.carry);
    }

    /// Sets the sums of one point of `D` coordinates to those of `old` plus increments, each a value and its rest. Returns the
    /// sum of the new carries.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a few numbers in registers")]
    pub fn advance_point<const D: usize>(
        &mut self,
        point: usize,
        old: &Self,
        [increments, rests]: [&[f64; D]; 2],
    ) -> f64 {
        let from = old.point::<D>(point);
        let values = &mut self.values.as_chunks_mut::<D>().0[point];
        let carries = &mut self.carries.as_chunks_mut::<D>().0[point];
        // Each array is stored at once: a load soon after stores of single coordinates would stall.
        let (mut sums, mut missing) = ([0.0; D], [0.0; D]);
        for axis in 0..D {
            let from = Sum {
                value: from[0][axis],
                carry: from[1][axis] + rests[axis],
            };
            let sum = from.plus(increments[axis]);
            (sums[axis], missing[axis]) = (sum.value, sum.carry);
        }
        (*values, *carries) = (sums, missing);
        missing.into_iter().fold(0.0, |sum, rest| sum + rest)
    }

    /// The values and the carries of one point of `D` coordinates.
    #[inline]
    #[must_use]
    pub fn point<const D: usize>(&self, point: usize) -> [&[f64; D]; 2] {
        [
            &self.values.as_chunks::<D>().0[point],
            &self.carries.as_chunks::<D>().0[point],
        ]
    }

    /// Adds to one sum.
    #[inline]
    pub fn add(&mut self, index: usize, increment: f64) {
        let sum = self.sum(index).plus(increment);
        (self.values[index], self.carries[index]) = (sum.value, sum.carry);
    }

    /// `self − old` of one sum, to rounding of the difference.
    #[inline]
    #[must_use]
    pub fn change(&self, index: usize, old: &Self) -> f64 {
        self.sum(index).change(old.sum(index))
    }

    /// Copies the sums of `other` without allocation; `self` has as many, or none and is left empty.
    #[inline]
    pub fn copy_from(&mut self, other: &Self) {
        if self.values.is_empty() {
            return;
        }
        self.values.copy_from_slice(&other.values);
        self.carries.copy_from_slice(&other.carries);
    }
}

/// One accumulated quantity with the rounding error of all its additions so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sum {
    /// The sum, rounded.
    pub value: f64,
    /// The rounding error of the value.
    pub carry: f64,
}

impl Sum {
    /// A sum that starts at `value`, exactly.
    #[must_use]
    pub fn new(value: f64) -> Self {
        let carry = 0.0;
        Self { value, carry }
    }

    /// Adds to the sum.
    #[inline]
    pub fn add(&mut self, increment: f64) {
        *self = self.plus(increment);
    }

    /// The sum with an increment.
    ///
    /// The carry is added to the rounding error of `value + increment`, and not to the increment, where its last digits
    /// would be lost (`Sum2`, Ogita, Rump & Oishi 2005).
    #[inline]
    fn plus(self, increment: f64) -> Self {
        let (high, error) = two_sum(self.value, increment);
        // Where additions cancel, the high part may be the smaller one.
        let (value, carry) = two_sum(high, error + self.carry);
        Self { value, carry }
    }

    /// `self − value`.
    #[inline]
    #[must_use]
    pub fn beyond(self, value: f64) -> f64 {
        (self.value - value) + self.carry
    }

    /// `self − old`, to rounding of the difference.
    #[inline]
    #[must_use]
    pub fn change(self, old: Self) -> f64 {
        (self.value - old.value) + (self.carry - old.carry)
    }
}

/// Adds to a value and its carry a change that is large compared with the carry: a correction of Newton's method. Takes
/// one addition less than [`Sum::add`], but may lose the last digits of the carry.
#[inline]
pub fn correct(value: &mut f64, carry: &mut f64, change: f64) {
    (*value, *carry) = two_sum(*value, *carry + change);
}

/// A sum to twice the precision, so that the sum over a large scene loses no digits.
#[derive(Clone, Copy, Debug)]
pub struct Total {
    value: f64,
    rest: f64,
}

impl Default for Total {
    fn default() -> Self {
        let [value, rest] = [0.0; 2];
        Self { value, rest }
    }
}

impl Total {
    /// Adds a term.
    #[inline]
    pub fn add(&mut self, term: f64) {
        let (value, rest) = two_sum(self.value, term);
        self.value = value;
        self.rest += rest;
    }

    /// Adds a sum with its carry.
    #[inline]
    pub fn add_sum(&mut self, sum: Sum) {
        self.add(sum.value);
        self.add(sum.carry);
    }

    /// Adds another sum.
    #[inline]
    pub fn add_total(&mut self, other: Self) {
        self.add(other.value);
        self.add(other.rest);
    }

    /// The sum, rounded once.
    #[must_use]
    #[inline]
    pub fn value(self) -> f64 {
        self.value + self.rest
    }

    /// The sum of some terms.
    pub fn of(terms: impl IntoIterator<Item = f64>) -> f64 {
        let mut sum = Self::default();
        for term in terms {
            sum.add(term);
        }
        sum.value()
    }
}

/// In a file, a pair: sum and carry.
#[cfg(feature = "serde")]
impl serde::Serialize for Sum {
    fn serialize<T: serde::Serializer>(&self, serializer: T) -> Result<T::Ok, T::Error> {
        (&self.value, &self.carry).serialize(serializer)
    }
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for Sum {
    fn deserialize<T: serde::Deserializer<'de>>(deserializer: T) -> Result<Self, T::Error> {
        let (value, carry) = serde::Deserialize::deserialize(deserializer)?;
        Ok(Self { value, carry })
    }
}

/// In a file, pairs: each sum with its carry.
#[cfg(feature = "serde")]
impl serde::Serialize for Compensated {
    fn serialize<T: serde::Serializer>(&self, serializer: T) -> Result<T::Ok, T::Error> {
        serializer.collect_seq(self.values.iter().zip(&self.carries))
    }
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for Compensated {
    fn deserialize<T: serde::Deserializer<'de>>(deserializer: T) -> Result<Self, T::Error> {
        let pairs = Vec::<(f64, f64)>::deserialize(deserializer)?;
        let (values, carries) = pairs.into_iter().unzip();
        Ok(Self { values, carries })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_increment_is_not_lost_between_a_large_one_and_its_opposite() {
        let mut sum = Sum::new(1.0_f64);
        for increment in [1e-3, 1e-25, -1e-3] {
            sum.add(increment);
        }
        assert_eq!(sum.value.to_bits(), 1.0_f64.to_bits());
        // ε² of the value.
        assert!((sum.carry - 1e-25).abs() < 1e-31, "{:e}", sum.carry);
    }

    #[test]
    fn a_million_small_additions_leave_one_rounding() {
        let mut sum = Compensated::new(vec![1.0e6_f64]);
        for _ in 0..1_000_000 {
            sum.add(0, 0.1);
        }
        // 10⁶ additions of the double nearest 0.1; the plain loop is off by 5e-5.
        assert_eq!(sum.values()[0].to_bits(), 1.1e6_f64.to_bits());
    }
}

//! Sums whose rounding is known.

/// A sum with the size of its terms.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Terms {
    pub(crate) sum: f64,
    magnitude: f64,
    count: f64,
}

impl Terms {
    /// A sum without terms.
    pub(crate) fn none() -> Self {
        Self {
            sum: 0.0,
            magnitude: 0.0,
            count: 0.0,
        }
    }

    pub(crate) fn add(&mut self, term: f64) {
        self.sum += term;
        self.magnitude += term.abs();
        self.count += 1.0;
    }

    /// Adds `factor (new − old)`, whose rounding is that of both numbers.
    pub(crate) fn add_change(&mut self, factor: f64, [old, new]: [f64; 2]) {
        self.sum += factor * (new - old);
        self.magnitude += factor.abs() * (new.abs() + old.abs());
        self.count += 1.0;
    }

    /// Adds the terms of another sum.
    pub(crate) fn add_all(&mut self, other: &Self) {
        self.sum += other.sum;
        self.magnitude += other.magnitude;
        self.count += other.count;
    }

    /// A bound of the rounding error: half ε of each partial sum and of each term, none of which exceeds the magnitude.
    pub(crate) fn rounding(&self) -> f64 {
        self.count * f64::EPSILON * self.magnitude
    }
}

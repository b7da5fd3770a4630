//! Numbers that look random and are always the same.

/// Numbers between −1 and 1 from a counter (Knuth's multiplicative hash).
pub struct Numbers(pub u32);

impl Numbers {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(1);
        let hash = self.0.wrapping_mul(2_654_435_761) ^ (self.0.wrapping_mul(40_503) >> 7);
        f64::from(hash) / f64::from(u32::MAX) * 2.0 - 1.0
    }
}

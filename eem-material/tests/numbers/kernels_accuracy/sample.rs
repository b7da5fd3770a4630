//! Pairs of ends at every distance, from equal to opposite scales.

/// A xorshift generator (Marsaglia 2003), so that every run sees the same pairs.
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: &str) -> Self {
        // FNV-1a: each kernel has its own sequence.
        let hash = seed.bytes().fold(0xCBF2_9CE4_8422_2325, |hash: u64, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3)
        });
        Self(hash)
    }

    #[expect(clippy::cast_precision_loss, reason = "53 bits fit")]
    fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 * 2.0_f64.powi(-53)
    }

    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}

/// Where a function is sampled.
pub(crate) struct Domain {
    /// Decimal exponents of the smallest and the largest |x|.
    pub(crate) exponents: (f64, f64),
    /// Whether negative arguments are sampled.
    pub(crate) signed: bool,
    /// Whether a pair of that size may be used.
    pub(crate) accept: fn(f64) -> bool,
}

impl Domain {
    pub(crate) fn point(&self, random: &mut Random) -> f64 {
        let size = 10.0_f64.powf(random.within(self.exponents.0, self.exponents.1));
        if self.signed && random.unit() < 0.5 {
            -size
        } else {
            size
        }
    }

    /// A pair at a random distance: none in a tenth of the cases, independent ends
    /// in a fifth, else |b − a|/|a| between 1e-18 and 1e2.
    pub(crate) fn pair(&self, random: &mut Random) -> (f64, f64) {
        loop {
            let a = self.point(random);
            let kind = random.unit();
            let b = if kind < 0.1 {
                a
            } else if kind < 0.3 {
                self.point(random)
            } else {
                let increment = 10.0_f64.powf(random.within(-18.0, 2.0));
                let side = if random.unit() < 0.5 { -1.0 } else { 1.0 };
                a + side * increment * a
            };
            let inside = (self.accept)(a) && (self.accept)(b) && b != 0.0;
            if inside && (self.signed || b > 0.0) {
                return (a, b);
            }
        }
    }
}

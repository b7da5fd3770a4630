//! Digests of numbers, to detect whether two sets of them are the same.

use core::fmt;
use core::num::ParseIntError;
use core::str::FromStr;

/// A 64-bit digest (FNV-1a; Fowler, Noll & Vo 1991), against mistakes, not against attacks.
///
/// Two numbers that differ in one bit have different digests; those of two scenes with different numbers agree by chance in
/// one of 2⁶⁴ cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Digest(u64);

impl Digest {
    /// The empty digest: the offset basis of the algorithm.
    const NOTHING: Self = Self(0xcbf2_9ce4_8422_2325);

    /// The prime of the algorithm.
    const PRIME: u64 = 0x0000_0100_0000_01b3;

    /// Adds some bytes.
    pub fn bytes(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(Self::PRIME);
        }
    }

    /// Adds a count or an index.
    pub fn count(&mut self, count: usize) {
        self.bytes(&(count as u64).to_le_bytes());
    }

    /// Adds the bits of a number.
    pub fn number(&mut self, number: f64) {
        self.bytes(&number.to_bits().to_le_bytes());
    }

    /// The digest as a number.
    #[must_use]
    pub const fn bits(self) -> u64 {
        self.0
    }

    /// The digest of what `add` adds.
    pub fn of(add: impl FnOnce(&mut Self)) -> Self {
        let mut digest = Self::NOTHING;
        add(&mut digest);
        digest
    }
}

/// 16 hexadecimal digits: not every format of files has integers of 64 bits.
impl fmt::Display for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

impl FromStr for Digest {
    type Err = ParseIntError;

    fn from_str(digits: &str) -> Result<Self, ParseIntError> {
        u64::from_str_radix(digits, 16).map(Self)
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for Digest {
    fn serialize<T: serde::Serializer>(&self, serializer: T) -> Result<T::Ok, T::Error> {
        serializer.collect_str(self)
    }
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for Digest {
    fn deserialize<T: serde::Deserializer<'de>>(deserializer: T) -> Result<Self, T::Error> {
        let digits = String::deserialize(deserializer)?;
        digits.parse().map_err(|_| {
            serde::de::Error::custom(format_args!("`{digits}` are not 16 hexadecimal digits"))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Digest;

    #[test]
    fn digests_are_those_of_the_algorithm() {
        // Test vectors of the authors.
        for (text, digest) in [
            ("", 0xcbf2_9ce4_8422_2325),
            ("a", 0xaf63_dc4c_8601_ec8c),
            ("foobar", 0x8594_4171_f739_67e8),
        ] {
            assert_eq!(Digest::of(|of| of.bytes(text.as_bytes())), Digest(digest));
        }
    }
}

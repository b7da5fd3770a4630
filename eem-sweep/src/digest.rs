//! Digests of 128 bits, by which a shard proves that it belongs to a sweep. They detect accidents, not forgery.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use xxhash_rust::xxh3::Xxh3;

/// A digest that is being formed.
pub(crate) struct Digest(Xxh3);

impl Digest {
    /// The digest of no bytes.
    pub(crate) fn new() -> Self {
        Self(Xxh3::new())
    }

    /// Adds bytes.
    pub(crate) fn bytes(&mut self, bytes: &[u8]) {
        self.0.update(bytes);
    }

    /// Adds a whole number.
    pub(crate) fn whole(&mut self, number: u64) {
        self.bytes(&number.to_le_bytes());
    }

    /// Adds a text with its length, so that "ab" + "c" is not "a" + "bc".
    pub(crate) fn text(&mut self, text: &str) {
        self.whole(text.len() as u64);
        self.bytes(text.as_bytes());
    }

    /// Adds the bits of numbers.
    pub(crate) fn numbers(&mut self, numbers: &[f64]) {
        self.whole(numbers.len() as u64);
        for number in numbers {
            self.whole(number.to_bits());
        }
    }

    /// 32 hexadecimal digits.
    pub(crate) fn hex(&self) -> String {
        format!("{:032x}", self.0.digest128())
    }
}

/// The digest of a file, read in pieces.
pub(crate) fn of_file(path: &Path) -> io::Result<String> {
    const PIECE: usize = 1 << 16;
    let mut file = File::open(path)?;
    let mut digest = Digest::new();
    let mut piece = vec![0; PIECE];
    loop {
        match file.read(&mut piece)? {
            0 => return Ok(digest.hex()),
            read => digest.bytes(&piece[..read]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_digest_is_the_published_one_and_knows_where_texts_end() {
        // XXH3-128 of no bytes, from the specification's sanity checks.
        assert_eq!(Digest::new().hex(), "99aa06d3014798d86001c324468d497f");
        let of = |texts: [&str; 2]| {
            let mut digest = Digest::new();
            for text in texts {
                digest.text(text);
            }
            digest.hex()
        };
        assert_ne!(of(["ab", "c"]), of(["a", "bc"]));
    }
}

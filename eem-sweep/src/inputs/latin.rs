//! Latin hypercubes: of n members each has a layer of its own among n layers of every range.

use std::ops::Range;

use rand::rngs::ChaCha8Rng;
use rand::{Rng, SeedableRng};

/// The order of layers in each column; values are computed on request.
#[derive(Clone, Debug)]
pub(super) struct Latin {
    seed: u64,
    ranges: Vec<Range<f64>>,
    /// The layer of each member, column after column: 4 bytes each.
    layers: Vec<Vec<u32>>,
}

impl Latin {
    /// Draws the layers; `members` fits in 32 bits.
    pub(super) fn new(members: u32, seed: u64, ranges: Vec<Range<f64>>) -> Self {
        let layers = (0..ranges.len() as u64).map(|column| shuffled(members, seed, column));
        let layers = layers.collect();
        Self {
            seed,
            ranges,
            layers,
        }
    }

    /// The seed and the ranges.
    pub(super) fn recipe(&self) -> (u64, &[Range<f64>]) {
        (self.seed, &self.ranges)
    }

    /// How many members it has.
    pub(super) fn members(&self) -> usize {
        self.layers.first().map_or(0, Vec::len)
    }

    /// Appends the values of a member: `low + (high − low)(layer + u)/n` with u from 0 to 1.
    pub(super) fn values(&self, member: usize, values: &mut Vec<f64>) {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed ^ PLACES);
        random.set_stream(member as u64);
        for (range, layers) in self.ranges.iter().zip(&self.layers) {
            let layers_in_all = f64::from(u32::try_from(layers.len()).unwrap_or(u32::MAX));
            // 53 bits: all doubles of this spacing in [0, 1).
            let place = (random.next_u64() >> 11) as f64 * (0.5 * f64::EPSILON);
            let share = (f64::from(layers[member]) + place) / layers_in_all;
            let width = range.end - range.start;
            values.push(if width.is_finite() {
                range.start + width * share
            } else {
                range.start * (1.0 - share) + range.end * share
            });
        }
    }
}

/// Makes the seed of places within layers different from that of the layers.
const PLACES: u64 = 0x9e37_79b9_7f4a_7c15;

/// 0 to `count − 1` in random order, by the shuffle of Fisher and Yates.
fn shuffled(count: u32, seed: u64, column: u64) -> Vec<u32> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(column);
    let mut order: Vec<u32> = (0..count).collect();
    for last in (1..order.len()).rev() {
        // ⌊x (last + 1)/2⁶⁴⌋ is off from even chances by less than 2⁻³².
        let chosen = (u128::from(random.next_u64()) * (last as u128 + 1)) >> 64;
        order.swap(last, usize::try_from(chosen).unwrap_or(last));
    }
    order
}

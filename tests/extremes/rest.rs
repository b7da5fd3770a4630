//! Kind 2: rest, uniform motion, rigid rotation, equilibrium, and increments of one ulp.

use super::tally::Family;

pub(crate) const FAMILIES: &[Family] = &[];

//! What depends on rounding alone: these tests of `cases` are run with other sets of features and with
//! optimisation.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use eem_testkit::scenes as support;

/// Against reference data and stored bits.
#[path = "../cases"]
mod cases {
    mod blocks;
    mod plate;
    mod reference_trajectory;
    mod same_bits;
}

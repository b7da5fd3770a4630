//! The published cases end in the same bits in every profile and with every set of features.
//!
//! Each run is compared with a constant, so that what is built in one way is compared with what is
//! built in another. A change of a scheme or of generated code changes the constants: the message of
//! the failed test has the new ones, to be written down once `reference_trajectory` passes.

mod stored;

use std::hint::black_box;

use eem::prelude::*;

use crate::support::{DoublePendulum, single_pendulum};
use stored::{GLIBC, PORTABLE, Stored};

/// Steps of each run.
const STEPS: usize = 10;

/// [`library`] of glibc 2.36 on `x86_64` with FMA.
const LIBRARY: u64 = 0x11e2_f3f8_b1c8_7ac3;

/// FNV-1a of the bytes of some numbers, which tells all doubles apart.
fn hash(numbers: &[f64]) -> u64 {
    let bytes = numbers.iter().flat_map(|number| number.to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// A hash of values of the transcendental functions that these cases call. They come from the library of
/// the system, whose last bit may differ from one system to the next.
fn library() -> u64 {
    let values = (1..=2_000).flat_map(|i| {
        let x = black_box(f64::from(i) * 1.234_567e-3);
        [x.ln(), x.ln_1p(), x.exp(), x.exp_m1(), (-x).exp_m1()]
    });
    hash(&values.collect::<Vec<_>>())
}

/// The bits that hold here, if there are some.
fn stored() -> Option<[Stored; 5]> {
    if cfg!(feature = "portable") {
        return Some(PORTABLE);
    }
    let library = library();
    if library != LIBRARY {
        println!("not compared: another library, {library:#018x}");
    }
    (library == LIBRARY).then_some(GLIBC)
}

/// Where the cases end with a scheme.
fn run(scheme: Scheme) -> Stored {
    let mut pendulum = single_pendulum(scheme, 0.2);
    for _ in 0..STEPS {
        pendulum.run.step().unwrap();
    }
    let double = DoublePendulum::ALL.map(|case| {
        let mut pendulum = case.simulation(scheme, case.step);
        for _ in 0..STEPS {
            pendulum.run.step().unwrap();
        }
        hash(&pendulum.row())
    });
    Stored {
        scheme,
        single: hash(&pendulum.row()),
        double,
    }
}

#[test]
fn published_cases_end_in_the_stored_bits() {
    if let Some(stored) = stored() {
        let found = stored.each_ref().map(|stored| run(stored.scheme));
        assert!(found == stored, "{found:#018x?}");
    }
}

//! The published cases end in the same bits in every profile and with every set of features.
//!
//! Each run is compared with a constant, so that what is built in one way is compared with what is
//! built in another. A change of a scheme or of generated code changes the constants: the message of
//! the failed test has the new ones, to be written down once `reference_trajectory` passes.

use std::hint::black_box;

use eem::prelude::*;

use crate::support::{DoublePendulum, single_pendulum};

/// Steps of each run.
const STEPS: usize = 10;

/// [`library`] of glibc 2.36 on `x86_64` with FMA.
const LIBRARY: u64 = 0x11e2_f3f8_b1c8_7ac3;

/// [`hash`] of q, p, θ, γ and the entropy of the air after [`STEPS`] published steps.
const SINGLE: [(Scheme, u64); 5] = [
    (Scheme::EemEntropy, 0xa60b_b76c_668d_200b),
    (Scheme::EemTemperature, 0xd77d_14c0_05e2_ac1e),
    (Scheme::Variational, 0x0568_db72_3370_1181),
    (Scheme::Variational4, 0x88c5_f128_5bea_af80),
    (Scheme::Staggered, 0x9258_d2f2_d6e2_0896),
];

/// [`hash`] of q, p and θ after [`STEPS`] published steps, in the order of [`DoublePendulum::ALL`].
const DOUBLE: [(Scheme, [u64; 3]); 5] = [
    (
        Scheme::EemEntropy,
        [
            0x1c14_7f78_becd_c082,
            0x3530_2515_4580_db19,
            0x2c6d_b8e8_648b_36cf,
        ],
    ),
    (
        Scheme::EemTemperature,
        [
            0x6116_2e99_a4ed_1369,
            0xfc9e_b37b_ec6c_08a3,
            0x1ee1_8c6e_a7d7_6f2e,
        ],
    ),
    (
        Scheme::Variational,
        [
            0x7043_930e_1314_9015,
            0x5867_4ebe_c047_d81e,
            0x9872_74f3_65d6_3c6d,
        ],
    ),
    (
        Scheme::Variational4,
        [
            0x999c_f404_0181_aef9,
            0x8237_1296_469f_9538,
            0x14d2_76ce_cf5b_6b44,
        ],
    ),
    (
        Scheme::Staggered,
        [
            0x26d9_4e73_85b3_9c05,
            0x8c25_6d88_16c4_0e35,
            0xd542_b621_97a6_92ba,
        ],
    ),
];

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

/// Asserts that runs end in the bits that are stored, where these hold.
fn assert_same(what: &str, found: &[u64], stored: &[u64]) {
    if library() == LIBRARY {
        assert!(found == stored, "{what}: {found:#018x?}");
    } else {
        println!(
            "{what}: {found:#018x?}, not compared: another library, {:#018x}",
            library()
        );
    }
}

#[test]
fn the_single_pendulum_ends_in_the_stored_bits() {
    for (scheme, stored) in SINGLE {
        let mut pendulum = single_pendulum(scheme, 0.2);
        for _ in 0..STEPS {
            pendulum.run.step().unwrap();
        }
        assert_same(scheme.name(), &[hash(&pendulum.row())], &[stored]);
    }
}

#[test]
fn double_pendulums_end_in_the_stored_bits() {
    for (scheme, stored) in DOUBLE {
        let found = DoublePendulum::ALL.map(|case| {
            let mut pendulum = case.simulation(scheme, case.step);
            for _ in 0..STEPS {
                pendulum.run.step().unwrap();
            }
            hash(&pendulum.row())
        });
        assert_same(scheme.name(), &found, &stored);
    }
}

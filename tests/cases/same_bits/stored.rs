//! The bits in which the published cases end.

use eem::prelude::*;

/// [`hash`](super::hash)es of the state after [`STEPS`](super::STEPS) published steps.
#[derive(Debug, PartialEq)]
pub(super) struct Stored {
    pub(super) scheme: Scheme,
    /// Of q, p, θ, γ and the entropy of the air.
    pub(super) single: u64,
    /// Of q, p and θ, in the order of [`DoublePendulum::ALL`](crate::support::DoublePendulum::ALL).
    pub(super) double: [u64; 3],
}

/// With the functions of glibc 2.36 on `x86_64` with FMA.
pub(super) const GLIBC: [Stored; 5] = [
    Stored {
        scheme: Scheme::EemEntropy,
        single: 0x6aa4_270f_621d_235d,
        double: [
            0x2254_eee8_77a9_fba0,
            0x5df2_00b9_26c9_08e0,
            0x8342_6345_2f46_bee3,
        ],
    },
    Stored {
        scheme: Scheme::EemTemperature,
        single: 0x0bef_851b_a425_c31d,
        double: [
            0xb881_3b7a_3add_4b3d,
            0x7f25_ea84_b01c_422e,
            0xcc48_0f0f_a674_10d1,
        ],
    },
    Stored {
        scheme: Scheme::Variational,
        single: 0x0568_db72_3370_1181,
        double: [
            0x7043_930e_1314_9015,
            0x5867_4ebe_c047_d81e,
            0x9872_74f3_65d6_3c6d,
        ],
    },
    Stored {
        scheme: Scheme::Variational4,
        single: 0xc1fd_02c3_ef57_c5c4,
        double: [
            0x176e_e49e_3712_4b69,
            0xf5d8_a767_c325_47ac,
            0xe40e_12b9_ccbf_aa08,
        ],
    },
    Stored {
        scheme: Scheme::Staggered,
        single: 0xee6d_496f_359e_2ca2,
        double: [
            0xcc86_20a5_cf12_35c8,
            0x9252_8b9c_6a58_cca2,
            0x816d_7707_04bb_0455,
        ],
    },
];

/// With the feature `portable`, on every platform.
pub(super) const PORTABLE: [Stored; 5] = [
    Stored {
        scheme: Scheme::EemEntropy,
        single: 0xb506_be67_db05_bdbe,
        double: [
            0xe3db_8d7d_0ca7_1258,
            0x59cc_8896_e987_7260,
            0xdfda_75ac_4f39_f2f6,
        ],
    },
    Stored {
        scheme: Scheme::EemTemperature,
        single: 0xee9f_f580_ba16_f252,
        double: [
            0xb881_3b7a_3add_4b3d,
            0xe244_1069_5faa_a413,
            0x7dae_f01c_17ac_ce03,
        ],
    },
    Stored {
        scheme: Scheme::Variational,
        single: 0xae73_f2a4_a7d3_4aaf,
        double: [
            0x641c_4bab_0a26_6d60,
            0x5867_4ebe_c047_d81e,
            0x86dc_6c48_3c86_6ff0,
        ],
    },
    Stored {
        scheme: Scheme::Variational4,
        single: 0xda22_6ddc_b6f7_e031,
        double: [
            0x354e_431a_bcf7_8216,
            0x2329_3e12_f551_c0eb,
            0x5089_edde_d08f_affc,
        ],
    },
    Stored {
        scheme: Scheme::Staggered,
        single: 0x2a7b_c745_0bb2_d11e,
        double: [
            0xcc86_20a5_cf12_35c8,
            0x5888_9aa1_d9a5_93c2,
            0xb094_cc07_7d4c_0d23,
        ],
    },
];

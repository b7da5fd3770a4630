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
        single: 0x692e_56bd_c06c_a39a,
        double: [
            0x534e_3545_a3f5_cddc,
            0x724c_1a8b_e399_919f,
            0x7b91_53bc_1b8c_c9df,
        ],
    },
    Stored {
        scheme: Scheme::EemTemperature,
        single: 0x58aa_7f01_6e8e_7b19,
        double: [
            0x67b0_b79a_e119_ecbc,
            0x59df_3b3e_1729_d415,
            0x4b8e_e439_2a0c_1d63,
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
        single: 0x8374_0fc7_56f0_2c35,
        double: [
            0x91ea_9ede_9abd_4250,
            0xd6b9_5465_d43b_246a,
            0xa461_7654_0c39_5fe0,
        ],
    },
];

/// With the feature `portable`, on every platform.
pub(super) const PORTABLE: [Stored; 5] = [
    Stored {
        scheme: Scheme::EemEntropy,
        single: 0xf494_12ce_7ca4_a453,
        double: [
            0x534e_3545_a3f5_cddc,
            0x724c_1a8b_e399_919f,
            0xb70a_4dde_5c54_be21,
        ],
    },
    Stored {
        scheme: Scheme::EemTemperature,
        single: 0x00fa_3af8_3a7b_f806,
        double: [
            0x67b0_b79a_e119_ecbc,
            0xcebf_4506_8f41_09d3,
            0xcfe6_91ab_878b_2c94,
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
        single: 0x2c6e_6f71_5137_e521,
        double: [
            0x93a5_9fb0_d4a1_248b,
            0x8eea_7580_3ca6_537b,
            0x4ab4_a04f_3c33_575e,
        ],
    },
];

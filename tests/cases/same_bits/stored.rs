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
        single: 0xe3a1_cda4_978b_7e76,
        double: [
            0xce92_5084_ea35_69d7,
            0x8bd3_e475_34b3_793e,
            0x998c_9c0c_a44b_8eda,
        ],
    },
    Stored {
        scheme: Scheme::EemTemperature,
        single: 0xd77d_14c0_05e2_ac1e,
        double: [
            0x6116_2e99_a4ed_1369,
            0xfc9e_b37b_ec6c_08a3,
            0x1ee1_8c6e_a7d7_6f2e,
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
        single: 0x7815_d598_80eb_a700,
        double: [
            0xce92_5084_ea35_69d7,
            0x4eeb_5970_fb55_2233,
            0x7e6c_93e3_d852_a83e,
        ],
    },
    Stored {
        scheme: Scheme::EemTemperature,
        single: 0x412d_c319_6103_f9f1,
        double: [
            0x7dcb_508d_7221_b044,
            0xfc9e_b37b_ec6c_08a3,
            0x54c9_e23e_5f9b_10b4,
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

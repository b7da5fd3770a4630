//! The energy–entropy–momentum scheme of order 6, TC-cG(3).
//!
//! As [`eem_entropy_4`](super::eem_entropy_4), on Gauss collocation of three stages, with five points of the
//! path.

use crate::element::tableau::{Ending, EntropyBalance, Path, Supports, Tableau};

/// `½ − √15/10`, and the same from the end.
const FIRST: f64 = 0.112_701_665_379_258_31;
const THIRD: f64 = 0.887_298_334_620_741_7;

const WEIGHTS: [f64; 3] = [5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0];

/// A.
const RATES: [[f64; 3]; 3] = [
    [
        5.0 / 36.0,
        -0.035_976_667_524_938_9,
        0.009_789_444_015_308_326,
    ],
    [
        0.300_263_194_980_864_6,
        2.0 / 9.0,
        -0.022_485_417_203_086_814,
    ],
    [
        0.267_988_333_762_469_45,
        0.480_421_111_969_383_35,
        5.0 / 36.0,
    ],
];

/// `A⁻¹`.
const MOTION: [[f64; 3]; 3] = [
    [5.0, 1.163_977_794_943_222_5, -0.163_977_794_943_222_5],
    [-5.727_486_121_839_514, 2.0, 0.727_486_121_839_514],
    [10.163_977_794_943_223, -9.163_977_794_943_223, 5.0],
];

/// `θ_i` and `s_i` are those of the stage.
const OWN: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// `b_i (A⁻¹)_ik`, a row per stage k.
const SUPPLY: [[f64; 3]; 3] = [supply(0), supply(1), supply(2)];

const fn supply(stage: usize) -> [f64; 3] {
    [
        WEIGHTS[0] * MOTION[0][stage],
        WEIGHTS[1] * MOTION[1][stage],
        WEIGHTS[2] * MOTION[2][stage],
    ]
}

const fn balance(stage: usize) -> EntropyBalance {
    EntropyBalance::of_stage(stage, [&OWN[stage], &RATES[stage], &SUPPLY[stage]])
}

/// See the module.
pub(crate) static TABLEAU: Tableau = Tableau {
    times: &[FIRST, 0.5, THIRD],
    known: 0,
    // A²/c.
    positions: &[
        &[
            0.098_588_703_846_749_08,
            -0.073_543_889_318_025_01,
            0.031_306_018_160_905_09,
        ],
        &[
            0.204_805_092_950_206_02,
            1.0 / 18.0,
            -0.010_360_648_505_761_58,
        ],
        &[
            0.246_471_759_616_872_7,
            0.184_655_000_429_136_12,
            0.012_522_407_264_362_035,
        ],
    ],
    rates: &[&RATES[0], &RATES[1], &RATES[2]],
    weights: &WEIGHTS,
    temperatures: &[&OWN[0], &OWN[1], &OWN[2]],
    entropies: &[balance(0), balance(1), balance(2)],
    motion: &[&MOTION[0], &MOTION[1], &MOTION[2]],
    ending: Ending::Increments {
        displacements: &[5.0 / 3.0, -4.0 / 3.0, 5.0 / 3.0],
        // 20 ± 10 √15/3 at the ends.
        impulses: &[32.909_944_487_358_06, -16.0, 7.090_055_512_641_944],
    },
    path: Some(Path {
        integrals: &[
            &[
                0.064_398_708_831_816,
                -0.024_167_596_307_925_55,
                0.006_678_964_506_777_55,
            ],
            &[
                0.231_788_296_506_356_04,
                -0.003_643_337_115_968_596_7,
                0.002_620_385_556_771_015_6,
            ],
            &RATES[1],
            &[
                0.275_157_392_221_006_76,
                0.448_087_781_560_413_04,
                0.045_989_481_271_421_74,
            ],
            &[
                0.271_098_813_271_000_2,
                0.468_612_040_752_37,
                0.213_379_068_945_961_77,
            ],
        ],
        projection: &[
            &[NEAREST, NEAR, 0.0, FAR, FARTHEST],
            &[EDGE, INNER, 0.64, INNER, EDGE],
            &[FARTHEST, FAR, 0.0, NEAR, NEAREST],
        ],
        supports: Supports {
            times: &[0.276_393_202_250_021, 0.723_606_797_749_979, 1.0],
            to_stages: &[
                &[
                    0.683_012_701_892_219_3,
                    -0.183_012_701_892_219_32,
                    0.056_350_832_689_629_156,
                ],
                &[0.625, 0.625, -0.125],
                &[
                    -0.183_012_701_892_219_32,
                    0.683_012_701_892_219_3,
                    0.443_649_167_310_370_84,
                ],
            ],
            integrals: &[
                &[
                    0.255_565_733_887_470_6,
                    0.023_460_624_222_240_916,
                    -0.002_633_155_859_690_505_6,
                ],
                &[
                    0.280_410_933_637_468_3,
                    0.420_983_820_222_203_53,
                    0.022_212_043_890_307_16,
                ],
                &WEIGHTS,
            ],
            mean: [
                &[0.0, 0.276_393_202_250_021, 0.723_606_797_749_979, 1.0],
                &[1.0 / 12.0, 5.0 / 12.0, 5.0 / 12.0, 1.0 / 12.0],
            ],
        },
    }),
};

/// `w_r ℓ_i(τ_r)/b_i` of the first stage, from the nearest point to the farthest one; at the point in the
/// middle it vanishes.
const NEAREST: f64 = 0.541_289_962_674_430_4;
const NEAR: f64 = 0.507_618_538_050_135_7;
const FAR: f64 = -0.091_284_540_703_543_25;
const FARTHEST: f64 = 0.042_376_039_978_977_18;

/// The same of the stage in the middle.
const EDGE: f64 = -0.098_248_505_970_167;
const INNER: f64 = 0.278_248_505_970_167;

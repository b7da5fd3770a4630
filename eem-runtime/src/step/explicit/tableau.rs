//! The coefficients of DOP853, and positive weights on its stages.
//!
//! Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, section II.5 and their code
//! `dop853.f`; the digits are those of `scipy/integrate/_ivp/dop853_coefficients.py`, rounded to doubles.
//! Stages are numbered from 0. Only stages that a row uses are listed.

#![expect(
    clippy::unreadable_literal,
    reason = "digits as published, to be compared with their source"
)]

/// Number of stages.
pub(super) const STAGES: usize = 12;

/// Up to these products with the step the stability function is at most 1: on the imaginary axis, vibrations, and on the real
/// one, conduction and dashpots.
pub(super) const IMAGINARY_LIMIT: f64 = 5.96;
pub(crate) const REAL_LIMIT: f64 = 6.39;

/// c: the times of the stages, as fractions of the step.
pub(super) const TIMES: [f64; STAGES] = [
    0.0,
    0.05260015195876773,
    0.0789002279381516,
    0.1183503419072274,
    0.2816496580927726,
    0.3333333333333333,
    0.25,
    0.3076923076923077,
    0.6512820512820513,
    0.6,
    0.8571428571428571,
    1.0,
];

/// a: the coefficients of each stage for the earlier stages that it uses.
pub(super) const ROW_1: [f64; 1] = [0.05260015195876773];
pub(super) const ROW_2: [f64; 2] = [0.0197250569845379, 0.0591751709536137];
pub(super) const ROW_3: [f64; 2] = [0.02958758547680685, 0.08876275643042054];
pub(super) const ROW_4: [f64; 3] = [0.2413651341592667, -0.8845494793282861, 0.924834003261792];
pub(super) const ROW_5: [f64; 3] = [
    0.037037037037037035,
    0.17082860872947386,
    0.12546768756682242,
];
pub(super) const ROW_6: [f64; 4] = [
    0.037109375,
    0.17025221101954405,
    0.06021653898045596,
    -0.017578125,
];
pub(super) const ROW_7: [f64; 5] = [
    0.03709200011850479,
    0.17038392571223998,
    0.10726203044637328,
    -0.015319437748624402,
    0.008273789163814023,
];
pub(super) const ROW_8: [f64; 6] = [
    0.6241109587160757,
    -3.3608926294469414,
    -0.868219346841726,
    27.59209969944671,
    20.154067550477894,
    -43.48988418106996,
];
pub(super) const ROW_9: [f64; 7] = [
    0.47766253643826434,
    -2.4881146199716677,
    -0.590290826836843,
    21.230051448181193,
    15.279233632882423,
    -33.28821096898486,
    -0.020331201708508627,
];
pub(super) const ROW_10: [f64; 8] = [
    -0.9371424300859873,
    5.186372428844064,
    1.0914373489967295,
    -8.149787010746927,
    -18.52006565999696,
    22.739487099350505,
    2.4936055526796523,
    -3.0467644718982196,
];
pub(super) const ROW_11: [f64; 9] = [
    2.273310147516538,
    -10.53449546673725,
    -2.0008720582248625,
    -17.9589318631188,
    27.94888452941996,
    -2.8589982771350235,
    -8.87285693353063,
    12.360567175794303,
    0.6433927460157636,
];

/// The stages that have weights.
pub(super) const WEIGHTED: [usize; 8] = [0, 5, 6, 7, 8, 9, 10, 11];

/// b, of order 8, of the [weighted](WEIGHTED) stages; two of them are negative.
pub(super) const WEIGHTS: [f64; 8] = [
    0.054293734116568765,
    4.450312892752409,
    1.8915178993145003,
    -5.801203960010585,
    0.3111643669578199,
    -0.1521609496625161,
    0.20136540080403034,
    0.04471061572777259,
];

/// The times and the weights of forces in a step.
pub(crate) const fn load_rule() -> (&'static [f64], &'static [f64]) {
    const AT: [f64; WEIGHTED.len()] = {
        let mut at = [0.0; WEIGHTED.len()];
        let mut index = 0;
        while index < at.len() {
            at[index] = TIMES[WEIGHTED[index]];
            index += 1;
        }
        at
    };
    (&AT, &WEIGHTS)
}

/// The times and the weights of the positions of a moved anchor in a step: those of the stages, of the polynomial through its
/// positions at Chebyshev points.
pub(crate) const fn motion_rule() -> (&'static [f64], &'static [f64]) {
    (&MOTION_TIMES, &MOTION_WEIGHTS)
}

/// `½ − ½ cos(π m/10)`
const MOTION_TIMES: [f64; 11] = [
    0.0,
    0.024471741852423214,
    0.09549150281252629,
    0.20610737385376343,
    0.3454915028125263,
    0.5,
    0.6545084971874737,
    0.7938926261462366,
    0.9045084971874737,
    0.9755282581475768,
    1.0,
];

/// `Σ_i b_i ℓ_m(c_i)`
const MOTION_WEIGHTS: [f64; 11] = [
    0.14728800641727063,
    -0.19698081950613017,
    0.2299212230363745,
    0.1284271131856906,
    0.02202838316402516,
    0.36038499577940664,
    -0.06285353388708252,
    0.2898821138398522,
    0.0076974791663234725,
    0.06425885920594179,
    0.009946179598327833,
];

/// `Σ_m |ℓ'_m(c_i)|` of the [weighted](WEIGHTED) stages: times ε/2 of positions, the rounding of a velocity times the step.
pub(super) const MOTION_SLOPES: [f64; 8] = [
    200.0,
    33.42597574704832,
    28.980596918800966,
    31.179853538985814,
    31.868646728050926,
    25.272144356176977,
    28.428710226572807,
    200.0,
];

/// Positive weights of order 5 of the same stages, for the guard of productions (found by linear
/// programming: the least weight is as large as possible).
pub(super) const POSITIVE_WEIGHTS: [f64; 8] = [
    0.08134581508287198,
    0.049807697006058575,
    0.2918940553901368,
    0.04980769700831541,
    0.2479712494708942,
    0.04980769700046008,
    0.17955809203825143,
    0.049807697003011554,
];

/// b less the weights of the embedded formula of order 5.
pub(super) const ERROR_5: [f64; 8] = [
    0.01312004499419488,
    -1.2251564463762044,
    -0.4957589496572502,
    1.6643771824549864,
    -0.35032884874997366,
    0.3341791187130175,
    0.08192320648511571,
    -0.022355307863886294,
];

/// b less the weights of the embedded formula of order 3.
pub(super) const ERROR_3: [f64; 8] = [
    -0.18980075407240762,
    4.450312892752409,
    1.8915178993145003,
    -5.801203960010585,
    -0.42268232132379197,
    -0.1521609496625161,
    0.20136540080403034,
    0.022651792198360825,
];

#[cfg(test)]
mod tests {
    use super::*;

    /// All rows with the stages that they use.
    fn rows() -> Vec<(usize, Vec<usize>, Vec<f64>)> {
        let row = |stage: usize, used: &[usize], a: &[f64]| (stage, used.to_vec(), a.to_vec());
        vec![
            row(1, &[0], &ROW_1),
            row(2, &[0, 1], &ROW_2),
            row(3, &[0, 2], &ROW_3),
            row(4, &[0, 2, 3], &ROW_4),
            row(5, &[0, 3, 4], &ROW_5),
            row(6, &[0, 3, 4, 5], &ROW_6),
            row(7, &[0, 3, 4, 5, 6], &ROW_7),
            row(8, &[0, 3, 4, 5, 6, 7], &ROW_8),
            row(9, &[0, 3, 4, 5, 6, 7, 8], &ROW_9),
            row(10, &[0, 3, 4, 5, 6, 7, 8, 9], &ROW_10),
            row(11, &[0, 3, 4, 5, 6, 7, 8, 9, 10], &ROW_11),
        ]
    }

    #[test]
    fn stages_are_where_their_times_say() {
        for (stage, _, a) in rows() {
            let sum: f64 = a.iter().sum();
            assert!((sum - TIMES[stage]).abs() < 1e-14, "{stage}: {sum}");
        }
    }

    /// `Σ w c^k`.
    fn moment(weights: &[f64; 8], power: i32) -> f64 {
        let terms = WEIGHTED.iter().zip(weights);
        terms.map(|(&stage, w)| w * TIMES[stage].powi(power)).sum()
    }

    #[test]
    fn weights_integrate_polynomials_of_their_order() {
        for (weights, order) in [(&WEIGHTS, 8), (&POSITIVE_WEIGHTS, 5)] {
            for power in 0..order {
                let exact = 1.0 / f64::from(power + 1);
                assert!((moment(weights, power) - exact).abs() < 1e-14, "{power}");
            }
        }
        assert!(POSITIVE_WEIGHTS.iter().all(|&weight| weight > 0.0));
        for power in 0..3 {
            assert!(moment(&ERROR_3, power).abs() < 1e-14);
        }
        for power in 0..5 {
            assert!(moment(&ERROR_5, power).abs() < 1e-14);
        }
    }
}

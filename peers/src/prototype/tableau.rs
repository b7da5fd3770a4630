//! DOP853: twelve stages, order 8, two embedded estimates of the error.
//!
//! Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, II.5, and their code `dop853.f`. A term
//! `[j] a` stands for a times the rate at stage j, counted from 0. The sums are written out: loops over the whole
//! tableau would multiply by its zeros, too.

#![allow(clippy::unreadable_literal, reason = "17 digits, as in the source")]

use core::array;

use super::model::Pendulum;
use super::stages::Stages;

/// h Σ aⱼ kⱼ.
macro_rules! sum {
    ($h:expr, $k:expr; [$first:literal] $a:literal $(, [$next:literal] $b:literal)*) => {
        array::from_fn(|i| $h * ($a * $k[$first][i] $(+ $b * $k[$next][i])*))
    };
}

/// The rates of a stage at y + h Σ aⱼ kⱼ.
macro_rules! stage {
    ($stages:expr, $C:ty, $h:expr, $y:expr, $stage:literal: $($terms:tt)*) => {{
        let change: [f64; N] = sum!($h, $stages.y; $($terms)*);
        let at = array::from_fn(|i| $y[i] + change[i]);
        $stages.evaluate::<$C>($stage, &at)
    }};
}

/// h Σ bⱼ kⱼ, of order 8.
macro_rules! weighted {
    ($h:expr, $k:expr) => {
        sum!($h, $k;
            [0] 0.054293734116568765, [5] 4.450312892752409, [6] 1.8915178993145003,
            [7] -5.801203960010585, [8] 0.3111643669578199, [9] -0.1521609496625161,
            [10] 0.20136540080403034, [11] 0.04471061572777259
        )
    };
}

impl<const N: usize, const X: usize> Stages<N, X> {
    /// Rates at all stages of a step of size h from y; false if a state is not admissible.
    #[inline(always)]
    pub(super) fn fill<C: Pendulum<N, X>>(&mut self, h: f64, y: &[f64; N]) -> bool {
        let mut is_admissible = true;
        is_admissible &= stage!(self, C, h, y, 1: [0] 0.05260015195876773);
        is_admissible &= stage!(self, C, h, y, 2: [0] 0.0197250569845379, [1] 0.0591751709536137);
        is_admissible &= stage!(self, C, h, y, 3: [0] 0.02958758547680685, [2] 0.08876275643042054);
        is_admissible &= stage!(self, C, h, y, 4:
            [0] 0.2413651341592667, [2] -0.8845494793282861, [3] 0.924834003261792
        );
        is_admissible &= stage!(self, C, h, y, 5:
            [0] 0.037037037037037035, [3] 0.17082860872947386, [4] 0.12546768756682242
        );
        is_admissible &= stage!(self, C, h, y, 6:
            [0] 0.037109375, [3] 0.17025221101954405, [4] 0.06021653898045596, [5] -0.017578125
        );
        is_admissible &= stage!(self, C, h, y, 7:
            [0] 0.03709200011850479, [3] 0.17038392571223998, [4] 0.10726203044637328,
            [5] -0.015319437748624402, [6] 0.008273789163814023
        );
        is_admissible &= stage!(self, C, h, y, 8:
            [0] 0.6241109587160757, [3] -3.3608926294469414, [4] -0.868219346841726,
            [5] 27.59209969944671, [6] 20.154067550477894, [7] -43.48988418106996
        );
        is_admissible &= stage!(self, C, h, y, 9:
            [0] 0.47766253643826434, [3] -2.4881146199716677, [4] -0.590290826836843,
            [5] 21.230051448181193, [6] 15.279233632882423, [7] -33.28821096898486,
            [8] -0.020331201708508627
        );
        is_admissible &= stage!(self, C, h, y, 10:
            [0] -0.9371424300859873, [3] 5.186372428844064, [4] 1.0914373489967295,
            [5] -8.149787010746927, [6] -18.52006565999696, [7] 22.739487099350505,
            [8] 2.4936055526796523, [9] -3.0467644718982196
        );
        is_admissible &= stage!(self, C, h, y, 11:
            [0] 2.273310147516538, [3] -10.53449546673725, [4] -2.0008720582248625,
            [5] -17.9589318631188, [6] 27.94888452941996, [7] -2.8589982771350235,
            [8] -8.87285693353063, [9] 12.360567175794303, [10] 0.6433927460157636
        );
        is_admissible
    }

    /// The changes of y and of the integrals over a step.
    #[inline(always)]
    pub(super) fn changes(&self, h: f64) -> ([f64; N], [f64; X]) {
        (weighted!(h, self.y), weighted!(h, self.x))
    }

    /// The estimates of orders 5 and 3 for the error of the change of y.
    #[inline(always)]
    pub(super) fn errors(&self, h: f64) -> [[f64; N]; 2] {
        let fifth = sum!(h, self.y;
            [0] 0.01312004499419488, [5] -1.2251564463762044, [6] -0.4957589496572502,
            [7] 1.6643771824549864, [8] -0.35032884874997366, [9] 0.3341791187130175,
            [10] 0.08192320648511571, [11] -0.022355307863886294
        );
        let third = sum!(h, self.y;
            [0] -0.18980075407240762, [5] 4.450312892752409, [6] 1.8915178993145003,
            [7] -5.801203960010585, [8] -0.4226823213237919, [9] -0.1521609496625161,
            [10] 0.20136540080403034, [11] 0.02265179219836082
        );
        [fifth, third]
    }

    /// The change of an integral by weights that are all positive, of order 5.
    #[cold]
    pub(super) fn positive_change(&self, h: f64, integral: usize) -> f64 {
        let rates: [[f64; 1]; 12] = array::from_fn(|stage| [self.x[stage][integral]]);
        let [change] = sum!(h, rates;
            [0] 0.08134581508287198, [5] 0.049807697006058575, [6] 0.2918940553901368,
            [7] 0.04980769700831541, [8] 0.2479712494708942, [9] 0.04980769700046008,
            [10] 0.17955809203825143, [11] 0.049807697003011554
        );
        change
    }
}

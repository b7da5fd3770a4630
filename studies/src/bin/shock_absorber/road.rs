//! A rough road as a sum of waves: the same road in every run, and the same again in every lap.

#![allow(dead_code, reason = "examples that share this file use a part of it")]

use std::f64::consts::{PI, TAU};

/// Spatial frequency to which the roughness of a road class refers, cycles/m (ISO 8608).
const REFERENCE_FREQUENCY: f64 = 0.1;

/// (√5 − 1)/2. The phase of wave k is k² turns of it: without a pattern, and the same in every
/// run. (k turns of it would only shift the road.)
const GOLDEN_TURN: f64 = 0.618_033_988_749_894_9;

/// A closed track and how fast it is driven; its waves are those that fit into a lap.
///
/// ```text
/// z(t) = Σ_k A_k cos(2π k v t/L + φ_k),   A_k² = 2 G(n_k)/L,   n_k = k/L,   G(n) = G₀ (n/n₀)⁻²
/// ```
///
/// ISO 8608:2016 gives G₀ at n₀ = 0.1 m⁻¹ by class and the exponent −2; Múčka, J. Test. Eval. 46
/// (2018) 405–418, reviews the sum of cosines.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Track {
    /// L, m.
    pub(crate) lap: f64,
    /// v, m/s.
    pub(crate) speed: f64,
    /// G₀, m³.
    pub(crate) roughness: f64,
    /// The shortest and the longest wave, as k.
    pub(crate) waves: [u32; 2],
}

/// The height of the road below a wheel, as a function of time.
#[derive(Clone, Debug)]
pub(crate) struct Road {
    waves: Vec<Wave>,
}

#[derive(Clone, Copy, Debug)]
struct Wave {
    /// m.
    amplitude: f64,
    /// rad/s.
    frequency: f64,
    /// rad.
    phase: f64,
}

impl Track {
    /// Time of a lap, s.
    pub(crate) const fn lap_time(&self) -> f64 {
        self.lap / self.speed
    }

    /// Mean power (W) that a road with all waves gives to a car on a tyre of this stiffness (N/m).
    ///
    /// ```text
    /// P = π² G₀ n₀² v k_t
    /// ```
    ///
    /// The slope of such a road is white noise, of the density `(2π)² G₀ n₀² v` per hertz as a
    /// velocity; a spring shaken by white noise takes up a quarter of that times its stiffness,
    /// whatever hangs on it.
    pub(crate) fn power(&self, tyre: f64) -> f64 {
        (PI * REFERENCE_FREQUENCY).powi(2) * self.roughness * self.speed * tyre
    }

    /// What a wheel on this track feels.
    pub(crate) fn road(&self) -> Road {
        let [first, last] = self.waves;
        let wave = |k: u32| {
            let k = f64::from(k);
            let density = self.roughness * (k / self.lap / REFERENCE_FREQUENCY).powi(-2);
            Wave {
                amplitude: (2.0 * density / self.lap).sqrt(),
                frequency: TAU * k / self.lap_time(),
                phase: TAU * (k * k * GOLDEN_TURN).fract(),
            }
        };
        Road {
            waves: (first..=last).map(wave).collect(),
        }
    }
}

impl Road {
    /// Height at the time `t` (s), m.
    pub(crate) fn height(&self, t: f64) -> f64 {
        let height = |wave: &Wave| wave.amplitude * (wave.frequency * t + wave.phase).cos();
        self.waves.iter().map(height).sum()
    }
}

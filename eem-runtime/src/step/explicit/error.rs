//! The estimate of the error of a step (Hairer, Nørsett & Wanner, section II.10).

use super::Explicit;
use super::demand::Scales;
use crate::step::control::{Tolerance, norm};
use eem_material::number::scalar::{Mask, Real};

impl<S: Real, const D: usize> Explicit<S, D> {
    /// The scales of the step, at its end before it is closed.
    pub(super) fn scales(&self) -> Scales<S> {
        let size = self.components.masses * D;
        let momenta = self.offsets.momenta..self.offsets.momenta + size;
        Scales {
            position: norm(&self.y0[..size]).maximum(norm(&self.y[..size])),
            momentum: norm(&self.y[momenta]).maximum(self.books.largest_momentum),
        }
    }

    /// The error of the step in units of the tolerance,
    ///
    /// ```text
    /// e₅²/√(e₅² + 0.01 e₃²),     e = |h Σ E k / scale|₂
    /// ```
    ///
    /// with the scales of a [`Tolerance`]: |q| for positions and viscous stretches, the largest |p| so far for
    /// momenta, and θ.
    pub(super) fn estimate(&mut self, h: S, tolerance: &Tolerance<S>, scales: Scales<S>) -> S {
        self.find_errors(h);
        let [fifth, third] = self.errors();
        let mut sums = [S::zero(); 2];
        let mut see = |index: usize, per_scale: S| {
            for (sum, errors) in sums.iter_mut().zip([fifth, third]) {
                let error = errors[index] * per_scale;
                *sum += error * error;
            }
        };
        let per_scale = |size: S, absolute: S| {
            let scale = tolerance.relative * size + absolute;
            // Where the scale is zero nothing moves.
            let has_scale = S::zero().less(scale).all();
            if has_scale { scale.recip() } else { S::zero() }
        };
        let offsets = self.offsets;
        let size = self.components.masses * D;
        let position = per_scale(scales.position, tolerance.position);
        for index in (0..size).chain(offsets.viscous..offsets.temperatures) {
            see(index, position);
        }
        let momentum = per_scale(scales.momentum, tolerance.momentum);
        for index in offsets.momenta..offsets.momenta + size {
            see(index, momentum);
        }
        for index in offsets.temperatures..offsets.reservoirs {
            see(index, per_scale(self.y0[index], tolerance.temperature));
        }
        let [five, three] = sums;
        if five.at_most(S::zero()).all() {
            return S::zero();
        }
        five / (five + S::from_f64(0.01) * three).sqrt()
    }
}

//! Heat capacities that are not constant, each with an elastic part that couples.

use crate::zoo::number::{atan, exp, ln, ln_1p};
use crate::zoo::specimen::specimen;

specimen! {
    /// `C = c (θ/θr)ⁿ`, beside Ogden's powers of the stretch.
    Power { modulus: 2.0, alpha: 1.3, coupling: 0.01, capacity: 0.4, order: 2.2, theta_ref: 300.0 }
    (lambda: Stretch = 1.3 in [0.5, 2.5], theta: Temperature = 310.0 in [200.0, 400.0])
    {
        let ratio = theta / theta_ref;
        modulus * ratio * (lambda.powf(alpha) / alpha + 2.0 / (alpha * lambda.powf(0.5 * alpha)))
            - coupling * theta.sqrt() * lambda
            - capacity * theta * ratio.powf(order) / (order * (order + 1.0))
    }
}

specimen! {
    /// Shomate's polynomial, `C = a + b t + c t² + d t³ + e/t²` with t = θ/1000 K; a mole of solid
    /// aluminium, Chase 1998.
    Polynomial {
        a: 28.0892, b: -5.414_849, c: 8.560_423, d: 3.42737, e: -0.277_375,
        stiffness: 90000.0, expansion: 0.000_023, length: 0.1,
    }
    (lambda: Stretch = 0.101 in [0.09, 0.11], theta: Temperature = 400.0 in [300.0, 900.0])
    {
        let t = theta / 1000.0;
        let u = lambda - length * (1.0 + expansion * (theta - 300.0));
        0.5 * stiffness * u.powi(2) - a * theta * ln(t)
            - theta * (b * t / 2.0 + c * t.powi(2) / 6.0 + d * t.powi(3) / 12.0 + 0.5 * e * t.powi(-2))
    }
}

specimen! {
    /// A metal at a few kelvin: electrons and lattice, `C = g θ + a θ³`.
    Metal { stiffness: 40.0, pull: 0.001, length: 1.0, g: 0.00069, a: 0.000_047_8 }
    (lambda: Stretch = 1.05 in [0.7, 1.5], theta: Temperature = 8.0 in [1.0, 30.0])
    {
        let u = lambda - length;
        0.5 * stiffness * u.powi(2) - pull * theta.powi(2) * u
            - 0.5 * g * theta.powi(2) - a * theta.powi(4) / 12.0
    }
}

specimen! {
    /// Einstein solid whose frequency falls with the stretch, `Θ = Θ₀ (λ/L)^(−g)`.
    Einstein { stiffness: 300.0, length: 1.0, capacity: 3.0, lowest: 250.0, grueneisen: 1.8 }
    (lambda: Stretch = 1.1 in [0.8, 1.6], theta: Temperature = 150.0 in [40.0, 400.0])
    {
        let s = lambda / length;
        let frequency = lowest * s.powf(-grueneisen);
        0.5 * stiffness * ln(s).powi(2) + 0.5 * capacity * frequency
            + capacity * theta * ln_1p(-exp(-frequency / theta))
    }
}

specimen! {
    /// Debye-like: three frequencies of an elastic continuum, with the weights of its density.
    ThreeModes {
        stiffness: 200.0, length: 1.0, capacity: 1.5, debye: 320.0, coupling: 0.001,
    }
    (lambda: Stretch = 1.1 in [0.7, 1.6], theta: Temperature = 120.0 in [30.0, 400.0])
    {
        let u = lambda - length;
        let x = debye / theta;
        0.5 * stiffness * u.powi(2) - coupling * theta.powi(2) * u
            + capacity * theta * (0.1 * ln_1p(-exp(-0.35 * x)) + 0.35 * ln_1p(-exp(-0.65 * x))
                + 0.55 * ln_1p(-exp(-0.92 * x)))
    }
}

specimen! {
    /// Frozen at low temperature, constant at high: `C = c θ²/(θ² + Θ²)`.
    Saturating { stiffness: 200.0, length: 1.0, capacity: 2.5, frozen: 120.0, expansion: 0.001 }
    (lambda: Stretch = 1.1 in [0.7, 1.6], theta: Temperature = 150.0 in [30.0, 400.0])
    {
        let u = lambda - length;
        let ratio = theta / frozen;
        0.5 * stiffness * u.powi(2) - stiffness * expansion * theta * u
            - capacity * (0.5 * theta * ln(1.0 + ratio.powi(2)) - theta + frozen * atan(ratio))
    }
}

specimen! {
    /// Schottky anomaly: two levels whose gap opens with the stretch, beside a lattice.
    Schottky { stiffness: 60.0, length: 1.0, n_r: 4.0, gap: 20.0, lattice: 0.5, theta_ref: 10.0 }
    (lambda: Stretch = 1.2 in [0.7, 1.6], theta: Temperature = 8.0 in [3.0, 40.0])
    {
        let s = lambda / length;
        0.5 * stiffness * (s - 1.0).powi(2) - n_r * theta * ln_1p(exp(-gap * s / theta))
            - lattice * theta * ln(theta / theta_ref)
    }
}

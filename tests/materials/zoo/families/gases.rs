//! Gases under a piston: λ is the height of the column, `V = A λ`, against an outer pressure.

use crate::zoo::number::{exp, ln};
use crate::zoo::specimen::specimen;

specimen! {
    /// Ideal gas: a mole of air at 1 bar, 0.1 m² of piston.
    Ideal { n_r: 8.314, area: 0.1, pressure: 100_000.0, height: 0.25, capacity: 20.8, theta_ref: 300.0 }
    (lambda: Stretch = 0.25 in [0.08, 0.8], theta: Temperature = 310.0 in [200.0, 600.0])
    {
        -n_r * theta * ln(lambda / height) + pressure * area * lambda
            + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
    }
}

specimen! {
    /// Van der Waals 1873: a mole of carbon dioxide, a = 0.3640 Pa m⁶, b = 4.267e-5 m³.
    VanDerWaals {
        n_r: 8.314, a: 0.364, b: 0.000_042_67, area: 0.01, volume: 0.0024, pressure: 1_000_000.0,
        capacity: 28.5, theta_ref: 300.0,
    }
    (lambda: Stretch = 0.24 in [0.03, 0.8], theta: Temperature = 310.0 in [250.0, 500.0])
    {
        let v = area * lambda;
        -n_r * theta * ln((v - b) / volume) - a / v + pressure * v
            + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
    }
}

specimen! {
    /// Redlich & Kwong 1949: a mole of nitrogen, a = 1.555 Pa m⁶ K^½, b = 2.68e-5 m³.
    RedlichKwong {
        n_r: 8.314, a: 1.555, b: 0.000_026_8, area: 0.01, volume: 0.0024, pressure: 1_000_000.0,
        capacity: 20.8, theta_ref: 300.0,
    }
    (lambda: Stretch = 0.24 in [0.03, 0.8], theta: Temperature = 290.0 in [150.0, 500.0])
    {
        let v = area * lambda;
        -n_r * theta * ln((v - b) / volume) - a / (b * theta.sqrt()) * ln(1.0 + b / v)
            + pressure * v + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
    }
}

specimen! {
    /// Second virial coefficient of the square well, `B = b (1 − (r³ − 1)(exp(ε/θ) − 1))`.
    SquareWell {
        n_r: 8.314, b: 0.00005, range: 1.7, epsilon: 93.0, area: 0.01, volume: 0.0024,
        pressure: 1_000_000.0, capacity: 12.5, theta_ref: 300.0,
    }
    (lambda: Stretch = 0.24 in [0.05, 0.8], theta: Temperature = 290.0 in [150.0, 500.0])
    {
        let v = area * lambda;
        let virial = b * (1.0 - (range.powi(3) - 1.0) * (exp(epsilon / theta) - 1.0));
        n_r * theta * (virial / v - ln(v / volume)) + pressure * v
            + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
    }
}

specimen! {
    /// Radiation in a cavity at a million kelvin, `ψ = −a V θ⁴/3`.
    Photons { a: 7.5657e-16, area: 0.0001, pressure: 252_190_000.0, stiffness: 1_000_000.0, height: 1.0 }
    (lambda: Stretch = 1.0 in [0.3, 3.0], theta: Temperature = 1_000_000.0 in [500_000.0, 1_500_000.0])
    {
        -a / 3.0 * area * lambda * theta.powi(4) + pressure * area * lambda
            + 0.5 * stiffness * (lambda - height).powi(2)
    }
}

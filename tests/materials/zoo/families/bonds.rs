//! Bonds between particles, in the reduced units of their fields unless a parameter says otherwise.

use crate::zoo::number::{exp, ln};
use crate::zoo::specimen::specimen;

specimen! {
    /// The bond of a diatomic molecule, Morse 1929.
    Morse { depth: 4.5, width: 1.9, length: 0.75 }
    (lambda: Stretch = 0.85 in [0.5, 2.0])
    {
        depth * (1.0 - exp(-width * (lambda - length))).powi(2)
    }
}

specimen! {
    /// Lennard-Jones 1931, 12–6.
    LennardJones { epsilon: 1.0, sigma: 1.0 }
    (lambda: Stretch = 1.15 in [0.9, 2.5])
    {
        let attraction = (sigma / lambda).powi(6);
        4.0 * epsilon * (attraction.powi(2) - attraction)
    }
}

specimen! {
    /// Mie 1903 with the exponents of a coarse-grained alkane.
    Mie { epsilon: 1.2, sigma: 1.0, n: 14.65, m: 6.0 }
    (lambda: Stretch = 1.12 in [0.9, 2.5])
    {
        let ratio = sigma / lambda;
        let prefactor = n / (n - m) * (n / m).powf(m / (n - m));
        prefactor * epsilon * (ratio.powf(n) - ratio.powf(m))
    }
}

specimen! {
    /// Finitely extensible nonlinear elastic bond, Warner 1972.
    Fene { stiffness: 30.0, extent: 1.5 }
    (lambda: Stretch = 0.6 in [0.1, 1.4])
    {
        -0.5 * stiffness * extent.powi(2) * ln(1.0 - (lambda / extent).powi(2))
    }
}

specimen! {
    /// The bead–spring bond of Kremer & Grest 1990, its repulsion without a cut-off.
    KremerGrest { stiffness: 30.0, extent: 1.5, epsilon: 1.0, sigma: 1.0 }
    (lambda: Stretch = 1.0 in [0.8, 1.4])
    {
        let attraction = (sigma / lambda).powi(6);
        4.0 * epsilon * (attraction.powi(2) - attraction)
            - 0.5 * stiffness * extent.powi(2) * ln(1.0 - (lambda / extent).powi(2))
    }
}

specimen! {
    /// Exp–6, Buckingham 1938, with the data of argon in eV and Å.
    Buckingham { a: 10550.0, b: 3.66, c: 63.7 }
    (lambda: Stretch = 3.9 in [3.4, 4.6])
    {
        a * exp(-b * lambda) - c / lambda.powi(6)
    }
}

specimen! {
    /// An ion pair, Born & Mayer 1932, with the data of rock salt in eV and Å.
    BornMayer { charge: 14.4, a: 1227.0, rho: 0.321 }
    (lambda: Stretch = 2.5 in [1.8, 5.0])
    {
        a * exp(-lambda / rho) - charge / lambda
    }
}

specimen! {
    /// Worm-like chain, Marko & Siggia 1995, eq. 7 integrated; entropic but for its heat capacity.
    WormLikeChain { boltzmann: 0.0138, contour: 300.0, persistence: 50.0, capacity: 5.0, theta_ref: 300.0 }
    (lambda: Stretch = 150.0 in [20.0, 280.0], theta: Temperature = 310.0 in [270.0, 350.0])
    {
        let x = lambda / contour;
        let bending = 1.0 / (4.0 * (1.0 - x)) - 0.25 * x + 0.5 * x.powi(2) - 0.25;
        boltzmann * theta * contour / persistence * bending
            + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
    }
}

specimen! {
    /// A bond that unfolds: two wells in thermal equilibrium, ψ = −kθ ln Σ exp(−uᵢ/kθ).
    TwoState {
        boltzmann: 0.0138, folded: 2.0, unfolded: 0.5, short: 1.0, long: 4.0, gap: 4.0,
        capacity: 0.3, theta_ref: 300.0,
    }
    (lambda: Stretch = 2.0 in [0.5, 5.0], theta: Temperature = 320.0 in [260.0, 380.0])
    {
        let first = 0.5 * folded * (lambda - short).powi(2);
        let second = 0.5 * unfolded * (lambda - long).powi(2) + gap;
        let energy = boltzmann * theta;
        first - energy * ln(1.0 + exp((first - second) / energy))
            + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
    }
}

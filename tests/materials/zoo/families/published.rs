//! The models of the papers that the schemes come from.

use crate::zoo::number::{diff, exp, ln};
use crate::zoo::specimen::specimen;

specimen! {
    /// Thermo-visco-elastic pendulum, García Orden & Romero 2012, §4.1.
    ThermoViscoElastic {
        length: 1.0, k0: 100.0, k1: 0.5, ratio: 0.1, beta: 4.0, capacity: 1.0, mu0: 5.0, mu1: 0.1,
        eta0: 100.0, activation: 10.0, theta_ref: 300.0,
    }
    (
        lambda: Stretch = 1.3 in [0.6, 3.0],
        gamma: Viscous = 0.2 in [-1.0, 1.0],
        theta: Temperature = 340.0 in [280.0, 345.0],
    )
    {
        let strain = ln(lambda / length);
        let heating = theta - theta_ref;
        let elastic = 0.5 * (k0 - k1 * heating) * strain.powi(2) - beta * heating * strain
            + capacity * (heating - theta * ln(theta / theta_ref));
        (1.0 + ratio) * elastic + (mu0 - mu1 * heating) * gamma.powi(2)
            - ratio * gamma * diff(elastic, lambda)
    }
    or {
        let strain = ln(lambda / length);
        let heating = theta - theta_ref;
        let elastic = 0.5 * (k0 - k1 * heating) * strain.powi(2) - beta * heating * strain
            + capacity * (heating - theta * ln(theta / theta_ref));
        let force = ((k0 - k1 * heating) * strain - beta * heating) / lambda;
        (1.0 + ratio) * elastic + (mu0 - mu1 * heating) * gamma.powi(2) - ratio * gamma * force
    }
    [gamma = eta0 * exp(activation * (1.0 / theta - 1.0 / theta_ref))]
}

specimen! {
    /// Thermoelastic double pendulum, Conde Martín, Betsch & García Orden 2016, eq. 43, the data
    /// of Krüger.
    ConstantStiffness {
        stiffness: 100.0, length: 2.0, beta: 0.2, capacity: 1000.0, theta_ref: 300.0,
    }
    (lambda: Stretch = 2.4 in [1.0, 4.0], theta: Temperature = 330.0 in [250.0, 400.0])
    {
        let strain = ln(lambda / length);
        0.5 * stiffness * strain.powi(2) - beta * (theta - theta_ref) * strain
            + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
    }
}

specimen! {
    /// The same with a stiffness logarithmic in θ, which rules out a closed inverse of s(θ).
    LogarithmicStiffness {
        c0: 5000.0, c1: 50.0, length: 2.0, beta: 20.0, capacity: 5000.0, theta_ref: 300.0,
    }
    (lambda: Stretch = 3.1 in [1.0, 4.0], theta: Temperature = 380.0 in [250.0, 420.0])
    {
        let strain = ln(lambda / length);
        let stiffness = c0 - c1 * theta_ref * ln(theta / theta_ref);
        0.5 * stiffness * strain.powi(2) - beta * (theta - theta_ref) * strain
            + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
    }
}

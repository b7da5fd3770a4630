//! One, two and three dashpots, in series and in parallel, with laws of all kinds.

use crate::zoo::number::{cosh, exp, ln, tanh};
use crate::zoo::specimen::specimen;

specimen! {
    /// Spring and dashpot in series beside a spring, without temperature.
    Maxwell { stiffness: 20.0, branch: 8.0, quartic: 2.0, length: 1.0, eta: 3.0 }
    (lambda: Stretch = 1.2 in [0.5, 2.0], gamma: Viscous = 0.1 in [-1.0, 1.0])
    {
        let u = lambda - length;
        0.5 * stiffness * u.powi(2) + 0.5 * branch * (u - gamma).powi(2)
            + quartic * (u - gamma).powi(4)
    }
    [gamma = eta]
}

specimen! {
    /// The same with temperature, and Arrhenius' law for the viscosity.
    Zener {
        stiffness: 20.0, branch: 15.0, length: 1.0, coupling: 0.05, capacity: 1.0,
        theta_ref: 300.0, eta: 6.0, activation: 1200.0,
    }
    (
        lambda: Stretch = 1.3 in [0.5, 2.0],
        gamma: Viscous = 0.1 in [-1.0, 1.0],
        theta: Temperature = 310.0 in [250.0, 400.0],
    )
    {
        let u = lambda - length;
        let heating = theta - theta_ref;
        0.5 * stiffness * u.powi(2) + 0.5 * branch * (u - gamma).powi(2) - coupling * heating * u
            + capacity * (heating - theta * ln(theta / theta_ref))
    }
    [gamma = eta * exp(activation * (1.0 / theta - 1.0 / theta_ref))]
}

specimen! {
    /// Burgers' element: a Maxwell and a Kelvin–Voigt element in series.
    Burgers {
        stiffness: 30.0, kelvin: 12.0, length: 1.0, capacity: 1.0, theta_ref: 300.0, eta_kelvin: 4.0,
        eta_maxwell: 40.0, exponent: 3.0,
    }
    (
        lambda: Stretch = 1.3 in [0.5, 2.0],
        creep: Viscous = 0.1 in [-0.5, 0.5],
        flow: Viscous = 0.05 in [-0.5, 0.5],
        theta: Temperature = 310.0 in [250.0, 400.0],
    )
    {
        let elastic = lambda - length - creep - flow;
        0.5 * stiffness * theta / theta_ref * elastic.powi(2) + 0.5 * kelvin * creep.powi(2)
            + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
    }
    [creep = eta_kelvin * (theta_ref / theta).powi(2)]
    [flow = eta_maxwell * (theta_ref / theta).powf(exponent)]
}

specimen! {
    /// Two Maxwell branches with stiffnesses that fall with the temperature.
    TwoBranches {
        k: 20.0, k_fast: 5.0, k_slow: 7.0, fall: 0.002, beta: 0.05, capacity: 2.0,
        theta_ref: 290.0, eta_fast: 4.0, eta_slow: 60.0, activation: 900.0,
    }
    (
        lambda: Stretch = 1.4 in [0.5, 2.0],
        fast: Viscous = 0.3 in [-1.0, 1.0],
        slow: Viscous = -0.1 in [-1.0, 1.0],
        theta: Temperature = 320.0 in [250.0, 400.0],
    )
    {
        let softening = exp(-fall * (theta - theta_ref));
        let strain = ln(lambda);
        let branches = k_fast * (strain - fast).powi(2) + k_slow * (strain - slow).powi(2);
        0.5 * softening * (k * strain.powi(2) + branches) - beta * (theta - theta_ref) * strain
            + capacity * (theta - theta * ln(theta / theta_ref))
    }
    [fast = eta_fast * exp(activation / theta - activation / theta_ref)]
    [slow = eta_slow * (theta_ref / theta).powf(1.5)]
}

specimen! {
    /// A Prony series of three branches whose times shift together, Williams, Landel & Ferry 1955.
    ThreeBranches {
        k: 10.0, k1: 6.0, k2: 4.0, k3: 2.0, length: 1.0, capacity: 1.5, theta_ref: 320.0,
        eta1: 0.5, eta2: 5.0, eta3: 50.0, c1: 8.86, c2: 101.6,
    }
    (
        lambda: Stretch = 1.3 in [0.5, 2.0],
        a: Viscous = 0.1 in [-0.5, 0.5],
        b: Viscous = 0.05 in [-0.5, 0.5],
        c: Viscous = -0.02 in [-0.5, 0.5],
        theta: Temperature = 330.0 in [280.0, 400.0],
    )
    {
        let u = lambda - length;
        0.5 * (k * u.powi(2) + k1 * (u - a).powi(2) + k2 * (u - b).powi(2) + k3 * (u - c).powi(2))
            * (theta / theta_ref)
            + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
    }
    [a = eta1 * exp(-c1 * (theta - theta_ref) / (c2 + theta - theta_ref))]
    [b = eta2 * exp(-c1 * (theta - theta_ref) / (c2 + theta - theta_ref))]
    [c = eta3 * exp(-c1 * (theta - theta_ref) / (c2 + theta - theta_ref))]
}

specimen! {
    /// Finite viscoelasticity: the branch measures ln(λ/(L + γ)), the elastic part of the strain.
    Logarithmic {
        k: 30.0, branch: 20.0, length: 1.0, capacity: 1.0, theta_ref: 300.0, eta: 5.0,
        lower: 0.2,
    }
    (
        lambda: Stretch = 1.3 in [0.5, 2.0],
        gamma: Viscous = 0.1 in [-0.4, 0.8],
        theta: Temperature = 310.0 in [250.0, 400.0],
    )
    {
        0.5 * k * ln(lambda / length).powi(2)
            + 0.5 * branch * ln(lambda / (length + gamma)).powi(2)
            + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
    }
    [gamma = eta * (1.0 - (1.0 - lower) * tanh((theta - 250.0) / theta_ref))]
}

specimen! {
    /// Two networks of rubber, one of which slips, after Bergström & Boyce 1998.
    ViscousRubber {
        equilibrium: 2.0, network: 3.0, length: 0.5, capacity: 0.6, theta_ref: 295.0, eta: 2.0,
        activation: 600.0,
    }
    (
        lambda: Stretch = 0.8 in [0.2, 1.5],
        gamma: Viscous = 0.05 in [-0.2, 0.6],
        theta: Temperature = 305.0 in [250.0, 400.0],
    )
    {
        let s = lambda / length;
        let t = lambda / (length + gamma);
        0.5 * theta / theta_ref
            * (equilibrium * (s.powi(2) + 2.0 / s - 3.0) + network * (t.powi(2) + 2.0 / t - 3.0))
            + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
    }
    [gamma = eta * exp(activation / theta) / exp(activation / theta_ref)]
}

specimen! {
    /// An air spring with an auxiliary volume behind an orifice; the viscosity is Sutherland's.
    AirSpring {
        n_r: 8.314, aux: 4.0, area: 0.1, pressure: 100_000.0, height: 0.25, restoring: 400.0,
        capacity: 31.0, theta_ref: 300.0, eta: 900.0, sutherland: 111.0,
    }
    (
        lambda: Stretch = 0.25 in [0.12, 0.5],
        gamma: Viscous = 0.01 in [-0.08, 0.08],
        theta: Temperature = 310.0 in [250.0, 500.0],
    )
    {
        -n_r * theta * ln((lambda - gamma) / height) - aux * theta * ln(1.0 + gamma / height)
            + pressure * area * lambda + restoring * (cosh(gamma / height) - 1.0)
            + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
    }
    [gamma = eta * (theta / theta_ref).powf(1.5) * (theta_ref + sutherland) / (theta + sutherland)]
}

//! The free energies of the suite; `wide.rs` has those of the random campaign.

pub(crate) mod wide;

use super::model::model;

model! {
    /// Hooke's law.
    Hooke { stiffness, length } (lambda: Stretch) {
        0.5 * stiffness * (lambda - length).powi(2)
    }
}

model! {
    /// Hencky's logarithmic strain.
    Hencky { stiffness, length } (lambda: Stretch) {
        0.5 * stiffness * ln(lambda / length).powi(2)
    }
}

pub(crate) const fn hooke(stiffness: f64, length: f64) -> Hooke {
    Hooke { stiffness, length }
}

pub(crate) const fn hencky(stiffness: f64, length: f64) -> Hencky {
    Hencky { stiffness, length }
}

model! {
    /// Newton's potential: Kepler's problem.
    Gravitation { strength } (lambda: Stretch) { -(strength / lambda) }
}

model! {
    /// The bond of Fermi, Pasta, Ulam and Tsingou with a cubic term.
    Cubic { alpha, length } (lambda: Stretch) {
        let extension = lambda - length;
        0.5 * extension.powi(2) + alpha / 3.0 * extension.powi(3)
    }
}

model! {
    /// Morse (1929): the force has its peak at `λ = l + ln 2/a` and falls beyond.
    Morse { depth, steepness, length } (lambda: Stretch) {
        depth * (1.0 - exp(-(steepness * (lambda - length)))).powi(2)
    }
}

model! {
    /// A spring beside a Maxwell branch, without temperature.
    Maxwell { stiffness, branch, length, eta } (lambda: Stretch, gamma: Viscous) {
        let extension = lambda - length;
        0.5 * stiffness * extension.powi(2) + 0.5 * branch * (extension - gamma).powi(2)
    }
    [gamma = eta]
}

model! {
    /// The hot spring of the finding: gas, oscillator (Einstein 1907) and lattice.
    Hot { gas, bonds, frequency, capacity } (lambda: Stretch, theta: Temperature) {
        gas * theta / lambda + bonds * theta * ln(-exp_m1(-(frequency / theta)))
            + capacity * (theta - theta * ln(theta))
    }
}

model! {
    /// Thermoelastic, linear in the extension.
    Thermoelastic { stiffness, length, coupling, capacity, theta_ref }
    (lambda: Stretch, theta: Temperature) {
        let extension = lambda - length;
        let heating = theta - theta_ref;
        0.5 * stiffness * extension.powi(2) - coupling * heating * extension
            + capacity * (heating - theta * ln(theta / theta_ref))
    }
}

model! {
    /// Thermoelastic with logarithmic strain, and a stiffness logarithmic in the temperature: Conde
    /// Martín, Betsch & García Orden (2016), eq. (43).
    LogarithmicStiffness { stiffness, softening, coupling, capacity, length, theta_ref }
    (lambda: Stretch, theta: Temperature) {
        let strain = ln(lambda / length);
        let modulus = stiffness - softening * theta_ref * ln(theta / theta_ref);
        0.5 * modulus * strain.powi(2) - coupling * (theta - theta_ref) * strain
            + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
    }
}

model! {
    /// Thermo-visco-elastic element of García Orden & Romero (2012), §4.1.
    ThermoViscoElastic {
        k0, k1, ratio, coupling, capacity, mu0, mu1, eta0, a, length, theta_ref
    }
    (lambda: Stretch, gamma: Viscous, theta: Temperature) {
        let strain = ln(lambda / length);
        let heating = theta - theta_ref;
        let elastic = 0.5 * (k0 - k1 * heating) * strain.powi(2)
            - coupling * heating * strain
            + capacity * (heating - theta * ln(theta / theta_ref));
        (1.0 + ratio) * elastic + (mu0 - mu1 * heating) * gamma.powi(2)
            - ratio * gamma * diff(elastic, lambda)
    }
    or {
        let strain = ln(lambda / length);
        let heating = theta - theta_ref;
        let elastic = 0.5 * (k0 - k1 * heating) * strain.powi(2)
            - coupling * heating * strain
            + capacity * (heating - theta * ln(theta / theta_ref));
        let force = ((k0 - k1 * heating) * strain - coupling * heating) / lambda;
        (1.0 + ratio) * elastic + (mu0 - mu1 * heating) * gamma.powi(2) - ratio * gamma * force
    }
    [gamma = eta0 * exp(a * (1.0 / theta - 1.0 / theta_ref))]
}

model! {
    /// Two Maxwell branches beside a spring, in logarithmic strain; viscosities thin with heat.
    TwoDashpots {
        stiffness, first, second, coupling, capacity, length, theta_ref, eta1, eta2, a, n
    }
    (lambda: Stretch, gamma1: Viscous, gamma2: Viscous, theta: Temperature) {
        let strain = ln(lambda / length);
        let heating = theta - theta_ref;
        let branches = first * (strain - gamma1).powi(2) + second * (strain - gamma2).powi(2);
        0.5 * (stiffness * strain.powi(2) + branches) - coupling * heating * strain
            + capacity * (heating - theta * ln(theta / theta_ref))
    }
    [gamma1 = eta1 * exp(a * (1.0 / theta - 1.0 / theta_ref))]
    [gamma2 = eta2 * exp(n * ln(theta_ref / theta))]
}

model! {
    /// The same with extensions in the place of strains, and constant viscosities.
    TwoLinearDashpots { stiffness, first, second, coupling, capacity, length, theta_ref, eta1, eta2 }
    (lambda: Stretch, gamma1: Viscous, gamma2: Viscous, theta: Temperature) {
        let extension = lambda - length;
        let heating = theta - theta_ref;
        let branches = first * (extension - gamma1).powi(2) + second * (extension - gamma2).powi(2);
        0.5 * (stiffness * extension.powi(2) + branches) - coupling * heating * extension
            + capacity * (heating - theta * ln(theta / theta_ref))
    }
    [gamma1 = eta1]
    [gamma2 = eta2]
}

model! {
    /// Capacity `c = a θ³` of a lattice at low temperature (Debye 1912), which vanishes at θ → 0.
    Lattice { stiffness, length, coupling, a } (lambda: Stretch, theta: Temperature) {
        let extension = lambda - length;
        0.5 * stiffness * extension.powi(2) - coupling * theta * extension
            - a / 12.0 * theta.powi(4)
    }
}

model! {
    /// A bar with a phase transformation of first order (Landau's expansion to the sixth power, Falk
    /// 1980): the austenite `e = 0` is stable when hot, the martensites `e = ±…` when cold.
    Landau { a, b, d, theta_0, capacity, length } (lambda: Stretch, theta: Temperature) {
        let strain = lambda / length - 1.0;
        0.5 * a * (theta - theta_0) * strain.powi(2) - 0.25 * b * strain.powi(4)
            + d / 6.0 * strain.powi(6)
            + capacity * (theta - theta_0 - theta * ln(theta / theta_0))
    }
}

model! {
    /// A piston on a gas of van der Waals: volume λ times unit area, covolume b, cohesion a.
    VanDerWaals { gas, covolume, cohesion, capacity, theta_ref } (lambda: Stretch, theta: Temperature) {
        -(gas * theta * ln((lambda - covolume) / covolume)) - cohesion / lambda
            + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
    }
}

impl ThermoViscoElastic {
    /// The published data.
    pub(crate) const PENDULUM: Self = Self {
        k0: 100.0,
        k1: 0.5,
        ratio: 0.1,
        coupling: 4.0,
        capacity: 1.0,
        mu0: 5.0,
        mu1: 0.1,
        eta0: 100.0,
        a: 10.0,
        length: 1.0,
        theta_ref: 300.0,
    };
}

impl Hot {
    /// The data of the finding.
    pub(crate) const FOUND: Self = Self {
        gas: 0.549,
        bonds: 1.15,
        frequency: 236.0,
        capacity: 0.106,
    };
}

impl TwoDashpots {
    /// The data of the finding, with one viscosity for both branches.
    pub(crate) const fn of_viscosity(eta: f64) -> Self {
        Self {
            stiffness: 100.0,
            first: 50.0,
            second: 80.0,
            coupling: 0.1,
            capacity: 5.0,
            length: 1.0,
            theta_ref: 300.0,
            eta1: eta,
            eta2: eta,
            a: 1000.0,
            n: 1.5,
        }
    }
}

impl TwoLinearDashpots {
    /// As above.
    pub(crate) const fn of_viscosity(eta: f64) -> Self {
        Self {
            stiffness: 100.0,
            first: 50.0,
            second: 80.0,
            coupling: 0.1,
            capacity: 5.0,
            length: 1.0,
            theta_ref: 300.0,
            eta1: eta,
            eta2: eta,
        }
    }
}

impl Thermoelastic {
    /// An ordinary spring.
    pub(crate) const ORDINARY: Self = Self {
        stiffness: 100.0,
        length: 1.0,
        coupling: 0.1,
        capacity: 5.0,
        theta_ref: 300.0,
    };
}

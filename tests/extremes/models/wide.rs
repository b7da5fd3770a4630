//! Free energies of the random campaign: singular forces, steep functions, capacities and viscosities of many scales.

use super::super::model::model;

model! {
    /// Strain and heat by logarithms to the base of ten.
    Decimal { stiffness, coupling, capacity, length, theta_ref } (lambda: Stretch, theta: Temperature) {
        let strain = log10(lambda / length);
        let heating = theta - theta_ref;
        0.5 * stiffness * strain.powi(2) - coupling * heating * strain
            + capacity * (heating - theta * log10(theta / theta_ref))
    }
}

model! {
    /// A spring that stiffens exponentially: `f = k/a sinh(a e)`.
    Stiffening { stiffness, steepness, length } (lambda: Stretch) {
        2.0 * stiffness / steepness.powi(2) * sinh(0.5 * steepness * (lambda - length)).powi(2)
    }
}

model! {
    /// Gent (1996): a spring whose extension has a limit.
    Gent { stiffness, limit, length } (lambda: Stretch) {
        -(0.5 * stiffness * limit.powi(2) * ln(1.0 - ((lambda - length) / limit).powi(2)))
    }
}

model! {
    /// Finitely extensible nonlinear elastic dumbbell (Warner 1972).
    Fene { stiffness, limit } (lambda: Stretch) {
        -(0.5 * stiffness * limit.powi(2) * ln(1.0 - (lambda / limit).powi(2)))
    }
}

model! {
    /// Lennard-Jones (1931).
    LennardJones { depth, size } (lambda: Stretch) {
        4.0 * depth * ((size / lambda).powi(12) - (size / lambda).powi(6))
    }
}

model! {
    /// Attraction and repulsion by powers (Mie 1903), here with a minimum for any positive exponents.
    Powers { attraction, repulsion, m, n, length } (lambda: Stretch) {
        attraction * (lambda / length).powf(m) + repulsion * (length / lambda).powf(n)
    }
}

model! {
    /// Capacity `4 c (θ/Θ)³` when cold and c when hot, as that of a crystal (Debye 1912), in closed form.
    Debye { stiffness, coupling, capacity, length, scale } (lambda: Stretch, theta: Temperature) {
        let extension = lambda - length;
        0.5 * stiffness * extension.powi(2) - coupling * theta * extension
            - capacity / 3.0 * theta * ln_1p((theta / scale).powi(3))
    }
}

model! {
    /// Levels at two scales of energy (Schottky 1922) beside a constant capacity.
    Schottky { stiffness, coupling, low, low_capacity, high, high_capacity, capacity, length }
    (lambda: Stretch, theta: Temperature) {
        let extension = lambda - length;
        0.5 * stiffness * extension.powi(2) - coupling * theta * extension
            - low_capacity * theta * ln_1p(exp(-(low / theta)))
            - high_capacity * theta * ln_1p(exp(-(high / theta)))
            + capacity * (theta - theta * ln(theta))
    }
}

model! {
    /// A stiffness that falls within a few kelvins.
    Transition { stiffness, drop, centre, width, capacity, length } (lambda: Stretch, theta: Temperature) {
        0.5 * (stiffness - drop * tanh((theta - centre) / width)) * (lambda - length).powi(2)
            + capacity * (theta - centre - theta * ln(theta / centre))
    }
}

model! {
    /// A Maxwell branch with the viscosity of Arrhenius.
    Arrhenius { stiffness, branch, coupling, capacity, length, theta_ref, eta, a }
    (lambda: Stretch, gamma: Viscous, theta: Temperature) {
        let extension = lambda - length;
        let heating = theta - theta_ref;
        0.5 * stiffness * extension.powi(2) + 0.5 * branch * (extension - gamma).powi(2)
            - coupling * heating * extension
            + capacity * (heating - theta * ln(theta / theta_ref))
    }
    [gamma = eta * exp(a * (1.0 / theta - 1.0 / theta_ref))]
}

model! {
    /// A spring with a dashpot in parallel (Voigt 1892).
    Voigt { stiffness, length, eta } (lambda: Stretch) {
        0.5 * stiffness * (lambda - length).powi(2)
    }
    [lambda = eta]
}

model! {
    /// The same with a temperature, whose rise thins the dashpot.
    WarmVoigt { stiffness, coupling, capacity, length, theta_ref, eta, a }
    (lambda: Stretch, theta: Temperature) {
        let extension = lambda - length;
        let heating = theta - theta_ref;
        0.5 * stiffness * extension.powi(2) - coupling * heating * extension
            + capacity * (heating - theta * ln(theta / theta_ref))
    }
    [lambda = eta * exp(a * (1.0 / theta - 1.0 / theta_ref))]
}

model! {
    /// A Maxwell branch alone, which relaxes to nothing.
    Branch { stiffness, length, eta } (lambda: Stretch, gamma: Viscous) {
        0.5 * stiffness * (lambda - length - gamma).powi(2)
    }
    [gamma = eta]
}

model! {
    /// A polymer at its glass transition: viscosity by Williams, Landel & Ferry (1955), which has no value at
    /// `θ = centre − c2`.
    Glass { stiffness, branch, coupling, capacity, length, centre, eta, c1, c2 }
    (lambda: Stretch, gamma: Viscous, theta: Temperature) {
        let extension = lambda - length;
        let heating = theta - centre;
        0.5 * stiffness * extension.powi(2) + 0.5 * branch * (extension - gamma).powi(2)
            - coupling * heating * extension
            + capacity * (heating - theta * ln(theta / centre))
    }
    [gamma = eta * exp(-(c1 * (theta - centre) / (c2 + theta - centre)))]
}

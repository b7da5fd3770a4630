//! Springs: powers and logarithms of the stretch.

use crate::zoo::number::{cos, exp, exp_m1, ln};
use crate::zoo::specimen::specimen;

specimen! {
    /// Hooke's law.
    Linear { stiffness: 50.0, length: 1.0 }
    (lambda: Stretch = 1.2 in [0.5, 2.0])
    {
        0.5 * stiffness * (lambda - length).powi(2)
    }
}

specimen! {
    /// Hencky's logarithmic strain.
    Hencky { stiffness: 100.0, length: 2.0 }
    (lambda: Stretch = 2.6 in [0.5, 6.0])
    {
        0.5 * stiffness * ln(lambda / length).powi(2)
    }
}

specimen! {
    /// A hardening spring, Duffing 1918.
    Duffing { stiffness: 20.0, hardening: 400.0, length: 0.7 }
    (lambda: Stretch = 0.9 in [0.3, 1.5])
    {
        let u = lambda - length;
        0.5 * stiffness * u.powi(2) + 0.25 * hardening * u.powi(4)
    }
}

specimen! {
    /// A bar of Saint Venant–Kirchhoff material: quadratic in the Green–Lagrange strain.
    GreenLagrange { stiffness: 2000.0, length: 0.5 }
    (lambda: Stretch = 0.55 in [0.35, 0.8])
    {
        let strain = 0.5 * ((lambda / length).powi(2) - 1.0);
        0.5 * stiffness * length * strain.powi(2)
    }
}

specimen! {
    /// The bond of the α+β chain, Fermi, Pasta, Ulam & Tsingou 1955.
    FermiPastaUlam { alpha: 0.25, beta: 0.5, length: 1.0 }
    (lambda: Stretch = 1.4 in [0.2, 2.2])
    {
        let u = lambda - length;
        u.powi(2) / 2.0 + alpha * u.powi(3) / 3.0 + beta * u.powi(4) / 4.0
    }
}

specimen! {
    /// The exponential bond of Toda 1967.
    Toda { a: 2.0, b: 3.0, length: 1.0 }
    (lambda: Stretch = 1.2 in [0.4, 2.0])
    {
        let u = lambda - length;
        a / b * exp_m1(-b * u) + a * u
    }
}

specimen! {
    /// A spring over a corrugated track, Frenkel & Kontorova 1938; `wave` is its wave number.
    Corrugated { stiffness: 30.0, height: 0.4, wave: 12.0, length: 1.0 }
    (lambda: Stretch = 1.3 in [0.5, 2.0])
    {
        let u = lambda - length;
        0.5 * stiffness * u.powi(2) + height * (1.0 - cos(wave * u))
    }
}

specimen! {
    /// Two inclined springs that are nearly unstretched: the force grows with the third power of
    /// the deflection. `w` is half the span.
    Inclined { stiffness: 400.0, w: 0.5, rest: 0.48, length: 1.0 }
    (lambda: Stretch = 1.2 in [0.5, 1.6])
    {
        let u = lambda - length;
        stiffness * ((u.powi(2) + w.powi(2)).sqrt() - rest).powi(2) + 0.02 * stiffness * lambda.recip()
    }
}

specimen! {
    /// A square centimetre of steel, a metre long, with the stretch of a spring wire.
    Steel { stiffness: 21_000_000.0, length: 1.0 }
    (lambda: Stretch = 1.001 in [0.998, 1.002])
    {
        0.5 * stiffness * length * ln(lambda / length).powi(2)
    }
}

specimen! {
    /// A linear thermoelastic bar: thermal expansion and a constant heat capacity.
    Thermoelastic {
        stiffness: 800.0, expansion: 0.002, length: 1.0, capacity: 15.0, theta_ref: 293.0,
    }
    (lambda: Stretch = 1.1 in [0.7, 1.5], theta: Temperature = 310.0 in [250.0, 400.0])
    {
        let u = lambda - length;
        let heating = theta - theta_ref;
        0.5 * stiffness * u.powi(2) - stiffness * expansion * heating * u
            + capacity * (heating - theta * ln(theta / theta_ref))
    }
}

specimen! {
    /// A stiffness that falls exponentially with the temperature.
    Softening { stiffness: 100.0, fall: 0.002, length: 1.0, capacity: 2.0, theta_ref: 290.0 }
    (lambda: Stretch = 1.4 in [0.5, 2.0], theta: Temperature = 320.0 in [250.0, 400.0])
    {
        let heating = theta - theta_ref;
        0.5 * stiffness * exp(-fall * heating) * (lambda - length).powi(2)
            + capacity * (heating - theta * ln(theta / theta_ref))
    }
}

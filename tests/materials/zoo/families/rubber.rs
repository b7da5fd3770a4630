//! Bars of incompressible rubber, uniaxial: `I₁ = s² + 2/s`, `I₂ = 2 s + 1/s²` with s = λ/L.

use crate::zoo::number::{exp, ln};
use crate::zoo::specimen::specimen;

specimen! {
    /// One modulus, Treloar 1943.
    NeoHookean { modulus: 3.0, length: 0.5 }
    (lambda: Stretch = 0.8 in [0.2, 2.0])
    {
        let s = lambda / length;
        0.5 * modulus * (s.powi(2) + 2.0 / s - 3.0)
    }
}

specimen! {
    /// Two moduli, Mooney 1940, Rivlin 1948.
    MooneyRivlin { c10: 1.8, c01: 0.6, length: 0.5 }
    (lambda: Stretch = 0.7 in [0.2, 2.0])
    {
        let s = lambda / length;
        c10 * (s.powi(2) + 2.0 / s - 3.0) + c01 * (2.0 * s + s.powi(-2) - 3.0)
    }
}

specimen! {
    /// Three powers, Ogden 1972, with his moduli for Treloar's vulcanised rubber in `MPa`.
    Ogden {
        mu1: 0.63, mu2: 0.0012, mu3: -0.01, alpha1: 1.3, alpha2: 5.0, alpha3: -2.0, length: 1.0,
    }
    (lambda: Stretch = 1.8 in [0.3, 5.0])
    {
        let s = lambda / length;
        mu1 / alpha1 * (s.powf(alpha1) + 2.0 * s.powf(-0.5 * alpha1) - 3.0)
            + mu2 / alpha2 * (s.powf(alpha2) + 2.0 * s.powf(-0.5 * alpha2) - 3.0)
            + mu3 / alpha3 * (s.powf(alpha3) + 2.0 * s.powf(-0.5 * alpha3) - 3.0)
    }
}

specimen! {
    /// Limited extensibility, Gent 1996.
    Gent { modulus: 2.0, limit: 20.0, length: 0.5 }
    (lambda: Stretch = 1.0 in [0.2, 2.0])
    {
        let s = lambda / length;
        -0.5 * modulus * limit * ln(1.0 - (s.powi(2) + 2.0 / s - 3.0) / limit)
    }
}

specimen! {
    /// A cubic in I₁ − 3, Yeoh 1990.
    Yeoh { c1: 1.2, c2: -0.03, c3: 0.002, length: 1.0 }
    (lambda: Stretch = 1.5 in [0.4, 3.0])
    {
        let s = lambda / length;
        let i = s.powi(2) + 2.0 / s - 3.0;
        c1 * i + c2 * i.powi(2) + c3 * i.powi(3)
    }
}

specimen! {
    /// Eight chains, the series of Arruda & Boyce 1993 to five terms; `n` is the number of links.
    ArrudaBoyce { modulus: 1.5, n: 26.5, length: 1.0 }
    (lambda: Stretch = 2.0 in [0.4, 4.0])
    {
        let s = lambda / length;
        let i = s.powi(2) + 2.0 / s;
        modulus * (0.5 * (i - 3.0) + (i.powi(2) - 9.0) / (20.0 * n)
            + 11.0 * (i.powi(3) - 27.0) / (1050.0 * n.powi(2))
            + 19.0 * (i.powi(4) - 81.0) / (7000.0 * n.powi(3))
            + 519.0 * (i.powi(5) - 243.0) / (673_750.0 * n.powi(4)))
    }
}

specimen! {
    /// A Gaussian network: the modulus is proportional to θ, the force is entropy alone.
    Entropic { modulus: 3.0, length: 0.5, capacity: 0.8, theta_ref: 295.0 }
    (lambda: Stretch = 0.9 in [0.2, 2.0], theta: Temperature = 315.0 in [250.0, 400.0])
    {
        let s = lambda / length;
        0.5 * modulus * theta / theta_ref * (s.powi(2) + 2.0 / s - 3.0)
            + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
    }
}

specimen! {
    /// Modified entropic elasticity, Chadwick 1974, of a Gent network that expands with heat.
    EntropicGent {
        modulus: 2.0, limit: 25.0, expansion: 0.01, length: 0.5, capacity: 0.8, theta_ref: 295.0,
    }
    (lambda: Stretch = 1.0 in [0.2, 2.0], theta: Temperature = 315.0 in [250.0, 400.0])
    {
        let s = lambda / length;
        let heating = theta - theta_ref;
        -0.5 * modulus * limit * theta / theta_ref * ln(1.0 - (s.powi(2) + 2.0 / s - 3.0) / limit)
            - expansion * heating * ln(s) + capacity * (heating - theta * ln(theta / theta_ref))
    }
}

specimen! {
    /// A freely jointed chain, inverse Langevin function of Cohen 1991; its heat capacity grows
    /// with the temperature to a plateau.
    FreelyJointed { boltzmann: 0.05, links: 40.0, contour: 8.0, capacity: 3.0, theta_ref: 300.0, width: 60.0 }
    (lambda: Stretch = 4.0 in [0.5, 7.0], theta: Temperature = 290.0 in [200.0, 400.0])
    {
        let x = lambda / contour;
        boltzmann * links * theta / theta_ref * (0.5 * x.powi(2) - ln(1.0 - x.powi(2)))
            - capacity * theta * ln(theta / theta_ref)
            - 0.01 * capacity * width * exp((theta - theta_ref) / width)
    }
}

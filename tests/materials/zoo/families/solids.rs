//! Solids: free energies per volume of `e1 = tr E`, `e2 = E:E` and `j = J − 1`.

use crate::zoo::number::{exp, exp_m1, ln, ln_1p};
use crate::zoo::specimen::specimen;

specimen! {
    /// Saint-Venant–Kirchhoff.
    SaintVenantKirchhoff { la: 2000.0, mu: 1000.0 }
    (e1: StrainTrace = 0.12 in [-0.1, 0.4], e2: StrainSquare = 0.05 in [0.0, 0.3])
    {
        0.5 * la * e1.powi(2) + mu * e2
    }
}

specimen! {
    /// Mooney–Rivlin, compressible: `tr C − 3 = 2 e1`, `tr cof C − 3 = 4 e1 + 2 (e1² − e2)`.
    CompressibleMooneyRivlin {
        a: 249.375, b: 249.375, c1: 4211.5, d1: 1496.25, c2: 5209.0, d2: 665.0, beta: 2.233e-4,
        capacity: 100.0, theta_ref: 293.15,
    }
    (
        e1: StrainTrace = 0.12 in [-0.1, 0.4], e2: StrainSquare = 0.05 in [0.0, 0.3],
        j: Dilatation = 0.1 in [-0.2, 0.3], theta: Temperature = 305.0 in [250.0, 350.0],
    )
    {
        let isochoric = 2.0 * a * e1 + b * (4.0 * e1 + 2.0 * (e1.powi(2) - e2));
        let volumetric = 0.5 * c1 * j.powi(2) - d1 * ln_1p(j);
        isochoric + volumetric - 3.0 * beta * (theta - theta_ref) * (c2 * j - d2 / (1.0 + j))
            + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
    }
}

specimen! {
    /// Without temperature, every strain in a product with the change of volume.
    Compressible { a: 250.0, b: 150.0, c: 4000.0, d: 1100.0 }
    (
        e1: StrainTrace = 0.12 in [-0.1, 0.4], e2: StrainSquare = 0.05 in [0.0, 0.3],
        j: Dilatation = 0.1 in [-0.2, 0.3],
    )
    {
        2.0 * a * e1 + b * (4.0 * e1 + 2.0 * (e1.powi(2) - e2)) * (1.0 + j).powf(-4.0 / 3.0)
            + 0.5 * c * j.powi(2) - d * ln_1p(j)
    }
}

specimen! {
    /// A shear modulus that falls with the temperature; two measures.
    ThermoelasticSolid {
        mu: 1000.0, mu1: 2.0, la: 2000.0, b: 3.0, c: 100.0, tr: 300.0,
    }
    (
        e1: StrainTrace = 0.12 in [-0.1, 0.4], j: Dilatation = 0.1 in [-0.2, 0.3],
        theta: Temperature = 310.0 in [250.0, 350.0],
    )
    {
        (mu - mu1 * (theta - tr)) * (e1 - ln_1p(j)) + 0.5 * la * ln_1p(j).powi(2)
            - b * (theta - tr) * ln_1p(j)
            + c * (theta - tr - theta * ln(theta / tr))
    }
}

specimen! {
    /// The same with a third measure that no other can be separated from.
    Coupled {
        mu: 1000.0, mu1: 2.0, la: 2000.0, b: 3.0, g: 400.0, c: 100.0, tr: 300.0,
    }
    (
        e1: StrainTrace = 0.12 in [-0.1, 0.4], e2: StrainSquare = 0.05 in [0.0, 0.3],
        j: Dilatation = 0.1 in [-0.2, 0.3], theta: Temperature = 310.0 in [250.0, 350.0],
    )
    {
        (mu - mu1 * (theta - tr)) * (e1 - ln_1p(j)) + 0.5 * la * ln_1p(j).powi(2)
            - b * (theta - tr) * ln_1p(j)
            + g * e2 * (1.0 + e1) * (theta / tr) / (1.0 + j)
            + c * (theta - tr - theta * ln(theta / tr))
    }
}

specimen! {
    /// A volumetric dashpot and one for `E:E`, whose spring softens with the temperature.
    Viscoelastic {
        la: 2000.0, mu: 1000.0, kv: 1500.0, ks: 2500.0, ks1: 4.0, b: 3.0, c: 100.0, tr: 300.0,
        eta: 300.0, activation: 50.0,
    }
    (
        e1: StrainTrace = 0.12 in [-0.1, 0.4], e2: StrainSquare = 0.05 in [0.0, 0.3],
        g1: Viscous = 0.03 in [-0.1, 0.2], g2: Viscous = 0.02 in [-0.1, 0.2],
        theta: Temperature = 310.0 in [250.0, 350.0],
    )
    {
        0.5 * la * e1.powi(2) + mu * e2 + 0.5 * kv * (e1 - g1).powi(2)
            + 0.5 * (ks - ks1 * (theta - tr)) * (e2 - g2).powi(2)
            - b * (theta - tr) * e1
            + c * (theta - tr - theta * ln(theta / tr))
    }
    [g1 = eta * exp(activation / theta - activation / tr)]
    [g2 = 2.0 * eta * exp(activation / theta - activation / tr)]
}

specimen! {
    /// Two families of fibres.
    FibreReinforced {
        la: 2000.0, mu: 1000.0, kv: 1500.0, kf: 2500.0, ks: 800.0, b: 3.0, c: 100.0, tr: 300.0,
    }
    (
        e1: StrainTrace = 0.12 in [-0.1, 0.4], e2: StrainSquare = 0.05 in [0.0, 0.3],
        warp: FibreStrain = 0.1 in [-0.3, 0.5], weft: FibreStrain = 0.05 in [-0.3, 0.5],
        theta: Temperature = 310.0 in [250.0, 350.0],
    )
    {
        0.5 * la * e1.powi(2) + mu * e2 + 0.5 * kf * warp.powi(2)
            + ks * exp_m1(weft.powi(2)) + 0.5 * kv * ln_1p(2.0 * warp).powi(2)
            - b * (theta - tr) * (e1 + weft) + c * (theta - tr - theta * ln(theta / tr))
    }
}

specimen! {
    /// Shape and volume flow by a tensor, beside a dashpot; the branch softens with the temperature.
    Flowing {
        la: 2000.0, mu: 1000.0, kv: 1500.0, ks: 800.0, ks1: 2.0, kf: 500.0, b: 3.0, c: 100.0, tr: 300.0,
        eta: 300.0, activation: 50.0,
    }
    (
        e1: StrainTrace = 0.12 in [-0.1, 0.4], e2: StrainSquare = 0.05 in [0.0, 0.3],
        m3: ViscousStrain = 0.02 in [-0.1, 0.2], m2: ViscousSquare = 0.03 in [0.0, 0.2],
        m1: ViscousTrace = 0.04 in [-0.1, 0.2], g: Viscous = 0.03 in [-0.1, 0.2],
        theta: Temperature = 310.0 in [250.0, 350.0],
    )
    {
        0.5 * la * e1.powi(2) + mu * e2 + 0.5 * kv * (e1 - m1).powi(2)
            + (ks - ks1 * (theta - tr)) * (e2 - 2.0 * m3 + m2) * (1.0 + m2)
            + 0.5 * kf * (e1 - g).powi(2)
            - b * (theta - tr) * e1
            + c * (theta - tr - theta * ln(theta / tr))
    }
    [g = 2.0 * eta]
    [m3 = eta * exp(activation / theta - activation / tr)]
    [m1 = 3.0 * eta * exp(activation / theta - activation / tr)]
}

//! Every elementary function and every kind of power once.

use crate::zoo::number::{
    abs, asinh, atan, atanh, cbrt, cos, cosh, exp, exp_m1, ln, ln_1p, log2, log10, sin, sinh, tan,
    tanh,
};
use crate::zoo::specimen::specimen;

specimen! {
    /// Powers with constant exponents of all kinds, and one in which base and exponent vary.
    Powers { mu: 2.0, alpha: 1.3, nu: 0.4, capacity: 0.02, order: 2.2, theta_ref: 300.0 }
    (
        lambda: Stretch = 1.3 in [0.5, 2.5],
        gamma: Viscous = 0.3 in [0.1, 0.45],
        theta: Temperature = 310.0 in [200.0, 400.0],
    )
    {
        let ratio = theta / theta_ref;
        mu * (lambda.powf(alpha) + lambda.powf(-0.5) + lambda.powi(-3) + lambda.powf(2.5))
            + nu * lambda.powf(ratio) + nu * (lambda - gamma).powi(3) / theta.sqrt()
            - capacity * theta * ratio.powf(order) + nu * gamma.powi(6) * ratio.recip()
    }
    [gamma = mu * (theta / theta_ref).powf(-alpha)]
}

specimen! {
    /// Every elementary function; no material is like that.
    Every { a: 0.3, b: -0.7, stiffness: 60.0, capacity: 40.0 }
    (
        lambda: Stretch = 0.4 in [0.2, 0.7],
        gamma: Viscous = 0.25 in [0.05, 0.6],
        theta: Temperature = 1.7 in [1.0, 2.5],
    )
    {
        let hyperbolic = sinh(lambda) + cosh(gamma) + tanh(lambda * theta) + asinh(gamma / a);
        let circular = sin(lambda / a) + cos(gamma * theta) + tan(lambda * gamma) + atan(lambda);
        let logarithms = log2(lambda + theta) + log10(theta) + ln_1p(gamma * gamma) + atanh(gamma);
        abs(b) * (hyperbolic + circular + logarithms) + exp_m1(a * lambda) * cbrt(theta)
            + stiffness * (lambda - a).powi(2) - capacity * theta * ln(theta)
            + exp(gamma) / (1.0 + lambda * lambda).sqrt()
    }
    [gamma = abs(b) + tanh(theta)]
}

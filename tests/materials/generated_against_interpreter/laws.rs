//! The models: those of the published examples, and others that use what those leave out.

use eem::FreeEnergy;
use eem_symbolic::Model;

use crate::generated_against_interpreter::formula::{
    self, Role, abs, asinh, atan, atanh, cbrt, cos, diff, exp, exp_m1, ln, ln_1p, log2, log10, sin,
    sinh, tan, tanh,
};

/// A model, its data, and the same model as an expression graph.
pub(crate) trait Law: FreeEnergy<f64> {
    /// The model with the data of an example.
    fn example() -> Self;
    /// A state in the middle of what the model is for.
    fn state() -> Vec<f64>;
    /// What the macro should have understood.
    fn symbolic() -> Model;
}

/// Writes a formula once and has it read twice.
macro_rules! law {
    (
        $(#[$doc:meta])*
        $name:ident { $($field:ident: $value:expr),* $(,)? }
        ($($argument:ident: $role:ident = $at:expr),*) $body:block
        $([$dashpot:ident = $viscosity:expr])*
    ) => {
        $(#[$doc])*
        #[derive(FreeEnergy)]
        #[free_energy(|$($argument: $role),*| $body)]
        $(#[viscosity($dashpot = $viscosity)])*
        pub(crate) struct $name {
            $($field: f64,)*
        }

        impl Law for $name {
            fn example() -> Self {
                Self { $($field: $value),* }
            }

            fn state() -> Vec<f64> {
                vec![$($at),*]
            }

            fn symbolic() -> Model {
                formula::begin();
                $(let $argument = formula::variable(stringify!($argument));)*
                $(let $field = formula::variable(stringify!($field));)*
                let arguments = [$((Role::$role, $argument)),*];
                let parameters = [$($field),*];
                let psi = $body;
                let viscosities: &[formula::E] = &[$($viscosity),*];
                formula::model(&arguments, &parameters, psi, viscosities)
            }
        }
    };
}

law! {
    /// García Orden & Romero (2012), §4.1.
    Pendulum {
        length: 1.0, k0: 100.0, k1: 0.5, ratio: 0.1, beta: 4.0, capacity: 1.0, mu0: 5.0, mu1: 0.1,
        eta0: 100.0, activation: 10.0, theta_ref: 300.0,
    }
    (lambda: Stretch = 1.3, gamma: Viscous = 0.2, theta: Temperature = 345.0) {
        let strain = ln(lambda / length);
        let k = k0 - k1 * (theta - theta_ref);
        let mu = mu0 - mu1 * (theta - theta_ref);
        let psi_e = 0.5 * k * strain.powi(2) - beta * (theta - theta_ref) * strain
            + capacity * (theta - theta_ref - theta * ln(theta / theta_ref));
        (1.0 + ratio) * psi_e + mu * gamma.powi(2) - ratio * gamma * diff(psi_e, lambda)
    }
    [gamma = eta0 * exp(activation * (1.0 / theta - 1.0 / theta_ref))]
}

law! {
    /// Conde Martín, Betsch & García Orden (2016), eq. 43, the data of Romero.
    LinearStiffness { stiffness: 1.0, length: 2.0, beta: 0.2, capacity: 5.0, theta_ref: 300.0 }
    (lambda: Stretch = 2.4, theta: Temperature = 330.0) {
        let strain = ln(lambda / length);
        stiffness / 2.0 * strain.powi(2) - beta * (theta - theta_ref) * strain
            + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
    }
}

law! {
    /// The same with a stiffness logarithmic in θ, which rules out a closed inverse s ↦ θ.
    LogarithmicStiffness {
        c0: 5000.0, c1: 50.0, length: 2.0, beta: 20.0, capacity: 5000.0, theta_ref: 300.0,
    }
    (lambda: Stretch = 3.1, theta: Temperature = 380.0) {
        let strain = ln(lambda / length);
        let stiffness = c0 - c1 * theta_ref * ln(theta / theta_ref);
        0.5 * stiffness * strain.powi(2) - beta * (theta - theta_ref) * strain
            + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
    }
}

law! {
    /// An elastic bar of incompressible rubber: no temperature, no dashpot.
    NeoHookean { shear: 3.0, length: 0.5 }
    (lambda: Stretch = 0.8) {
        let stretch = lambda / length;
        0.5 * shear * (stretch.powi(2) + 2.0 / stretch - 3.0)
    }
}

law! {
    /// A spring and a dashpot in series, isothermal.
    Maxwell { stiffness: 8.0, quartic: 2.0, eta: 3.0 }
    (lambda: Stretch = 1.2, gamma: Viscous = 0.3) {
        stiffness * (lambda - gamma).powi(2) / 2.0 + quartic * (lambda - gamma).powi(4)
    }
    [gamma = eta]
}

law! {
    /// Two Maxwell branches with stiffnesses that fall with the temperature.
    TwoDashpots {
        k: 20.0, k_fast: 5.0, k_slow: 7.0, fall: 0.002, beta: 0.05, capacity: 2.0, theta_ref: 290.0,
        eta_fast: 4.0, eta_slow: 60.0, activation: 900.0,
    }
    (lambda: Stretch = 1.4, fast: Viscous = 0.3, slow: Viscous = -0.1, theta: Temperature = 320.0) {
        let softening = exp(-fall * (theta - theta_ref));
        let strain = ln(lambda);
        let branches = k_fast * (strain - fast).powi(2) + k_slow * (strain - slow).powi(2);
        0.5 * softening * (k * strain.powi(2) + branches) - beta * (theta - theta_ref) * strain
            + capacity * (theta - theta * ln(theta / theta_ref))
    }
    [fast = eta_fast * exp(activation / theta - activation / theta_ref)]
    [slow = eta_slow * (theta_ref / theta).powf(1.5)]
}

law! {
    /// Powers of all kinds: Ogden terms, a heat capacity that is a power of θ, both varying.
    Powers { mu: 2.0, alpha: 1.3, nu: 0.4, capacity: 0.02, order: 2.2, theta_ref: 300.0 }
    (lambda: Stretch = 1.3, gamma: Viscous = 0.6, theta: Temperature = 310.0) {
        let ratio = theta / theta_ref;
        mu * (lambda.powf(alpha) + lambda.powf(-0.5) + lambda.powi(-3) + lambda.powf(2.5))
            + nu * lambda.powf(ratio) + nu * (lambda - gamma).powi(3) / theta.sqrt()
            - capacity * theta * ratio.powf(order) + nu * gamma.powi(6) * ratio.recip()
    }
    [gamma = mu * (theta / theta_ref).powf(-alpha)]
}

law! {
    /// Every elementary function once.
    Functions { a: 0.3, b: -0.7, capacity: 40.0 }
    (lambda: Stretch = 0.4, gamma: Viscous = 0.25, theta: Temperature = 1.7) {
        let hyperbolic = sinh(lambda) + gamma.cosh() + tanh(lambda * theta) + asinh(gamma / a);
        let circular = sin(lambda / a) + cos(gamma * theta) + tan(lambda * gamma) + atan(lambda);
        let logarithms = log2(lambda + theta) + log10(theta) + ln_1p(gamma * gamma) + atanh(gamma);
        abs(b) * (hyperbolic + circular + logarithms) + exp_m1(a * lambda) * cbrt(theta)
            - capacity * theta * ln(theta) + exp(gamma) / (1.0 + lambda * lambda).sqrt()
    }
    [gamma = abs(b) + tanh(theta)]
}

//! A free energy that is written once and read twice: by the derive, and by the judge as a function of
//! numbers of 32 digits.

use eem::prelude::*;
use eem::{Array, Caloric};

use super::jet::Jet;

/// What [`model!`] writes besides the derive.
pub(crate) trait Model: FreeEnergy<f64> + Clone + Send + Sync + 'static {
    /// ψ of (λ, γ …, θ).
    fn psi(&self, x: &[Jet]) -> Jet;
}

/// Writes a free energy, its fields and its viscosities; literals follow the operators of the formula
/// language, in which `0.5 * x` and `x * 0.5` are both read. A formula with `diff` has a second one,
/// behind `or`, without.
macro_rules! model {
    (
        $(#[doc = $doc:literal])*
        $name:ident { $($field:ident),* $(,)? }
        ($($argument:ident: $role:ident),* $(,)?) $body:block $(or $plain:block)?
        $([$dashpot:ident = $viscosity:expr])*
    ) => {
        $(#[doc = $doc])*
        #[derive(Clone, Copy, Debug, eem::FreeEnergy)]
        #[free_energy(|$($argument: $role),*| $body)]
        $(#[viscosity($dashpot = $viscosity)])*
        pub(crate) struct $name {
            $(pub(crate) $field: f64,)*
        }

        impl $crate::extremes::model::Model for $name {
            #[allow(unused_variables, reason = "fields of the viscosities alone")]
            #[allow(unreachable_code, reason = "a formula without `diff` comes first")]
            fn psi(&self, x: &[$crate::extremes::jet::Jet]) -> $crate::extremes::jet::Jet {
                #[allow(unused_imports, reason = "not every formula needs every function")]
                use $crate::extremes::jet::{exp, exp_m1, ln, ln_1p, log10, sinh, tanh};
                let &[$($argument),*] = x else { panic!("one number per variable") };
                $(let $field = $crate::extremes::jet::Jet::from(self.$field);)*
                model!(@one $body $(or $plain)?)
            }
        }
    };
    (@one $body:block) => { $body };
    (@one $body:block or $plain:block) => { $plain };
}
pub(crate) use model;

/// A [`Model`] behind a table of functions, all on slices (λ, γ …, θ).
pub(crate) trait Body: Send + Sync {
    fn dashpots(&self) -> usize;
    fn thermal(&self) -> bool;
    fn psi(&self, x: &[Jet]) -> Jet;
    fn free_energy(&self, x: &[f64]) -> f64;
    /// `∂ψ/∂x`.
    fn gradient(&self, x: &[f64]) -> Vec<f64>;
    /// `∂²ψ/∂x²` by rows.
    fn hessian(&self, x: &[f64]) -> Vec<Vec<f64>>;
    fn caloric(&self, x: &[f64]) -> Caloric<f64>;
    fn viscosities(&self, theta: f64) -> Vec<f64>;
    /// Of the dashpot in parallel with the spring, if there is one.
    fn drag(&self, theta: f64) -> Option<f64>;
    /// `(f*, g*…, θ*, Δs)` in temperature form, and its derivative by the new state, by rows.
    fn response(&self, x0: &[f64], x1: &[f64]) -> (Vec<f64>, Vec<Vec<f64>>);
}

fn array<A: Array<f64>>(elements: &[f64]) -> A {
    let mut array = A::filled(0.0);
    array.as_mut().copy_from_slice(elements);
    array
}

fn rows<R: Array<f64>, M: Array<R>>(matrix: &M) -> Vec<Vec<f64>> {
    matrix
        .as_ref()
        .iter()
        .map(|row| row.as_ref().to_vec())
        .collect()
}

impl<M: Model> Body for M {
    fn dashpots(&self) -> usize {
        M::DASHPOTS
    }

    fn thermal(&self) -> bool {
        M::THERMAL
    }

    fn psi(&self, x: &[Jet]) -> Jet {
        Model::psi(self, x)
    }

    fn free_energy(&self, x: &[f64]) -> f64 {
        FreeEnergy::free_energy(self, &array(x))
    }

    fn gradient(&self, x: &[f64]) -> Vec<f64> {
        FreeEnergy::gradient(self, &array(x)).as_ref().to_vec()
    }

    fn hessian(&self, x: &[f64]) -> Vec<Vec<f64>> {
        rows(&FreeEnergy::hessian(self, &array(x)).1)
    }

    fn caloric(&self, x: &[f64]) -> Caloric<f64> {
        FreeEnergy::caloric(self, &array(x))
    }

    fn viscosities(&self, theta: f64) -> Vec<f64> {
        self.viscosity(theta).0.as_ref().to_vec()
    }

    fn drag(&self, theta: f64) -> Option<f64> {
        FreeEnergy::drag(self, theta).0.as_ref().first().copied()
    }

    fn response(&self, x0: &[f64], x1: &[f64]) -> (Vec<f64>, Vec<Vec<f64>>) {
        let old = self.temperature_form_old(&array(x0));
        let (response, tangent) = self.temperature_form(&old, &array(x1));
        (response.as_ref().to_vec(), rows(&tangent))
    }
}

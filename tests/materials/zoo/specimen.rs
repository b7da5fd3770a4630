//! A free energy of the zoo: one formula, read by the derive and by Rust, with data and a home.

use eem::prelude::*;
use eem::{Array, Caloric, Domain, DomainError, DomainReport, check_domain};
use eem_symbolic::{ExprId, Model};
use num_dual::HyperDual64;

use crate::zoo::expression::{self, Written};
use crate::zoo::number::{Num, Value};
use crate::zoo::precise::Precise;

/// What [`specimen!`] writes for a model.
pub(crate) trait Formula: FreeEnergy<f64> + Clone + Send + Sync + 'static {
    const NAME: &'static str;
    /// Stretch or strains, viscous variables, temperature.
    const VARIABLES: &'static [&'static str];
    const ROLES: &'static [&'static str];
    const FIELDS: &'static [&'static str];
    /// A state in the middle of what the model is for.
    const STATE: &'static [f64];
    /// What the model is for: an interval for every variable.
    const HOME: &'static [[f64; 2]];

    /// The model with realistic data.
    fn example() -> Self;
    /// The data in the order of [`FIELDS`](Self::FIELDS).
    fn data(&self) -> Vec<f64>;
    /// ψ as it is written.
    fn psi<V: Value>(x: &[Num<V>], fields: &[Num<V>]) -> Num<V>;
    /// ψ without `diff`.
    fn psi_of_numbers<V: Value>(x: &[Num<V>], fields: &[Num<V>]) -> Num<V>;
    /// `η_k`.
    fn viscosities<V: Value>(x: &[Num<V>], fields: &[Num<V>]) -> Vec<Num<V>>;
    /// The element of a spring.
    fn into_spring(self, scene: &mut Scene<2>, ends: [Node; 2]) -> Element;
}

/// A spring in a scene; a solid is none.
macro_rules! element {
    (Stretch $($rest:ident)*; $model:expr, $scene:expr, $ends:expr) => {
        $scene.spring($model, $ends)
    };
    ($($roles:ident)*; $model:expr, $scene:expr, $ends:expr) => {
        unreachable!("a solid between {:?} of {:?}", $ends, $scene)
    };
}
pub(crate) use element;

/// Writes a free energy once and has it read twice: by the derive as tokens, by Rust as a function
/// of any number. A formula with `diff` has a second one, behind `or`, without.
macro_rules! specimen {
    (
        $(#[doc = $doc:literal])*
        $name:ident { $($field:ident: $value:expr),* $(,)? }
        ($($argument:ident: $role:ident = $at:literal in [$low:literal, $high:literal]),* $(,)?)
        $body:block $(or $plain:block)?
        $([$dashpot:ident = $viscosity:expr])*
    ) => {
        $(#[doc = $doc])*
        #[derive(Clone, Debug, eem::FreeEnergy)]
        #[free_energy(|$($argument: $role),*| $body)]
        $(#[viscosity($dashpot = $viscosity)])*
        pub(crate) struct $name {
            $($field: f64,)*
        }

        #[allow(unused_variables, reason = "not every function uses all variables and fields")]
        impl $crate::zoo::specimen::Formula for $name {
            const NAME: &'static str = stringify!($name);
            const VARIABLES: &'static [&'static str] = &[$(stringify!($argument)),*];
            const ROLES: &'static [&'static str] = &[$(stringify!($role)),*];
            const FIELDS: &'static [&'static str] = &[$(stringify!($field)),*];
            const STATE: &'static [f64] = &[$($at),*];
            const HOME: &'static [[f64; 2]] = &[$([$low, $high]),*];

            fn example() -> Self {
                Self { $($field: $value),* }
            }

            fn data(&self) -> Vec<f64> {
                vec![$(self.$field),*]
            }

            fn psi<V: $crate::zoo::number::Value>(
                x: &[$crate::zoo::number::Num<V>],
                fields: &[$crate::zoo::number::Num<V>],
            ) -> $crate::zoo::number::Num<V> {
                let &[$($argument),*] = x else { panic!("one number per variable") };
                let &[$($field),*] = fields else { panic!("one number per field") };
                $body
            }

            fn psi_of_numbers<V: $crate::zoo::number::Value>(
                x: &[$crate::zoo::number::Num<V>],
                fields: &[$crate::zoo::number::Num<V>],
            ) -> $crate::zoo::number::Num<V> {
                let &[$($argument),*] = x else { panic!("one number per variable") };
                let &[$($field),*] = fields else { panic!("one number per field") };
                $(return $plain;)?
                #[allow(unreachable_code, reason = "there is a formula without `diff`")]
                Self::psi(x, fields)
            }

            fn viscosities<V: $crate::zoo::number::Value>(
                x: &[$crate::zoo::number::Num<V>],
                fields: &[$crate::zoo::number::Num<V>],
            ) -> Vec<$crate::zoo::number::Num<V>> {
                let &[$($argument),*] = x else { panic!("one number per variable") };
                let &[$($field),*] = fields else { panic!("one number per field") };
                vec![$($viscosity),*]
            }

            fn into_spring(
                self,
                scene: &mut eem::prelude::Scene<2>,
                ends: [eem::prelude::Node; 2],
            ) -> eem::prelude::Element {
                $crate::zoo::specimen::element!($($role)*; self, scene, ends)
            }
        }
    };
}
pub(crate) use specimen;

/// A [`Formula`] behind a table of functions, so that a test is written and compiled once.
pub(crate) trait Specimen {
    fn name(&self) -> &'static str;
    fn thermal(&self) -> bool;
    fn measures(&self) -> usize;
    fn dashpots(&self) -> usize;
    /// It is a function of strains.
    fn is_solid(&self) -> bool;
    fn state(&self) -> &'static [f64];
    fn home(&self) -> &'static [[f64; 2]];
    /// The numbers that programs take before the state.
    fn parameters(&self) -> Vec<f64>;

    /// What the macro should have understood.
    fn symbolic(&self) -> Model;
    fn psi_of_duals(&self, x: &[Num<HyperDual64>]) -> Num<HyperDual64>;
    fn viscosities_of_duals(&self, x: &[Num<HyperDual64>]) -> Vec<Num<HyperDual64>>;
    fn precise_psi(&self, x: &[Precise]) -> Precise;

    fn free_energy(&self, x: &[f64]) -> f64;
    fn energy_magnitude(&self, x: &[f64]) -> f64;
    fn internal_energy(&self, x: &[f64]) -> f64;
    /// Gradient, then Hessian by rows.
    fn hessian(&self, x: &[f64]) -> Vec<f64>;
    fn gradient(&self, x: &[f64]) -> Vec<f64>;
    fn caloric(&self, x: &[f64]) -> Caloric<f64>;
    /// All η, then all dη/dθ.
    fn viscosity(&self, theta: f64) -> Vec<f64>;
    /// Response, then tangent by rows.
    fn entropy_form(&self, x0: &[f64], x1: &[f64], corners: &[f64]) -> Vec<f64>;
    fn temperature_form(&self, x0: &[f64], x1: &[f64]) -> Vec<f64>;
    /// Responses without tangents.
    fn entropy_response(&self, x0: &[f64], x1: &[f64], corners: &[f64]) -> Vec<f64>;
    fn temperature_response(&self, x0: &[f64], x1: &[f64]) -> Vec<f64>;

    fn spring(&self, scene: &mut Scene<2>, ends: [Node; 2]) -> Element;
    fn check_domain(&self, domain: &Domain, samples: usize) -> Result<DomainReport, DomainError>;
}

/// The array with these elements.
fn array<A: Array<f64>>(elements: &[f64]) -> A {
    let mut array = A::filled(0.0);
    array.as_mut().copy_from_slice(elements);
    array
}

fn flat<R: Array<f64>, M: Array<R>>(first: &[f64], matrix: &M) -> Vec<f64> {
    let rows = matrix.as_ref().iter().flat_map(AsRef::as_ref);
    first.iter().chain(rows).copied().collect()
}

impl<F: Formula> Specimen for F {
    fn name(&self) -> &'static str {
        F::NAME
    }

    fn thermal(&self) -> bool {
        F::THERMAL
    }

    fn measures(&self) -> usize {
        F::MEASURES
    }

    fn dashpots(&self) -> usize {
        F::DASHPOTS
    }

    fn is_solid(&self) -> bool {
        F::PER_VOLUME
    }

    fn state(&self) -> &'static [f64] {
        F::STATE
    }

    fn home(&self) -> &'static [[f64; 2]] {
        F::HOME
    }

    fn parameters(&self) -> Vec<f64> {
        (0..F::PARAMETERS.len())
            .map(|index| self.parameter(index))
            .collect()
    }

    fn symbolic(&self) -> Model {
        let write = |x: &[Num<ExprId>], fields: &[Num<ExprId>]| Written {
            psi: F::psi(x, fields),
            viscosities: F::viscosities(x, fields),
        };
        let mut model = expression::model(F::VARIABLES, F::ROLES, F::FIELDS, write);
        // The programs take the parameters in the order in which the macro counts them.
        let place = |name: &&str| F::FIELDS.iter().position(|field| field == name);
        let places = F::PARAMETERS
            .iter()
            .map(|name| place(name).expect("a field"));
        model.parameters = places.map(|place| model.parameters[place]).collect();
        model
    }

    fn psi_of_duals(&self, x: &[Num<HyperDual64>]) -> Num<HyperDual64> {
        F::psi_of_numbers(x, &crate::zoo::dual::constants(&self.data()))
    }

    fn viscosities_of_duals(&self, x: &[Num<HyperDual64>]) -> Vec<Num<HyperDual64>> {
        F::viscosities(x, &crate::zoo::dual::constants(&self.data()))
    }

    fn precise_psi(&self, x: &[Precise]) -> Precise {
        let data = self.data();
        let fields: Vec<_> = data.iter().map(|&value| Num(Precise::of(value))).collect();
        let x: Vec<_> = x.iter().map(|&value| Num(value)).collect();
        F::psi_of_numbers(&x, &fields).0
    }

    fn free_energy(&self, x: &[f64]) -> f64 {
        FreeEnergy::free_energy(self, &array(x))
    }

    fn energy_magnitude(&self, x: &[f64]) -> f64 {
        FreeEnergy::energy_magnitude(self, &array(x))
    }

    fn internal_energy(&self, x: &[f64]) -> f64 {
        FreeEnergy::internal_energy(self, &array(x))
    }

    fn hessian(&self, x: &[f64]) -> Vec<f64> {
        let (gradient, hessian) = FreeEnergy::hessian(self, &array(x));
        flat(gradient.as_ref(), &hessian)
    }

    fn gradient(&self, x: &[f64]) -> Vec<f64> {
        FreeEnergy::gradient(self, &array(x)).as_ref().to_vec()
    }

    fn caloric(&self, x: &[f64]) -> Caloric<f64> {
        FreeEnergy::caloric(self, &array(x))
    }

    fn viscosity(&self, theta: f64) -> Vec<f64> {
        let (eta, slope) = FreeEnergy::viscosity(self, theta);
        [eta.as_ref(), slope.as_ref()].concat()
    }

    fn entropy_form(&self, x0: &[f64], x1: &[f64], corners: &[f64]) -> Vec<f64> {
        let old = self.entropy_form_old(&array(x0));
        let (response, tangent) = FreeEnergy::entropy_form(self, &old, &array(x1), &array(corners));
        flat(response.as_ref(), &tangent)
    }

    fn temperature_form(&self, x0: &[f64], x1: &[f64]) -> Vec<f64> {
        let old = self.temperature_form_old(&array(x0));
        let (response, tangent) = FreeEnergy::temperature_form(self, &old, &array(x1));
        flat(response.as_ref(), &tangent)
    }

    fn entropy_response(&self, x0: &[f64], x1: &[f64], corners: &[f64]) -> Vec<f64> {
        let old = self.entropy_form_old(&array(x0));
        let response = self.entropy_form_response(&old, &array(x1), &array(corners));
        response.as_ref().to_vec()
    }

    fn temperature_response(&self, x0: &[f64], x1: &[f64]) -> Vec<f64> {
        let old = self.temperature_form_old(&array(x0));
        let response = self.temperature_form_response(&old, &array(x1));
        response.as_ref().to_vec()
    }

    fn spring(&self, scene: &mut Scene<2>, ends: [Node; 2]) -> Element {
        self.clone().into_spring(scene, ends)
    }

    fn check_domain(&self, domain: &Domain, samples: usize) -> Result<DomainReport, DomainError> {
        check_domain(self, domain, samples)
    }
}

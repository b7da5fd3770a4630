//! A free energy of the zoo: one formula, read by the derive and by Rust, with data and a home.

use std::sync::Arc;

use eem::{Domain, DomainError, DomainReport, FreeEnergy, check_domain};
use eem_symbolic::{ExprId, Model};
use eem_testkit::table::Table;
use num_dual::HyperDual64;

#[cfg(feature = "typed")]
use crate::zoo::against_typed;
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
    /// The formulas as texts.
    #[cfg(feature = "typed")]
    const TEXTS: (&'static str, &'static [(&'static str, &'static str)]);
    /// All functions.
    #[cfg(feature = "typed")]
    fn all_functions(&self, at: &against_typed::At) -> against_typed::Results;
    /// The same behind tables.
    #[cfg(feature = "typed")]
    fn functions_behind_tables(&self, at: &against_typed::At) -> Vec<against_typed::Results>;
    /// `η_k`.
    fn viscosities<V: Value>(x: &[Num<V>], fields: &[Num<V>]) -> Vec<Num<V>>;
}

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

            #[cfg(feature = "typed")]
            const TEXTS: (&'static str, &'static [(&'static str, &'static str)]) = (
                stringify!(|$($argument: $role),*| $body),
                &[$((stringify!($dashpot), stringify!($viscosity))),*],
            );

            #[cfg(feature = "typed")]
            fn all_functions(
                &self,
                at: &$crate::zoo::against_typed::At,
            ) -> $crate::zoo::against_typed::Results {
                $crate::zoo::against_typed::everything(self, at)
            }

            #[cfg(feature = "typed")]
            fn functions_behind_tables(
                &self,
                at: &$crate::zoo::against_typed::At,
            ) -> Vec<$crate::zoo::against_typed::Results> {
                $crate::zoo::against_typed::behind_tables(self, at)
            }

            fn viscosities<V: $crate::zoo::number::Value>(
                x: &[$crate::zoo::number::Num<V>],
                fields: &[$crate::zoo::number::Num<V>],
            ) -> Vec<$crate::zoo::number::Num<V>> {
                let &[$($argument),*] = x else { panic!("one number per variable") };
                let &[$($field),*] = fields else { panic!("one number per field") };
                vec![$($viscosity),*]
            }
        }
    };
}
pub(crate) use specimen;

/// A specimen as texts.
#[cfg(feature = "typed")]
pub(crate) struct Text {
    pub(crate) free_energy: &'static str,
    pub(crate) viscosities: &'static [(&'static str, &'static str)],
    pub(crate) values: Vec<(&'static str, f64)>,
}

/// A [`Formula`] behind a table of functions, so that a test is written and compiled once.
pub(crate) trait Specimen: Table {
    fn name(&self) -> &'static str;
    fn thermal(&self) -> bool;
    fn measures(&self) -> usize;
    fn dashpots(&self) -> usize;
    /// It is a function of strains.
    fn is_solid(&self) -> bool;
    fn state(&self) -> &'static [f64];
    fn home(&self) -> &'static [[f64; 2]];

    /// The formulas as texts, and the values of the parameters.
    #[cfg(feature = "typed")]
    fn text(&self) -> Text;
    /// All functions.
    #[cfg(feature = "typed")]
    fn everything(&self, at: &against_typed::At) -> against_typed::Results;
    /// The same behind tables.
    #[cfg(feature = "typed")]
    fn behind_tables(&self, at: &against_typed::At) -> Vec<against_typed::Results>;

    /// What the macro should have understood.
    fn symbolic(&self) -> Model;
    fn psi_of_duals(&self, x: &[Num<HyperDual64>]) -> Num<HyperDual64>;
    fn viscosities_of_duals(&self, x: &[Num<HyperDual64>]) -> Vec<Num<HyperDual64>>;
    /// ψ, with one parameter of another value.
    fn precise_psi(&self, x: &[Precise], moved: Option<(usize, Precise)>) -> Precise;
    /// A generated derivative by the parameters.
    #[cfg(feature = "gradients")]
    fn by_parameters(&self, function: &str, arguments: &[&[f64]]) -> Vec<f64>;

    /// The specimen, to be kept.
    fn table(&self) -> Arc<dyn Table>;
    fn check_domain(&self, domain: &Domain, samples: usize) -> Result<DomainReport, DomainError>;
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

    #[cfg(feature = "typed")]
    fn text(&self) -> Text {
        let (free_energy, viscosities) = F::TEXTS;
        Text {
            free_energy,
            viscosities,
            values: F::FIELDS.iter().copied().zip(self.data()).collect(),
        }
    }

    #[cfg(feature = "typed")]
    fn everything(&self, at: &against_typed::At) -> against_typed::Results {
        self.all_functions(at)
    }

    #[cfg(feature = "typed")]
    fn behind_tables(&self, at: &against_typed::At) -> Vec<against_typed::Results> {
        self.functions_behind_tables(at)
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

    fn precise_psi(&self, x: &[Precise], moved: Option<(usize, Precise)>) -> Precise {
        let data = self.data();
        let mut fields: Vec<_> = data.iter().map(|&value| Num(Precise::of(value))).collect();
        if let Some((parameter, value)) = moved {
            let mut names = F::FIELDS.iter();
            let place = names.position(|name| *name == F::PARAMETERS[parameter]);
            fields[place.expect("a field")] = Num(value);
        }
        let x: Vec<_> = x.iter().map(|&value| Num(value)).collect();
        F::psi_of_numbers(&x, &fields).0
    }

    #[cfg(feature = "gradients")]
    fn by_parameters(&self, function: &str, arguments: &[&[f64]]) -> Vec<f64> {
        crate::zoo::parameters::generated(self, function, arguments)
    }

    fn table(&self) -> Arc<dyn Table> {
        Arc::new(self.clone())
    }

    fn check_domain(&self, domain: &Domain, samples: usize) -> Result<DomainReport, DomainError> {
        check_domain(self, domain, samples)
    }
}

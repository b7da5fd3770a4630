//! Derivatives of the generated code against dual numbers.
//!
//! Every model is written twice: as the formula that the derive differentiates, and as an ordinary
//! Rust function, evaluated on the dual numbers of `num-dual`. The two have the formula in common
//! and nothing else: no graph, no rule of differentiation, no divided difference.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "dual_numbers/duals.rs"]
mod duals;
#[path = "dual_numbers/forms.rs"]
mod forms;
#[path = "dual_numbers/formulas.rs"]
mod formulas;
#[path = "dual_numbers/models.rs"]
mod models;
#[path = "dual_numbers/points.rs"]
mod points;
mod support;

/// One module of tests per model.
macro_rules! check {
    ($($module:ident: $model:path),* $(,)?) => {$(
        mod $module {
            #[test]
            fn derivatives_of_the_free_energy() {
                crate::points::free_energy::<$model>();
            }

            #[test]
            fn entropy_heat_capacity_and_internal_energy() {
                crate::points::caloric::<$model>();
            }

            #[test]
            fn viscosities_and_their_slopes() {
                crate::points::viscosities::<$model>();
            }

            #[test]
            fn entropy_form_and_its_tangent() {
                crate::forms::entropy_form::<$model>();
            }

            #[test]
            fn temperature_form_and_its_tangent() {
                crate::forms::temperature_form::<$model>();
            }
        }
    )*};
}

check! {
    thermo_visco_elastic: crate::support::ThermoViscoElastic,
    logarithmic_stiffness: crate::support::LogarithmicStiffness,
    hencky: crate::support::Hencky,
    neo_hookean: crate::models::NeoHookean,
    two_dashpots: crate::models::TwoDashpots,
    power_heat: crate::models::PowerHeat,
    saturating: crate::models::Saturating,
}

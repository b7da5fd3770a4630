//! Derivatives of the generated code against dual numbers.
//!
//! Every model is written twice: as the formula that the derive differentiates, and as an ordinary
//! Rust function, evaluated on the dual numbers of `num-dual`. The two have the formula in common
//! and nothing else: no graph, no rule of differentiation, no divided difference.

mod duals;
mod forms;
mod formulas;
mod models;
mod points;
/// One module of tests per model.
macro_rules! check {
    ($($module:ident: $model:path),* $(,)?) => {$(
        mod $module {
            #[test]
            fn derivatives_of_the_free_energy() {
                crate::dual_numbers::points::free_energy::<$model>();
            }

            #[test]
            fn entropy_heat_capacity_and_internal_energy() {
                crate::dual_numbers::points::caloric::<$model>();
            }

            #[test]
            fn viscosities_and_their_slopes() {
                crate::dual_numbers::points::viscosities::<$model>();
            }

            #[test]
            fn entropy_form_and_its_tangent() {
                crate::dual_numbers::forms::entropy_form::<$model>();
            }

            #[test]
            fn temperature_form_and_its_tangent() {
                crate::dual_numbers::forms::temperature_form::<$model>();
            }
        }
    )*};
}

check! {
    thermo_visco_elastic: crate::support::ThermoViscoElastic,
    logarithmic_stiffness: crate::support::LogarithmicStiffness,
    hencky: crate::support::Hencky,
    neo_hookean: crate::dual_numbers::models::NeoHookean,
    two_dashpots: crate::dual_numbers::models::TwoDashpots,
    power_heat: crate::dual_numbers::models::PowerHeat,
    saturating: crate::dual_numbers::models::Saturating,
}

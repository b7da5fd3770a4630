//! Generated functions against the interpreter of the programs they were printed from, and against
//! what the numbers have to fulfil whoever computes them.
//!
//! The formula of every model is written once and read twice: by the derive, and by Rust itself as
//! a function of expressions. The interpreter integrates divided differences by quadrature, so that
//! the kernels of the runtime are checked in passing.

#[path = "generated_against_interpreter/compare.rs"]
mod compare;
#[path = "generated_against_interpreter/formula.rs"]
mod formula;
#[path = "generated_against_interpreter/laws.rs"]
mod laws;
#[path = "generated_against_interpreter/properties.rs"]
mod properties;

/// One module of tests per law.
macro_rules! check {
    ($($law:ident: $module:ident),* $(,)?) => {$(
        mod $module {
            use crate::laws::$law;

            #[test]
            fn point_functions_agree_with_the_interpreter() {
                crate::compare::points::<$law>();
            }

            #[test]
            fn forms_agree_with_the_interpreter() {
                crate::compare::forms::<$law>();
            }

            #[test]
            fn discrete_derivatives_sum_up_to_the_energy() {
                crate::properties::directionality::<$law>();
            }

            #[test]
            fn derivatives_are_those_of_differences() {
                crate::properties::derivatives::<$law>();
            }

            #[test]
            fn forms_are_symmetric_in_time() {
                crate::properties::symmetry::<$law>();
            }
        }
    )*};
}

check! {
    Pendulum: pendulum,
    LinearStiffness: linear_stiffness,
    LogarithmicStiffness: logarithmic_stiffness,
    NeoHookean: neo_hookean,
    Maxwell: maxwell,
    TwoDashpots: two_dashpots,
    Powers: powers,
    Functions: functions,
}

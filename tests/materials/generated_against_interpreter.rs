//! Generated functions against the interpreter of the programs they were printed from, and against
//! what the numbers have to fulfil whoever computes them.
//!
//! The formula of every model is written once and read twice: by the derive, and by Rust itself as
//! a function of expressions. The interpreter integrates divided differences by quadrature, so that
//! the kernels of the runtime are checked in passing.

mod compare;
mod formula;
mod laws;
mod properties;

/// One module of tests per law.
macro_rules! check {
    ($($law:ident: $module:ident),* $(,)?) => {$(
        mod $module {
            use crate::generated_against_interpreter::laws::$law;

            #[test]
            fn point_functions_agree_with_the_interpreter() {
                crate::generated_against_interpreter::compare::points::<$law>();
            }

            #[test]
            fn forms_agree_with_the_interpreter() {
                crate::generated_against_interpreter::compare::forms::<$law>();
            }

            #[test]
            fn discrete_derivatives_sum_up_to_the_energy() {
                crate::generated_against_interpreter::properties::directionality::<$law>();
            }

            #[test]
            fn derivatives_are_those_of_differences() {
                crate::generated_against_interpreter::properties::derivatives::<$law>();
            }

            #[test]
            fn forms_are_symmetric_in_time() {
                crate::generated_against_interpreter::properties::symmetry::<$law>();
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

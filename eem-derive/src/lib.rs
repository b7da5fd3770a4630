//! `#[derive(FreeEnergy)]`: from a written free energy to straight-line Rust.
//!
//! The input is a struct whose fields are the parameters of a material and whose attribute is its
//! free energy; the output is one `impl FreeEnergy`. There is no mathematics in this crate. It
//! reads tokens, checks them, hands a model to [`eem_symbolic`] and prints the programs that come
//! back. The phases:
//!
//! | phase | module | from → to |
//! |---|---|---|
//! | parse | `attr`, `parse` | tokens → `ast` |
//! | check | `check` | `ast` → `checked`: names resolved, roles and laws complete |
//! | model | `model` | `checked` → [`eem_symbolic::Model`]: every subexpression has a value |
//! | physics | `physics` | the model can be one of a material |
//! | expand | `expand` | programs → tokens |
//!
//! A phase leaves a hole where it reports something, and the phases after it look at the rest: the
//! mistakes of all phases come out together, and none of them causes a second message. Beside them
//! stands an implementation that does nothing, from `fallback`, so that uses of a wrong model cause
//! no messages either. `message` is the catalogue of all messages.

mod ast;
mod attr;
mod check;
mod checked;
mod ctxt;
mod derive;
mod expand;
mod fallback;
mod message;
mod model;
mod nearest;
mod parse;
mod physics;
#[cfg(test)]
mod tests;

use proc_macro::TokenStream;
use syn::{DeriveInput, parse_macro_input};

/// Implements `FreeEnergy` for a struct whose fields are the parameters of a free energy.
///
/// ```ignore
/// #[derive(FreeEnergy)]
/// #[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
///     let strain = ln(lambda / natural_length);
///     0.5 * stiffness * strain.powi(2)
///         + 0.5 * branch * (lambda - gamma).powi(2)
///         + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
/// })]
/// #[viscosity(gamma = eta_ref * exp(activation / theta))]
/// pub struct Spring {
///     pub natural_length: f64, // m
///     pub stiffness: f64,      // J
///     pub branch: f64,         // N/m
///     pub capacity: f64,       // J/K
///     pub theta_ref: f64,      // K
///     pub eta_ref: f64,        // N s/m
///     pub activation: f64,     // K
/// }
/// ```
///
/// # Arguments
///
/// The arguments of the closure are the state; their types say what each one is and their order
/// is free. What is not declared does not exist at run time.
///
/// | role | how many | meaning |
/// |---|---|---|
/// | `Stretch` | one | length of the spring, m |
/// | `Viscous` | any number | stretch of one dashpot, m; each needs a law in `#[viscosity]` |
/// | `Temperature` | none or one | absolute temperature, K |
///
/// # Expressions
///
/// * names: arguments, fields of type `f64`, `f32` or of a type parameter, and `let` bindings. A
///   name means one thing: no argument has the name of a field, and no `let` a name that can be seen
///   where it stands.
/// * numbers: `2`, `2.0`, `1e-3`, `1_000.0`, all exact: `1 / 2` is one half.
/// * `+`, `-`, `*`, `/`, unary minus, parentheses, blocks with `let`.
/// * `diff(expression, argument)`: the partial derivative, anywhere in an expression.
/// * in call form `ln(x)` and in method form `x.ln()`: `powi`, `powf`, `sqrt`, `cbrt`, `recip`,
///   `abs`, `exp`, `exp_m1`, `ln`, `ln_1p`, `log2`, `log10`, `sin`, `cos`, `tan`, `sinh`, `cosh`,
///   `tanh`, `asinh`, `atan`, `atanh`. `abs` is for parameters only: it has no derivative at zero.
///
/// # Viscosity
///
/// `#[viscosity(gamma = law)]`, one law per dashpot in N s/m, separated by commas or in several
/// attributes. A law may use the temperature and the fields.
///
/// # Fields that are no parameters
///
/// Fields of other types may be there for any purpose. A number that neither the free energy nor a
/// viscosity uses is an error, because a parameter without effect is most often a term that was
/// forgotten. `#[free_energy(unused)]` on the field says that it is no parameter; a name that
/// starts with an underscore says so too.
///
/// # What is refused
///
/// Everything wrong with a model is a compile-time error at the token that is wrong, with a line
/// that says what to write instead. Beside syntax, names and arguments of functions these are
///
/// * constants that do not fit an `f64`, divisors that are zero, and arguments outside of the domain
///   of a function: `ln(-1)`, `sqrt(-lambda)`;
/// * a free energy that does not depend on one of its arguments, or is linear in the temperature:
///   its heat capacity `c = -θ ∂²ψ/∂θ²` is zero, and no temperature belongs to an entropy;
/// * a heat capacity or a viscosity that is nowhere positive.
///
/// These follow from the formulas alone, given that lengths and temperatures are positive. What
/// depends on the values of the parameters shows only at run time.
///
/// # Another path to the crate
///
/// `#[free_energy(crate = path)]`, alone or beside the closure, for a renamed or re-exported
/// `eem`.
#[proc_macro_derive(FreeEnergy, attributes(free_energy, viscosity))]
pub fn derive_free_energy(input: TokenStream) -> TokenStream {
    let input = parse_macro_input!(input as DeriveInput);
    derive::derive(&input).into()
}

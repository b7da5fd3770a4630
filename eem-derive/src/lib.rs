//! `#[derive(FreeEnergy)]`: from a written free energy to straight-line Rust.
//!
//! The input is a struct whose fields are the parameters of a material and whose attribute is its
//! free energy; the output is one `impl FreeEnergy`, for solids with one `impl StrainEnergy`. There is no mathematics in this crate. It
//! reads tokens, checks them, hands a model to [`eem_symbolic`] and prints the programs that come
//! back. The phases:
//!
//! | phase | module | from → to |
//! |---|---|---|
//! | parse | `attr`, `parse` | tokens → `ast` |
//! | check | `check` | `ast` → `checked`: names resolved, roles and laws complete |
//! | units | `units` | `checked` → the units of its fields, every operation in order |
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
mod unit;
mod units;
mod warnings;

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
///     #[unit("m")]
///     pub natural_length: f64,
///     #[unit("J")]
///     pub stiffness: f64,
///     #[unit("N/m")]
///     pub branch: f64,
///     #[unit("J/K")]
///     pub capacity: f64,
///     #[unit("K")]
///     pub theta_ref: f64,
///     #[unit("N s/m")]
///     pub eta_ref: f64,
///     #[unit("K")]
///     pub activation: f64,
/// }
/// ```
///
/// Beside `FreeEnergy`, which the schemes use, this implements `Describe`: the formulas, units and
/// operation counts of the model in print, `Spring::DESCRIPTION`.
///
/// # Arguments
///
/// The arguments of the closure are the state; their types say what each one is and their order
/// is free. What is not declared does not exist at run time.
///
/// | role | how many | meaning |
/// |---|---|---|
/// | `Stretch` | one, in a spring | length of the spring, m |
/// | `StrainTrace`, `StrainSquare`, `Dilatation` | each at most one, in a solid | `tr E`, `E:E`, `J − 1` |
/// | `FibreStrain` | any number, in a solid | `a·E a` along one fibre, whose direction a every solid has of its own |
/// | `ViscousStrain`, `ViscousSquare`, `ViscousTrace` | each at most one, in a solid | `E:Γ`, `Γ:Γ`, `tr Γ` of a viscous strain Γ, a tensor; the first and the last need a law in `#[viscosity]` |
/// | `Viscous` | any number | stretch of one dashpot, m, in a solid a strain; each needs a law in `#[viscosity]` |
/// | `Temperature` | none or one | absolute temperature, K |
///
/// # Solids
///
/// With strains instead of a stretch the free energy is that of a solid, per reference volume:
///
/// ```ignore
/// #[derive(FreeEnergy)]
/// #[free_energy(|e1: StrainTrace, e2: StrainSquare| 0.5 * la * e1.powi(2) + mu * e2)]
/// pub struct Elastic {
///     pub la: f64,
///     pub mu: f64,
/// }
/// ```
///
/// `E = ½(FᵀF − 1)` is the Green–Lagrange strain and `J = det F`. All strains are zero at rest, so that
/// small ones keep their digits: write `ln_1p(j)` for ln J, `2 * e1` for `tr C − 3`, and
/// `4 * e1 + 2 * (e1.powi(2) - e2)` for `tr cof C − 3`. The strains that are named are those that exist.
/// Their order is the order of the discrete derivatives, and part of the model. Such a model
/// implements `StrainEnergy`, too.
///
/// # Solids whose shape flows
///
/// A scalar `Viscous` relaxes one measure. Shear relaxes with a tensor Γ of its own at every point, of which the
/// free energy sees invariants:
///
/// ```ignore
/// #[derive(FreeEnergy)]
/// #[free_energy(|e2: StrainSquare, m3: ViscousStrain, m2: ViscousSquare| {
///     mu * e2 + branch * (e2 - 2 * m3 + m2)
/// })]
/// #[viscosity(m3 = eta)]
/// pub struct Relaxing {
///     pub mu: f64,
///     pub branch: f64,
///     pub eta: f64,
/// }
/// ```
///
/// Here `e2 - 2 * m3 + m2` is `(E − Γ):(E − Γ)`. Γ flows as
///
/// ```text
/// Γ̇ = dev G/η + vol G/η_v,   G = −∂ψ/∂Γ = −(∂ψ/∂m1 1 + 2 ∂ψ/∂m2 Γ + ∂ψ/∂m3 E)
/// ```
///
/// and heats the point by `G:Γ̇`. The viscosity of the `ViscousStrain` is η; that of the `ViscousTrace` is `η_v`.
/// Without a `ViscousTrace` there is no volumetric flow, and Γ has no trace; with one there is, also if the
/// free energy does not mention it. Above, `G = 2 branch (E − Γ)`, and shear relaxes in the time
/// `eta/(2 * branch)`. In plane strain Γ flows across the plane, too. The material implements `JointEnergy`
/// as well.
///
/// # Expressions
///
/// * names: arguments, fields of type `f64`, `f32` or of a type parameter, and `let` bindings. A
///   name means one thing: no argument has the name of a field, and no `let` a name that can be seen
///   where it stands.
/// * entries of fields that are arrays: with `stiffness: [f64; 3]` there are `stiffness[0]` to
///   `stiffness[2]`. Index and length are written out. Every entry is a parameter of its own.
/// * fields of other types, which the formulas do not mention. All fields must be `Clone`, since a scene can be
///   copied.
/// * constants of the program, whose names are in upper case: `R`, `crate::gas::R`, `Self::R`. Rust finds
///   them where the struct stands; their type is `f64`, or one that fits without loss such as `f32` or `i32`.
///   `PI` is π without an import, `core::f64::consts::…` and `std::f64::consts::…` are known by their values.
/// * numbers: `2`, `2.0`, `1e-3`, `1_000.0`, all exact: `1 / 2` is one half.
/// * `+`, `-`, `*`, `/`, unary minus, parentheses, blocks with `let`.
/// * helpers, `let f = |x, y| …;`, called as `f(a, b)`: every call stands for the body with its arguments. A
///   helper sees what is before it and cannot call itself. What is wrong in a call is said at the token in the
///   body, with the call.
/// * `diff(expression, argument)`: the partial derivative, anywhere in an expression.
/// * in call form `ln(x)` and in method form `x.ln()`: `powi`, `powf`, `sqrt`, `cbrt`, `recip`,
///   `abs`, `exp`, `exp_m1`, `ln`, `ln_1p`, `log2`, `log10`, `sin`, `cos`, `tan`, `sinh`, `cosh`,
///   `tanh`, `asinh`, `atan`, `atanh`. `abs` is for parameters only: it has no derivative at zero.
///
/// # Viscosity
///
/// `#[viscosity(gamma = law)]`, one law per dashpot in N s/m, in a solid in Pa s, separated by commas or in several
/// attributes. A law may use the temperature and the fields.
///
/// With the name of the `Stretch`, `#[viscosity(lambda = law)]`, a dashpot stands beside the spring
/// (Kelvin–Voigt): the force `η λ̇`, and its heat `η λ̇²`. The schemes `EemEntropy` and `EemTemperature` step it
/// and keep the laws, and the midpoint and trapezoidal rules step it; others refuse a scene with one.
///
/// # Units
///
/// `#[unit("J/K")]` on a field says what it is measured in. A model whose formulas use no field
/// with a unit is not looked at; otherwise all fields that they use need one, and the compiler
/// checks every operation and says which unit a field without one needs. Lengths and viscous
/// stretches are in m, the temperature is in K, the free energy has to come out in J and a
/// viscosity in N s/m. In a solid strains and viscous variables are pure numbers, the free energy is in
/// J/m^3, which is Pa, and a viscosity in Pa s.
///
/// | in a formula | is right if |
/// |---|---|
/// | `a + b`, `a - b` | `a` and `b` have the same unit |
/// | `exp(x)`, `ln(x)`, `sin(x)` … | `x` is a pure number |
/// | `x.powi(n)`, `x.powf(y)` | the exponent is a pure number, and one that is written out unless `x` is a pure number, too |
/// | a number | a pure number; zero has any unit |
///
/// All others multiply and divide units; `diff(e, x)` has the unit of `e/x`. Exponents are exact
/// rationals.
///
/// The unit above an array is that of every entry. A constant is a pure number, unless the struct says
/// what it is measured in, with the path that the formula has: `#[unit(R = "J/(mol K)", crate::MOLES = "mol")]`.
///
/// A unit is a product of symbols: `N s/m`, `kg*m^2/(s^2 K)`, `J·K⁻¹`, `m^(1/2)`, `1/s`, and `1` for a
/// pure number. Known are the units of the SI (`rad` and `sr` are 1, `ohm` stands for Ω), with
/// their prefixes, and `min`, `h`, `d`, `L`, `t`, `bar`. What can be read in two ways is refused:
/// write `J/(kg K)`, not `J/kg K`, and `m^2`, not `m2`.
///
/// Prefixes are factors of the value, and a formula works with values: 5 kN/m times 2 m is 10 only in
/// kN. That is why the scale of a unit counts as the rest of it does, numbers in a formula do not
/// stand for prefixes, and a field in mm cannot be added to a length in m: give it in m, or multiply
/// it by a field in `m/mm`, of value 0.001.
///
/// # Fields that are no parameters
///
/// Fields of other types may be there for any purpose. A number, or an entry of an array of numbers, that
/// neither the free energy nor a viscosity uses is an error, because a parameter without effect is most often a term that was
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
/// * powers with an exponent that is no integer, of a base that can be negative in some state:
///   `(lambda - length).powf(2.5)`. Parameters count as positive here;
/// * in a solid, what has no value or no derivative at rest: `1 / j`, `ln(j)`, `sqrt(e2)`;
/// * a free energy that does not depend on one of its arguments, or is linear in the temperature:
///   its heat capacity `c = -θ ∂²ψ/∂θ²` is zero, and no temperature belongs to an entropy;
/// * a heat capacity or a viscosity that is nowhere positive.
///
/// These follow from the formulas alone, given that lengths and temperatures are positive and that
/// `tr E > −3/2`, `E:E ≥ 0` and `J − 1 > −1`. What
/// depends on the values of the parameters shows only at run time.
///
/// # Another path to the crate
///
/// `#[free_energy(crate = path)]`, alone or beside the closure, for a renamed or re-exported
/// `eem`.
#[proc_macro_derive(FreeEnergy, attributes(free_energy, viscosity, unit))]
pub fn derive_free_energy(input: TokenStream) -> TokenStream {
    let input = parse_macro_input!(input as DeriveInput);
    derive::derive(&input).into()
}

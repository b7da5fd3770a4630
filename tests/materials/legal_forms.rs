//! The zoo of legal forms: everything a free energy may look like, and what it then means.

use eem::FreeEnergy;

/// ψ of a model at a state, for comparison with a number.
fn energy<M, const N: usize>(model: &M, x: [f64; N]) -> f64
where
    M: FreeEnergy<f64, Variables = [f64; N]>,
{
    model.free_energy(&x)
}

/// A few roundings of terms of order one.
fn close(found: f64, expected: f64) {
    let tolerance = 16.0 * f64::EPSILON * expected.abs().max(1.0);
    let error = (found - expected).abs();
    assert!(error <= tolerance, "{found} is not {expected}");
}

/// Models of one stretch without parameters, with ψ(0.5).
macro_rules! formulas {
    ($($name:ident: $formula:expr => $expected:expr;)*) => {
        $(
            #[test]
            fn $name() {
                #[derive(FreeEnergy)]
                #[free_energy(|x: Stretch| $formula)]
                struct Model;
                close(energy(&Model, [0.5]), $expected);
            }
        )*
    };
}

formulas! {
    integers_are_numbers: 2 * x => 1.0;
    one_half_is_not_zero: 1 / 2 + x => 1.0;
    floats_have_all_spellings: 2.0 * x + 2. + 1e-3 + 1E3 + 1_000.000_1 => 2003.0011;
    hexadecimal_numbers: 0x10 * x + 0b11 + 0o7 => 18.0;
    a_suffix_of_the_right_type: 2f64 * x + 3_f64 => 4.0;
    signs: -x - -x + -(-x) => 0.5;
    a_minus_before_a_power: -x.powi(2) => -0.25;
    precedence: 1 + 2 * x / 4 - 3 => -1.75;
    parentheses: ((1 + 2) * ((x))) => 1.5;
    a_block_is_an_expression: 2 * { let y = x; y * y } + { x } => 1.0;
    a_block_in_an_argument: ln({ let y = x; y * 2 }) + x => 0.5;
    nested_derivatives: diff(diff(x.powi(3), x) * x, x) => 2.25;
    a_derivative_of_a_block: diff({ let y = x * x; y * y }, x) => 0.5;
    calls_in_calls: exp(ln(sqrt(x * x))) => 0.5;
    methods_of_methods: x.powi(2).sqrt().ln().exp() => 0.5;
    methods_of_numbers: 2.powi(3) * x + 2.0.sqrt().powi(2) => 6.0;
    powers: x.powi(-1) + powi(x, 2) + powi(x, 6 / 3) + x.powi(0) => 3.5;
    real_powers: x.powf(0.5) * powf(x, 1 / 2) + 4.powf(x) => 2.5;
    powers_of_powers: x.powf(x).powf(2) => 0.5;
    helpers: { let f = |a, b| a * b + 1; f(x, 2) + f(f(x, x), 4) } => 8.0;
    helpers_with_blocks: { let f = |a| { let b = a * a; b * b }; f(2 * x) + x.f() } => 1.0625;
    helpers_see_what_is_before_them: { let y = 2 * x; let f = |a| a * y; let z = 3; f(z) } => 3.0;
    arguments_are_those_of_the_call: { let f = |a| a + 1; let g = |b| f(b) * f(2 * b); g(f(x)) } => 10.0;
    derivatives_of_helpers: { let f = |a| a.powi(3); diff(f(x) * x, x) } => 0.5;
    derivatives_in_helpers: { let f = |a| diff(a * x, x); f(x) + f(x.powi(2)) } => 1.75;
    the_same_name_in_two_helpers: { let f = |a| { let b = a; b }; let g = |a| { let b = 2 * a; b }; f(x) + g(x) } => 1.5;
    helpers_in_blocks: { let y = { let f = |a| a * x; f(2) }; let f = |a| a + y; f(x) } => 1.5;
    helpers_in_parentheses: { let f = (|a| (a + 1)); f(x) } => 1.5;
    a_number_as_exponent: { let f = |a, n| a.powi(n); f(x, 2) + f(x, 1 + 2) } => 0.375;
    pi: sin(PI / 6) + core::f64::consts::FRAC_PI_2 / ::std::f64::consts::PI + x => 1.5;
    constants_of_std: exp(x) / sqrt(std::f64::consts::E) + std::f64::consts::LOG2_E * core::f64::consts::LN_2 => 2.0;
    names_of_functions_are_free: { let ln = ln(x); let exp = exp(ln); exp } => 0.5;
}

/// Every function, in call form and in method form.
macro_rules! functions {
    ($($name:ident)*) => {
        $(
            #[test]
            fn $name() {
                #[derive(FreeEnergy)]
                #[free_energy(|x: Stretch| $name(x) + 2 * x.$name())]
                struct Model;
                close(energy(&Model, [0.5]), 3.0 * f64::$name(0.5));
            }
        )*
    };
}

functions! {
    sqrt cbrt recip exp exp_m1 ln ln_1p log2 log10 sin cos tan sinh cosh tanh asinh atan atanh
}

/// Parameters may be inside of everything, `abs` included.
#[derive(FreeEnergy)]
#[free_energy(|x: Stretch| abs(a) * x + (a * b).abs() + x.powf(b) + powf(b, x) + sqrt(b) * ln(b))]
struct Parameters {
    a: f64,
    b: f32,
}

#[test]
fn parameters_are_everywhere() {
    let model = Parameters { a: -3.0, b: 4.0 };
    let expected = 1.5 + 12.0 + 0.0625 + 2.0 + 2.0 * f64::ln(4.0);
    close(energy(&model, [0.5]), expected);
}

/// One law per attribute or several, blocks, trailing commas, any delimiter, any order.
#[derive(FreeEnergy)]
#[viscosity {
    b = {
        let rate = exp(-theta / 100);
        eta * rate
    },
    c = eta,
}]
#[free_energy[
    |
        c: Viscous,
        theta: Temperature,
        x: Stretch,
        a: Viscous,
        b: Viscous,
    | {
        (x - a) * (x - b) * (x - c) - theta * ln(theta)
    },
]]
#[viscosity(a = 2 * eta)]
struct Laws {
    eta: f64,
}

#[test]
fn laws_belong_to_their_dashpots() {
    let (eta, slopes) = Laws { eta: 3.0 }.viscosity(100.0_f64);
    let expected = [3.0, 6.0, 3.0 * (-1.0_f64).exp()];
    for (found, expected) in eta.into_iter().zip(expected) {
        close(found, expected);
    }
    close(slopes[2], -0.03 * (-1.0_f64).exp());
}

/// Models written by a macro: names, expressions and types arrive as fragments.
macro_rules! spring {
    ($name:ident, $lambda:ident: $role:ident, $k:ident: $number:ty, $energy:expr) => {
        #[derive(FreeEnergy)]
        #[free_energy(|$lambda: $role| $k * ($energy))]
        struct $name {
            $k: $number,
        }
    };
}

spring!(Linear, stretch: Stretch, force: f64, stretch - 1);
spring!(Cubic, stretch: Stretch, stiffness: f32, (stretch - 1).powi(3));

#[test]
fn macros_can_write_models() {
    close(energy(&Linear { force: 4.0 }, [3.0]), 8.0);
    close(energy(&Cubic { stiffness: 0.5 }, [3.0]), 4.0);
}

/// Names in any alphabet.
#[derive(FreeEnergy)]
#[free_energy(|λ: Stretch, θ: Temperature| {
    let ε = ln(λ / λ0);
    0.5 * k * ε.powi(2) - c * θ * ln(θ)
})]
#[allow(non_snake_case)]
struct Greek {
    λ0: f64,
    k: f64,
    c: f64,
}

#[test]
fn names_may_be_greek() {
    let model = Greek {
        λ0: 0.5,
        k: 2.0,
        c: 1.0,
    };
    close(energy(&model, [0.5, 1.0]), 0.0);
}

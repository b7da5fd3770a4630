//! The legal forms of a model: type parameters, lifetimes, constants, bounds, unused fields,
//! scalars and blocks.

// The data are small integers: every result is exact.
#![allow(clippy::float_cmp)]

use std::fmt::Debug;
use std::marker::PhantomData;
use std::ops::Mul;

use eem::{FreeEnergy, Strain, StrainEnergy};

/// All parameters of the scalar type: the model works in that scalar.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| 0.5 * stiffness * (lambda - length).powi(2))]
struct Generic<T> {
    stiffness: T,
    length: T,
}

/// A type parameter with bounds of its own beside plain floats.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| 0.5 * stiffness * (lambda - length).powi(2) / scale)]
struct Mixed<'a, T: Copy + 'a, const N: usize>
where
    T: PartialOrd + Mul<f64, Output = T> + Mul<T, Output = T>,
{
    stiffness: T,
    length: f64,
    scale: f32,
    #[allow(dead_code)]
    history: [&'a T; N],
}

/// Fields that the energy does not mention may have any type.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| stiffness * lambda)]
struct Labelled<'a, L: ?Sized> {
    stiffness: f64,
    #[allow(dead_code)]
    name: &'a str,
    _label: PhantomData<L>,
}

/// No parameters at all.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| lambda.powi(2) / 2)]
struct Bare {}

/// No parameters, and no braces.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| lambda.powi(2) / 2)]
struct Unit;

/// Blocks that are not inside of one another can use the same names, and so can a law.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| {
    let soft = {
        let square = lambda.powi(2);
        k * square
    };
    let stiff = {
        let square = gamma.powi(2);
        let _kept = square * square;
        100 * k * square
    };
    soft + stiff + diff(soft, lambda)
})]
#[viscosity(gamma = { let square = k * k; let soft = square; soft })]
struct Blocks {
    k: f64,
}

/// Numbers that are no parameters.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda)]
#[allow(dead_code)]
struct Marked<T> {
    k: T,
    /// Hidden by the argument, which is allowed because it is no parameter.
    #[free_energy(unused)]
    lambda: f64,
    #[doc = "Not compiled at all."]
    #[cfg(any())]
    absent: f64,
    #[cfg_attr(all(), free_energy(unused))]
    density: T,
    _padding: f64,
}

/// Parameters of the struct with the names that generated code gives to its own.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda)]
struct Reserved<'__s, __S: Copy + Debug = u8, const __S_: usize = 2>
where
    Self: Sized,
    [__S; __S_]: Debug,
    for<'a> &'a __S: Debug,
{
    k: f64,
    #[allow(dead_code)]
    data: &'__s [__S; __S_],
}

/// Raw identifiers name what they say.
#[derive(FreeEnergy)]
#[free_energy(|r#loop: Stretch, r#fn: Viscous| {
    let r#let = r#type * r#loop;
    r#let * r#fn + k
})]
#[viscosity(r#fn = r#type)]
struct Raw {
    r#type: f64,
    r#k: f64,
}

/// Any order of arguments; the state is measures, dashpots, temperature.
#[derive(FreeEnergy)]
#[free_energy(|theta: Temperature, b: Viscous, a: Viscous, lambda: Stretch| {
    lambda + 10 * a + 100 * b - 1000 * theta.powi(2)
})]
#[viscosity(a = 1, b = 2 * theta)]
struct Order {}

/// A solid of any scalar; its measures are in the order of the arguments.
#[derive(FreeEnergy)]
#[free_energy(|g: Viscous, j: Dilatation, theta: Temperature, e2: StrainSquare, e1: StrainTrace| {
    2 * mu * e2 + 3 * e1 + 5 * j + 7 * g - 11 * theta.powi(2)
})]
#[viscosity(g = 1)]
struct Solid<'a, T: Copy, const N: usize>
where
    T: Debug,
{
    mu: T,
    #[allow(dead_code)]
    data: &'a [T; N],
}

#[test]
fn strains_are_measures_in_the_order_of_the_arguments() {
    let solid = Solid {
        mu: 0.5,
        data: &[1.0],
    };
    assert_eq!(<Solid<'_, f64, 1> as FreeEnergy<f64>>::MEASURES, 3);
    let strains = <Solid<'_, f64, 1> as StrainEnergy<3>>::STRAINS;
    assert_eq!(strains, [Strain::Dilatation, Strain::Square, Strain::Trace]);
    assert_eq!(
        solid.gradient(&[1.0, 1.0, 1.0, 1.0, 1.0]),
        [5.0, 1.0, 3.0, 7.0, -22.0]
    );
}

fn energy<M, const N: usize>(model: &M, x: [f64; N]) -> f64
where
    M: FreeEnergy<f64, Variables = [f64; N]>,
{
    model.free_energy(&x)
}

#[test]
fn a_type_parameter_is_the_scalar() {
    let double = Generic {
        stiffness: 3.0_f64,
        length: 1.0,
    };
    assert_eq!(double.free_energy(&[3.0]), 6.0);
}

#[test]
fn floats_are_converted_to_the_scalar() {
    let seen = 1.0;
    let mixed = Mixed {
        stiffness: 3.0,
        length: 1.0,
        scale: 0.5,
        history: [&seen; 2],
    };
    assert_eq!(energy(&mixed, [3.0]), 12.0);
    assert_eq!(
        <Mixed<'_, f64, 2> as FreeEnergy<f64>>::PARAMETERS,
        ["stiffness", "length", "scale"]
    );
    let bare = Bare {};
    assert_eq!(bare.free_energy(&[3.0_f64]), 4.5_f64);
    assert_eq!(Unit.free_energy(&[3.0_f64]), 4.5_f64);
}

#[test]
fn unused_fields_are_no_parameters() {
    let labelled = Labelled::<str> {
        stiffness: 2.0,
        name: "spring",
        _label: PhantomData,
    };
    assert_eq!(energy(&labelled, [3.0]), 6.0);
    assert_eq!(
        <Labelled<'_, str> as FreeEnergy<f64>>::PARAMETERS,
        ["stiffness"]
    );
}

#[test]
fn names_live_as_long_as_their_block() {
    let blocks = Blocks { k: 4.0 };
    // k λ² + 100 k γ² + 2 k λ at λ = 3, γ = 1
    assert_eq!(energy(&blocks, [3.0, 1.0]), 36.0 + 400.0 + 24.0);
    assert_eq!(blocks.viscosity(1.0_f64), ([16.0], [0.0]));
}

#[test]
fn marked_fields_are_no_parameters() {
    let marked = Marked {
        k: 2.0,
        lambda: f64::NAN,
        density: f64::NAN,
        _padding: f64::NAN,
    };
    assert_eq!(energy(&marked, [3.0]), 6.0);
    assert_eq!(<Marked<f64> as FreeEnergy<f64>>::PARAMETERS, ["k"]);
}

#[test]
fn type_parameters_do_not_meet_the_generated_one() {
    let data = [1, 2];
    let reserved = Reserved {
        k: 2.0,
        data: &data,
    };
    assert_eq!(energy(&reserved, [3.0]), 6.0);
}

#[test]
fn raw_identifiers_are_names() {
    let raw = Raw {
        r#type: 2.0,
        k: 5.0,
    };
    assert_eq!(energy(&raw, [3.0, 4.0]), 29.0);
    assert_eq!(<Raw as FreeEnergy<f64>>::PARAMETERS, ["type", "k"]);
}

#[test]
fn the_state_is_measures_dashpots_temperature() {
    let order = Order {};
    // λ = 1, b = 2, a = 3, θ = 4: dashpots keep the order of the closure.
    assert_eq!(
        energy(&order, [1.0, 2.0, 3.0, 4.0]),
        1.0 + 200.0 + 30.0 - 16000.0
    );
    let (eta, eta_theta) = order.viscosity(4.0_f64);
    assert_eq!((eta, eta_theta), ([8.0, 1.0], [2.0, 0.0]));
    assert_eq!(<Order as FreeEnergy<f64>>::MEASURES, 1);
    assert_eq!(<Order as FreeEnergy<f64>>::DASHPOTS, 2);
    const { assert!(<Order as FreeEnergy<f64>>::THERMAL) };
}

//! The legal forms of a model: type parameters, lifetimes, constants, bounds, unused fields,
//! scalars, blocks and shadowing.

// The data are small integers: every result is exact.
#![allow(clippy::float_cmp)]

use std::marker::PhantomData;

use eem::FreeEnergy;

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
    T: PartialOrd,
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

/// Inner names hide outer ones: a `let` the argument, the argument the field, a block its outside.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| {
    let k = k / 2;
    let square = lambda * lambda;
    let force = diff(square, lambda);
    let lambda = {
        let k = 100;
        k * lambda
    };
    k * lambda + force
})]
struct Shadowed {
    k: f64,
    #[allow(dead_code)]
    lambda: f64,
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
    lambda + 10 * a + 100 * b + 1000 * theta.powi(2)
})]
#[viscosity(a = 1, b = 2 * theta)]
struct Order {}

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
    let single = Generic {
        stiffness: 3.0_f32,
        length: 1.0,
    };
    assert_eq!(single.gradient(&[3.0]), [6.0_f32]);
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
    assert_eq!(bare.free_energy(&[3.0_f32]), 4.5_f32);
    assert_eq!(bare.free_energy(&[3.0_f64]), 4.5_f64);
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
fn inner_names_hide_outer_names() {
    let shadowed = Shadowed {
        k: 4.0,
        lambda: f64::NAN,
    };
    // (k/2)·(100 λ) + 2 λ at λ = 3
    assert_eq!(energy(&shadowed, [3.0]), 606.0);
    assert_eq!(<Shadowed as FreeEnergy<f64>>::PARAMETERS, ["k"]);
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
        1.0 + 200.0 + 30.0 + 16000.0
    );
    let (eta, eta_theta) = order.viscosity(4.0_f64);
    assert_eq!((eta, eta_theta), ([8.0, 1.0], [2.0, 0.0]));
    assert_eq!(<Order as FreeEnergy<f64>>::MEASURES, 1);
    assert_eq!(<Order as FreeEnergy<f64>>::DASHPOTS, 2);
    const { assert!(<Order as FreeEnergy<f64>>::THERMAL) };
}

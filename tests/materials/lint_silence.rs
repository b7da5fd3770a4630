//! Generated code triggers no lint in the crate of the user, however strict that crate is.

// With `future_incompatible`, which only the root of a crate can deny.
#![deny(warnings)]
#![deny(
    let_underscore,
    nonstandard_style,
    rust_2018_idioms,
    unused,
    missing_docs,
    missing_debug_implementations,
    non_snake_case,
    single_use_lifetimes,
    trivial_casts,
    trivial_numeric_casts,
    unreachable_pub,
    unsafe_code,
    unused_lifetimes,
    unused_qualifications,
    unused_results,
    variant_size_differences
)]
#![deny(clippy::all, clippy::pedantic, clippy::nursery)]

use eem::FreeEnergy;

/// The model with everything: dashpots, temperature, powers, functions.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    let strain = ln(lambda / natural_length);
    let elastic = 0.123_456_789 * stiffness * strain.powi(2) - coupling * (theta - 300) * strain;
    elastic + branch * (lambda - gamma).powi(4) + capacity * (theta - theta * ln(theta / 300))
        - 0.1 * gamma * diff(elastic, lambda) + theta.powf(1.25) * tanh(strain)
})]
#[viscosity(gamma = eta * exp(activation / theta))]
pub struct Spring {
    /// Length at rest, m.
    pub natural_length: f64,
    /// Stiffness, J.
    pub stiffness: f64,
    /// Thermoelastic coupling, J/K.
    pub coupling: f64,
    /// Stiffness of the branch, N/m³.
    pub branch: f32,
    /// Heat capacity, J/K.
    pub capacity: f64,
    /// Viscosity at high temperature, N s/m.
    pub eta: f64,
    /// Activation temperature, K.
    pub activation: f64,
}

/// The model with nothing.
#[derive(Clone, Copy, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch| stiffness * lambda)]
pub struct Bare<T> {
    stiffness: T,
}

/// No parameters at all.
#[derive(Clone, Copy, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch| lambda.powi(2) / 2)]
pub struct Unit;

/// Dashpots without temperature, and a number that is no parameter.
#[derive(Clone, Copy, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, a: Viscous, b: Viscous| k * (lambda - a - b).powi(2))]
#[viscosity(a = 2, b = eta)]
pub struct Viscous {
    k: f64,
    eta: f64,
    #[free_energy(unused)]
    /// Density, kg/m³.
    pub density: f64,
}

/// Temperature without dashpots, in the scalar of the struct.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| k * theta * lambda - c * theta * ln(theta))]
pub struct Entropic<'a, T: Clone, const N: usize>
where
    [T; N]: Sized,
{
    k: T,
    c: T,
    /// Name, for humans.
    pub name: &'a [&'a str; N],
}

#[test]
fn strict_functions_can_derive() {
    #[derive(FreeEnergy)]
    #[free_energy(|lambda: Stretch| lambda / 2)]
    struct Local;
    assert!((Local.free_energy(&[4.0_f64]) - 2.0).abs() < f64::EPSILON);
}

#[test]
fn strict_crates_can_derive() {
    let bare = Bare { stiffness: 2.0_f64 };
    assert!((bare.free_energy(&[3.0]) - 6.0).abs() < f64::EPSILON);
    assert!((Unit.free_energy(&[2.0_f64]) - 2.0).abs() < f64::EPSILON);
    let viscous = Viscous {
        k: 1.0,
        eta: 3.0,
        density: 0.0,
    };
    assert!((viscous.viscosity(0.0_f64).0[1] - 3.0).abs() < f64::EPSILON);
    let entropic = Entropic {
        k: 2.0_f64,
        c: 1.0,
        name: &["rubber"],
    };
    assert!((entropic.free_energy(&[3.0, 1.0]) - 6.0).abs() < f64::EPSILON);
}

//! Generated code means the same wherever it stands: without the prelude, below names that look
//! like those of the standard library, and with fields that look like generated names.

#![no_implicit_prelude]
#![allow(non_camel_case_types, dead_code)]
// The data are chosen so that every result is exact.
#![allow(clippy::float_cmp)]

/// Names that generated code must not find.
mod shadows {
    pub(crate) mod core {}
    pub(crate) mod std {}
    pub(crate) mod eem {}
    pub(crate) mod kernel {}
    pub(crate) struct Array;
    pub(crate) struct Caloric;
    pub(crate) struct From;
    pub(crate) struct Option;
    pub(crate) struct Self_;
    pub(crate) struct Strain;
    pub(crate) trait StrainEnergy {}
    pub(crate) struct bool;
    pub(crate) struct f64;
    pub(crate) struct str;
    pub(crate) struct usize;
    pub(crate) trait Scalar {}
    pub(crate) fn ln() {}
    pub(crate) fn diff() {}
}

/// A way to the crate that does not start with its name.
mod facade {
    pub(crate) use ::eem as energies;
}

mod no_prelude {
    #[allow(unused_imports)]
    use crate::hygiene::shadows::{
        Array, Caloric, From, Option, Scalar, Strain, StrainEnergy, bool, core, diff, eem, f64,
        kernel, ln, std, str, usize,
    };

    #[derive(::eem::FreeEnergy)]
    #[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
        let strain = ln(lambda / length);
        k * (strain.powi(2) + (lambda - gamma).powi(4)) + diff(strain * theta, lambda)
            - c * theta * (ln(theta / 300) - 1) + theta.powf(1.5) * tanh(strain)
    })]
    #[viscosity(gamma = eta * exp(300 / theta))]
    pub(crate) struct Spring {
        pub(crate) length: ::core::primitive::f64,
        pub(crate) k: ::core::primitive::f64,
        pub(crate) c: ::core::primitive::f32,
        pub(crate) eta: ::core::primitive::f64,
    }
}

mod solid_without_prelude {
    #[allow(unused_imports)]
    use crate::hygiene::shadows::{
        Array, Caloric, Scalar, Strain, StrainEnergy, bool, core, eem, f64, usize,
    };

    #[derive(::eem::FreeEnergy)]
    #[free_energy(|e1: StrainTrace, e2: StrainSquare| 0.5 * la * e1.powi(2) + mu * e2)]
    pub(crate) struct Solid {
        pub(crate) la: ::core::primitive::f64,
        pub(crate) mu: ::core::primitive::f64,
    }
}

mod renamed_crate {
    #[derive(::eem::FreeEnergy)]
    #[free_energy(crate = ::renamed, |lambda: Stretch| 0.5 * k * lambda.powi(2))]
    pub(crate) struct Renamed {
        pub(crate) k: f64,
    }

    #[derive(::eem::FreeEnergy)]
    #[free_energy(crate = crate::hygiene::facade::energies)]
    #[free_energy(|lambda: Stretch| 0.5 * k * lambda.powi(2))]
    pub(crate) struct Reexported {
        pub(crate) k: f64,
    }
}

/// Fields with the names that generated functions use, and names with versions.
#[derive(::eem::FreeEnergy)]
#[free_energy(|x: Stretch, x1: Viscous, theta: Temperature| {
    let __v1 = __v0 * (x - x0) * (x - __old);
    __v1 + x_0 * x1 * x + theta0 * theta_1 * (theta - theta * ln(theta)) + s0 * s * s1 * x
        + __index * r#type * x
})]
#[viscosity(x1 = __x + __theta / theta)]
struct Names {
    x0: f64,
    x_0: f64,
    __v0: f64,
    __x: f64,
    __old: f64,
    __theta: f64,
    __index: f64,
    theta0: f64,
    theta_1: f64,
    s: f64,
    s0: f64,
    s1: f64,
    r#type: f64,
}

const NAMES: Names = Names {
    x0: 1.5,
    x_0: 0.25,
    __v0: 8.0,
    __x: 2.0,
    __old: 0.5,
    __theta: 600.0,
    __index: 3.0,
    theta0: 0.5,
    theta_1: 2.0,
    s: 0.25,
    s0: 2.0,
    s1: 4.0,
    r#type: 5.0,
};

use ::std::assert_eq;
use ::std::prelude::rust_2024::test;

#[test]
fn models_work_without_the_prelude() {
    let spring = no_prelude::Spring {
        length: 1.0,
        k: 2.0,
        c: 1.5,
        eta: 7.0,
    };
    let psi: f64 = ::eem::FreeEnergy::free_energy(&spring, &[1.0, 1.0, 300.0]);
    // ln 1 = 0, tanh 0 = 0; diff(ln(λ/L) θ, λ) = θ/λ = 300; −1.5·300·(−1) = 450.
    assert_eq!(psi, 750.0);
    let (eta, _): ([f64; 1], _) = ::eem::FreeEnergy::viscosity(&spring, 300.0);
    assert_eq!(eta, [7.0 * ::eem::Scalar::exp(1.0_f64)]);
}

#[test]
fn solids_work_without_the_prelude() {
    let solid = solid_without_prelude::Solid { la: 4.0, mu: 2.0 };
    let psi: f64 = ::eem::FreeEnergy::free_energy(&solid, &[0.5, 0.25]);
    assert_eq!(psi, 1.0);
    let strains = <solid_without_prelude::Solid as ::eem::StrainEnergy<2>>::STRAINS;
    assert_eq!(strains, [::eem::Strain::Trace, ::eem::Strain::Square]);
}

#[test]
fn the_path_of_the_crate_can_be_given() {
    let renamed = renamed_crate::Renamed { k: 4.0 };
    let reexported = renamed_crate::Reexported { k: 4.0 };
    let x = [3.0_f64];
    assert_eq!(::eem::FreeEnergy::free_energy(&renamed, &x), 18.0);
    assert_eq!(::eem::FreeEnergy::gradient(&reexported, &x), [12.0]);
}

#[test]
fn field_names_do_not_meet_generated_names() {
    let x = [2.0_f64, 1.0, 1.0];
    // 8·0.5·1.5 + 0.25·1·2 + 0.5·2·(1 − 0) + 2·0.25·4·2 + 3·5·2
    let psi = ::eem::FreeEnergy::free_energy(&NAMES, &x);
    assert_eq!(psi, 6.0 + 0.5 + 1.0 + 4.0 + 30.0);
    let (eta, _): ([f64; 1], _) = ::eem::FreeEnergy::viscosity(&NAMES, 300.0);
    assert_eq!(eta, [4.0]);
    let names = <Names as ::eem::FreeEnergy<f64>>::PARAMETERS;
    assert_eq!(names.len(), 13);
    assert_eq!(names[12], "type");
    let value: f64 = ::eem::FreeEnergy::parameter(&NAMES, 12);
    assert_eq!(value, 5.0);
}

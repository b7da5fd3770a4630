//! Constants of the program and arrays of parameters: the same material as one with a field for every
//! number, bit for bit.

use eem::prelude::*;
use eem::{Array, SceneError};

const R: f64 = 8.25;
/// Smaller types that are an `f64` without loss.
const HALF: f32 = 0.5;
const THREE: i32 = 3;

mod gas {
    pub(super) const R: f64 = 0.75;
    pub(super) mod inner {
        pub(in super::super) const MOLES: f64 = 1.5;
    }
}

/// Everything at once: constants by bare name, by path, of the type and of `std`, and arrays.
#[derive(Clone, FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    let strain = ln(lambda / length);
    let branch = strain - gamma;
    HALF * stiffness[0] * strain.powi(2) + stiffness[2] * strain.powi(4) / THREE
        + stiffness[1] * branch.powi(2) * PI
        + coupling[0] * gas::R * ::std::f64::consts::TAU * strain * theta / theta_ref
        + gas::inner::MOLES * R * (theta - theta * ln(theta / theta_ref))
})]
#[viscosity(gamma = (viscous[0] + viscous[1]) * (theta_ref / theta).powf(Self::EXPONENT) * self::gas::inner::MOLES)]
struct Named {
    length: f64,
    stiffness: [f64; 3],
    coupling: [f32; 1],
    theta_ref: f64,
    #[free_energy(unused)]
    #[allow(dead_code, reason = "no parameter")]
    history: [f64; 2],
    viscous: [f64; 2],
    #[allow(dead_code, reason = "no parameter")]
    _spare: [f64; 2],
}

impl Named {
    const EXPONENT: f64 = 1.5;
}

/// The same with fields, in the order in which `Named` counts its parameters.
#[derive(Clone, FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    let strain = ln(lambda / length);
    let branch = strain - gamma;
    half * stiffness_0 * strain.powi(2) + stiffness_2 * strain.powi(4) / three
        + stiffness_1 * branch.powi(2) * 3.141592653589793
        + coupling_0 * gas_r * 6.283185307179586 * strain * theta / theta_ref
        + moles * r * (theta - theta * ln(theta / theta_ref))
})]
#[viscosity(gamma = (viscous_0 + viscous_1) * (theta_ref / theta).powf(exponent) * moles_again)]
struct Fields {
    length: f64,
    stiffness_0: f64,
    stiffness_1: f64,
    stiffness_2: f64,
    coupling_0: f32,
    theta_ref: f64,
    viscous_0: f64,
    viscous_1: f64,
    half: f64,
    three: f64,
    gas_r: f64,
    moles: f64,
    r: f64,
    exponent: f64,
    moles_again: f64,
}

fn named() -> Named {
    Named {
        length: 1.1,
        stiffness: [20.0, 7.0, 3.0],
        coupling: [0.3],
        theta_ref: 300.0,
        history: [f64::NAN; 2],
        viscous: [0.5, 2.5],
        _spare: [f64::NAN; 2],
    }
}

fn fields() -> Fields {
    Fields {
        length: 1.1,
        stiffness_0: 20.0,
        stiffness_1: 7.0,
        stiffness_2: 3.0,
        coupling_0: 0.3,
        theta_ref: 300.0,
        viscous_0: 0.5,
        viscous_1: 2.5,
        half: 0.5,
        three: 3.0,
        gas_r: 0.75,
        moles: 1.5,
        r: 8.25,
        exponent: 1.5,
        moles_again: 1.5,
    }
}

/// All that a model computes, as text with all digits.
fn everything<M: FreeEnergy<f64>>(model: &M) -> String {
    fn array<A: Array<f64>>(numbers: &[f64]) -> A {
        let mut array = A::filled(0.0);
        for (entry, &number) in array.as_mut().iter_mut().zip(numbers) {
            *entry = number;
        }
        array
    }
    let (x0, x1) = (array(&[1.3, 0.1, 310.0]), array(&[1.4, 0.15, 312.0]));
    let corners = array(&[311.0, 309.0, 310.5, 311.5]);
    let values = [
        model.free_energy(&x0),
        model.energy_magnitude(&x0),
        model.internal_energy(&x0),
    ];
    let entropy_form = model.entropy_form(&model.entropy_form_old(&x0), &x1, &corners);
    let temperature_form = model.temperature_form(&model.temperature_form_old(&x0), &x1);
    format!(
        "{values:?} {:?} {:?} {:?} {:?} {:?} {entropy_form:?} {temperature_form:?}",
        model.gradient(&x0),
        model.hessian(&x0),
        model.caloric(&x0),
        model.entropy_hessian(&x0),
        model.viscosity(310.0),
    )
}

#[test]
fn names_stand_for_their_numbers() {
    let (named, fields) = (named(), fields());
    assert_eq!(everything(&named), everything(&fields));
    assert!(!everything(&named).contains("NaN"));
}

#[test]
fn a_number_that_differs_by_a_millionth_is_noticed() {
    let mut other = fields();
    other.r *= 1.0 + 1e-6;
    assert_ne!(everything(&named()), everything(&other));
    let mut other = named();
    other.stiffness[2] *= 1.0 + 1e-6;
    assert_ne!(everything(&other), everything(&fields()));
}

/// A scalar of its own in an array, and a constant of the same name as a field.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k[0] * lambda + k[1] * lambda.powi(2) * R / self::R)]
#[allow(non_snake_case, reason = "the name of the constant")]
struct Generic<T> {
    k: [T; 2],
    R: T,
}

#[test]
fn arrays_can_have_the_scalar() {
    let model = Generic {
        k: [2.0, 3.0],
        R: 16.5,
    };
    assert_eq!(model.free_energy(&[2.0]).to_bits(), 28.0_f64.to_bits());
    let names = <Generic<f64> as FreeEnergy<f64>>::PARAMETERS;
    assert_eq!(names, ["k[0]", "k[1]", "R", "self::R"]);
}

#[test]
fn constants_have_the_shortest_name_that_is_free() {
    let names = [
        "length",
        "stiffness[0]",
        "stiffness[1]",
        "stiffness[2]",
        "coupling[0]",
        "theta_ref",
        "viscous[0]",
        "viscous[1]",
        "HALF",
        "THREE",
        "gas::R",
        "gas::inner::MOLES",
        "R",
        "EXPONENT",
        "self::gas::inner::MOLES",
    ];
    assert_eq!(<Named as FreeEnergy<f64>>::PARAMETERS, names);
}

/// With units: those of the constants stand on the struct.
#[derive(Clone, FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    MOLES * gas::R * theta * (0.5 * (lambda / length[1]).powi(2) - ln(lambda / length[0]) - HALF * ln(theta / theta_ref) * PI)
})]
#[unit(gas::R = "J/(mol K)", MOLES = "mol")]
struct Measured {
    #[unit("m")]
    length: [f64; 2],
    #[unit("K")]
    theta_ref: f64,
}

const MOLES: f64 = f64::NAN;

#[test]
fn the_description_has_the_units() {
    let units = Measured::DESCRIPTION
        .parameters
        .iter()
        .map(|p| (p.name, p.unit));
    let expected = [
        ("length[0]", "m"),
        ("length[1]", "m"),
        ("theta_ref", "K"),
        ("MOLES", "mol"),
        ("R", "J/(mol K)"),
        ("HALF", "1"),
    ];
    assert!(units.eq(expected.map(|(name, unit)| (name, Some(unit)))));
    let psi = Measured::DESCRIPTION.equation("ψ").unwrap();
    assert!(psi.contains("length[1]") && psi.contains("*R"), "{psi}");
}

#[test]
fn a_constant_without_a_value_is_refused_by_name() {
    let mut scene = Scene::<2>::new();
    let ends = [
        scene.anchor([0.0, 0.0]),
        scene.mass(1.0, [1.0, 0.0], [0.0; 2]),
    ];
    let model = Measured {
        length: [1.0; 2],
        theta_ref: 300.0,
    };
    let spring = scene.spring(model, ends);
    scene.set_temperature(spring, 300.0);
    let refused = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap_err();
    let [SceneError::Parameter { parameter, .. }] = refused.errors() else {
        panic!("{refused}")
    };
    assert_eq!(*parameter, "MOLES");
}

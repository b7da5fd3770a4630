//! The golden expansions compile and compute what the formulas say.

#![allow(missing_docs, clippy::pedantic)]

extern crate energies as eem;

use eem::{FreeEnergy as _, Strain, StrainEnergy as _};

pub struct ElasticSpring {
    pub stiffness: f64,
    pub length: f64,
}
include!("../src/tests/golden/elastic_spring.rs");

#[test]
fn elastic_spring() {
    let spring = ElasticSpring {
        stiffness: 4.0,
        length: 1.0,
    };
    assert_eq!(spring.free_energy(&[3.0_f64]), 8.0);
    assert_eq!(spring.gradient(&[3.0_f64]), [8.0]);
    let old = spring.entropy_form_old(&[2.0_f64]);
    // (ψ(3) − ψ(2))/(3 − 2) and its derivative
    assert_eq!(spring.entropy_form(&old, &[3.0], &[]), ([6.0], [[2.0]]));
}

pub struct ElasticSolid {
    pub la: f64,
    pub mu: f64,
}
include!("../src/tests/golden/elastic_solid.rs");

#[test]
fn elastic_solid() {
    let solid = ElasticSolid { la: 4.0, mu: 2.0 };
    assert_eq!(<ElasticSolid as eem::FreeEnergy<f64>>::MEASURES, 2);
    const { assert!(<ElasticSolid as eem::FreeEnergy<f64>>::PER_VOLUME) }
    assert_eq!(ElasticSolid::STRAINS, [Strain::Trace, Strain::Square]);
    assert_eq!(solid.free_energy(&[0.5_f64, 0.25]), 1.0);
    assert_eq!(solid.gradient(&[0.5_f64, 0.25]), [2.0, 2.0]);
    let old = solid.entropy_form_old(&[0.5_f64, 0.25]);
    // ½·4·(1 + ½), 2
    let (response, tangent) = solid.entropy_form(&old, &[1.0, 0.5], &[]);
    assert_eq!(response, [3.0, 2.0]);
    assert_eq!(tangent, [[2.0, 0.0], [0.0, 0.0]]);
}

pub struct ThermoViscoElasticSpring {
    pub stiffness: f64,
    pub branch: f64,
    pub length: f64,
    pub coupling: f64,
    pub capacity: f64,
    pub theta_ref: f64,
    pub eta_ref: f64,
    pub activation: f64,
}
include!("../src/tests/golden/thermo_visco_elastic_spring.rs");

/// Numbers that are small sums of powers of two, so that formulas have exact values.
const SPRING: ThermoViscoElasticSpring = ThermoViscoElasticSpring {
    stiffness: 4.0,
    branch: 2.0,
    length: 1.0,
    coupling: 0.5,
    capacity: 8.0,
    theta_ref: 256.0,
    eta_ref: 3.0,
    activation: 512.0,
};

#[test]
fn thermo_visco_elastic_spring() {
    let x = [3.0_f64, 0.5, 256.0];
    // ½·4·2² + ½·2·1.5²; f = 4·2 + 2·1.5, ∂ψ/∂γ = −2·1.5, s = 0.5·2
    assert_eq!(SPRING.free_energy(&x), 10.25);
    assert_eq!(SPRING.gradient(&x), [11.0, -3.0, -1.0]);
    assert_eq!(SPRING.internal_energy(&x), 10.25 + 256.0);
    let (viscosity, slope) = SPRING.viscosity(256.0);
    // dη/dθ = −η a/θ²
    assert_eq!((viscosity, slope), ([3.0], [-3.0 * 512.0 / 65536.0]));
}

/// Δe = f* Δλ − g* Δγ + θ* Δs, and Δs is what the entropy does.
#[test]
fn thermo_visco_elastic_spring_keeps_its_energy() {
    let (x0, x1) = ([1.25_f64, 0.125, 300.0], [1.5, 0.25, 310.0]);
    let old = SPRING.temperature_form_old(&x0);
    let ([f, g, theta, entropy], _) = SPRING.temperature_form(&old, &x1);
    let response = SPRING.temperature_form_response(&old, &x1);
    assert_eq!(response, [f, g, theta, entropy]);
    let change = SPRING.internal_energy(&x1) - SPRING.internal_energy(&x0);
    let work = f * (x1[0] - x0[0]) - g * (x1[1] - x0[1]) + theta * entropy;
    assert!(
        (work - change).abs() < 1e-12 * change,
        "{work}, not {change}"
    );
    let entropies = [x0, x1].map(|x| SPRING.caloric(&x).entropy);
    let difference = entropies[1] - entropies[0];
    assert!((entropy - difference).abs() < 1e-14);
}

//! The golden expansions compile and compute what the formulas say.

#![allow(missing_docs, clippy::pedantic)]

extern crate energies as eem;

use eem::FreeEnergy as _;

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

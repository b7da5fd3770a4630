//! The derive works where the crate `eem` has another name.

#![allow(missing_docs)]

extern crate eem as energies;
// Generated code that relied on the name `eem` would find the wrong crate.
extern crate core as eem;

use energies::{FreeEnergy, Strain, StrainEnergy as _};

#[derive(FreeEnergy)]
#[free_energy(crate = ::energies, |lambda: Stretch, theta: Temperature| {
    stiffness * theta * lambda.powi(2) - theta * ln(theta)
})]
struct Spring {
    stiffness: f64,
}

mod inner {
    pub(crate) use ::energies as renamed_again;
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| stiffness * lambda.powi(2))]
#[free_energy(crate = crate::inner::renamed_again)]
struct Separate {
    stiffness: f64,
}

#[derive(FreeEnergy)]
#[free_energy(crate = ::energies, |j: Dilatation| 0.5 * bulk * ln_1p(j).powi(2))]
struct Solid {
    bulk: f64,
}

#[test]
fn a_renamed_crate_is_found() {
    let spring = Spring { stiffness: 2.0 };
    assert!((spring.free_energy(&[3.0_f64, 1.0]) - 18.0).abs() < 1e-14);
    let solid = Solid { bulk: 2.0 };
    assert!(solid.free_energy(&[0.0_f64]).abs() <= 0.0);
    assert_eq!(Solid::STRAINS, [Strain::Dilatation]);
    let separate = Separate { stiffness: 2.0 };
    assert!((separate.free_energy(&[3.0_f64]) - 18.0).abs() < 1e-14);
}

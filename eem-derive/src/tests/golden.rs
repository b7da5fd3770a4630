//! Expansions of short models, word for word.
//!
//! `EEM_BLESS=1 cargo test -p eem-derive` rewrites them; `tests/golden.rs` compiles and runs them.

use std::path::Path;

use quote::quote;

use super::{expand, pretty};

fn compare(name: &str, found: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("src/tests/golden")
        .join(name);
    if std::env::var_os("EEM_BLESS").is_some() {
        std::fs::write(&path, found).expect("the golden file can be written");
    }
    let golden = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        golden == found,
        "{name} differs; EEM_BLESS=1 accepts this:\n{found}"
    );
}

#[test]
fn elastic_spring() {
    let item = quote! {
        #[free_energy(|lambda: Stretch| 0.5 * stiffness * (lambda - length).powi(2))]
        pub struct ElasticSpring {
            pub stiffness: f64,
            pub length: f64,
        }
    };
    compare("elastic_spring.rs", &pretty(expand(item)));
}

#[test]
fn thermo_visco_elastic_spring() {
    let item = quote! {
        #[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
            let stretch = lambda - length;
            let heating = theta - theta_ref;
            0.5 * stiffness * stretch.powi(2) + 0.5 * branch * (stretch - gamma).powi(2)
                - coupling * heating * stretch
                + capacity * (heating - theta * ln(theta / theta_ref))
        })]
        #[viscosity(gamma = eta_ref * exp(activation * (1 / theta - 1 / theta_ref)))]
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
    };
    compare("thermo_visco_elastic_spring.rs", &pretty(expand(item)));
}

#[test]
fn elastic_solid() {
    let item = quote! {
        #[free_energy(|e1: StrainTrace, e2: StrainSquare| 0.5 * la * e1.powi(2) + mu * e2)]
        pub struct ElasticSolid {
            #[unit("Pa")]
            pub la: f64,
            #[unit("Pa")]
            pub mu: f64,
        }
    };
    compare("elastic_solid.rs", &pretty(expand(item)));
}

#[test]
fn formulas_of_the_pendulum() {
    let expansion = pretty(expand(super::pendulum()));
    let lines = expansion.lines().map(str::trim_start);
    let docs = lines
        .skip_while(|line| !line.starts_with("///"))
        .take_while(|line| line.starts_with("///"));
    let docs: Vec<&str> = docs.collect();
    let docs = docs.join("\n") + "\n";
    compare("pendulum_docs.txt", &docs);
}

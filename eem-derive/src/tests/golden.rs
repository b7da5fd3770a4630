//! Expansions of short models, word for word.
//!
//! `EEM_BLESS=1 cargo test -p eem-derive` rewrites them; `tests/golden.rs` compiles and runs them.

use std::path::Path;

use proc_macro2::TokenStream;
use quote::quote;

use super::{expand, pretty};

fn check(name: &str, item: TokenStream) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/tests/golden").join(name);
    let expansion = pretty(expand(item));
    if std::env::var_os("EEM_BLESS").is_some() {
        std::fs::write(&path, &expansion).expect("the golden file can be written");
    }
    let golden = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        golden == expansion,
        "{name} differs; EEM_BLESS=1 accepts this expansion:\n{expansion}"
    );
}

#[test]
fn elastic_spring() {
    check(
        "elastic_spring.rs",
        quote! {
            #[free_energy(|lambda: Stretch| 0.5 * stiffness * (lambda - length).powi(2))]
            pub struct ElasticSpring {
                pub stiffness: f64,
                pub length: f64,
            }
        },
    );
}

#[test]
fn maxwell_element() {
    check(
        "maxwell_element.rs",
        quote! {
            #[free_energy(|lambda: Stretch, gamma: Viscous| stiffness * (lambda - gamma).powi(2))]
            #[viscosity(gamma = eta)]
            pub struct MaxwellElement<T> {
                pub stiffness: T,
                pub eta: T,
            }
        },
    );
}

//! Expansions of short models, word for word: each form that is printed, once.
//!
//! `EEM_BLESS=1 cargo test -p eem-language` rewrites them. That such code compiles and computes what the formulas say is
//! tested wherever a model is derived.

use std::path::Path;

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use syn::{Block, Expr, ImplItem, Item, ItemConst, ItemImpl};

use super::{expand, expand_with_gradients, pretty};

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
    assert!(found.lines().count() < 150, "{name} is too long to be read");
}

/// The expansion of a model with these items of its implementations only, without the implementations that have none
/// of them. `*` is everything but functions.
fn excerpt(model: TokenStream, wanted: &[&str]) -> String {
    excerpt_of(expand(model), wanted)
}

fn excerpt_of(expansion: TokenStream, wanted: &[&str]) -> String {
    let mut missing = wanted.to_vec();
    let mut keep = |item: &ImplItem| {
        let name = match item {
            ImplItem::Fn(function) => function.sig.ident.to_string(),
            _ => "*".to_owned(),
        };
        missing.retain(|wanted| *wanted != name);
        wanted.contains(&name.as_str())
    };
    let file: syn::File = syn::parse2(expansion).expect("the expansion is Rust");
    let mut shown = TokenStream::new();
    for item in file.items {
        for mut implementation in implementations(item) {
            implementation.items.retain(&mut keep);
            if !implementation.items.is_empty() {
                implementation.to_tokens(&mut shown);
            }
        }
    }
    assert!(missing.is_empty(), "not there: {missing:?}");
    pretty(shown)
}

/// The implementations inside of `const _: () = { … };`.
fn implementations(item: Item) -> Vec<ItemImpl> {
    let Item::Const(ItemConst { expr, .. }) = item else {
        panic!("only constants are generated");
    };
    let Expr::Block(syn::ExprBlock {
        block: Block { stmts, .. },
        ..
    }) = *expr
    else {
        panic!("a constant with a block is generated");
    };
    let implementations = stmts.into_iter().filter_map(|statement| match statement {
        syn::Stmt::Item(Item::Impl(implementation)) => Some(implementation),
        _ => None,
    });
    implementations.collect()
}

fn elastic() -> TokenStream {
    quote! {
        #[free_energy(|lambda: Stretch| 0.5 * stiffness * (lambda - length).powi(2))]
        pub struct Elastic {
            pub stiffness: f64,
            pub length: f64,
        }
    }
}

fn thermal() -> TokenStream {
    quote! {
        #[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
            0.5 * k * (lambda - gamma).powi(2) - c * theta * ln(theta)
        })]
        #[viscosity(gamma = eta * exp(activation / theta), lambda = eta)]
        pub struct Thermal { k: f64, c: f64, eta: f64, activation: f64 }
    }
}

#[test]
fn frame() {
    let whole = pretty(expand(elastic()));
    let frame = whole.split_once("const MEASURES");
    compare("frame.txt", frame.expect("there is an implementation").0);
}

#[test]
fn without_temperature_and_dashpot() {
    let functions = [
        "*",
        "free_energy",
        "caloric",
        "entropy_hessian",
        "viscosity",
        "drag",
        "temperature_form",
    ];
    compare("elastic.rs", &excerpt(elastic(), &functions));
}

#[test]
fn functions_of_a_state() {
    let functions = [
        "hessian",
        "caloric",
        "rates",
        "entropy_hessian",
        "viscosity",
        "drag",
    ];
    compare("state.rs", &excerpt(thermal(), &functions));
}

#[test]
fn functions_of_the_temperature_alone() {
    compare(
        "temperature.rs",
        &excerpt(thermal(), &["caloric_at", "rates_at"]),
    );
}

#[test]
fn forms_of_a_step() {
    let functions = ["temperature_form_old", "temperature_form"];
    compare("step.rs", &excerpt(thermal(), &functions));
}

#[test]
fn derivatives_by_parameters() {
    let functions = [
        "entropy_form_adjoint",
        "temperature_form_tangent",
        "gradient_adjoint",
        "energy_by_parameters",
        "viscosity_adjoint",
        "drag_adjoint",
    ];
    let model = quote! {
        #[free_energy(|lambda: Stretch, gamma: Viscous| 0.5 * k * (lambda - gamma).powi(2))]
        #[viscosity(gamma = eta)]
        pub struct Maxwell { k: f64, eta: f64 }
    };
    compare(
        "parameters.rs",
        &excerpt_of(expand_with_gradients(model), &functions),
    );
}

#[test]
fn form_with_corners() {
    let functions = ["entropy_form_old", "entropy_form_response", "mixed_states"];
    compare("corners.rs", &excerpt(thermal(), &functions));
}

#[test]
fn solid_with_a_viscous_strain() {
    // One scalar, an array, a number of another type, a constant.
    let model = quote! {
        #[free_energy(|e2: StrainSquare, m3: ViscousStrain, m2: ViscousSquare, j: Dilatation| {
            mu * (e2 + m2 - 2 * m3) + bulk[0] * ln_1p(j) + bulk[1] * NU * j * j
        })]
        #[viscosity(m3 = eta)]
        pub struct Flowing<T> { mu: T, bulk: [T; 2], eta: f32 }
    };
    compare(
        "solid.rs",
        &excerpt(model, &["*", "parameter", "duplicate", "at_point"]),
    );
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

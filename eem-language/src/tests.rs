//! Expansions, looked at from inside: what the compile-fail tests cannot see.

use proc_macro2::{TokenStream, TokenTree};
use quote::quote;
use syn::{DeriveInput, parse_quote};

mod catalogue;
mod golden;
mod mutation;
mod text;
mod units;

/// The expansion of an item.
fn expand(item: TokenStream) -> TokenStream {
    let input: DeriveInput = syn::parse2(item).expect("the test item is Rust");
    crate::derive::derive_with(&input, false)
}

/// The same with derivatives by the parameters.
fn expand_with_gradients(item: TokenStream) -> TokenStream {
    let input: DeriveInput = syn::parse2(item).expect("the test item is Rust");
    crate::derive::derive_with(&input, true)
}

/// The expansion as readable source.
fn pretty(tokens: TokenStream) -> String {
    let file: syn::File = syn::parse2(tokens).expect("the expansion is Rust");
    prettyplease::unparse(&file)
}

fn spring() -> TokenStream {
    quote! {
        #[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
            let strain = ln(lambda / length);
            k * (strain.powi(2) + (lambda - gamma).powi(4)) - c * theta * ln(theta / 300)
        })]
        #[viscosity(gamma = eta * exp(300 / theta))]
        struct Spring {
            length: f64,
            k: f64,
            c: f64,
            eta: f64,
        }
    }
}

/// The thermo-visco-elastic pendulum of García Orden & Romero (2012), §4.1, and its units.
pub(crate) fn pendulum() -> TokenStream {
    quote! {
        #[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
            let strain = ln(lambda / length);
            let k = k0 - k1 * (theta - theta_ref);
            let mu = mu0 - mu1 * (theta - theta_ref);
            let psi_e = 0.5 * k * strain.powi(2) - beta * (theta - theta_ref) * strain
                + capacity * (theta - theta_ref - theta * ln(theta / theta_ref));
            (1.0 + ratio) * psi_e + mu * gamma.powi(2) - ratio * gamma * diff(psi_e, lambda)
        })]
        #[viscosity(gamma = eta0 * exp(activation * (1.0 / theta - 1.0 / theta_ref)))]
        struct Pendulum {
            #[unit("m")] length: f64,
            #[unit("J")] k0: f64,
            #[unit("J/K")] k1: f64,
            #[unit("1")] ratio: f64,
            #[unit("J/K")] beta: f64,
            #[unit("J/K")] capacity: f64,
            #[unit("N/m")] mu0: f64,
            #[unit("N/(m K)")] mu1: f64,
            #[unit("N s/m")] eta0: f64,
            #[unit("K")] activation: f64,
            #[unit("K")] theta_ref: f64,
        }
    }
}

#[test]
fn the_same_input_gives_the_same_code() {
    assert_eq!(
        expand(pendulum()).to_string(),
        expand(pendulum()).to_string()
    );
}

#[test]
fn every_absolute_path_starts_at_the_crate() {
    let item = spring();
    let renamed = quote! { #[free_energy(crate = ::somewhere::energies)] #item };
    let mut roots = Vec::new();
    absolute_roots(expand(renamed), &mut roots);
    assert_eq!(roots, ["somewhere"]);
}

/// The first names of all paths with a leading `::`.
fn absolute_roots(tokens: TokenStream, roots: &mut Vec<String>) {
    let mut before = None;
    let mut tokens = tokens.into_iter().peekable();
    while let Some(token) = tokens.next() {
        match &token {
            TokenTree::Group(group) => absolute_roots(group.stream(), roots),
            TokenTree::Punct(colon) if colon.as_char() == ':' => {
                let pair = matches!(tokens.peek(), Some(TokenTree::Punct(p)) if p.as_char() == ':');
                let relative = matches!(&before, Some(TokenTree::Ident(i)) if i != "use")
                    || matches!(&before, Some(TokenTree::Punct(p)) if p.as_char() == '>');
                if pair {
                    tokens.next();
                }
                if pair && !relative {
                    roots.extend(tokens.peek().map(ToString::to_string));
                }
            }
            _ => {}
        }
        before = Some(token);
    }
}

#[test]
fn a_wrong_model_implements_the_trait() {
    let expansion = pretty(expand(quote! {
        #[free_energy(|lambda: Stretch| stifness * lambda)]
        struct Spring<T: Copy> {
            stiffness: T,
        }
    }));
    assert!(expansion.contains("unknown name `stifness`"));
    assert!(expansion.contains("help: did you mean `stiffness`?"));
    assert!(expansion.contains("__eem::FreeEnergy<__S> for Spring<T>"));
}

#[test]
fn numbers_are_exact_until_they_are_printed() {
    // 0.1 + 0.2 is three tenths, not what the sum of two floats is.
    let expansion = pretty(expand(quote! {
        #[free_energy(|lambda: Stretch| (0.1 + 0.2) * lambda + 1 / 4 * lambda)]
        struct Spring {}
    }));
    assert!(expansion.contains("from_f64(0.55)"), "{expansion}");
}

#[test]
fn only_solids_are_per_volume() {
    let solid = pretty(expand(quote! {
        #[free_energy(|theta: Temperature, j: Dilatation, e1: StrainTrace| {
            k * (j.powi(2) + e1) - c * theta * ln(theta)
        })]
        struct Solid<T: Copy> { k: T, c: f64 }
    }));
    for part in [
        "const MEASURES: __eem::core::primitive::usize = 2;",
        "const PER_VOLUME: __eem::core::primitive::bool = true;",
        "impl<T: Copy> __eem::StrainEnergy<2> for Solid<T> {",
        "[__eem::Strain::Dilatation, __eem::Strain::Trace]",
    ] {
        let squeezed: String = solid.split_whitespace().collect::<Vec<_>>().join(" ");
        let squeezed = squeezed.replace("[ ", "[").replace(", ]", "]");
        assert!(squeezed.contains(part), "{part} is not in {solid}");
    }
    let spring = pretty(expand(pendulum()));
    assert!(!spring.contains("PER_VOLUME") && !spring.contains("Strain"));
}

#[test]
fn a_wrong_solid_keeps_its_shape() {
    let solid = pretty(expand(quote! {
        #[free_energy(|j: Dilatation, e1: StrainTrace, g: Viscous| kk * j * e1 * g)]
        struct Solid { k: f64 }
    }));
    for part in [
        "const MEASURES: __eem::core::primitive::usize = 2;",
        "const PER_VOLUME: __eem::core::primitive::bool = true;",
        "type Variables = [__S; 3];",
        "impl __eem::StrainEnergy<2> for Solid {",
    ] {
        assert!(solid.contains(part), "{part} is not in {solid}");
    }
}

#[test]
fn items_without_syntax_errors_only_are_seen() {
    // The fields may be anything, also types this crate cannot know.
    let input: DeriveInput = parse_quote! {
        #[free_energy(|lambda: Stretch| k * lambda)]
        struct Spring<'a, F: Fn(f64) -> f64, const N: usize>(fn(&'a F) -> [u8; N]);
    };
    let expansion = crate::derive::derive(&input).to_string();
    assert!(expansion.contains("tuple struct"));
}

//! The macro `#[derive(FreeEnergy)]`. The implementation is in [`eem_language`].
//!
//! A proc-macro crate can export only macros, so the implementation is an ordinary library that tests, fuzz targets
//! and other programs can call.

use proc_macro::TokenStream;
use syn::{DeriveInput, parse_macro_input};

#[doc = include_str!("free_energy.md")]
#[proc_macro_derive(FreeEnergy, attributes(free_energy, viscosity, unit))]
pub fn derive_free_energy(input: TokenStream) -> TokenStream {
    let input = parse_macro_input!(input as DeriveInput);
    eem_language::derive(&input).into()
}

//! `#[derive(FreeEnergy)]`: the macro over [`eem_language`], which reads, checks and prints.
//!
//! A crate of procedural macros can export nothing but macros. What they do is therefore in a library of its own,
//! which tests, fuzz targets and programs can call.

use proc_macro::TokenStream;
use syn::{DeriveInput, parse_macro_input};

#[doc = include_str!("free_energy.md")]
#[proc_macro_derive(FreeEnergy, attributes(free_energy, viscosity, unit))]
pub fn derive_free_energy(input: TokenStream) -> TokenStream {
    let input = parse_macro_input!(input as DeriveInput);
    eem_language::derive(&input).into()
}

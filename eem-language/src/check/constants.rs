//! Constants: those of `std` have a value here, all others are resolved by Rust where the code stands.

use core::f64::consts;

use proc_macro2::{Ident, TokenStream};
use quote::ToTokens;

use crate::nearest::nearest;

/// The constants that formulas mention and Rust resolves, in order of appearance.
#[derive(Debug, Default)]
pub(super) struct Constants {
    /// Path as text and as tokens.
    mentioned: Vec<(String, TokenStream)>,
}

impl Constants {
    /// The index of the constant with exactly this path, which is added if it is new.
    pub(super) fn mention(&mut self, path: impl ToTokens) -> usize {
        let text = text(&path);
        let known = self.mentioned.iter().position(|(known, _)| *known == text);
        known.unwrap_or_else(|| {
            self.mentioned.push((text, path.into_token_stream()));
            self.mentioned.len() - 1
        })
    }

    /// The paths in order of appearance.
    pub(super) fn paths(&self) -> &[(String, TokenStream)] {
        &self.mentioned
    }
}

/// The path without blanks.
pub(crate) fn text(path: &impl ToTokens) -> String {
    path.to_token_stream().to_string().replace(' ', "")
}

/// π is known by its bare name; no other constant of `std` is, because `E` may be a modulus and `TAU` a
/// relaxation time.
pub(crate) fn bare(ident: &Ident) -> Option<f64> {
    (ident == "PI").then_some(consts::PI)
}

/// The constants of `core::f64::consts`.
const OF_STD: [(&str, f64); 19] = [
    ("PI", consts::PI),
    ("TAU", consts::TAU),
    ("E", consts::E),
    ("FRAC_1_PI", consts::FRAC_1_PI),
    ("FRAC_1_SQRT_2", consts::FRAC_1_SQRT_2),
    ("FRAC_2_PI", consts::FRAC_2_PI),
    ("FRAC_2_SQRT_PI", consts::FRAC_2_SQRT_PI),
    ("FRAC_PI_2", consts::FRAC_PI_2),
    ("FRAC_PI_3", consts::FRAC_PI_3),
    ("FRAC_PI_4", consts::FRAC_PI_4),
    ("FRAC_PI_6", consts::FRAC_PI_6),
    ("FRAC_PI_8", consts::FRAC_PI_8),
    ("LN_10", consts::LN_10),
    ("LN_2", consts::LN_2),
    ("LOG10_2", consts::LOG10_2),
    ("LOG10_E", consts::LOG10_E),
    ("LOG2_10", consts::LOG2_10),
    ("LOG2_E", consts::LOG2_E),
    ("SQRT_2", consts::SQRT_2),
];

/// The value of `core::f64::consts::NAME` and `std::f64::consts::NAME`. `None` for a constant that is newer
/// than the list: Rust resolves it.
pub(crate) fn of_std(path: &syn::Path) -> Option<f64> {
    let text = text(path);
    let text = text.strip_prefix("::").unwrap_or(&text);
    let inside = ["core::", "std::"]
        .iter()
        .find_map(|root| text.strip_prefix(root))?;
    let name = inside.strip_prefix("f64::consts::")?;
    let found = OF_STD.iter().find(|(known, _)| *known == name);
    found.map(|&(_, value)| value)
}

/// How to write the constant of `std` that was most likely meant by an unknown name.
pub(crate) fn meant(ident: &Ident) -> Option<String> {
    let nearest = nearest(&ident.to_string(), OF_STD.map(|(name, _)| name))?;
    Some(match nearest {
        "PI" => nearest.to_owned(),
        other => format!("core::f64::consts::{other}"),
    })
}

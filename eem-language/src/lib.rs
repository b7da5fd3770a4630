//! The language of free energies: from the tokens of a struct to straight-line Rust.
//!
//! The input is a struct whose fields are the parameters of a material and whose attribute is its free energy. The
//! output is one `impl FreeEnergy` and one `impl Describe`, for solids also `impl StrainEnergy`. The entry point is
//! [`derive()`]; `eem-derive` turns it into the macro `#[derive(FreeEnergy)]`, whose documentation describes the language.
//! Models that are known only when a program runs are read by [`text`], which ends with the model and its programs.
//!
//! This crate does no mathematics. It reads and checks tokens, passes a model to [`eem_symbolic`], and prints the
//! resulting programs. The phases:
//!
//! | phase | module | from → to |
//! |---|---|---|
//! | parse | `attr`, `parse` | tokens → `ast` |
//! | check | `check` | `ast` → `checked`: names resolved, roles and laws complete |
//! | units | `units` | `checked` → the units of its fields, every operation in order |
//! | model | `model` | `checked` → [`eem_symbolic::Model`]: every subexpression has a value |
//! | physics | `physics` | checks that the model can be a material |
//! | expand | `expand` | programs → tokens |
//!
//! A phase that reports an error leaves a hole, and later phases check the rest. So the errors of all phases appear
//! together, and none causes a second message. With the errors `fallback` emits an empty implementation, so that uses
//! of the model cause no further messages. `message` is the catalogue of all messages.
//!
//! ```
//! let input = syn::parse_quote! {
//!     #[free_energy(|lambda: Stretch| 0.5 * stifness * lambda.powi(2))]
//!     struct Spring {
//!         stiffness: f64,
//!     }
//! };
//! let tokens = eem_language::derive(&input).to_string();
//! assert!(tokens.contains("unknown name `stifness`"));
//! ```
//!
//! # Where to change what
//!
//! | to | look in |
//! |---|---|
//! | change the nouns of messages in texts | `dialect.rs`; `tests/text/cases.rs` compares all cases in both dialects, and lists what texts cannot say |
//! | change what only texts have | `text`; messages in `message/text.rs`, with a case each in `tests/text/words.rs` |
//! | change the syntax or a message | `parse`, `check`, `message`; a case per message in `eem-ui/tests/ui`; the reference is `eem-derive/src/free_energy.md` |
//! | add a unit, or a rule for units | `unit/table.rs`, `units/rules` |
//! | add a role of an argument | `Role` and `Strain` in `ast.rs`; the compiler then lists the phases to extend. Synonyms in `parse/closure.rs`, unit in `units/quantities.rs`, bound in `model/domain.rs` |
//! | change constants, arrays or helpers | `constants.rs`, `parameters.rs`, `helpers.rs` in `check`; `Origin` in `checked.rs` |
//! | change what a solid may do at rest | `model/rest.rs` |
//! | change the generated code | `expand`; `expand/description.rs` for `Describe` |
//! | see the generated code | `cargo run -p eem-language --example expand -- FILE` |

mod ast;
mod attr;
mod check;
mod checked;
mod ctxt;
mod derive;
mod dialect;
mod expand;
mod fallback;
mod message;
mod model;
mod nearest;
mod parse;
mod physics;
#[cfg(test)]
mod tests;
pub mod text;
mod unit;
mod units;
mod warnings;

pub use derive::derive;

//! What the compiler says about a wrong model, word for word.
//!
//! The folders are those of the catalogue of messages, and `use` is about models where they are used. Almost all
//! text here is ours, so that it depends little on the compiler. `TRYBUILD=overwrite cargo test -p eem-ui` accepts
//! what the compiler says now; review the difference.

#[test]
fn wrong_models_are_explained() {
    trybuild::TestCases::new().compile_fail("tests/ui/*/*.rs");
}

//! What the compiler says about a wrong model.
//!
//! The folders are those of the catalogue of messages, and `use` is about models where they are
//! used. Almost all text here is ours, so that it depends little on the compiler.
//! `TRYBUILD=overwrite cargo test --test ui` refreshes it.

#[test]
fn wrong_models_are_explained() {
    let cases = trybuild::TestCases::new();
    cases.compile_fail("tests/ui/*/*.rs");
}

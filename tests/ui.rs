//! What the compiler says about a wrong model.
//!
//! The folders are those of the catalogue of messages. All errors here are ours, so that their
//! text depends little on the compiler. `TRYBUILD=overwrite cargo test --test ui` refreshes them.

#[test]
fn wrong_models_are_explained() {
    let cases = trybuild::TestCases::new();
    cases.compile_fail("tests/ui/*/*.rs");
}

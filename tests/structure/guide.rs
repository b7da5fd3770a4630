//! What the guide quotes of the compiler is what the compiler says in the compile-fail tests.

#![allow(clippy::unwrap_used, reason = "a test: what is missing is a failure")]

use std::fs;
use std::path::Path;

/// All expected messages of the compile-fail tests.
fn messages() -> String {
    let folders =
        fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("eem-ui/tests/ui")).unwrap();
    let files = folders.flat_map(|folder| fs::read_dir(folder.unwrap().path()).unwrap());
    let paths = files.map(|file| file.unwrap().path());
    let expected = paths.filter(|path| path.extension().is_some_and(|end| end == "stderr"));
    expected
        .map(|path| fs::read_to_string(path).unwrap())
        .collect()
}

#[test]
fn quoted_messages_are_those_of_the_compiler() {
    let guide = include_str!("../../docs/guide.md");
    let messages = messages();
    let blocks = guide.split("```text\n").skip(1);
    let blocks = blocks.map(|rest| rest.split("```").next().unwrap());
    let quoted: Vec<_> = blocks
        .filter(|block| block.starts_with("error: "))
        .collect();
    for block in &quoted {
        assert!(
            messages.contains(*block),
            "no compile-fail test has\n{block}"
        );
    }
    let mistakes = guide.matches("```compile_fail").count();
    assert_eq!(quoted.len(), mistakes, "a message for every mistake");
}

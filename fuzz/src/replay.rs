//! The saved corpora, with a stable compiler.

use std::path::{Path, PathBuf};
use std::thread;

/// Stack for the deepest nesting that the targets try, without optimisation.
const STACK: usize = 64 << 20;

/// The files of a corpus, by name.
fn corpus(name: &str) -> Vec<PathBuf> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let candidates = [here.join("fuzz/corpus"), here.join("corpus")];
    let folder = candidates.iter().find(|folder| folder.is_dir());
    let folder = folder.expect("a folder with corpora").join(name);
    let entries = std::fs::read_dir(&folder).expect("a folder with a corpus");
    let mut files: Vec<_> = entries.map(|entry| entry.expect("a file").path()).collect();
    files.sort();
    files
}

fn replay(name: &str, target: fn(&[u8])) {
    let files = corpus(name);
    assert!(
        files.len() >= 20,
        "{} files in the corpus {name}",
        files.len()
    );
    let run = move || {
        for file in files {
            let data = std::fs::read(&file).expect("a readable file");
            println!("{}", file.display());
            target(&data);
        }
    };
    let thread = thread::Builder::new().stack_size(STACK).spawn(run);
    thread.expect("a thread").join().expect("no panic");
}

#[test]
fn saved_expressions_are_answered() {
    replay("expression", crate::expression);
}

#[test]
fn saved_texts_are_answered() {
    replay("text", crate::text);
}

#[test]
fn saved_laws_hold() {
    replay("laws", crate::laws);
}

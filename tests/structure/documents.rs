//! The README and the pages of `docs`: every link leads somewhere, on disk and in rustdoc, and what is
//! embedded is the file it stands for.

#![allow(clippy::unwrap_used, reason = "a test: what is missing is a failure")]

use std::fs;
use std::path::{Path, PathBuf};

const LIBRARY: &str = include_str!("../../src/lib.rs");

/// The README and the pages, with their texts.
fn documents() -> Vec<(PathBuf, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let pages = fs::read_dir(root.join("docs")).unwrap();
    let pages = pages.map(|page| page.unwrap().path());
    let is_page = |path: &PathBuf| {
        let name = path.file_name().unwrap().to_string_lossy();
        name.ends_with(".md") && !name.ends_with(".link.md")
    };
    let mut paths: Vec<_> = pages.filter(is_page).collect();
    paths.push(root.join("README.md"));
    let read = |path: PathBuf| {
        let text = fs::read_to_string(&path).unwrap();
        (path, text)
    };
    paths.into_iter().map(read).collect()
}

/// The text without fenced blocks.
fn prose(text: &str) -> String {
    text.split("```").step_by(2).collect()
}

/// Where the inline links of a text lead.
fn inline(text: &str) -> Vec<&str> {
    let targets = text.split("](").skip(1);
    targets.filter_map(|rest| rest.split(')').next()).collect()
}

/// The names and targets of the definitions `[name]: target` in a text.
fn definitions(text: &str) -> Vec<(&str, &str)> {
    let definition = |line: &'_ str| -> Option<(usize, usize)> {
        let rest = line.strip_prefix('[')?;
        let end = rest.find("]: ")?;
        Some((1 + end, 1 + end + 3))
    };
    let lines = text.lines().map(|line| line.trim_start_matches("//! "));
    let parts = lines.filter_map(|line| {
        let (end, start) = definition(line)?;
        Some((&line[1..end], line[start..].trim()))
    });
    parts.collect()
}

fn is_elsewhere(target: &str) -> bool {
    ["https://", "http://", "crate::", "#"]
        .iter()
        .any(|start| target.starts_with(start))
}

#[test]
fn links_lead_to_files_and_to_pages_of_rustdoc() {
    let mut faults = Vec::new();
    let own = definitions(LIBRARY);
    for (path, text) in documents() {
        let text = prose(&text);
        let folder = path.parent().unwrap();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        // Inline links to files are dead in rustdoc.
        for target in inline(&text).iter().filter(|target| !is_elsewhere(target)) {
            faults.push(format!(
                "{name}: `{target}` is dead in rustdoc; use a definition"
            ));
        }
        for (label, target) in definitions(&text) {
            if is_elsewhere(target) {
                continue;
            }
            if !folder.join(target).exists() {
                faults.push(format!("{name}: there is no {target}"));
            }
            let stem = Path::new(target).file_stem().unwrap().to_string_lossy();
            let is_embedded = LIBRARY.contains(&format!("docs/{stem}.link.md"));
            if !is_embedded && !own.iter().any(|(name, _)| *name == label) {
                faults.push(format!("{name}: rustdoc does not know [{label}]"));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn every_page_is_a_module_of_rustdoc() {
    for (path, _) in documents() {
        let name = path.file_name().unwrap().to_string_lossy();
        assert!(
            LIBRARY.contains(&format!("{name}\")")),
            "{name} is not included in src/lib.rs"
        );
    }
}

/// Definitions that embed pictures: the link, the picture.
const EMBEDDED: [(&str, &str); 2] = [("energy", "energy"), ("picture", "tutorial")];

#[test]
fn embedded_pictures_are_those_of_the_files() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    for (label, picture) in EMBEDDED {
        let svg = fs::read(docs.join(format!("{picture}.svg"))).unwrap();
        let expected = format!("[{label}]: data:image/svg+xml;base64,{}\n", base64(&svg));
        let path = docs.join(format!("{picture}.link.md"));
        if std::env::var_os("EEM_BLESS").is_some() {
            fs::write(&path, &expected).unwrap();
        }
        let embedded = fs::read_to_string(&path).unwrap();
        assert!(
            embedded == expected,
            "{picture}.svg has changed; EEM_BLESS=1 embeds it anew"
        );
    }
}

/// RFC 4648, section 4.
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for chunk in bytes.chunks(3) {
        let mut three = [0; 3];
        three[..chunk.len()].copy_from_slice(chunk);
        let bits = u32::from_be_bytes([0, three[0], three[1], three[2]]);
        for place in 0..4 {
            if place > chunk.len() {
                text.push('=');
            } else {
                let digit = (bits >> (18 - 6 * place)) & 63;
                text.push(char::from(DIGITS[digit as usize]));
            }
        }
    }
    text
}

#[test]
fn base64_is_that_of_the_standard() {
    let pairs = [
        ("", ""),
        ("f", "Zg=="),
        ("fo", "Zm8="),
        ("foo", "Zm9v"),
        ("foob", "Zm9vYg=="),
    ];
    for (plain, coded) in pairs {
        assert_eq!(base64(plain.as_bytes()), coded);
    }
}

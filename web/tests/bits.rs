//! The bits of runs, which are those of the module in a browser; `EEM_BLESS=1 cargo test` writes them anew.

#![allow(clippy::unwrap_used, reason = "a test: what is missing is a failure")]

use std::fmt::Write;
use std::fs;
use std::path::Path;

use eem_web::examples::EXAMPLES;
use eem_web::pendulum::{Pendulum, SAMPLE};
use eem_web::sheet::Material;

/// Three schemes in all examples: the samples after 10, 20, … 100 steps, and where a run ends before.
fn found() -> String {
    let mut text = String::new();
    for (index, example) in EXAMPLES.iter().enumerate() {
        let law = Material::read(example.sheet).unwrap().law;
        for scheme in ["eem-temperature", "midpoint", "trapezoidal"] {
            let mut run = Pendulum::new(&law, &example.setting, scheme).unwrap();
            for step in 1..=100 {
                let Ok(sample) = run.step() else {
                    writeln!(text, "{index} {scheme} {step} ends").unwrap();
                    break;
                };
                if step % 10 == 0 {
                    let bits: [String; SAMPLE] =
                        sample.map(|value| format!("{:016x}", value.to_bits()));
                    writeln!(text, "{index} {scheme} {step} {}", bits.join(" ")).unwrap();
                }
            }
        }
    }
    text
}

#[test]
fn runs_have_the_bits_that_the_module_has_in_a_browser() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bits.txt");
    let found = found();
    if std::env::var_os("EEM_BLESS").is_some() {
        fs::write(&path, &found).unwrap();
    }
    let stored = fs::read_to_string(&path).unwrap();
    for (found, stored) in found.lines().zip(stored.lines()) {
        assert_eq!(found, stored);
    }
    assert_eq!(found.lines().count(), stored.lines().count());
}

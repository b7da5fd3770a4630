//! What every answer to a source is: programs, or faults with places in its texts. Also a part of the tests of the language.

use super::{Compiled, Fault, Faults, Part, Source};

/// The answer has faults or a model, and if they are wanted the model has programs, or faults.
pub(super) fn check_answer(source: &Source, answer: &Result<Compiled, Faults>, has_programs: bool) {
    match answer {
        Ok(compiled) => {
            check_all(source, compiled.warnings());
            if has_programs {
                match compiled.programs() {
                    Ok(programs) => programs.verify().expect("valid programs"),
                    Err(faults) => check_all(source, faults.all()),
                }
            }
        }
        Err(faults) => {
            assert_ne!(faults.all(), [], "no model and no fault: {source:?}");
            check_all(source, faults.all());
        }
    }
}

fn check_all(source: &Source, faults: &[Fault]) {
    for fault in faults {
        check(source, fault);
    }
}

/// The place of a fault is in its part, and can be drawn.
fn check(source: &Source, fault: &Fault) {
    let text = match &fault.part {
        Part::FreeEnergy => Some(source.free_energy()),
        Part::Dashpot(name) | Part::Parameter(name) => Some(name.as_str()),
        // Several may have one name.
        Part::Viscosity(_) | Part::Unit(_) => None,
    };
    if let Some(text) = text {
        let line = text.split('\n').nth(fault.line - 1);
        let line = line.unwrap_or_else(|| panic!("{fault:?} in {source:?}"));
        let last = fault.column - 1 + fault.width;
        assert!(last <= line.chars().count() + 1, "{fault:?} in {source:?}");
    }
    let lines = fault.to_string().lines().count();
    assert!(lines >= 6, "{fault}");
}

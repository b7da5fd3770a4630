//! The prototype is the library's explicit scheme, and keeps its laws.

use crate::cases::CaseName;
use crate::prototype::{Krueger, Run};
use crate::ratios::agreement::{check, check_laws, temperature_states};
use crate::systems::{State, larger};

const ALL: [CaseName; 3] = [CaseName::Single, CaseName::Krueger, CaseName::Log];

#[test]
fn library_and_prototype_end_in_the_same_state() {
    for case in ALL {
        check(case).unwrap();
    }
}

/// So many that the closing makes all of its corrections.
#[test]
fn the_prototype_keeps_its_laws() {
    for case in ALL {
        check_laws(case, 1000).unwrap();
    }
}

/// Order 8 divides the error by 256. The check of agreement needs a factor of two.
#[test]
fn halving_the_step_divides_the_error_by_more_than_a_hundred() {
    let after = |step: f64, steps: u32| -> State {
        let mut run = Run::<Krueger, 14, 2>::new();
        for _ in 0..steps {
            run.step(step, None).unwrap();
        }
        run.state()
    };
    let states = [(0.1, 20), (0.05, 40), (0.025, 80)].map(|(step, steps)| after(step, steps));
    let apart = |a: &State, b: &State| a.errors(b).into_iter().fold(0.0, larger);
    let [coarse, fine] = [0, 1].map(|i| apart(&states[i], &states[i + 1]));
    assert!(fine < 0.01 * coarse, "{coarse:e} and {fine:e}");
}

/// Both solve the same equations; what differs is rounding of the prototype's plain quotients. One of an energy of
/// 2 MJ by a change of 1 cm, in units of a force of 1 kN, is off by some 10⁻¹¹; twenty steps and the motion make
/// it a hundred times that at most.
#[test]
fn library_and_prototype_in_temperature_form_differ_by_rounding() {
    for [library, prototype] in temperature_states(CaseName::Log).unwrap() {
        let apart = library.errors(&prototype).into_iter().fold(0.0, larger);
        assert!(apart < 1e-9, "{apart:e}");
    }
}

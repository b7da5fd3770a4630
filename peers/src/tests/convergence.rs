//! The equations in both variables and the library's scenes have the same solution, and all solvers find it.

use crate::cases::CaseName;
use crate::reference::Reference;
use crate::solvers::{Solved, Solver, Task};
use crate::systems::{Double, Single, System, Variables, larger};

/// Some periods of the fastest oscillation, s.
const END: f64 = 0.25;

const ALL: [CaseName; 3] = [CaseName::Single, CaseName::Krueger, CaseName::Log];

/// The largest error, the largest energy defect and the steps of a run.
fn run(
    case: CaseName,
    reference: &Reference,
    solver: Solver,
    variables: Variables,
    tolerance: f64,
) -> [f64; 2] {
    let start = reference.start.clone();
    match case.double() {
        None => solve(&Single::new(variables, start), reference, solver, tolerance),
        Some(case) => solve(
            &Double::new(&case, variables, start),
            reference,
            solver,
            tolerance,
        ),
    }
}

fn solve<const N: usize>(
    system: &impl System<N>,
    reference: &Reference,
    solver: Solver,
    tolerance: f64,
) -> [f64; 2] {
    let task = Task {
        system,
        sizes: system.sizes(reference.momentum),
        end: END,
        tolerance,
    };
    let (mut seen, mut defect) = (0, 0.0);
    let first = system.energy(&system.start());
    let Solved {
        y,
        steps,
        evaluations,
        ..
    } = solver
        .solve(&task, |y| {
            seen += 1;
            defect = larger(defect, (system.energy(y) - first).abs() / first);
        })
        .unwrap();
    assert_eq!(seen, steps + 1);
    assert!(evaluations > steps);
    let errors = system.state(&y).errors(&reference.state);
    [errors.into_iter().fold(0.0, larger), defect]
}

#[test]
fn the_two_references_agree() {
    for case in ALL {
        let reference = Reference::of(case, END).unwrap();
        let doubt = reference.doubts.into_iter().fold(0.0, larger);
        assert!(doubt <= 1e-11, "{case:?}: {doubt:e}");
    }
}

#[test]
fn every_solver_finds_the_librarys_solution_in_both_variables() {
    for case in ALL {
        let reference = Reference::of(case, END).unwrap();
        for variables in Variables::ALL {
            for (solver, bound) in [(Solver::Dop853, 1e-7), (Solver::Bdf, 1e-5)] {
                let [error, defect] = run(case, &reference, solver, variables, 1e-9);
                let what = format!("{case:?} {} {}", solver.name(), variables.name());
                assert!(error <= bound, "{what}: {error:e}");
                assert!(defect <= bound, "{what}: {defect:e}");
                let [rough, _] = run(case, &reference, solver, variables, 1e-4);
                assert!(rough >= 10.0 * error, "{what}: {rough:e} and {error:e}");
            }
        }
    }
}

#[test]
fn an_error_below_the_references_doubt_is_not_stated() {
    let mut reference = Reference::of(CaseName::Single, END).unwrap();
    reference.doubts = [1e-6, 0.0, 0.0];
    let mut state = reference.state.clone();
    state.positions[0] += 1e-5;
    state.temperatures[0] *= 1.0 + 1e-5;
    assert!(reference.largest_error(&state).is_none());
    let [q, p, theta] = reference.errors(&state);
    assert_eq!((q, p), (None, Some(0.0)));
    assert!(theta.is_some_and(|error| (error / 1e-5 - 1.0).abs() < 1e-6));
}

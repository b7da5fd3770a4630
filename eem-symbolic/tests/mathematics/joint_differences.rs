//! Divided differences of one function between the same ends are one operation, which the
//! interpreter evaluates and `verify` checks.

use eem_symbolic::{
    DifferencePart, F64, Function, Graph, Input, Instruction, Operation, Program, ProgramKernel,
    Stage, Value, VerifyError,
};

const LN: ProgramKernel = ProgramKernel::Function(Function::Ln);

/// `[ln[a, b], ln[a, a, b], ln[a, b, b]]` of the inputs a and b.
fn joint(kernel: ProgramKernel, parts: &[DifferencePart]) -> Program {
    let mut graph = Graph::new();
    let inputs = ["a", "b"].map(|name| Input {
        symbol: graph.symbol(name),
        name: name.to_owned(),
        stage: Stage::New,
    });
    let [a, b, differences] = [0, 1, 2].map(Value::new);
    let parts = parts.iter().map(|&part| Operation::Part(differences, part));
    let operations = [
        Operation::Input(0),
        Operation::Input(1),
        Operation::JointDifferences(kernel, a, b),
    ];
    let stage = Stage::New;
    let instructions = operations.into_iter().chain(parts);
    let instructions: Vec<_> = instructions
        .map(|operation| Instruction { operation, stage })
        .collect();
    Program {
        inputs: inputs.into(),
        outputs: (3..instructions.len()).map(Value::new).collect(),
        instructions,
    }
}

const ALL: [DifferencePart; 3] = [
    DifferencePart::First,
    DifferencePart::SecondA,
    DifferencePart::SecondB,
];

#[test]
fn the_parts_are_the_differences() {
    let program = joint(LN, &ALL);
    assert_eq!(program.verify(), Ok(()));
    let found = program.interpret(&F64, &[1.0, 2.0]);
    // With L = ln 2: L, (f′(1) − L)/(1 − 2) and (f′(2) − L)/(2 − 1).
    let ln = 2.0_f64.ln();
    for (found, expected) in found.iter().zip([ln, ln - 1.0, 0.5 - ln]) {
        assert!((found - expected).abs() < 1e-15, "{found}, not {expected}");
    }
}

#[test]
fn joint_differences_are_used_by_their_parts_alone() {
    let differences = Value::new(2);
    let mut as_number = joint(LN, &ALL);
    as_number.instructions[3].operation = Operation::Neg(differences);
    let wrong = VerifyError::WrongKind {
        instruction: 3,
        operand: differences,
    };
    assert_eq!(as_number.verify(), Err(wrong));
    let mut of_number = joint(LN, &ALL);
    of_number.instructions[3].operation = Operation::Part(Value::new(0), DifferencePart::First);
    let wrong = VerifyError::WrongKind {
        instruction: 3,
        operand: Value::new(0),
    };
    assert_eq!(of_number.verify(), Err(wrong));
    let mut output = joint(LN, &ALL);
    output.outputs.push(differences);
    let wrong = VerifyError::UnknownOutput { output: 3 };
    assert_eq!(output.verify(), Err(wrong));
}

#[test]
fn one_difference_is_not_joint() {
    let program = joint(LN, &ALL[..1]);
    let wrong = VerifyError::FewParts { instruction: 2 };
    assert_eq!(program.verify(), Err(wrong));
}

#[test]
fn functions_without_such_a_call_are_refused() {
    let program = joint(ProgramKernel::Function(Function::Sin), &ALL);
    let wrong = VerifyError::NoJointCall { instruction: 2 };
    assert_eq!(program.verify(), Err(wrong));
}

/// A difference is joint wherever another one of the same function has the same ends.
#[test]
fn no_two_calls_could_be_one() {
    let mut joint = 0;
    for law in crate::support::all_laws() {
        let programs = law.model.programs();
        let forms = [Some(programs.entropy_form), programs.temperature_form];
        for program in forms.into_iter().flatten() {
            let mut calls = Vec::new();
            for Instruction { operation, .. } in &program.instructions {
                let (Operation::DividedDifference(kernel, a, b)
                | Operation::SecondDividedDifference(kernel, a, b)
                | Operation::JointDifferences(kernel, a, b)) = *operation
                else {
                    continue;
                };
                joint += usize::from(matches!(operation, Operation::JointDifferences(..)));
                if kernel.has_joint_call() {
                    calls.push((kernel, a, b));
                }
            }
            for (i, &(kernel, a, b)) in calls.iter().enumerate() {
                let again = calls[..i].contains(&(kernel, a, b));
                let mirrored = calls[..i].contains(&(kernel.mirrored(), b, a));
                assert!(!again && !mirrored, "{}: {kernel:?} {a:?} {b:?}", law.name);
            }
        }
    }
    assert!(joint > 0);
}

#[test]
fn a_restricted_program_says_where_its_values_come_from() {
    for law in crate::support::all_laws() {
        let program = law.model.programs().entropy_form;
        let responses = law.state.len() + usize::from(law.model.temperature.is_some());
        let restriction = program.restricted_to(responses);
        let outputs = restriction.program.outputs.iter();
        let origins = outputs.map(|output| restriction.origins[output.index()]);
        let expected = program.outputs[..responses].iter().copied().map(Some);
        assert!(origins.eq(expected), "{}", law.name);
        let hoisted = program.hoisted();
        for value in restriction.program.hoisted() {
            let origin = restriction.origins[value.index()].expect("a number has an origin");
            assert!(hoisted.contains(&origin), "{}", law.name);
        }
    }
}

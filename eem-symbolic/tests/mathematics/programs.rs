//! Programs are schedules: verified, staged, without repetition; broken ones are rejected.

use crate::support::laws;
use eem_symbolic::{
    F64, Function, Graph, Input, Instruction, Number, Operation, Program, ProgramKernel, Programs,
    Stage, Value, VerifyError, schedule,
};

fn each(programs: &Programs) -> Vec<(&'static str, &Program)> {
    let mut all = vec![
        ("free energy", &programs.free_energy),
        ("magnitude of the free energy", &programs.energy_magnitude),
        ("gradient", &programs.gradient),
        ("Hessian", &programs.hessian),
        ("internal energy", &programs.internal_energy),
        ("entropy form", &programs.entropy_form),
    ];
    all.extend(programs.caloric.iter().map(|program| ("caloric", program)));
    let of_temperature = programs.caloric_at.iter();
    all.extend(of_temperature.map(|program| ("caloric of temperature", program)));
    all.extend(
        programs
            .viscosity
            .iter()
            .map(|program| ("viscosity", program)),
    );
    all.extend(
        programs
            .temperature_form
            .iter()
            .map(|program| ("temperature form", program)),
    );
    all
}

#[test]
fn programs_of_laws_are_valid() {
    for law in crate::support::all_laws() {
        for (name, program) in each(&law.model.programs()) {
            assert_eq!(program.verify(), Ok(()), "{} of {}", name, law.name);
        }
    }
}

#[test]
fn shapes_are_those_of_the_law() {
    for law in crate::support::all_laws() {
        let model = &law.model;
        let programs = model.programs();
        let (n, thermal) = (law.state.len(), usize::from(model.temperature.is_some()));
        let (parameters, dashpots) = (law.parameters.len(), model.dashpots.len());
        let shape = |program: &Program| (program.inputs.len() - parameters, program.outputs.len());
        assert_eq!(shape(&programs.free_energy), (n, 1));
        assert_eq!(shape(&programs.energy_magnitude), (n, 1));
        assert_eq!(shape(&programs.gradient), (n, n));
        assert_eq!(shape(&programs.hessian), (n, n + n * n));
        assert_eq!(shape(&programs.internal_energy), (n, 1));
        assert_eq!(
            programs.caloric.as_ref().map(shape),
            (thermal == 1).then_some((n, 3))
        );
        let viscosity = (dashpots > 0).then_some((thermal, 2 * dashpots));
        assert_eq!(programs.viscosity.as_ref().map(shape), viscosity);
        let responses = n + thermal;
        let outputs = responses * (n + 1);
        let corners = 2 * thermal * (n - 1);
        assert_eq!(shape(&programs.entropy_form), (2 * n + corners, outputs));
        let temperature = (thermal == 1).then_some((2 * n, outputs));
        assert_eq!(programs.temperature_form.as_ref().map(shape), temperature);
    }
}

#[test]
fn old_stage_depends_on_parameters_and_old_state_alone() {
    for law in crate::support::all_laws() {
        let (parameters, n) = (law.parameters.len(), law.state.len());
        let program = law.model.programs().entropy_form;
        for (index, input) in program.inputs.iter().enumerate() {
            let stage = if index < parameters + n {
                Stage::Old
            } else {
                Stage::New
            };
            assert_eq!(input.stage, stage, "{}", input.name);
        }
        let hoisted = program.hoisted();
        assert!(hoisted.is_sorted());
        for value in hoisted {
            let instruction = &program.instructions[value.index()];
            assert_eq!(instruction.stage, Stage::Old);
            assert!(!matches!(instruction.operation, Operation::Constant(_)));
        }
    }
}

/// Upper bounds of the operations per iteration, so that a loss of sharing does not go unnoticed.
#[test]
fn operation_counts_stay_small() {
    let bounds = [
        (laws::pendulum(), [42, 75, 255, 121]),
        (laws::logarithmic_stiffness(), [20, 37, 219, 92]),
    ];
    for (law, [caloric, hessian, entropy, temperature]) in bounds {
        let programs = law.model.programs();
        let temperature_form = programs.temperature_form.as_ref().expect("a thermal law");
        let caloric_program = programs.caloric.as_ref().expect("a thermal law");
        let bounds = [
            ("caloric", caloric_program, caloric),
            ("Hessian", &programs.hessian, hessian),
            ("entropy form", &programs.entropy_form, entropy),
            ("temperature form", temperature_form, temperature),
        ];
        for (name, program, bound) in bounds {
            let count = program.operation_count();
            println!(
                "{} {name}: {count:?}, {} hoisted",
                law.name,
                program.hoisted().len()
            );
            assert!(
                count.new.total() <= bound,
                "{} {name}: {}",
                law.name,
                count.new.total()
            );
        }
    }
}

#[test]
fn a_restricted_program_has_the_same_bits() {
    for law in crate::support::all_laws() {
        let program = law.model.programs().entropy_form;
        let responses = law.state.len() + usize::from(law.model.temperature.is_some());
        let restricted = program.restricted_to(responses).program;
        assert_eq!(restricted.verify(), Ok(()), "{}", law.name);
        let before = program.operation_count().new.total();
        assert!(
            restricted.operation_count().new.total() < before,
            "{}",
            law.name
        );
        let moved = law.state.iter().map(|x| x * 1.01);
        let theta = law.state.iter().rev().take(1).cycle();
        let state = law.state.iter().copied().chain(moved);
        let inputs = law.parameters.iter().copied().chain(state);
        let inputs: Vec<f64> = inputs.chain(theta.take(8).copied()).collect();
        let bits = |program: &Program| {
            let values = program.interpret(&F64, &inputs).into_iter();
            values.take(responses).map(f64::to_bits).collect::<Vec<_>>()
        };
        assert_eq!(bits(&restricted), bits(&program), "{}", law.name);
    }
}

#[test]
fn a_quotient_of_products_is_one_division() {
    let mut graph = Graph::new();
    let symbols = ["a", "b", "c", "d"].map(|name| graph.symbol(name));
    let [a, b, c, d] = symbols.map(|symbol| graph.variable(symbol));
    let numerator = graph.mul(a, b);
    let denominator = graph.mul(c, d);
    let quotient = graph.div(numerator, denominator);
    let power = graph.powi(a, 5);
    let root = graph.sqrt(b);
    let root = graph.mul(root, b);
    let outputs = [quotient, power, root];
    let inputs = symbols.map(|symbol| Input {
        symbol,
        name: graph.name(symbol).to_owned(),
        stage: Stage::New,
    });
    let count = schedule(&graph, inputs.to_vec(), &outputs)
        .operation_count()
        .new;
    assert_eq!(
        (count.multiplications, count.divisions, count.functions),
        (6, 1, 1)
    );
}

#[test]
fn long_chains_need_no_deep_stack() {
    let mut graph = Graph::new();
    let symbol = graph.symbol("x");
    let x = graph.variable(symbol);
    let mut e = x;
    for _ in 0..20_000 {
        let product = graph.mul(e, x);
        let one = graph.integer(1);
        let sum = graph.add(product, one);
        e = graph.apply(Function::Sin, sum);
    }
    let name = String::from("x");
    let program = schedule(
        &graph,
        vec![Input {
            symbol,
            name,
            stage: Stage::New,
        }],
        &[e],
    );
    assert_eq!(program.operation_count().new.functions, 20_000);
}

/// One parameter p, one variable x, values p, x, p x.
fn product() -> Program {
    let mut graph = Graph::new();
    let symbols = ["p", "x"].map(|name| graph.symbol(name));
    let [p, x] = symbols.map(|symbol| graph.variable(symbol));
    let output = graph.mul(p, x);
    let stages = [Stage::Old, Stage::New];
    let inputs = symbols.iter().zip(stages).map(|(&symbol, stage)| Input {
        symbol,
        name: graph.name(symbol).to_owned(),
        stage,
    });
    let program = schedule(&graph, inputs.collect(), &[output]);
    assert_eq!((program.instructions.len(), program.verify()), (3, Ok(())));
    program
}

fn with(change: impl FnOnce(&mut Program)) -> Result<(), VerifyError> {
    let mut program = product();
    change(&mut program);
    program.verify()
}

fn push(program: &mut Program, operation: Operation, stage: Stage) {
    program.instructions.push(Instruction { operation, stage });
    let last = Value::new(program.instructions.len() - 1);
    program.outputs.push(last);
}

#[test]
fn broken_programs_are_rejected() {
    let [first, second, third] = [0, 1, 2].map(Value::new);
    let early = with(|program| program.instructions[0].operation = Operation::Neg(third));
    assert_eq!(
        early,
        Err(VerifyError::UseBeforeDefinition {
            instruction: 0,
            operand: third
        })
    );
    let unknown = with(|program| program.outputs[0] = Value::new(3));
    assert_eq!(unknown, Err(VerifyError::UnknownOutput { output: 0 }));
    let input = with(|program| program.instructions[1].operation = Operation::Input(2));
    assert_eq!(
        input,
        Err(VerifyError::UnknownInput {
            instruction: 1,
            input: 2
        })
    );
    let old = with(|program| program.instructions[2].stage = Stage::Old);
    let expected = VerifyError::WrongStage {
        instruction: 2,
        expected: Stage::New,
    };
    assert_eq!(old, Err(expected));
    let unused = with(|program| program.outputs[0] = first);
    assert_eq!(unused, Err(VerifyError::Unused { instruction: 2 }));
    let twice = with(|program| push(program, Operation::Mul(first, second), Stage::New));
    let mirrored = with(|program| program.outputs.clear());
    assert_eq!(mirrored, Err(VerifyError::Unused { instruction: 2 }));
    assert!(matches!(
        twice,
        Err(VerifyError::Duplicate {
            first: 2,
            second: 3
        }) | Ok(())
    ));
    let square = with(|program| push(program, Operation::Powi(second, 2), Stage::New));
    assert_eq!(
        square,
        Err(VerifyError::TrivialPower {
            instruction: 3,
            exponent: 2
        })
    );
    let kernel = Operation::DividedDifference(ProgramKernel::Powi(2), first, second);
    let kernel = with(|program| push(program, kernel, Stage::New));
    assert_eq!(
        kernel,
        Err(VerifyError::TrivialPower {
            instruction: 3,
            exponent: 2
        })
    );
    let nan = Operation::Constant(Number::Float(f64::NAN));
    let nan = with(|program| push(program, nan, Stage::New));
    assert_eq!(nan, Err(VerifyError::NonFiniteConstant { instruction: 3 }));
}

#[test]
fn constants_belong_to_the_stage_that_uses_them() {
    let across = with(|program| {
        push(program, Operation::Constant(Number::HALF), Stage::Old);
        push(
            program,
            Operation::Mul(Value::new(1), Value::new(3)),
            Stage::New,
        );
    });
    let operand = Value::new(3);
    assert_eq!(
        across,
        Err(VerifyError::ConstantAcrossStages {
            instruction: 4,
            operand
        })
    );
}

/// Σ |terms of s| of the logarithmic stiffness, ½ c₁ θr L²/θ + β |L| + c |ln(θ/θr)|.
#[test]
fn magnitude_is_the_sum_of_magnitudes() {
    let law = laws::logarithmic_stiffness();
    let program = law.model.programs().caloric.expect("a thermal law");
    let (lambda, theta) = (1.7, 250.0);
    let inputs = [&law.parameters[..], &[lambda, theta]].concat();
    let [entropy, capacity, magnitude] = program.interpret(&F64, &inputs)[..] else {
        panic!("three outputs");
    };
    let strain = (lambda / 2.0_f64).ln();
    let elastic = 0.5 * 50.0 * 300.0 * strain * strain / theta;
    let caloric = 5000.0 * (theta / 300.0_f64).ln();
    let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-14;
    assert!(close(entropy, elastic + 20.0 * strain + caloric));
    assert!(close(magnitude, elastic - 20.0 * strain - caloric));
    assert!(close(capacity, 5000.0 - elastic));
}

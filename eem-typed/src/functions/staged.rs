//! Tapes of programs: of one state; and in two parts, for the old state once in a step and for the new one in each iteration.

use std::collections::BTreeMap;

use eem_symbolic::{Operation, Program, Value};

use crate::error::LawError;
use crate::tape::{Tape, Wanted, fold};

/// A function of old and new inputs, in two parts.
#[derive(Debug)]
pub(crate) struct Staged {
    /// From the old inputs to the kept values.
    pub(crate) old: Tape,
    /// From the kept values and the new inputs to the results.
    pub(crate) new: Tape,
}

/// A form: response and tangent, and the response alone.
#[derive(Debug)]
pub(crate) struct Form {
    pub(crate) staged: Staged,
    pub(crate) response: Tape,
}

/// The inputs of a program that are not parameters, counted from the first of them.
pub(super) fn state_inputs(program: &Program, parameters: usize) -> Vec<(Value, usize)> {
    let instructions = program.instructions.iter().enumerate();
    let inputs = instructions.filter_map(|(value, instruction)| match instruction.operation {
        Operation::Input(input) => Some((Value::new(value), input.checked_sub(parameters)?)),
        _ => None,
    });
    inputs.collect()
}

/// The values of the old stage that the new one reads, without those that depend on parameters alone.
pub(super) fn kept(program: &Program, parameters: &[f64]) -> Vec<Value> {
    let folded = fold(program, parameters);
    let mut kept = program.hoisted();
    kept.retain(|value| folded[value.index()].number().is_none());
    kept
}

impl Staged {
    /// The first `old` inputs after the parameters are old. Keeps the values of [`kept`] if they fit, else the old inputs.
    pub(super) fn new(
        program: &Program,
        parameters: &[f64],
        old: usize,
        fits: &dyn Fn(&[Value]) -> bool,
    ) -> Result<Self, LawError> {
        let (staged, _) = Self::with_places(program, parameters, old, fits)?;
        Ok(staged)
    }

    /// The same, with the places of the inputs of the new part.
    fn with_places(
        program: &Program,
        parameters: &[f64],
        old: usize,
        fits: &dyn Fn(&[Value]) -> bool,
    ) -> Result<(Self, Places), LawError> {
        let folded = fold(program, parameters);
        let mut old_inputs = state_inputs(program, parameters.len());
        old_inputs.retain(|&(_, input)| input < old);
        let mut values = kept(program, parameters);
        if !fits(&values) {
            values = old_inputs.iter().map(|&(value, _)| value).collect();
        }
        let wanted = Wanted {
            program,
            folded: &folded,
            known: old_inputs.into_iter().collect(),
            inputs: old,
            outputs: &values,
        };
        let of_old = Tape::new(&wanted)?;
        let all = program.inputs.len() - parameters.len();
        let kept: Vec<_> = values.iter().copied().zip(0..).collect();
        let places = Places {
            kept: kept.into_iter().collect(),
            old,
            inputs: values.len() + all - old,
        };
        let wanted = Wanted {
            known: places.of(program, parameters.len(), &Some),
            inputs: places.inputs,
            outputs: &program.outputs,
            ..wanted
        };
        let new = Tape::new(&wanted)?;
        Ok((Self { old: of_old, new }, places))
    }

    /// Computes the kept values from the old inputs, at the beginning of `kept`.
    pub(crate) fn keep(&self, inputs: &[f64], kept: &mut [f64]) {
        self.old.run([inputs], [&mut kept[..self.old.results()]]);
    }
}

impl Form {
    /// The form of a program of x⁰, x¹ and corners.
    pub(super) fn new(
        program: &Program,
        parameters: &[f64],
        [variables, responses]: [usize; 2],
        fits: &dyn Fn(&[Value]) -> bool,
    ) -> Result<Self, LawError> {
        let (staged, places) = Staged::with_places(program, parameters, variables, fits)?;
        let part = program.restricted_to(responses);
        let origin = |value: Value| part.origins[value.index()];
        let response = Tape::new(&Wanted {
            program: &part.program,
            folded: &fold(&part.program, parameters),
            known: places.of(&part.program, parameters.len(), &origin),
            inputs: places.inputs,
            outputs: &part.program.outputs,
        })?;
        Ok(Self { staged, response })
    }
}

/// The places of the inputs of the new part of a function.
struct Places {
    /// The kept values of the whole program, with their places.
    kept: BTreeMap<Value, usize>,
    old: usize,
    inputs: usize,
}

impl Places {
    /// The inputs among the values of a program, whose values have their `origin` in the whole program.
    fn of(
        &self,
        program: &Program,
        parameters: usize,
        origin: &dyn Fn(Value) -> Option<Value>,
    ) -> BTreeMap<Value, usize> {
        let values = (0..program.instructions.len()).map(Value::new);
        let kept = values.filter_map(|value| Some((value, *self.kept.get(&origin(value)?)?)));
        let mut known: Vec<_> = kept.collect();
        for (value, input) in state_inputs(program, parameters) {
            if let Some(input) = input.checked_sub(self.old) {
                known.push((value, self.kept.len() + input));
            }
        }
        known.into_iter().collect()
    }
}

/// The tape of a program whose inputs are the parameters and one state.
pub(super) fn of_state(program: &Program, parameters: &[f64]) -> Result<Tape, LawError> {
    let known = state_inputs(program, parameters.len());
    Tape::new(&Wanted {
        program,
        folded: &fold(program, parameters),
        known: known.into_iter().collect(),
        inputs: program.inputs.len() - parameters.len(),
        outputs: &program.outputs,
    })
}

//! Allocation of registers: a result takes the first free one, which is free again after its last reader.

use std::collections::{BTreeMap, BTreeSet};

use eem_symbolic::{DifferencePart, Operation, Value};

use super::fold::Folded;
use super::instruction::{Action, Instruction, Register};
use super::lower::{Line, Wanted};

/// The parts of a tape, with registers as operands.
pub(super) struct Allocated {
    pub(super) constants: Box<[f64]>,
    pub(super) instructions: Box<[Instruction]>,
    pub(super) outputs: Box<[Register]>,
    /// The number of registers.
    pub(super) registers: usize,
}

/// The tape of these lines. With more than 2¹⁶ registers only their count is right; such a tape is refused.
pub(super) fn allocate(wanted: &Wanted<'_>, lines: &[Line]) -> Allocated {
    let mut constants = Constants::new(wanted);
    for line in lines {
        line.action.operands(|operand| constants.see(operand));
    }
    for &output in wanted.outputs {
        constants.see(output);
    }
    let mut file = File::new(wanted, &constants, lines);
    let mut instructions = Vec::with_capacity(lines.len());
    for (index, line) in lines.iter().enumerate() {
        let action = line.action.map(|operand| file.register(operand));
        file.release(index);
        let count = match line.action {
            Action::Joint(..) => 3,
            _ => 1,
        };
        let to = file.take(line.value, count);
        instructions.push(Instruction { action, to });
    }
    let outputs = wanted.outputs.iter();
    Allocated {
        outputs: outputs.map(|&output| file.register(output)).collect(),
        registers: file.used,
        constants: constants.numbers.into(),
        instructions: instructions.into(),
    }
}

/// The folded values that lines or outputs read.
struct Constants<'w> {
    folded: &'w [Folded],
    places: BTreeMap<Value, usize>,
    numbers: Vec<f64>,
}

impl<'w> Constants<'w> {
    fn new(wanted: &'w Wanted<'_>) -> Self {
        Self {
            folded: wanted.folded,
            places: BTreeMap::new(),
            numbers: Vec::new(),
        }
    }

    fn see(&mut self, value: Value) {
        if let Some(number) = self.folded[value.index()].number()
            && !self.places.contains_key(&value)
        {
            self.places.insert(value, self.numbers.len());
            self.numbers.push(number);
        }
    }
}

/// The registers of the values that are stored.
struct File<'w> {
    operations: &'w [eem_symbolic::Instruction],
    places: BTreeMap<Value, usize>,
    /// For each line, the values that it is the last to read.
    last: BTreeMap<usize, Vec<Value>>,
    free: BTreeSet<usize>,
    used: usize,
}

impl<'w> File<'w> {
    fn new(wanted: &Wanted<'w>, constants: &Constants<'_>, lines: &[Line]) -> Self {
        let first = constants.numbers.len();
        let inputs = wanted.known.iter();
        let mut places = constants.places.clone();
        places.extend(inputs.map(|(&value, &place)| (value, first + place)));
        let mut file = Self {
            operations: &wanted.program.instructions,
            places,
            last: BTreeMap::new(),
            free: BTreeSet::new(),
            used: first + wanted.inputs,
        };
        let mut readers = BTreeMap::new();
        for (index, line) in lines.iter().enumerate() {
            line.action.operands(|operand| {
                readers.insert(file.origin(operand).0, index);
            });
        }
        for &output in wanted.outputs {
            readers.insert(file.origin(output).0, usize::MAX);
        }
        for line in lines {
            if let Some(&reader) = readers.get(&line.value) {
                file.last.entry(reader).or_default().push(line.value);
            }
        }
        file
    }

    /// The value under which a line stores `value`, and the place of `value` among the results of the line.
    fn origin(&self, value: Value) -> (Value, usize) {
        if self.places.contains_key(&value) {
            return (value, 0);
        }
        match self.operations[value.index()].operation {
            Operation::Part(call, DifferencePart::First) => (call, 0),
            Operation::Part(call, DifferencePart::SecondA) => (call, 1),
            Operation::Part(call, DifferencePart::SecondB) => (call, 2),
            _ => (value, 0),
        }
    }

    fn register(&self, value: Value) -> Register {
        let (origin, part) = self.origin(value);
        let Some(place) = self.places.get(&origin) else {
            unreachable!("operands are computed first")
        };
        Register::try_from(place + part).unwrap_or(Register::MAX)
    }

    /// Frees the registers of values that this line is the last to read.
    fn release(&mut self, line: usize) {
        for value in self.last.remove(&line).unwrap_or_default() {
            let Some(&place) = self.places.get(&value) else {
                continue;
            };
            self.free.extend(place..place + self.width(value));
        }
    }

    fn width(&self, value: Value) -> usize {
        match self.operations[value.index()].operation {
            Operation::JointDifferences(..) => 3,
            _ => 1,
        }
    }

    /// Takes `count` consecutive registers for a value, and returns the first.
    fn take(&mut self, value: Value, count: usize) -> Register {
        let mut free = self.free.iter().copied();
        let fits = |first: &usize| (1..count).all(|next| self.free.contains(&(first + next)));
        let place = free.find(fits).unwrap_or(self.used);
        for register in place..place + count {
            self.free.remove(&register);
        }
        self.used = self.used.max(place + count);
        self.places.insert(value, place);
        Register::try_from(place).unwrap_or(Register::MAX)
    }
}

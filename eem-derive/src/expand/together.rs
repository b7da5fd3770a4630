//! First and second divided differences of one function between the same ends are evaluated together.

use std::collections::BTreeMap;

use eem_symbolic::{Function, Instruction, Operation, ProgramKernel, Value};
use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};

use super::statements::divided_difference;

/// A function and its ends, the smaller value first.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Key {
    kernel: String,
    ends: [Value; 2],
}

/// The instructions that belong together, by where they are.
#[derive(Debug, Default)]
pub(super) struct Together {
    members: BTreeMap<usize, Key>,
    groups: BTreeMap<Key, Group>,
}

#[derive(Debug)]
struct Group {
    /// The first of the instructions, which comes with the evaluation of all.
    first: usize,
    count: usize,
    evaluation: TokenStream,
    /// The ends in the order of the evaluation.
    ends: [Value; 2],
}

/// How an instruction of a group is printed.
pub(super) struct Member {
    // Expands to: `let __d7 = __eem::kernel::ln_dds(__v3, __v5);`, or to nothing.
    pub(super) evaluation: Option<TokenStream>,
    // Expands to: `__d7.second_b`.
    pub(super) value: TokenStream,
}

impl Together {
    /// Looks for groups among instructions.
    pub(super) fn of<'p>(instructions: impl Iterator<Item = (usize, &'p Instruction)>) -> Self {
        let mut together = Self::default();
        for (index, instruction) in instructions {
            let (Operation::DividedDifference(kernel, a, b)
            | Operation::SecondDividedDifference(kernel, a, b)) = instruction.operation
            else {
                continue;
            };
            if !has_kernel(kernel) {
                continue;
            }
            let key = key(kernel, a, b);
            together.members.insert(index, key.clone());
            let group = together.groups.entry(key).or_insert_with(|| Group {
                first: index,
                count: 0,
                evaluation: divided_difference("_dds", kernel, a, b),
                ends: [a, b],
            });
            group.count += 1;
        }
        together
    }

    /// The instruction as one of several that belong together.
    pub(super) fn member(&self, index: usize, operation: &Operation) -> Option<Member> {
        let group = &self.groups[self.members.get(&index)?];
        if group.count < 2 {
            return None;
        }
        let name = format_ident!("__d{}", group.first, span = Span::mixed_site());
        let field = match *operation {
            Operation::SecondDividedDifference(_, a, _) if a == group.ends[0] => "second_b",
            Operation::SecondDividedDifference(..) => "second_a",
            _ => "first",
        };
        let field = Ident::new(field, Span::call_site());
        let evaluation = &group.evaluation;
        Some(Member {
            evaluation: (group.first == index).then(|| quote! { let #name = #evaluation; }),
            value: quote!(#name.#field),
        })
    }
}

/// Whether the runtime evaluates the differences of a function together.
fn has_kernel(kernel: ProgramKernel) -> bool {
    match kernel {
        ProgramKernel::Function(Function::Ln | Function::Ln1p) | ProgramKernel::Power(..) => true,
        ProgramKernel::Function(_)
        | ProgramKernel::Powi(_)
        | ProgramKernel::Sqrt
        | ProgramKernel::Powf(_) => false,
    }
}

fn key(kernel: ProgramKernel, a: Value, b: Value) -> Key {
    let kernel = match kernel {
        ProgramKernel::Power(value_a, value_b) => {
            let (first, second) = (value_a.min(value_b), value_a.max(value_b));
            format!("{:?}", ProgramKernel::Power(first, second))
        }
        kernel => format!("{kernel:?}"),
    };
    let ends = [a.min(b), a.max(b)];
    Key { kernel, ends }
}

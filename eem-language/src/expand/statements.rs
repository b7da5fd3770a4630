//! One `let` per instruction of a program.

use std::collections::{BTreeMap, BTreeSet};

use eem_symbolic::{DifferencePart, Instruction, Number, Operation, Program, ProgramKernel, Value};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{ToTokens as _, format_ident, quote};

/// Prints the instructions of one program.
pub(super) struct Statements<'p> {
    pub(super) program: &'p Program,
    /// The scalar of the implementation.
    pub(super) scalar: &'p TokenStream,
    /// The source of an input.
    pub(super) input: Box<dyn Fn(usize) -> TokenStream + 'p>,
    /// The expressions that read values computed by another function.
    pub(super) known: BTreeMap<Value, TokenStream>,
}

impl Statements<'_> {
    // Expands to: `let __v7 = __v3 * __v5;` for every instruction that `keep` selects. Known
    // values are read right before their first use: `let __v3 = __old[0];`.
    pub(super) fn lets(&self, keep: impl Fn(usize, &Instruction) -> bool) -> TokenStream {
        let mut tokens = TokenStream::new();
        let instructions = self.program.instructions.iter().enumerate();
        let kept = instructions.filter(|(index, instruction)| keep(*index, instruction));
        let mut read = BTreeSet::new();
        for (index, instruction) in kept {
            for operand in instruction.operation.operands() {
                if let Some(known) = self.known.get(&operand)
                    && read.insert(operand)
                {
                    let name = value(operand);
                    tokens.extend(quote! { let #name = #known; });
                }
            }
            let name = name(index);
            let value = self.operation(&instruction.operation);
            tokens.extend(quote! { let #name = #value; });
        }
        tokens
    }

    // Expands to: `__old[0]` for a value that is known, and to `__v7` for another one.
    pub(super) fn read(&self, wanted: Value) -> TokenStream {
        match self.known.get(&wanted) {
            Some(known) => known.clone(),
            None => value(wanted).into_token_stream(),
        }
    }

    fn operation(&self, operation: &Operation) -> TokenStream {
        match operation {
            Operation::Input(index) => (self.input)(*index),
            Operation::Constant(number) => self.constant(number),
            Operation::Add(a, b) => infix(*a, &quote!(+), *b),
            Operation::Sub(a, b) => infix(*a, &quote!(-), *b),
            Operation::Mul(a, b) => infix(*a, &quote!(*), *b),
            Operation::Div(a, b) => infix(*a, &quote!(/), *b),
            Operation::Neg(a) => {
                let a = value(*a);
                quote!(-#a)
            }
            Operation::Powi(a, n) => {
                let n = integer(*n);
                self.method("powi", &[*a], Some(&n))
            }
            Operation::Sqrt(a) => self.method("sqrt", &[*a], None),
            Operation::Power(a, b) => self.method("powf", &[*a, *b], None),
            Operation::Apply(function, a) => self.method(function.name(), &[*a], None),
            Operation::DividedDifference(kernel, a, b) => {
                divided_difference("_dd", *kernel, *a, *b)
            }
            Operation::SecondDividedDifference(kernel, a, b) => {
                divided_difference("_dd2", *kernel, *a, *b)
            }
            Operation::JointDifferences(kernel, a, b) => {
                divided_difference("_dds", *kernel, *a, *b)
            }
            Operation::Part(differences, part) => {
                let (differences, part) = (value(*differences), field(*part));
                quote!(#differences.#part)
            }
        }
    }

    // Expands to: `<__S as __eem::Scalar>::ln(__v3)`.
    fn method(&self, name: &str, arguments: &[Value], extra: Option<&TokenStream>) -> TokenStream {
        let scalar = self.scalar;
        let name = Ident::new(name, Span::call_site());
        let arguments = arguments.iter().map(|&a| value(a)).map(|a| quote!(#a));
        let arguments = arguments.chain(extra.cloned());
        quote!(<#scalar as __eem::Scalar>::#name(#(#arguments),*))
    }

    // Expands to: `<__S as __eem::Scalar>::from_f64(0.5)`.
    fn constant(&self, number: &Number) -> TokenStream {
        let scalar = self.scalar;
        let value = number.to_f64();
        let sign = value.is_sign_negative().then(|| quote!(-));
        let magnitude = Literal::f64_unsuffixed(value.abs());
        quote!(<#scalar as __eem::Scalar>::from_f64(#sign #magnitude))
    }
}

// Expands to: `__eem::kernel::ln_dd(__v3, __v5)`; first, second and joint divided differences differ
// in the suffix of the name only.
fn divided_difference(suffix: &str, kernel: ProgramKernel, a: Value, b: Value) -> TokenStream {
    let (a, b) = (value(a), value(b));
    let (name, arguments) = match kernel {
        ProgramKernel::Function(function) => (function.name(), quote!(#a, #b)),
        ProgramKernel::Powi(-1) => ("recip", quote!(#a, #b)),
        ProgramKernel::Powi(n) => {
            let n = integer(n);
            ("powi", quote!(#a, #b, #n))
        }
        ProgramKernel::Sqrt => ("sqrt", quote!(#a, #b)),
        ProgramKernel::Powf(exponent) => {
            let exponent = value(exponent);
            ("powf", quote!(#a, #b, #exponent))
        }
        ProgramKernel::Power(value_a, value_b) => {
            let (value_a, value_b) = (value(value_a), value(value_b));
            ("power", quote!(#value_a, #value_b, #a, #b))
        }
    };
    let name = format_ident!("{name}{suffix}");
    quote!(__eem::kernel::#name(#arguments))
}

/// The field of joint differences that holds one of them.
fn field(part: DifferencePart) -> Ident {
    let name = match part {
        DifferencePart::First => "first",
        DifferencePart::SecondA => "second_a",
        DifferencePart::SecondB => "second_b",
    };
    Ident::new(name, Span::call_site())
}

/// The name of a value.
pub(super) fn value(value: Value) -> Ident {
    name(value.index())
}

fn name(index: usize) -> Ident {
    format_ident!("__v{}", index, span = Span::mixed_site())
}

fn infix(a: Value, operator: &TokenStream, b: Value) -> TokenStream {
    let (a, b) = (value(a), value(b));
    quote!(#a #operator #b)
}

fn integer(n: i32) -> TokenStream {
    let sign = (n < 0).then(|| quote!(-));
    let magnitude = Literal::u32_unsuffixed(n.unsigned_abs());
    quote!(#sign #magnitude)
}

//! Files and functions that are longer than they may be.

use proc_macro2::Span;
use syn::spanned::Spanned as _;
use syn::visit::{self, Visit};
use syn::{Block, ImplItemFn, Item, ItemFn, Signature, TraitItemFn};

use super::sources::{Sources, attributes, is_for_tests};

/// What is too long, in words.
pub(crate) fn too_long(sources: &Sources, file: usize, function: usize) -> Vec<String> {
    let mut faults = Vec::new();
    for (name, source) in &sources.files {
        let lines = source.text.lines().count() - lines_of_tests(&source.text);
        if lines > file {
            faults.push(format!("{name} has {lines} lines, more than {file}"));
        }
        let mut functions = Functions(Vec::new());
        for item in &source.items {
            functions.visit_item(item);
        }
        for (called, lines) in functions.0 {
            if lines > function {
                faults.push(format!(
                    "{name}: `{called}` has {lines} lines, more than {function}"
                ));
            }
        }
    }
    faults
}

/// Lines of the items at the top of a file that are for tests.
fn lines_of_tests(text: &str) -> usize {
    let file = syn::parse_file(text).expect("the file has been read before");
    let items = file.items.iter();
    let tests = items.filter(|item| is_for_tests(attributes(item)));
    tests
        .map(|item: &Item| lines(item.span(), item.span()))
        .sum()
}

/// Names and lines of functions.
struct Functions(Vec<(String, usize)>);

impl Functions {
    fn note(&mut self, signature: &Signature, body: &Block) {
        let lines = lines(signature.span(), body.span());
        self.0.push((signature.ident.to_string(), lines));
    }
}

/// From the first line of one span to the last line of another.
fn lines(first: Span, last: Span) -> usize {
    last.end().line + 1 - first.start().line
}

impl<'a> Visit<'a> for Functions {
    fn visit_item_fn(&mut self, function: &'a ItemFn) {
        self.note(&function.sig, &function.block);
        visit::visit_item_fn(self, function);
    }

    fn visit_impl_item_fn(&mut self, function: &'a ImplItemFn) {
        self.note(&function.sig, &function.block);
        visit::visit_impl_item_fn(self, function);
    }

    fn visit_trait_item_fn(&mut self, function: &'a TraitItemFn) {
        if let Some(body) = &function.default {
            self.note(&function.sig, body);
        }
        visit::visit_trait_item_fn(self, function);
    }
}

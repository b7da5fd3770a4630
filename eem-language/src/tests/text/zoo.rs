//! Free energies of the zoo: from text come the programs that the derive prints, in every bit.

use std::fs;
use std::path::Path;

use eem_symbolic::Model;
use proc_macro2::{Delimiter, TokenTree};
use syn::{DeriveInput, Item, ItemMacro};

use super::item::AsText;
use crate::attr::Attributes;
use crate::ctxt::Ctxt;
use crate::dialect::Dialect;
use crate::tests::catalogue::sources;
use crate::text::{Source, compile};
use crate::{check, derive, parse};

/// The structs that the specimens of a file stand for, as source.
fn structs(text: &str) -> Vec<String> {
    let file = syn::parse_file(text).expect("a file of the zoo is Rust");
    let specimens = file.items.into_iter().filter_map(|item| match item {
        Item::Macro(ItemMacro { mac, .. }) if mac.path.is_ident("specimen") => Some(mac.tokens),
        _ => None,
    });
    let specimen = |tokens: proc_macro2::TokenStream| {
        let written = |token: &TokenTree| text[token.span().byte_range()].to_owned();
        let inside = |token: &TokenTree| {
            let text = written(token);
            text[1..text.len() - 1].to_owned()
        };
        let (mut name, mut groups, mut laws) = (String::new(), Vec::new(), Vec::new());
        let mut before = None;
        for token in tokens {
            match &token {
                TokenTree::Ident(ident) => name = name_unless_or(name, &ident.to_string()),
                TokenTree::Group(group) if group.delimiter() == Delimiter::Bracket => {
                    if !matches!(&before, Some(TokenTree::Punct(_))) {
                        laws.push(format!("#[viscosity({})]\n", inside(&token)));
                    }
                }
                TokenTree::Group(_) => groups.push(token.clone()),
                TokenTree::Punct(_) | TokenTree::Literal(_) => {}
            }
            before = Some(token);
        }
        // `theta: Temperature = 300.0 in [250.0, 350.0]`
        let arguments = inside(&groups[1]);
        let arguments = arguments
            .split(']')
            .filter_map(|one| one.split(" = ").next());
        let arguments: Vec<String> = arguments
            .map(|a| format!("{}, ", a.trim_matches([',', ' ', '\n'])))
            .collect();
        let arguments = arguments.concat();
        let arguments = arguments.trim_end_matches([',', ' ']);
        let fields = inside(&groups[0]);
        let fields = fields.split(',').filter_map(|field| field.split_once(':'));
        let fields: Vec<String> = fields
            .map(|(name, _)| format!("{}: f64, ", name.trim()))
            .collect();
        let (fields, laws) = (fields.concat(), laws.concat());
        let body = written(&groups[2]);
        format!(
            "#[derive(FreeEnergy)]\n#[free_energy(|{arguments}| {body})]\n{laws}struct {name} {{ {fields} }}"
        )
    };
    specimens.map(specimen).collect()
}

/// The first identifier is the name; `or` stands before a second body.
fn name_unless_or(name: String, ident: &str) -> String {
    if name.is_empty() {
        ident.to_owned()
    } else {
        name
    }
}

/// The model that the derive prints.
fn derived(input: &DeriveInput) -> Option<Model> {
    let cx = Ctxt::new(Dialect::Attribute);
    let attributes = Attributes::from_syn(&cx, input);
    let parsed = parse::input(&cx, input, &attributes)?;
    let checked = check::check(&cx, &parsed);
    let model = derive::model(&cx, &checked);
    cx.barrier(model).ok().map(|(model, _)| model)
}

/// All structs of the zoo.
fn zoo() -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/materials/zoo/families");
    let read = |file| fs::read_to_string(file).expect("a file of the zoo can be read");
    sources(&root)
        .into_iter()
        .flat_map(|file| structs(&read(file)))
        .collect()
}

/// All of them as texts.
pub(super) fn sources_of_all() -> Vec<Source> {
    let source = |item: &String| AsText::new(item, &read(item)).map(|text| text.source);
    zoo().iter().filter_map(|item| source(item).ok()).collect()
}

fn read(item: &str) -> DeriveInput {
    syn::parse_str(item).unwrap_or_else(|error| panic!("{item}: {error}"))
}

#[test]
fn texts_of_the_zoo_give_the_programs_of_the_derive() {
    let mut compared = 0;
    for item in zoo() {
        let input = read(&item);
        let as_text = AsText::new(&item, &input).unwrap_or_else(|why| panic!("{item}: {why}"));
        let compiled = compile(&as_text.source);
        let compiled = compiled.unwrap_or_else(|faults| panic!("{item}\n{faults}"));
        let derived = derived(&input).expect("the derive takes it").programs();
        let programs = compiled.programs().expect("its numbers fit");
        // With all digits, and the sign of zero.
        assert_eq!(format!("{programs:?}"), format!("{derived:?}"), "{item}");
        compared += 1;
    }
    assert!(compared > 60, "{compared} models");
}

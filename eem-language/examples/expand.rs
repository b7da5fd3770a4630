//! Prints what `#[derive(FreeEnergy)]` generates for the structs of a file:
//! `cargo run -p eem-language --example expand -- examples/src/bin/single_pendulum.rs`.
//!
//! With names behind the file, for the structs of these names only. Mistakes in a model are printed
//! where the compiler would show them, as `compile_error!` in front of an empty implementation.

use std::error::Error;
use std::process::ExitCode;

use syn::{Attribute, DeriveInput, File, Item, Meta, Path, Token, punctuated::Punctuated};

const USAGE: &str = "usage: expand FILE [STRUCT]…";

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let Some(file) = arguments.next() else {
        eprintln!("{USAGE}");
        return ExitCode::FAILURE;
    };
    match print(&file, &arguments.collect::<Vec<_>>()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {file}: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Prints the expansions for the named models of a file, or for all.
fn print(file: &str, names: &[String]) -> Result<(), Box<dyn Error>> {
    let File { items, .. } = syn::parse_file(&std::fs::read_to_string(file)?)?;
    let mut models = Vec::new();
    collect(items, &mut models);
    models.retain(|model| names.is_empty() || names.iter().any(|name| model.ident == name));
    if models.is_empty() {
        return Err("no such struct with `#[derive(FreeEnergy)]`".into());
    }
    for model in models {
        let expansion: File = syn::parse2(eem_language::derive(&model))?;
        println!("// {}\n{}", model.ident, prettyplease::unparse(&expansion));
    }
    Ok(())
}

/// Collects the models among the items and in the modules among them.
fn collect(items: Vec<Item>, models: &mut Vec<DeriveInput>) {
    for item in items {
        match item {
            Item::Mod(module) => collect(module.content.unwrap_or_default().1, models),
            Item::Struct(item) if has_derive(&item.attrs) => models.push(item.into()),
            Item::Enum(item) if has_derive(&item.attrs) => models.push(item.into()),
            Item::Union(item) if has_derive(&item.attrs) => models.push(item.into()),
            _ => {}
        }
    }
}

/// Whether `FreeEnergy` is among the derives, under whatever path.
fn has_derive(attributes: &[Attribute]) -> bool {
    let derives = attributes.iter().filter(|a| a.path().is_ident("derive"));
    let paths = derives.filter_map(|attribute| match &attribute.meta {
        Meta::List(list) => {
            let parser = Punctuated::<Path, Token![,]>::parse_terminated;
            list.parse_args_with(parser).ok()
        }
        Meta::Path(_) | Meta::NameValue(_) => None,
    });
    let mut paths = paths.flatten();
    paths.any(|path| {
        let last = path.segments.last();
        last.is_some_and(|segment| segment.ident == "FreeEnergy")
    })
}

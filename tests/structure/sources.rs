//! The files of a crate that its library consists of, each with its module; no tests.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use syn::{Attribute, Item};

/// The path of a module from the root of its crate.
pub(crate) type Module = Vec<String>;

/// Parsed files by name, and the file of each module.
pub(crate) struct Sources {
    pub(crate) files: BTreeMap<String, Source>,
    pub(crate) modules: BTreeMap<Module, String>,
}

/// One file.
pub(crate) struct Source {
    pub(crate) text: String,
    /// Without what is compiled for tests only.
    pub(crate) items: Vec<Item>,
    pub(crate) module: Module,
}

impl Sources {
    /// The files below `src` of a crate of this workspace.
    pub(crate) fn of_crate(name: &str) -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let mut texts = BTreeMap::new();
        read(&root.join(name).join("src"), "", &mut texts);
        Self::new(texts)
    }

    /// Files with these names and texts, as far as `lib.rs` declares them.
    pub(crate) fn new(texts: impl IntoIterator<Item = (String, String)>) -> Self {
        let mut texts: BTreeMap<_, _> = texts.into_iter().collect();
        let (files, modules) = (BTreeMap::new(), BTreeMap::new());
        let mut sources = Self { files, modules };
        let mut pending = vec![("lib.rs".to_owned(), Module::new())];
        while let Some((name, module)) = pending.pop() {
            let text = texts.remove(&name);
            let text = text.unwrap_or_else(|| panic!("{name} is declared and does not exist"));
            let file = syn::parse_file(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
            let items = without_tests(file.items);
            sources.declare(&items, &module, &name, &mut |child: Module| {
                let path = child.join("/");
                let names = [format!("{path}.rs"), format!("{path}/mod.rs")];
                let name = names.into_iter().find(|name| texts.contains_key(name));
                pending.push((name.unwrap_or(format!("{path}.rs")), child));
            });
            let source = Source {
                text,
                items,
                module,
            };
            sources.files.insert(name, source);
        }
        sources
    }

    /// Notes the modules of a file: its own, and those that are written out in it.
    fn declare(
        &mut self,
        items: &[Item],
        module: &Module,
        file: &str,
        in_a_file: &mut impl FnMut(Module),
    ) {
        self.modules.insert(module.clone(), file.to_owned());
        for item in items {
            let Item::Mod(child) = item else { continue };
            let mut path = module.clone();
            path.push(child.ident.to_string());
            match &child.content {
                Some((_, items)) => self.declare(items, &path, file, in_a_file),
                None => in_a_file(path),
            }
        }
    }
}

fn read(folder: &Path, prefix: &str, texts: &mut BTreeMap<String, String>) {
    for entry in fs::read_dir(folder).expect("the folder can be read") {
        let path = entry.expect("the folder can be read").path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let name = format!("{prefix}{name}");
        if path.is_dir() {
            read(&path, &format!("{name}/"), texts);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = fs::read_to_string(&path).expect("the file can be read");
            texts.insert(name, text);
        }
    }
}

/// The items that are compiled outside of tests, too.
fn without_tests(items: Vec<Item>) -> Vec<Item> {
    let mut kept = Vec::new();
    for mut item in items {
        if is_for_tests(attributes(&item)) {
            continue;
        }
        if let Item::Mod(module) = &mut item
            && let Some((_, items)) = &mut module.content
        {
            *items = without_tests(std::mem::take(items));
        }
        kept.push(item);
    }
    kept
}

/// Whether there is a `#[cfg(test)]`.
pub(crate) fn is_for_tests(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let condition = attribute.parse_args::<syn::Path>();
        attribute.path().is_ident("cfg") && condition.is_ok_and(|path| path.is_ident("test"))
    })
}

pub(crate) fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}

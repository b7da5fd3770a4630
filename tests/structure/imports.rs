//! Which files of a crate each file imports from.

use std::collections::{BTreeMap, BTreeSet};

use syn::visit::{self, Visit};
use syn::{ItemMod, ItemUse, UseTree};

use super::sources::{Module, Sources};

/// For each file, the files of the same crate that it names something of.
pub(crate) type Imports = BTreeMap<String, BTreeSet<String>>;

/// The imports of all files.
pub(crate) fn imports(sources: &Sources) -> Imports {
    let mut imports = Imports::new();
    for (name, source) in &sources.files {
        let mut reader = Reader {
            sources,
            module: source.module.clone(),
            found: BTreeSet::new(),
        };
        for item in &source.items {
            reader.visit_item(item);
        }
        reader.found.remove(name);
        imports.insert(name.clone(), reader.found);
    }
    imports
}

/// Collects the paths of one file.
struct Reader<'s> {
    sources: &'s Sources,
    /// The module that is being read.
    module: Module,
    found: BTreeSet<String>,
}

impl Reader<'_> {
    /// Notes the file of the last module in a path, unless the path leads to another crate.
    fn note(&mut self, path: &[String]) {
        let mut names = path.iter().map(String::as_str).peekable();
        let mut module = self.module.clone();
        match names.peek() {
            Some(&"crate") => module.clear(),
            Some(&("self" | "super")) => {}
            Some(&name) if path.len() > 1 && self.is_module(&module, name) => {}
            _ => return,
        }
        for name in names {
            match name {
                "crate" | "self" => {}
                "super" => {
                    module.pop();
                }
                name if self.is_module(&module, name) => module.push(name.to_owned()),
                _ => break,
            }
        }
        let file = self.sources.modules.get(&module);
        self.found.extend(file.cloned());
    }

    fn is_module(&self, parent: &Module, name: &str) -> bool {
        let child = [parent.as_slice(), &[name.to_owned()]].concat();
        self.sources.modules.contains_key(&child)
    }

    fn note_tree(&mut self, tree: &UseTree, before: &mut Vec<String>) {
        match tree {
            UseTree::Path(path) => {
                before.push(path.ident.to_string());
                self.note_tree(&path.tree, before);
                before.pop();
            }
            UseTree::Group(group) => {
                for tree in &group.items {
                    self.note_tree(tree, before);
                }
            }
            UseTree::Name(name) => self.note_with(before, &name.ident.to_string()),
            UseTree::Rename(rename) => self.note_with(before, &rename.ident.to_string()),
            UseTree::Glob(_) => self.note_with(before, "*"),
        }
    }

    fn note_with(&mut self, before: &[String], last: &str) {
        self.note(&[before, &[last.to_owned()]].concat());
    }
}

impl<'a> Visit<'a> for Reader<'_> {
    fn visit_item_mod(&mut self, item: &'a ItemMod) {
        self.module.push(item.ident.to_string());
        visit::visit_item_mod(self, item);
        self.module.pop();
    }

    fn visit_item_use(&mut self, item: &'a ItemUse) {
        self.note_tree(&item.tree, &mut Vec::new());
    }

    fn visit_path(&mut self, path: &'a syn::Path) {
        if path.leading_colon.is_none() {
            let names = path.segments.iter().map(|s| s.ident.to_string());
            self.note(&names.collect::<Vec<_>>());
        }
        visit::visit_path(self, path);
    }

    fn visit_visibility(&mut self, _: &'a syn::Visibility) {
        // `pub(super)` imports nothing.
    }
}

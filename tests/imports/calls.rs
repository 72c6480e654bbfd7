//! Which methods there are, of which types, and what types they and the fields have.

use super::bodies;
use super::crates::{Module, Sources, absolute};
use super::tokens::{Range, Signature, Tokens, behind, functions, is_name, parts};
use std::collections::{BTreeMap, BTreeSet};

/// A type: the module that defines it, and its name.
pub type Type = (Module, String);

/// A method, and its type.
pub type Method = (Type, String);

/// The files that define the methods of each type, by their names.
pub type Methods = BTreeMap<Type, BTreeMap<String, BTreeSet<Module>>>;

/// In how many files the methods of a type are.
pub fn n_files(methods: &BTreeMap<String, BTreeSet<Module>>) -> usize {
    methods.values().flatten().collect::<BTreeSet<_>>().len()
}

/// The methods of all types, and which of them each file calls.
pub fn of<'f>(
    files: &BTreeMap<&'f Module, Tokens<'_>>,
    sources: &Sources,
) -> (Methods, BTreeMap<&'f Module, BTreeSet<Method>>) {
    let mut known = Known {
        sources,
        methods: Methods::new(),
        returned: BTreeMap::new(),
        fields: BTreeMap::new(),
        owners: BTreeMap::new(),
    };
    for (module, tokens) in files {
        known.declare(module, tokens);
    }
    let called = |(&module, tokens): (&&'f Module, &Tokens)| {
        let mut called = BTreeSet::new();
        let blocks = known.blocks(module, tokens);
        for (_, at) in functions(tokens, 0..tokens.len()) {
            let own = blocks.iter().find(|block| block.body.contains(&at)).map(|block| &block.of);
            bodies::visit(&known, module, tokens, own, &Signature::at(tokens, at), &mut called);
        }
        (module, called)
    };
    let called = files.iter().map(called).collect();
    (known.methods, called)
}

/// What the declarations of a crate tell.
pub struct Known<'s> {
    sources: &'s Sources,
    methods: Methods,
    /// The types that methods return, and those of fields.
    pub returned: BTreeMap<Method, Type>,
    pub fields: BTreeMap<Method, Type>,
    /// The types, and the traits, that have a method of a name.
    owners: BTreeMap<String, BTreeSet<Type>>,
}

/// An `impl`: of what type, whether of a trait, and its body.
struct Block {
    of: Type,
    is_of_trait: bool,
    body: Range,
}

impl Known<'_> {
    /// The type that tokens name, behind references, and in an `Option`, a `Box` or a `Result`.
    pub fn named(&self, module: &Module, tokens: &[&str], own: Option<&Type>) -> Option<Type> {
        let is_path = |token: &&str| is_name(token) && !["mut", "dyn", "impl", "const"].contains(token);
        let at = tokens.iter().position(is_path)?;
        if tokens[..at].iter().any(|token| ["[", "("].contains(token)) {
            return None;
        }
        let n = tokens[at..]
            .iter()
            .zip(0..)
            .take_while(|(t, k)| if k % 2 == 0 { is_name(t) } else { **t == "::" });
        let path: Vec<String> = n.step_by(2).map(|(token, _)| (*token).to_owned()).collect();
        let end = at + 2 * path.len() - 1;
        match path.last()?.as_str() {
            "Self" => own.cloned(),
            "Option" | "Box" | "Result" if tokens.get(end) == Some(&"<") => {
                self.named(module, &tokens[end + 1..], own)
            }
            _ => self.type_at(module, &path),
        }
    }

    /// The type of a path.
    pub fn type_at(&self, module: &Module, path: &[String]) -> Option<Type> {
        let path = match self.sources.files[module].names.get(&path[0]) {
            Some(start) => [start.as_slice(), &path[1..]].concat(),
            None => absolute(path, module)?,
        };
        let (definer, rest) = self.sources.definer(&path)?;
        Some((definer, rest.first()?.clone()))
    }

    pub fn has(&self, ty: &Type, method: &str) -> bool {
        self.methods.get(ty).is_some_and(|methods| methods.contains_key(method))
    }

    /// The type with methods in many files that alone has one of this name.
    pub fn only_owner(&self, method: &str) -> Option<&Type> {
        let owners = self.owners.get(method).filter(|owners| owners.len() == 1)?;
        owners.first().filter(|ty| self.methods.get(ty).is_some_and(|methods| n_files(methods) > super::FEW))
    }

    fn blocks(&self, module: &Module, tokens: &[&str]) -> Vec<Block> {
        let is_start = |at: usize| at == 0 || ["}", ";", "]", "unsafe", "{"].contains(&tokens[at - 1]);
        let block = |at: usize| {
            let head = if tokens[at + 1] == "<" { behind(tokens, at + 1) } else { at + 1 };
            let open = head + tokens[head..].iter().position(|&t| t == "{")?;
            // What is behind a `for` is the type, unless it binds a lifetime.
            let of_trait = (head..open).find(|&k| tokens[k] == "for" && tokens[k + 1] != "<");
            let of = self.named(module, &tokens[of_trait.map_or(head, |k| k + 1)..open], None)?;
            Some(Block { of, is_of_trait: of_trait.is_some(), body: open + 1..behind(tokens, open) - 1 })
        };
        (0..tokens.len()).filter(|&at| tokens[at] == "impl" && is_start(at)).filter_map(block).collect()
    }

    /// Notes what a file defines.
    fn declare(&mut self, module: &Module, tokens: &[&str]) {
        for block in self.blocks(module, tokens) {
            for (name, at) in functions(tokens, block.body.clone()) {
                if !block.is_of_trait {
                    let methods = self.methods.entry(block.of.clone()).or_default();
                    methods.entry(name.to_owned()).or_default().insert(module.clone());
                }
                self.owners.entry(name.to_owned()).or_default().insert(block.of.clone());
                let returned = Signature::at(tokens, at).returned;
                if let Some(ty) = returned.and_then(|tell| self.named(module, &tokens[tell], Some(&block.of)))
                {
                    self.returned.insert((block.of.clone(), name.to_owned()), ty);
                }
            }
        }
        for at in 0..tokens.len() {
            let open = || {
                (at..tokens.len())
                    .find(|&k| ["{", ";", "("].contains(&tokens[k]))
                    .filter(|&k| tokens[k] == "{")
            };
            match tokens[at] {
                "struct" => {
                    open().into_iter().for_each(|open| self.declare_fields(module, tokens, at + 1, open))
                }
                "trait" => open().into_iter().for_each(|open| {
                    for (name, _) in functions(tokens, open + 1..behind(tokens, open) - 1) {
                        let of = (module.clone(), tokens[at + 1].to_owned());
                        self.owners.entry(name.to_owned()).or_default().insert(of);
                    }
                }),
                _ => {}
            }
        }
    }

    fn declare_fields(&mut self, module: &Module, tokens: &[&str], name: usize, open: usize) {
        let of = (module.clone(), tokens[name].to_owned());
        for part in parts(tokens, open + 1..behind(tokens, open) - 1) {
            let Some(colon) = part.clone().find(|&k| tokens[k] == ":") else { continue };
            if let Some(ty) = self.named(module, &tokens[colon + 1..part.end], Some(&of)) {
                self.fields.insert((of.clone(), tokens[colon - 1].to_owned()), ty);
            }
        }
    }
}

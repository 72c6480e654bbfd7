//! Which method of which type a call is of, as far as reading tells.
//!
//! A method is known by the type of what it is called of: `self`, a parameter, a local value, a field, what a function
//! returns. Where that is not known, a name that a single type of the crate has is of that type.

use super::crates::{Method, Module, Sources, absolute};
use super::tokens::{Tokens, behind, is_name, opening};
use std::collections::{BTreeMap, BTreeSet};

/// A type: the module that defines it, and its name.
pub type Type = (Module, String);

/// Names that types of the standard library have, too: alone they tell nothing.
const COMMON: &str = "all any append chain chunks clear clone cloned collect contains copied count enumerate extend \
                      fill filter find first flatten fold get insert is_empty is_finite iter last len lock map max min \
                      new next parse peek pop position product push read remove repeat replace reserve resize rev skip \
                      sort split sum swap take truncate update windows write zip";

/// What gives the value in an `Option` or a `Box`, or a reference to it.
const WITHIN: [&str; 12] = [
    "as_deref",
    "as_deref_mut",
    "as_mut",
    "as_ref",
    "clone",
    "expect",
    "get_or_insert_default",
    "take",
    "unwrap",
    "unwrap_or_default",
    "borrow",
    "borrow_mut",
];

/// The files that define the methods of each type, by their names.
pub type Methods = BTreeMap<Type, BTreeMap<String, BTreeSet<Module>>>;

/// The methods of all types, and which of them each file calls.
pub fn of<'t>(
    files: &BTreeMap<&'t Module, Tokens<'_>>,
    sources: &Sources,
) -> (Methods, BTreeMap<&'t Module, BTreeSet<Method>>) {
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
    let called = files.iter().map(|(&module, tokens)| (module, known.called(module, tokens))).collect();
    (known.methods, called)
}

struct Known<'s> {
    sources: &'s Sources,
    methods: Methods,
    /// What a method returns, and the type of a field.
    returned: BTreeMap<Method, Type>,
    fields: BTreeMap<Method, Type>,
    /// The types, and the traits, that have a method of a name.
    owners: BTreeMap<String, BTreeSet<Type>>,
}

/// An `impl`: of what type, whether of a trait, and the tokens of its body.
struct Block {
    of: Type,
    is_of_trait: bool,
    body: std::ops::Range<usize>,
}

impl Known<'_> {
    /// The type that tokens name, behind references, and in an `Option`, a `Box` or a `Result`.
    fn named(&self, module: &Module, tokens: &[&str], own: Option<&Type>) -> Option<Type> {
        let at = tokens.iter().position(|t| is_name(t) && !["mut", "dyn", "impl", "const"].contains(t))?;
        if at > 0 && ["[", "("].contains(&tokens[0]) || at > 0 && tokens[..at].contains(&"[") {
            return None;
        }
        let mut end = at;
        let mut path = vec![tokens[at].to_owned()];
        while tokens.get(end + 1) == Some(&"::") && tokens.get(end + 2).is_some_and(|t| is_name(t)) {
            end += 2;
            path.push(tokens[end].to_owned());
        }
        match path.last()?.as_str() {
            "Self" => own.cloned(),
            "Option" | "Box" | "Result" | "Rc" | "Arc" if tokens.get(end + 1) == Some(&"<") => {
                self.named(module, &tokens[end + 2..], own)
            }
            _ => self.type_of_path(module, &path),
        }
    }

    fn type_of_path(&self, module: &Module, path: &[String]) -> Option<Type> {
        let source = &self.sources.files[module];
        let path = match source.names.get(&path[0]) {
            Some(start) => [start.as_slice(), &path[1..]].concat(),
            None => absolute(path, module)?,
        };
        let (definer, rest) = self.sources.definer(&path)?;
        Some((definer, rest.first()?.clone()))
    }

    fn blocks(&self, module: &Module, tokens: &[&str]) -> Vec<Block> {
        let mut blocks = Vec::new();
        let mut at = 0;
        while at < tokens.len() {
            let is_start = at == 0 || ["}", ";", "]", "unsafe", "{"].contains(&tokens[at - 1]);
            if tokens[at] != "impl" || !is_start {
                at += 1;
                continue;
            }
            let mut head = at + 1;
            if tokens[head] == "<" {
                head = behind(tokens, head);
            }
            let open = head + tokens[head..].iter().position(|&t| t == "{").expect("a block has a body");
            let end = behind(tokens, open);
            let split = tokens[head..open].iter().position(|&t| t == "for");
            let split = split.filter(|&k| tokens[head + k + 1] != "<");
            let is_of_trait = split.is_some();
            let named = &tokens[head + split.map_or(0, |k| k + 1)..open];
            if let Some(of) = self.named(module, named, None) {
                blocks.push(Block { of, is_of_trait, body: open + 1..end - 1 });
            }
            at = open + 1;
        }
        blocks
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
                let signature = Signature::at(tokens, at);
                if let Some(returned) =
                    signature.returned.and_then(|r| self.named(module, &tokens[r], Some(&block.of)))
                {
                    self.returned.insert((block.of.clone(), name.to_owned()), returned);
                }
            }
        }
        for at in 0..tokens.len() {
            match tokens[at] {
                "struct" => self.declare_fields(module, tokens, at),
                "trait" => {
                    let open = at + tokens[at..].iter().position(|&t| t == "{").expect("a trait has a body");
                    let of = (module.clone(), tokens[at + 1].to_owned());
                    for (name, _) in functions(tokens, open + 1..behind(tokens, open) - 1) {
                        self.owners.entry(name.to_owned()).or_default().insert(of.clone());
                    }
                }
                _ => {}
            }
        }
    }

    fn declare_fields(&mut self, module: &Module, tokens: &[&str], at: usize) {
        let of = (module.clone(), tokens[at + 1].to_owned());
        let Some(open) = (at..tokens.len()).find(|&k| ["{", ";", "("].contains(&tokens[k])) else { return };
        if tokens[open] != "{" {
            return;
        }
        for part in split(tokens, open + 1..behind(tokens, open) - 1) {
            let Some(colon) = part.clone().find(|&k| tokens[k] == ":") else { continue };
            if let Some(ty) = self.named(module, &tokens[colon + 1..part.end], Some(&of)) {
                self.fields.insert((of.clone(), tokens[colon - 1].to_owned()), ty);
            }
        }
    }

    /// The methods that a file calls.
    fn called(&self, module: &Module, tokens: &[&str]) -> BTreeSet<Method> {
        let mut called = BTreeSet::new();
        let blocks = self.blocks(module, tokens);
        for (_, at) in functions(tokens, 0..tokens.len()) {
            let own = blocks.iter().find(|block| block.body.contains(&at)).map(|block| &block.of);
            let signature = Signature::at(tokens, at);
            let mut body = Body { known: self, module, tokens, own, locals: BTreeMap::new() };
            body.take_parameters(&signature);
            body.visit(signature.body, &mut called);
        }
        called
    }
}

/// A function body as it is read.
struct Body<'k> {
    known: &'k Known<'k>,
    module: &'k Module,
    tokens: &'k [&'k str],
    own: Option<&'k Type>,
    locals: BTreeMap<&'k str, Option<Type>>,
}

impl<'k> Body<'k> {
    fn take_parameters(&mut self, signature: &Signature) {
        for part in &signature.parameters {
            let part = part.clone();
            if let Some(colon) = part.clone().find(|&k| self.tokens[k] == ":") {
                self.declare(colon, part.end);
            }
        }
    }

    /// Notes the type of the name before a colon, which the tokens behind it have.
    fn declare(&mut self, colon: usize, end: usize) {
        let ty = self.known.named(self.module, &self.tokens[colon + 1..end], self.own);
        self.locals.insert(self.tokens[colon - 1], ty);
    }

    fn visit(&mut self, body: std::ops::Range<usize>, called: &mut BTreeSet<Method>) {
        let tokens = self.tokens;
        for at in body {
            if tokens[at] == "let" {
                self.visit_let(at);
            }
            if tokens[at] == "|" && tokens[at - 1] != "|" {
                self.visit_closure(at);
            }
            let is_call = is_name(tokens[at]) && matches!(tokens.get(at + 1), Some(&"(" | &"::"));
            if !is_call || tokens.get(at + 1) == Some(&"::") && tokens.get(at + 2) != Some(&"<") {
                // A method that is named and not called here.
                if !(is_name(tokens[at]) && tokens[at - 1] == "::") {
                    continue;
                }
            }
            let name = tokens[at];
            let ty = match tokens[at - 1] {
                "." => self.type_before(at - 1),
                "::" => self.path_type_before(at - 1),
                _ => continue,
            };
            match ty {
                Some(ty) => {
                    if self.known.methods.get(&ty).is_some_and(|methods| methods.contains_key(name)) {
                        called.insert((ty, name.to_owned()));
                    }
                }
                None if tokens[at - 1] == "." && !COMMON.split_whitespace().any(|common| common == name) => {
                    let owners = self.known.owners.get(name);
                    if let Some(ty) = owners.filter(|owners| owners.len() == 1).and_then(BTreeSet::first)
                        && self.known.methods.get(ty).is_some_and(|methods| methods.contains_key(name))
                        && self.known.methods[ty].values().flatten().collect::<BTreeSet<_>>().len() > 3
                    {
                        called.insert((ty.clone(), name.to_owned()));
                    }
                }
                None => {}
            }
        }
    }

    /// Notes the type of the value that a declaration names.
    fn visit_let(&mut self, at: usize) {
        let tokens = self.tokens;
        let mut name = at + 1;
        while ["mut", "ref"].contains(&tokens[name]) {
            name += 1;
        }
        if tokens[name] == "Some" || tokens[name] == "Ok" {
            name += 2;
            while ["mut", "ref"].contains(&tokens[name]) {
                name += 1;
            }
        }
        if !is_name(tokens[name]) {
            return;
        }
        let mut next = name + 1;
        while tokens.get(next) == Some(&")") {
            next += 1;
        }
        if tokens.get(next) == Some(&":") {
            let end = (next..tokens.len()).find(|&k| ["=", ";"].contains(&tokens[k])).unwrap_or(tokens.len());
            self.declare(next, end);
        } else if tokens.get(next) == Some(&"=") {
            let mut end = next + 1;
            while end < tokens.len() && ![";", "else", "{", "&"].contains(&tokens[end]) || end == next + 1 {
                end = if ["(", "["].contains(&tokens[end]) { behind(tokens, end) } else { end + 1 };
            }
            let ty = if tokens[end] == "{" && tokens.get(next + 1) != Some(&"&") && end == next + 2 {
                self.known.named(self.module, &tokens[next + 1..end], self.own)
            } else {
                self.type_before(end)
            };
            self.locals.insert(tokens[name], ty);
        }
    }

    /// Notes the types of a closure's parameters: those that are not told are not known.
    fn visit_closure(&mut self, at: usize) {
        let tokens = self.tokens;
        let Some(end) = (at + 1..tokens.len().min(at + 40)).find(|&k| ["|", ";", "{"].contains(&tokens[k]))
        else {
            return;
        };
        if tokens[end] != "|" {
            return;
        }
        for part in split(tokens, at + 1..end) {
            if let Some(colon) = part.clone().find(|&k| tokens[k] == ":") {
                self.declare(colon, part.end);
            } else {
                for k in part {
                    if is_name(tokens[k]) && !["mut", "ref"].contains(&tokens[k]) {
                        self.locals.insert(tokens[k], None);
                    }
                }
            }
        }
    }

    /// The type of the expression that ends before a token.
    fn type_before(&self, end: usize) -> Option<Type> {
        let tokens = self.tokens;
        let last = end.checked_sub(1)?;
        match tokens[last] {
            "?" => self.type_before(last),
            ")" => {
                let open = opening(tokens, last);
                let mut name = open.checked_sub(1)?;
                if tokens[name] == ">" {
                    name = opening(tokens, name).checked_sub(2)?;
                }
                if !is_name(tokens[name]) {
                    return None;
                }
                match tokens[name - 1] {
                    "." => {
                        let ty = self.type_before(name - 1)?;
                        if WITHIN.contains(&tokens[name]) {
                            return Some(ty);
                        }
                        self.known.returned.get(&(ty, tokens[name].to_owned())).cloned()
                    }
                    "::" => {
                        let ty = self.path_type_before(name - 1)?;
                        self.known.returned.get(&(ty, tokens[name].to_owned())).cloned()
                    }
                    _ => None,
                }
            }
            name if is_name(name) => match tokens[last - 1] {
                "." => {
                    let ty = self.type_before(last - 1)?;
                    self.known.fields.get(&(ty, name.to_owned())).cloned()
                }
                "::" => None,
                _ if name == "self" => self.own.cloned(),
                _ => self.locals.get(name).cloned().flatten(),
            },
            _ => None,
        }
    }

    /// The type that a path names before a `::`.
    fn path_type_before(&self, colons: usize) -> Option<Type> {
        let tokens = self.tokens;
        let mut last = colons.checked_sub(1)?;
        if tokens[last] == ">" {
            last = opening(tokens, last).checked_sub(2)?;
        }
        if tokens[last] == "Self" {
            return self.own.cloned();
        }
        if !is_name(tokens[last]) {
            return None;
        }
        let mut path = vec![tokens[last].to_owned()];
        while last >= 2 && tokens[last - 1] == "::" && is_name(tokens[last - 2]) {
            last -= 2;
            path.insert(0, tokens[last].to_owned());
        }
        self.known.type_of_path(self.module, &path)
    }
}

/// The functions that tokens declare, and where their names are.
fn functions<'t>(tokens: &[&'t str], within: std::ops::Range<usize>) -> Vec<(&'t str, usize)> {
    let named = within.filter(|&k| tokens[k] == "fn" && tokens.get(k + 1).is_some_and(|t| is_name(t)));
    named.map(|k| (tokens[k + 1], k + 1)).collect()
}

/// The parts of a function.
struct Signature {
    parameters: Vec<std::ops::Range<usize>>,
    returned: Option<std::ops::Range<usize>>,
    body: std::ops::Range<usize>,
}

impl Signature {
    /// That of the function whose name is at a place.
    fn at(tokens: &[&str], name: usize) -> Self {
        let mut open = name + 1;
        if tokens[open] == "<" {
            open = behind_generics(tokens, open);
        }
        let close = behind(tokens, open);
        let mut end = close;
        while end < tokens.len() && !["{", ";"].contains(&tokens[end]) {
            end = if ["[", "("].contains(&tokens[end]) { behind(tokens, end) } else { end + 1 };
        }
        let is_returning = tokens.get(close) == Some(&"->");
        let body = if tokens.get(end) == Some(&"{") { end + 1..behind(tokens, end) - 1 } else { end..end };
        Signature {
            parameters: split(tokens, open + 1..close - 1),
            returned: is_returning.then_some(close + 1..end),
            body,
        }
    }
}

/// Behind generic parameters, in which an arrow is a token of its own.
fn behind_generics(tokens: &[&str], open: usize) -> usize {
    behind(tokens, open)
}

/// Parts between commas that are in no brackets.
fn split(tokens: &[&str], within: std::ops::Range<usize>) -> Vec<std::ops::Range<usize>> {
    let mut parts = Vec::new();
    let (mut start, mut at) = (within.start, within.start);
    let mut angles = 0;
    while at < within.end {
        match tokens[at] {
            "(" | "[" | "{" => {
                at = behind(tokens, at);
                continue;
            }
            "<" => angles += 1,
            ">" => angles -= 1,
            "," if angles == 0 => {
                parts.push(start..at);
                start = at + 1;
            }
            _ => {}
        }
        at += 1;
    }
    if start < within.end {
        parts.push(start..within.end);
    }
    parts
}

//! Which method of which type a call is of, as far as reading tells.
//!
//! A method is known by the type of what it is called of: `self`, a parameter, a local value, a field, what a method
//! returns. Where that is not known, a name that a single type has is of that type, if its methods are in many files.

use super::calls::{Known, Method, Type};
use super::crates::Module;
use super::tokens::{Signature, behind, is_name, opening, parts};
use std::collections::{BTreeMap, BTreeSet};

/// Names that types of the standard library have, too: alone they tell nothing.
const COMMON: &str = "all any append chain chunks clear clone cloned collect contains copied count enumerate extend \
                      fill filter find first flatten fold get insert is_empty is_finite iter last len lock map max min \
                      new next parse peek pop position product push read remove repeat replace reserve resize rev skip \
                      sort split sum swap take truncate update windows write zip";

/// What gives the value in an `Option` or a `Box`, or a reference to it.
const WITHIN: &str = "as_deref as_deref_mut as_mut as_ref clone expect get_or_insert_default take unwrap";

/// Whether a name is one of these.
fn is_among(names: &str, name: &str) -> bool {
    names.split_whitespace().any(|other| other == name)
}

/// Notes the methods that a function calls; `own` is the type that `Self` stands for.
pub fn visit(
    known: &Known,
    module: &Module,
    tokens: &[&str],
    own: Option<&Type>,
    signature: &Signature,
    called: &mut BTreeSet<Method>,
) {
    let mut body = Body { known, module, tokens, own, locals: BTreeMap::new() };
    for part in signature.parameters.clone() {
        if let Some(colon) = part.clone().find(|&k| tokens[k] == ":") {
            body.declare(colon, part.end);
        }
    }
    for at in signature.body.clone() {
        match tokens[at] {
            "let" => body.visit_let(at),
            "|" if tokens[at - 1] != "|" => body.visit_closure(at),
            name if is_name(name) => called.extend(body.method_at(at)),
            _ => {}
        }
    }
}

/// A function body as far as it has been read.
struct Body<'b> {
    known: &'b Known<'b>,
    module: &'b Module,
    tokens: &'b [&'b str],
    own: Option<&'b Type>,
    /// Local values; those of which nothing is known hide others of their names.
    locals: BTreeMap<&'b str, Option<Type>>,
}

impl Body<'_> {
    /// The method that is called, or named behind its type, at a token.
    fn method_at(&self, at: usize) -> Option<Method> {
        let (name, next) = (self.tokens[at], &self.tokens[at + 1..]);
        let is_call = next.first() == Some(&"(") || next.starts_with(&["::", "<"]);
        let ty = match self.tokens[at - 1] {
            "::" => self.type_of_path_before(at - 1)?,
            "." if is_call => match self.type_before(at - 1) {
                Some(ty) => ty,
                None if is_among(COMMON, name) => return None,
                None => self.known.only_owner(name)?.clone(),
            },
            _ => return None,
        };
        self.known.has(&ty, name).then(|| (ty, name.to_owned()))
    }

    /// Notes the type of the name before a colon, which the tokens behind it tell.
    fn declare(&mut self, colon: usize, end: usize) {
        let ty = self.known.named(self.module, &self.tokens[colon + 1..end], self.own);
        self.locals.insert(self.tokens[colon - 1], ty);
    }

    /// Notes the type of the value that a `let` names, or of the fields that it takes apart.
    fn visit_let(&mut self, at: usize) {
        let tokens = self.tokens;
        let is_around = |token: &str| ["mut", "ref", "Some", "Ok", "("].contains(&token);
        let Some(name) = (at + 1..tokens.len()).find(|&k| !is_around(tokens[k])) else { return };
        let next = (name + 1..tokens.len()).find(|&k| tokens[k] != ")").unwrap_or(name);
        match tokens[next] {
            _ if !is_name(tokens[name]) => {}
            ":" => {
                let end = (next..tokens.len()).find(|&k| ["=", ";"].contains(&tokens[k]));
                self.declare(next, end.unwrap_or(tokens.len()));
            }
            "{" => {
                let Some(ty) = self.known.named(self.module, &tokens[name..next], self.own) else { return };
                for part in parts(tokens, next + 1..behind(tokens, next) - 1) {
                    let names: Vec<&str> =
                        part.map(|k| tokens[k]).filter(|t| is_name(t) && *t != "mut").collect();
                    if let (Some(field), Some(local)) = (names.first(), names.last()) {
                        let ty = self.known.fields.get(&(ty.clone(), (*field).to_owned()));
                        self.locals.insert(local, ty.cloned());
                    }
                }
            }
            "=" => {
                let ty = self.type_of_value(next + 1);
                self.locals.insert(tokens[name], ty);
            }
            _ => {}
        }
    }

    /// The type of the expression that begins at a token.
    fn type_of_value(&self, start: usize) -> Option<Type> {
        let tokens = self.tokens;
        let mut end = start;
        while end < tokens.len() && ![";", "else", "{"].contains(&tokens[end]) {
            end = if ["(", "["].contains(&tokens[end]) { behind(tokens, end) } else { end + 1 };
        }
        if tokens.get(end) == Some(&"{") && end == start + 1 {
            return self.known.named(self.module, &tokens[start..end], self.own);
        }
        self.type_before(end)
    }

    /// Notes the types of a closure's parameters; those that are not told are not known.
    fn visit_closure(&mut self, at: usize) {
        let tokens = self.tokens;
        let end = (at + 1..tokens.len()).find(|&k| ["|", ";", "{", "}"].contains(&tokens[k]));
        let Some(end) = end.filter(|&end| tokens[end] == "|") else { return };
        for part in parts(tokens, at + 1..end) {
            match part.clone().find(|&k| tokens[k] == ":") {
                Some(colon) => self.declare(colon, part.end),
                None => part
                    .filter(|&k| is_name(tokens[k]))
                    .for_each(|k| drop(self.locals.insert(tokens[k], None))),
            }
        }
    }

    /// The type of the expression that ends before a token.
    fn type_before(&self, end: usize) -> Option<Type> {
        let tokens = self.tokens;
        let last = end.checked_sub(1)?;
        let of =
            |ty: Type, name: &str, types: &BTreeMap<Method, Type>| types.get(&(ty, name.to_owned())).cloned();
        match tokens[last] {
            "?" => self.type_before(last),
            ")" => {
                let mut name = opening(tokens, last).checked_sub(1)?;
                if tokens[name] == ">" {
                    name = opening(tokens, name).checked_sub(2)?;
                }
                let method = tokens[name];
                match tokens[name.checked_sub(1)?] {
                    "." if is_among(WITHIN, method) => self.type_before(name - 1),
                    "." => of(self.type_before(name - 1)?, method, &self.known.returned),
                    "::" => of(self.type_of_path_before(name - 1)?, method, &self.known.returned),
                    _ => None,
                }
            }
            name if is_name(name) => match tokens[last.checked_sub(1)?] {
                "." => of(self.type_before(last - 1)?, name, &self.known.fields),
                "::" => None,
                _ if name == "self" => self.own.cloned(),
                _ => self.locals.get(name).cloned().flatten(),
            },
            _ => None,
        }
    }

    /// The type that a path names before a `::`.
    fn type_of_path_before(&self, colons: usize) -> Option<Type> {
        let tokens = self.tokens;
        let mut last = colons.checked_sub(1)?;
        if tokens[last] == ">" {
            last = opening(tokens, last).checked_sub(2)?;
        }
        let mut first = last;
        while first >= 2 && tokens[first - 1] == "::" && is_name(tokens[first - 2]) {
            first -= 2;
        }
        self.known.named(self.module, &tokens[first..=last], self.own)
    }
}

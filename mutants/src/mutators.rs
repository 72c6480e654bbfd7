//! Which mutants there are: those of cargo-mutants, conditions that are forced, and statements that are deleted.

use std::ops::Range;

use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{BinOp, Block, Expr, Pat, ReturnType, Stmt, Type, UnOp};

use crate::edits::Edits;

pub struct Mutant {
    pub id: u32,
    pub line: usize,
    pub function: String,
    pub change: String,
}

pub struct Mutators<'a> {
    text: &'a str,
    next: u32,
    /// The types and functions around.
    names: Vec<String>,
    constant: bool,
    pub mutants: Vec<Mutant>,
    pub skipped: usize,
    pub edits: Edits,
}

/// The call that asks whether a mutant is alive.
fn on(id: u32) -> String {
    format!("crate::mutation::on({id})")
}

pub fn is_for_tests(attributes: &[syn::Attribute]) -> bool {
    let is_test = |attribute: &syn::Attribute| {
        attribute.path().is_ident("test")
            || attribute.path().is_ident("cfg")
                && attribute.parse_args::<syn::Path>().is_ok_and(|path| path.is_ident("test"))
    };
    attributes.iter().any(is_test)
}

/// What cargo-mutants puts in place of an operator.
fn others(operator: &BinOp) -> (&'static str, &'static [&'static str]) {
    match operator {
        BinOp::Eq(_) => ("==", &["!="]),
        BinOp::Ne(_) => ("!=", &["=="]),
        BinOp::And(_) => ("&&", &["||"]),
        BinOp::Or(_) => ("||", &["&&"]),
        BinOp::Lt(_) => ("<", &["==", ">", "<="]),
        BinOp::Gt(_) => (">", &["==", "<", ">="]),
        BinOp::Le(_) => ("<=", &[">", "<"]),
        BinOp::Ge(_) => (">=", &["<", ">"]),
        BinOp::Add(_) => ("+", &["-", "*"]),
        BinOp::Sub(_) => ("-", &["+", "/"]),
        BinOp::Mul(_) => ("*", &["+", "/"]),
        BinOp::Div(_) => ("/", &["%", "*"]),
        BinOp::Rem(_) => ("%", &["/", "+"]),
        BinOp::Shl(_) => ("<<", &[">>"]),
        BinOp::Shr(_) => (">>", &["<<"]),
        BinOp::BitAnd(_) => ("&", &["|", "^"]),
        BinOp::BitOr(_) => ("|", &["&", "^"]),
        BinOp::BitXor(_) => ("^", &["|", "&"]),
        BinOp::AddAssign(_) => ("+=", &["-=", "*="]),
        BinOp::SubAssign(_) => ("-=", &["+=", "/="]),
        BinOp::MulAssign(_) => ("*=", &["+=", "/="]),
        BinOp::DivAssign(_) => ("/=", &["%=", "*="]),
        BinOp::RemAssign(_) => ("%=", &["/=", "+="]),
        BinOp::ShlAssign(_) => ("<<=", &[">>="]),
        BinOp::ShrAssign(_) => (">>=", &["<<="]),
        BinOp::BitAndAssign(_) => ("&=", &["|="]),
        BinOp::BitOrAssign(_) => ("|=", &["&="]),
        BinOp::BitXorAssign(_) => ("^=", &["|=", "&="]),
        _ => ("", &[]),
    }
}

/// Values that a function may give instead. Those that its type has not are found by compiling.
fn values(output: &ReturnType) -> &'static [&'static str] {
    let ReturnType::Type(_, of) = output else { return &["()"] };
    let Type::Path(path) = &**of else {
        return match &**of {
            Type::Tuple(tuple) if tuple.elems.is_empty() => &["()"],
            Type::Tuple(_) | Type::Array(_) => &["Default::default()"],
            _ => &[],
        };
    };
    match path.path.segments.last().map(|segment| segment.ident.to_string()).as_deref() {
        Some("bool") => &["true", "false"],
        Some("f64" | "f32") => &["0.0", "1.0", "-1.0"],
        Some("u8" | "u16" | "u32" | "u64" | "u128" | "usize") => &["0", "1"],
        Some("i8" | "i16" | "i32" | "i64" | "i128" | "isize") => &["0", "1", "-1"],
        Some("Option") => &["None", "Some(Default::default())"],
        Some("Result") => &["Ok(Default::default())"],
        _ => &["Default::default()"],
    }
}

/// Whether a condition binds names, and cannot be put in parentheses.
fn binds(condition: &Expr) -> bool {
    match condition {
        Expr::Let(_) => true,
        Expr::Binary(binary) => binds(&binary.left) || binds(&binary.right),
        _ => false,
    }
}

/// Statements worth deleting: calls, assignments and jumps, not declarations.
fn may_go(statement: &Expr) -> bool {
    match statement {
        Expr::Try(inner) => may_go(&inner.expr),
        Expr::Binary(binary) => others(&binary.op).0.ends_with('='),
        Expr::Call(_) | Expr::MethodCall(_) | Expr::Assign(_) => true,
        Expr::Return(_) | Expr::Break(_) | Expr::Continue(_) => true,
        _ => false,
    }
}

fn place(of: &impl Spanned) -> Range<usize> {
    of.span().byte_range()
}

impl<'a> Mutators<'a> {
    pub fn new(text: &'a str, next: u32) -> Mutators<'a> {
        let (names, mutants, edits) = (Vec::new(), Vec::new(), Edits::default());
        Mutators { text, next, names, constant: false, mutants, skipped: 0, edits }
    }

    fn source(&self, of: &impl Spanned) -> &'a str {
        &self.text[place(of)]
    }

    fn mutant(&mut self, at: &impl Spanned, change: String) -> Option<u32> {
        if self.constant {
            self.skipped += 1;
            return None;
        }
        let id = self.next;
        self.next += 1;
        let line = at.span().start().line;
        self.mutants.push(Mutant { id, line, function: self.names.join("::"), change });
        Some(id)
    }

    /// An expression, and what may stand in its place: name and text.
    fn instead(&mut self, expression: &Expr, others: Vec<(String, String)>) {
        let mut mutants = Vec::new();
        for (change, text) in others {
            if let Some(id) = self.mutant(expression, change) {
                mutants.push((id, format!("if {} {{ {text} }} else ", on(id))));
            }
        }
        self.edits.around(place(expression), ["(", "{ ", " })"], mutants);
    }

    /// A condition that may be forced to each of `values`.
    fn forced(&mut self, what: &str, condition: &Expr, values: &[bool]) {
        let mut mutants = Vec::new();
        for value in values {
            if let Some(id) = self.mutant(condition, format!("{what} is {value}")) {
                let force = if *value { format!("{} || ", on(id)) } else { format!("!{} && ", on(id)) };
                mutants.push((id, force));
            }
        }
        self.edits.around(place(condition), ["(", "(", "))"], mutants);
    }

    fn body(&mut self, signature: &syn::Signature, block: &Block) {
        let Some(first) = block.stmts.first() else { return };
        let mut mutants = Vec::new();
        for value in values(&signature.output) {
            if let Some(id) = self.mutant(&signature.ident, format!("returns {value}")) {
                mutants.push((id, format!("if {} {{ return {value}; }} ", on(id))));
            }
        }
        let start = place(first).start;
        self.edits.around(start..start, ["", "", ""], mutants);
    }

    fn function(&mut self, signature: &syn::Signature, block: &Block) {
        self.names.push(signature.ident.to_string());
        let constant = self.constant;
        self.constant |= signature.constness.is_some();
        self.body(signature, block);
        self.visit_block(block);
        self.constant = constant;
        self.names.pop();
    }

    fn constant(&mut self, expression: &Expr) {
        let constant = std::mem::replace(&mut self.constant, true);
        self.visit_expr(expression);
        self.constant = constant;
    }
}

impl<'ast> Visit<'ast> for Mutators<'_> {
    fn visit_item(&mut self, item: &'ast syn::Item) {
        let (attributes, name) = match item {
            syn::Item::Fn(item) => (&item.attrs, None),
            syn::Item::Mod(item) => (&item.attrs, Some(item.ident.to_string())),
            syn::Item::Impl(item) => (&item.attrs, Some(self.source(&item.self_ty).to_owned())),
            syn::Item::Trait(item) => (&item.attrs, Some(item.ident.to_string())),
            syn::Item::Const(item) => return self.constant(&item.expr),
            syn::Item::Static(item) => return self.constant(&item.expr),
            _ => return,
        };
        if is_for_tests(attributes) {
            return;
        }
        let named = name.is_some();
        self.names.extend(name);
        visit::visit_item(self, item);
        if named {
            self.names.pop();
        }
    }

    fn visit_item_fn(&mut self, function: &'ast syn::ItemFn) {
        self.function(&function.sig, &function.block);
    }

    fn visit_impl_item_fn(&mut self, function: &'ast syn::ImplItemFn) {
        if !is_for_tests(&function.attrs) {
            self.function(&function.sig, &function.block);
        }
    }

    fn visit_trait_item_fn(&mut self, function: &'ast syn::TraitItemFn) {
        if let Some(block) = &function.default {
            self.function(&function.sig, block);
        }
    }

    fn visit_impl_item_const(&mut self, item: &'ast syn::ImplItemConst) {
        self.constant(&item.expr);
    }

    fn visit_expr_const(&mut self, _: &'ast syn::ExprConst) {}

    fn visit_pat(&mut self, _: &'ast Pat) {}

    fn visit_type(&mut self, _: &'ast Type) {}

    fn visit_path(&mut self, _: &'ast syn::Path) {}

    fn visit_expr_method_call(&mut self, call: &'ast syn::ExprMethodCall) {
        self.visit_expr(&call.receiver);
        call.args.iter().for_each(|argument| self.visit_expr(argument));
    }

    fn visit_expr_repeat(&mut self, repeat: &'ast syn::ExprRepeat) {
        self.visit_expr(&repeat.expr);
        self.constant(&repeat.len);
    }

    fn visit_expr(&mut self, expression: &'ast Expr) {
        match expression {
            Expr::Binary(binary) if !binds(expression) => {
                let (operator, others) = others(&binary.op);
                let (left, right) = (self.source(&binary.left), self.source(&binary.right));
                let change =
                    |other: &&str| (format!("{operator} is {other}"), format!("{left} {other} {right}"));
                self.instead(expression, others.iter().map(change).collect());
            }
            Expr::Unary(unary) if !matches!(unary.op, UnOp::Deref(_)) => {
                let sign = if matches!(unary.op, UnOp::Not(_)) { "!" } else { "-" };
                let text = self.source(&unary.expr).to_owned();
                self.instead(expression, vec![(format!("{sign} is left out"), text)]);
            }
            Expr::If(conditional) if !binds(&conditional.cond) => {
                self.forced("if", &conditional.cond, &[true, false]);
            }
            Expr::While(repeated) if !binds(&repeated.cond) => self.forced("while", &repeated.cond, &[false]),
            _ => {}
        }
        visit::visit_expr(self, expression);
    }

    fn visit_expr_match(&mut self, choice: &'ast syn::ExprMatch) {
        self.visit_expr(&choice.expr);
        let has_rest =
            choice.arms.last().is_some_and(|arm| matches!(arm.pat, Pat::Wild(_)) && arm.guard.is_none());
        for (k, arm) in choice.arms.iter().enumerate() {
            let may_go = has_rest && k + 1 < choice.arms.len();
            match &arm.guard {
                Some((_, guard)) if !binds(guard) => self.forced("guard", guard, &[true, false]),
                None if may_go => {
                    let end = place(&arm.pat).end;
                    if let Some(id) =
                        self.mutant(&arm.pat, format!("arm {} is deleted", self.source(&arm.pat)))
                    {
                        self.edits.around(end..end, ["", "", ""], vec![(id, format!(" if !{}", on(id)))]);
                    }
                }
                _ => {}
            }
            arm.guard.iter().for_each(|(_, guard)| self.visit_expr(guard));
            self.visit_expr(&arm.body);
        }
    }

    fn visit_stmt(&mut self, statement: &'ast Stmt) {
        if let Stmt::Expr(expression, Some(_)) = statement
            && may_go(expression)
        {
            let text = self.source(expression);
            let shown: String =
                text.split_whitespace().collect::<Vec<_>>().join(" ").chars().take(60).collect();
            if let Some(id) = self.mutant(expression, format!("deleted: {shown}")) {
                let guard = format!("if !{} {{ ", on(id));
                self.edits.around(place(statement), ["", "", " }"], vec![(id, guard)]);
            }
        }
        visit::visit_stmt(self, statement);
    }
}

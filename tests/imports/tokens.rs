//! Sources in Rust as tokens, without comments, without what is quoted and without tests.

/// A name, a lifetime, a number, or a sign; `::`, `->`, `=>` and `..` are one each. What is quoted is `""`.
pub type Tokens<'t> = Vec<&'t str>;

/// The part of a file before its tests, which are last.
pub fn before_tests(text: &str) -> &str {
    text.split("\n#[cfg(test)]\nmod tests").next().expect("there is a first part")
}

/// The tokens of a text.
pub fn tokens(text: &str) -> Tokens<'_> {
    let mut tokens = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let n = if first.is_alphanumeric() || first == '_' {
            let end = |c: char| !c.is_alphanumeric() && c != '_';
            rest.find(end).unwrap_or(rest.len())
        } else if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").map_or(rest.len(), |at| at + 2)
        } else if first == '"' {
            quoted(rest)
        } else if first == '\'' {
            quoted_letter(rest)
        } else if ["::", "->", "=>", ".."].iter().any(|sign| rest.starts_with(sign)) {
            2
        } else {
            first.len_utf8()
        };
        let token = &rest[..n];
        if token.starts_with('"') {
            tokens.push("\"\"");
        } else if !first.is_whitespace() && !token.starts_with("//") && !token.starts_with("/*") {
            tokens.push(token);
        }
        rest = &rest[n..];
    }
    tokens
}

/// The length of a text in quotes.
fn quoted(rest: &str) -> usize {
    let mut is_escaped = false;
    for (at, c) in rest.char_indices().skip(1) {
        match c {
            _ if is_escaped => is_escaped = false,
            '\\' => is_escaped = true,
            '"' => return at + 1,
            _ => {}
        }
    }
    rest.len()
}

/// The length of a letter in quotes, or of a lifetime.
fn quoted_letter(rest: &str) -> usize {
    let letter = rest[1..].chars().next().map_or(0, char::len_utf8);
    if rest[1..].starts_with('\\') {
        rest[3..].find('\'').map_or(rest.len(), |at| at + 4)
    } else if rest[1 + letter..].starts_with('\'') {
        letter + 2
    } else {
        1 + rest[1..].find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len() - 1)
    }
}

/// Behind the bracket that closes the one at a place; `<` and `>` are brackets where the first one is.
pub fn behind(tokens: &[&str], open: usize) -> usize {
    let is_angled = tokens[open] == "<";
    let mut depth = 0;
    for (at, token) in tokens.iter().enumerate().skip(open) {
        match *token {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth -= 1,
            "<" if is_angled => depth += 1,
            ">" if is_angled => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return at + 1;
        }
    }
    tokens.len()
}

/// Where the bracket is open that the one at a place closes.
pub fn opening(tokens: &[&str], close: usize) -> usize {
    let is_angled = tokens[close] == ">";
    let mut depth = 0;
    for at in (0..=close).rev() {
        match tokens[at] {
            ")" | "]" | "}" => depth += 1,
            "(" | "[" | "{" => depth -= 1,
            ">" if is_angled => depth += 1,
            "<" if is_angled => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return at;
        }
    }
    0
}

/// Whether a token is a name.
pub fn is_name(token: &str) -> bool {
    token.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

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

/// Places of tokens.
pub type Range = std::ops::Range<usize>;

/// The functions that tokens declare, and where their names are.
pub fn functions<'t>(tokens: &[&'t str], within: Range) -> Vec<(&'t str, usize)> {
    let named = within.filter(|&k| tokens[k] == "fn" && tokens.get(k + 1).is_some_and(|t| is_name(t)));
    named.map(|k| (tokens[k + 1], k + 1)).collect()
}

/// Where the parts of a function are.
pub struct Signature {
    pub parameters: Vec<Range>,
    pub returned: Option<Range>,
    pub body: Range,
}

impl Signature {
    /// That of the function whose name is at a place.
    pub fn at(tokens: &[&str], name: usize) -> Self {
        let open = if tokens[name + 1] == "<" { behind(tokens, name + 1) } else { name + 1 };
        let close = behind(tokens, open);
        let mut end = close;
        while end < tokens.len() && !["{", ";"].contains(&tokens[end]) {
            end = if ["[", "("].contains(&tokens[end]) { behind(tokens, end) } else { end + 1 };
        }
        let is_returning = tokens.get(close) == Some(&"->");
        let body = if tokens.get(end) == Some(&"{") { end + 1..behind(tokens, end) - 1 } else { end..end };
        Signature {
            parameters: parts(tokens, open + 1..close - 1),
            returned: is_returning.then_some(close + 1..end),
            body,
        }
    }
}

/// Parts between commas that are in no brackets.
pub fn parts(tokens: &[&str], within: Range) -> Vec<Range> {
    let mut parts = Vec::new();
    let (mut start, mut at, mut n_angles) = (within.start, within.start, 0);
    while at < within.end {
        match tokens[at] {
            "<" => n_angles += 1,
            ">" => n_angles -= 1,
            "," if n_angles == 0 => {
                parts.push(start..at);
                start = at + 1;
            }
            _ => {}
        }
        at = if ["(", "[", "{"].contains(&tokens[at]) { behind(tokens, at) } else { at + 1 };
    }
    parts.extend((start < within.end).then_some(start..within.end));
    parts
}

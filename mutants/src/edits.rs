//! Text put around expressions.

use std::collections::HashSet;
use std::ops::Range;

/// One place where text is put in. All places of one expression come and go together, by the mutants that need them.
struct Insertion {
    position: usize,
    /// Whether it closes what was opened before the expression.
    closes: bool,
    parts: Vec<Part>,
}

/// Text that is there for one mutant, or for any of the expression.
struct Part {
    ids: Vec<u32>,
    text: String,
}

#[derive(Default)]
pub struct Edits {
    insertions: Vec<Insertion>,
}

impl Edits {
    /// Puts `open` before an expression, then the text of each mutant, then `between`, and `close` after it.
    pub fn around(
        &mut self,
        place: Range<usize>,
        [open, between, close]: [&str; 3],
        mutants: Vec<(u32, String)>,
    ) {
        let ids: Vec<u32> = mutants.iter().map(|mutant| mutant.0).collect();
        let always = |text: &str| Part { ids: ids.clone(), text: text.to_owned() };
        let mut parts = vec![always(open)];
        parts.extend(mutants.into_iter().map(|(id, text)| Part { ids: vec![id], text }));
        parts.push(always(between));
        let closing = vec![always(close)];
        self.insertions.push(Insertion { position: place.start, closes: false, parts });
        self.insertions.push(Insertion { position: place.end, closes: true, parts: closing });
    }

    /// `text` with the insertions, without mutants that are left out. Outer expressions were added before inner ones:
    /// at one place, inner ones close first, and outer ones open first.
    pub fn applied_to(&self, text: &str, left_out: &HashSet<u32>) -> String {
        let mut order: Vec<(usize, &Insertion)> = self.insertions.iter().enumerate().collect();
        order.sort_by_key(|&(number, insertion)| {
            let number = i64::try_from(number).unwrap_or(i64::MAX);
            (insertion.position, !insertion.closes, if insertion.closes { -number } else { number })
        });
        let mut result = String::new();
        let mut done = 0;
        for (_, insertion) in order {
            result.push_str(&text[done..insertion.position]);
            done = insertion.position;
            for part in &insertion.parts {
                if part.ids.iter().any(|id| !left_out.contains(id)) {
                    result.push_str(&part.text);
                }
            }
        }
        result.push_str(&text[done..]);
        result
    }
}

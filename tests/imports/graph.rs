//! Arrows between rooms, and what they may not do: run up, or in a circle.

use std::collections::{BTreeMap, BTreeSet};

/// Pairs of rooms of which the first uses the second, each with what shows it.
pub type Arrows = BTreeMap<(String, String), BTreeSet<String>>;

/// Arrows that run to an earlier one of these floors, each of one room or several; every room with an arrow is in one.
pub fn upward(arrows: &Arrows, floors: &[&str]) -> Vec<String> {
    let at = |room: &str| {
        let at = floors.iter().position(|floor| floor.split(' ').any(|r| r == room));
        at.unwrap_or_else(|| panic!("there is no floor for {room}"))
    };
    arrows.iter().filter(|((from, to), _)| at(from) > at(to)).flat_map(|(_, ends)| ends.clone()).collect()
}

/// Prints the rooms of a folder, each before those that it uses. Returns what shows circles, by the rooms on each.
pub fn circles(folder: &str, arrows: &Arrows) -> Vec<String> {
    let reached = reached(arrows);
    let mut order: Vec<&str> = reached.keys().copied().collect();
    order.sort_by_key(|room| std::cmp::Reverse(reached[room].len()));
    println!("{folder}: {} arrows; {}", arrows.len(), order.join(" > "));
    let mut circles: BTreeMap<Vec<&str>, String> = BTreeMap::new();
    for ((from, to), ends) in arrows {
        if reached[to.as_str()].contains(from.as_str()) {
            let is_on = |room: &&&str| {
                reached[**room].contains(from.as_str()) && reached[from.as_str()].contains(**room)
            };
            let rooms = reached.keys().filter(is_on).copied().collect();
            let circle = circles.entry(rooms).or_default();
            ends.iter().for_each(|end| *circle += &format!("\n    {end}"));
        }
    }
    circles.iter().map(|(rooms, ends)| format!("{folder}: {}{ends}", rooms.join(", "))).collect()
}

/// The rooms that each room uses, itself or by others.
fn reached(arrows: &Arrows) -> BTreeMap<&str, BTreeSet<&str>> {
    let mut reached: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for (from, to) in arrows.keys() {
        reached.entry(to).or_default();
        reached.entry(from).or_default().insert(to);
    }
    loop {
        let before: usize = reached.values().map(BTreeSet::len).sum();
        for (from, to) in arrows.keys() {
            let further = reached[to.as_str()].clone();
            reached.get_mut(from.as_str()).expect("it has been entered").extend(further);
        }
        if reached.values().map(BTreeSet::len).sum::<usize>() == before {
            return reached;
        }
    }
}

#[test]
fn circles_are_found() {
    let arrows = |pairs: &[(&str, &str)]| -> Arrows {
        let named =
            |&(a, b): &(&str, &str)| ((a.to_owned(), b.to_owned()), BTreeSet::from([format!("{a} -> {b}")]));
        pairs.iter().map(named).collect()
    };
    assert_eq!(circles("x", &arrows(&[("a", "b"), ("b", "c"), ("a", "c")])), Vec::<String>::new());
    let found =
        circles("x", &arrows(&[("a", "b"), ("b", "c"), ("c", "b"), ("c", "d"), ("e", "f"), ("f", "e")]));
    assert_eq!(found, ["x: b, c\n    b -> c\n    c -> b", "x: e, f\n    e -> f\n    f -> e"]);
    assert_eq!(upward(&arrows(&[("a", "b"), ("b", "c"), ("c", "b")]), &["a", "b c"]), Vec::<String>::new());
    assert_eq!(upward(&arrows(&[("a", "b"), ("c", "b")]), &["a b", "c"]), ["c -> b"]);
}

//! Free slots, near and in hand.

use super::*;
use crate::random::Rng;
use std::collections::BTreeSet;

fn slots(free: &FreeSlots) -> BTreeSet<usize> {
    free.iter().map(Slot::index).collect()
}

#[test]
fn slots_are_taken_near() {
    let rng = &mut Rng::new(1);
    for n_slots in [1, 64, 65, 5000, 300_000, 900_000] {
        let mut free = FreeSlots::default();
        free.cover(n_slots).expect("room");
        free.in_hand.are_near_wanted = true;
        let mut expected = BTreeSet::new();
        for round in 0..3000 {
            let slot = rng.below(n_slots);
            // Many at first, then fewer and fewer, and none.
            if round < 1000 || round % 4 == 0 && round < 2000 {
                free.set(Slot::at(slot), true);
                expected.insert(slot);
                continue;
            }
            let Some(taken) = free.take_near(Slot::at(slot)) else {
                assert!(expected.is_empty());
                continue;
            };
            let smallest = [1, 64, 4096, 64 * 4096, usize::MAX].into_iter().find(|&size| {
                let first = slot / size * size;
                expected.range(first..first.saturating_add(size)).next().is_some()
            });
            let size = smallest.expect("one is free");
            let is_near = taken.index().abs_diff(slot) < NEAR;
            assert!(is_near || taken.index() / size == slot / size, "{taken:?} {slot} {size}");
            assert!(expected.remove(&taken.index()));
            assert_eq!(free.len(), expected.len());
        }
        assert_eq!(slots(&free), expected);
        assert!(n_slots > 65 || free.len() == 0);
    }
}

/// The latest first, unless they are to be near.
#[test]
fn the_latest_are_taken_first() {
    let mut free = FreeSlots::default();
    free.cover(100_000).expect("room");
    let some = [7, 90_000, 50, 40_000].map(Slot::new);
    let take = |free: &mut FreeSlots, near| free.take_near(Slot::new(near)).map(Slot::get);
    for is_local in [false, true] {
        if is_local {
            free.put_everywhere([Slot::new(39_000)].into_iter());
            assert_eq!(take(&mut free, 1), Some(39_000));
        }
        some.iter().for_each(|&slot| free.put(slot));
        let taken = [9; 5].map(|near| take(&mut free, near));
        // No others are there.
        assert_eq!(taken, [Some(40_000), Some(50), Some(90_000), Some(7), None], "{is_local}");
        // The first half of them is not in hand any more.
        let more = (0..33).map(|k| Slot::new(1000 * k));
        more.clone().for_each(|slot| free.put(slot));
        assert_eq!((free.len(), free.iter().count()), (33, 33));
        assert_eq!(take(&mut free, 3001), Some(if is_local { 3000 } else { 32_000 }));
        more.for_each(|slot| free.set(slot, false));
        assert_eq!((free.len(), free.iter().count()), (0, 0));
    }
}

/// What was free is so when there are more slots, and in a copy.
#[test]
fn few_slots_become_many() {
    let mut free = FreeSlots::default();
    free.cover(WORD).expect("room");
    (0..WORD).step_by(3).for_each(|slot| free.set(Slot::at(slot), true));
    let few = slots(&free);
    free.cover(100 * WORD).expect("room");
    assert_eq!((slots(&free), free.len()), (few.clone(), few.len()));
    free.set(Slot::at(99 * WORD), true);
    let copy = free.copied().expect("room");
    assert_eq!(slots(&copy), slots(&free));
    // From far away, by the upper levels.
    let far = Slot::at(50 * WORD);
    let taken: BTreeSet<usize> = std::iter::from_fn(|| free.take_near(far)).map(Slot::index).collect();
    assert_eq!(taken, slots(&copy));
    assert_eq!(free.levels, [vec![0; 100], vec![0; 2], vec![0]]);
}

#[test]
fn ranges_have_their_own_and_come_together() {
    let rng = &mut Rng::new(2);
    let n_slots = 40_000;
    let mut free = FreeSlots::default();
    free.cover(n_slots).expect("room");
    let mut expected = BTreeSet::new();
    for round in 0..20 {
        let starts = [0, 128 + round % 3 * 64, 12_800, 39_936].map(Slot::at);
        for _ in 0..100 {
            let slot = rng.below(n_slots);
            free.set(Slot::at(slot), true);
            expected.insert(slot);
        }
        let mut numbers = [0; 4];
        for (k, mut range) in free.ranges(&starts, &mut numbers).enumerate() {
            let end = starts.get(k + 1).map_or(n_slots, |end| end.index());
            let own: Vec<usize> = (starts[k].index()..end).collect();
            assert_eq!(*range.n, own.iter().filter(|slot| expected.contains(slot)).count());
            for _ in 0..50 {
                let slot = own[rng.below(own.len())];
                if rng.below(3) == 0 && !expected.contains(&slot) {
                    range.put(Slot::at(slot));
                    expected.insert(slot);
                } else if let Some(taken) = range.take_near(Slot::at(slot)) {
                    assert!(own.contains(&taken.index()) && expected.remove(&taken.index()));
                } else {
                    assert!(own.iter().all(|slot| !expected.contains(slot)));
                }
            }
        }
        free.count();
        assert_eq!((slots(&free), free.len()), (expected.clone(), expected.len()));
        let mut again = FreeSlots::default();
        again.cover(n_slots).expect("room");
        expected.iter().for_each(|&slot| again.set(Slot::at(slot), true));
        assert_eq!(again.levels, free.levels);
    }
}

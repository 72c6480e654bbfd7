//! What refinement and coarsening remember from call to call changes nothing: copies, which remember nothing, go on
//! alike.

use super::ids::assert_same;
use super::lives::domain_of;
use super::loops::Rotor;
use super::{Triangulation, seeds};
use crate::common::Rng;
use deldrift::motion::{CoarsenOptions, Options, Quality, QualityReport, RefineOptions, Saved, Segment};
use deldrift::{SegmentId, VertexId};

/// What is asked for, besides angles.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Asked {
    Angles,
    Area,
    /// By label, of which there are two.
    Areas,
    Sizes,
}

/// What one round calls.
#[derive(Clone, Copy, Debug)]
struct Round {
    asked: Asked,
    coarsens: bool,
    refines: bool,
    reuses_ids: bool,
    is_fine: bool,
}

impl Round {
    fn random(rng: &mut Rng, asked: Asked) -> Self {
        // Other numbers, now and then.
        let asked = if rng.below(10) == 0 {
            *rng.pick(&[Asked::Angles, Asked::Area, Asked::Areas, Asked::Sizes])
        } else {
            asked
        };
        Round {
            asked,
            coarsens: rng.below(8) > 0,
            refines: rng.below(8) > 0,
            reuses_ids: rng.below(4) == 0,
            is_fine: rng.below(12) == 0,
        }
    }

    /// Coarsens and refines; `sizes` are by vertex, and get those of the new ones.
    fn run(self, t: &mut Triangulation, sizes: &mut Vec<f64>) -> [Option<QualityReport>; 2] {
        let mut reports = [None; 2];
        for (k, is_called) in [self.coarsens, self.refines].into_iter().enumerate() {
            if !is_called {
                continue;
            }
            let mask = domain_of(t);
            let labels: Vec<u32> = t.cells().expect("room").corners.iter().map(|row| label(t, row)).collect();
            let bound = if self.is_fine { 0.012 } else { 0.02 };
            let asked = self.asked;
            sizes.resize(t.id_count(), 0.3);
            let quality = Quality {
                least_angle: 25.0,
                greatest_area: if asked == Asked::Area { bound } else { 0.0 },
                labels: (asked == Asked::Areas).then_some(&labels),
                areas: if asked == Asked::Areas { &[0.02, 0.012] } else { &[] },
                sizes: (asked == Asked::Sizes).then_some(sizes),
                ..Quality::default()
            };
            let options = RefineOptions { reuses_ids: self.reuses_ids, ..RefineOptions::default() };
            let done = match k {
                0 => t.coarsen(&quality, &CoarsenOptions::default(), &mask),
                _ => t.refine(&quality, &options, &mask),
            };
            reports[k] = Some(done.expect("a domain"));
        }
        reports
    }
}

/// By where a cell is.
fn label(t: &Triangulation, row: &[VertexId; 3]) -> u32 {
    let sum: f64 = row.map(|v| t.position(v).expect("present")[0]).iter().sum();
    u32::from(sum > 0.3)
}

/// A change of the program's between two rounds.
fn change(rotor: &mut Rotor, rng: &mut Rng, sizes: &mut [f64]) {
    let free: Vec<_> =
        rotor.t.made_vertices().filter(|&(_, on)| on == SegmentId::NONE).map(|(v, _)| v).collect();
    match rng.below(8) {
        0 | 1 => rotor.step(0.02),
        2 | 3 if !free.is_empty() => {
            // A few, by so little that cells stay as they are mostly.
            let first = rng.below(free.len());
            for &v in free.iter().skip(first).take(1 + rng.below(3)) {
                let p = rotor.t.position(v).expect("present").map(|x| x + 0.004 * (rng.unit() - 0.5));
                rotor.t.move_vertices(&[v], &[p]).expect("present");
            }
            if rotor.t.commit_timestamp().is_err() {
                rotor.t.discard_moves();
            }
        }
        4 if !sizes.is_empty() => {
            let k = rng.below(sizes.len());
            sizes[k] = *rng.pick(&[0.15, 0.3, f64::INFINITY]);
        }
        5 if !free.is_empty() => {
            // A segment where there is an edge: no cell is another one.
            let v = *rng.pick(&free);
            let cells = rotor.t.cells().expect("room");
            let row = cells.corners.iter().find(|row| row.contains(&v)).expect("it is a corner");
            let other = row.iter().copied().find(|&w| w != v).expect("there are three");
            let segment = Segment { ends: [v, other], marker: 7, ..Segment::default() };
            rotor.t.stage_segments([segment].into_iter()).expect("present");
            if rotor.t.commit_timestamp().is_err() {
                rotor.t.discard_moves();
            }
        }
        6 => {
            let own: Vec<_> =
                rotor.t.segments().filter(|(_, segment)| segment.marker == 7).map(|(id, _)| id).collect();
            rotor.t.stage_segment_removals(&own).expect("in force");
            rotor.t.commit_timestamp().expect("no conflict");
        }
        _ => {}
    }
}

/// Rounds of all kinds, after changes of all kinds and none, beside those of a copy that was loaded for each.
#[test]
fn copies_that_remember_nothing_go_on_alike() {
    let (mut n_removed, mut n_inserted, mut n_at_rest) = (0, 0, 0);
    for seed in seeds(24) {
        let rng = &mut Rng::new(seed);
        let asked = *rng.pick(&[Asked::Angles, Asked::Area, Asked::Areas, Asked::Sizes]);
        let mut rotor = Rotor::new();
        let mut sizes = Vec::new();
        let first = Round { asked, coarsens: false, refines: true, reuses_ids: false, is_fine: false };
        first.run(&mut rotor.t, &mut sizes);
        for k in 0..60 {
            change(&mut rotor, rng, &mut sizes);
            let round = Round::random(rng, asked);
            let context = || format!("seed {seed}, round {k}: {round:?}");
            let bytes = rotor.t.saved().expect("room");
            let mut loaded =
                Triangulation::load(&Saved::of(&bytes).expect("saved"), Options::default()).expect("saved");
            let mut sizes_of_copy = sizes.clone();
            let wanted = round.run(&mut loaded, &mut sizes_of_copy);
            let reports = round.run(&mut rotor.t, &mut sizes);
            assert_eq!(reports, wanted, "{}", context());
            if round.refines {
                assert_same(&loaded, &rotor.t, &context);
            }
            for report in reports.into_iter().flatten() {
                n_removed += report.removed;
                n_inserted += report.inserted;
                n_at_rest += usize::from(report.removed + report.inserted == 0);
            }
        }
    }
    println!("{n_removed} {n_inserted} {n_at_rest}");
    assert!(n_removed > 300 && n_inserted > 600 && n_at_rest > 300, "{n_removed} {n_inserted} {n_at_rest}");
}

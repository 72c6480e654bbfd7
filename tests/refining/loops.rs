//! Loops of moves, commits, coarsening and refinement, beside meshes made anew.

use super::ids::assert_same;
use super::lives::{LIMIT, coarsen, count_bad, domain_of, domains, quality, refine, turned};
use super::{Domain, Triangulation, check_fresh, circle};
use deldrift::motion::{CoarsenOptions, Level, Monitor, Options, Quality, RefineOptions, Saved};
use deldrift::{Error, VertexId};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// A ring whose inner polygon turns.
pub(super) struct Rotor {
    pub(super) t: Triangulation,
    turn: f64,
}

const OUTER: f64 = 0.95;
const INNER: f64 = 0.4;

impl Rotor {
    fn domain(turn: f64) -> Domain {
        Domain::default()
            .with_ring(&turned(&circle([0.0; 2], 1.0, 12), 0.05))
            .with_ring(&turned(&circle([0.0; 2], INNER, 8), 0.3 + turn))
    }

    pub(super) fn new() -> Self {
        Rotor { t: Self::domain(0.0).build(), turn: 0.0 }
    }

    /// All vertices turn, the less the nearer they are to the outer polygon.
    pub(super) fn step(&mut self, angle: f64) {
        self.turn += angle;
        for v in (0..self.t.id_count()).map(VertexId::at) {
            let Ok(p) = self.t.position(v) else { continue };
            let r = p[0].hypot(p[1]);
            let share = ((OUTER - r) / (OUTER - INNER)).clamp(0.0, 1.0);
            let (sine, cosine) = (angle * share).sin_cos();
            self.t
                .move_vertices(&[v], &[[p[0] * cosine - p[1] * sine, p[0] * sine + p[1] * cosine]])
                .expect("present");
        }
        self.t.commit_timestamp().expect("no conflict");
    }
}

/// How many times the vertices of a mesh made anew there are after each step: the mean, and the most.
fn growth_of(asked: &Quality, n_steps: usize) -> [f64; 2] {
    let mut rotor = Rotor::new();
    refine(&mut rotor.t, asked, LIMIT);
    let (mut sum, mut most) = (0.0, 0.0f64);
    for _ in 0..n_steps {
        rotor.step(0.02);
        coarsen(&mut rotor.t, asked);
        refine(&mut rotor.t, asked, LIMIT);
        assert_eq!(count_bad(&rotor.t, asked), 0, "{asked:?}");
        let mut anew = Rotor::domain(rotor.turn).build();
        refine(&mut anew, asked, LIMIT);
        let ratio = rotor.t.vertex_count() as f64 / anew.vertex_count() as f64;
        sum += ratio;
        most = most.max(ratio);
    }
    assert_eq!(rotor.t.validate(Level::Delaunay), Ok(()));
    [sum / n_steps as f64, most]
}

#[test]
fn meshes_that_move_have_as_few_vertices_as_new_ones() {
    for (angle, area, most_of_all) in
        [(20.0, 0.004, 1.25), (25.0, 0.004, 1.25), (30.0, 0.004, 1.25), (33.0, 0.004, 1.35)]
    {
        for area in [0.0, area] {
            let [mean, most] = growth_of(&quality(angle, area), 250);
            println!("{angle} degrees, {area}: mean {mean:.3}, most {most:.3}");
            assert!(mean <= 1.1 && most <= most_of_all, "{angle}, {area}: {mean} {most}");
        }
    }
}

/// A mesh for 25 times the area is as if it had been made for that, whatever it was made for before.
#[test]
fn meshes_for_larger_cells_have_as_few_vertices_as_new_ones() {
    for (name, size, domain) in domains() {
        for (angle, area) in [(20.0, 0.001), (25.0, 0.001), (30.0, 0.002), (33.0, 0.002), (0.0, 0.001)] {
            let [fine, coarse] = [1.0, 25.0].map(|factor| quality(angle, factor * area * size * size));
            let mut t = domain.build();
            refine(&mut t, &fine, LIMIT);
            coarsen(&mut t, &coarse);
            let report = refine(&mut t, &coarse, LIMIT);
            let mut anew = domain.build();
            let fresh = refine(&mut anew, &coarse, LIMIT);
            let [n, n_anew] = [&t, &anew].map(|t| t.vertex_count() as f64);
            assert!(n <= 1.25 * n_anew, "{name}, {angle}: {n} {n_anew}");
            assert!(report.bad_cells <= fresh.bad_cells, "{name}, {angle}: {report:?} {fresh:?}");
            coarsen(&mut t, &coarse);
            refine(&mut t, &coarse, LIMIT);
            let saved = t.saved().expect("room");
            assert_eq!((coarsen(&mut t, &coarse).removed, refine(&mut t, &coarse, LIMIT).inserted), (0, 0));
            assert!(t.saved().expect("room") == saved, "{name}, {angle}");
        }
    }
}

/// Loaded copies, whose cells are in another order, and clones go on as the original does, to the last bit, made anew or not.
#[test]
fn copies_are_refined_alike() {
    for (angle, area) in [(33.0, 0.02), (25.0, 0.004)] {
        let asked = quality(angle, area);
        let mut rotor = Rotor::new();
        refine(&mut rotor.t, &asked, LIMIT);
        let (mut n_anew, mut n_removed, mut n_inserted) = (0, 0, 0);
        for step in 0..150 {
            rotor.step(0.02);
            let bytes = rotor.t.saved().expect("room");
            let loaded =
                Triangulation::load(&Saved::of(&bytes).expect("saved"), Options::default()).expect("saved");
            let cloned = rotor.t.try_clone(None).expect("room");
            let options = RefineOptions { has_weights: true, limit: LIMIT, ..RefineOptions::default() };
            let goes_on = |t: &mut Triangulation| {
                let (coarsened, mask) = (coarsen(t, &asked), domain_of(t));
                [coarsened, t.refine(&asked, &options, &mask).expect("a domain")]
            };
            let wanted = goes_on(&mut rotor.t);
            for mut copy in [loaded, cloned] {
                assert_eq!(goes_on(&mut copy), wanted, "{angle} degrees, step {step}");
                assert_same(&copy, &rotor.t, &|| format!("{angle} degrees, step {step}"));
            }
            let [coarsened, refined] = wanted;
            n_anew += usize::from(refined.removed > 0);
            n_removed += coarsened.removed;
            n_inserted += refined.inserted;
        }
        assert!(n_anew > 0 && n_removed > 20 && n_inserted > 100, "{n_anew} {n_removed} {n_inserted}");
    }
}

/// Pieces come and go at every step, and what is held stays as large: nothing is kept of those that have gone.
#[test]
fn memory_of_a_loop_does_not_grow() {
    let asked = quality(25.0, 0.02);
    let mut rotor = Rotor::new();
    let options = RefineOptions { limit: LIMIT, reuses_ids: true, ..RefineOptions::default() };
    let (mut most, mut n_pieces) = ([0; 2], 0);
    for step in 0..2_500 {
        rotor.step(0.05);
        coarsen(&mut rotor.t, &asked);
        let mask = domain_of(&rotor.t);
        n_pieces += rotor.t.refine(&asked, &options, &mask).expect("a domain").new_segments;
        let half = usize::from(step >= 500);
        most[half] = most[half].max(rotor.t.memory_bytes());
    }
    println!("{most:?} bytes, {n_pieces} pieces");
    assert!(n_pieces > 5_000 && most[1] as f64 <= 1.1 * most[0] as f64, "{most:?} bytes, {n_pieces} pieces");
    check_fresh(&rotor.t, &|| "in the end".to_owned());
}

/// A refinement that is broken off, while it finds the mesh made anew or in its commit, leaves what is saved as it was.
#[test]
fn nothing_is_known_of_a_mesh_made_anew_in_vain() {
    let (mut n_broken, mut n_anew) = (0, 0);
    for (angle, area) in [(33.0, 0.0), (33.0, 0.02), (25.0, 0.02)] {
        let asked = quality(angle, area);
        let mut rotor = Rotor::new();
        refine(&mut rotor.t, &asked, LIMIT);
        for _ in 0..60 {
            rotor.step(0.05);
            coarsen(&mut rotor.t, &asked);
            let before = rotor.t.saved().expect("room");
            let mask = domain_of(&rotor.t);
            for most in 0.. {
                let n_told = Arc::new(AtomicUsize::new(0));
                let told = n_told.clone();
                let monitor: Monitor = Box::new(move |_| told.fetch_add(1, Relaxed) < most);
                let mut t = rotor.t.try_clone(Some(monitor)).expect("room");
                n_told.store(0, Relaxed);
                match t.refine(&asked, &RefineOptions::default(), &mask) {
                    Err(error) => {
                        n_broken += 1;
                        assert_eq!(error, Error::Cancelled);
                        assert!(t.saved().expect("room") == before, "{angle} {area}, after {most}");
                    }
                    Ok(report) => {
                        n_anew += usize::from(report.removed > 0);
                        break;
                    }
                }
            }
            refine(&mut rotor.t, &asked, LIMIT);
        }
    }
    assert!(n_broken > 100 && n_anew > 5, "{n_broken} {n_anew}");
}

/// Values of a linear function are carried over to a mesh made anew; without growth there is none.
#[test]
fn values_are_carried_to_a_mesh_made_anew() {
    let asked = quality(33.0, 0.004);
    let linear = |p: [f64; 2]| 3.0 + 2.0 * p[0] - 0.5 * p[1];
    let options = RefineOptions { has_weights: true, ..RefineOptions::default() };
    let (mut n_anew, mut n_inserted) = (0, 0);
    for growth in [1.1, f64::INFINITY] {
        let coarsening = CoarsenOptions { growth, ..CoarsenOptions::default() };
        let mut rotor = Rotor::new();
        refine(&mut rotor.t, &asked, LIMIT);
        for _ in 0..60 {
            rotor.step(0.02);
            let mask = domain_of(&rotor.t);
            rotor.t.coarsen(&asked, &coarsening, &mask).expect("a domain");
            let t = &rotor.t;
            let values: Vec<_> =
                VertexId::range(0..t.id_count()).map(|v| t.position(v).map_or(f64::NAN, linear)).collect();
            let mask = domain_of(t);
            let report = rotor.t.refine(&asked, &options, &mask).expect("a domain");
            n_anew += usize::from(report.removed > 0);
            assert!(growth < f64::INFINITY || report.removed == 0);
            n_inserted += report.inserted;
            let weights = rotor.t.refined_weights();
            assert_eq!(weights.len(), report.inserted);
            for (v, row) in VertexId::range(values.len()..rotor.t.id_count()).zip(weights) {
                let value: f64 =
                    row.vertices.iter().zip(row.weights).map(|(&v, weight)| values[v.index()] * weight).sum();
                let wanted = linear(rotor.t.position(v).expect("it has been inserted"));
                assert!((value - wanted).abs() < 1e-12, "{v:?}: {value} {wanted}");
            }
        }
    }
    assert!(n_anew > 2 && n_inserted > 1000, "{n_anew} {n_inserted}");
}

/// A motion of any domain: it is squeezed along one axis, and back, by a map that keeps segments straight.
fn factor(step: usize) -> f64 {
    const FORTH: usize = 25;
    let sign = if (step / FORTH).is_multiple_of(2) { 1.0 } else { -1.0 };
    (0.02f64 * sign).exp()
}

fn squeezed([x, y]: [f64; 2], factor: f64) -> [f64; 2] {
    [x * factor, y / factor]
}

/// Angles and areas, by the square of the domain's size.
const ASKED: [(f64, f64); 8] = [
    (20.0, 0.0),
    (25.0, 0.0),
    (30.0, 0.0),
    (33.0, 0.0),
    (20.0, 0.004),
    (25.0, 0.004),
    (30.0, 0.004),
    (33.0, 0.004),
];

/// After each step of a loop how many times the vertices of a mesh made anew there are, in the mean and at most, and how many
/// more bad cells at most.
fn squeeze(domain: &Domain, asked: &Quality, n_steps: usize) -> (f64, f64, usize) {
    let (mut t, mut domain) = (domain.build(), domain.clone());
    refine(&mut t, asked, LIMIT);
    let (mut sum, mut most, mut n_bad) = (0.0, 0.0f64, 0);
    for step in 0..n_steps {
        let factor = factor(step);
        domain.points.iter_mut().for_each(|p| *p = squeezed(*p, factor));
        let present: Vec<_> = VertexId::range(0..t.id_count()).filter(|&v| t.is_present(v)).collect();
        let goals: Vec<_> =
            present.iter().map(|&v| squeezed(t.position(v).expect("present"), factor)).collect();
        t.move_vertices(&present, &goals).expect("good places");
        // Vertices that are on sides but for rounding may be on the other side after it.
        let (Ok(_), Some(mut anew)) = (t.commit_timestamp(), domain.try_build()) else {
            return (sum / step.max(1) as f64, most, n_bad);
        };
        coarsen(&mut t, asked);
        let report = refine(&mut t, asked, LIMIT);
        let fresh = refine(&mut anew, asked, LIMIT);
        assert!(!report.is_cut_short && !fresh.is_cut_short);
        let ratio = t.vertex_count() as f64 / anew.vertex_count() as f64;
        (sum, most) = (sum + ratio, most.max(ratio));
        n_bad = n_bad.max(report.bad_cells.saturating_sub(fresh.bad_cells));
    }
    (sum / n_steps as f64, most, n_bad)
}

/// The table of docs/SEGMENTS.md: `cargo test --release --test library -- growth_of_all --ignored --nocapture`.
#[test]
#[ignore = "takes minutes"]
fn growth_of_all_domains() {
    let names = ASKED.map(|(angle, area)| format!("{angle}°{}", if area > 0.0 { ", area" } else { "" }));
    println!("| domain | {} |\n|---|{}", names.join(" | "), "---|".repeat(ASKED.len()));
    for (name, size, domain) in domains() {
        let cells = ASKED.map(|(angle, area)| {
            let (mean, most, n_bad) = squeeze(&domain, &quality(angle, area * size * size), 200);
            let bad = if n_bad > 0 { format!(", {n_bad} bad") } else { String::new() };
            if most == 0.0 { "·".to_string() } else { format!("{mean:.2}, {most:.2}{bad}") }
        });
        println!("| {name} | {} |", cells.join(" | "));
    }
}

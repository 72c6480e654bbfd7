use num_bigint::BigInt;

use super::*;
use crate::delaunay::{Insertion, Level, PowerPlane, PowerSpace, Relocation, Shortcut};
use crate::ids::VertexId;
use crate::machine::threads::Threads;
use crate::predicates::PointArray;
use crate::random::Rng;

/// Cells by vertex id, each ascending, in ascending order, and the hidden vertices.
type Shown = (Vec<Vec<u32>>, Vec<u32>);

/// Vertices, and the integers that their points are made of, coordinates and then the weight.
type Listed = Vec<(u32, Vec<i64>)>;

fn determinant(rows: &[Vec<BigInt>]) -> BigInt {
    let Some((first, rest)) = rows.split_first() else { return BigInt::from(1) };
    let mut sum = BigInt::from(0);
    for (k, x) in first.iter().enumerate().filter(|(_, x)| **x != BigInt::from(0)) {
        let without = |row: &Vec<BigInt>| {
            row.iter().enumerate().filter(|(j, _)| *j != k).map(|(_, y)| y.clone()).collect()
        };
        let minor: Vec<Vec<BigInt>> = rest.iter().map(without).collect();
        let term = x * determinant(&minor);
        if k % 2 == 0 { sum += term } else { sum -= term }
    }
    sum
}

/// The lower hull by its definition: the simplices of which no other point is below, where the vertex of id i is raised by a
/// number that is small beside that of the vertex of the next higher one, and all of these beside differences of lifts.
fn lower_hull(points: &Listed, d: usize) -> Shown {
    let most = points.iter().map(|(id, _)| *id).max().unwrap_or(0);
    let raised = |id: u32| -> BigInt { BigInt::from(1) << (64 * id) };
    let large = raised(most + 2);
    let row = |(id, p): &(u32, Vec<i64>)| -> Vec<BigInt> {
        let mut row: Vec<BigInt> = p[..d].iter().map(|&x| BigInt::from(x)).collect();
        let lift: i64 = p[..d].iter().map(|x| x * x).sum::<i64>() - p[d];
        row.push(BigInt::from(lift) * &large + raised(*id));
        row
    };
    let rows: Vec<Vec<BigInt>> = points.iter().map(row).collect();
    let minus = |p: &[BigInt], q: &[BigInt]| -> Vec<BigInt> { p.iter().zip(q).map(|(x, y)| x - y).collect() };
    let (mut cells, mut is_shown) = (Vec::new(), vec![false; points.len()]);
    let mut chosen: Vec<usize> = (0..=d).collect();
    let zero = BigInt::from(0);
    while chosen.len() == d + 1 && chosen[d] < points.len() {
        let from_first: Vec<Vec<BigInt>> =
            chosen[1..].iter().map(|&k| minus(&rows[k], &rows[chosen[0]])).collect();
        let flat: Vec<Vec<BigInt>> = from_first.iter().map(|row| row[..d].to_vec()).collect();
        let orientation = determinant(&flat);
        if orientation != zero {
            let is_below = |k: usize| {
                let mut all = from_first.clone();
                all.push(minus(&rows[k], &rows[chosen[0]]));
                let side = determinant(&all);
                assert!(side != zero, "no tie is left");
                (side < zero) == (orientation > zero)
            };
            if !(0..points.len()).any(|k| !chosen.contains(&k) && is_below(k)) {
                let mut cell: Vec<u32> = chosen.iter().map(|&k| points[k].0).collect();
                cell.sort_unstable();
                cells.push(cell);
                chosen.iter().for_each(|&k| is_shown[k] = true);
            }
        }
        // The next subset.
        let Some(at) = (0..=d).rev().find(|&i| chosen[i] + d + 1 - i < points.len()) else { break };
        chosen[at] += 1;
        for i in at + 1..=d {
            chosen[i] = chosen[i - 1] + 1;
        }
    }
    cells.sort();
    let hidden = points.iter().zip(&is_shown).filter(|(_, shown)| !**shown).map(|((id, _), _)| *id);
    let mut hidden: Vec<u32> = hidden.collect();
    hidden.sort_unstable();
    if cells.is_empty() {
        hidden.clear();
    }
    (cells, hidden)
}

fn shown<G: Geometry>(t: &Delaunay<G>) -> Shown {
    t.validate(Level::Delaunay).expect("a regular triangulation");
    let mut cells: Vec<Vec<u32>> = t
        .complex()
        .finite()
        .map(|c| {
            let mut cell: Vec<u32> =
                t.complex().cell(c).corners.as_ref().iter().map(|&s| t.site(s).id.get()).collect();
            cell.sort_unstable();
            cell
        })
        .collect();
    cells.sort();
    let mut hidden: Vec<u32> =
        t.live_sites().filter(|&s| t.is_hidden(s)).map(|s| t.site(s).id.get()).collect();
    hidden.sort_unstable();
    assert_eq!(hidden.len(), t.n_hidden());
    (cells, hidden)
}

fn point_of<G: Geometry>(numbers: &[i64]) -> G::Point {
    let numbers: Vec<f64> = numbers.iter().map(|&x| x as f64).collect();
    G::Point::of_flattened(&numbers).0[0]
}

/// A fresh build of these.
fn built<G: Geometry>(points: &Listed) -> Delaunay<G> {
    let mut t = Delaunay::<G>::on(Threads::ONE).expect("room");
    for (id, numbers) in points {
        t.add_site(point_of::<G>(numbers), VertexId::new(*id)).expect("room");
    }
    t.rebuild(&mut |_| true).expect("room");
    t
}

/// What a history draws its points from.
#[derive(Clone, Copy)]
struct Kind {
    /// Coordinates are from 0 to this.
    extent: i64,
    /// Weights are from 0 to this.
    weight: i64,
    /// Whether one axis has few values.
    is_flat: bool,
}

impl Kind {
    fn draw(self, rng: &mut Rng, d: usize) -> Vec<i64> {
        let mut p: Vec<i64> = (0..d).map(|_| rng.within(0, self.extent)).collect();
        if self.is_flat {
            p[d - 1] = rng.within(0, 1);
        }
        p.push(rng.within(0, self.weight));
        p
    }
}

const KINDS: [Kind; 6] = [
    Kind { extent: 9, weight: 0, is_flat: false },
    Kind { extent: 9, weight: 9, is_flat: false },
    Kind { extent: 3, weight: 3, is_flat: false },
    Kind { extent: 100, weight: 3_000, is_flat: false },
    Kind { extent: 6, weight: 40, is_flat: true },
    Kind { extent: 1, weight: 2, is_flat: false },
];

/// Builds, insertions, removals and relocations, alone and several before the hidden sites are settled: after each the cells and the
/// hidden sites are those of the definition, and of a fresh build.
fn histories<G: Geometry>(n_histories: usize) {
    let mut n_hidden = 0;
    for seed in 0..n_histories as u64 {
        let rng = &mut Rng::new(seed + 1);
        let kind = KINDS[rng.below(KINDS.len())];
        let n = G::D + 1 + rng.below(7);
        let mut points: Listed = (0..n as u32).map(|id| (id, kind.draw(rng, G::D))).collect();
        let mut t = built::<G>(&points);
        let mut next_id = n as u32;
        assert_eq!(shown(&t), lower_hull(&points, G::D), "seed {seed}, built");
        'history: for step in 0..8 {
            t.begin().expect("room");
            for _ in 0..1 + rng.below(3) {
                if !t.has_cells() {
                    break;
                }
                let sites: std::collections::HashMap<u32, SiteId> =
                    t.live_sites().map(|s| (t.site(s).id.get(), s)).collect();
                let at = rng.below(points.len());
                match rng.below(4) {
                    0 if points.len() < 11 => {
                        let numbers = kind.draw(rng, G::D);
                        let s = t.add_site(point_of::<G>(&numbers), VertexId::new(next_id)).expect("room");
                        let inserted = t.insert_site_anywhere(s).expect("room");
                        assert!(matches!(inserted, Insertion::New | Insertion::Hidden(_)));
                        points.push((next_id, numbers));
                        next_id += 1;
                    }
                    1 if points.len() > G::D + 2 => {
                        t.remove_site(sites[&points[at].0]).expect("room");
                        points.remove(at);
                    }
                    kind_of_move => {
                        let mut numbers = kind.draw(rng, G::D);
                        if kind_of_move == 2 {
                            // The weight alone.
                            numbers[..G::D].copy_from_slice(&points[at].1[..G::D]);
                        }
                        let (id, s) = (points[at].0, sites[&points[at].0]);
                        let q = point_of::<G>(&numbers);
                        let shortcut = [Shortcut::Certificates, Shortcut::Flips][rng.below(2)];
                        let done = t.relocate_site(s, &q, VertexId::new(id), shortcut).expect("room");
                        points[at].1 = numbers;
                        if done == Relocation::Spans {
                            t.end();
                            t = built::<G>(&points);
                            continue 'history;
                        }
                    }
                }
            }
            t.settle(|_| Ok(())).expect("room");
            t.end();
            if !t.has_cells() {
                break;
            }
            assert_eq!(shown(&t), lower_hull(&points, G::D), "seed {seed}, step {step}");
            assert_eq!(shown(&t), shown(&built::<G>(&points)));
            n_hidden += t.n_hidden();
        }
    }
    assert!(n_hidden > n_histories, "{n_hidden} hidden");
}

#[test]
fn cells_are_the_lower_hull_in_the_plane() {
    histories::<PowerPlane>(1_500);
}

#[test]
fn cells_are_the_lower_hull_in_space() {
    histories::<PowerSpace>(700);
}

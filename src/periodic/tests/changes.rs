//! Lists of changes, beside what a program keeps by them.

use super::*;

/// The cells by index, as a program knows them: rows of vertices, and these in order with their shifts from the first.
fn known<G: Moving>(t: &PeriodicTriangulation<G>) -> Vec<(Vec<VertexId>, Class)> {
    let shifts: Vec<_> = t.cell_shifts().unwrap().collect();
    let rows = t.cells().unwrap().corners.iter().zip(shifts.chunks_exact(G::D + 1));
    let known = rows.map(|(row, shifts)| {
        let mut class: Class = row.as_ref().iter().map(|v| v.get()).zip(shifts.iter().copied()).collect();
        class.sort_unstable();
        let first = class[0].1;
        class.iter_mut().for_each(|(_, shift)| *shift = [0, 1, 2].map(|j| shift[j] - first[j]));
        (row.as_ref().to_vec(), class)
    });
    known.collect()
}

/// What is kept for each cell by the lists of changes is what there is, and what need not change stays.
fn keeps_what_it_knows<G: Moving>(seed: u64, n: usize, rank: usize) {
    let rng = &mut Rng::new(seed);
    let mut basis = vec![G::Point::default(); rank];
    (0..rank).for_each(|j| basis[j][j] = 1.0);
    let mut points = random_points::<G>(rng, n, &basis);
    let mut t = PeriodicTriangulation::<G>::new(&points, &basis, Options::default()).unwrap();
    let (mut kept, mut hidden): (Vec<Option<Class>>, BTreeSet<VertexId>) = Default::default();
    for step in 0..24 {
        let before = kept.clone();
        let changes = t.take_changes().unwrap();
        let moved: Vec<_> =
            changes.renumbered_from.iter().map(|&cell| before[cell.index()].clone()).collect();
        for (&cell, row) in changes.removed.iter().zip(changes.removed_corners) {
            let class = kept[cell.index()].take().expect("it was there");
            let mut vertices: Vec<_> = row.as_ref().iter().map(|v| v.get()).collect();
            vertices.sort_unstable();
            assert!(class.iter().map(|&(v, _)| v).eq(vertices), "seed {seed}, step {step}");
        }
        changes.renumbered_from.iter().for_each(|cell| kept[cell.index()] = None);
        let created = changes.created.to_vec();
        hidden.extend(changes.hidden);
        changes.shown.iter().for_each(|v| assert!(hidden.remove(v)));
        let to = changes.renumbered_to.to_vec();
        let from = changes.renumbered_from.to_vec();
        let stars: BTreeSet<_> = changes.stars.iter().copied().collect();
        let now = known(&t);
        assert!(from.iter().all(|cell| cell.index() >= now.len()), "only the last ones get others");
        kept.resize(now.len().max(kept.len()), None);
        to.iter().zip(moved).for_each(|(cell, class)| kept[cell.index()] = class);
        for cell in created {
            assert!(kept[cell.index()].is_none());
            let (row, class) = &now[cell.index()];
            assert!(!before.contains(&Some(class.clone())), "it was there: seed {seed}, step {step}");
            assert!(row.iter().all(|v| stars.contains(v)));
            kept[cell.index()] = Some(class.clone());
        }
        assert!(kept[now.len()..].iter().all(Option::is_none));
        kept.truncate(now.len());
        assert!(
            kept.iter().zip(&now).all(|(kept, (_, class))| kept.as_ref() == Some(class)),
            "seed {seed}, step {step}"
        );
        let expected: BTreeSet<_> = VertexId::range(0..points.len())
            .filter(|&v| t.is_present(v) && t.coincident_representative(v).unwrap() != v)
            .collect();
        hidden.retain(|&v| t.is_present(v));
        assert!(hidden == expected);
        classes(&t, &points, &basis);
        for _ in 0..rng.below(3) {
            if rng.one_in(2) {
                t.cell_count().unwrap();
            }
            let size = [0, 1 << 8, 1 << 14][rng.below(3)];
            for p in &mut points {
                (0..G::D).for_each(|k| {
                    p[k] += (rng.below(2 * size + 1) as f64 - size as f64) / (1u64 << 20) as f64
                });
                if rng.one_in(9) {
                    p[0] += 1.0;
                }
            }
            if rng.one_in(4) {
                let (i, j) = (rng.below(points.len()), rng.below(points.len()));
                points[i] = points[j];
            }
            t.commit_positions(&points).unwrap();
            if rng.one_in(3) {
                points.extend(random_points::<G>(rng, 2, &basis));
                t.stage_insertions(&points[points.len() - 2..]).unwrap();
                let some = VertexId::at(rng.below(points.len() - 2));
                if t.is_present(some) && t.vertex_count() > 2 {
                    t.stage_removals(&[some]).unwrap();
                }
                t.commit_timestamp().unwrap();
            }
            if rng.one_in(6) {
                basis[0][rank - 1] += 0.0625;
                t.stage_vectors(&basis).unwrap();
                t.commit_timestamp().unwrap();
            }
        }
    }
}

#[test]
fn changes_are_what_has_changed() {
    for seed in 0..12 {
        let n = [1, 3, 30][seed as usize % 3];
        keeps_what_it_knows::<Plane>(seed, n, 2);
        keeps_what_it_knows::<Plane>(seed, n, 1);
        keeps_what_it_knows::<Space>(seed, n, 3);
    }
}

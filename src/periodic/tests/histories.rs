//! Random histories, beside what is made anew.

use super::*;

/// A random history: moves of all and of some, steps and drifts, positions wrapped by the program, vertices that come and go, and
/// other lattices. After each commit the cells are those of a triangulation that is made anew, and of copies.
fn history<G: Moving>(seed: u64, basis: &[G::Point], n: usize) {
    let rng = &mut Rng::new(seed);
    let mut basis = basis.to_vec();
    let mut points = random_points::<G>(rng, n, &basis);
    let mut is_there = vec![true; n];
    let mut t = PeriodicTriangulation::<G>::new(&points, &basis, Options::default()).unwrap();
    let grid = (1u64 << 20) as f64;
    for step in 0..12 {
        let mut present: Vec<VertexId> =
            VertexId::range(0..points.len()).filter(|&v| is_there[v.index()]).collect();
        let drifts = rng.one_in(3);
        let drift = [0, 1].map(|_| if drifts { rng.below(1 << 18) as f64 / grid } else { 0.0 });
        let size = [1 << 10, 1 << 13, 1 << 16, 1 << 19][rng.below(4)];
        let mut goals = points.clone();
        let (changes_weights, spread) = (G::HAS_WEIGHTS && rng.one_in(2), spread_of_weights::<G>(rng, n));
        for p in &mut goals {
            if changes_weights {
                *p = with_random_weight::<G>(rng, *p, spread);
            }
            for axis in 0..G::D {
                p[axis] += drift[axis.min(1)] + (rng.below(2 * size) as f64 - size as f64) / grid;
            }
            if rng.below(4) == 0 {
                for b in &basis {
                    let k = rng.below(7) as f64 - 3.0;
                    (0..G::D).for_each(|axis| p[axis] += k * b[axis]);
                }
            }
        }
        match rng.below(6) {
            0 => {
                rng.shuffle(&mut present);
                present.truncate(1 + rng.below(present.len()));
                let to: Vec<G::Point> = present.iter().map(|&v| goals[v]).collect();
                t.move_vertices(&present, &to).unwrap();
                present.iter().zip(&to).for_each(|(&v, p)| points[v] = *p);
                t.commit_timestamp().unwrap();
            }
            1 => {
                let more = random_points::<G>(rng, 3, &basis);
                assert_eq!(t.stage_insertions(&more).unwrap().index(), points.len());
                points.extend(&more);
                is_there.resize(points.len(), true);
                if present.len() > 2 {
                    let gone = present[rng.below(present.len())];
                    t.stage_removals(&[gone]).unwrap();
                    is_there[gone.index()] = false;
                }
                t.commit_timestamp().unwrap();
                assert_eq!(t.id_count(), points.len());
            }
            2 => {
                for b in &mut basis {
                    (0..G::D).for_each(|axis| {
                        b[axis] += (rng.below(1 << 18) as f64 - (1 << 17) as f64) / grid / 4.0
                    });
                }
                t.stage_vectors(&basis).unwrap();
                t.commit_positions(&goals).unwrap();
                points = goals;
            }
            _ => {
                t.commit_positions(&goals).unwrap();
                points = goals;
            }
        }
        for v in VertexId::range(0..points.len()) {
            assert_eq!(
                t.position(v).ok(),
                is_there[v.index()].then(|| points[v]),
                "seed {seed}, step {step}"
            );
        }
        let fresh = anew::<G>(&points, &is_there, &basis);
        let expected = classes(&fresh, &points, &basis);
        assert_eq!(classes(&t, &points, &basis), expected, "seed {seed}, step {step}");
        assert_eq!(t.timestamp(), step + 1);
    }
}

#[test]
fn histories_end_as_what_is_made_anew() {
    for seed in 0..36 {
        let n = [1, 2, 4, 9, 30, 300][seed as usize % 6];
        history::<Plane>(seed, &[[1.0, 0.0], [0.0, 1.0]], n);
        history::<Plane>(seed, &[[1.0, 0.25], [-0.125, 0.5]], n);
        history::<Plane>(seed, &[[0.75, 0.25]], n);
    }
    for seed in 0..8 {
        let n = [1, 2, 5, 60][seed as usize % 4];
        history::<Space>(seed, &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], n);
        history::<Space>(seed, &[[1.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.25, -0.375, 0.75]], n);
        history::<Space>(seed, &[[1.0, 0.0, 0.0], [0.5, 1.0, 0.0]], n);
    }
}

#[test]
fn histories_with_weights_end_as_what_is_made_anew() {
    for seed in 0..36 {
        let n = [1, 2, 4, 9, 30, 300][seed as usize % 6];
        history::<PowerPlane>(seed, &unweighted(&[[1.0, 0.0], [0.0, 1.0]]), n);
        history::<PowerPlane>(seed, &unweighted(&[[1.0, 0.25], [-0.125, 0.5]]), n);
        history::<PowerPlane>(seed, &unweighted(&[[0.75, 0.25]]), n);
    }
    for seed in 0..8 {
        let n = [1, 2, 5, 60][seed as usize % 4];
        history::<PowerSpace>(seed, &unweighted(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]), n);
        history::<PowerSpace>(
            seed,
            &unweighted(&[[1.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.25, -0.375, 0.75]]),
            n,
        );
        history::<PowerSpace>(seed, &unweighted(&[[1.0, 0.0, 0.0], [0.5, 1.0, 0.0]]), n);
    }
}

/// A box that is strained and sheared, through boxes whose shortest vectors are others, with what is in it: as what is made
/// anew, and built anew seldom.
fn strained<G: Moving>(seed: u64, n: usize, rank: usize) {
    let rng = &mut Rng::new(seed);
    let grid = (1u64 << 20) as f64;
    let mut basis = vec![G::Point::default(); rank];
    (0..rank).for_each(|j| basis[j][j] = 1.0);
    let mut points = random_points::<G>(rng, n, &basis);
    let options = Options { algorithm: Algorithm::PlacementFlips, ..Options::default() };
    let mut t = PeriodicTriangulation::<G>::new(&points, &basis, options).unwrap();
    let (shear, steps) = (rng.below(G::D), 60);
    let mut rebuilds = 0;
    for step in 0..steps {
        // Some 1.5 in all, and noise that has the vectors now in one order of lengths and now in another.
        let strain = |rng: &mut Rng| (rng.below(1 << 13) as f64 - (1 << 12) as f64) / grid;
        let before = basis.clone();
        for (j, b) in basis.iter_mut().enumerate() {
            b[j] += strain(rng);
            let to = (shear + 1) % G::D;
            if j == shear && rank > 1 && to < rank {
                b[to] += 0.025;
            }
        }
        // What is in the box goes with it, rounded, or stays.
        let goes = !rng.one_in(4);
        for p in &mut points {
            let share: Vec<f64> = (0..rank).map(|j| p[j]).collect();
            for (x, (b, old)) in share.iter().zip(basis.iter().zip(&before)).filter(|_| goes) {
                (0..G::D).for_each(|axis| p[axis] += ((b[axis] - old[axis]) * x * grid).round() / grid);
            }
        }
        t.stage_vectors(&basis).unwrap();
        let report = if goes { t.commit_positions(&points).unwrap() } else { t.commit_timestamp().unwrap() };
        rebuilds += report.rebuilds;
        let fresh = PeriodicTriangulation::<G>::new(&points, &basis, Options::default()).unwrap();
        let expected = classes(&fresh, &points, &basis);
        assert!(classes(&t, &points, &basis) == expected, "seed {seed}, step {step}");
    }
    assert!(rebuilds <= 6, "{rebuilds} builds in {steps} steps");
}

#[test]
fn a_box_that_is_strained_is_seldom_built_anew() {
    for seed in 0..4 {
        strained::<Plane>(seed, [60, 300][seed as usize % 2], 2);
        strained::<Space>(seed, [40, 90][seed as usize % 2], 3);
        strained::<Plane>(seed, 60, 1);
        strained::<Space>(seed, 40, 2);
    }
}

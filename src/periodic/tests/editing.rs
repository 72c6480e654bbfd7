//! Vertices that come and go without a build.

use super::keeping::load;
use super::*;
use crate::motion::Level;

/// How many vertices come in each of three steps.
const N_COMING: [usize; 3] = [1, 0, 2];

/// What a history of edits is made of: moves of all or of some, vertices that come and go, some of them where others are, and
/// other vectors. After each commit all is as in what is made anew, and most commits are no builds.
fn edited<G: Moving>(seed: u64, n: usize, basis: &[G::Point]) {
    let rng = &mut Rng::new(seed);
    let grid = (1u64 << 20) as f64;
    let mut basis = basis.to_vec();
    let mut points = random_points::<G>(rng, n, &basis);
    let mut is_there = vec![true; n];
    let mut t = PeriodicTriangulation::<G>::new(&points, &basis, Options::default()).unwrap();
    let (steps, mut builds) = (30, 0);
    for step in 0..steps {
        let present: Vec<VertexId> =
            VertexId::range(0..points.len()).filter(|&v| is_there[v.index()]).collect();
        let mut coming = random_points::<G>(rng, N_COMING[step % 3], &basis);
        if step % 5 == 4 {
            // At the place of another one, in another period.
            let mut place = points[present[step % present.len()]];
            (0..G::D).for_each(|axis| place[axis] += 2.0 * basis[0][axis]);
            coming.push(place);
        }
        let mut going = Vec::new();
        while going.len() < 1 + step % 3 {
            let v = present[rng.below(present.len())];
            if !going.contains(&v) {
                going.push(v);
            }
        }
        assert_eq!(t.stage_insertions(&coming).unwrap().index(), points.len());
        points.extend(&coming);
        is_there.resize(points.len(), true);
        t.stage_removals(&going).unwrap();
        going.iter().for_each(|v| is_there[v.index()] = false);
        if step % 7 == 3 {
            for b in &mut basis {
                (0..G::D).for_each(|axis| b[axis] += (rng.below(1 << 12) as f64 - (1 << 11) as f64) / grid);
            }
            t.stage_vectors(&basis).unwrap();
        }
        let mut goals = points.clone();
        for p in &mut goals {
            (0..G::D).for_each(|axis| p[axis] += (rng.below(1 << 12) as f64 - (1 << 11) as f64) / grid);
        }
        let report = match step % 3 {
            0 => t.commit_timestamp().unwrap(),
            1 => {
                let stays = present.iter().copied().filter(|v| is_there[v.index()]);
                let some: Vec<VertexId> = stays.filter(|_| rng.one_in(3)).collect();
                let to: Vec<G::Point> = some.iter().map(|&v| goals[v]).collect();
                t.move_vertices(&some, &to).unwrap();
                some.iter().zip(&to).for_each(|(&v, p)| points[v] = *p);
                t.commit_timestamp().unwrap()
            }
            _ => {
                points = goals;
                t.commit_positions(&points).unwrap()
            }
        };
        assert_eq!((report.inserted, report.removed), (coming.len() as u64, going.len() as u64));
        // Other vectors may be too different. Ids inside of vertices that have gone stay until all is built.
        builds += usize::from(step % 7 != 3 && t.inside.images.n_gone() == 0);
        for v in VertexId::range(0..points.len()) {
            let expected = is_there[v.index()].then(|| points[v]);
            assert_eq!(t.position(v).ok(), expected, "seed {seed}, step {step}");
        }
        let fresh = anew::<G>(&points, &is_there, &basis);
        let expected = classes(&fresh, &points, &basis);
        assert!(classes(&t, &points, &basis) == expected, "seed {seed}, step {step}");
        assert_eq!(t.hidden_vertices().unwrap(), fresh.hidden_vertices().unwrap());
        assert_eq!(t.violation(Level::Delaunay).unwrap(), None, "seed {seed}, step {step}");
        if step % 6 == 5 {
            let loaded = load::<G>(&t.saved().unwrap()).unwrap();
            assert!(classes(&loaded, &points, &basis) == expected);
            t = if step % 12 == 5 { loaded } else { t.try_clone(None).unwrap() };
        }
    }
    assert!(builds <= 1, "seed {seed}: {builds} builds");
}

#[test]
fn vertices_come_and_go_as_in_what_is_made_anew() {
    for seed in 0..6 {
        edited::<Plane>(seed, [130, 400][seed as usize % 2], &[[1.0, 0.0], [0.0, 1.0]]);
        edited::<Plane>(seed, 120, &[[1.0, 0.25], [-0.125, 0.5]]);
        edited::<Plane>(seed, 120, &[[0.75, 0.25]]);
    }
    for seed in 0..3 {
        edited::<Space>(seed, 150, &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        edited::<Space>(seed, 130, &[[1.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.25, -0.375, 0.75]]);
        edited::<Space>(seed, 120, &[[1.0, 0.0, 0.0], [0.5, 1.0, 0.0]]);
    }
}

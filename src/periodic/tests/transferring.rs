//! Cells that may meet those that are turned over, found near by and by a look at all.

use super::*;
use crate::motion::finds_as_by_a_look_at_all;

fn history<G: Moving>(seed: u64, counts: &mut [usize; 2]) {
    let rng = &mut Rng::new(seed);
    let (way, skew) = (*rng.pick(&[0.1, 0.2, 0.6]), *rng.pick(&[0.0, 0.3, 4.7]));
    let rank = 1 + rng.below(G::D);
    let is_lattice = rng.one_in(4);
    let basis: Vec<G::Point> = (0..rank)
        .map(|j| {
            let mut vector = G::Point::default();
            (0..G::D).for_each(|k| vector[k] = if j == k { 1.0 } else { skew * f64::from(u8::from(j > k)) });
            vector
        })
        .collect();
    let draw = |rng: &mut Rng, near: Option<G::Point>| {
        let mut place = near.unwrap_or_default();
        for axis in 0..G::D {
            place[axis] += if near.is_some() { way * (rng.unit() - 0.5) } else { rng.unit() };
            if is_lattice {
                place[axis] = (4.0 * place[axis]).round() / 4.0;
            }
        }
        place
    };
    let n = if rng.one_in(3) { 6 + rng.below(100) } else { 300 };
    let mut places: Vec<_> = (0..n).map(|_| draw(rng, None)).collect();
    let mut t = PeriodicTriangulation::<G>::new(&places, &basis, Options::default()).unwrap();
    t.take_changes().unwrap();
    for _ in 0..3 {
        let n_before = places.len();
        let every = [n, n / 3 + 1, 1, n, n / 3 + 1][rng.below(5)];
        for v in VertexId::range(0..places.len()) {
            if t.is_present(v) && rng.one_in(every) {
                places[v.index()] = draw(rng, Some(places[v.index()]));
                t.move_vertices(&[v], &[places[v.index()]]).unwrap();
            }
        }
        t.commit_timestamp().unwrap();
        if rng.one_in(3) {
            let v = VertexId::new(rng.below(places.len()) as u32);
            if t.is_present(v) {
                t.remove_vertex(v).unwrap();
            }
            places.push(draw(rng, None));
            t.insert_vertex(places.last().unwrap()).unwrap();
        }
        t.take_changes().unwrap();
        let now = t.now().unwrap();
        let (gone, _) = now.gone_and_arrived(Some(&places[..n_before])).unwrap();
        if let Some(is_near) = finds_as_by_a_look_at_all(&now, &gone) {
            counts[usize::from(is_near)] += 1;
        }
    }
}

#[test]
fn cells_near_by_are_those_of_a_look_at_all() {
    for history in [history::<Plane>, history::<Space>] {
        let mut counts = [0; 2];
        (0..100).for_each(|seed| history(seed, &mut counts));
        println!("by a look at all, near by: {counts:?}");
        assert!(counts[0] > 5 && counts[1] > 30, "{counts:?}");
    }
}

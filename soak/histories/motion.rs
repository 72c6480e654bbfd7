//! How the points of a history go on.

use super::family::{Family, LIMIT, Source, shifted};
use crate::common::inputs::{Kind, quantized};
use crate::common::{Rng, point};
use deldrift::{Dimension, VertexId};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Motion {
    /// Everything is staged, and nothing moves.
    Rest,
    /// Each on its own, at random.
    Jitter,
    /// Each on its own, on and on.
    Drift,
    /// All by the same vector.
    Rigid,
    /// About a centre.
    Turn,
    Shear,
    Mirror,
    /// To twice or half the size.
    Scale,
    /// By a step of the lattice, along one axis.
    Hop,
    /// By a few units in the last place.
    Ulps,
    /// Two by two, places are exchanged.
    Swap,
    /// Onto others.
    Meet,
    /// Onto a hyperplane, a line or a point.
    Collapse,
    /// Far away.
    Teleport,
    /// To new places of the same kind.
    Redraw,
}

/// Those that use up what algorithms keep come more often.
const MOTIONS: [Motion; 20] = [
    Motion::Rest,
    Motion::Jitter,
    Motion::Jitter,
    Motion::Jitter,
    Motion::Drift,
    Motion::Drift,
    Motion::Drift,
    Motion::Rigid,
    Motion::Turn,
    Motion::Shear,
    Motion::Mirror,
    Motion::Scale,
    Motion::Hop,
    Motion::Ulps,
    Motion::Swap,
    Motion::Meet,
    Motion::Collapse,
    Motion::Teleport,
    Motion::Redraw,
    Motion::Redraw,
];

/// A motion that lasts for several commits.
#[derive(Debug)]
pub struct Phase<G: Dimension> {
    motion: Motion,
    /// One vertex in so many; 0 for one alone.
    share: usize,
    size: f64,
    axis: usize,
    centre: G::Point,
    /// Seed of the velocities.
    velocity: u64,
    /// Where the vertices were before it, if they return there in the end.
    pub begin: Option<Vec<Option<G::Point>>>,
    pub commits_left: usize,
    /// Whether places stay on the grid of tests/common/inputs.rs.
    is_quantized: bool,
}

impl<G: Dimension> Phase<G> {
    /// The next phase of points that are about `spacing` apart.
    pub fn new(source: &Source<G>, spacing: f64, now: &[Option<G::Point>], rng: &mut Rng) -> Self {
        let motion = *rng.pick(&MOTIONS);
        let lasts = matches!(motion, Motion::Jitter | Motion::Drift | Motion::Rigid | Motion::Turn);
        let returns = rng.one_in(2) && matches!(motion, Motion::Collapse | Motion::Meet | Motion::Scale);
        let exact =
            matches!(source.family, Family::Of(Kind::Lattice | Kind::Duplicates) | Family::Cospherical);
        Phase {
            motion,
            share: *rng.pick(&[1, 1, 1, 1, 2, 10, 50, 0]),
            size: spacing * 0.5f64.powi(rng.below(if lasts { 26 } else { 8 }) as i32),
            axis: rng.below(G::D),
            centre: point::<G>(|_| 20.0 * rng.unit() - 10.0),
            velocity: rng.next(),
            begin: returns.then(|| now.to_vec()),
            commits_left: 1 + rng.below(if lasts { 12 } else { 3 }),
            is_quantized: exact && rng.one_in(2),
        }
    }

    pub fn name(&self) -> String {
        format!("{:?} by {:e} of one in {}", self.motion, self.size, self.share)
    }

    /// Those of the present vertices that it moves.
    pub fn choose(&self, mut present: Vec<VertexId>, rng: &mut Rng) -> Vec<VertexId> {
        match self.share {
            0 => present.truncate(1),
            share => present.retain(|_| rng.one_in(share)),
        }
        if matches!(self.motion, Motion::Swap) {
            rng.shuffle(&mut present);
        }
        present
    }

    /// Where the chosen ones go.
    pub fn targets(
        &self,
        chosen: &[VertexId],
        now: &[Option<G::Point>],
        source: &Source<G>,
        rng: &mut Rng,
    ) -> Vec<G::Point> {
        let at = |v: VertexId| now[v].expect("present");
        let common = Rng::new(self.velocity);
        let mut target = |(i, &v): (usize, &VertexId)| {
            let p = at(v);
            let q = match self.motion {
                Motion::Rest => p,
                Motion::Jitter => point::<G>(|k| p[k] + self.size * (2.0 * rng.unit() - 1.0)),
                Motion::Drift => {
                    let mut own = Rng::new(self.velocity ^ u64::from(v.get()));
                    point::<G>(|k| p[k] + self.size * (2.0 * own.unit() - 1.0))
                }
                Motion::Rigid => {
                    let mut common = common.clone();
                    point::<G>(|k| p[k] + self.size * (2.0 * common.unit() - 1.0))
                }
                Motion::Turn | Motion::Shear | Motion::Mirror | Motion::Scale => self.map(p),
                Motion::Hop => {
                    point::<G>(|k| if k == self.axis { p[k] + rng.within(-1, 1) as f64 } else { p[k] })
                }
                Motion::Ulps => point::<G>(|k| shifted(p[k], rng.within(-3, 3))),
                Motion::Swap => at(*chosen.get(i ^ 1).unwrap_or(&v)),
                Motion::Meet if i.is_multiple_of(4) => at(*rng.pick(chosen)),
                Motion::Meet => p,
                Motion::Collapse => self.collapsed(p),
                Motion::Teleport => point::<G>(|_| 3000.0 * (2.0 * rng.unit() - 1.0)),
                Motion::Redraw => source.draw_one(rng),
            };
            if self.is_quantized {
                return quantized::<G>(q);
            }
            point::<G>(|k| q[k].clamp(-LIMIT, LIMIT))
        };
        chosen.iter().enumerate().map(&mut target).collect()
    }

    /// The maps of space, by an amount drawn from the size and the velocity.
    fn map(&self, p: G::Point) -> G::Point {
        let (next, c) = ((self.axis + 1) % G::D, &self.centre);
        let mut q = p;
        match self.motion {
            Motion::Turn => {
                // Of a rational angle, so that sine and cosine are the same everywhere.
                let t = self.size / 32.0;
                let (sin, cos) = (2.0 * t / (1.0 + t * t), (1.0 - t * t) / (1.0 + t * t));
                let (x, y) = (p[self.axis] - c[self.axis], p[next] - c[next]);
                q[self.axis] = c[self.axis] + cos * x - sin * y;
                q[next] = c[next] + sin * x + cos * y;
            }
            Motion::Shear => q[self.axis] += self.size / 8.0 * (p[next] - c[next]),
            Motion::Mirror => q[self.axis] = -p[self.axis],
            _ => {
                let factor = if self.velocity.is_multiple_of(2) { 2.0 } else { 0.5 };
                q = point::<G>(|k| factor * p[k]);
            }
        }
        q
    }

    fn collapsed(&self, p: G::Point) -> G::Point {
        let onto = |k: usize| match self.velocity % 4 {
            0 => k == self.axis,
            1 => k != self.axis,
            2 => true,
            _ => k + 1 == G::D,
        };
        point::<G>(|k| if onto(k) { self.centre[k].floor() } else { p[k] })
    }
}

//! What a mesh of a history is to be like.

use crate::common::Rng;
use deldrift::motion::{CoarsenOptions, Kept, MovingTriangulation, Quality, QualityReport, RefineOptions};
use deldrift::{Error, Plane};

/// More vertices than meshes here have: gaps that are hardly not narrow get some ten thousand, and a domain has few.
pub const LIMIT: usize = 100_000;

/// A quality, and by which means.
#[derive(Clone, Debug)]
pub struct Asked {
    least_angle: f64,
    greatest_area: f64,
    /// By nesting level; none if empty.
    areas: Vec<f64>,
    pub has_sizes: bool,
    is_conforming: bool,
    /// Whether holes are refined, too.
    has_holes: bool,
    pub keeps: Kept,
    pub growth: f64,
    pub limit: usize,
    pub reuses_ids: bool,
}

impl Asked {
    /// For a domain of this size.
    pub fn new(size: f64, rng: &mut Rng) -> Self {
        let area = |rng: &mut Rng| *rng.pick(&[0.0, 0.2, 0.05, 0.05, 0.02]) * size * size;
        let is_conforming = rng.one_in(6);
        let angles: &[f64] = if is_conforming { &[0.0, 20.0] } else { &[0.0, 20.0, 25.0, 25.0, 30.0, 33.0] };
        Asked {
            least_angle: *rng.pick(angles),
            greatest_area: area(rng),
            areas: if rng.one_in(4) { (0..4).map(|_| area(rng)).collect() } else { Vec::new() },
            has_sizes: rng.one_in(4),
            is_conforming,
            has_holes: rng.one_in(4),
            keeps: *rng.pick(&[Kept::None, Kept::None, Kept::None, Kept::Outer, Kept::All]),
            growth: *rng.pick(&[1.1, 1.1, 1.1, 1.0, 1.5, f64::INFINITY]),
            limit: if rng.one_in(8) { rng.below(60) } else { LIMIT },
            reuses_ids: rng.one_in(2),
        }
    }

    /// Calls with the quality and the cells that it is asked of, in the order in which they are now.
    fn with<T>(
        &self,
        t: &mut MovingTriangulation<Plane>,
        sizes: &[f64],
        call: impl FnOnce(&mut MovingTriangulation<Plane>, &Quality, &[u8]) -> T,
    ) -> T {
        let levels = t.nesting_levels().expect("room");
        let mask: Vec<u8> = levels.iter().map(|level| self.selects(*level).into()).collect();
        let quality = Quality {
            least_angle: self.least_angle,
            greatest_area: self.greatest_area,
            labels: (!self.areas.is_empty()).then_some(&levels[..]),
            areas: &self.areas,
            sizes: self.has_sizes.then_some(sizes),
            is_too_large: None,
            is_conforming: self.is_conforming,
        };
        call(t, &quality, &mask)
    }

    fn selects(&self, level: u32) -> bool {
        level % 2 == 1 || self.has_holes && level > 0
    }

    pub fn coarsen(&self, t: &mut MovingTriangulation<Plane>, sizes: &[f64]) -> Result<QualityReport, Error> {
        let options = CoarsenOptions { growth: self.growth, keeps: self.keeps, ..CoarsenOptions::default() };
        self.with(t, sizes, |t, quality, mask| t.coarsen(quality, &options, mask))
    }

    pub fn refine(
        &self,
        t: &mut MovingTriangulation<Plane>,
        sizes: &[f64],
        limit: usize,
    ) -> Result<QualityReport, Error> {
        let options =
            RefineOptions { keeps: self.keeps, limit, has_weights: true, reuses_ids: self.reuses_ids };
        self.with(t, sizes, |t, quality, mask| t.refine(quality, &options, mask))
    }

    /// Whether nothing is proved of such angles: in practice they are reached, but not between all segments.
    pub fn may_be_endless(&self) -> bool {
        self.least_angle > 26.5
    }

    /// How many cells are below the quality by more than rounding makes of it.
    pub fn count_bad(&self, t: &MovingTriangulation<Plane>, sizes: &[f64]) -> usize {
        let levels = t.nesting_levels().expect("room");
        let cells = t.cells().expect("room").corners.iter().zip(levels);
        let cosine = self.least_angle.to_radians().cos() + 1e-9;
        let is_bad = |&(row, level): &(&[deldrift::VertexId; 3], u32)| {
            let p = row.map(|v| t.position(v).expect("present"));
            let way = |i: usize, j: usize| [p[j][0] - p[i][0], p[j][1] - p[i][1]];
            let length = |[x, y]: [f64; 2]| (x * x + y * y).sqrt();
            let [u, v] = [way(0, 1), way(0, 2)];
            let area = (u[0] * v[1] - u[1] * v[0]) / 2.0;
            let of_label = self.areas.get(level as usize).copied().unwrap_or(0.0);
            let is_large =
                [self.greatest_area, of_label].iter().any(|&most| most > 0.0 && area > most * (1.0 + 1e-9));
            let is_sharp = (0..3).any(|i| {
                let [a, b] = [way(i, (i + 1) % 3), way(i, (i + 2) % 3)];
                self.least_angle > 0.0 && a[0] * b[0] + a[1] * b[1] > cosine * length(a) * length(b)
            });
            let is_long = self.has_sizes
                && (0..3).any(|i| {
                    let mean = row.iter().map(|v| sizes[v.index()]).sum::<f64>() / 3.0;
                    length(way(i, (i + 1) % 3)) > mean * (1.0 + 1e-9)
                });
            self.selects(level) && (is_large || is_sharp || is_long)
        };
        cells.filter(is_bad).count()
    }
}

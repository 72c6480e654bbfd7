//! Means of cells from what they have in common with others.

use super::beside::{Besides, Fit};
use super::overlap::{dot, is_turned_over};
use super::{BeyondFacet, Overlay, Pair, TransferOrder, TransferReport, Transferred};
use crate::error::Result;
use crate::machine::memory;
use crate::predicates::PlaceInSpace;
use std::ops::Range;

/// What a cell that is turned over may have of another one, as rounding may make it of one that is flat.
const NEGLIGIBLE: f64 = 1.0 / (1u64 << 30) as f64;

/// A sum, and what rounding has taken from it.
#[derive(Clone, Copy, Debug, Default)]
struct CompensatedSum {
    sum: f64,
    rest: f64,
}

impl CompensatedSum {
    fn add(&mut self, x: f64) {
        let sum = self.sum + x;
        let of_x = sum - self.sum;
        self.rest += (self.sum - (sum - of_x)) + (x - of_x);
        self.sum = sum;
    }

    fn value(self) -> f64 {
        self.sum + self.rest
    }
}

/// A cell that has come, as its pairs tell of it.
#[derive(Clone, Debug)]
struct Cover {
    pairs: Range<usize>,
    /// By what shares are divided: their sum, 1 where a cell that is turned over is met; 0 for a cell with no pairs.
    whole: f64,
    is_signed: bool,
    /// The pair with the greatest share.
    first: usize,
}

/// Where the mean of a cell comes from that nothing covers.
#[derive(Clone, Copy, Debug)]
enum Source {
    Pairs,
    Nothing,
    Arrived(u32),
    Before(u32),
}

/// Numbers of one component.
#[derive(Default)]
struct Work {
    low: Vec<f64>,
    /// By pair, what its gradient adds to the mean.
    added: Vec<f64>,
    /// By cell that has come, the shares of what is added and taken that leave it in its range.
    room: Vec<[f64; 2]>,
    range: Vec<[f64; 2]>,
    /// By cell that is gone, its gradient, and which share of that is used.
    gradients: Vec<(PlaceInSpace, f64)>,
}

impl Overlay<'_> {
    pub(super) fn transfer<const D: usize>(
        &self,
        order: TransferOrder,
        n_values: usize,
        value: &impl Fn(u32, usize) -> f64,
    ) -> Result<Transferred> {
        let covers = self.covers()?;
        let sources = self.sources(&covers)?;
        let mut fits = Vec::new();
        let besides = match order {
            TransferOrder::First => None,
            TransferOrder::Second => {
                let besides = Besides::of::<D>(self.gone, self.arrived)?;
                memory::collect(&mut fits, (0..self.gone.len()).map(|k| besides.fit::<D>(k)))?;
                for cover in covers.iter().filter(|cover| cover.is_signed) {
                    self.pairs[cover.pairs.clone()].iter().for_each(|pair| fits[pair.gone as usize] = None);
                }
                Some(besides)
            }
        };
        let gradients = besides.as_ref().map(|besides| (besides, &fits[..]));
        let mut report = self.report::<D>(&covers)?;
        memory::lengthen(&mut report.lost, n_values, 0.0)?;
        memory::lengthen(&mut report.gained, n_values, 0.0)?;
        let (mut cells, mut means) = (Vec::new(), Vec::new());
        memory::collect(&mut cells, self.arrived.iter().map(|cell| cell.index))?;
        memory::lengthen(&mut means, cells.len() * n_values, 0.0)?;
        let mut work = self.room()?;
        for c in 0..n_values {
            self.transfer_one(&covers, &sources, gradients, &mut work, &|before| value(before, c));
            for (i, mean) in work.low.iter().enumerate() {
                means[i * n_values + c] = *mean;
            }
            (report.lost[c], report.gained[c]) = self.account(&covers, &work, |before| value(before, c));
        }
        Ok(Transferred { cells, means, report })
    }

    /// Memory for one component.
    fn room(&self) -> Result<Work> {
        let mut work = Work::default();
        memory::lengthen(&mut work.low, self.arrived.len(), 0.0)?;
        memory::lengthen(&mut work.room, self.arrived.len(), [1.0; 2])?;
        memory::lengthen(&mut work.range, self.arrived.len(), [0.0; 2])?;
        memory::lengthen(&mut work.added, self.pairs.len(), 0.0)?;
        memory::lengthen(&mut work.gradients, self.gone.len(), ([0.0; 3], 0.0))?;
        Ok(work)
    }

    fn covers(&self) -> Result<Vec<Cover>> {
        let mut covers = Vec::new();
        memory::reserve_exact(&mut covers, self.arrived.len())?;
        let mut at = 0;
        for i in 0..self.arrived.len() as u32 {
            let n = self.pairs[at..].iter().take_while(|pair| pair.arrived == i).count();
            let pairs = at..at + n;
            at = pairs.end;
            let shares = || self.pairs[pairs.clone()].iter().map(|pair| pair.share);
            let is_signed = shares().any(|share| share < -NEGLIGIBLE);
            let sum: f64 = shares().sum();
            let whole = if is_signed { 1.0 } else { sum.max(0.0) };
            let first = pairs.clone().fold(pairs.start, |first, k| {
                if self.pairs[k].share.abs() > self.pairs[first].share.abs() { k } else { first }
            });
            covers.push(Cover { pairs, whole, is_signed, first });
        }
        Ok(covers)
    }

    /// Where the means come from: for cells that nothing covers from the nearest one, by facets, that has any.
    fn sources(&self, covers: &[Cover]) -> Result<Vec<Source>> {
        let mut sources = Vec::new();
        let of = |cover: &Cover| if cover.whole > 0.0 { Source::Pairs } else { Source::Nothing };
        memory::collect(&mut sources, covers.iter().map(of))?;
        let is_empty = |sources: &[Source], i: u32| matches!(sources[i as usize], Source::Nothing);
        let mut queue = Vec::new();
        for i in (0..covers.len() as u32).filter(|&i| covers[i as usize].whole <= 0.0) {
            let source = self.arrived[i as usize].beyond.iter().find_map(|beyond| match *beyond {
                BeyondFacet::Living { before, .. } => Some(Source::Before(before)),
                BeyondFacet::Arrived(k) if covers[k as usize].whole > 0.0 => Some(Source::Arrived(k)),
                _ => None,
            });
            if let Some(source) = source {
                sources[i as usize] = source;
                memory::push(&mut queue, i)?;
            }
        }
        let mut next = 0;
        while let Some(&i) = queue.get(next) {
            next += 1;
            for beyond in &self.arrived[i as usize].beyond {
                if let &BeyondFacet::Arrived(k) = beyond
                    && is_empty(&sources, k)
                {
                    sources[k as usize] = sources[i as usize];
                    memory::push(&mut queue, k)?;
                }
            }
        }
        Ok(sources)
    }

    fn report<const D: usize>(&self, covers: &[Cover]) -> Result<TransferReport> {
        let (mut lost, mut gained) = (CompensatedSum::default(), CompensatedSum::default());
        self.volumes_gone.iter().for_each(|&volume| lost.add(volume));
        self.volumes_arrived.iter().for_each(|&volume| gained.add(volume));
        for pair in &self.pairs {
            let volume = self.volumes_arrived[pair.arrived as usize];
            lost.add(-volume * pair.share);
            gained.add(-volume * pair.share);
        }
        Ok(TransferReport {
            gone: self.gone.len(),
            arrived: self.arrived.len(),
            overlaps: self.pairs.len(),
            turned_over: self.gone.iter().filter(|cell| is_turned_over::<D>(&cell.corners)).count(),
            uncovered: covers.iter().filter(|cover| cover.whole <= 0.0).count(),
            lost_volume: lost.value(),
            gained_volume: gained.value(),
            volume_error: self.volume_error,
            ..TransferReport::default()
        })
    }

    /// Makes the means of one component, which `work.low` has then.
    fn transfer_one(
        &self,
        covers: &[Cover],
        sources: &[Source],
        gradients: Option<(&Besides, &[Option<Fit>])>,
        work: &mut Work,
        value: &impl Fn(u32) -> f64,
    ) {
        let of = |pair: &Pair| value(self.gone[pair.gone as usize].before);
        for (i, cover) in covers.iter().enumerate() {
            let pairs = &self.pairs[cover.pairs.clone()];
            let Some(first) = self.pairs.get(cover.first).filter(|_| cover.whole > 0.0) else { continue };
            let (middle, mut range) = (of(first), [of(first); 2]);
            let mut sum = 0.0;
            for pair in pairs {
                let there = of(pair);
                sum += pair.share * (there - middle);
                range = [range[0].min(there), range[1].max(there)];
            }
            let low = middle + sum / cover.whole;
            (work.low[i], work.range[i]) =
                (if cover.is_signed { low } else { low.max(range[0]).min(range[1]) }, range);
        }
        if let Some((besides, fits)) = gradients {
            self.add_gradients(covers, besides, fits, work, value);
        }
        for (i, source) in sources.iter().enumerate() {
            work.low[i] = match *source {
                Source::Pairs => continue,
                Source::Nothing => 0.0,
                Source::Before(before) => value(before),
                // One that has pairs.
                Source::Arrived(k) => work.low[k as usize],
            };
        }
    }

    /// Adds what follows from the gradients, as far as no mean leaves its range.
    fn add_gradients(
        &self,
        covers: &[Cover],
        besides: &Besides,
        fits: &[Option<Fit>],
        work: &mut Work,
        value: &impl Fn(u32) -> f64,
    ) {
        for ((k, cell), gradient) in self.gone.iter().enumerate().zip(&mut work.gradients) {
            let own = value(cell.before);
            let found = fits[k].as_ref().map(|fit| besides.gradient(k, fit, |before| value(before) - own));
            *gradient = match found.filter(|g| g.iter().all(|x| x.is_finite())) {
                Some(found) => (found, 1.0),
                None => ([0.0; 3], 0.0),
            };
        }
        for (pair, added) in self.pairs.iter().zip(&mut work.added) {
            let (gradient, used) = &mut work.gradients[pair.gone as usize];
            *added = dot(gradient, &pair.moment) / covers[pair.arrived as usize].whole;
            if !added.is_finite() {
                (*added, *used) = (0.0, 0.0);
            }
        }
        for (i, cover) in covers.iter().enumerate() {
            let [low, high] = &mut work.range[i];
            let mut sums = [0.0; 2];
            for k in cover.pairs.clone() {
                let added = work.added[k];
                sums[usize::from(added < 0.0)] += added.abs();
                besides.for_values(self.pairs[k].gone, |before| {
                    let there = value(before);
                    (*low, *high) = (low.min(there), high.max(there));
                });
            }
            let mean = work.low[i];
            let share = |room: f64, sum: f64| if sum > room { room / sum } else { 1.0 };
            work.room[i] = [share(*high - mean, sums[0]), share(mean - *low, sums[1])];
        }
        for (pair, &added) in self.pairs.iter().zip(&work.added) {
            let used = &mut work.gradients[pair.gone as usize].1;
            if added != 0.0 {
                *used = used.min(work.room[pair.arrived as usize][usize::from(added < 0.0)]);
            }
        }
        for (i, cover) in covers.iter().enumerate().filter(|(_, cover)| !cover.is_signed) {
            let added = cover.pairs.clone().map(|k| self.used(work, k)).sum::<f64>();
            work.low[i] = (work.low[i] + added).max(work.range[i][0]).min(work.range[i][1]);
        }
    }

    /// What the gradient of a pair adds to the mean.
    fn used(&self, work: &Work, k: usize) -> f64 {
        work.added[k] * work.gradients[self.pairs[k].gone as usize].1
    }

    /// What of one component is lost, and what is gained.
    fn account(&self, covers: &[Cover], work: &Work, value: impl Fn(u32) -> f64) -> (f64, f64) {
        let (mut lost, mut gained) = (CompensatedSum::default(), CompensatedSum::default());
        for (cell, volume) in self.gone.iter().zip(&self.volumes_gone) {
            lost.add(volume * value(cell.before));
        }
        for (mean, volume) in work.low.iter().zip(&self.volumes_arrived) {
            gained.add(volume * mean);
        }
        for (k, pair) in self.pairs.iter().enumerate() {
            let there = value(self.gone[pair.gone as usize].before);
            let added = self.used(work, k) * covers[pair.arrived as usize].whole;
            let content = self.volumes_arrived[pair.arrived as usize] * (pair.share * there + added);
            lost.add(-content);
            gained.add(-content);
        }
        (lost.value(), gained.value())
    }
}

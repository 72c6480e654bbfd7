//! Replays with other values of a constant, and what comes of them.

use crate::constants::Constant;
use crate::inputs::Input;
use crate::recording::{Step, counts};
use crate::trial::Trial;
use std::fmt;

/// Of several replays, the sum of the least time of each step: all do the same work, and what else the machine does
/// only adds to it.
fn seconds(replays: &[Vec<Step>]) -> f64 {
    let step = |k: usize| replays.iter().map(|steps| steps[k].seconds).fold(f64::INFINITY, f64::min);
    (0..replays[0].len()).map(step).sum()
}

/// An input, and what is replayed with each value, in units of the time with the constant as it is.
struct Compared<'i> {
    input: &'i str,
    ratios: Vec<f64>,
    noise: f64,
}

/// Compares trials with the first of them; `None` if all count the same.
fn compare<'i>(input: &'i Input, trials: &[Trial], rounds: usize) -> Option<Compared<'i>> {
    let differ = |trial: &&Trial| counts(&input.replayed_with(trial)) != input.counts;
    let others: Vec<Option<&Trial>> = trials[1..].iter().map(|trial| Some(trial).filter(differ)).collect();
    if others.iter().all(Option::is_none) {
        return None;
    }
    // As it is it comes twice, at both ends.
    let mut takers = vec![Some(&trials[0])];
    takers.extend(others);
    takers.push(Some(&trials[0]));
    let mut replays = vec![Vec::new(); takers.len()];
    for _ in 0..rounds {
        for (replays, taker) in replays.iter_mut().zip(&takers) {
            if let Some(trial) = taker {
                replays.push(input.replayed_with(trial));
            }
        }
    }
    let times: Vec<Option<f64>> =
        replays.iter().map(|replays| (!replays.is_empty()).then(|| seconds(replays))).collect();
    let (first, last) = (times[0].expect("replayed"), times[takers.len() - 1].expect("replayed"));
    let as_is = f64::midpoint(first, last);
    let ratios = times[1..takers.len() - 1].iter().map(|time| time.map_or(1.0, |time| time / as_is));
    Some(Compared { input: &input.name, ratios: ratios.collect(), noise: (first / last).ln().abs() })
}

/// What has been measured of a constant.
pub struct Measured<'i> {
    constant: &'i Constant,
    dimension: usize,
    /// The values tried.
    values: Vec<f64>,
    /// The inputs on which they make a difference.
    compared: Vec<Compared<'i>>,
}

impl<'i> Measured<'i> {
    pub const HEADING: &'static str = "D constant                        present   measured  regret   worst  noise  \
                                       (of all inputs, at worst)";
    pub const COLUMNS: &'static str = "dimension,constant,present,measured,regret,worst,worst_input,noise";

    pub fn of(constant: &'i Constant, inputs: &'i [Input], rounds: usize, factors: &[f64]) -> Self {
        let values = constant.values(factors);
        let trial = |&value: &f64| {
            let mut trial = Trial::as_is();
            (constant.set)(&mut trial, value);
            trial
        };
        let mut trials = vec![Trial::as_is()];
        trials.extend(values.iter().map(trial));
        let inputs_of_it = inputs.iter().filter(|input| constant.is_measured_on(&input.name));
        let compared = inputs_of_it.filter_map(|input| compare(input, &trials, rounds)).collect();
        Measured { constant, dimension: inputs[0].dimension, values, compared }
    }

    /// Time with a value in units of that with the constant as it is, the geometric mean over inputs.
    fn ratio(&self, k: usize) -> f64 {
        let logarithms = self.compared.iter().map(|compared| compared.ratios[k].ln());
        (logarithms.sum::<f64>() / self.compared.len() as f64).exp()
    }

    /// The value measured by itself, or else the best of those tried, if one is better than the present one.
    fn best(&self) -> Option<usize> {
        if self.compared.is_empty() {
            return None;
        }
        if let Some(measured) = self.constant.measured {
            return self.values.iter().position(|&value| value == measured);
        }
        let best = (0..self.values.len()).min_by(|&a, &b| self.ratio(a).total_cmp(&self.ratio(b)));
        best.filter(|&k| self.ratio(k) < 1.0)
    }

    fn noise(&self) -> f64 {
        self.compared.iter().map(|compared| compared.noise).fold(0.0, f64::max)
    }

    /// The measured value, the regret of the present one on average and at worst, and where that is.
    fn summary(&self) -> (f64, f64, f64, &str) {
        let Some(k) = self.best() else {
            return (self.constant.measured.unwrap_or(self.constant.present), 0.0, 0.0, "");
        };
        let regret = |compared: &Compared| 1.0 / compared.ratios[k] - 1.0;
        let worst = self.compared.iter().max_by(|a, b| regret(a).total_cmp(&regret(b))).expect("some");
        let value = self.constant.measured.unwrap_or(self.values[k]);
        (value, 1.0 / self.ratio(k) - 1.0, regret(worst), worst.input)
    }

    /// The row of the file.
    pub fn row(&self) -> String {
        let (value, regret, worst, input) = self.summary();
        let Constant { name, present, .. } = self.constant;
        format!(
            "{},{name},{present:.4},{value:.4},{regret:.4},{worst:.4},{input},{:.4}",
            self.dimension,
            self.noise()
        )
    }
}

impl fmt::Display for Measured<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (value, regret, worst, input) = self.summary();
        let Constant { name, present, .. } = self.constant;
        let percent = |x: f64| format!("{:.1} %", 100.0 * x);
        let is_within_noise = !self.compared.is_empty() && regret.abs() <= self.noise();
        let input = if is_within_noise { "within noise" } else { input };
        writeln!(
            f,
            "{} {name:30} {present:9.4} {value:10.4} {:>7} {:>7} {:>6}  {input}",
            self.dimension,
            percent(regret),
            percent(worst),
            percent(self.noise())
        )?;
        if !self.compared.is_empty() {
            write!(f, "    {:28}", "time with")?;
            self.values.iter().try_for_each(|value| write!(f, " {value:9.4}"))?;
            writeln!(f, "  noise")?;
        }
        for Compared { input, ratios, noise } in &self.compared {
            write!(f, "    {input:28}")?;
            ratios.iter().try_for_each(|ratio| write!(f, " {ratio:9.3}"))?;
            writeln!(f, " {:>6}", percent(*noise))?;
        }
        Ok(())
    }
}

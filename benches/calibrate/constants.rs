//! The constants, and how each is tried.

use crate::trial::Trial;
use deldrift::internals::constants::{Constants, Costs};
use deldrift::motion::SwitchingRule;

/// How other values are made of one.
#[derive(Clone, Copy)]
enum Scale {
    /// By factors.
    Real,
    /// By factors, rounded, and at least 1.
    Whole,
    /// Shares of a whole: by factors of share and rest.
    Share,
}

/// Gives a constant another value.
type Set = Box<dyn Fn(&mut Trial, f64)>;

pub struct Constant {
    pub name: &'static str,
    pub present: f64,
    /// What it is by itself, if it is a cost.
    pub measured: Option<f64>,
    pub set: Set,
    scale: Scale,
    /// The inputs that it is measured on begin with one of these, if there are any.
    inputs: &'static [&'static str],
}

impl Constant {
    /// Other values than the present one.
    pub fn values(&self, factors: &[f64]) -> Vec<f64> {
        let x = self.present;
        let value = |&factor: &f64| match self.scale {
            Scale::Real => factor * x,
            Scale::Whole => (factor * x).round().max(1.0),
            Scale::Share => factor * x / (1.0 - x + factor * x),
        };
        let mut values: Vec<f64> = factors.iter().map(value).chain(self.measured).collect();
        values.retain(|&value| value != x);
        values.dedup();
        values
    }

    pub fn is_measured_on(&self, input: &str) -> bool {
        let begins_with = |names: &[&str]| names.iter().any(|name| input.starts_with(name));
        self.inputs.is_empty() || begins_with(self.inputs)
    }
}

/// The constants of a struct that has no other fields: of each its name, and how other values are made.
macro_rules! constants {
    ($prefix:literal $type:ident, $within:expr, [$($name:ident: $scale:ident),+ $(,)?] $(besides $other:ident)?) => {{
        let within: fn(&mut Trial) -> &mut $type = $within;
        let $type { $($name,)+ $($other: _)? } = *within(&mut Trial::as_is());
        vec![$(Constant {
            name: concat!($prefix, stringify!($name)),
            present: $name as f64,
            measured: None,
            set: Box::new(move |trial, value| within(trial).$name = value as _),
            scale: Scale::$scale,
            inputs: &[],
        }),+]
    }};
}

/// The constants of a dimension, of which costs have been measured.
pub fn of_dimension(dimension: usize, measured: &Costs) -> Vec<Constant> {
    let mut constants = costs_of(dimension, measured);
    constants.extend(thresholds_of(dimension));
    constants.extend(rule_of(dimension));
    constants
}

fn costs_of(dimension: usize, &measured: &Costs) -> Vec<Constant> {
    let within: fn(&mut Trial) -> &mut Costs = if dimension == 2 {
        |trial| &mut trial.table.plane.costs
    } else {
        |trial| &mut trial.table.space.costs
    };
    let mut costs = constants!("costs." Costs, within, [
        watched: Real, beyond: Real, sweep: Real, used_up: Real, computed: Real, rebuilt: Real, placed: Real,
        certified: Real, exact: Real,
    ] besides slack);
    let Costs { watched, beyond, sweep, slack, used_up, computed, rebuilt, placed, certified, exact } =
        measured;
    for (cost, measured) in
        costs.iter_mut().zip([watched, beyond, sweep, used_up, computed, rebuilt, placed, certified, exact])
    {
        cost.measured = Some(measured);
    }
    // Infinite where it is none.
    let slack_as_is = within(&mut Trial::as_is()).slack;
    costs.push(Constant {
        name: "costs.slack",
        present: slack_as_is.unwrap_or(f64::INFINITY),
        measured: slack,
        set: Box::new(move |trial, value| within(trial).slack = Some(value)),
        scale: Scale::Real,
        inputs: &[],
    });
    // All at once, but where slack never pays it is left out.
    costs.push(Constant {
        name: "costs",
        present: 0.0,
        measured: Some(1.0),
        set: Box::new(move |trial, _| *within(trial) = Costs { slack: slack_as_is.and(slack), ..measured }),
        scale: Scale::Real,
        inputs: &[],
    });
    costs
}

fn thresholds_of(dimension: usize) -> Vec<Constant> {
    let within: fn(&mut Trial) -> &mut Constants =
        if dimension == 2 { |trial| &mut trial.table.plane } else { |trial| &mut trial.table.space };
    constants!("" Constants, within, [
        min_wait_commits: Whole,
        weight_of_last: Share,
        vertices_per_change: Real,
        vertices_per_change_to_watch: Real,
        max_excess: Real,
        max_imbalance: Real,
        swept_per_placement: Whole,
        rebuilt_per_placement: Whole,
        failures_per_placement: Whole,
        failures_per_moved: Real,
        certified_per_vertex: Whole,
        max_failing: Real,
        max_failing_with_inverted: Real,
        failing_for_inverted: Real,
        max_failing_of_large: Real,
        cells_of_large: Real,
        exact_per_swept: Real,
        max_placing: Real,
        watched_share: Real,
        rebuilt_per_edit: Whole,
    ] besides costs)
}

/// The report's rule of *rebuilding + tolerance*, which programs may change.
fn rule_of(dimension: usize) -> Vec<Constant> {
    let constant = |name, present, scale, set: fn(&mut Trial, f64)| Constant {
        name,
        present,
        measured: None,
        set: Box::new(set),
        scale,
        inputs: &["switching"],
    };
    let rule = SwitchingRule::default();
    let share = if dimension == 2 { 0.75 } else { 0.55 };
    vec![
        constant("switching.sample", rule.sample.into(), Scale::Whole, |trial, x| {
            trial.rule.sample = x as u32
        }),
        constant("switching.period", rule.period.into(), Scale::Whole, |trial, x| {
            trial.rule.period = x as u32
        }),
        constant("switching.share", share, Scale::Share, |trial, x| trial.rule.share = Some(x)),
    ]
}

//! The constants, and how each is tried.

use crate::trials::Trial;
use deldrift::internals::constants::{Constants, Costs, Reading};
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
    /// By factors of what is more than 1.
    AboveOne,
}

/// What has to be timed.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Timing {
    /// All commits, where one of them counts other than with the constant as it is.
    IfCountsDiffer,
    /// All commits.
    Always,
}

/// Gives a constant another value.
type Set = Box<dyn Fn(&mut Trial, f64)>;

pub struct Constant {
    pub name: &'static str,
    pub present: f64,
    /// What it is by itself, if it is a cost.
    pub measured: Option<f64>,
    pub set: Set,
    pub timing: Timing,
    scale: Scale,
    /// The inputs that it is measured on begin with one of these, if there are any.
    inputs: &'static [&'static str],
}

/// Inputs for those constants alone that no commit's counts tell of.
const APART: [&str; 4] = ["read", "leap", "mixed", "monitored"];

impl Constant {
    /// Other values than the present one.
    pub fn values(&self, factors: &[f64]) -> Vec<f64> {
        let x = self.present;
        let value = |&factor: &f64| match self.scale {
            Scale::Real => factor * x,
            Scale::Whole => (factor * x).round().max(1.0),
            Scale::Share => factor * x / (1.0 - x + factor * x),
            Scale::AboveOne => 1.0 + factor * (x - 1.0),
        };
        let mut values: Vec<f64> = factors.iter().map(value).chain(self.measured).collect();
        values.retain(|&value| value != x);
        values.dedup();
        values
    }

    pub fn is_measured_on(&self, input: &str) -> bool {
        let begins_with = |names: &[&str]| names.iter().any(|name| input.starts_with(name));
        if self.inputs.is_empty() { !begins_with(&APART) } else { begins_with(self.inputs) }
    }

    fn timed_on(self, inputs: &'static [&'static str]) -> Self {
        Constant { timing: Timing::Always, inputs, ..self }
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
            timing: Timing::IfCountsDiffer,
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
        timing: Timing::IfCountsDiffer,
        scale: Scale::Real,
        inputs: &[],
    });
    // All at once, but where slack never pays it is left out.
    costs.push(Constant {
        name: "costs",
        present: 0.0,
        measured: Some(1.0),
        set: Box::new(move |trial, _| *within(trial) = Costs { slack: slack_as_is.and(slack), ..measured }),
        timing: Timing::IfCountsDiffer,
        scale: Scale::Real,
        inputs: &[],
    });
    costs
}

fn thresholds_of(dimension: usize) -> Vec<Constant> {
    let within: fn(&mut Trial) -> &mut Constants =
        if dimension == 2 { |trial| &mut trial.table.plane } else { |trial| &mut trial.table.space };
    let constants = constants!("" Constants, within, [
        min_wait_commits: Whole,
        max_wait_commits: Whole,
        wait_growth: Whole,
        weight_of_last: Share,
        vertices_per_change: Real,
        vertices_per_change_to_watch: Real,
        rarer_changes: Real,
        vertices_per_used_up_to_watch: Whole,
        max_excess: Real,
        max_imbalance: Real,
        max_share_beyond: Share,
        beyond_per_placed: Real,
        sampled_vertices: Whole,
        min_share_within: Share,
        swept_per_placement: Whole,
        max_rebuilds: Whole,
        rebuilds_growth: Whole,
        share_too_many: Share,
        min_share_of_round: Share,
        shorter_rounds: Real,
        rebuilt_per_placement: Whole,
        failures_per_placement: Whole,
        failures_per_moved: Real,
        certified_per_vertex: Whole,
        max_rounds: Whole,
        max_untanglings: Whole,
        max_failing: Real,
        max_failing_with_inverted: Real,
        failing_for_inverted: Real,
        max_failing_of_large: Real,
        cells_of_large: Real,
        exact_of_ties: Real,
        sample_margin: AboveOne,
        exact_per_swept: Real,
        slower_per_doubling: Real,
        near_bytes: Whole,
        built_alone: Share,
        repaired_alone: Share,
        max_placing: Real,
        min_share_spent: Share,
        max_share_beyond_alone: Share,
        watched_share: Real,
        max_share_expired: Share,
        max_share_followed: Share,
        margin: Real,
        moves_per_fit: Whole,
        max_stride_ratio: AboveOne,
        replaced_to_sort: Real,
        replaced_to_sort_first: Real,
        relocations_per_call: Whole,
        rebuilt_per_edit: Whole,
    ] besides costs);
    let timed = |constant: Constant| match constant.name {
        "max_stride_ratio" => constant.timed_on(&["leap"]),
        "replaced_to_sort" | "replaced_to_sort_first" => constant.timed_on(&["mixed"]),
        "relocations_per_call" => constant.timed_on(&["monitored"]),
        "moves_per_fit" => constant.timed_on(&["lloyd", "odt", "walk"]),
        _ => constant,
    };
    constants.into_iter().map(timed).collect()
}

/// The constants of reading.
pub fn of_reading() -> Vec<Constant> {
    let constants = constants!("" Reading, |trial| &mut trial.table.reading, [
        max_share_listed: Share,
        scanned_per_sorted: Whole,
        min_cells_listed: Whole,
        max_ids_per_cell: Whole,
        max_cells_per_corner: Whole,
    ]);
    constants.into_iter().map(|constant| constant.timed_on(&["read"])).collect()
}

/// The report's rule of *rebuilding + tolerance*, which programs may change.
fn rule_of(dimension: usize) -> Vec<Constant> {
    let constant = |name, present, scale, set: fn(&mut Trial, f64)| Constant {
        name,
        present,
        measured: None,
        set: Box::new(set),
        timing: Timing::IfCountsDiffer,
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

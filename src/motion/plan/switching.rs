//! Which of the two algorithms has its turn.

use crate::motion::options::SwitchingRule;

/// Where the algorithm is, and the rule that it goes by.
#[derive(Clone, Debug, Default)]
pub(in crate::motion) struct Switching {
    rule: SwitchingRule,
    has_switched: bool,
    commits: u64,
    draws: u64,
}

impl Switching {
    /// The rule in force.
    pub(in crate::motion) fn rule(&self) -> SwitchingRule {
        self.rule
    }

    /// From now on this is the rule.
    pub(in crate::motion) fn set_rule(&mut self, rule: SwitchingRule) {
        self.rule = rule;
    }

    /// Makes it rebuilding's turn again, with the first commit of a group.
    pub(in crate::motion) fn start_over(&mut self) {
        *self = Switching { rule: self.rule, ..Switching::default() };
    }

    /// Whether it is *tolerance*'s turn.
    pub(in crate::motion) fn has_switched(&self) -> bool {
        self.has_switched
    }

    /// A commit begins, one of a `group`. Whether it is to take a sample.
    pub(in crate::motion) fn begin_commit(&mut self, group: u64) -> bool {
        self.commits += 1;
        !self.has_switched && (self.commits - 1).is_multiple_of(group)
    }

    /// From now on it is *tolerance*'s turn.
    pub(in crate::motion) fn switch(&mut self) {
        self.has_switched = true;
    }

    /// A number below `n`, by SplitMix64 (Steele, Lea and Flood, 10.1145/2714064.2660195).
    pub(in crate::motion) fn draw(&mut self, seed: u64, n: usize) -> usize {
        self.draws += 1;
        let mut z = seed.wrapping_add(self.draws.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((u128::from(z ^ z >> 31) * n as u128) >> 64) as usize
    }
}

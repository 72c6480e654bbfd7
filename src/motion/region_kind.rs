//! The kinds of regions.

/// Which regions let a vertex pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RegionKind {
    /// Algorithm 1, T.
    Tolerance,
    /// Algorithm 2, S.
    SafeRegion,
    /// S+T: the safe region only where the tolerance fails.
    Both,
    /// The tolerance, of those bi-cells that are not [watched](super::filters::watching).
    Watch,
    /// The tolerance of each bi-cell for itself.
    Slack,
}

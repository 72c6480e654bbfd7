//! Ways from one timestamp to the next, by which every vertex comes to its goal and the cells are those of the new
//! positions.
//!
//! | file | report | what |
//! |---|---|---|
//! | `rebuilding` | section 1 | triangulate all positions again |
//! | `placement` | sections 3.1, 3.2 | relocate the vertices one at a time |
//! | `tolerance` | section 3.3, Algorithm 1 | place only vertices that leave their tolerance |
//! | `safe_region` | section 3.3, Algorithm 2 | place only vertices that leave their safe region |
//! | `switching` | section 5.2 | rebuild until few leave their tolerance |
//! | `repair` | | move all at once, check every certificate, mend what fails |
//! | `watching` | | as repair, but of what has left its tolerance, or soon will |
//! | `slack` | | as repair, but of bi-cells whose own tolerance is used up |
//! | `auto` | | watching, slack, repair or rebuilding, by what the last commits found |
//!
//! `moving` has the loops that move all vertices, `outlook` what is known of moves before a way is chosen, `following`
//! what commits with regions have in common, and `attempt` how the parts of a commit end.

pub(in crate::motion) mod attempt;
pub(in crate::motion) mod auto;
pub(in crate::motion) mod following;
pub(in crate::motion) mod moving;
pub(in crate::motion) mod outlook;
pub(in crate::motion) mod placement;
pub(in crate::motion) mod rebuilding;
pub(in crate::motion) mod repair;
pub(in crate::motion) mod safe_region;
pub(in crate::motion) mod slack;
pub(in crate::motion) mod switching;
pub(in crate::motion) mod tolerance;
pub(in crate::motion) mod watching;

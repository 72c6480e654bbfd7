//! *Auto*: the algorithm for each commit, from what the last ones found.
//!
//! | commit | algorithm |
//! |---|---|
//! | of few of the vertices | tolerance if up to date, else placement by flips, rebuilding where that costs more |
//! | of all vertices, while few leave their tolerance | watching |
//! | of all vertices, while few bi-cells use theirs up, in space | slack |
//! | otherwise | repair, which rebuilds where too much fails |
//! | after such a rebuild | rebuilding, for a while |
//!
//! **What is known before** decides before anything that the last commits have found: where nothing moves, nothing is
//! done; where all vertices move by exactly the same vector, the cells stay; and few vertices that move are placed,
//! also while commits are rebuilt or a cheaper way is due to be tried ([`outlook`](super::outlook)).
//!
//! **Checking everything or not.** Few flips in the last commits announce that most bi-cells have tolerance left. To
//! compute that of all costs eight sweeps. What is recomputed after that, and watched, is counted and weighed by
//! measured costs ([`constants`](super::constants)). When it has cost more than the expensive way would have, by a
//! share of a computation of all tolerances, the expensive way is taken, and the cheaper one is tried more and more
//! rarely. In space the way down is repair, slack, watching, without slack where almost nothing changes, and the way
//! up the same, without slack where much has changed; in the plane a sweep is so cheap that slack would seldom pay.
//! Before watching a sample of the vertices is checked. When what is watched or what is recomputed has cost more than
//! the other by a share of a computation of all, all tolerances are computed again, so that what is watched follows
//! from how far the vertices go now.
//!
//! **Rebuilding.** A repair may have to rebuild, or cost more than that, only once: when points leave a lattice. So
//! the next commit is swept as well. If repairs rebuild twice in a row, the next commit rebuilds without a sweep, then
//! three commits, then seven. Where a repair was expensive because of what came after its sweep, the next commit with
//! at least half as many failures is rebuilt; after the second such repair three commits are, then seven. What a
//! repair has cost is estimated from what it has counted. On lattices exact evaluations, and removals of vertices of
//! high degree near the hull, cost more than flips.
//!
//! **Immediate relocations** are counted in rounds of as many as there are vertices. After a round of which most
//! changed no cell tolerances are computed, and kept while most relocations are within: a test costs a hundredth of a
//! look at the star, a vertex beyond some eight looks.

mod choice;
mod commit;

pub(super) use choice::Auto;

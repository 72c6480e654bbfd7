//! Calls beside those of `abuse/rows.rs` that the walker pairs with all others: functions with other arguments, in the words
//! of `abuse/words.h` and `harness.h`.

pub type Call = (&'static str, &'static [&'static str]);

pub const MORE: &[Call] = &[
    // Of the vertex that came last, or is to come; to the place of another one; to its own.
    ("deldrift_move_vertex", &["t", "last[0]", "moved"]),
    ("deldrift_move_vertex", &["t", "2", "points"]),
    ("deldrift_move_vertices", &["t", "NULL", "moved", "n_ids"]),
    ("deldrift_relocate_vertex", &["t", "last[0]", "inside"]),
    ("deldrift_relocate_vertex", &["t", "1", "points + 2 * dimension"]),
    ("deldrift_relocate_vertex", &["t", "1", "points + dimension"]),
    ("deldrift_remove_vertex", &["t", "last[0]"]),
    ("deldrift_remove_vertex", &["t", "0"]),
    ("deldrift_stage_removals", &["t", "last", "1"]),
    // Where others are; and none.
    ("deldrift_insert_vertex", &["t", "points", "&out.number"]),
    ("deldrift_stage_insertions", &["t", "points", "2", "&out.number"]),
    ("deldrift_stage_insertions", &["t", "NULL", "0", "&out.number"]),
    ("deldrift_stage_insertions_at_free_ids", &["t", "moved", "NULL", "2", "out.ids"]),
    ("deldrift_insert_vertex_with_key", &["t", "moved", "UINT64_MAX", "&out.number"]),
    // To places as they were, in one line, and nowhere.
    ("deldrift_commit_positions", &["t", "points", "n_ids", "&out.report"]),
    ("deldrift_commit_positions", &["t", "in_line", "n_ids", "&out.report"]),
    ("deldrift_commit_positions", &["t", "nowhere", "n_ids", "&out.report"]),
    ("deldrift_commit_weighted", &["t", "NULL", "weights", "n_ids", "&out.report"]),
    ("deldrift_set_weight", &["t", "last[0]", "-9"]),
    // So heavy that it may hide all others, and so light that it may be hidden.
    ("deldrift_insert_vertex_with_weight", &["t", "inside", "9", "&out.number"]),
    ("deldrift_stage_insertions_with_weights", &["t", "inside", "(double[]){-9}", "1", "&out.number"]),
    ("deldrift_stage_weights", &["t", "last", "weights", "1"]),
    ("deldrift_commit_timestamp", &["cancelled()", "&out.report"]),
    ("deldrift_prepare_timestamp", &["cancelled()", "&out.report"]),
    ("deldrift_set_algorithm", &["t", "DELDRIFT_TOLERANCE"]),
    ("deldrift_stage_vectors", &["t", "strained", "n_vectors"]),
    ("deldrift_stage_segments", &["t", "ends", "NULL", "1", "&out.number"]),
    ("deldrift_stage_segments", &["t", "all_ends", "NULL", "10", "&out.number"]),
    ("deldrift_stage_segment_removals", &["t", "segments + 1", "1"]),
    ("deldrift_refine", &["t", "&finer", "NULL", "0", "&out.quality_report"]),
    ("deldrift_coarsen", &["t", "&coarser", "NULL", "0", "&out.quality_report"]),
    ("deldrift_position", &["t", "last[0]", "out.numbers"]),
    ("deldrift_star", &["t", "last[0]", "out.ids", "ROOM", "&out.count"]),
];

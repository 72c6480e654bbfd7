//! The wrong calls: from the role of a parameter follows what may be wrong with it.

use std::collections::BTreeSet;
use std::fmt::Write;

use super::declarations::{Declaration, Parameter, refused_by_boxes, refused_by_weights, statuses};
use super::roles::{Role, is_of_bytes, role};
use super::rows::{ROWS, Row};

/// Functions for triangulations of the plane alone.
const OF_PLANE: [&str; 25] = [
    "deldrift_set_regions",
    "deldrift_set_segment_sides",
    "deldrift_regions",
    "deldrift_update_labels",
    "deldrift_ordered_star",
    "deldrift_stage_segments",
    "deldrift_stage_segment_removals",
    "deldrift_stage_splits",
    "deldrift_segments",
    "deldrift_segment_conflicts",
    "deldrift_check_passings",
    "deldrift_passings",
    "deldrift_segments_of_cells",
    "deldrift_cells_of_segments",
    "deldrift_nesting_levels",
    "deldrift_crossing_numbers",
    "deldrift_label_cells",
    "deldrift_boundary_chains",
    "deldrift_refine",
    "deldrift_coarsen",
    "deldrift_made_vertices",
    "deldrift_original_segments",
    "deldrift_refined_weights",
    "deldrift_refined_sizes",
    "deldrift_refined_vertices",
];

/// Functions that list what there is not.
const TELL_NOTHING: [&str; 4] =
    ["deldrift_segment_conflicts", "deldrift_passings", "deldrift_vectors", "deldrift_reduced_vectors"];

/// The source of the program.
pub fn program(functions: &[Declaration]) -> String {
    let names = statuses().iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(", ");
    let mut text = format!("#define STATUS_NAMES {names}\n#include \"harness.h\"\n\n");
    let mut list = String::from("const function functions[] = {\n");
    let mut calls = String::from("deldrift_status call(size_t k) {\n    switch (k) {\n");
    // Nor do those for comparisons serve a periodic triangulation.
    let is_of_research = |function: &&Declaration| function.name.starts_with("deldrift_research_");
    let of_research = functions.iter().filter(is_of_research).map(|function| function.name.clone());
    let refused: BTreeSet<String> = refused_by_boxes(functions).into_iter().chain(of_research).collect();
    let refused_by_weights = refused_by_weights(functions);
    for (k, function) in functions.iter().enumerate() {
        let Some(row) = ROWS.iter().find(|row| row.function == function.name) else {
            panic!("{} has no row in ffi-tests/abuse/rows.rs", function.name);
        };
        let arity = function.parameters.len();
        assert_eq!(
            row.arguments.len(),
            arity,
            "the row of {} has another number of arguments",
            function.name
        );
        let is_of_plane = OF_PLANE.contains(&function.name.as_str());
        let has_count = function.tells_count();
        let _ = writeln!(text, "#define BASE {}\n#define HAS_COUNT {has_count}", row.base);
        let _ = writeln!(text, "static void of_{}(void) {{", function.name);
        let mut cases = Cases { function, row, text: &mut text };
        if is_of_plane {
            cases.add(
                "dimension",
                "3D",
                "INVALID_DIMENSION",
                "\"the dimension of t is 3\"",
                &[],
                "if (dimension == 3)",
            );
            cases.line("if (dimension == 3) return;");
        }
        cases.all();
        text += "}\n#undef BASE\n#undef HAS_COUNT\n\n";
        let takes_t = function.takes_t();
        let _ = writeln!(
            list,
            "    {{\"{0}\", {takes_t}, {is_of_plane}, {1}, {has_count}, {2}, {3}, {4}, of_{0}}},",
            function.name,
            row.base,
            refused.contains(&function.name),
            refused_by_weights.contains(&function.name),
            function.errors().contains("DELDRIFT_NOT_WEIGHTED")
        );
        let _ = writeln!(calls, "        case {k}: return {};", call(function, row.arguments));
    }
    let length = "const size_t n_functions = sizeof functions / sizeof *functions;";
    text + &list
        + &format!("}};\n{length}\n\n")
        + &calls
        + "        default: return DELDRIFT_INTERNAL_ERROR;\n    }\n}\n\n\
           int main(void) {\n    try_all();\n    return 0;\n}\n"
}

/// A call as an expression that gives a status.
pub fn call<T: AsRef<str>>(function: &Declaration, arguments: &[T]) -> String {
    let arguments: Vec<&str> = arguments.iter().map(AsRef::as_ref).collect();
    let arguments = arguments.join(", ");
    match (function.returns.as_str(), function.name.as_str()) {
        ("deldrift_status", name) => format!("{name}({arguments})"),
        ("const char", name) => format!("told({name}({arguments}))"),
        (_, "deldrift_destroy") => format!("destroyed({arguments})"),
        (_, "deldrift_free_cells") => format!("freed({arguments})"),
        (_, "deldrift_options_init") => format!("initialised({arguments})"),
        (returns, name) => panic!("{name} gives {returns}, which is no status"),
    }
}

/// Writes the cases of one function.
struct Cases<'f> {
    function: &'f Declaration,
    row: &'f Row,
    text: &'f mut String,
}

impl Cases<'_> {
    fn line(&mut self, line: &str) {
        let _ = writeln!(self.text, "    {line}");
    }

    /// A call with some of the arguments replaced. The first of them is what the case is about.
    fn add(
        &mut self,
        column: &str,
        given: &str,
        status: &str,
        message: &str,
        replaced: &[(usize, String)],
        condition: &str,
    ) {
        let mut arguments: Vec<String> = self.row.arguments.iter().map(|text| text.to_string()).collect();
        for (index, argument) in replaced {
            arguments[*index] = argument.clone();
        }
        let about = replaced.first().map_or("", |&(index, _)| self.function.parameters[index].name.as_str());
        let message = if status == "OK" { "NULL" } else { message };
        let line = format!(
            "{condition} CASE(\"{}\", \"{about}\", \"{column}\", \"{given}\", DELDRIFT_{status}, {message}, {});",
            self.function.name,
            call(self.function, &arguments)
        );
        self.line(line.trim_start());
    }

    /// An argument that is refused. The message is a format and its arguments.
    fn refused(&mut self, column: &str, at: usize, given: &str, argument: &str, status: &str, message: &str) {
        self.add(column, given, status, &format!("text({message})"), &[(at, argument.to_string())], "");
    }

    fn legal(&mut self, column: &str, at: usize, given: &str, argument: &str) {
        self.add(column, given, "OK", "", &[(at, argument.to_string())], "");
    }

    fn roles(&self) -> Vec<Role> {
        self.function.parameters.iter().map(|parameter| role(self.function, parameter)).collect()
    }

    fn all(&mut self) {
        self.add("valid", "what is right", "OK", "", &[], "");
        for (at, role) in self.roles().into_iter().enumerate() {
            let parameter = self.function.parameters[at].clone();
            if parameter.c_type.ends_with('*') {
                self.null(at, role, &parameter);
                self.misaligned(at, role, &parameter);
                self.contents(at, role, &parameter);
            } else {
                self.number(at, role, &parameter);
            }
        }
        self.overlaps();
    }

    fn null(&mut self, at: usize, role: Role, parameter: &Parameter) {
        let name = &parameter.name;
        let n_buffers = self.roles().iter().filter(|&&role| role == Role::Buffer).count();
        // Lists have offsets, which may be left out, and entries, which may only be left out with their capacity, unless
        // there are several arrays of them.
        let is_list = self.function.has("offsets");
        let is_legal = match role {
            // Of a triangulation that is not periodic there are none.
            Role::Vectors => self.function.name == "deldrift_stage_vectors",
            Role::Handle => self.function.name == "deldrift_destroy",
            Role::Owner
            | Role::Hint
            | Role::Options
            | Role::ResearchOptions
            | Role::OutputIfAny
            | Role::NumbersIfAny
            | Role::WholesIfAny
            | Role::MaskIfAny
            | Role::PointsIfAny
            | Role::VertexWeightsIfAny
            | Role::KeysIfAny => true,
            Role::Ids => {
                ["deldrift_move_vertices", "deldrift_stage_weights"].contains(&self.function.name.as_str())
            }
            Role::Buffer => {
                // A buffer that is alone in having its capacity may only be left out with that.
                let is_alone = ["deldrift_compact", "deldrift_voronoi_weight_derivatives"];
                !is_alone.contains(&self.function.name.as_str())
                    && n_buffers > 1
                    && (!is_list || name == "offsets" || n_buffers > 2)
            }
            _ => false,
        };
        if is_legal {
            return self.legal("null", at, "NULL", "NULL");
        }
        self.refused("null", at, "NULL", "NULL", "NULL_ARGUMENT", &format!("\"{name} is NULL\""));
    }

    fn misaligned(&mut self, at: usize, role: Role, parameter: &Parameter) {
        // What fills the options is in the header, and is the program's own; what frees has no way to say anything.
        let says_nothing = role == Role::Owner || self.function.name == "deldrift_options_init";
        if is_of_bytes(parameter) || says_nothing {
            return;
        }
        let wrong = match role {
            Role::Handle if self.function.name == "deldrift_destroy" => "(deldrift_triangulation *)odd",
            _ => "odd",
        };
        // There is nothing to be written, or read.
        let is_of_nothing = role == Role::Vectors && self.function.name == "deldrift_stage_vectors";
        if is_of_nothing || role == Role::Buffer && TELL_NOTHING.contains(&self.function.name.as_str()) {
            return self.legal("misaligned", at, "an odd address", wrong);
        }
        let message = format!("\"{} is 0x\"", parameter.name);
        self.refused("misaligned", at, "an odd address", wrong, "MISALIGNED_ARGUMENT", &message);
    }

    /// What may be wrong with what a pointer leads to.
    fn contents(&mut self, at: usize, role: Role, parameter: &Parameter) {
        let (name, valid) = (parameter.name.as_str(), self.row.arguments[at]);
        match role {
            Role::Points | Role::PointsIfAny => {
                let roles = self.roles();
                if name == "seeds" {
                    let message = "\"seeds[0] is on the boundary of several regions\"";
                    self.refused(
                        "value",
                        at,
                        "at the end of a segment",
                        "on_fence()",
                        "AMBIGUOUS_SEED",
                        message,
                    );
                }
                let count = roles.iter().position(|&role| role == Role::Count || role == Role::FixedCount);
                // Of several counts that of the points comes after them.
                let count = if self.function.has("n_values") { Some(at + 1) } else { count };
                self.coordinates(at, name, valid, count.map_or("1", |count| self.row.arguments[count]));
            }
            Role::Vectors if valid != "NULL" => {
                self.coordinates(at, name, valid, "dimension");
                let wanted = "\"vectors[%u] is not independent\", dimension - 1";
                self.refused(
                    "value",
                    at,
                    "all in one direction",
                    "one_direction",
                    "DEPENDENT_VECTORS",
                    wanted,
                );
            }
            Role::HalfSpaces => {
                for (given, value, said) in [("NaN", "NAN", "NaN"), ("infinity", "INFINITY", "inf")] {
                    let wrong = format!("bad({valid}, 2 * dimension + 1, {value})");
                    let message = format!("\"{name}[1], coordinate %u, is {said}\", dimension");
                    let column = if value == "NAN" { "nan" } else { "infinite" };
                    self.refused(column, at, given, &wrong, "NOT_FINITE", &message);
                }
                self.legal("range", at, "2e57", &format!("bad({valid}, 2 * dimension + 1, 2e57)"));
                let message = format!("\"{name}[1] is 0, but must be a normal\"");
                let wrong = format!("bad({valid}, dimension + 1, 0)");
                self.refused("value", at, "a normal that is zero", &wrong, "INVALID_VALUE", &message);
            }
            Role::PointsOfSimplex => self.coordinates(at, name, valid, "(dimension + 1)"),
            Role::PointsOfSphere => self.coordinates(at, name, valid, "(dimension + 2)"),
            Role::BoxCorner => {
                self.coordinates(at, name, valid, "1");
                let (wrong, other) = if name == "low" { ("3.0", "high") } else { ("-1.0", "high") };
                let wrong = format!("bad({valid}, 0, {wrong})");
                let message = format!("\"{other}[0] is \"");
                self.refused("value", at, "beyond the other corner", &wrong, "INVALID_VALUE", &message);
            }
            Role::OpenBoxCorner => {
                let last = |value: &str| format!("bad({valid}, dimension - 1, {value})");
                let message = format!("\"{name}[%u] is NaN\", dimension - 1");
                self.refused("nan", at, "NaN", &last("NAN"), "INVALID_VALUE", &message);
                for value in ["INFINITY", "-INFINITY"] {
                    self.legal("infinite", at, &value.to_lowercase(), &last(value));
                }
                self.legal("range", at, "2e57", &last("2e57"));
                let beyond = if name == "low" { "3.0" } else { "-3.0" };
                self.legal("value", at, "beyond the other corner", &last(beyond));
            }
            Role::Numbers | Role::NumbersIfAny => {
                self.legal("nan", at, "NaN", &format!("bad({valid}, 0, NAN)"));
                self.legal("infinite", at, "infinity", &format!("bad({valid}, 0, INFINITY)"));
            }
            Role::Magnitudes => {
                for (column, value, said) in [("nan", "NAN", "NaN"), ("value", "-1", "-1")] {
                    let message = format!("\"{name}[1] is {said}\"");
                    let given = format!("bad({valid}, 1, {value})");
                    self.refused(column, at, said, &given, "INVALID_VALUE", &message);
                }
                self.legal("infinite", at, "infinity", &format!("bad({valid}, 1, INFINITY)"));
                self.legal("zero", at, "0", &format!("bad({valid}, 1, 0)"));
            }
            Role::Weights => {
                for (column, value, said) in [
                    ("nan", "NAN", "NaN"),
                    ("infinite", "-INFINITY", "-inf"),
                    ("value", "-1.01e114", "-1010000"),
                ] {
                    let message = format!("\"{name}[1] is {said}\"");
                    let given = format!("bad({valid}, 1, {value})");
                    self.refused(column, at, said, &given, "INVALID_VALUE", &message);
                }
                self.legal("value", at, "1e114", &format!("bad({valid}, 1, 1e114)"));
            }
            Role::VertexWeights | Role::VertexWeightsIfAny => {
                for (column, value, said, status) in [
                    ("nan", "NAN", "NaN", "NOT_FINITE"),
                    ("infinite", "-INFINITY", "-inf", "NOT_FINITE"),
                    ("range", "-1.01e114", "-1.01e114", "OUT_OF_RANGE"),
                ] {
                    let message = format!("\"{name}[1] is {said}\"");
                    let given = format!("bad({valid}, 1, {value})");
                    self.refused(column, at, said, &given, status, &message);
                }
                self.legal("range", at, "1e114", &format!("bad({valid}, 1, 1e114)"));
            }
            Role::Ids => self.ids(at),
            Role::Ends => self.ends(at),
            Role::SegmentIds => self.segments(at),
            Role::Wholes | Role::WholesIfAny => {
                self.legal("value", at, "the least number", "bad_wholes(1, INT32_MIN)");
            }
            Role::LabelsOfRegions => {
                let message = "\"labels[0] is -1, \"";
                self.refused("value", at, "two in a region", "two_in_a_region()", "INVALID_VALUE", message);
            }
            Role::KeysIfAny => {
                self.legal("value", at, "the greatest number, more than once", "greatest_keys")
            }
            Role::CellIds | Role::CellIdsIfAny => {
                self.legal("value", at, "one twice", "bad_ids(1, 0)");
                for (given, value) in
                    [("the number of them", "(uint32_t)n_cells"), ("UINT32_MAX", "UINT32_MAX")]
                {
                    if value == "UINT32_MAX" && role == Role::CellIdsIfAny {
                        self.legal("id", at, "DELDRIFT_NONE", "bad_ids(1, DELDRIFT_NONE)");
                        continue;
                    }
                    let message = format!("\"cells[1] is %u\", (unsigned){value}");
                    self.refused("id", at, given, &format!("bad_ids(1, {value})"), "NO_SUCH_FACET", &message);
                }
            }
            Role::Hint => {
                for (given, kind, index) in
                    [("a vertex that is none", 0, "99"), ("a cell that is none", 1, "99")]
                {
                    self.legal("id", at, given, &format!("location_of({kind}, {index})"));
                }
                self.legal("removed", at, "a removed vertex", "location_of(0, REMOVED)");
                self.legal("value", at, "a kind that is none", "location_of(77, 0)");
            }
            Role::Options if self.function.name != "deldrift_options_init" => {
                let (size, code) = ("sizeof options", "999");
                let wrong = format!("bad_options(0, {code})");
                self.refused(
                    "zero",
                    at,
                    "a struct_size of 0",
                    &wrong,
                    "INVALID_OPTIONS",
                    "\"options.struct_size is 0\"",
                );
                let wrong = "bad_options(SIZE_MAX, 0)";
                let message = "\"options.struct_size is 18446744073709551615\"";
                self.refused("huge", at, "a struct_size of SIZE_MAX", wrong, "INVALID_OPTIONS", message);
                let wrong = format!("bad_options({size}, {code})");
                let message = "\"options.algorithm is 999\"";
                self.refused("value", at, "an algorithm that is none", &wrong, "INVALID_OPTIONS", message);
            }
            Role::ResearchOptions => self.research_options(at),
            Role::Quality => self.quality(at),
            Role::Mask if self.function.has("quality") => {
                let message = "\"no segment\"";
                self.refused("value", at, "one that ends between segments", "mask", "INVALID_VALUE", message);
                let none = [(at, "NULL".to_string()), (at + 1, "0".to_string())];
                self.add("null", "NULL, and 0", "OK", "", &none, "");
            }
            Role::Data => {
                self.legal("misaligned", at, "an odd address", "shifted(saved, saved_size)");
                for (given, place) in [("damaged at its start", "0"), ("damaged within", "saved_size / 2")] {
                    let wrong = format!("damaged({place})");
                    self.refused("value", at, given, &wrong, "INVALID_DATA", &format!("\"{name}: \""));
                }
            }
            Role::Path => {
                let missing = "\"/no such folder/file\"";
                let message = "\"\\\"/no such folder/file\\\": No such file or directory\"";
                self.refused("value", at, "in no folder", missing, "IO_ERROR", message);
                let is_read = self.function.name == "deldrift_load_file";
                let reason = if is_read { "it is a directory" } else { "Is a directory" };
                let message = format!("\"\\\"/\\\": {reason}\"");
                self.refused("value", at, "a folder", "\"/\"", "IO_ERROR", &message);
            }
            Role::Fields => self.fields(at, name),
            Role::Buffer if !parameter.c_type.starts_with("uint32_t") && is_of_bytes(parameter) => {
                self.legal("misaligned", at, "an odd address", "shifted(out.bytes, 1)");
            }
            _ => {}
        }
    }

    fn research_options(&mut self, at: usize) {
        for (column, given, wrong, said) in [
            ("zero", "a struct_size of 0", "0, 0", "options.struct_size is 0"),
            (
                "huge",
                "a struct_size of SIZE_MAX",
                "SIZE_MAX, 0",
                "options.struct_size is 18446744073709551615",
            ),
            ("nan", "NaN", "sizeof research, NAN", "options.switch_share is NaN"),
            ("infinite", "infinity", "sizeof research, INFINITY", "options.switch_share is inf"),
            ("value", "a share above 1", "sizeof research, 2", "options.switch_share is 2"),
        ] {
            let (wrong, message) = (format!("bad_research({wrong})"), format!("\"{said}\""));
            self.refused(column, at, given, &wrong, "INVALID_OPTIONS", &message);
        }
    }

    /// A member of a quality is another one; some are of use to one of the functions alone.
    fn quality(&mut self, at: usize) {
        let valid = self.row.arguments[at];
        for (column, given, change, status, said) in [
            ("zero", "a struct_size of 0", "struct_size = 0", "INVALID_OPTIONS", "struct_size is 0"),
            (
                "huge",
                "a struct_size of SIZE_MAX",
                "struct_size = SIZE_MAX",
                "INVALID_OPTIONS",
                "struct_size is 18446744073709551615",
            ),
            (
                "value",
                "a kind to keep that is none",
                "keeps = (deldrift_kept)999",
                "INVALID_OPTIONS",
                "keeps is 999",
            ),
            ("nan", "an angle", "least_angle = NAN", "INVALID_VALUE", "least_angle[0] is NaN"),
            ("infinite", "an angle", "least_angle = INFINITY", "INVALID_VALUE", "least_angle[0] is inf"),
            ("value", "an angle above 34", "least_angle = 34.5", "INVALID_VALUE", "least_angle[0] is 34.5"),
            ("nan", "an area", "greatest_area = NAN", "INVALID_VALUE", "greatest_area[0] is NaN"),
            ("infinite", "an area", "greatest_area = INFINITY", "OK", ""),
            ("value", "an area below 0", "greatest_area = -1", "INVALID_VALUE", "greatest_area[0] is -1"),
            ("nan", "a margin", "margin = NAN", "INVALID_VALUE", "margin[0] is NaN"),
            ("value", "a margin above 30", "margin = 31", "INVALID_VALUE", "margin[0] is 31"),
            ("nan", "a share", "share = NAN", "INVALID_VALUE", "share[0] is NaN"),
            ("zero", "a share of 0", "share = 0", "INVALID_VALUE", "share[0] is 0"),
            ("nan", "what is joined", "joins = NAN", "INVALID_VALUE", "joins[0] is NaN"),
            ("value", "what is joined, above 1", "joins = 2", "INVALID_VALUE", "joins[0] is 2"),
            ("nan", "a growth", "growth = NAN", "INVALID_VALUE", "growth[0] is NaN"),
            ("value", "a growth below 1", "growth = 0.5", "INVALID_VALUE", "growth[0] is 0.5"),
            ("infinite", "a growth", "growth = INFINITY", "OK", ""),
            ("zero", "a limit of 0", "limit = 0", "OK", ""),
            ("value", "circles, any number", "is_conforming = 999", "OK", ""),
            ("value", "ids given again, any number", "reuses_ids = 999", "OK", ""),
            ("huge", "labels, SIZE_MAX", "label_count = SIZE_MAX", "NULL_ARGUMENT", "labels is NULL"),
            ("null", "labels", "label_count = n_cells", "NULL_ARGUMENT", "labels is NULL"),
            ("null", "areas", "area_count = 2", "NULL_ARGUMENT", "areas is NULL"),
            ("null", "sizes", "size_count = n_ids", "NULL_ARGUMENT", "sizes is NULL"),
            (
                "misaligned",
                "labels",
                "labels = odd, bad_quality.label_count = n_cells",
                "MISALIGNED_ARGUMENT",
                "labels is 0x",
            ),
            (
                "misaligned",
                "areas",
                "areas = odd, bad_quality.area_count = 2",
                "MISALIGNED_ARGUMENT",
                "areas is 0x",
            ),
            (
                "misaligned",
                "sizes",
                "sizes = odd, bad_quality.size_count = n_ids",
                "MISALIGNED_ARGUMENT",
                "sizes is 0x",
            ),
            (
                "huge",
                "areas, SIZE_MAX",
                "areas = values, bad_quality.area_count = SIZE_MAX",
                "SIZE_OVERFLOW",
                "areas cannot have 18446744073709551615 entries",
            ),
            (
                "zero",
                "sizes, 0",
                "sizes = sizes, bad_quality.size_count = 0",
                "WRONG_COUNT",
                "size_count is 0, but must be",
            ),
            (
                "value",
                "sizes, one less",
                "sizes = sizes, bad_quality.size_count = n_ids - 1",
                "WRONG_COUNT",
                "size_count is",
            ),
            (
                "value",
                "labels, one less",
                "labels = wholes, bad_quality.label_count = 1",
                "WRONG_COUNT",
                "label_count is 1, but must be",
            ),
            (
                "nan",
                "the area of a label",
                "areas = bad(values, 1, NAN), bad_quality.area_count = 2",
                "INVALID_VALUE",
                "areas[1] is NaN",
            ),
            (
                "value",
                "the area of a label below 0",
                "areas = bad(values, 1, -1), bad_quality.area_count = 2",
                "INVALID_VALUE",
                "areas[1] is -1",
            ),
            (
                "nan",
                "a size",
                "sizes = bad_sizes(4, NAN), bad_quality.size_count = n_ids",
                "INVALID_VALUE",
                "sizes[4] is NaN",
            ),
            (
                "value",
                "a size of 0",
                "sizes = bad_sizes(4, 0), bad_quality.size_count = n_ids",
                "INVALID_VALUE",
                "sizes[4] is 0",
            ),
            (
                "removed",
                "the size of a removed vertex",
                "sizes = bad_sizes(REMOVED, NAN), bad_quality.size_count = n_ids",
                "OK",
                "",
            ),
        ] {
            let wrong = format!("(bad_quality = *({valid}), bad_quality.{change}, &bad_quality)");
            if status == "OK" {
                self.legal(column, at, given, &wrong);
            } else {
                self.refused(column, at, given, &wrong, status, &format!("\"quality.{said}\""));
            }
        }
    }

    /// The last coordinate of the last point.
    fn coordinates(&mut self, at: usize, name: &str, valid: &str, count: &str) {
        for (column, given, value, status, said) in [
            ("nan", "NaN", "NAN", "NOT_FINITE", "NaN"),
            ("infinite", "infinity", "INFINITY", "NOT_FINITE", "inf"),
            ("infinite", "-infinity", "-INFINITY", "NOT_FINITE", "-inf"),
            ("range", "2e57", "2e57", "OUT_OF_RANGE", "2e57"),
            ("range", "-2e57", "-2e57", "OUT_OF_RANGE", "-2e57"),
        ] {
            let wrong = format!("bad({valid}, {count} * dimension - 1, {value})");
            let message =
                format!("\"{name}[%u], coordinate %u, is {said}\", (unsigned)({count}) - 1, dimension - 1");
            self.refused(column, at, given, &wrong, status, &message);
        }
    }

    fn ids(&mut self, at: usize) {
        let removes = self.function.name == "deldrift_stage_removals";
        // Those that only read do not mind what is staged, nor what is listed twice.
        let reads = !self.function.changes_t();
        let twice = if removes { "STAGED_VERTEX" } else { "DUPLICATE_MOVE" };
        for (column, given, value, status, said) in [
            ("id", "the number of ids", "(uint32_t)n_ids", "NO_SUCH_VERTEX", "%u\", (unsigned)n_ids"),
            ("id", "UINT32_MAX", "UINT32_MAX", "NO_SUCH_VERTEX", "4294967295\""),
            ("removed", "a removed vertex", "REMOVED", "REMOVED_VERTEX", "5\""),
            ("removed", "one to be removed", "LEAVING", "STAGED_VERTEX", "6\""),
            ("removed", "one to be inserted", "COMING", "STAGED_VERTEX", "13\""),
            ("value", "one twice", "0", twice, "0\""),
        ] {
            let wrong = format!("bad_ids(1, {value})");
            let may_come = self.function.name == "deldrift_stage_weights" && value == "COMING";
            if reads && matches!(value, "LEAVING" | "0") || may_come {
                self.legal(column, at, given, &wrong);
                continue;
            }
            let message = format!("\"vertices[1] is {said}");
            self.refused(column, at, given, &wrong, status, &message);
        }
    }

    /// Ends of segments may be to be inserted, and even to be removed: that is a conflict of the commit.
    fn ends(&mut self, at: usize) {
        for (column, given, value, status, said) in [
            ("id", "the number of ids", "(uint32_t)n_ids", "NO_SUCH_VERTEX", "%u\", (unsigned)n_ids"),
            ("id", "UINT32_MAX", "UINT32_MAX", "NO_SUCH_VERTEX", "4294967295\""),
            ("removed", "a removed vertex", "REMOVED", "REMOVED_VERTEX", "5\""),
        ] {
            let message = format!("\"ends[5] is {said}");
            self.refused(column, at, given, &format!("bad_ends({value})"), status, &message);
        }
        self.legal("removed", at, "one to be removed", "bad_ends(LEAVING)");
        self.legal("removed", at, "one to be inserted", "bad_ends(COMING)");
        self.legal("value", at, "both ends at one vertex", "bad_ends(ends[4])");
    }

    fn segments(&mut self, at: usize) {
        for (column, given, value) in [
            ("id", "the number of ids", "N_SEGMENT_IDS"),
            ("id", "UINT32_MAX", "UINT32_MAX"),
            ("removed", "a removed segment", "REMOVED_SEGMENT"),
            ("removed", "one to be removed", "LEAVING_SEGMENT"),
            ("removed", "one to be laid", "COMING_SEGMENT"),
            ("value", "one twice", "segments[0]"),
        ] {
            let may_be = self.function.name == "deldrift_set_segment_sides"
                && ["one to be removed", "one to be laid", "one twice"].contains(&given);
            if may_be {
                self.legal(column, at, given, &format!("bad_segments({value})"));
                continue;
            }
            let message = format!("\"segments[1] is %u\", (unsigned){value}");
            self.refused(column, at, given, &format!("bad_segments({value})"), "NO_SUCH_SEGMENT", &message);
        }
    }

    fn fields(&mut self, at: usize, name: &str) {
        for (column, given, wrong, status, said) in [
            ("null", "a name that is NULL", "NULL, values, 1", "INVALID_FIELD", "name of {}[0]"),
            ("null", "values that are NULL", "\"f\", NULL, 1", "NULL_ARGUMENT", "values of {}[0] is NULL"),
            (
                "misaligned",
                "values at an odd address",
                "\"f\", odd, 1",
                "MISALIGNED_ARGUMENT",
                "values of {}[0] is 0x",
            ),
            (
                "zero",
                "0 components",
                "\"f\", values, 0",
                "INVALID_FIELD",
                "components of {}[0] must be at least 1",
            ),
            (
                "huge",
                "SIZE_MAX components",
                "\"f\", values, SIZE_MAX",
                "SIZE_OVERFLOW",
                "values of {}[0] cannot have",
            ),
            ("value", "a name that is not UTF-8", "\"\\xff\", values, 1", "INVALID_FIELD", "name of {}[0]"),
        ] {
            let message = format!("\"{}\"", said.replace("{}", name));
            self.refused(column, at, given, &format!("bad_field({wrong})"), status, &message);
        }
    }

    /// What may be wrong with what is no pointer.
    fn number(&mut self, at: usize, role: Role, parameter: &Parameter) {
        let name = parameter.name.as_str();
        match role {
            Role::Id | Role::AnyId => {
                for (column, given, value, status) in [
                    ("id", "the number of ids", "(uint32_t)n_ids", "NO_SUCH_VERTEX"),
                    ("id", "UINT32_MAX", "UINT32_MAX", "NO_SUCH_VERTEX"),
                    ("removed", "a removed vertex", "REMOVED", "REMOVED_VERTEX"),
                    ("removed", "one to be inserted", "COMING", "STAGED_VERTEX"),
                ] {
                    if role == Role::AnyId {
                        self.legal(column, at, given, value);
                    } else {
                        let message = format!("\"vertex[0] is %u\", (unsigned){value}");
                        self.refused(column, at, given, value, status, &message);
                    }
                }
            }
            Role::Dimension => {
                for value in ["0", "1", "4", "4294967295"] {
                    let message = format!("\"dimension is {value}, \"");
                    self.refused("dimension", at, value, value, "INVALID_DIMENSION", &message);
                }
            }
            Role::Cell | Role::Corner => {
                let first = if role == Role::Cell { "(uint32_t)n_cells" } else { "dimension + 1" };
                for (given, value) in [("the number of them", first), ("UINT32_MAX", "UINT32_MAX")] {
                    let message = format!("\"{name} is %u\", (unsigned)({value})");
                    self.refused("id", at, given, value, "NO_SUCH_FACET", &message);
                }
            }
            Role::Level => {
                for value in ["0", "4", "4294967295"] {
                    let message = format!("\"level is {value}, \"");
                    self.refused("value", at, value, value, "INVALID_LEVEL", &message);
                }
            }
            Role::Algorithm => {
                self.refused("value", at, "999", "999", "INVALID_OPTIONS", "\"algorithm is 999\"")
            }
            Role::Method => {
                self.refused("value", at, "2", "2", "INVALID_VALUE", &format!("\"{name}[0] is 2\""))
            }
            Role::Status => self.legal("value", at, "UINT32_MAX", "(deldrift_status)UINT32_MAX"),
            Role::Magnitude => {
                for (column, given, said) in [("nan", "NAN", "NaN"), ("value", "-1", "-1")] {
                    let message = format!("\"{name}[0] is {said}\"");
                    self.refused(column, at, said, given, "INVALID_VALUE", &message);
                }
                self.legal("infinite", at, "infinity", "INFINITY");
                self.legal("zero", at, "0", "0");
            }
            Role::VertexWeight => {
                for (column, given, said, status) in [
                    ("nan", "NAN", "NaN", "NOT_FINITE"),
                    ("infinite", "INFINITY", "inf", "NOT_FINITE"),
                    ("range", "1.01e114", "1.01e114", "OUT_OF_RANGE"),
                ] {
                    self.refused(column, at, said, given, status, &format!("\"{name}[0] is {said}\""));
                }
                self.legal("range", at, "-1e114", "-1e114");
                self.legal("zero", at, "0", "0");
            }
            Role::Whole => self.legal("value", at, "the least number", "INT32_MIN"),
            Role::Key => {
                self.legal("zero", at, "0", "0");
                self.legal("value", at, "UINT64_MAX", "UINT64_MAX");
            }
            Role::Limit => {
                self.legal("zero", at, "0", "0");
                self.legal("value", at, "SIZE_MAX", "SIZE_MAX");
            }
            Role::Corners => {
                for (given, value) in
                    [("0", "0"), ("two more than dimensions", "dimension + 2"), ("UINT32_MAX", "UINT32_MAX")]
                {
                    let message = format!("\"{name}[0] is %u\", (unsigned)({value})");
                    self.refused("value", at, given, value, "INVALID_VALUE", &message);
                }
            }
            Role::Count | Role::FixedCount | Role::CountOfEach | Role::Size => self.count(at, role, name),
            Role::Capacity => self.capacity(at),
            Role::VectorCount => {
                let is_creation = self.function.name.starts_with("deldrift_create");
                let (status, wrong) = match is_creation {
                    true => ("DEPENDENT_VECTORS", [("zero", "0"), ("value", "4"), ("huge", "SIZE_MAX")]),
                    false => ("WRONG_COUNT", [("value", "1"), ("value", "4"), ("huge", "SIZE_MAX")]),
                };
                for (column, value) in wrong {
                    self.refused(column, at, value, value, status, "\"vector\"");
                }
            }
            _ => unreachable!("{name} is a pointer"),
        }
    }

    fn count(&mut self, at: usize, role: Role, name: &str) {
        match role {
            Role::FixedCount => {
                // One that is too large for any array is found before it is compared.
                let is_points = self.function.name == "deldrift_commit_positions";
                let valid = self.row.arguments[at];
                for (column, given, value) in [
                    ("zero", "0", "0".to_string()),
                    ("value", "one less", format!("{valid} - 1")),
                    ("value", "one more", format!("{valid} + 1")),
                ] {
                    let message =
                        format!("\"{name} is %zu, but must be %zu\", (size_t)({value}), (size_t)({valid})");
                    self.refused(column, at, given, &value, "WRONG_COUNT", &message);
                }
                let (status, message) = match is_points {
                    true => (
                        "SIZE_OVERFLOW",
                        "\"positions cannot have 18446744073709551615 entries\"".to_string(),
                    ),
                    false => ("WRONG_COUNT", format!("\"{name} is 18446744073709551615, \"")),
                };
                self.refused("huge", at, "SIZE_MAX", "SIZE_MAX", status, &message);
            }
            Role::Size => {
                self.refused("zero", at, "0", "0", "INVALID_DATA", "\"data: \"");
                self.refused("value", at, "one less", "saved_size - 1", "INVALID_DATA", "\"data: \"");
                let message = "\"data cannot have 18446744073709551615 entries\"";
                self.refused("huge", at, "SIZE_MAX", "SIZE_MAX", "SIZE_OVERFLOW", message);
            }
            _ => {
                self.legal("zero", at, "0", "0");
                if role == Role::Count && self.function.name != "deldrift_interpolate" {
                    // The array before it, and others of as many entries, may be NULL then.
                    let pointer = (0..at).rev().find(|&k| self.function.parameters[k].c_type.ends_with('*'));
                    let none = vec![(at, "0".to_string()), (pointer.expect("an array"), "NULL".to_string())];
                    self.add("zero", "0, and NULL", "OK", "", &none, "");
                    let odd = vec![(at, "0".to_string()), (pointer.expect("an array"), "odd".to_string())];
                    self.add("zero", "0, and an odd address", "OK", "", &odd, "");
                }
                let is_creation = self.function.name.starts_with("deldrift_create");
                let status = if is_creation { "TOO_MANY_VERTICES" } else { "SIZE_OVERFLOW" };
                let message = "\"18446744073709551615\"";
                self.refused("huge", at, "SIZE_MAX", "SIZE_MAX", status, message);
                if !is_creation {
                    let message = match role {
                        // Numbers of each entry count in its size.
                        Role::CountOfEach if name == "k" => "\"vertices cannot have \"",
                        Role::CountOfEach => "\"values cannot have \"",
                        _ => "\"4611686018427387903\"",
                    };
                    self.refused("huge", at, "SIZE_MAX / 4", "SIZE_MAX / 4", status, message);
                }
            }
        }
    }

    fn capacity(&mut self, at: usize) {
        for (column, given, value) in [("zero", "0", "0"), ("value", "1", "1")] {
            // There is one hidden vertex, and nothing is in the way of a segment, or passes one.
            let is_enough = match self.function.name.as_str() {
                "deldrift_hidden_vertices" => value == "1",
                name => TELL_NOTHING.contains(&name),
            };
            if is_enough {
                self.legal(column, at, given, value);
                continue;
            }
            let message = format!("\"{} is {value}, but \"", self.function.parameters[at].name);
            self.refused(column, at, given, value, "BUFFER_TOO_SMALL", &message);
        }
        self.legal("huge", at, "SIZE_MAX", "SIZE_MAX");
        let roles = self.roles();
        // Where there are several capacities, each one's buffers are before it.
        let is_one = roles.iter().filter(|&&role| role == Role::Capacity).count() == 1;
        let first = (0..at).rfind(|&k| roles[k] == Role::Capacity).map_or(0, |before| before + 1);
        let own = if is_one { 0..roles.len() } else { first..at };
        let buffers = own.filter(|&k| roles[k] == Role::Buffer);
        let nowhere: Vec<(usize, String)> = buffers.map(|k| (k, "NULL".to_string())).collect();
        let mut without = vec![(at, "0".to_string())];
        without.extend(nowhere.iter().cloned());
        let mut named = nowhere.iter().map(|&(k, _)| self.function.parameters[k].name.clone());
        let named = named.find(|name| name != "offsets").expect("a buffer");
        let message = format!("\"{named} is NULL\"");
        // Without a count to be told, arrays are there to be updated.
        let status = if self.function.tells_count() { "OK" } else { "NULL_ARGUMENT" };
        self.add("zero", "0, and NULL", status, &message, &without, "");
        // All of them are NULL, and there is a capacity.
        self.add("null", "NULL for all buffers", "NULL_ARGUMENT", &message, &nowhere, "");
    }

    /// Arrays at the same place, of which one is written at least: what they hold then is anybody's guess.
    fn overlaps(&mut self) {
        let roles = self.roles();
        let is_array = |k: usize| {
            let role = roles[k];
            let is_read = matches!(role, Role::Points | Role::BoxCorner | Role::OpenBoxCorner)
                || matches!(role, Role::Numbers | Role::NumbersIfAny);
            let is_list = matches!(role, Role::Ends | Role::SegmentIds | Role::Wholes | Role::WholesIfAny);
            is_read
                || is_list
                || matches!(role, Role::Mask | Role::MaskIfAny | Role::Hint | Role::Buffer | Role::Output)
        };
        let element = |k: usize| {
            let c_type = self.function.parameters[k].c_type.as_str();
            c_type.trim_start_matches("const ").trim_end_matches(['*', ' ']).to_string()
        };
        let mut found = Vec::new();
        for written in (0..roles.len()).filter(|&k| matches!(roles[k], Role::Buffer | Role::Output)) {
            for other in (0..roles.len()).filter(|&k| k != written && is_array(k)) {
                let is_twice = other > written && matches!(roles[other], Role::Buffer | Role::Output);
                if element(written) == element(other) && !is_twice {
                    found.push((written, other));
                }
            }
        }
        for (written, other) in found {
            let given = format!("that of {}", self.function.parameters[other].name);
            self.legal("overlap", written, &given, self.row.arguments[other]);
        }
    }
}

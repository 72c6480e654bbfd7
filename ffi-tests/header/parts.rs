//! The headers that are made, and of which files of src/capi.

use deldrift::motion::Purpose;

/// A header that is made.
pub struct Header {
    pub path: &'static str,
    pub configuration: &'static str,
    /// What it has, for the first lines of the header and for the index of deldrift.h. The header for comparisons is not
    /// a part of deldrift.h, and has a first page of its own in its configuration.
    pub subject: Option<&'static str>,
    /// Another part, of which it uses types.
    pub also: Option<&'static str>,
    /// Files of src/capi, in the order in which the header shows them.
    pub sources: &'static [&'static str],
    /// The enumeration of algorithms, where the header has it.
    pub algorithms: Option<Algorithms>,
}

/// The enumeration of the algorithms that are there for one purpose.
pub struct Algorithms {
    pub name: &'static str,
    pub purpose: Purpose,
    /// The file of src/capi that says what the enumeration is, and the type of its numbers.
    pub documented_at: (&'static str, &'static str),
}

/// The header that includes all parts.
pub const MAIN: &str = "include/deldrift.h";

/// The first part, which all others include.
pub const CORE: &str = "core.h";

/// The headers with functions, in the order of deldrift.h; the one for comparisons is the last.
pub const HEADERS: [Header; 10] = [
    Header {
        algorithms: Some(Algorithms {
            name: "deldrift_algorithm",
            purpose: Purpose::Use,
            documented_at: ("options", "AlgorithmCode"),
        }),
        ..part(
            "include/deldrift/core.h",
            "What every program needs: statuses, options, creation, positions and cells.",
            &["status", "options", "handle", "triangulation", "state", "query"],
        )
    },
    part(
        "include/deldrift/motion.h",
        "Vertices that move, come and go: staging, commits, keys, the list of changes.",
        &["motion", "preparing", "immediate", "keys", "changes", "transferring"],
    ),
    part(
        "include/deldrift/read.h",
        "What is where, and what is near: location, neighbours, values between vertices.",
        &["location", "near", "reach", "incidence", "interpolation"],
    ),
    part(
        "include/deldrift/geometry.h",
        "Circumspheres, volumes, masks and boundaries of cells; exact signs.",
        &["geometry", "listed", "predicates"],
    ),
    part("include/deldrift/voronoi.h", "Voronoi cells and facets, in a box or a container.", &["voronoi"]),
    part(
        "include/deldrift/segments.h",
        "Segments in the plane, the domains that they bound, and the refinement of these.",
        &["segments", "splitting", "domain", "regions", "refining"],
    ),
    part("include/deldrift/periodic.h", "Periodic boxes.", &["periodic"]),
    Header {
        also: Some("motion.h"),
        ..part("include/deldrift/weights.h", "Vertices with weights: regular triangulations.", &["weights"])
    },
    part("include/deldrift/files.h", "Copies, saved data, and files for other programs.", &["saving"]),
    Header {
        path: "include/deldrift/research.h",
        configuration: "ffi-tests/header/research.toml",
        subject: None,
        also: None,
        sources: &["research"],
        algorithms: Some(Algorithms {
            name: "deldrift_research_algorithm",
            purpose: Purpose::Comparison,
            documented_at: ("research", "ResearchAlgorithmCode"),
        }),
    },
];

const fn part(path: &'static str, subject: &'static str, sources: &'static [&'static str]) -> Header {
    let configuration = "cbindgen.toml";
    Header { path, configuration, subject: Some(subject), also: None, sources, algorithms: None }
}

/// The headers that declare functions, in the order of deldrift.h.
pub fn paths() -> impl Iterator<Item = &'static str> {
    HEADERS.iter().map(|header| header.path)
}

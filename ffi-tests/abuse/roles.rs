//! What a parameter is for, which follows from its type and its name.

use super::declarations::{Declaration, Parameter};

/// What a parameter is to its function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Role {
    /// The triangulation.
    Handle,
    /// Coordinates of points: of so many as the argument `count` says, of one, of those of a simplex, of one more.
    Points,
    PointsOfSimplex,
    PointsOfSphere,
    /// Vectors of a box; how many they are.
    Vectors,
    VectorCount,
    /// Rows of a normal and an offset.
    HalfSpaces,
    /// A corner of a box: both are given, or none; and one that must be given, and may be anywhere.
    BoxCorner,
    OpenBoxCorner,
    /// What owns arrays that have been handed over.
    Owner,
    /// Numbers of any value.
    Numbers,
    /// Numbers of any value, or none.
    NumbersIfAny,
    Ids,
    /// Ids of vertices that are ends of segments, and ids of segments.
    Ends,
    SegmentIds,
    /// Whole numbers of any value; an array of them, and one that may be left out.
    Whole,
    Wholes,
    WholesIfAny,
    /// Keys of vertices, which may be left out, and one of any value.
    KeysIfAny,
    Key,
    /// Indices of cells, and of cells if there are any.
    CellIds,
    CellIdsIfAny,
    /// A mask, and one that may be left out.
    Mask,
    MaskIfAny,
    Hint,
    Options,
    ResearchOptions,
    Quality,
    Data,
    Path,
    Fields,
    /// The id of a vertex, and one that may be any number.
    Id,
    AnyId,
    Dimension,
    /// A cell and a corner of it.
    Cell,
    Corner,
    Level,
    Algorithm,
    Method,
    Status,
    /// A number that is not negative, and may be infinite; an array of them.
    Magnitude,
    Magnitudes,
    /// Numbers of a magnitude up to 1e114, of any points.
    Weights,
    /// Weights of vertices; such as may be left out; one.
    VertexWeights,
    VertexWeightsIfAny,
    VertexWeight,
    /// Coordinates of points, which may be left out.
    PointsIfAny,
    /// A number for each cell, one for each region.
    LabelsOfRegions,
    /// How much may be made at most: any number.
    Limit,
    /// How many corners each of several simplices has.
    Corners,
    /// How many entries an array has that is read.
    Count,
    /// That is not for the caller to choose.
    FixedCount,
    /// How many numbers each entry has.
    CountOfEach,
    /// How many bytes are read.
    Size,
    /// How many entries a buffer has.
    Capacity,
    /// A place for one result, one for a result that nobody has to want, an array for results.
    Output,
    OutputIfAny,
    Buffer,
}

/// From its type and its name.
pub fn role(function: &Declaration, parameter: &Parameter) -> Role {
    let is_commit = function.name.starts_with("deldrift_commit")
        || function.name == "deldrift_prepare_timestamp"
        || function.has("quality");
    match (parameter.c_type.as_str(), parameter.name.as_str()) {
        ("deldrift_triangulation *" | "const deldrift_triangulation *", "t") => Role::Handle,
        ("deldrift_released_cells *", "owner") => Role::Owner,
        // Where no cell is gone none is read.
        ("const double *", "positions") if function.name == "deldrift_transfer_cells" => Role::NumbersIfAny,
        ("const double *", "positions") if function.name == "deldrift_commit_weighted" => Role::PointsIfAny,
        ("const double *", "position" | "positions" | "centre") => Role::Points,
        ("const double *", "seeds") => Role::Points,
        ("const double *", "points") if function.name.ends_with("_sphere") => Role::PointsOfSphere,
        ("const double *", "weights") if function.name == "deldrift_in_power_sphere" => Role::Weights,
        ("const double *", "weights") if function.name == "deldrift_stage_weights" => Role::VertexWeights,
        ("const double *", "weights") => Role::VertexWeightsIfAny,
        ("double", "weight") => Role::VertexWeight,
        ("const double *", "points") => Role::PointsOfSimplex,
        ("const double *", "vectors") => Role::Vectors,
        ("const double *", "half_spaces") => Role::HalfSpaces,
        ("size_t", "vector_count") => Role::VectorCount,
        ("const double *", "low" | "high") if function.name == "deldrift_vertices_in_box" => {
            Role::OpenBoxCorner
        }
        ("const double *", "low" | "high") if function.has("box_count") => Role::OpenBoxCorner,
        ("const double *", "low" | "high") => Role::BoxCorner,
        ("const double *", "values") => Role::Numbers,
        ("const double *", "squared_radii") => Role::Magnitudes,
        ("const double *", "outside" | "previous") => Role::NumbersIfAny,
        ("const uint32_t *", "vertices") => Role::Ids,
        ("const uint32_t *", "ends") => Role::Ends,
        ("const uint32_t *", "segments") => Role::SegmentIds,
        ("const int32_t *", "labels") if function.name == "deldrift_set_regions" => Role::LabelsOfRegions,
        ("const int32_t *", "labels" | "references" | "sides") => Role::Wholes,
        ("const int32_t *", "markers") => Role::WholesIfAny,
        ("int32_t", "other") => Role::Whole,
        ("const uint64_t *", "keys") => Role::KeysIfAny,
        ("uint64_t", "key") => Role::Key,
        ("const uint32_t *", "cells") if function.name == "deldrift_barycentric" => Role::CellIdsIfAny,
        ("const uint32_t *", "cells") => Role::CellIds,
        ("const uint8_t *", "mask") if function.has("box_count") || function.has("radius_count") => {
            Role::MaskIfAny
        }
        ("const uint8_t *", "mask") => Role::Mask,
        ("const deldrift_location *", "hint") => Role::Hint,
        ("const deldrift_options *" | "deldrift_options *", "options") => Role::Options,
        ("const deldrift_research_options *", "options") => Role::ResearchOptions,
        ("const deldrift_quality *", _) => Role::Quality,
        ("const void *", "data") => Role::Data,
        ("const char *", "path") => Role::Path,
        ("const deldrift_field *", _) => Role::Fields,
        ("uint32_t", "vertex") if function.name == "deldrift_is_present" => Role::AnyId,
        ("uint32_t", "vertex") => Role::Id,
        ("uint32_t", "dimension") => Role::Dimension,
        ("uint32_t", "cell") => Role::Cell,
        ("uint32_t", "corner") => Role::Corner,
        ("uint32_t", "level") => Role::Level,
        ("deldrift_algorithm" | "deldrift_research_algorithm", _) => Role::Algorithm,
        ("deldrift_interpolation" | "deldrift_pairs" | "deldrift_transfer_order", _) => Role::Method,
        ("deldrift_status", _) => Role::Status,
        ("uint32_t", "corners_per_simplex") => Role::Corners,
        ("double", "squared_radius" | "tolerance") => Role::Magnitude,
        ("size_t", "count")
            if function.name == "deldrift_commit_positions"
                || function.name == "deldrift_commit_weighted" =>
        {
            Role::FixedCount
        }
        (
            "size_t",
            "count" | "vertex_count" | "cell_count" | "seed_count" | "box_count" | "half_space_count"
            | "position_count",
        ) => Role::Count,
        ("size_t", "vertex_field_count" | "cell_field_count") => Role::Count,
        (
            "size_t",
            "value_count" | "label_count" | "radius_count" | "mask_count" | "offset_count"
            | "reference_count",
        ) => Role::FixedCount,
        ("size_t", "n_values" | "k") => Role::CountOfEach,
        ("size_t", "size") => Role::Size,
        ("size_t", "capacity" | "edge_capacity") => Role::Capacity,
        ("size_t", "limit") => Role::Limit,
        ("deldrift_transfer_report *", _) | ("double *", "lost" | "gained") => Role::OutputIfAny,
        ("deldrift_split_report *", "report") => Role::OutputIfAny,
        ("size_t *", "undecided") if function.name == "deldrift_regions" => Role::OutputIfAny,
        ("size_t *", "undecided") => Role::Output,
        (c_type, "report") if is_commit && c_type.ends_with('*') => Role::OutputIfAny,
        (c_type, name) if c_type.ends_with('*') && !c_type.starts_with("const") => {
            let is_buffer = function.has("capacity") && name != "count" && name != "edge_count";
            if is_buffer { Role::Buffer } else { Role::Output }
        }
        (c_type, name) => panic!("{}: what can be wrong with {c_type} {name}?", function.name),
    }
}

/// Whether every address is aligned for what a pointer leads to.
pub fn is_of_bytes(parameter: &Parameter) -> bool {
    ["uint8_t *", "void *", "char *", "bool *"].iter().any(|bytes| parameter.c_type.ends_with(bytes))
}

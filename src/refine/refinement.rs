//! What refinement knows: the mesh as it is so far, and what waits.

use super::criteria::Tests;
use super::mesh::Mesh;
use super::parts::NONE;
use super::queue::Queues;
use super::removal::Hole;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use std::cell::Cell;

/// Which segments stay whole.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kept {
    /// None.
    #[default]
    None,
    /// Those with cells that are to be refined on one side only.
    Outer,
    /// All.
    All,
}

/// Where segments come from.
#[derive(Debug, Default)]
pub(crate) struct Origins {
    /// Ends of each original segment.
    pub ends: Vec<[VertexId; 2]>,
    /// How long what is in force of each is.
    pub lengths: Vec<f64>,
    /// The original of each segment.
    pub of_segments: Vec<u32>,
    /// Vertices that earlier calls have added, with the original that they are on.
    pub of_vertices: Vec<(VertexId, u32)>,
}

pub(super) struct Refinement<'a> {
    pub(super) mesh: Mesh<'a>,
    pub(super) tests: Tests<'a>,
    pub(super) origins: Origins,
    pub(super) kept: Kept,
    pub(super) queues: Queues,
    /// Pieces to be split.
    pub(super) encroached: Vec<Wanted>,
    /// The original that each vertex is on, [`NONE`] if there is none.
    pub(super) on: Vec<u32>,
    /// The greatest length of edges at each vertex, if that is given.
    pub(super) sizes: Vec<f64>,
    pub(super) n_given: usize,
    pub(super) n_added: usize,
    /// Pieces that have been split, and vertices that have been taken out of circles.
    pub(super) n_split: usize,
    pub(super) n_cleared: usize,
    /// Whether something that is wanted has been left, as there was no room for it.
    pub(super) has_left: bool,
    /// Whether something has been left since it is in a narrow gap, which may not be one after pieces have been split, as
    /// rounding bends them.
    pub(super) has_gaps: Cell<bool>,
    pub(super) hole: Hole,
    /// Pieces in the way of a vertex, each with where it is in the way.
    pub(super) in_the_way: Vec<(u32, [f64; 2])>,
    /// Whether flat triangles have been seen.
    pub(super) has_flat: bool,
    /// Where vertices touch a piece.
    pub(super) touching: Vec<f64>,
}

/// A piece that is to be split.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wanted {
    pub(super) piece: u32,
    /// Its ends when it was entered.
    pub(super) ends: [VertexId; 2],
    /// What it is to be split for, if that is not only the corner opposite it.
    pub(super) cause: Option<[f64; 2]>,
}

impl<'a> Refinement<'a> {
    pub(super) fn new(mesh: Mesh<'a>, tests: Tests<'a>, origins: Origins, kept: Kept) -> Result<Self> {
        let mut on = Vec::new();
        let n_given = mesh.points.len();
        memory::lengthen(&mut on, n_given, NONE)?;
        origins.of_vertices.iter().for_each(|&(v, original)| on[v] = original);
        let sizes = memory::copy_of(tests.given_sizes())?;
        Ok(Refinement {
            mesh,
            tests,
            origins,
            kept,
            queues: Queues::new()?,
            encroached: Vec::new(),
            on,
            sizes,
            n_given,
            n_added: 0,
            n_split: 0,
            n_cleared: 0,
            has_left: false,
            has_gaps: Cell::new(false),
            hole: Hole::default(),
            in_the_way: Vec::new(),
            has_flat: false,
            touching: Vec::new(),
        })
    }
}

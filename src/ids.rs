//! Numbers that name something, each kind of a type of its own, so that none is taken for another.
//!
//! The kernel knows *sites* and *slots*, programs know *vertices* and *cells*; `motion` translates.

#![allow(unsafe_code)]

use std::fmt::{self, Debug};
use std::hash::Hash;
use std::ops::{Index, IndexMut, Range};

/// Any of the types, for what is written once for all of them.
pub(crate) trait Id: Copy + Debug + Eq + Hash + Ord + Send + Sync + 'static {
    /// The one of a number.
    fn new(number: u32) -> Self;

    /// Its number.
    fn get(self) -> u32;

    /// Its position in an array.
    #[inline(always)]
    fn index(self) -> usize {
        self.get() as usize
    }
}

macro_rules! ids {
    ($($(#[$documentation:meta])* $name:ident;)+) => { $(
        $(#[$documentation])*
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(transparent)]
        pub struct $name(u32);

        impl $name {
            /// None of them.
            pub const NONE: Self = $name(u32::MAX);

            /// The one of a number.
            #[inline(always)]
            pub const fn new(number: u32) -> Self {
                $name(number)
            }

            /// The one at a position in an array.
            #[inline(always)]
            pub const fn at(index: usize) -> Self {
                debug_assert!(index <= u32::MAX as usize);
                $name(index as u32)
            }

            /// Its number.
            #[inline(always)]
            pub const fn get(self) -> u32 {
                self.0
            }

            /// Its position in an array.
            #[inline(always)]
            pub const fn index(self) -> usize {
                self.0 as usize
            }

            /// The ids at a range of positions.
            #[inline(always)]
            pub fn range(
                positions: Range<usize>,
            ) -> impl DoubleEndedIterator<Item = Self> + ExactSizeIterator + Clone + Send + Sync {
                (positions.start as u32..positions.end as u32).map(Self)
            }

            /// The ids of some numbers, in the same memory.
            #[inline(always)]
            pub const fn of_numbers(numbers: &[u32]) -> &[Self] {
                // SAFETY: the type is transparent: a number and nothing else.
                unsafe { std::slice::from_raw_parts(numbers.as_ptr().cast(), numbers.len()) }
            }

            /// The numbers of some, in the same memory.
            #[inline(always)]
            pub const fn numbers_of(ids: &[Self]) -> &[u32] {
                // SAFETY: the type is transparent: a number and nothing else.
                unsafe { std::slice::from_raw_parts(ids.as_ptr().cast(), ids.len()) }
            }

            /// The numbers of some, in the same memory, to be changed.
            #[inline(always)]
            pub const fn numbers_of_mut(ids: &mut [Self]) -> &mut [u32] {
                // SAFETY: the type is transparent: a number and nothing else; any number is one of it.
                unsafe { std::slice::from_raw_parts_mut(ids.as_mut_ptr().cast(), ids.len()) }
            }
        }

        impl Id for $name {
            #[inline(always)]
            fn new(number: u32) -> Self {
                $name(number)
            }

            #[inline(always)]
            fn get(self) -> u32 {
                self.0
            }
        }

        impl Debug for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                Debug::fmt(&self.0, f)
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                fmt::Display::fmt(&self.0, f)
            }
        }

        impl<T> Index<$name> for [T] {
            type Output = T;

            #[inline(always)]
            #[track_caller]
            fn index(&self, id: $name) -> &T {
                &self[id.0 as usize]
            }
        }

        impl<T> IndexMut<$name> for [T] {
            #[inline(always)]
            #[track_caller]
            fn index_mut(&mut self, id: $name) -> &mut T {
                &mut self[id.0 as usize]
            }
        }

        impl<T> Index<$name> for Vec<T> {
            type Output = T;

            #[inline(always)]
            #[track_caller]
            fn index(&self, id: $name) -> &T {
                &self[id.0 as usize]
            }
        }

        impl<T> IndexMut<$name> for Vec<T> {
            #[inline(always)]
            #[track_caller]
            fn index_mut(&mut self, id: $name) -> &mut T {
                &mut self[id.0 as usize]
            }
        }
    )+ };
}

ids! {
    /// A vertex, as programs know it. The numbers begin with 0; ties between signs are broken by them.
    VertexId;
    /// A finite cell, as programs know it: its index in the arrays of [`CellsView`](crate::motion::CellsView).
    CellId;
    /// A segment, as programs know it. The numbers begin with 0.
    SegmentId;
    /// A site: a place of vertices, by its index in the kernel. Site 0 stands for the ghost vertex.
    SiteId;
    /// A place for a cell in the kernel.
    Slot;
}

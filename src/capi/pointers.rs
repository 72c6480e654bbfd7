//! Pointers from C, taken at their word: what a call is given, as values of these types, which are used safely.
//!
//! A value is made of a pointer, by [`given!`](given) at the head of a function, with the promise that the pointer is
//! NULL, or misaligned, or points to as much as the header says, for as long as the call lasts. What can be checked is
//! checked when the value is used.

use std::ffi::{CStr, c_char};
use std::marker::PhantomData;
use std::mem::MaybeUninit;
use std::ops::Deref;
use std::{ptr, slice};

use super::status::{Failure, Wrong};
use crate::delaunay::Moving;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::motion::MovingTriangulation;
use crate::periodic::PeriodicTriangulation;
use crate::predicates::PointArray;

/// Takes pointers that a C function has been given at their word, each under its own name: `given!(x: Input)` makes an
/// [`Input`] of the pointer `x`, `given!(x[n]: Array)` an [`Array`] of `x` and the count `n`.
///
/// There is no `unsafe` block in it: it compiles only in functions that are unsafe to call, and their caller's promise,
/// the header's conditions on pointers, is the one that is needed here.
macro_rules! given {
    ($($name:ident $([$count:expr])? : $kind:ident),+ $(,)?) => { $(
        #[allow(unsafe_op_in_unsafe_fn)]
        let $name = $kind::new(stringify!($name), $name $(, $count)?);
    )+ };
}
pub(super) use given;

/// A value that is read.
#[derive(Clone, Copy)]
pub(super) struct Input<'a, T> {
    argument: &'static str,
    pointer: *const T,
    lives: PhantomData<&'a T>,
}

impl<'a, T> Input<'a, T> {
    /// # Safety
    /// `pointer` is NULL, misaligned, or to a `T`.
    #[inline(always)]
    pub(super) unsafe fn new(argument: &'static str, pointer: *const T) -> Self {
        Input { argument, pointer, lives: PhantomData }
    }

    /// The value, which must be there.
    #[inline(always)]
    pub(super) fn get(self) -> Result<&'a T, Failure> {
        check(self.argument, self.pointer)?;
        // SAFETY: neither NULL nor misaligned; the rest was promised to `new`.
        Ok(unsafe { &*self.pointer })
    }

    /// The value, unless it is NULL.
    #[inline(always)]
    pub(super) fn if_any(self) -> Result<Option<&'a T>, Failure> {
        (!self.pointer.is_null()).then(|| self.get()).transpose()
    }
}

/// A place for a result, which may be uninitialised.
pub(super) struct Output<'a, T> {
    argument: &'static str,
    pointer: *mut T,
    lives: PhantomData<&'a mut T>,
}

impl<'a, T> Output<'a, T> {
    /// # Safety
    /// `pointer` is NULL, misaligned, or to a place for a `T` that nothing else uses.
    #[inline(always)]
    pub(super) unsafe fn new(argument: &'static str, pointer: *mut T) -> Self {
        Output { argument, pointer, lives: PhantomData }
    }

    /// The place, which must be there.
    #[inline(always)]
    pub(super) fn place(self) -> Result<&'a mut MaybeUninit<T>, Failure> {
        check(self.argument, self.pointer)?;
        // SAFETY: neither NULL nor misaligned; the rest was promised to `new`, and the type allows what is
        // uninitialised.
        Ok(unsafe { &mut *self.pointer.cast() })
    }

    /// The place, unless it is NULL.
    #[inline(always)]
    pub(super) fn if_any(self) -> Result<Option<&'a mut MaybeUninit<T>>, Failure> {
        (!self.pointer.is_null()).then(|| self.place()).transpose()
    }
}

/// What a call has handed out for another one to free.
pub(super) struct Owned<T> {
    pointer: *mut T,
}

impl<T> Owned<T> {
    /// # Safety
    /// `pointer` is NULL, or from [`Box::into_raw`], and nothing uses it after this.
    pub(super) unsafe fn new(_argument: &'static str, pointer: *mut T) -> Self {
        Owned { pointer }
    }

    /// Frees it, unless it is NULL, or misaligned and so nothing that has been handed out.
    pub(super) fn free(self) {
        if !self.pointer.is_null() && self.pointer.is_aligned() {
            // SAFETY: promised to `new`.
            drop(unsafe { Box::from_raw(self.pointer) });
        }
    }
}

/// Values that are read, as many as their count.
#[derive(Clone, Copy)]
pub(super) struct Array<'a, T> {
    argument: &'static str,
    pointer: *const T,
    count: usize,
    lives: PhantomData<&'a [T]>,
}

impl<'a, T> Array<'a, T> {
    /// # Safety
    /// `pointer` is NULL, misaligned, or to `count` values.
    #[inline(always)]
    pub(super) unsafe fn new(argument: &'static str, pointer: *const T, count: usize) -> Self {
        Array { argument, pointer, count, lives: PhantomData }
    }

    pub(super) fn is_null(&self) -> bool {
        self.pointer.is_null()
    }

    /// The values; none if they are not given.
    #[inline(always)]
    pub(super) fn if_any(self) -> Result<Option<&'a [T]>, Failure> {
        if self.is_null() { Ok(None) } else { self.get().map(Some) }
    }

    /// The values, which must be there unless their count is 0.
    #[inline(always)]
    pub(super) fn get(self) -> Result<&'a [T], Failure> {
        if self.count == 0 {
            return Ok(&[]);
        }
        check(self.argument, self.pointer)?;
        check_size::<T>(self.argument, self.count)?;
        // SAFETY: neither NULL, misaligned nor larger than an object may be; the rest was promised to `new`.
        Ok(unsafe { slice::from_raw_parts(self.pointer, self.count) })
    }
}

/// A string that ends in a NUL.
#[derive(Clone, Copy)]
pub(super) struct Text<'a>(Input<'a, c_char>);

impl<'a> Text<'a> {
    /// # Safety
    /// `pointer` is NULL, or to characters of which one is a NUL.
    pub(super) unsafe fn new(argument: &'static str, pointer: *const c_char) -> Self {
        // SAFETY: the caller's promise.
        Text(unsafe { Input::new(argument, pointer) })
    }

    /// The string, which must be there.
    pub(super) fn get(self) -> Result<&'a CStr, Failure> {
        let first = self.0.get()?;
        // SAFETY: there is a NUL at its end, as was promised to `new`.
        Ok(unsafe { CStr::from_ptr(first) })
    }
}

/// What has points of some dimension, which C gives as rows of coordinates alone.
pub(super) trait OfPoints {
    type Point: PointArray + Copy;
}

impl<G: Moving> OfPoints for MovingTriangulation<G> {
    type Point = G::Point;
}

impl<G: Moving> OfPoints for PeriodicTriangulation<G> {
    type Point = G::Point;
}

/// A point that is read: as many numbers as the triangulation of the call has dimensions. It is told its name when it
/// is used: calls that take one are short, and a name that is kept would be carried through all of them.
#[derive(Clone, Copy)]
pub(super) struct Point<'a> {
    pointer: *const f64,
    lives: PhantomData<&'a [f64]>,
}

impl<'a> Point<'a> {
    /// # Safety
    /// `pointer` is NULL, misaligned, or to a point in the dimension of the triangulation of the call.
    #[inline(always)]
    pub(super) unsafe fn new(_argument: &'static str, pointer: *const f64) -> Self {
        Point { pointer, lives: PhantomData }
    }

    pub(super) fn is_null(&self) -> bool {
        self.pointer.is_null()
    }

    /// The point, which must be there, of weight 0 where there are weights; `t` is the triangulation of the call.
    #[inline(always)]
    pub(super) fn of<T: OfPoints>(self, argument: &'static str, t: &T) -> Result<T::Point, Failure> {
        Ok(T::Point::at(*self.place(argument, t)?, 0.0))
    }

    /// The point, which must be there, with this weight.
    pub(super) fn with_weight<T: OfPoints>(self, weight: f64, t: &T) -> Result<T::Point, Failure> {
        Ok(T::Point::at(*self.place("position", t)?, weight))
    }

    /// Its coordinates, which must be there.
    #[inline(always)]
    pub(super) fn place<T: OfPoints>(
        self,
        argument: &'static str,
        _t: &T,
    ) -> Result<&'a PlaceOf<T>, Failure> {
        // SAFETY: promised to `new`: so many numbers are a place.
        unsafe { Input::new(argument, self.pointer.cast()) }.get()
    }
}

/// Points that are read, as many as their count: an array of numbers.
#[derive(Clone, Copy)]
pub(super) struct Points<'a>(Array<'a, f64>);

impl<'a> Points<'a> {
    /// # Safety
    /// `pointer` is NULL, misaligned, or to `count` points in the dimension of the triangulation of the call.
    #[inline(always)]
    pub(super) unsafe fn new(argument: &'static str, pointer: *const f64, count: usize) -> Self {
        // SAFETY: the caller's promise: a point begins with a number.
        Points(unsafe { Array::new(argument, pointer, count) })
    }

    /// The points, which must be there unless their count is 0, of weight 0 where there are weights; `t` is the triangulation of the
    /// call.
    #[inline(always)]
    pub(super) fn of<T: OfPoints>(self, _t: &T) -> Result<TakenPoints<'a, T::Point>, Failure> {
        self.of_kind::<T>()
    }

    /// The points; none if they are not given.
    pub(super) fn if_any<T: OfPoints>(self, t: &T) -> Result<Option<TakenPoints<'a, T::Point>>, Failure> {
        if self.0.is_null() { Ok(None) } else { self.of(t).map(Some) }
    }

    /// Those of what is still to be made.
    #[inline(always)]
    pub(super) fn of_kind<T: OfPoints>(self) -> Result<TakenPoints<'a, T::Point>, Failure> {
        let places = self.places::<T>()?;
        Ok(match T::Point::of_places(places) {
            Some(points) => TakenPoints::Lent(points),
            None => {
                let mut points = Vec::new();
                memory::collect(&mut points, places.iter().map(|&place| T::Point::at(place, 0.0)))?;
                TakenPoints::Made(points)
            }
        })
    }

    /// Those of what is still to be made, with these weights, or with 0 if there are none.
    pub(super) fn with_weights<T: OfPoints>(self, weights: Option<&[f64]>) -> Result<Vec<T::Point>, Failure> {
        let weight_of = |k: usize| weights.map_or(0.0, |weights| weights[k]);
        let mut points = Vec::new();
        let places = self.places::<T>()?.iter().enumerate();
        memory::collect(&mut points, places.map(|(k, &place)| T::Point::at(place, weight_of(k))))?;
        Ok(points)
    }

    /// The points, with these weights, or with 0 if there are none; `t` is the triangulation of the call.
    pub(super) fn with_weights_of<T: OfPoints>(
        self,
        weights: Option<&[f64]>,
        _t: &T,
    ) -> Result<Vec<T::Point>, Failure> {
        self.with_weights::<T>(weights)
    }

    /// The coordinates, one after the other.
    pub(super) fn numbers<T: OfPoints>(self, _t: &T) -> Result<&'a [f64], Failure> {
        self.places::<T>().map(PointArray::flattened)
    }

    /// The coordinates; none if they are not given.
    pub(super) fn numbers_if_any<T: OfPoints>(self, t: &T) -> Result<Option<&'a [f64]>, Failure> {
        if self.0.is_null() { Ok(None) } else { self.numbers(t).map(Some) }
    }

    /// The coordinates, in rows.
    #[inline(always)]
    pub(super) fn places<T: OfPoints>(self) -> Result<&'a [PlaceOf<T>], Failure> {
        let Points(Array { argument, pointer, count, .. }) = self;
        // SAFETY: promised to `new`: so many numbers are as many places.
        unsafe { Array::new(argument, pointer.cast(), count) }.get()
    }
}

/// The coordinates of a point.
pub(super) type PlaceOf<T> = <<T as OfPoints>::Point as PointArray>::Place;

/// Points of the caller's, or made of places.
pub(super) enum TakenPoints<'a, P> {
    Lent(&'a [P]),
    Made(Vec<P>),
}

impl<P> Deref for TakenPoints<'_, P> {
    type Target = [P];

    #[inline(always)]
    fn deref(&self) -> &[P] {
        match self {
            TakenPoints::Lent(points) => points,
            TakenPoints::Made(points) => points,
        }
    }
}

/// What C has in buffers: numbers, rows of them, and structures. Points with weights are none, as positions are rows of coordinates.
pub(super) trait InBuffer {}

impl InBuffer for bool {}
impl InBuffer for u8 {}
impl InBuffer for i32 {}
impl InBuffer for u32 {}
impl InBuffer for i64 {}
impl InBuffer for u64 {}
impl InBuffer for f64 {}
impl InBuffer for usize {}
impl InBuffer for VertexId {}
impl InBuffer for CellId {}
impl<T: InBuffer, const N: usize> InBuffer for [T; N] {}

/// A buffer of the caller's, which may be uninitialised.
pub(super) struct Buffer<'a, T> {
    argument: &'static str,
    pointer: *mut T,
    capacity: usize,
    lives: PhantomData<&'a mut [T]>,
}

impl<'a, T: InBuffer> Buffer<'a, T> {
    /// # Safety
    /// `pointer` is NULL, misaligned, or has room for `capacity` entries, which nothing else uses.
    #[inline(always)]
    pub(super) unsafe fn new(argument: &'static str, pointer: *mut T, capacity: usize) -> Self {
        Buffer { argument, pointer, capacity, lives: PhantomData }
    }

    pub(super) fn is_null(&self) -> bool {
        self.pointer.is_null()
    }

    /// Its name, and whether it is there.
    pub(super) fn offer(&self) -> Offer {
        Offer { argument: self.argument, is_there: !self.pointer.is_null() }
    }

    /// Its first `n` entries, which must be there.
    #[inline(always)]
    pub(super) fn places(self, n: usize) -> Result<&'a mut [MaybeUninit<T>], Failure> {
        let Buffer { argument, pointer, capacity, .. } = self;
        if n == 0 {
            return Ok(&mut []);
        }
        check(argument, pointer)?;
        check_size::<T>(argument, n)?;
        if capacity < n {
            return Err(Failure::BufferTooSmall { argument: "capacity", capacity, needed: n });
        }
        // SAFETY: neither NULL, misaligned nor larger than an object may be; the rest was promised to `new`, and the
        // type allows what is uninitialised.
        Ok(unsafe { slice::from_raw_parts_mut(pointer.cast(), n) })
    }

    /// Its first `n` entries; none if it is NULL.
    #[inline(always)]
    pub(super) fn places_if_any(self, n: usize) -> Result<&'a mut [MaybeUninit<T>], Failure> {
        let n = if self.is_null() { 0 } else { n };
        self.places(n)
    }

    /// Fills the buffer with `needed` values, if it is there and has the room, and tells their number. No value is made
    /// before the buffer is in order.
    pub(super) fn fill<I: IntoIterator<Item = T>>(
        self,
        count: Output<'_, usize>,
        needed: usize,
        make: impl FnOnce() -> Result<I, Failure>,
    ) -> Result<(), Failure> {
        self.fill_by(count, needed, |places| {
            write_all(places, make()?);
            Ok(())
        })
    }

    /// Has the `needed` entries of the buffer written, if it is there and has the room, and tells their number.
    pub(super) fn fill_by(
        self,
        count: Output<'_, usize>,
        needed: usize,
        write: impl FnOnce(&mut [MaybeUninit<T>]) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let (capacity, offer) = (self.capacity, self.offer());
        fill_all(count, needed, capacity, [offer], || write(self.places(needed)?))
    }
}

/// Writes values to as many places.
#[inline(always)]
pub(super) fn write_all<T>(places: &mut [MaybeUninit<T>], values: impl IntoIterator<Item = T>) {
    places.iter_mut().zip(values).for_each(|(place, value)| _ = place.write(value));
}

/// A buffer as far as its room is concerned: its name, and whether it is there.
#[derive(Clone, Copy)]
pub(super) struct Offer {
    argument: &'static str,
    pub(super) is_there: bool,
}

impl Offer {
    /// The failure of a call that needs it, where it is not there.
    pub(super) fn missing(&self) -> Failure {
        Wrong::Null.in_argument(self.argument)
    }
}

/// Has buffers of the same capacity filled with `needed` entries each, if there are any and they have the room, and
/// tells the number.
pub(super) fn fill_all<const N: usize>(
    count: Output<'_, usize>,
    needed: usize,
    capacity: usize,
    buffers: [Offer; N],
    fill: impl FnOnce() -> Result<(), Failure>,
) -> Result<(), Failure> {
    let fitting = fit(count, needed, capacity, &buffers)?;
    if fitting.are_any {
        fill()?;
    }
    fitting.tell();
    Ok(())
}

/// Buffers that have room for what is needed, or are not there.
pub(super) struct Fitting<'a> {
    count: &'a mut MaybeUninit<usize>,
    needed: usize,
    pub(super) are_any: bool,
}

impl Fitting<'_> {
    /// Tells how many entries are needed; what was to be done for them has been done.
    #[inline(always)]
    pub(super) fn tell(self) {
        self.count.write(self.needed);
    }
}

/// Compares what is needed with the capacity of the caller's buffers. If that is too small, the number that is needed
/// is told at once, so that the caller can provide greater ones. Without a buffer the capacity must be 0: then the
/// number alone is asked for.
pub(super) fn fit<'a>(
    count: Output<'a, usize>,
    needed: usize,
    capacity: usize,
    buffers: &[Offer],
) -> Result<Fitting<'a>, Failure> {
    let count = count.place()?;
    let are_any = buffers.iter().any(|buffer| buffer.is_there);
    if !are_any && capacity > 0 {
        return Err(buffers[0].missing());
    }
    if are_any && capacity < needed {
        count.write(needed);
        return Err(Failure::BufferTooSmall { argument: "capacity", capacity, needed });
    }
    Ok(Fitting { count, needed, are_any })
}

/// Where a list begins, NULL if it is empty: an empty slice of Rust begins at an address that means
/// nothing to C.
pub(super) fn start_of<T>(list: &[T]) -> *const T {
    if list.is_empty() { ptr::null() } else { list.as_ptr() }
}

#[inline(always)]
fn check<T>(argument: &'static str, pointer: *const T) -> Result<(), Failure> {
    if !pointer.is_null() && pointer.is_aligned() { Ok(()) } else { Err(wrong(argument, pointer)) }
}

#[cold]
#[inline(never)]
fn wrong<T>(argument: &'static str, pointer: *const T) -> Failure {
    let wrong = if pointer.is_null() {
        Wrong::Null
    } else {
        Wrong::Misaligned { address: pointer.addr(), alignment: align_of::<T>() }
    };
    wrong.in_argument(argument)
}

fn check_size<T>(argument: &'static str, count: usize) -> Result<(), Failure> {
    match count.checked_mul(size_of::<T>()) {
        Some(bytes) if isize::try_from(bytes).is_ok() => Ok(()),
        _ => Err(Wrong::TooLarge { count, size: size_of::<T>() }.in_argument(argument)),
    }
}

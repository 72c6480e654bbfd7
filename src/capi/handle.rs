//! The object that C knows as a triangulation, and how calls get at what is in it.

use std::cell::UnsafeCell;
use std::marker::PhantomData;
use std::mem::{self, MaybeUninit};
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering::Relaxed};

use super::guard;
use super::options::Callbacks;
use super::pointers::{Input, Output};
use super::status::{Failure, deldrift_status};
use crate::either::{AnyTriangulation, AnyWeighted};
use crate::error::Error;
use crate::machine::{environment, memory};
use crate::periodic::AnyPeriodic;

/// What is in a triangulation that C knows.
#[expect(
    clippy::large_enum_variant,
    reason = "it is in a box of its own, and what is open is read with no other step"
)]
pub(super) enum Content {
    Open(AnyTriangulation),
    Weighted(Box<AnyWeighted>),
    Periodic(Box<AnyPeriodic>),
}

impl From<AnyTriangulation> for Content {
    fn from(t: AnyTriangulation) -> Self {
        Content::Open(t)
    }
}

impl From<Box<AnyWeighted>> for Content {
    fn from(t: Box<AnyWeighted>) -> Self {
        Content::Weighted(t)
    }
}

impl From<Box<AnyPeriodic>> for Content {
    fn from(t: Box<AnyPeriodic>) -> Self {
        Content::Periodic(t)
    }
}

impl Content {
    /// The number of coordinates of a point, 2 or 3.
    pub(super) fn dimension(&self) -> u32 {
        match self {
            Content::Open(t) => t.dimension(),
            Content::Weighted(t) => t.dimension(),
            Content::Periodic(t) => t.dimension(),
        }
    }

    /// Whether vertices have weights.
    pub(super) fn is_weighted(&self) -> bool {
        match self {
            Content::Open(_) => false,
            Content::Weighted(_) => true,
            Content::Periodic(t) => t.is_weighted(),
        }
    }

    /// Refuses what may not be done while a timestamp is prepared.
    pub(super) fn reject_prepared(&self) -> Result<(), Error> {
        let content = self;
        in_any!(content => content.reject_prepared())
    }

    /// For a function that serves neither periodic triangulations nor weights.
    #[inline(always)]
    fn open(&self) -> Result<&AnyTriangulation, Failure> {
        match self {
            Content::Open(t) => Ok(t),
            Content::Weighted(_) => Err(Failure::Weighted),
            Content::Periodic(_) => Err(Failure::Periodic),
        }
    }

    #[inline(always)]
    fn open_mut(&mut self) -> Result<&mut AnyTriangulation, Failure> {
        match self {
            Content::Open(t) => Ok(t),
            Content::Weighted(_) => Err(Failure::Weighted),
            Content::Periodic(_) => Err(Failure::Periodic),
        }
    }
}

/// A triangulation: opaque, made by deldrift_create, unmade by deldrift_destroy.
pub struct deldrift_triangulation {
    content: UnsafeCell<Content>,
    // What the triangulation calls, for those that are made from it.
    callbacks: Callbacks,
    // Written only by calls that change the triangulation, which exclude all others by contract. They are
    // atomic so that a caller that breaks the contract reads a flag and not garbage; nothing is ordered.
    is_changing: AtomicBool,
    is_poisoned: AtomicBool,
    // How many calls that only read it may be calling its callbacks.
    n_watched: AtomicU32,
}

impl deldrift_triangulation {
    #[inline(always)]
    fn new(content: Content, callbacks: Callbacks) -> Self {
        Self {
            content: UnsafeCell::new(content),
            callbacks,
            is_changing: AtomicBool::new(false),
            is_poisoned: AtomicBool::new(false),
            n_watched: AtomicU32::new(0),
        }
    }

    /// One that is to be built: in memory of its own, and made there.
    #[inline(always)]
    pub(super) fn unbuilt(
        content: impl FnOnce() -> AnyTriangulation,
        callbacks: Callbacks,
    ) -> Result<Box<Self>, Error> {
        memory::boxed_by(
            #[inline(always)]
            || Self::new(Content::Open(content()), callbacks),
        )
    }

    /// What is in it, which is open, as long as nobody else knows it.
    pub(super) fn content_mut(&mut self) -> Result<&mut AnyTriangulation, Failure> {
        self.content.get_mut().open_mut()
    }

    fn check_idle(&self) -> Result<(), Failure> {
        if self.is_changing.load(Relaxed) { Err(Failure::Busy) } else { Ok(()) }
    }

    fn check_ready(&self) -> Result<(), Failure> {
        self.check_idle()?;
        if self.is_poisoned.load(Relaxed) { Err(Failure::Poisoned) } else { Ok(()) }
    }

    /// Whether no call below this one on the stack uses it.
    fn check_unused(&self) -> Result<(), Failure> {
        self.check_idle()?;
        if self.n_watched.load(Relaxed) > 0 { Err(Failure::Busy) } else { Ok(()) }
    }

    /// Keeps callbacks that are called while it is read from changing it.
    fn watch(&self) -> Watched<'_> {
        self.n_watched.fetch_add(1, Relaxed);
        Watched(self)
    }

    /// Claims the triangulation for a call that changes it.
    #[inline(always)]
    fn claim(&self) -> Result<Claim<'_>, Failure> {
        self.check_ready()?;
        self.check_unused()?;
        self.is_changing.store(true, Relaxed);
        Ok(Claim(self))
    }
}

/// The right to change a triangulation. Dropped without release, by a panic, it leaves it poisoned.
struct Claim<'t>(&'t deldrift_triangulation);

impl Claim<'_> {
    /// The change has come to its end, with or without success.
    fn release(self) {
        self.0.is_changing.store(false, Relaxed);
        mem::forget(self);
    }
}

impl Drop for Claim<'_> {
    fn drop(&mut self) {
        self.0.is_poisoned.store(true, Relaxed);
        self.0.is_changing.store(false, Relaxed);
    }
}

/// A call that reads a triangulation and calls its callbacks.
struct Watched<'t>(&'t deldrift_triangulation);

impl Drop for Watched<'_> {
    fn drop(&mut self) {
        self.0.n_watched.fetch_sub(1, Relaxed);
    }
}

/// The triangulation of a pointer.
///
/// # Safety
/// `t` is NULL, misaligned, or the triangulation of a successful creation.
#[inline(always)]
unsafe fn handle_of<'a>(t: *const deldrift_triangulation) -> Result<&'a deldrift_triangulation, Failure> {
    // SAFETY: the caller's promise.
    unsafe { Input::new("t", t) }.get()
}

/// A triangulation that a call reads.
pub(super) struct Reading<'a> {
    pointer: *const deldrift_triangulation,
    lives: PhantomData<&'a deldrift_triangulation>,
}

impl<'a> Reading<'a> {
    /// # Safety
    /// `t` is NULL, misaligned, or the triangulation of a successful creation, and no other thread changes it.
    #[inline(always)]
    pub(super) unsafe fn new(_argument: &'static str, t: *const deldrift_triangulation) -> Self {
        Reading { pointer: t, lives: PhantomData }
    }

    /// What is in it, and its callbacks, unless a call below this one on the stack is changing it.
    #[inline(always)]
    fn ready(self) -> Result<(&'a Content, &'a deldrift_triangulation), Failure> {
        // SAFETY: promised to `new`.
        let handle = unsafe { handle_of(self.pointer) }?;
        handle.check_ready()?;
        // SAFETY: it is ready, so no call below this one on the stack is changing it, and none of another thread, as
        // was promised to `new`.
        Ok((unsafe { &*handle.content.get() }, handle))
    }

    /// Runs the body of an entry that looks at a triangulation.
    #[inline(always)]
    pub(super) fn read(self, body: impl FnOnce(&AnyTriangulation) -> Result<(), Failure>) -> deldrift_status {
        guard::enter(|| body(self.ready()?.0.open()?))
    }

    /// Runs the body of an entry that looks at a triangulation, periodic or not.
    #[inline(always)]
    pub(super) fn read_any(self, body: impl FnOnce(&Content) -> Result<(), Failure>) -> deldrift_status {
        guard::enter(|| body(self.ready()?.0))
    }

    /// Runs the body of an entry that makes something of a triangulation that calls the same callbacks.
    pub(super) fn read_with_callbacks(
        self,
        body: impl FnOnce(&Content, Callbacks) -> Result<(), Failure>,
    ) -> deldrift_status {
        guard::enter(|| {
            let (t, handle) = self.ready()?;
            body(t, handle.callbacks)
        })
    }

    /// Runs the body of an entry that looks at a triangulation, periodic or not, for long, with a monitor that calls
    /// its callbacks. These may look at it as well; calls that change it are turned away.
    pub(super) fn read_any_watched(
        self,
        body: impl FnOnce(&Content, &mut dyn FnMut(f64) -> bool) -> Result<(), Failure>,
    ) -> deldrift_status {
        guard::enter(|| {
            let (t, handle) = self.ready()?;
            let _watched = handle.watch();
            body(t, &mut |fraction| handle.callbacks.go_on(fraction))
        })
    }

    /// Runs the body of an entry that tells one thing about a triangulation of any kind, and writes what it tells.
    #[inline(always)]
    pub(super) fn tell_any<T>(
        self,
        out: Output<'_, T>,
        body: impl FnOnce(&Content) -> Result<T, Failure>,
    ) -> deldrift_status {
        self.read_any(|t| {
            let out = out.place()?;
            out.write(body(t)?);
            Ok(())
        })
    }
}

/// A triangulation that a call changes.
#[derive(Clone, Copy)]
pub(super) struct Changing<'a> {
    pointer: *mut deldrift_triangulation,
    lives: PhantomData<&'a mut deldrift_triangulation>,
}

impl<'a> Changing<'a> {
    /// # Safety
    /// `t` is NULL, misaligned, or the triangulation of a successful creation, and no other thread uses it.
    #[inline(always)]
    pub(super) unsafe fn new(_argument: &'static str, t: *mut deldrift_triangulation) -> Self {
        Changing { pointer: t, lives: PhantomData }
    }

    #[inline(always)]
    fn handle(self) -> Result<&'a deldrift_triangulation, Failure> {
        // SAFETY: promised to `new`.
        unsafe { handle_of(self.pointer) }
    }

    /// Runs the body of an entry that changes a triangulation, and poisons it if the body panics.
    pub(super) fn change(
        self,
        body: impl FnOnce(&mut AnyTriangulation) -> Result<(), Failure>,
    ) -> deldrift_status {
        self.change_any(|t| body(t.open_mut()?))
    }

    /// That, of a triangulation that may be periodic.
    pub(super) fn change_any(
        self,
        body: impl FnOnce(&mut Content) -> Result<(), Failure>,
    ) -> deldrift_status {
        guard::enter(|| {
            let handle = self.handle()?;
            let claim = handle.claim()?;
            // SAFETY: the claim excludes calls below this one on the stack, the promise to `new` those of other
            // threads.
            let outcome = body(unsafe { &mut *handle.content.get() });
            claim.release();
            outcome
        })
    }

    /// Makes a change so short that the guard would cost as much: the body cannot panic, and calls nothing of the
    /// caller's. Whether it was made; if not, nothing has happened.
    #[inline(always)]
    pub(super) fn change_shortly(self, body: impl FnOnce(&mut AnyTriangulation) -> bool) -> bool {
        environment::in_default(|| {
            self.handle().is_ok_and(|handle| {
                let is_free = handle.check_ready().is_ok() && handle.check_unused().is_ok();
                // SAFETY: it is free, which excludes calls below this one on the stack, and the promise to `new`
                // excludes those of other threads.
                is_free && unsafe { &mut *handle.content.get() }.open_mut().is_ok_and(body)
            })
        })
    }

    /// Ends its life, and frees its memory, unless it is NULL or a call below this one on the stack uses it.
    pub(super) fn destroy(self) {
        if self.pointer.is_null() {
            return;
        }
        // There is nowhere to give the status to; the message is there to be read.
        let _ = guard::enter(|| {
            self.handle()?.check_unused()?;
            // SAFETY: it came from a Box, and nothing uses it: no call below this one on the stack, as has been
            // checked, and none of another thread, as was promised to `new`.
            drop(unsafe { Box::from_raw(self.pointer) });
            Ok(())
        });
    }
}

/// Gives a triangulation to the caller.
pub(super) fn hand_out(
    out: &mut MaybeUninit<*mut deldrift_triangulation>,
    content: impl Into<Content>,
    callbacks: Callbacks,
) -> Result<(), Failure> {
    out.write(Box::into_raw(memory::boxed(deldrift_triangulation::new(content.into(), callbacks))?));
    Ok(())
}

/// What a reference to a box leads to, of either kind.
pub(super) trait Within {
    type To;

    fn within(self) -> Self::To;
}

impl<'t, T> Within for &'t Box<T> {
    type To = &'t T;

    fn within(self) -> &'t T {
        self
    }
}

impl<'t, T> Within for &'t mut Box<T> {
    type To = &'t mut T;

    fn within(self) -> &'t mut T {
        self
    }
}

/// Evaluates an expression on a periodic triangulation, in its dimension.
macro_rules! in_its_period {
    ($periodic:expr, $t:ident => $body:expr) => {
        match $crate::capi::handle::Within::within($periodic) {
            $crate::periodic::AnyPeriodic::Plane($t) => $body,
            $crate::periodic::AnyPeriodic::Space($t) => $body,
            $crate::periodic::AnyPeriodic::PowerPlane($t) => $body,
            $crate::periodic::AnyPeriodic::PowerSpace($t) => $body,
        }
    };
}
pub(super) use in_its_period;

/// Evaluates an expression on a triangulation with weights, in its dimension.
macro_rules! with_weights {
    ($weighted:expr, $t:ident => $body:expr) => {
        match $weighted {
            $crate::either::AnyWeighted::Plane($t) => $body,
            $crate::either::AnyWeighted::Space($t) => $body,
        }
    };
}
pub(super) use with_weights;

/// Evaluates an expression on what is in a triangulation with weights, which may be periodic, in its dimension; any other is
/// refused.
macro_rules! in_weighted {
    ($t:ident => $body:expr) => {
        match $t {
            $crate::capi::handle::Content::Weighted(t) => {
                $crate::capi::handle::with_weights!($crate::capi::handle::Within::within(t), $t => $body)
            }
            $crate::capi::handle::Content::Periodic(t) => match $crate::capi::handle::Within::within(t) {
                $crate::periodic::AnyPeriodic::PowerPlane($t) => $body,
                $crate::periodic::AnyPeriodic::PowerSpace($t) => $body,
                _ => return Err($crate::capi::status::Failure::NotWeighted),
            },
            $crate::capi::handle::Content::Open(_) => return Err($crate::capi::status::Failure::NotWeighted),
        }
    };
}
pub(super) use in_weighted;

/// Evaluates one expression on what is in a triangulation that does not repeat, with weights or without, in its dimension, and
/// another one on what is in a periodic one: `by_kind!(t => t.count(), periodic t => t.count_anew()?)`.
macro_rules! by_kind {
    ($t:ident => $body:expr, periodic $p:ident => $other:expr) => {
        match $t {
            $crate::capi::handle::Content::Open($crate::AnyTriangulation::Plane($t)) => $body,
            $crate::capi::handle::Content::Open($crate::AnyTriangulation::Space($t)) => $body,
            $crate::capi::handle::Content::Weighted(t) => {
                $crate::capi::handle::with_weights!($crate::capi::handle::Within::within(t), $t => $body)
            },
            $crate::capi::handle::Content::Periodic(t) => $crate::capi::handle::in_its_period!(t, $p => $other),
        }
    };
}
pub(super) use by_kind;

/// Evaluates an expression on what is in a triangulation that does not repeat, with weights or without, in its dimension; a periodic
/// one is refused.
macro_rules! in_open {
    ($t:ident => $body:expr) => {
        match $t {
            $crate::capi::handle::Content::Open($crate::AnyTriangulation::Plane($t)) => $body,
            $crate::capi::handle::Content::Open($crate::AnyTriangulation::Space($t)) => $body,
            $crate::capi::handle::Content::Weighted(t) => {
                $crate::capi::handle::with_weights!($crate::capi::handle::Within::within(t), $t => $body)
            },
            $crate::capi::handle::Content::Periodic(_) => {
                return Err($crate::capi::status::Failure::Periodic);
            }
        }
    };
}
pub(super) use in_open;

/// Evaluates an expression on what is in a triangulation of any kind, in its dimension: `in_any!(t => t.count())`.
macro_rules! in_any {
    ($t:ident => $body:expr) => {
        $crate::capi::handle::by_kind!($t => $body, periodic $t => $body)
    };
}
pub(super) use in_any;

/// Evaluates an expression on a triangulation that may be periodic, and writes the result to an output.
macro_rules! tell_any {
    ($t:ident, $out:ident => $body:expr) => {
        $t.tell_any($out, |$t| $crate::capi::handle::in_any!($t => Ok($body)))
    };
}
pub(super) use tell_any;

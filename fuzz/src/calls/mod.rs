//! Bytes as a sequence of calls of the functions of the header, compared after each with a model and a fresh build.

pub mod asking;
mod beside;
pub mod called;
mod change;
pub mod check;
mod conflicts;
mod constraining;
pub mod files;
mod geometry;
pub mod model;
mod near;
mod periodic;
pub mod places;
mod read;
mod refining;
mod refuse;
mod regions;
mod segments;
mod transferring;
pub mod types;
mod weights;

use super::allocator::Fault;
use super::source::Source;
use super::tally;
use called::{c, note};
use deldrift::capi::deldrift_status::*;
use deldrift::capi::*;
use model::Model;
use places::{Style, place};
use std::cell::Cell;
use std::collections::BTreeSet;
use std::ffi::{CStr, c_void};
use std::ptr::{null, null_mut};
use std::sync::Once;
use types::{Place, Row};

/// A history: a triangulation is created, changed, read and destroyed. Some go on with copies as with the original.
pub fn run(data: &[u8]) {
    static ONCE: Once = Once::new();
    // So that small triangulations are worked on by several threads.
    ONCE.call_once(deldrift::internals::use_all_threads);
    live(data, None);
    if data.iter().fold(0, |sum: u8, &byte| sum.wrapping_add(byte)) % 4 == 0 {
        beside::compare(data);
    }
}

/// Makes all calls; with what goes on where there are copies, or as the bytes say.
fn live(data: &[u8], with: Option<beside::With>) -> Vec<beside::Seen> {
    let mut history = History::new(data, with);
    let mut most = 60;
    while !history.s.is_done() && most > 0 {
        history.step();
        history.note_seen();
        most -= 1;
    }
    history.end();
    history.seen
}

/// What the callbacks of a triangulation are told, and tell.
#[derive(Default)]
struct Callback {
    /// The triangulation that is being changed.
    t: Cell<*mut deldrift_triangulation>,
    /// How often the work goes on before it is cancelled; never, if there is no number.
    left: Cell<Option<u32>>,
    has_cancelled: Cell<bool>,
    calls_back: Cell<bool>,
    /// What was wrong.
    wrong: Cell<Option<&'static str>>,
}

unsafe extern "C" fn cancel(user_data: *mut c_void) -> Answer {
    // SAFETY: it is what the options had, and outlives the triangulation.
    let callback = unsafe { &*user_data.cast::<Callback>() };
    let t = callback.t.get();
    if callback.calls_back.get() && !t.is_null() {
        let mut count = 77;
        let is_read = c!(deldrift_cell_count(t, &mut count)) != DELDRIFT_BUSY || count != 77;
        let is_changed = c!(deldrift_commit_timestamp(t, null_mut())) != DELDRIFT_BUSY;
        c!(deldrift_destroy(t));
        if is_read || is_changed {
            callback.wrong.set(Some("a call from a callback was let in"));
        }
    }
    let answer = match callback.left.get() {
        Some(0) => {
            callback.has_cancelled.set(true);
            true
        }
        left => {
            callback.left.set(left.map(|left| left - 1));
            false
        }
    };
    answer.into()
}

unsafe extern "C" fn progress(user_data: *mut c_void, fraction: f64) {
    // SAFETY: as above.
    let callback = unsafe { &*user_data.cast::<Callback>() };
    if !(0.0..=1.0).contains(&fraction) {
        callback.wrong.set(Some("progress is not between 0 and 1"));
    }
}

/// What was there when the changes were last taken.
#[derive(Clone, Default)]
struct Carried {
    rows: Vec<Row>,
    hidden: BTreeSet<u32>,
}

struct History<'a> {
    s: Source<'a>,
    style: Style,
    m: Model,
    t: *mut deldrift_triangulation,
    options: deldrift_options,
    chosen: Chosen,
    callback: Box<Callback>,
    /// What is to befall the next call.
    fault: Option<Fault>,
    cancel_after: Option<u32>,
    /// The cells of a fresh build, sorted, unless positions have changed since.
    fresh: Option<Vec<Row>>,
    carried: Carried,
    /// How many vertices have been within their safe region.
    within: u64,
    /// Whether cells are compared with the definition at the end.
    proves: bool,
    /// Whether there are segments.
    has_segments: bool,
    /// The key of the next vertex, if vertices have keys. They ascend with ids, so that the model need not know them.
    next_key: Option<u64>,
    /// What goes on where there are copies; as the bytes say, if nothing is given.
    with: Option<beside::With>,
    seen: Vec<beside::Seen>,
}

/// The numbers of places, for C.
pub fn flattened(places: &[Place], d: usize) -> Vec<f64> {
    places.iter().flat_map(|p| p[..d].iter().copied()).collect()
}

pub fn message() -> String {
    // SAFETY: the library's own string.
    unsafe { CStr::from_ptr(c!(deldrift_last_error())) }.to_string_lossy().into_owned()
}

/// The algorithm codes, those for tests included.
const ALGORITHMS: [u32; 12] = [0, 0, 1, 2, 3, 4, 16, 17, 18, 19, 1000, 1001];

/// An algorithm, and the rule of one of research.
#[derive(Clone, Copy)]
struct Chosen {
    algorithm: u32,
    rule: deldrift_research_options,
}

impl Chosen {
    /// What a triangulation can be created with: algorithms of research are chosen afterwards.
    fn at_creation(&self) -> u32 {
        if self.is_of_research() { 0 } else { self.algorithm }
    }

    fn is_of_research(&self) -> bool {
        self.algorithm >= 16
    }

    fn choose(&self, t: *mut deldrift_triangulation) -> deldrift_status {
        if self.is_of_research() {
            c!(deldrift_research_set_algorithm(t, self.algorithm, &self.rule))
        } else {
            c!(deldrift_set_algorithm(t, self.algorithm))
        }
    }
}

fn options(s: &mut Source, callback: &Callback) -> (deldrift_options, Chosen) {
    let flags = s.byte();
    let asks = flags & 1 != 0;
    let tells = flags & 2 != 0;
    let rule = deldrift_research_options {
        struct_size: size_of::<deldrift_research_options>(),
        switch_share: 0.0,
        switch_seed: 0,
        switch_sample: 0,
        switch_period: 0,
    };
    let mut chosen = Chosen { algorithm: s.pick(&ALGORITHMS), rule };
    let options = deldrift_options {
        struct_size: size_of::<deldrift_options>(),
        algorithm: chosen.at_creation(),
        threads: u32::from(flags >> 2 & 3),
        coincidence: u32::from(flags & 0x70 == 0),
        passing: 0,
        parts: usize::from(flags >> 2 & 1),
        cancel: asks.then_some(cancel as unsafe extern "C" fn(*mut c_void) -> Answer),
        progress: tells.then_some(progress as unsafe extern "C" fn(*mut c_void, f64)),
        user_data: std::ptr::from_ref(callback).cast_mut().cast(),
    };
    if chosen.algorithm == 19 {
        chosen.rule.switch_share = s.pick(&[0.0, 1.0, 0.01]);
        chosen.rule.switch_seed = u64::from(s.byte());
        chosen.rule.switch_sample = s.pick(&[0, 1, 5, u32::MAX]);
        chosen.rule.switch_period = s.pick(&[0, 1, 2]);
    }
    (options, chosen)
}

impl<'a> History<'a> {
    fn new(data: &'a [u8], with: Option<beside::With>) -> Self {
        tally::HISTORIES.add(1);
        let mut s = Source::new(data);
        let flags = s.byte();
        let d = 2 + usize::from(flags & 1);
        let n = match s.byte() {
            255 => 300 + s.below(200),
            n if n < 40 => usize::from(n) % 6,
            n => 3 + usize::from(n) % 28,
        };
        let style = Style::new(&mut s);
        let callback = Box::<Callback>::default();
        let (options, chosen) = options(&mut s, &callback);
        let m = Model { d, ..Model::default() };
        let mut history = History {
            s,
            style,
            m,
            t: null_mut(),
            options,
            chosen,
            callback,
            fault: None,
            cancel_after: None,
            fresh: None,
            carried: Carried::default(),
            within: 0,
            proves: flags & 0x3e == 0 && n < 60,
            has_segments: d == 2 && flags & 0x40 != 0,
            next_key: (flags & 0xc0 == 0x80).then_some(7),
            with,
            seen: Vec::new(),
        };
        for _ in 0..n {
            let p = history.place();
            history.m.positions.push(Some(p));
        }
        history.create();
        history
    }

    fn place(&mut self) -> Place {
        place(&mut self.s, self.style, &self.m)
    }

    /// A vertex that is present.
    fn some(&mut self) -> Option<u32> {
        let present: Vec<u32> = self.m.present().collect();
        if present.is_empty() { None } else { Some(present[self.s.below(present.len())]) }
    }

    /// An operation, and perhaps something that befalls it.
    fn step(&mut self) {
        tally::OPERATIONS.add(1);
        let choice = self.s.byte();
        if choice & 0xc0 == 0xc0 {
            let (first, goes_on) = (usize::from(self.s.byte()), choice & 0x20 != 0);
            self.fault = Some(Fault { first: if first < 128 { first % 16 } else { first - 128 }, goes_on });
        }
        if choice & 0xe0 == 0x80 {
            self.cancel_after = Some(u32::from(self.s.byte() % 8));
            self.callback.calls_back.set(choice & 0x10 == 0);
        }
        if self.with.is_some() {
            // What befalls calls does so at other places in copies, and calls that are taken back leave other hints.
            (self.fault, self.cancel_after) = (None, None);
        }
        if self.has_segments && choice & 0x28 == 0x20 {
            self.change_segments();
        } else {
            self.change_or_read(choice);
        }
        (self.fault, self.cancel_after) = (None, None);
        self.callback.calls_back.set(false);
    }

    fn change_or_read(&mut self, choice: u8) {
        match choice % 32 {
            0 => self.insert(),
            1 => self.remove(),
            2 | 3 => self.relocate(),
            4 => self.move_one(),
            5..=8 => self.stage_motion(),
            9 => self.stage_insertions(),
            10 => self.stage_removals(),
            11 => self.discard(),
            12..=16 => self.commit(),
            17 | 18 => self.commit_positions(),
            19 => self.set_algorithm(),
            20 => self.compact(),
            21 => self.take_changes(),
            22 => self.clone_or_load(),
            23..=26 => self.read(),
            28 if choice & 0x20 != 0 => self.weigh(),
            27 | 28 => self.read_geometry(),
            29 if choice & 0x20 != 0 => self.repeat(),
            29 => self.write_files(),
            30 => self.refuse(),
            _ => self.read_near(),
        }
    }

    /// Makes a call, first with what is to befall it. If that makes it fail, nothing may have changed, and the call is
    /// made again.
    fn call(&mut self, mut call: impl FnMut() -> deldrift_status) -> deldrift_status {
        self.callback.t.set(self.t);
        if let Some(fault) = self.fault.take() {
            let (status, refused) = fault.during(&mut call);
            if status != DELDRIFT_OUT_OF_MEMORY {
                return self.sound(status);
            }
            tally::FAULTS.add(1);
            assert!(refused, "no memory, though there was: {}", message());
            assert!(!message().is_empty());
            self.check();
        }
        if let Some(left) = self.cancel_after.take() {
            self.callback.left.set(Some(left));
            let status = call();
            self.callback.left.set(None);
            if status != DELDRIFT_CANCELLED {
                assert!(!self.callback.has_cancelled.get(), "cancelled, but {status:?}");
                return self.sound(status);
            }
            tally::CANCELLED.add(1);
            assert!(self.callback.has_cancelled.take(), "not cancelled");
            self.check();
        }
        let status = call();
        self.sound(status)
    }

    fn sound(&self, status: deldrift_status) -> deldrift_status {
        if let Some(wrong) = self.callback.wrong.take() {
            panic!("{wrong}");
        }
        let is_defect =
            matches!(status, DELDRIFT_INTERNAL_ERROR | DELDRIFT_POISONED | DELDRIFT_OUT_OF_MEMORY);
        assert!(
            !is_defect && status != DELDRIFT_CANCELLED && status != DELDRIFT_BUSY,
            "{status:?}: {}",
            message()
        );
        status
    }

    /// A call that must end in this status.
    fn expect(&mut self, wanted: deldrift_status, call: impl FnMut() -> deldrift_status) {
        let status = self.call(call);
        assert_eq!(status, wanted, "{}", message());
        assert!(wanted == DELDRIFT_OK || !message().is_empty());
    }

    /// A call that must end in one of several; that.
    fn expect_one(
        &mut self,
        wanted: &[deldrift_status],
        call: impl FnMut() -> deldrift_status,
    ) -> deldrift_status {
        let status = self.call(call);
        assert!(wanted.contains(&status), "{status:?}, not {wanted:?}: {}", message());
        status
    }

    fn ok(&mut self, call: impl FnMut() -> deldrift_status) {
        self.expect(DELDRIFT_OK, call);
    }

    /// Keys of vertices that come, if vertices have keys.
    fn draw_keys(&mut self, count: usize) -> Option<Vec<u64>> {
        let next = self.next_key.as_mut()?;
        let keys = (0..count as u64).map(|k| *next + 3 * k).collect();
        *next += 3 * count as u64;
        Some(keys)
    }

    fn create(&mut self) {
        let d = self.m.d;
        let places: Vec<Place> = self.m.positions.iter().flatten().copied().collect();
        let numbers = flattened(&places, d);
        let given = self.draw_keys(places.len());
        let keys = given.as_ref().map_or(null(), |keys| keys.as_ptr());
        let options = self.options;
        let rejects = options.coincidence == 1 && Model::has_coincidence(&self.m.positions);
        let mut t = null_mut();
        let wanted = if rejects { DELDRIFT_COINCIDENT } else { DELDRIFT_OK };
        let create = |options: &_, t: &mut _| {
            c!(deldrift_create_with_keys(d as u32, numbers.as_ptr(), keys, places.len(), options, t))
        };
        let plan = self.s.byte();
        if plan < 30 {
            let fault = Fault { first: usize::from(self.s.byte()) % 64, goes_on: plan & 1 == 0 };
            let (status, refused) = fault.during(|| create(&options, &mut t));
            let is_out = status == DELDRIFT_OUT_OF_MEMORY && refused && t.is_null();
            assert!(is_out || status == wanted, "{status:?}: {}", message());
            tally::FAULTS.add(u64::from(is_out));
        } else if plan < 40 {
            self.callback.left.set(Some(u32::from(self.s.byte() % 4)));
            let status = create(&options, &mut t);
            let is_cancelled =
                status == DELDRIFT_CANCELLED && self.callback.has_cancelled.take() && t.is_null();
            assert!(is_cancelled || status == wanted, "{status:?}: {}", message());
            self.callback.left.set(None);
            tally::CANCELLED.add(u64::from(is_cancelled));
        }
        if t.is_null() {
            self.expect(wanted, || create(&options, &mut t));
        }
        if rejects {
            assert!(t.is_null(), "created in spite of coincidence");
            self.options.coincidence = 0;
            let options = self.options;
            self.ok(|| create(&options, &mut t));
        }
        self.t = t;
        self.is_ok(self.chosen.choose(t));
        self.check();
    }

    fn end(&mut self) {
        if self.proves && !self.has_segments && self.m.present().count() < 60 {
            tally::PROOFS.add(1);
            let (rows, neighbours) = self.cells();
            self.m.prove(&rows, &neighbours);
        }
        let t = std::mem::replace(&mut self.t, null_mut());
        c!(deldrift_destroy(t));
        c!(deldrift_destroy(null_mut()));
    }

    /// Segments come, go, and are asked about.
    fn change_segments(&mut self) {
        match self.s.below(12) {
            0..=2 => self.stage_segments(),
            3 => self.stage_segment_removals(),
            4 => {
                self.check_staged();
                self.check_passings();
            }
            5 => self.read_sides(),
            6 => self.read_regions(),
            7 => self.stage_splits(),
            8 => self.read_chains(),
            _ => self.improve(),
        }
    }
}

/// The address of no triangulation.
fn no_triangulation() -> *const deldrift_triangulation {
    null()
}

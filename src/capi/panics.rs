//! Panics in calls. At every point at which a commit calls its monitor, by every algorithm: the call gives an internal
//! error, the triangulation can then only be destroyed, and others go on, on the same threads.

use std::env;
use std::ffi::CStr;
use std::mem::MaybeUninit;
use std::process::Command;
use std::ptr::{null, null_mut};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use super::handle::{Changing, Reading, hand_out};
use super::options::GivenOptions;
use super::*;
use crate::delaunay::{Dimension, Plane, Space};
use crate::either::AnyTriangulation;
use crate::machine::threads;
use crate::motion::{Algorithm, Monitor, MovingTriangulation, Options};

fn message() -> String {
    // SAFETY: the message always ends in a NUL.
    unsafe { CStr::from_ptr(deldrift_last_error()) }.to_str().expect("messages are UTF-8").to_string()
}

/// Numbers from 0 to 1, the same in every run.
fn points<G: Dimension>(n: usize, mut seed: u64) -> Vec<G::Point> {
    let mut next = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1u64 << 53) as f64
    };
    let mut point = || {
        let mut point = G::Point::default();
        (0..G::D).for_each(|axis| point[axis] = next());
        point
    };
    (0..n).map(|_| point()).collect()
}

struct Scene<G: Dimension> {
    t: *mut deldrift_triangulation,
    /// Calls of the monitor until it panics.
    left: Arc<AtomicUsize>,
    places: Vec<G::Point>,
}

impl<G: Dimension> Scene<G> {
    /// A triangulation that has made a commit and has moves staged for the next one.
    fn new(options: Options) -> Self
    where
        AnyTriangulation: From<MovingTriangulation<G>>,
    {
        let n = if options.threads > 1 { 800 } else { 60 };
        let left = Arc::new(AtomicUsize::new(usize::MAX));
        let counter = left.clone();
        let monitor: Monitor = Box::new(move |_| {
            assert!(counter.fetch_sub(1, Relaxed) != 0, "planted");
            true
        });
        let options = Options { monitor: Some(monitor), ..options };
        let made = MovingTriangulation::new(&points::<G>(n, 3), options).expect("points in range");
        let mut out = MaybeUninit::uninit();
        // SAFETY: NULL stands for the defaults, which have no callbacks.
        let defaults = unsafe { GivenOptions::new("options", null()) }.read().expect("defaults are in order");
        hand_out(&mut out, AnyTriangulation::from(made), defaults.callbacks()).expect("there is memory");
        // SAFETY: it has been written.
        let t = unsafe { out.assume_init() };
        let scene = Scene { t, left, places: points::<G>(n, 4) };
        scene.stage();
        assert_eq!(scene.commit(), deldrift_status::DELDRIFT_OK);
        let places = points::<G>(n, 5);
        let scene = Scene { places, ..scene };
        scene.stage();
        scene
    }

    fn stage(&self) {
        // SAFETY: so many points are there, and the triangulation is.
        let status =
            unsafe { deldrift_move_vertices(self.t, null(), self.places.as_ptr().cast(), self.places.len()) };
        assert_eq!(status, deldrift_status::DELDRIFT_OK);
    }

    fn commit(&self) -> deldrift_status {
        // SAFETY: the triangulation is there.
        unsafe { deldrift_commit_timestamp(self.t, null_mut()) }
    }

    fn validate(&self) -> deldrift_status {
        // SAFETY: the triangulation is there.
        unsafe { deldrift_validate(self.t, 3) }
    }

    fn end(self) {
        // SAFETY: nobody uses it after this.
        unsafe { deldrift_destroy(self.t) };
    }
}

/// How many panics there were, one in each of as many commits.
fn panics_of<G: Dimension>(algorithm: Algorithm, threads: u32) -> usize
where
    AnyTriangulation: From<MovingTriangulation<G>>,
{
    let options = || Options { algorithm, threads, ..Options::default() };
    for k in 0.. {
        let scene = Scene::<G>::new(options());
        scene.left.store(k, Relaxed);
        let status = scene.commit();
        if status == deldrift_status::DELDRIFT_OK {
            assert_eq!(scene.validate(), deldrift_status::DELDRIFT_OK);
            scene.end();
            return k;
        }
        assert_eq!(status, deldrift_status::DELDRIFT_INTERNAL_ERROR);
        assert!(message().contains("planted"), "{}", message());
        scene.left.store(usize::MAX, Relaxed);
        assert_eq!(scene.commit(), deldrift_status::DELDRIFT_POISONED);
        assert_eq!(scene.validate(), deldrift_status::DELDRIFT_POISONED);
        scene.end();
    }
    unreachable!("a commit calls its monitor a few times")
}

/// In a process of its own, where all threads are used that are asked for: other tests depend on how many are.
#[test]
fn panics_in_commits_poison_one_triangulation_and_no_other() {
    const ALL_THREADS: &str = "DELDRIFT_ALL_THREADS";
    if env::var_os(ALL_THREADS).is_none() {
        let name = "capi::panics::panics_in_commits_poison_one_triangulation_and_no_other";
        let mut test = Command::new(env::current_exe().expect("a test knows its own path"));
        let outcome = test.args([name, "--exact", "--nocapture"]).env(ALL_THREADS, "1").output();
        let outcome = outcome.expect("a test can be run");
        let [said, errors] = [&outcome.stdout, &outcome.stderr].map(|text| String::from_utf8_lossy(text));
        println!("{said}");
        assert!(outcome.status.success() && said.contains("panics in all commits: "), "{errors}");
        return;
    }
    let mut sum = 0;
    for algorithm in Algorithm::ALL {
        let mut n_panics = 0;
        for threads in [1, 3] {
            n_panics += panics_of::<Plane>(algorithm, threads);
            n_panics += panics_of::<Space>(algorithm, threads);
        }
        println!("panics in commits by {algorithm:?}: {n_panics}");
        assert!(n_panics > 0, "{algorithm:?}");
        sum += n_panics;
    }
    println!("panics in all commits: {sum}");
}

fn square() -> *mut deldrift_triangulation {
    let (positions, mut t) = ([0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.1, 1.1], null_mut());
    // SAFETY: four points are there, and a place for the result.
    let status = unsafe { deldrift_create(2, positions.as_ptr(), 4, std::ptr::null(), &mut t) };
    assert_eq!(status, deldrift_status::DELDRIFT_OK);
    t
}

#[test]
fn panic_in_a_change_poisons_the_triangulation() {
    let (t, mut count) = (square(), 77);
    // SAFETY: `t` lives until its destruction at the end.
    unsafe {
        let status = Changing::new("t", t).change(|_| panic!("cell {} went missing", 13));
        assert_eq!(status, deldrift_status::DELDRIFT_INTERNAL_ERROR);
        assert!(
            message().contains("cell 13 went missing") && message().contains("panics.rs"),
            "{}",
            message()
        );

        assert_eq!(deldrift_cell_count(t, &mut count), deldrift_status::DELDRIFT_POISONED);
        assert_eq!(deldrift_commit_timestamp(t, null_mut()), deldrift_status::DELDRIFT_POISONED);
        assert_eq!(deldrift_validate(t, 1), deldrift_status::DELDRIFT_POISONED);
        assert!(message().contains("unusable"), "{}", message());
        assert_eq!(count, 77);
        deldrift_destroy(t);
    }
}

#[test]
fn panic_in_a_query_is_an_internal_error_and_no_more() {
    let (t, mut count) = (square(), 0);
    // SAFETY: `t` lives until its destruction at the end.
    unsafe {
        assert_eq!(Reading::new("t", t).read(|_| panic!("oh")), deldrift_status::DELDRIFT_INTERNAL_ERROR);
        assert_eq!(deldrift_cell_count(t, &mut count), deldrift_status::DELDRIFT_OK);
        assert_eq!(count, 2);
        deldrift_destroy(t);
    }
}

#[test]
#[cfg(not(miri))]
fn panic_leaves_the_environment_of_the_caller() {
    use crate::machine::environment::Environment;
    use crate::machine::environment::tests::{FOREIGN, IS_KNOWN, abroad, is_default_now};
    if !IS_KNOWN {
        return;
    }
    let t = square();
    // SAFETY: `t` lives until its destruction at the end.
    unsafe {
        let (status, after) = abroad(|| {
            let status = Changing::new("t", t).change(|_| {
                assert!(is_default_now());
                assert!(guard::call_back(Environment::current) == FOREIGN && is_default_now());
                panic!("{} of {}", 1.0 / 3.0, f64::NAN)
            });
            (status, Environment::current())
        });
        assert_eq!((status, after), (deldrift_status::DELDRIFT_INTERNAL_ERROR, FOREIGN));
        assert!(message().contains("0.333333333333") && message().contains("of NaN"), "{}", message());
        deldrift_destroy(t);
    }
}

#[test]
fn panic_on_another_thread_is_one_here() {
    let t = square();
    // SAFETY: `t` lives until its destruction at the end.
    unsafe {
        let status = Changing::new("t", t).change(|_| {
            threads::join(|| (), || panic!("cell {} went missing", 14));
            Ok(())
        });
        assert_eq!(status, deldrift_status::DELDRIFT_INTERNAL_ERROR);
        assert!(message().contains("cell 14 went missing"), "{}", message());
        assert_eq!(deldrift_validate(t, 1), deldrift_status::DELDRIFT_POISONED);
        deldrift_destroy(t);
    }
}

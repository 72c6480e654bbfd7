//! Two threads that write the same number, for ThreadSanitizer to find: see .ci/nightly.

static mut SHARED: u64 = 0;

fn increment() {
    for _ in 0..1000 {
        // SAFETY: there is none; that is the fault.
        unsafe { SHARED += 1 };
    }
}

fn main() {
    let other = std::thread::spawn(increment);
    increment();
    other.join().expect("no panic");
}

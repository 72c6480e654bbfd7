//! A static library of somebody else's that is written in Rust, too, and catches a panic of its own.

#[unsafe(no_mangle)]
pub extern "C" fn other_catches_a_panic() -> bool {
    let hook = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| {}));
    let outcome = std::panic::catch_unwind(|| panic!("planted"));
    std::panic::set_hook(hook);
    outcome.is_err()
}

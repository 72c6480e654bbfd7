//! libFuzzer's way to the target.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| deldrift_fuzz::loaders::run(data));

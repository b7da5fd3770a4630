//! See `eem_fuzz::laws`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| eem_fuzz::laws(data));

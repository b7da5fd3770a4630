//! See `eem_fuzz::expression`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| eem_fuzz::expression(data));

//! See `eem_fuzz::text`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| eem_fuzz::text(data));

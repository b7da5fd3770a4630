//! The module in the browser: the functions that a page calls by name, and the memory that it reads: texts as UTF-8, samples as
//! `f64`.
//!
//! A call that takes a text reads what the page has written into [`eem_room`]; one that answers with a text leaves it at
//! [`eem_text`] until the next call.

#![allow(
    unsafe_code,
    reason = "names that a page knows; there is no unsafe block, and no function of this name elsewhere"
)]

use std::sync::{Mutex, MutexGuard, PoisonError};

use eem_web::page::Page;
use eem_web::pendulum::SAMPLE;

/// A page, with the texts that go in and out.
struct Desk {
    page: Page,
    input: Vec<u8>,
    output: String,
}

static DESK: Mutex<Desk> = Mutex::new(Desk {
    page: Page::new(),
    input: Vec::new(),
    output: String::new(),
});

fn desk() -> MutexGuard<'static, Desk> {
    DESK.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Answers to the text that the page has written.
fn answer(with: impl FnOnce(&mut Page, &str) -> String) {
    let desk = &mut *desk();
    let text = String::from_utf8_lossy(&desk.input);
    desk.output = with(&mut desk.page, &text);
}

/// Where the page may write a text of so many bytes.
#[unsafe(no_mangle)]
extern "C" fn eem_room(bytes: usize) -> *mut u8 {
    let mut desk = desk();
    desk.input.clear();
    desk.input.resize(bytes, 0);
    desk.input.as_mut_ptr()
}

/// Where the last text begins.
#[unsafe(no_mangle)]
extern "C" fn eem_text() -> *const u8 {
    desk().output.as_ptr()
}

/// How many bytes it has.
#[unsafe(no_mangle)]
extern "C" fn eem_text_length() -> usize {
    desk().output.len()
}

/// Where the samples begin.
#[unsafe(no_mangle)]
extern "C" fn eem_samples() -> *const f64 {
    desk().page.samples().as_ptr()
}

/// How many numbers they have.
#[unsafe(no_mangle)]
extern "C" fn eem_samples_length() -> usize {
    desk().page.samples().len()
}

/// Numbers of one sample.
#[unsafe(no_mangle)]
extern "C" fn eem_sample_size() -> usize {
    SAMPLE
}

/// See [`Page::contents`].
#[unsafe(no_mangle)]
extern "C" fn eem_contents() {
    desk().output = Page::contents();
}

/// See [`Page::read`].
#[unsafe(no_mangle)]
extern "C" fn eem_read() {
    answer(Page::read);
}

/// See [`Page::start`].
#[unsafe(no_mangle)]
extern "C" fn eem_start() {
    answer(Page::start);
}

/// See [`Page::advance`].
#[unsafe(no_mangle)]
extern "C" fn eem_advance(run: usize, steps: usize) {
    let desk = &mut *desk();
    desk.output = desk.page.advance(run, steps);
}

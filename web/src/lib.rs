//! A pendulum of a material from a text, stepped with several schemes: what is behind the page in the browser.
//!
//! # Where to change what
//!
//! | to | look in |
//! |---|---|
//! | change what a text may say, or where mistakes are drawn | `sheet.rs` |
//! | change the scene, or what is measured | `pendulum.rs` |
//! | add an example | `examples.rs` |
//! | change what the page asks for | `page.rs`, then its caller `page/module.js` |
//! | add a function that the page calls | the crate in the folder `module` |

pub mod examples;
pub mod page;
pub mod pendulum;
pub mod sheet;

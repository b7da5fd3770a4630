//! Materials from texts in a running program: the language of `#[derive(FreeEnergy)]`, with the bits of the derive.
//!
//! ```text
//! texts ── compile ─▶ Compiled ── values ─▶ Law ── model ─▶ Typed: FreeEnergy ── Scene::spring, Scene::solid ─▶ elements
//! ```
//!
//! [`compile`] reads a [`Source`] and marks every mistake in the text; [`Law::new`] gives the parameters their values;
//! [`Law::model`] makes a material of a type that is known at compile time, a spring such as [`ThermalSpring1`] or a
//! [`solid!`]; [`Law::add_spring`] adds a spring of any shape: with or without temperature, with at most [`MOST_DASHPOTS`]
//! dashpots in series and one in parallel.
//!
//! ```
//! use eem::prelude::*;
//! use eem::typed::{Law, Source, Spring0, compile};
//!
//! let source = Source::new("|lambda: Stretch| 0.5 * k * ln(lambda / l).powi(2)")
//!     .parameter("k", Some("J"))
//!     .parameter("l", Some("m"));
//! let law = Law::new(compile(&source)?, &[("k", 30.0), ("l", 1.5)])?;
//! let spring: Spring0 = law.model()?;
//!
//! let mut scene = Scene::<1>::new();
//! let ends = [scene.anchor([0.0]), scene.mass(1.0, [3.0], [0.0])];
//! let typed = scene.spring(spring, ends);
//! let run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
//! assert_eq!(run.force(typed)?, 30.0 * 2.0_f64.ln() / 3.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Operations are interpreted one by one, so a step of the pendulum with one dashpot takes 1.9 times the instructions of the
//! derived material (`EemTemperature`), or 2.3 times (`EemEntropy`). Six springs of one law or more that follow one another are
//! evaluated up to 32 at a time: a step of a lattice of 10⁴ springs takes 1.2 (`EemTemperature`) to 1.4 (`EemEntropy`) times the
//! instructions of derived ones. A law takes some 11 ms to compile and make: do that once, and clone the spring.
//!
//! # Where to change what
//!
//! | to | look in |
//! |---|---|
//! | add an operation or an elementary function | `tape/instruction.rs`, `tape/fold.rs`, `tape/lower.rs`: the compiler lists them |
//! | change which operations are joined, or how registers are allocated | `tape/lower.rs`, `tape/allocate.rs` |
//! | change what is kept of the old state, and how much | `functions/staged.rs`; `kept` in `shape.rs` |
//! | evaluate several springs at a time | `run_rows` in `tape.rs`, `typed/together.rs`; the caller is `element/group/ahead.rs` in `eem-runtime` |
//! | change derivatives with respect to parameters | `functions/by_parameters.rs`, their names in `names.rs`; programs are made at the first derivative |
//! | add a shape | the types of springs, and `solid!`, in `shapes.rs`; what a type says of its law: `shape.rs` |
//! | change what is at the places of dashpots and of a temperature that a law lacks | `functions/room.rs` |

mod error;
mod functions;
mod law;
mod names;
mod shape;
mod shapes;
mod tape;
mod typed;

pub use eem_language::text::{
    Argument, Compiled, Fault, Faults, Formula, Level, Part, Source, compile,
};
pub use error::LawError;
pub use law::Law;
#[doc(hidden)]
pub use shape::KEPT;
pub use shape::{Flow, MOST_DASHPOTS, Measures, Strains, Stretch};
pub use shapes::*;
pub use typed::Typed;

//! The mathematics behind `eem`, without tokens and without dependencies.
//!
//! A free energy is an expression in a hash-consed [`Graph`]. Passes over it are pure functions of
//! the graph: partial derivatives ([`diff`]), divided differences that never subtract neighbouring
//! function values ([`divided_difference`]), the internal energy `ψ − θ ∂ψ/∂θ` simplified term by
//! term ([`internal_energy`]). A [`Model`] turns a free energy into [`Program`]s: straight-line
//! code with shared subexpressions, verified, and executable by [`Program::interpret`].
//!
//! The same input gives the same graph, formulas and programs, byte for byte.
//!
//! ```
//! use eem_symbolic::{Graph, diff, divided_difference, format};
//!
//! let mut graph = Graph::new();
//! let x = graph.symbol("x");
//! let at = graph.variable(x);
//! let ln = graph.apply(eem_symbolic::Function::Ln, at);
//! let e = graph.product(&[at, ln]);
//! let slope = diff(&mut graph, e, x);
//! assert_eq!(format(&graph, slope), "ln(x) + 1");
//!
//! let (a, b) = (graph.version(x, "a"), graph.version(x, "b"));
//! let (a, b) = (graph.variable(a), graph.variable(b));
//! let secant = divided_difference(&mut graph, e, x, a, b);
//! assert_eq!(format(&graph, secant), "0.5*((a + b)*ln[a, b] + ln(a) + ln(b))");
//! ```
//!
//! # Where to change what
//!
//! | to | look in |
//! |---|---|
//! | add an elementary function | its row in `function.rs`; the compiler then lists the passes to extend. Then its kernel in `eem-material/src/number/kernel` |
//! | change what is generated | `programs.rs`, `discrete`; the printer is `expand` in `eem-language` |
//! | compute several values in one call | an `Operation` in `operation.rs`, chosen in `joint.rs` |
//! | change the order of operations, or what is shared | `schedule`, `factor.rs`; `discrete/logarithm.rs` for what an iteration can reuse |
//! | change the derivatives by the parameters | `parameters.rs` |
//! | differentiate a program | the rules in `sweep.rs`, used backwards by `adjoint.rs` and forwards by `tangent.rs` |
//! | detect impossible models | `flaw.rs`, `sign.rs`, `range.rs` |
//! | change the bound for the rounding of ψ | `magnitude.rs` |

#![forbid(unsafe_code)]

// Expressions.
mod derivative;
mod difference;
mod function;
mod graph;
mod node;
mod number;
mod order;
mod power;
mod product;
mod sum;

// Passes over expressions.
mod diff;
mod display;
mod divided_difference;
mod factor;
mod internal_energy;
mod lower_bound;
mod magnitude;
mod range;
mod sign;
mod substitute;

// Programs.
mod adjoint;
mod composer;
mod cost;
mod difference_formulas;
mod discrete;
mod flaw;
mod formulas;
mod interpret;
mod joint;
mod model;
mod operation;
mod parameters;
mod program;
mod programs;
mod quadrature;
mod running_error;
mod schedule;
mod sweep;
mod tangent;
mod verify;
mod verify_error;

pub use diff::{diff, diff_total};
pub use display::format;
pub use divided_difference::divided_difference;
pub use function::Function;
pub use graph::Graph;
pub use internal_energy::internal_energy;
pub use lower_bound::LowerBound;
pub use magnitude::magnitude;
pub use node::{ExprId, Kernel, Node, Symbol};
pub use number::{Number, Rational};
pub use range::{Range, range};
pub use sign::{Sign, sign};
pub use substitute::substitute;

pub use adjoint::adjoint;
pub use cost::{OperationCount, StageCount, TranscendentalCount};
pub use difference_formulas::DifferenceFormula;
pub use flaw::Flaw;
pub use formulas::Formulas;
pub use interpret::{Arithmetic, F64, JointDifferences};
pub use joint::Restriction;
pub use model::Model;
pub use operation::{DifferencePart, Operation, ProgramKernel, Value};
pub use parameters::ParameterPrograms;
pub use program::{Input, Instruction, Program, Stage};
pub use programs::Programs;
pub use running_error::{Bounded, RunningError};
pub use schedule::schedule;
pub use tangent::tangent;
pub use verify_error::VerifyError;

/// The example of the README is part of the tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

//! What `eem-symbolic` says of expressions and programs, against high precision, known results and bounds.

#[path = "../growing/mod.rs"]
mod growing;
#[path = "../support/mod.rs"]
mod support;

mod oracle;
mod reader;

mod derivatives;
mod determinism;
mod discrete_forms;
mod display;
mod divided_differences;
mod flaws;
mod growth;
mod internal_energy;
mod interpreter;
mod joint_differences;
mod laws;
mod magnitudes;
mod parameters;
mod programs;
mod random_expressions;
mod sweeps;

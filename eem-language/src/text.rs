//! Models as texts: the same language, checked like the attributes of a struct, while the program runs.
//!
//! A [`Source`] has a free energy, viscosities, and parameters with their units. [`compile`] reads each of them on its
//! own and gives a model with its [programs](Compiled::programs), or all mistakes with their places:
//!
//! ```
//! use eem_language::text::{Source, compile};
//!
//! let source = Source::new("|lambda: Stretch| {
//!     let strain = ln(lamda / length);
//!     0.5 * stiffness * strain.powi(2)
//! }")
//! .parameter("stiffness", Some("J"))
//! .parameter("length", Some("m"));
//! let faults = compile(&source).unwrap_err();
//! assert_eq!(
//!     faults.to_string(),
//!     "error: unknown name `lamda`
//!  --> psi, line 2, column 21
//!   |
//! 2 |     let strain = ln(lamda / length);
//!   |                     ^^^^^
//!   = help: did you mean `lambda`?"
//! );
//! ```
//!
//! The language is that of `#[derive(FreeEnergy)]`, with parameters instead of fields. A text belongs to no program, so
//! that it has no constants but those of the standard library: `PI`, `core::f64::consts::SQRT_2`.

mod compiled;
mod fault;
mod part;
pub(crate) mod reader;
mod source;
mod stack;

pub use crate::ast::{Joint, Strain};
use crate::attr::Attributes;
use crate::ctxt::Ctxt;
use crate::dialect::Dialect;
use crate::units::Quantities;
use crate::{check, derive, message, parse};
pub use compiled::{Argument, Compiled, Formula};
pub use fault::{Fault, Faults, Level};
pub use part::Part;
use reader::Reader;
pub use source::{LONGEST, Source};

/// Reads and checks all texts of a model.
///
/// A formula has at most [`LONGEST`] bytes, a name or a unit 256, and brackets and operators are nested some hundred times
/// at most. The work is done on a thread with a stack of its own. Where there are no threads, as in a browser, it is done
/// on the calling thread, which needs a stack of some MiB for deeply nested formulas; at the end, the places of all tokens
/// that `proc-macro2` has kept for that thread are forgotten.
///
/// # Errors
///
/// All mistakes, in the order of the source. If a text is not even made of tokens, such as one with an open parenthesis,
/// or a name is invalid, only such mistakes are reported, and the formulas are not checked.
///
/// # Panics
///
/// Inside of a procedural macro, where the compiler has the places of tokens.
///
/// ```
/// use eem_language::text::{Source, compile};
///
/// let source = Source::new("|lambda: Stretch, gamma: Viscous| 0.5 * k * (lambda - gamma).powi(2)")
///     .viscosity("gamma", "eta")
///     .parameter("k", None)
///     .parameter("eta", None);
/// let compiled = compile(&source).unwrap();
/// assert_eq!(compiled.model().measures.len(), 1);
/// assert_eq!(compiled.model().dashpots.len(), 1);
///
/// let faults = compile(&source.parameter("unused", None)).unwrap_err();
/// assert_eq!(faults.all()[0].text, "neither the free energy nor a viscosity uses `unused`");
/// ```
pub fn compile(source: &Source) -> Result<Compiled, Faults> {
    stack::on_deep_stack(|| {
        let result = compile_in(source, Dialect::Text);
        // Without threads, the calling thread lives on and would keep every text.
        reader::forget_places();
        result
    })
}

/// The same with messages in a dialect, which tests choose.
pub(crate) fn compile_in(source: &Source, dialect: Dialect) -> Result<Compiled, Faults> {
    let mut reader = Reader::new(dialect);
    let Some(input) = reader.read(source) else {
        return Err(reader.take_faults());
    };
    let cx = Ctxt::new(dialect);
    let attributes = Attributes::from_syn(&cx, &input);
    let parsed = parse::input(&cx, &input, &attributes);
    let checked = parsed.as_ref().map(|parsed| check::check(&cx, parsed));
    let model = checked.as_ref().and_then(|c| derive::model(&cx, c));
    for report in cx.take_reports() {
        reader.report(Level::Error, report.span(), &report.message, report.calls);
    }
    let faults = reader.take_faults();
    let (Some(checked), Some((model, _)), []) = (checked, model, faults.all()) else {
        return Err(faults);
    };
    let value = syn::spanned::Spanned::span(checked.energy.value.original);
    let too_large = message::attribute::physics::factor_too_large();
    reader.report(Level::Error, value, &too_large, Vec::new());
    let too_large = reader.take_faults();
    for (span, message) in cx.take_warnings() {
        reader.report(Level::Warning, span, &message, Vec::new());
    }
    let warnings = reader.take_faults();
    let measures = (checked.strains().collect(), checked.joints().collect());
    let arguments = (checked.arguments(), Quantities::of(checked.per_volume()));
    Ok(Compiled::new(
        source,
        model,
        arguments,
        measures,
        [too_large, warnings],
    ))
}

//! A model that came from texts.

use std::sync::OnceLock;

use eem_symbolic::{Model, Programs};

use super::fault::{Fault, Faults};
use super::source::Source;
use super::stack::on_deep_stack;

/// A model whose texts are right.
///
/// ```
/// use eem_language::text::{Source, compile};
/// use eem_symbolic::F64;
///
/// let source = Source::new("|lambda: Stretch| 0.5 * k * (lambda - 1).powi(2)").parameter("k", None);
/// let compiled = compile(&source).unwrap();
/// let psi = &compiled.programs().unwrap().free_energy;
/// // k, lambda
/// assert_eq!(psi.interpret(&F64, &[100.0, 1.5]), [12.5]);
/// ```
#[derive(Clone, Debug)]
pub struct Compiled {
    source: Source,
    model: Model,
    /// Nothing if a number in them does not fit.
    programs: OnceLock<Option<Programs>>,
    /// What is said in that case.
    too_large: Faults,
    warnings: Vec<Fault>,
}

impl Compiled {
    pub(super) fn new(source: &Source, model: Model, too_large: Faults, warnings: Faults) -> Self {
        Self {
            source: source.clone(),
            model,
            programs: OnceLock::new(),
            too_large,
            warnings: warnings.0,
        }
    }

    /// The texts.
    ///
    /// ```
    /// use eem_language::text::{Source, compile};
    ///
    /// let source = Source::new("|lambda: Stretch| lambda.powi(2)");
    /// assert_eq!(compile(&source).unwrap().source(), &source);
    /// ```
    #[must_use]
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// ψ and the viscosities as expressions; the parameters are those that they mention, in the order of the source,
    /// every entry of an array for itself.
    ///
    /// ```
    /// use eem_language::text::{Source, compile};
    ///
    /// let source = Source::new("|lambda: Stretch| (k[0] + k[1] * b) * lambda.powi(2)");
    /// let source = source.parameter("b", None).parameter("k[2]", None);
    /// let compiled = compile(&source).unwrap();
    /// let model = compiled.model();
    /// let names: Vec<_> = model.parameters.iter().map(|&k| model.graph.name(k)).collect();
    /// assert_eq!(names, ["b", "k[0]", "k[1]"]);
    /// ```
    #[must_use]
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The programs of the model, which are made at the first call: the same that the derive prints.
    ///
    /// # Errors
    ///
    /// If a derivative has a factor that does not fit an `f64`: the fault is at the value of ψ.
    ///
    /// ```
    /// use eem_language::text::{Source, compile};
    ///
    /// let source = Source::new("|lambda: Stretch| 1e200 * (1e200 * lambda).powi(2)");
    /// let compiled = compile(&source).unwrap();
    /// let faults = compiled.programs().unwrap_err();
    /// assert!(faults.all()[0].text.ends_with("has a factor that does not fit an `f64`"));
    /// assert_eq!(faults.all()[0].column, 19);
    /// ```
    pub fn programs(&self) -> Result<&Programs, Faults> {
        let make = || {
            let programs = self.model.programs();
            programs.verify().is_ok().then_some(programs)
        };
        let programs = self.programs.get_or_init(|| on_deep_stack(make));
        programs.as_ref().ok_or_else(|| self.too_large.clone())
    }

    /// What is accepted and loses digits, in the order of the source.
    ///
    /// ```
    /// use eem_language::text::{Source, compile};
    ///
    /// let source = Source::new("|e1: StrainTrace| ln(1 + e1).powi(2)");
    /// let compiled = compile(&source).unwrap();
    /// let warning = &compiled.warnings()[0];
    /// assert_eq!(warning.help, "write `ln_1p(x)` for `ln(1 + x)`");
    /// assert!(warning.to_string().starts_with("warning: `ln(1 + e1)` is inaccurate"));
    /// ```
    #[must_use]
    pub fn warnings(&self) -> &[Fault] {
        &self.warnings
    }
}

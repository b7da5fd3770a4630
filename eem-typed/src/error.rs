//! Errors of laws whose texts are right.

use eem_language::text::Faults;

/// Why there is no law, or no spring of it.
///
/// ```
/// use eem::typed::{Law, LawError, Source, compile};
///
/// let source = Source::new("|lambda: Stretch| 0.5 * k * (lambda - l).powi(2)");
/// let source = source.parameter("k", Some("N/m")).parameter("l", Some("m"));
/// let compiled = compile(&source).unwrap();
/// let error = Law::new(compiled, &[("k", 40.0)]).unwrap_err();
/// assert_eq!(error.to_string(), "parameter `l` has no value: give each parameter one");
/// assert!(matches!(error, LawError::Missing { .. }));
/// ```
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LawError {
    /// A parameter without a value.
    #[error("parameter `{name}` has no value: give each parameter one")]
    Missing {
        /// The parameter.
        name: String,
    },
    /// A value for a name that is not that of a parameter.
    #[error("there is no parameter `{name}` for the value {value:?}: {help}")]
    Unknown {
        /// The name as it was given.
        name: String,
        /// Its value.
        value: f64,
        /// The names of the parameters.
        help: String,
    },
    /// Two values for one parameter.
    #[error("parameter `{name}` has two values, {first:?} and {second:?}: give one")]
    Repeated {
        /// The parameter.
        name: String,
        /// The first value.
        first: f64,
        /// The second value.
        second: f64,
    },
    /// A value that is infinite or NaN.
    #[error("parameter `{name}` is {value:?}, which is not finite: give a number")]
    NotFinite {
        /// The parameter.
        name: String,
        /// Its value as it was given.
        value: f64,
    },
    /// A number in a derivative of ψ does not fit an `f64`.
    #[error("{0}")]
    Programs(Faults),
    /// The free energy is a function of strains.
    #[error(
        "the free energy is per volume, that of a solid: a spring has a `Stretch`; call `model`"
    )]
    Solid,
    /// More dashpots in series than there are springs for.
    #[error("the law has {dashpots} dashpots in series: a spring made of texts has at most {most}")]
    Dashpots {
        /// Their number.
        dashpots: usize,
        /// The largest number.
        most: usize,
    },
    /// The type of the material is for laws with other variables.
    #[error("the law has {law}; the type of the material has {material}")]
    Shape {
        /// The variables of the law.
        law: String,
        /// The variables of a law of the type.
        material: String,
    },
    /// A formula needs more numbers at a time than there is room for.
    #[error("the formulas need {numbers} numbers at a time, at most {most}: shorten them")]
    TooLarge {
        /// The number needed.
        numbers: usize,
        /// The largest number.
        most: usize,
    },
    /// Numbers that do not make whole states.
    #[error("{numbers} numbers do not make whole states of {variables}")]
    States {
        /// The number of numbers.
        numbers: usize,
        /// The number of variables of a state.
        variables: usize,
    },
    /// A name that a law cannot have.
    #[error("a law cannot have the name `{name}`: {why}")]
    Name {
        /// The name, or its beginning.
        name: String,
        /// What is wrong with it.
        why: &'static str,
    },
}

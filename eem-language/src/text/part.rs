//! The parts of a source.

use std::fmt::{self, Display, Formatter};

/// Characters of a name that a place shows.
const SHOWN: usize = 40;

/// The text in which a fault is.
///
/// ```
/// use eem_language::text::{Part, Source, compile};
///
/// let source = Source::new("|x: Stretch| k * x").parameter("k", Some("Newton"));
/// let faults = compile(&source).unwrap_err();
/// assert_eq!(faults.all()[0].part, Part::Unit("k".to_owned()));
/// assert_eq!(faults.all()[0].part.to_string(), "unit of `k`");
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Part {
    /// The free energy, `psi`.
    FreeEnergy,
    /// The name for which a viscosity was given.
    Dashpot(String),
    /// The viscosity of this name.
    Viscosity(String),
    /// The name of a parameter.
    Parameter(String),
    /// The unit of the parameter of this name.
    Unit(String),
}

impl Display for Part {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::FreeEnergy => f.write_str("psi"),
            Self::Dashpot(name) => write!(f, "name of the viscosity `{}`", short(name)),
            Self::Viscosity(name) => write!(f, "viscosity of `{}`", short(name)),
            Self::Parameter(name) => write!(f, "parameter `{}`", short(name)),
            Self::Unit(name) => write!(f, "unit of `{}`", short(name)),
        }
    }
}

/// The name on one line and shortened if it is long: names may be any text.
pub(super) fn short(name: &str) -> String {
    let mut name = name.chars();
    let visible = |c: char| if c.is_control() { ' ' } else { c };
    let start: String = name.by_ref().take(SHOWN).map(visible).collect();
    match name.next() {
        Some(_) => start + "…",
        None => start,
    }
}

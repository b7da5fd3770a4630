//! Names of schemes, as command lines and files have them.

use core::fmt;
use core::str::FromStr;

use crate::step::scheme::Scheme;

impl Scheme {
    /// The scheme of this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        named().find(|scheme| scheme.name() == name)
    }
}

impl fmt::Display for Scheme {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// There is no scheme of this name; the message lists those there are.
///
/// ```
/// use eem::Scheme;
///
/// assert_eq!("eem-entropy".parse(), Ok(Scheme::EemEntropy));
/// let error = "euler".parse::<Scheme>().unwrap_err();
/// assert!(error.to_string().starts_with("no scheme is named `euler`; there are eem-entropy, "));
/// ```
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no scheme is named `{name}`; there are {}", names())]
pub struct UnknownScheme {
    /// What was asked for.
    pub name: String,
}

/// All that have a name.
fn named() -> impl Iterator<Item = Scheme> {
    Scheme::ALL.into_iter().chain([Scheme::Auto])
}

fn names() -> String {
    let names: Vec<_> = named().map(Scheme::name).collect();
    names.join(", ")
}

impl FromStr for Scheme {
    type Err = UnknownScheme;

    fn from_str(name: &str) -> Result<Self, UnknownScheme> {
        Self::from_name(name).ok_or_else(|| UnknownScheme {
            name: name.to_owned(),
        })
    }
}

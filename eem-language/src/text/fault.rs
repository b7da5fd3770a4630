//! Faults: what is wrong, where, and how it is drawn.

use std::error::Error;
use std::fmt::{self, Display, Formatter};

use super::part::Part;
use crate::message::calls_shown;

/// Characters of a line that are drawn.
const WIDEST: usize = 160;
/// Characters before the fault that are drawn of a line that is too long.
const BEFORE: usize = 60;

/// A mistake in a text, or a warning.
///
/// `Display` draws it:
///
/// ```
/// use eem_language::text::{Source, compile};
///
/// let source = Source::new("|x: Stretch| k * x ^ 2").parameter("k", None);
/// let faults = compile(&source).unwrap_err();
/// let fault = &faults.all()[0];
/// assert_eq!((fault.line, fault.column, fault.width), (1, 20, 1));
/// assert_eq!(fault.text, "`^` is not a power");
/// assert_eq!(fault.help, "write `x.powi(2)` or `x.powf(y)`");
/// assert_eq!(
///     fault.to_string(),
///     "error: `^` is not a power
///  --> psi, line 1, column 20
///   |
/// 1 | |x: Stretch| k * x ^ 2
///   |                    ^
///   = help: write `x.powi(2)` or `x.powf(y)`"
/// );
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Fault {
    /// Whether there is a model in spite of the fault.
    pub level: Level,
    /// The text in which it is.
    pub part: Part,
    /// Line in the text, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// Characters from there on; to the end of the line if it goes on in the next.
    pub width: usize,
    /// What is wrong.
    pub text: String,
    /// What to write instead.
    pub help: String,
    /// The calls of helpers in which the fault shows, as quoted; empty outside of helpers.
    pub calls: Vec<String>,
    pub(super) drawing: Drawing,
}

/// The line of a fault, or the part around the fault if the line is long.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Drawing {
    line: String,
    /// Characters before the place.
    before: usize,
    /// Characters of the place.
    width: usize,
}

impl Drawing {
    /// `column` counts from 0.
    pub(super) fn new(line: &str, column: usize, width: usize) -> Self {
        // A tab would move what is behind it away from its caret.
        let visible = |c: char| if c.is_control() { ' ' } else { c };
        let start = if line.chars().nth(WIDEST).is_some() {
            column.saturating_sub(BEFORE)
        } else {
            0
        };
        let mut rest = line.chars().skip(start).map(visible);
        let mut shown: String = rest.by_ref().take(WIDEST).collect();
        if start > 0 {
            shown = shown.chars().skip(1).collect();
            shown.insert(0, '…');
        }
        if rest.next().is_some() {
            shown.push('…');
        }
        let before = column - start;
        Self {
            line: shown,
            before,
            width: width.min(WIDEST.saturating_sub(before)).max(1),
        }
    }
}

/// The severity of a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Level {
    /// There is no model.
    Error,
    /// Results lose digits, for example.
    Warning,
}

impl Display for Level {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Error => "error",
            Self::Warning => "warning",
        })
    }
}

impl Display for Fault {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { line, column, .. } = self;
        let margin = " ".repeat(line.to_string().len());
        let Drawing {
            line: drawn,
            before,
            width,
        } = &self.drawing;
        writeln!(f, "{}: {}", self.level, self.text)?;
        writeln!(f, "{margin}--> {}, line {line}, column {column}", self.part)?;
        writeln!(f, "{margin} |")?;
        writeln!(f, "{}", format!("{line} | {drawn}").trim_end())?;
        let (before, carets) = (" ".repeat(*before), "^".repeat(*width));
        writeln!(f, "{margin} | {before}{carets}")?;
        for call in calls_shown(&self.calls) {
            writeln!(f, "{margin} = {call}")?;
        }
        write!(f, "{margin} = help: {}", self.help)
    }
}

/// All mistakes of a model, in the order of the source: ψ, viscosities, parameters; mistakes in a name come before
/// those in its law or unit.
///
/// `Display` draws them all:
///
/// ```
/// use eem_language::text::{Source, compile};
///
/// let source = Source::new("|x: Stretch| k * y + z").parameter("k", None);
/// let faults = compile(&source).unwrap_err();
/// let texts: Vec<_> = faults.all().iter().map(|fault| fault.text.as_str()).collect();
/// assert_eq!(texts, ["unknown name `y`", "unknown name `z`"]);
/// assert_eq!(faults.to_string().matches("--> psi, line 1").count(), 2);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Faults(pub(super) Vec<Fault>);

impl Faults {
    /// The mistakes, at least one.
    #[must_use]
    pub fn all(&self) -> &[Fault] {
        &self.0
    }
}

impl Display for Faults {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for (index, fault) in self.0.iter().enumerate() {
            let gap = if index == 0 { "" } else { "\n\n" };
            write!(f, "{gap}{fault}")?;
        }
        Ok(())
    }
}

impl Error for Faults {}

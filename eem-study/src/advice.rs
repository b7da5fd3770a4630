//! Recommending a setting for an accuracy.

use core::fmt;

use crate::error::StudyError;
use crate::quantity::{DOUBT, StateQuantity};
use crate::report::StudyReport;
use crate::row::{StudyRow, largest};
use eem_material::number::readable::Readable;

/// A recommendation for an accuracy; `Display` prints it in words.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Recommendation<'a> {
    /// The largest relative error that is allowed, in every kind of quantity at the end time.
    pub accuracy: f64,
    /// The advice.
    pub advice: Advice<'a>,
}

/// The advice for an accuracy.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Advice<'a> {
    /// These settings are accurate enough, even with the uncertainty of the reference added to their errors.
    Take {
        /// The fastest of all settings.
        fastest: &'a StudyRow,
        /// The fastest setting whose scheme proves energy, entropy and momenta in every step.
        lawful: Option<&'a StudyRow>,
    },
    /// No setting is accurate enough.
    NoneReaches {
        /// The most accurate one.
        closest: Option<&'a StudyRow>,
    },
    /// The accuracy cannot be judged because the references differ by more than a hundredth of it.
    Refused {
        /// The quantity in which they differ most.
        quantity: StateQuantity,
        /// Their difference.
        doubt: f64,
    },
}

impl StudyReport {
    /// The fastest settings with errors of at most `accuracy` in every kind of quantity at the end time.
    ///
    /// # Errors
    ///
    /// [`StudyError::Accuracy`] if it is not positive and finite.
    pub fn recommend(&self, accuracy: f64) -> Result<Recommendation<'_>, StudyError> {
        check_accuracy(accuracy)?;
        let doubts = StateQuantity::ALL.into_iter();
        let doubts =
            doubts.filter_map(|quantity| Some((quantity, self.reference.doubt(quantity)?)));
        let worst = doubts.reduce(|a, b| if b.1 > a.1 || b.1.is_nan() { b } else { a });
        let is_known = worst.is_none_or(|(_, doubt)| doubt <= DOUBT * accuracy);
        let advice = match worst.filter(|_| !is_known) {
            Some((quantity, doubt)) => Advice::Refused { quantity, doubt },
            None => self.advice(accuracy),
        };
        Ok(Recommendation { accuracy, advice })
    }

    fn advice(&self, accuracy: f64) -> Advice<'_> {
        let within = || {
            let rows = self.rows.iter();
            rows.filter(move |row| row.is_within(accuracy))
        };
        let fastest = |a: &&StudyRow, b: &&StudyRow| a.seconds.total_cmp(&b.seconds);
        let lawful = within().filter(|row| row.setting.scheme.is_exact());
        match within().min_by(fastest) {
            Some(row) => Advice::Take {
                fastest: row,
                lawful: lawful.min_by(fastest),
            },
            None => Advice::NoneReaches {
                closest: self.closest(),
            },
        }
    }

    /// The most accurate row.
    fn closest(&self) -> Option<&StudyRow> {
        let rows = self.rows.iter();
        let rows = rows.filter_map(|row| Some((row, largest(&row.differences)?)));
        let rows = rows.filter(|(_, difference)| difference.is_finite());
        let least = rows.min_by(|a, b| a.1.total_cmp(&b.1));
        least.map(|(row, _)| row)
    }
}

impl StudyRow {
    /// Whether every error plus the uncertainty of the reference is within an accuracy.
    fn is_within(&self, accuracy: f64) -> bool {
        let pairs = self.differences.iter().zip(&self.doubts);
        let errors = pairs.filter_map(|(difference, doubt)| Some((*difference)? + (*doubt)?));
        let mut errors = errors.peekable();
        errors.peek().is_some() && errors.all(|error| error <= accuracy)
    }
}

/// An error unless an accuracy is positive and finite.
pub(crate) fn check_accuracy(accuracy: f64) -> Result<(), StudyError> {
    if accuracy > 0.0 && accuracy.is_finite() {
        Ok(())
    } else {
        Err(StudyError::Accuracy { accuracy })
    }
}

impl fmt::Display for Recommendation<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let accuracy = Readable(self.accuracy);
        write!(f, "For errors of at most {accuracy}: ")?;
        match self.advice {
            Advice::Take { fastest, lawful } => {
                let words = words(fastest);
                match lawful {
                    Some(lawful) if lawful == fastest => {
                        write!(f, "{words}, which is the fastest and keeps the laws.")
                    }
                    Some(lawful) => {
                        let lawful = self::words(lawful);
                        write!(
                            f,
                            "{lawful}, which keeps the laws; fastest of all is {words}."
                        )
                    }
                    None => write!(
                        f,
                        "{words}, the fastest; none that keeps the laws is so accurate."
                    ),
                }
            }
            Advice::NoneReaches {
                closest: Some(closest),
            } => {
                let error = largest(&closest.differences).unwrap_or(f64::NAN);
                let setting = closest.setting;
                write!(
                    f,
                    "no setting reaches it; {setting} comes closest with {error:.1e}. Try smaller steps."
                )
            }
            Advice::NoneReaches { closest: None } => {
                write!(f, "no run reaches the end time. Try smaller steps.")
            }
            Advice::Refused { quantity, doubt } => write!(
                f,
                "refused. The two references differ by {doubt:.1e} in the {quantity}, more than 1 % of it. \
                 Ask for less accuracy, end the runs earlier, or give references of your own."
            ),
        }
    }
}

/// A setting and its cost.
fn words(row: &StudyRow) -> String {
    let milliseconds = 1e3 * row.seconds;
    let (setting, steps) = (row.setting, row.steps);
    format!("{setting} ({steps} steps, {milliseconds:.2} ms)")
}

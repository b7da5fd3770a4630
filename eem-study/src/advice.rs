//! Recommending a setting for an accuracy.

use core::fmt;

use crate::error::{StudyError, listed};
use crate::quantity::{DOUBT, StateQuantity};
use crate::report::StudyReport;
use crate::row::{StudyRow, largest};
use eem_material::number::readable::Readable;

/// A recommendation for an accuracy; `Display` prints it in words.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Recommendation<'a> {
    /// The largest relative error that is allowed, in each of these kinds of quantities at the end time.
    pub accuracy: f64,
    /// The kinds of quantities.
    pub quantities: Vec<StateQuantity>,
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
        Ok(self.recommendation(accuracy, StateQuantity::ALL.to_vec()))
    }

    /// The same for errors in some kinds of quantities only.
    ///
    /// ```
    /// use eem::materials::ThermoelasticSpring;
    /// use eem::prelude::*;
    /// use eem::StateQuantity;
    ///
    /// fn scene() -> Scene<1> {
    ///     let mut scene = Scene::new();
    ///     let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.3], [0.0])];
    ///     let spring = ThermoelasticSpring {
    ///         stiffness: 4.0,
    ///         coupling: 0.1,
    ///         capacity: 10.0,
    ///         natural_length: 1.0,
    ///         theta_ref: 300.0,
    ///     };
    ///     let spring = scene.spring(spring, ends);
    ///     scene.set_temperature(spring, 310.0);
    ///     scene
    /// }
    ///
    /// // The temperature hardly changes: large steps find it.
    /// let report = Study::new(scene, 1.0).settings(Setting::halved(Scheme::EemTemperature, 0.1, 3)).run()?;
    /// let recommended = report.recommend_for(&[StateQuantity::Temperatures], 1e-6)?;
    /// assert!(matches!(recommended.advice, Advice::Take { .. }));
    /// assert!(matches!(report.recommend(1e-6)?.advice, Advice::NoneReaches { .. }));
    /// # Ok::<(), eem::StudyError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`StudyError::Accuracy`] if the accuracy is not positive and finite; [`StudyError::NoSuchQuantity`] if the scene has
    /// none of these kinds.
    pub fn recommend_for(
        &self,
        quantities: &[StateQuantity],
        accuracy: f64,
    ) -> Result<Recommendation<'_>, StudyError> {
        check_accuracy(accuracy)?;
        let doubts = self.reference.doubts();
        let is_there = |quantity: &StateQuantity| doubts[quantity.index()].is_some();
        if !quantities.iter().any(is_there) {
            let quantities = quantities.to_vec();
            return Err(StudyError::NoSuchQuantity { quantities });
        }
        Ok(self.recommendation(accuracy, quantities.to_vec()))
    }

    fn recommendation(&self, accuracy: f64, quantities: Vec<StateQuantity>) -> Recommendation<'_> {
        let doubts = quantities.iter();
        let doubts =
            doubts.filter_map(|&quantity| Some((quantity, self.reference.doubt(quantity)?)));
        let worst = doubts.reduce(|a, b| if b.1 > a.1 || b.1.is_nan() { b } else { a });
        let is_known = worst.is_none_or(|(_, doubt)| doubt <= DOUBT * accuracy);
        let advice = match worst.filter(|_| !is_known) {
            Some((quantity, doubt)) => Advice::Refused { quantity, doubt },
            None => self.advice(accuracy, &quantities),
        };
        Recommendation {
            accuracy,
            quantities,
            advice,
        }
    }

    fn advice(&self, accuracy: f64, quantities: &[StateQuantity]) -> Advice<'_> {
        let within = || {
            let rows = self.rows.iter();
            rows.filter(move |row| row.is_within(accuracy, quantities))
        };
        let fastest = |a: &&StudyRow, b: &&StudyRow| a.seconds.total_cmp(&b.seconds);
        let lawful = within().filter(|row| row.setting.scheme.is_exact());
        match within().min_by(fastest) {
            Some(row) => Advice::Take {
                fastest: row,
                lawful: lawful.min_by(fastest),
            },
            None => Advice::NoneReaches {
                closest: self.closest(quantities),
            },
        }
    }

    /// The most accurate row.
    fn closest(&self, quantities: &[StateQuantity]) -> Option<&StudyRow> {
        let rows = self.rows.iter();
        let rows = rows.filter_map(|row| Some((row, largest(&row.differences, quantities)?)));
        let rows = rows.filter(|(_, difference)| difference.is_finite());
        let least = rows.min_by(|a, b| a.1.total_cmp(&b.1));
        least.map(|(row, _)| row)
    }
}

impl StudyRow {
    /// Whether every error plus the uncertainty of the reference is within an accuracy.
    fn is_within(&self, accuracy: f64, quantities: &[StateQuantity]) -> bool {
        let error = |quantity: &StateQuantity| {
            let index = quantity.index();
            Some(self.differences[index]? + self.doubts[index]?)
        };
        let mut errors = quantities.iter().filter_map(error).peekable();
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
        write!(f, "For errors of at most {accuracy}")?;
        if self.quantities != StateQuantity::ALL {
            write!(f, " in the {}", listed(&self.quantities))?;
        }
        f.write_str(": ")?;
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
                let error = largest(&closest.differences, &self.quantities).unwrap_or(f64::NAN);
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

//! The results of a study: a row per setting, and the references.

use crate::quantity::StateQuantity;
use crate::reference::StudyReference;
use crate::row::StudyRow;
use eem_runtime::Scheme;

/// The result of [`Study::run`](crate::Study::run).
///
/// `Display` prints a table, the reference and a recommendation for each accuracy.
///
/// ```
/// use eem::materials::Hooke;
/// use eem::prelude::*;
/// use eem::{Advice, Setting, Study, StudyReport};
///
/// fn scene() -> Scene<1> {
///     let mut scene = Scene::new();
///     let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.5], [0.0])];
///     scene.spring(Hooke { stiffness: 4.0, natural_length: 1.0 }, ends);
///     scene
/// }
///
/// // A mass that swings with ω = 2/s; the scheme's error in the phase ωt is (ωh)²ωt/12.
/// let report = Study::new(scene, 1.0)
///     .settings(Setting::halved(Scheme::EemEntropy, 0.1, 3))
///     .run()?;
/// let [q, dq_dphase] = [1.0 + 0.5 * 2.0_f64.cos(), 0.5 * 2.0_f64.sin()];
/// let expected = dq_dphase * 0.2_f64.powi(2) * 2.0 / 12.0 / q;
/// let error = report.rows[0].error(eem::StateQuantity::Positions).unwrap();
/// assert!((error / expected - 1.0).abs() < 0.02);
///
/// let Advice::Take { fastest, .. } = report.recommend(5e-4)?.advice else { unreachable!() };
/// assert_eq!(fastest.setting.step(), Some(0.025));
/// assert_eq!(report.csv_rows().count(), 3);
/// # Ok::<(), eem::StudyError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct StudyReport {
    /// The time at which errors are compared, s.
    pub end: f64,
    /// A row per setting, in their order.
    pub rows: Vec<StudyRow>,
    /// The references.
    pub reference: StudyReference,
    /// The accuracies that `Display` recommends settings for.
    pub accuracies: Vec<f64>,
}

impl StudyReport {
    /// The Pareto front: the rows that no other row beats in both time and largest error, from the fastest to the
    /// most accurate.
    #[must_use]
    pub fn front(&self) -> Vec<&StudyRow> {
        let stated = |row| Some((row, StudyRow::largest_error(row).stated()?));
        let mut rows: Vec<(&StudyRow, f64)> = self.rows.iter().filter_map(stated).collect();
        rows.sort_by(|(a, own), (b, other)| {
            let by_time = a.seconds.total_cmp(&b.seconds);
            by_time.then(own.total_cmp(other))
        });
        let mut least = f64::INFINITY;
        rows.retain(|&(_, error)| {
            let is_better = error < least;
            least = least.min(error);
            is_better
        });
        rows.into_iter().map(|(row, _)| row).collect()
    }

    /// The observed order of a scheme for one kind of quantity: the slope between the two
    /// smallest steps with stated errors.
    ///
    /// ```text
    /// ln(error₁/error₂) / ln(h₁/h₂)
    /// ```
    ///
    /// `None` unless there are two such steps with an error: where nothing moves, positions have none.
    #[must_use]
    pub fn order(&self, scheme: Scheme, quantity: StateQuantity) -> Option<f64> {
        let point = |row: &StudyRow| {
            let own = row.setting;
            let error = row.error(quantity).filter(|_| own.scheme == scheme)?;
            Some((own.step()?, error))
        };
        let mut points: Vec<_> = self.rows.iter().filter_map(point).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points.dedup_by(|a, b| a.0.total_cmp(&b.0).is_eq());
        let [(small, fine), (large, coarse)] = *points.first_chunk()?;
        let has_errors = fine > 0.0 && coarse > 0.0;
        has_errors.then(|| (coarse / fine).ln() / (large / small).ln())
    }
}

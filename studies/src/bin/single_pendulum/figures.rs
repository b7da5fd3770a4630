//! The pictures: the figures of the papers about the single pendulum.

use eem::Scheme;

use eem_studies::comparison::{self, Plot};
use eem_studies::figures::look::BOLD;
use eem_studies::figures::{Axes, Figure};
use eem_studies::published::{Against, Published};
use eem_studies::record::Record;

/// Figures 2 to 8 of García Orden & Romero (2012), which show the entropy form beside midpoint and
/// trapezoidal rule, with all schemes.
pub(super) const ALL_SCHEMES: [Plot; 7] = [
    Plot {
        file: "garcia_orden_2012_figure_02_trajectory",
        title: "García Orden & Romero (2012), figure 2: trajectory of the mass",
        x_label: "x (m)",
        y_label: "y (m)",
        points: |run| run.points("q1_x", "q1_y"),
        axes: Axes::Map,
    },
    Plot::history(
        "garcia_orden_2012_figure_03_length",
        "García Orden & Romero (2012), figure 3: length of the spring",
        "length λ (m)",
        |run| run.norms("q1_"),
    ),
    Plot::history(
        "garcia_orden_2012_figure_04_viscous_stretch",
        "García Orden & Romero (2012), figure 4: viscous stretch",
        "viscous stretch γ (m)",
        |run| run.points("time", "gamma_1"),
    ),
    Plot::history(
        "garcia_orden_2012_figure_05_temperature",
        "García Orden & Romero (2012), figure 5: temperature of the spring",
        "temperature θ (K)",
        |run| run.points("time", "theta_1"),
    ),
    Plot::history(
        "garcia_orden_2012_figure_06_angular_momentum",
        "García Orden & Romero (2012), figure 6: angular momentum",
        "angular momentum J (kg m²/s)",
        |run| run.points("time", "angular_momentum"),
    ),
    Plot::history(
        "garcia_orden_2012_figure_07_energy",
        "García Orden & Romero (2012), figure 7: total energy",
        "total energy E (J)",
        |run| run.points("time", "energy"),
    ),
    Plot::history(
        "garcia_orden_2012_figure_08_entropy",
        "García Orden & Romero (2012), figure 8: total entropy",
        "total entropy S (J/K)",
        |run| run.points("time", "entropy"),
    ),
];

/// Figures 3 and 4 of Kern et al. (2021).
pub(super) const KERN: [Published; 2] = [
    Published {
        file: "kern_2021_figure_03_energy_error",
        title: "Kern et al. (2021), figure 3: error of the energy",
        y_label: "E − E₀ (J)",
        schemes: VARIATIONAL_AND_ENTROPY_FORM,
        quantities: &[("", Record::energy_changes)],
        against: Against::Nothing,
        axes: Axes::Even,
    },
    Published {
        file: "kern_2021_figure_04_entropy_error",
        title: "Kern et al. (2021), figure 4: error of the entropy",
        y_label: "S − S of the reference (J/K)",
        schemes: VARIATIONAL_AND_ENTROPY_FORM,
        quantities: &[("", |run| run.points("time", "entropy"))],
        against: Against::Deviation,
        axes: Axes::Even,
    },
];

/// The picture of `README.md`: the scheme that keeps the energy over two that do not.
pub(super) fn hero(runs: &[Record]) -> Figure {
    let curve = |(scheme, look): (Scheme, usize)| {
        let run = runs.iter().find(|run| run.scheme == scheme.name())?;
        let look = look + comparison::look(scheme.name());
        let points = run.points("time", "energy");
        Some(comparison::curve(run, points, look, Axes::Even))
    };
    let shown = [
        (Scheme::EemEntropy, BOLD),
        (Scheme::Midpoint, 0),
        (Scheme::Trapezoidal, 0),
    ];
    Figure {
        title: "Total energy of a thermo-visco-elastic pendulum, steps of 0.2 s".to_owned(),
        x_label: "time (s)".to_owned(),
        y_label: "total energy E (J)".to_owned(),
        curves: shown.into_iter().filter_map(curve).collect(),
        axes: Axes::Even,
    }
}

const VARIATIONAL_AND_ENTROPY_FORM: &[Scheme] = &[Scheme::Variational, Scheme::EemEntropy];

//! The pictures: every scheme side by side, and the figures of the papers, case by case.

use eem::Scheme;

use eem_studies::comparison::Plot;
use eem_studies::figures::Axes;
use eem_studies::published::{Against, Published};
use eem_studies::record::Record;
use eem_studies::statistics;

/// The lengths of both springs, drawn as long as one oscillation can be told from the next.
pub(super) const LENGTHS: [Plot; 2] = [
    Plot::history(
        "length_1",
        "Length of spring 1",
        "length λ₁ (m)",
        first_length,
    ),
    Plot::history(
        "length_2",
        "Length of spring 2",
        "length λ₂ (m)",
        second_length,
    ),
];

/// Temperatures and what is conserved or grows.
pub(super) const HISTORIES: [Plot; 5] = [
    Plot::history(
        "temperature_1",
        "Temperature of spring 1",
        "temperature θ₁ (K)",
        first_temperature,
    ),
    Plot::history(
        "temperature_2",
        "Temperature of spring 2",
        "temperature θ₂ (K)",
        second_temperature,
    ),
    Plot::history("energy", "Total energy", "total energy E (J)", energy),
    Plot::history("entropy", "Total entropy", "total entropy S (J/K)", entropy),
    Plot::history(
        "angular_momentum",
        "Angular momentum",
        "angular momentum |J| (kg m²/s)",
        angular_momentum,
    ),
];

/// What rounding and schemes do to the conserved quantities.
pub(super) const DEFECTS: [Plot; 2] = [
    Plot::defect(
        "energy_defect",
        "Largest defect of the energy so far",
        "|E − E₀| / |E₀|",
        statistics::energy_defects,
    ),
    Plot::defect(
        "angular_momentum_defect",
        "Largest defect of the angular momentum so far",
        "|J − J₀| / |J₀|",
        statistics::angular_momentum_defects,
    ),
];

const TEMPERATURE_FORM: &[Scheme] = &[Scheme::EemTemperature];
const BOTH_FORMS: &[Scheme] = &[Scheme::EemTemperature, Scheme::EemEntropy];
const MIDPOINT: &[Scheme] = &[Scheme::MidpointTemperature];
const AGAINST_ORDINARY: &[Scheme] = &[
    Scheme::EemTemperature,
    Scheme::MidpointTemperature,
    Scheme::TrapezoidalTemperature,
];
const AGAINST_VARIATIONAL: &[Scheme] = &[Scheme::EemTemperature, Scheme::Variational];

/// What most figures have in common.
const HISTORY: Published = Published {
    file: "",
    title: "",
    y_label: "",
    schemes: TEMPERATURE_FORM,
    quantities: &[],
    against: Against::Nothing,
    axes: Axes::Even,
};

const TEMPERATURES: Published = Published {
    y_label: "temperature (K)",
    quantities: &[("θ₁", first_temperature), ("θ₂", second_temperature)],
    ..HISTORY
};

const ENERGY: Published = Published {
    y_label: "total energy E (J)",
    quantities: &[("", energy)],
    ..HISTORY
};

const ENTROPY: Published = Published {
    y_label: "total entropy S (J/K)",
    quantities: &[("", entropy)],
    ..HISTORY
};

/// Figures 3 to 6 of Conde Martín, Betsch & García Orden (2016).
pub(super) const ROMERO: [Published; 4] = [
    Published {
        file: "conde_martin_2016_figure_03_strains",
        title: "Conde Martín et al. (2016), figure 3: strains of the springs",
        y_label: "strain ln(λ/λ0)",
        schemes: BOTH_FORMS,
        quantities: &[("spring 1", first_strain), ("spring 2", second_strain)],
        ..HISTORY
    },
    Published {
        file: "conde_martin_2016_figure_04_temperatures",
        title: "Conde Martín et al. (2016), figure 4: temperatures",
        schemes: BOTH_FORMS,
        ..TEMPERATURES
    },
    Published {
        file: "conde_martin_2016_figure_05_energy",
        title: "Conde Martín et al. (2016), figure 5: total energy",
        schemes: BOTH_FORMS,
        ..ENERGY
    },
    Published {
        file: "conde_martin_2016_figure_06_entropy",
        title: "Conde Martín et al. (2016), figure 6: total entropy",
        schemes: BOTH_FORMS,
        against: Against::Reference,
        ..ENTROPY
    },
];

/// Figures 7 to 11 of the same paper.
pub(super) const KRUEGER: [Published; 5] = [
    Published {
        file: "conde_martin_2016_figure_07_elongation",
        title: "Conde Martín et al. (2016), figure 7: elongation of spring 1",
        y_label: "elongation λ₁ − λ0 (m)",
        quantities: &[("", first_elongation)],
        ..HISTORY
    },
    Published {
        file: "conde_martin_2016_figure_08_temperatures",
        title: "Conde Martín et al. (2016), figure 8: temperatures",
        ..TEMPERATURES
    },
    Published {
        file: "conde_martin_2016_figure_09_elongation_midpoint",
        title: "Conde Martín et al. (2016), figure 9: elongation of spring 1, midpoint rule",
        y_label: "elongation λ₁ − λ0 (m)",
        schemes: MIDPOINT,
        quantities: &[("", first_elongation)],
        ..HISTORY
    },
    Published {
        file: "conde_martin_2016_figure_10_energy",
        title: "Conde Martín et al. (2016), figure 10: total energy",
        schemes: BOTH_FORMS,
        ..ENERGY
    },
    Published {
        file: "conde_martin_2016_figure_11_entropy",
        title: "Conde Martín et al. (2016), figure 11: total entropy",
        schemes: BOTH_FORMS,
        ..ENTROPY
    },
];

/// Figures 12 to 17 of the same paper, and figures 6 to 9 of Kern et al. (2021).
pub(super) const LOG: [Published; 10] = [
    Published {
        file: "conde_martin_2016_figure_12_stretches",
        title: "Conde Martín et al. (2016), figure 12: lengths of the springs",
        y_label: "length (m)",
        quantities: &[("λ₁", first_length), ("λ₂", second_length)],
        ..HISTORY
    },
    Published {
        file: "conde_martin_2016_figure_13_temperatures",
        title: "Conde Martín et al. (2016), figure 13: temperatures",
        ..TEMPERATURES
    },
    Published {
        file: "conde_martin_2016_figure_14_temperature_1",
        title: "Conde Martín et al. (2016), figure 14: temperature of spring 1",
        y_label: "temperature θ₁ (K)",
        quantities: &[("", first_temperature)],
        against: Against::Reference,
        ..HISTORY
    },
    Published {
        file: "conde_martin_2016_figure_15_energy",
        title: "Conde Martín et al. (2016), figure 15: total energy",
        schemes: AGAINST_ORDINARY,
        ..ENERGY
    },
    Published {
        file: "conde_martin_2016_figure_16_entropy",
        title: "Conde Martín et al. (2016), figure 16: total entropy",
        schemes: AGAINST_ORDINARY,
        ..ENTROPY
    },
    Published {
        file: "conde_martin_2016_figure_17_angular_momentum",
        title: "Conde Martín et al. (2016), figure 17: angular momentum",
        y_label: "angular momentum |J| (kg m²/s)",
        schemes: AGAINST_ORDINARY,
        quantities: &[("", angular_momentum)],
        ..HISTORY
    },
    Published {
        file: "kern_2021_figure_06_temperatures",
        title: "Kern et al. (2021), figure 6: temperatures",
        schemes: AGAINST_VARIATIONAL,
        ..TEMPERATURES
    },
    Published {
        file: "kern_2021_figure_07_energy_error",
        title: "Kern et al. (2021), figure 7: error of the energy",
        y_label: "E − E₀ (J)",
        schemes: AGAINST_VARIATIONAL,
        quantities: &[("", Record::energy_changes)],
        ..HISTORY
    },
    Published {
        file: "kern_2021_figure_08_entropy_error",
        title: "Kern et al. (2021), figure 8: error of the entropy",
        y_label: "S − S of the reference (J/K)",
        schemes: AGAINST_VARIATIONAL,
        against: Against::Deviation,
        ..ENTROPY
    },
    Published {
        file: "kern_2021_figure_09_angular_momentum",
        title: "Kern et al. (2021), figure 9: largest error of the angular momentum so far",
        y_label: "|J − J₀| / |J₀|",
        schemes: AGAINST_VARIATIONAL,
        quantities: &[("", statistics::angular_momentum_defects)],
        axes: Axes::Logarithmic,
        ..HISTORY
    },
];

/// Natural lengths of the springs (m), the same in all cases.
const NATURAL_LENGTHS: [f64; 2] = [2.0, 1.0];

fn first_length(run: &Record) -> Vec<(f64, f64)> {
    run.norms("q1_")
}

fn second_length(run: &Record) -> Vec<(f64, f64)> {
    run.distances("q1_", "q2_")
}

fn first_elongation(run: &Record) -> Vec<(f64, f64)> {
    let elongation = |(time, length)| (time, length - NATURAL_LENGTHS[0]);
    first_length(run).into_iter().map(elongation).collect()
}

fn first_strain(run: &Record) -> Vec<(f64, f64)> {
    strain(first_length(run), NATURAL_LENGTHS[0])
}

fn second_strain(run: &Record) -> Vec<(f64, f64)> {
    strain(second_length(run), NATURAL_LENGTHS[1])
}

fn strain(lengths: Vec<(f64, f64)>, natural: f64) -> Vec<(f64, f64)> {
    let strain = |(time, length): (f64, f64)| (time, (length / natural).ln());
    lengths.into_iter().map(strain).collect()
}

fn first_temperature(run: &Record) -> Vec<(f64, f64)> {
    run.points("time", "theta_1")
}

fn second_temperature(run: &Record) -> Vec<(f64, f64)> {
    run.points("time", "theta_2")
}

fn energy(run: &Record) -> Vec<(f64, f64)> {
    run.points("time", "energy")
}

fn entropy(run: &Record) -> Vec<(f64, f64)> {
    run.points("time", "entropy")
}

fn angular_momentum(run: &Record) -> Vec<(f64, f64)> {
    run.norms("angular_momentum_")
}

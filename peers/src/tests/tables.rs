//! CSV rows come back as they were, and times at equal errors are those of a power law.

use std::{env, fs, process};

use crate::rows::{self, Row};
use crate::summary;

#[test]
fn rows_are_read_as_they_were_written() {
    let directory = env::temp_dir().join(format!("eem-peers-{}", process::id()));
    fs::create_dir_all(&directory).unwrap();
    let all = vec![
        Row {
            scheme: "dop853 entropy".to_owned(),
            tolerance: Some(1e-3),
            step: None,
            errors: [Some(1.0 / 3.0), Some(1e-300), Some(0.25)],
            largest_error: Some(1.0 / 3.0),
            energy_defect: Some(0.1),
            steps: 7,
            rejected: 1,
            evaluations: 120,
            seconds: Some(1e-5),
        },
        Row::failed(1e-2, f64::NAN),
    ];
    rows::write(&directory, &all).unwrap();
    let read = rows::read(&directory.join("peers.csv")).unwrap();
    fs::remove_dir_all(&directory).unwrap();
    assert_eq!(read[0], all[0]);
    assert!(read[1].energy_defect.is_some_and(f64::is_nan));
    assert_eq!(read[1].largest_error, None);
}

#[test]
fn lines_have_the_names_of_the_librarys_pictures() {
    let row = |scheme: &str, tolerance| Row {
        scheme: scheme.to_owned(),
        tolerance,
        ..Row::default()
    };
    assert_eq!(row("gauss4", None).line(), "gauss4");
    assert_eq!(row("gauss4", Some(0.1)).line(), "gauss4, controlled");
    assert_eq!(row("bdf entropy", Some(0.1)).line(), "bdf entropy");
}

#[test]
fn times_at_equal_errors_follow_a_power_law() {
    let points: Vec<(f64, f64)> = (2..9)
        .map(|n| 10.0_f64.powi(-n))
        .map(|error| (error, error.powf(-0.125)))
        .collect();
    let time = summary::time_for(&points, 3e-6).unwrap();
    assert!((time / 3e-6_f64.powf(-0.125) - 1.0).abs() < 1e-12);
    assert_eq!(summary::time_for(&points, 1e-9), None);
    assert_eq!(summary::time_for(&points[..1], 1e-2), None);
}

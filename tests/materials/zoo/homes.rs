//! The domain check: the home of every specimen passes.

use eem::Domain;

use crate::zoo::families;
use crate::zoo::specimen::Specimen;

/// Points of the sample beside the corners.
const SAMPLES: usize = 500;

/// The home of a specimen as a domain.
fn home(specimen: &dyn Specimen) -> Domain {
    let home = specimen.home();
    let measures = specimen.measures();
    let mechanical = measures + specimen.dashpots();
    let mut domain = if specimen.is_solid() {
        Domain::of_strains(home[..measures].iter().copied())
    } else {
        Domain::of_stretch(home[0])
    };
    for &range in &home[measures..mechanical] {
        domain = domain.with_viscous(range);
    }
    for &range in &home[mechanical..] {
        domain = domain.with_temperature(range);
    }
    domain
}

#[test]
fn every_home_is_sound() {
    for specimen in families::all() {
        let report = specimen.check_domain(&home(&*specimen), SAMPLES);
        let report = report.unwrap_or_else(|error| panic!("{}: {error}", specimen.name()));
        println!("{:22} {report}", specimen.name());
        assert!(report.evaluations >= SAMPLES);
        assert_eq!(report.heat_capacity.is_some(), specimen.thermal());
        // Dashpots, and the flows of a viscous strain; each with its slope.
        let viscosities = specimen.viscosity(300.0).len() / 2;
        assert_eq!(report.viscosities.len(), viscosities);
    }
}

#[test]
fn the_zoo_is_large_enough() {
    let mut names: Vec<_> = families::all()
        .iter()
        .map(|specimen| specimen.name())
        .collect();
    assert!(names.len() >= 40, "{}", names.len());
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), families::all().len());
}

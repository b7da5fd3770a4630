//! The judge sees what he is for.

use super::super::models::Hooke;
use super::super::published::{LOGARITHMIC, double_pendulum, single_pendulum};
use super::super::watched::{EXACT, FORMS};
use super::super::world::World;
use super::*;

/// A step of the single pendulum before and after, with its report.
fn step() -> (Facts<2>, Stored, Stored, StepReport) {
    let world = single_pendulum([1.0, 1.0]);
    let mut watched = world.start(FORMS[0], 0.2).expect("a sound scene");
    let before = watched.stored().clone();
    let report = watched.step().expect("the published step");
    let after = watched.stored().clone();
    (watched.facts, before, after, report)
}

/// The first complaint about a step whose end was changed.
fn complaint(spoil: impl Fn(&mut Stored)) -> String {
    let (facts, before, mut after, report) = step();
    spoil(&mut after);
    let broken = check_step(&facts, &before, &after, &report).broken;
    broken.first().cloned().unwrap_or_default()
}

#[test]
fn an_honest_step_is_not_accused() {
    assert_eq!(complaint(|_| ()), "");
}

/// One part in 10⁹ of the momentum is more than ten times what the bounds allow.
#[test]
fn a_spoilt_momentum_is_seen() {
    let spoilt = complaint(|state| state.momenta[2] = state.momenta[2] * (1.0 + 1e-9));
    assert!(spoilt.contains("energy is off"), "{spoilt}");
}

#[test]
fn a_spoilt_temperature_is_seen_where_energy_does_not_see_it() {
    let spoilt = complaint(|state| state.temperatures[0] *= 1.0 + 1e-12);
    assert!(spoilt.contains("kept entropy"), "{spoilt}");
}

/// Momenta of two masses, changed by opposite amounts across their arm.
#[test]
fn a_spoilt_rotation_is_seen_in_every_plane() {
    let planes = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
    for [along, across] in planes {
        let mut world = World::<4>::new();
        let mut at = [1.0; 4];
        let first = world.mass(1.0, at, [0.3; 4]);
        at[along] += 1.1;
        let second = world.mass(3.0, at, [0.0; 4]);
        let (stiffness, length) = (100.0, 1.0);
        world.spring(Hooke { stiffness, length }, [first, second]);
        let mut watched = world.start(FORMS[0], 0.01).expect("a sound scene");
        let before = watched.stored().clone();
        let report = watched.step().expect("a small step");
        assert!(watched.record.is_lawful(), "{:?}", watched.record.broken);
        let mut after = watched.stored().clone();
        for (node, sign) in [(0, 1.0), (1, -1.0)] {
            let own = &mut after.momenta[4 * node + across];
            *own = *own + Digits::from(sign * 1e-12);
        }
        let broken = check_step(&watched.facts, &before, &after, &report).broken;
        let is_seen = broken.iter().any(|law| law.contains("angular momentum"));
        let is_linear = broken.iter().any(|law| law.contains("linear momentum"));
        assert!(is_seen && !is_linear, "{along}, {across}: {broken:?}");
    }
}

#[test]
fn lost_entropy_is_seen_below_the_last_bit() {
    // The step produces 0.02 J/K; what is taken away is that and an ε² of S.
    let (facts, before, mut after, report) = step();
    let produced = check_step(&facts, &before, &after, &report).entropy;
    let taken = Digits::from(produced) + Digits::from(1e-28);
    after.reservoirs[0] = after.reservoirs[0] - taken;
    let broken = check_step(&facts, &before, &after, &report).broken;
    assert!(
        broken.iter().any(|law| law.contains("entropy lost")),
        "{broken:?}"
    );
}

#[test]
fn every_step_of_an_exact_scheme_reports_its_bound() {
    for scheme in EXACT {
        let world = double_pendulum(&LOGARITHMIC, [1.0, 1.0]);
        let mut watched = world.start(scheme, 0.1).expect("a sound scene");
        let mut worst = 0.0_f64;
        for _ in 0..20 {
            let report = watched.step().expect("the published step");
            let is_bounded = report.bound > 0.0 && report.defect.abs() <= report.bound;
            assert!(is_bounded, "{}: {report:?}", scheme.name());
            worst = worst.max((report.defect / report.bound).abs());
            assert!(report.least_production >= 0.0 && report.production > 0.0);
        }
        assert!(watched.record.is_lawful(), "{:?}", watched.record.broken);
        let kept = watched.run.worst_step().expect("there were steps");
        assert!((kept.defect / kept.bound).abs() >= worst);
    }
}

//! The judge sees what he is for.

use eem::{Law, Scheme, StepError, StepFailure};

use super::super::models::{Maxwell, Thermoelastic, hooke};
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
        world.spring(hooke(stiffness, length), [first, second]);
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

/// A mass on an anchor that moves, by a branch without temperature and a spring that is held at 300 K.
fn driven() -> World<1> {
    let mut world = World::new();
    let anchor = world.anchor([0.0]);
    let mass = world.mass(1.0, [1.3], [0.0]);
    world.spring(
        Maxwell {
            stiffness: 100.0,
            branch: 50.0,
            length: 1.0,
            eta: 0.1,
        },
        [anchor, mass],
    );
    let held = world.warm(Thermoelastic::ORDINARY, [anchor, mass], 300.0);
    world.hold_temperature(held, 300.0);
    world.move_anchor(anchor, |t| [t]);
    world
}

/// 1e-8 J from one book to another, which leaves the balance of energy.
#[test]
fn books_that_do_not_fit_the_states_are_seen() {
    let mut watched = driven().start(Scheme::EemTemperature, 0.01).unwrap();
    let before = watched.stored().clone();
    let report = watched.step().unwrap();
    assert!(watched.record.is_lawful(), "{:?}", watched.record.broken);
    let complaints = |spoil: &dyn Fn(&mut Stored, Digits)| {
        let mut after = watched.stored().clone();
        spoil(&mut after, Digits::from(1e-8));
        let broken = check_step(&watched.facts, &before, &after, &report).broken;
        assert!(
            !broken.iter().any(|law| law.contains("energy")),
            "{broken:?}"
        );
        broken.join("; ")
    };
    let heated = complaints(&|after, part| {
        after.heat = after.heat + part;
        after.work = after.work - part;
    });
    assert!(heated.contains("heat is not θ times") && heated.contains("work is off"));
    // The books give no more entropy than before: it is that of the heat at 300 K.
    assert!(heated.contains("entropy lost"), "{heated}");
    let lost = complaints(&|after, part| {
        after.lost = after.lost - part;
        after.work = after.work - part;
    });
    assert!(lost.contains("lost heat is too little") && lost.contains("lost heat is off"));
}

#[test]
fn a_refusal_is_explained_by_rounding_up_to_its_bound() {
    let watched = driven().start(Scheme::EemTemperature, 0.01).unwrap();
    let explained = |defect: f64| {
        let law = Law::Energy;
        let (bound, element, time) = (0.0, None, 0.01);
        let error = StepError {
            time: 0.0,
            step: 0.01,
            failure: StepFailure::LawNotKept {
                law,
                defect,
                bound,
                element,
                time,
            },
            shorter: None,
            history: [].into(),
        };
        explained(&watched.facts, watched.stored(), &error).is_some()
    };
    // θ c = 1500 J, twice, by 64 ε.
    assert!(explained(4e-11) && !explained(1e-10));
}

//! Findings 1 to 3 are not reproducible; fresh hot steps are in `scenes`, small capacities and stiff
//! conduction (finding 4) in `heat`, two dashpots (finding 5) in `stiffness`.

use super::super::watched::EXACT;
use super::*;

/// Random steps.
const FRESH: usize = 2000;

fn assert_none(complaints: &[String]) {
    assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
}

/// Every step that was taken kept the laws.
fn assert_lawful(what: &str, record: &Record) {
    assert!(record.is_lawful(), "{what}: {:?}", record.broken);
}

#[test]
fn a_hot_spring_near_its_anchor_takes_a_true_step() {
    for scheme in EXACT {
        let mut watched = hot_as_found(scheme);
        let result = watched.step();
        assert_lawful(scheme.name(), &watched.record);
        if scheme != Scheme::EemTemperature {
            continue;
        }
        result.expect("the temperature form has a solution");
        let state = watched.stored();
        let distance = state.positions[2].value().hypot(state.positions[3].value());
        // The solution, found with 50 digits and printed with so many.
        assert!((distance - 1.4176).abs() < 5e-5, "{distance} m");
        let theta = state.temperatures[0];
        assert!((theta - 170.4433).abs() < 5e-5, "{theta} K");
    }
}

#[test]
fn an_ill_conditioned_turn_keeps_energy_or_is_refused() {
    for scheme in EXACT {
        for off in [
            0.0, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2,
        ] {
            for factor in [1.0 + off, 1.0 - off] {
                let mut watched = turned_round(scheme, factor);
                let result = watched.step();
                let what = format!("{} 1 ± {off:e}: {result:?}", scheme.name());
                assert_lawful(&what, &watched.record);
            }
        }
    }
}

#[test]
fn random_compressed_springs_keep_energy_or_are_refused() {
    let mut random = Random::new(2);
    for _ in 0..FRESH {
        let scheme = EXACT[random.below(3)];
        let position = [random.uniform(0.05, 1.0), 0.0];
        let step = random.decades(0.05, 2.0);
        let speed = random.uniform(-4.0, 1.0) * position[0] / step;
        let hooke = sprung(hooke(100.0, 1.0));
        let world = on_anchor(hooke, position, [speed, random.uniform(-0.01, 0.01)]);
        let mut watched = world.start(scheme, step).unwrap();
        let _ = watched.step();
        assert_lawful(
            &format!("{position:?}, {speed} m/s, {step} s"),
            &watched.record,
        );
    }
}

#[test]
fn a_stiff_pair_completes_with_the_default_settings() {
    let mut wrong = Vec::new();
    for scheme in EXACT {
        for stiffness in [1e2, 1e4, 1e6, 1e8, 1e10, 1e12] {
            let mut watched = stiff_pair(scheme, stiffness);
            watched.steps(100);
            wrong.extend(complaint(
                &format!("k = {stiffness:e}"),
                scheme,
                100,
                &watched.record,
            ));
        }
    }
    assert_none(&wrong);
}

#[test]
fn a_maxwell_element_of_any_viscosity_completes() {
    let mut wrong = Vec::new();
    for scheme in EXACT {
        for exponent in (-12..=16).step_by(2) {
            for starts_relaxed in [true, false] {
                let mut watched = maxwell(scheme, 10.0_f64.powi(exponent), starts_relaxed);
                watched.steps(50);
                let what = format!("h k/η = 1e{exponent}, {starts_relaxed}");
                wrong.extend(complaint(&what, scheme, 50, &watched.record));
            }
        }
    }
    assert_none(&wrong);
}

/// A step from 551 K to 0.06 K, one of 23 in 333 333 that were 1 to 7 % beyond the bound which they
/// reported: the defect that they reported was off by more than the bound.
#[test]
fn a_violent_expansion_is_within_the_bound_that_it_reports() {
    let model = Hot {
        gas: 0.636_679_067_820_608_7,
        bonds: 1.058_983_720_723_293_3,
        frequency: 250.147_858_002_674_87,
        capacity: 0.404_960_703_873_662_45,
    };
    for scheme in EXACT {
        let hot = warmed(model, 550.710_916_054_669_5);
        let velocity = [2.516_759_489_194_263_3, -0.089_354_402_400_728_45];
        let world = on_anchor(hot, [0.103_181_195_524_740_99, 0.0], velocity);
        let mut watched = world.start(scheme, 0.050_002_669_286_462_99).unwrap();
        let result = watched.step();
        assert_lawful(&format!("{} {result:?}", scheme.name()), &watched.record);
    }
}

/// In entropy form, heat was taken at the temperatures of mixed states: this spring gained 42 J of free energy in seven steps.
#[test]
fn a_strongly_coupled_spring_gains_no_free_energy_from_a_thermostat() {
    let model = TwoLinearDashpots {
        stiffness: 10.0,
        first: 10.0,
        coupling: 0.3,
        capacity: 0.04,
        ..TwoLinearDashpots::of_viscosity(1.0)
    };
    for scheme in Scheme::ALL.into_iter().filter(|scheme| scheme.is_exact()) {
        let held = |world: &mut World<2>, ends| {
            let element = world.warm(model, ends, 400.0);
            world.hold_temperature(element, 400.0);
        };
        let world = on_anchor(held, [1.05, 0.0], [0.0, 0.1]);
        let mut watched = world.start(scheme, 0.03).unwrap();
        let record = watched.steps(20);
        assert_lawful(scheme.name(), record);
        assert_eq!(record.steps, 20, "{}", scheme.name());
    }
}

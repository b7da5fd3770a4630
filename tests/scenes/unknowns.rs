//! A model carries no unknown, no storage and no arithmetic for what it does not have.

use core::fmt::Debug;

use eem::prelude::*;

use crate::support::dashpots::{ThreeDashpots, TwoDashpots};
use crate::support::{Hencky, LogarithmicStiffness, ThermoViscoElastic, hencky};

/// A chain of two masses from an anchor, both springs of the same model; heat flows between the
/// springs when `temperature` (K) is given.
fn chain<M>(model: &M, scheme: Scheme, temperature: Option<f64>) -> (Simulation<3>, [Element; 2])
where
    M: FreeEnergy<f64> + Clone + Debug + Send + Sync + 'static,
{
    let mut scene = Scene::<3>::new();
    let pivot = scene.anchor([0.0; 3]);
    let first = scene.mass(1.0, [1.5, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let second = scene.mass(2.0, [2.6, 0.1, 0.0], [0.0, 0.0, 0.5]);
    let springs = [[pivot, first], [first, second]].map(|ends| scene.spring(model.clone(), ends));
    if let Some(temperature) = temperature {
        scene.set_temperature(springs[0], temperature);
        scene.set_temperature(springs[1], temperature + 20.0);
        scene.conduct(springs[0], springs[1], 1.0);
    }
    (Simulation::new(scene, scheme, 0.01).unwrap(), springs)
}

const HENCKY: Hencky = hencky(100.0, 1.0);

/// Coordinates of the two free masses.
const COORDINATES: usize = 6;

#[test]
fn an_elastic_scene_solves_for_positions_alone() {
    for scheme in Scheme::ALL {
        let (mut run, springs) = chain(&HENCKY, scheme, None);
        let sets = match scheme {
            Scheme::EemExplicit => 0,
            Scheme::Variational4 | Scheme::Gauss4 | Scheme::EemEntropy4 => 2,
            Scheme::EemEntropy6 => 3,
            _ => 1,
        };
        assert_eq!(run.unknowns(), sets * COORDINATES, "{}", scheme.name());
        run.step().unwrap();
        for element in springs {
            assert_eq!(
                run.temperature(element),
                Err(SceneError::NotThermal { element })
            );
            assert_eq!(
                run.entropy(element),
                Err(SceneError::NotThermal { element })
            );
            let none = SceneError::NoSuchDashpot {
                element,
                dashpot: 0,
                dashpots: 0,
            };
            assert_eq!(run.viscous_stretch(element, 0), Err(none));
        }
        let ledger = run.ledger();
        let thermal = [ledger.entropy, ledger.element_entropy, ledger.heat];
        assert!(thermal.iter().all(|value| value.abs() <= 0.0));
    }
}

#[test]
fn a_thermoelastic_scene_has_no_dashpot() {
    for scheme in [Scheme::EemEntropy, Scheme::EemTemperature] {
        let (mut run, [element, _]) = chain(&LogarithmicStiffness::FIRST, scheme, Some(300.0));
        assert_eq!(run.unknowns(), COORDINATES + 2);
        run.step().unwrap();
        assert!(run.temperature(element).is_ok());
        let none = SceneError::NoSuchDashpot {
            element,
            dashpot: 0,
            dashpots: 0,
        };
        assert_eq!(run.viscous_stretch(element, 0), Err(none));
    }
}

// Viscous stretches belong to one element each, and are eliminated there.
#[test]
fn dashpots_add_no_unknown_of_the_scene() {
    for scheme in [Scheme::EemEntropy, Scheme::EemTemperature] {
        let one = chain(&ThermoViscoElastic::PENDULUM, scheme, Some(300.0));
        let two = chain(&TwoDashpots::DATA, scheme, Some(300.0));
        let three = chain(&ThreeDashpots::DATA, scheme, Some(300.0));
        for (dashpots, (run, [element, _])) in (1..).zip([one, two, three]) {
            assert_eq!(run.unknowns(), COORDINATES + 2);
            assert!(run.viscous_stretch(element, dashpots - 1).is_ok());
            assert!(run.viscous_stretch(element, dashpots).is_err());
        }
    }
}

/// Bytes of variables, viscosities and corners.
fn bytes<M: FreeEnergy<f64>>() -> [usize; 3] {
    [
        size_of::<M::Variables>(),
        size_of::<M::Viscosities>(),
        size_of::<M::Corners>(),
    ]
}

#[test]
fn nothing_is_stored_for_what_a_model_does_not_have() {
    const NUMBER: usize = size_of::<f64>();
    assert_eq!(bytes::<Hencky>(), [NUMBER, 0, 0]);
    assert_eq!(
        bytes::<LogarithmicStiffness>(),
        [2, 0, 2].map(|n| n * NUMBER)
    );
    assert_eq!(bytes::<ThreeDashpots>(), [5, 3, 8].map(|n| n * NUMBER));
}

#[test]
fn an_elastic_model_does_no_thermal_arithmetic() {
    // What has no temperature answers zero, whatever it is asked at.
    let caloric = FreeEnergy::<f64>::caloric(&HENCKY, &[1.3]);
    let answers = [caloric.entropy, caloric.heat_capacity, caloric.magnitude];
    assert!(answers.iter().all(|answer| answer.abs() <= 0.0));
    // And its entropy form is the discrete derivative of ψ: no corner to be found.
    let old = FreeEnergy::<f64>::entropy_form_old(&HENCKY, &[1.0]);
    let (response, _) = FreeEnergy::<f64>::entropy_form(&HENCKY, &old, &[1.3], &[]);
    let psi = |lambda: f64| FreeEnergy::<f64>::free_energy(&HENCKY, &[lambda]);
    let quotient = (psi(1.3) - psi(1.0)) / 0.3;
    assert_eq!(response.len(), 1);
    // Cancellation in the quotient costs a few roundings of ψ/0.3.
    approx::assert_relative_eq!(response[0], quotient, max_relative = 8.0 * f64::EPSILON);
}

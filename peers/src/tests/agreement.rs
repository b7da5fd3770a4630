//! Energies, entropies and forces of the equations are the library's, at the start and along a motion.

use eem::prelude::*;

use crate::cases::{CaseName, state};
use crate::inversion::temperature;
use crate::single_pendulum;
use crate::springs::{Spring, Stretched};
use crate::systems::{Double, Single, State, System, Variables};

/// A dozen roundings of terms that are as large as what is compared.
const ROUNDING: f64 = 1e-12;

/// The start and states along a second of motion.
const STEPS: usize = 50;
const STEP: f64 = 0.02;

#[track_caller]
fn assert_near(value: f64, expected: f64, size: f64) {
    let error = (value - expected).abs();
    assert!(
        error <= ROUNDING * size,
        "{value:e} instead of {expected:e}"
    );
}

/// Follows the library's run and evaluates the equations in each of its states.
fn follow<const D: usize, const N: usize, S: System<N>>(
    mut run: Simulation<D>,
    springs: &[Element],
    system: impl Fn(Variables, State) -> S,
) {
    let forces = |run: &Simulation<D>| {
        springs
            .iter()
            .map(|&spring| run.force(spring).unwrap())
            .collect::<Vec<_>>()
    };
    let scale = forces(&run)
        .iter()
        .fold(0.0, |largest: f64, force| largest.max(force.abs()));
    for _ in 0..STEPS {
        let ledger = run.ledger();
        for variables in Variables::ALL {
            let system = system(variables, state(&run));
            let y = system.start();
            // The equations start with an empty reservoir.
            let energy = ledger.energy - ledger.reservoir_heat;
            assert_near(system.energy(&y), energy, energy.abs());
            let entropy = ledger.element_entropy;
            assert_near(system.entropy(&y), entropy, entropy.abs());
            for (force, expected) in system.forces(&y).into_iter().zip(forces(&run)) {
                assert_near(force, expected, scale);
            }
        }
        run.step().unwrap();
    }
}

#[test]
fn the_single_pendulum_has_the_librarys_energy_entropy_and_force() {
    let (scene, watched) = single_pendulum::scene(single_pendulum::CONDUCTANCE);
    let run = Simulation::new(scene, Scheme::EemEntropy, STEP).unwrap();
    follow(run, &watched.elements, Single::new);
}

#[test]
fn the_double_pendulums_have_the_librarys_energies_entropies_and_forces() {
    for case in [CaseName::Krueger, CaseName::Log].map(CaseName::double) {
        let case = case.unwrap();
        let (scene, watched) = case.scene();
        let run = Simulation::new(scene, Scheme::EemEntropy, STEP).unwrap();
        follow(run, &watched.elements, |variables, start| {
            Double::new(&case, variables, start)
        });
    }
}

#[test]
fn the_start_has_the_published_energy_and_entropy() {
    let published = [
        (CaseName::Single, 1_704.623_703_153_6, 5.425_832_690_2),
        (CaseName::Krueger, 90_000.375_170_773_5, 269.076_435_762_5),
        (CaseName::Log, 400_819.933_391_345, 1_183.024_338_221_3),
    ];
    for (case, energy, entropy) in published {
        let start = case.start().unwrap();
        let variables = Variables::Entropy;
        let values = match case.double() {
            None => {
                let system = Single::new(variables, start);
                let y = system.start();
                [system.energy(&y), system.entropy(&y)]
            }
            Some(case) => {
                let system = Double::new(&case, variables, start);
                let y = system.start();
                [system.energy(&y), system.entropy(&y)]
            }
        };
        // All published digits.
        assert!(
            (values[0] - energy).abs() <= 1e-13 * energy.abs() + 1e-10,
            "{values:?}"
        );
        assert!((values[1] - entropy).abs() <= 1e-10, "{values:?}");
    }
}

#[test]
fn the_inversion_gives_the_temperature_back_from_far_away() {
    let log = CaseName::Log.double().unwrap().springs[0];
    for theta in [150.0, 300.0, 380.0, 900.0] {
        let at = log.at(2.7, 0.0);
        let mut warm = 300.0;
        let found = temperature(at.caloric(), at.entropy(theta), &mut warm);
        assert_near(found, theta, theta);
        assert_near(warm, theta, theta);
        let at = single_pendulum::SPRING.at(1.3, 0.2);
        let found = temperature(at.caloric(), at.entropy(theta), &mut 300.0);
        assert_near(found, theta, theta);
    }
}

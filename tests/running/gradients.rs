//! Gradients of runs: against differences of runs, and against the laws, which say what the gradient of the energy is.

use eem::prelude::*;
use eem::{Gradient, GradientError, History, Objective};

use crate::support::{DoublePendulum, ThermoViscoElastic, single_pendulum_scene};

const FORMS: [Scheme; 2] = [Scheme::EemTemperature, Scheme::EemEntropy];

/// The largest difference of two gradients, in units of the largest number of their kind.
fn difference<const D: usize>(a: &Gradient<D>, b: &Gradient<D>) -> f64 {
    let [a, b] = [a, b].map(Gradient::numbers);
    let size = b.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let pairs = a.iter().zip(&b);
    pairs.fold(0.0, |most, (a, b)| f64::max(most, (a - b).abs())) / size
}

/// The gradient of the energy at the end is that of the energy at the start: it is kept whatever the inputs are.
fn assert_energy_law<const D: usize>(what: &str, scene: &Scene<D>, step: f64, steps: usize, bound: f64) {
    for scheme in FORMS {
        let mut run = Simulation::new(scene.clone(), scheme, step).unwrap();
        run.keep_history(History::default());
        let energy = Objective::at_end(Quantity::TotalEnergy);
        let start = run.gradient(&energy).unwrap();
        for _ in 0..steps {
            run.step().unwrap();
        }
        let end = run.gradient(&energy).unwrap();
        let off = difference(&end, &start);
        println!("{what}, {scheme}: {off:e}");
        assert!(off <= bound, "{what}, {scheme}: {off:e}\n{:?}\n{:?}", end.numbers(), start.numbers());
    }
}

#[test]
fn the_gradient_of_the_energy_is_kept() {
    assert_energy_law("single", &single_pendulum_scene().0, 0.1, 50, 1e-12);
    for case in DoublePendulum::ALL {
        assert_energy_law(case.name, &case.scene().0, case.step, 20, 1e-10);
    }
}

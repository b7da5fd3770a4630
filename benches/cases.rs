//! Time of one step of the published cases, and of what a spring can have; see `README.md`.

#![allow(clippy::unwrap_used, reason = "a benchmark fails by panicking")]

use divan::Bencher;
use eem::prelude::*;
use eem_testkit::scenes::{
    DoublePendulum, Hencky, LogarithmicStiffness, ThermoViscoElastic, single_pendulum,
};

/// Runs per line; the fastest is the one to look at on a busy machine.
const RUNS: u32 = 20;

/// The published step of the single pendulum, s.
const PENDULUM_STEP: f64 = 0.2;
/// The published duration of its runs, s.
const PENDULUM_DURATION: f64 = 20.0;
/// Steps of the springs on their own.
const STEPS: usize = 400;
/// Their size, s: a twelfth of the period of the elastic spring.
const STEP: f64 = 0.05;

/// The schemes that complete all of the published runs.
const SCHEMES: [Scheme; 2] = [Scheme::EemTemperature, Scheme::EemEntropy];

fn main() {
    println!("Newton iterations per step, and steps before one that a scheme cannot do");
    for scheme in Scheme::ALL {
        let pendulum = || single_pendulum(scheme, PENDULUM_STEP).run;
        report("single pendulum", pendulum(), pendulum_steps());
        for case in DoublePendulum::ALL {
            let run = case.simulation(scheme, case.step).run;
            report(case.name, run, steps(&case));
        }
    }
    divan::main();
}

fn report<const D: usize>(name: &str, mut run: Simulation<D>, steps: usize) {
    let iterations = (0..steps).map_while(|_| Some(run.step().ok()?.iterations));
    let (done, sum) = iterations.fold((0, 0), |(done, sum), more| (done + 1, sum + more));
    let number = |count: usize| f64::from(u32::try_from(count).unwrap());
    let mean = number(sum) / number(done);
    println!(
        "{:24} {name:16} {mean:5.2}   {done} of {steps}",
        run.scheme().name()
    );
}

fn pendulum_steps() -> usize {
    whole(PENDULUM_DURATION / PENDULUM_STEP)
}

fn steps(case: &DoublePendulum) -> usize {
    whole(case.duration / case.step)
}

/// The whole number of steps next to a duration over a step.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a few thousand, positive"
)]
fn whole(steps: f64) -> usize {
    steps.round() as usize
}

/// A sample is a whole run, or what a scheme can do of it: the time is a mean over fast and slow
/// phases.
fn bench<const D: usize>(
    bencher: Bencher<'_, '_>,
    steps: usize,
    start: impl Fn() -> Simulation<D>,
) {
    let mut trial = start();
    let steps = (0..steps).take_while(|_| trial.step().is_ok()).count();
    let mut run = start();
    let mut left = steps;
    bencher.bench_local(move || {
        if left == 0 {
            run = start();
            left = steps;
        }
        left -= 1;
        run.step().unwrap()
    });
}

/// The single pendulum of García Orden & Romero (2012), §4.1, with the published step.
#[divan::bench(args = Scheme::ALL, sample_size = 100, sample_count = RUNS)]
fn single(bencher: Bencher<'_, '_>, scheme: Scheme) {
    bench(bencher, pendulum_steps(), || {
        single_pendulum(scheme, PENDULUM_STEP).run
    });
}

/// The double pendulums of Conde Martín, Betsch & García Orden (2016), with the published steps.
#[divan::bench_group(sample_count = RUNS)]
mod double {
    use super::{Bencher, DoublePendulum, Scheme, bench, steps};

    fn case(bencher: Bencher<'_, '_>, case: DoublePendulum, scheme: Scheme) {
        bench(bencher, steps(&case), || {
            case.simulation(scheme, case.step).run
        });
    }

    #[divan::bench(args = Scheme::ALL, sample_size = 83)]
    fn romero(bencher: Bencher<'_, '_>, scheme: Scheme) {
        case(bencher, DoublePendulum::ROMERO, scheme);
    }

    #[divan::bench(args = Scheme::ALL, sample_size = 5_000)]
    fn krueger(bencher: Bencher<'_, '_>, scheme: Scheme) {
        case(bencher, DoublePendulum::KRUEGER, scheme);
    }

    #[divan::bench(args = Scheme::ALL, sample_size = 250)]
    fn log(bencher: Bencher<'_, '_>, scheme: Scheme) {
        case(bencher, DoublePendulum::LOGARITHMIC, scheme);
    }
}

/// One mass on one spring, and what the spring has.
#[divan::bench_group(sample_size = 400, sample_count = RUNS)]
mod features {
    use super::{
        Bencher, Hencky, LogarithmicStiffness, SCHEMES, STEP, STEPS, Scene, Scheme, Simulation,
        ThermoViscoElastic, bench,
    };
    use eem::FreeEnergy;

    const ELASTIC: Hencky = Hencky {
        stiffness: 100.0,
        natural_length: 1.0,
    };

    const THERMOELASTIC: LogarithmicStiffness = LogarithmicStiffness {
        stiffness: 100.0,
        softening: 0.5,
        coupling: 4.0,
        capacity: 1.0,
        natural_length: 1.0,
        theta_ref: 300.0,
    };

    /// A mass on a spring, with heat conducted to the air if there is a conductance, W/K.
    fn scene<M>(model: M, temperature: Option<f64>, conductance: Option<f64>) -> Scene<2>
    where
        M: FreeEnergy<f64> + Send + Sync + 'static,
    {
        let mut scene = Scene::<2>::new();
        let pivot = scene.anchor([0.0, 0.0]);
        let bob = scene.mass(1.0, [3.0, 0.0], [0.0, 1.0]);
        let spring = scene.spring(model, [pivot, bob]);
        if let Some(temperature) = temperature {
            scene.set_temperature(spring, temperature);
        }
        if let Some(conductance) = conductance {
            let air = scene.reservoir(300.0);
            scene.conduct(spring, air, conductance);
        }
        scene
    }

    fn run(bencher: Bencher<'_, '_>, scheme: Scheme, scene: impl Fn() -> Scene<2>) {
        bench(bencher, STEPS, || {
            Simulation::new(scene(), scheme, STEP).unwrap()
        });
    }

    #[divan::bench(args = SCHEMES)]
    fn elastic(bencher: Bencher<'_, '_>, scheme: Scheme) {
        run(bencher, scheme, || scene(ELASTIC, None, None));
    }

    #[divan::bench(args = SCHEMES)]
    fn thermoelastic(bencher: Bencher<'_, '_>, scheme: Scheme) {
        run(bencher, scheme, || scene(THERMOELASTIC, Some(380.0), None));
    }

    #[divan::bench(args = SCHEMES)]
    fn thermoelastic_conducting(bencher: Bencher<'_, '_>, scheme: Scheme) {
        run(bencher, scheme, || {
            scene(THERMOELASTIC, Some(380.0), Some(0.1))
        });
    }

    #[divan::bench(args = SCHEMES)]
    fn thermo_visco_elastic(bencher: Bencher<'_, '_>, scheme: Scheme) {
        run(bencher, scheme, || {
            scene(ThermoViscoElastic::PENDULUM, Some(380.0), None)
        });
    }

    #[divan::bench(args = SCHEMES)]
    fn thermo_visco_elastic_conducting(bencher: Bencher<'_, '_>, scheme: Scheme) {
        run(bencher, scheme, || {
            scene(ThermoViscoElastic::PENDULUM, Some(380.0), Some(10.0))
        });
    }
}

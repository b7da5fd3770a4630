//! A step whose forces are wrong is refused, however it was found.

use eem::prelude::*;
use eem::{Caloric, Law, Rates, StepFailure};

use crate::support::{LogarithmicStiffness, ThermoViscoElastic};

/// Relative error of the force f*.
const ERROR: f64 = 1e-7;

/// A material whose discrete force f* is wrong: everything else is that of the material, and the wrong
/// force moves momenta and does work alike.
#[derive(Clone, Debug)]
struct Spoilt<M> {
    material: M,
    error: f64,
}

macro_rules! forward {
    ($($method:ident($($argument:ident: $kind:ty),*) -> $result:ty;)*) => {
        $(fn $method(&self, $($argument: $kind),*) -> $result {
            self.material.$method($($argument),*)
        })*
    };
}

impl<M: FreeEnergy<f64>> FreeEnergy<f64> for Spoilt<M> {
    const MEASURES: usize = M::MEASURES;
    const DASHPOTS: usize = M::DASHPOTS;
    const THERMAL: bool = M::THERMAL;
    const MODEL: &'static str = M::MODEL;
    const PARAMETERS: &'static [&'static str] = M::PARAMETERS;

    type Parameters = M::Parameters;
    type Variables = M::Variables;
    type Hessian = M::Hessian;
    type Viscosities = M::Viscosities;
    type Drag = M::Drag;
    type Corners = M::Corners;
    type Response = M::Response;
    type Tangent = M::Tangent;
    type EntropyFormOld = M::EntropyFormOld;
    type TemperatureFormOld = M::TemperatureFormOld;

    fn duplicate(&self) -> Self {
        Self {
            material: self.material.duplicate(),
            error: self.error,
        }
    }

    forward! {
        parameter(index: usize) -> f64;
        free_energy(x: &M::Variables) -> f64;
        energy_magnitude(x: &M::Variables) -> f64;
        internal_energy(x: &M::Variables) -> f64;
        gradient(x: &M::Variables) -> M::Variables;
        hessian(x: &M::Variables) -> (M::Variables, M::Hessian);
        caloric(x: &M::Variables) -> Caloric<f64>;
        entropy_hessian(x: &M::Variables) -> M::Hessian;
        viscosity(theta: f64) -> (M::Viscosities, M::Viscosities);
        drag(theta: f64) -> (M::Drag, M::Drag);
        entropy_form_old(x0: &M::Variables) -> M::EntropyFormOld;
        temperature_form_old(x0: &M::Variables) -> M::TemperatureFormOld;
    }

    fn rates(&self, x: &M::Variables) -> Rates<M::Variables> {
        let mut rates = self.material.rates(x);
        rates.forces[0] *= 1.0 + self.error;
        rates
    }

    fn entropy_form(
        &self,
        old: &M::EntropyFormOld,
        x1: &M::Variables,
        corners: &M::Corners,
    ) -> (M::Response, M::Tangent) {
        self.spoil(self.material.entropy_form(old, x1, corners))
    }

    fn temperature_form(
        &self,
        old: &M::TemperatureFormOld,
        x1: &M::Variables,
    ) -> (M::Response, M::Tangent) {
        self.spoil(self.material.temperature_form(old, x1))
    }
}

impl<M: FreeEnergy<f64>> Spoilt<M> {
    fn spoil(
        &self,
        (mut response, mut tangent): (M::Response, M::Tangent),
    ) -> (M::Response, M::Tangent) {
        response[0] *= 1.0 + self.error;
        for entry in tangent[0].as_mut() {
            *entry *= 1.0 + self.error;
        }
        (response, tangent)
    }
}

/// The published single pendulum.
fn single(error: f64, scheme: Scheme) -> Simulation<2> {
    let material = ThermoViscoElastic::PENDULUM;
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0; 2]);
    let bob = scene.mass(1.0, [3.0, 0.0], [0.0, 1.0]);
    let spring = scene.spring(Spoilt { material, error }, [pivot, bob]);
    scene.set_temperature(spring, 380.0);
    let air = scene.reservoir(300.0);
    scene.conduct(spring, air, 10.0);
    Simulation::new(scene, scheme, 0.2).unwrap()
}

/// The published double pendulum with logarithmic stiffness.
fn log(error: f64, scheme: Scheme) -> Simulation<3> {
    let first = LogarithmicStiffness::FIRST;
    let second = LogarithmicStiffness {
        stiffness: 10_000.0,
        softening: 60.0,
        capacity: 2000.0,
        natural_length: 1.0,
        ..first.clone()
    };
    let mut scene = Scene::<3>::new();
    let pivot = scene.anchor([0.0; 3]);
    let [upper, lower] = [(10.0, [3.0, 0.0, 0.5]), (20.0, [3.0, 1.0, 1.0])]
        .map(|(mass, position)| scene.mass(mass, position, [0.0; 3]));
    scene.set_momentum(upper, [0.0, 10.0, 0.0]);
    scene.set_momentum(lower, [0.0, 0.0, -20.0]);
    let mut spring = |material, nodes, theta| {
        let spring = scene.spring(Spoilt { material, error }, nodes);
        scene.set_temperature(spring, theta);
        spring
    };
    let upper_spring = spring(first, [pivot, upper], 380.0);
    let lower_spring = spring(second, [upper, lower], 298.0);
    scene.conduct(upper_spring, lower_spring, 300.0);
    Simulation::new(scene, scheme, 0.1).unwrap()
}

/// The first step is refused with the wrong force and taken with the right one.
fn check<const D: usize>(case: impl Fn(f64, Scheme) -> Simulation<D>) {
    for scheme in [Scheme::EemEntropy, Scheme::EemTemperature] {
        case(0.0, scheme).step().unwrap();
        let mut run = case(ERROR, scheme);
        let before = run.ledger();
        let failure = run.step().unwrap_err().failure;
        assert!(
            matches!(
                failure,
                StepFailure::LawNotKept {
                    law: Law::Energy,
                    element: Some(_),
                    ..
                }
            ),
            "{scheme:?}: {failure}"
        );
        assert_eq!(run.ledger(), before);
    }
}

#[test]
fn a_step_of_the_single_pendulum_with_a_wrong_force_is_refused() {
    check(single);
}

#[test]
fn a_step_of_the_double_pendulum_with_a_wrong_force_is_refused() {
    check(log);
}

/// The mean correction of an explicit run of half a second.
fn correction<const D: usize>(mut run: Simulation<D>, steps: u32) -> f64 {
    run.set_step_size(0.5 / f64::from(steps)).unwrap();
    for _ in 0..steps {
        run.step().unwrap();
    }
    run.corrections().total / f64::from(steps)
}

/// An explicit step puts the energy back also where a force is wrong: then what it puts back falls with the
/// first power of the step, and not with the ninth.
#[test]
fn the_correction_of_explicit_steps_shows_a_wrong_force() {
    const STEPS: [u32; 2] = [50, 100];
    const WRONG: f64 = 1e-6;
    let explicit = Scheme::EemExplicit;
    let check = |name: &str, of: &dyn Fn(f64, u32) -> f64| {
        let [honest, wrong] = [0.0, WRONG].map(|error| STEPS.map(|steps| of(error, steps)));
        let slope = (wrong[0] / wrong[1]).log2();
        println!("{name}: honest {honest:?}, wrong {wrong:?}, slope {slope}");
        assert!((slope - 1.0).abs() <= 0.3, "{name}: {slope}");
        assert!(wrong[1] > 100.0 * honest[1], "{name}");
    };
    check("single", &|error, steps| {
        correction(single(error, explicit), steps)
    });
    check("log", &|error, steps| {
        correction(log(error, explicit), steps)
    });
}

//! Loads that are functions of time are not passed over by controlled steps.

use std::f64::consts::PI;
use std::panic::{AssertUnwindSafe, catch_unwind};

use eem::materials::ThermoelasticSpring;
use eem::prelude::*;
use eem::{StepFailure, StepLimit, TimedLoad};
use eem_testkit::length::at_length;
use eem_testkit::random::Random;

use crate::support::hooke;

/// The time of a run, s, and how long a bump lasts: a hundredth of it.
const SPAN: f64 = 10.0;
const BUMP: f64 = 0.01 * SPAN;

const TOLERANCE: f64 = 1e-4;

/// Below this error, in tolerances, a bump has been seen; one that is missed makes an error of more than ten times as much (see
/// `a_bump_matters`).
const SEEN: f64 = 20.0;

/// The same with a tolerance for the run. Steps are accepted up to 1.2, with estimates right to a tenth; the samples and the mean of
/// a load may each miss one more; and a bump makes the largest momentum 1.75 times that of the swing: 1.75 (1.2 · 1.1 + 2) = 5.8.
const OVER: f64 = 5.8;

/// `(1 + cos 2πx)/2` around its middle, s.
fn bump(time: f64, middle: f64) -> f64 {
    let x = (time - middle) / BUMP;
    if x.abs() < 0.5 {
        0.5 + 0.5 * (2.0 * PI * x).cos()
    } else {
        0.0
    }
}

/// `∫ bump(t) f(t) dt` by Simpson's rule; the error is of the order (1/200)⁴.
fn weighted(middle: f64, of: impl Fn(f64) -> f64) -> f64 {
    let step = BUMP / 200.0;
    let term = |index: i32| {
        let time = middle + step * f64::from(index - 100);
        let weight = match index {
            0 | 200 => 1.0,
            _ if index % 2 == 1 => 4.0,
            _ => 2.0,
        };
        weight * bump(time, middle) * of(time)
    };
    step / 3.0 * (0..=200).map(term).sum::<f64>()
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Load {
    Force,
    Thrust,
    Motion,
    Temperature,
    Oven,
}

impl Load {
    const ALL: [Self; 5] = [
        Self::Force,
        Self::Thrust,
        Self::Motion,
        Self::Temperature,
        Self::Oven,
    ];

    /// The largest force on the mass, N.
    fn force(self) -> f64 {
        match self {
            Self::Force | Self::Thrust => FORCE,
            Self::Motion => OMEGA * OMEGA * SHIFT,
            Self::Temperature | Self::Oven => 0.0,
        }
    }

    /// The scales of position, m, momentum, kg m/s, and temperature, K. From rest the momentum is the impulse of the bump.
    fn scales(self, swing: f64) -> [f64; 3] {
        let momentum = if swing > 0.0 {
            swing * OMEGA
        } else {
            0.5 * BUMP * self.force()
        };
        [1.0, momentum, 300.0]
    }
}

/// A mass of 1 kg on a spring of 4 N/m that swings by 0.1 m or is at rest, and two springs of 2 J/K with a conductance of 10 W/K between them.
struct Bumped {
    scene: Scene<1>,
    mass: Node,
    second: Element,
}

const OMEGA: f64 = 2.0;
const SWING: f64 = 0.1;
const AT_REST: f64 = 0.0;

/// κ/c of the second spring, 1/s.
const RATE: f64 = 5.0;

const FORCE: f64 = 3.0;
const SHIFT: f64 = 0.3;
const WARMING: f64 = 100.0;

impl Bumped {
    fn new(load: Load, swing: f64, middle: f64) -> Self {
        let mut scene = Scene::<1>::new();
        let hook = scene.anchor([0.0]);
        let mass = scene.mass(1.0, [1.0 + swing], [0.0]);
        let stiffness = OMEGA * OMEGA;
        scene.spring(hooke(stiffness, 1.0), [hook, mass]);
        let ends = [scene.anchor([0.0]), scene.anchor([1.0])];
        let mut wire = || {
            let wire = ThermoelasticSpring {
                stiffness: 1.0,
                coupling: 0.0,
                capacity: 2.0,
                natural_length: 1.0,
                theta_ref: 300.0,
            };
            let wire = scene.spring(wire, ends);
            scene.set_temperature(wire, 300.0);
            wire
        };
        let [first, second] = [wire(), wire()];
        match load {
            Load::Force => scene.force(mass, move |t| [FORCE * bump(t, middle)]),
            Load::Thrust => scene.rocket(mass, [hook, mass], move |t| FORCE * bump(t, middle)),
            Load::Motion => scene.move_anchor(hook, move |t| [SHIFT * bump(t, middle)]),
            Load::Temperature => {
                scene.prescribe_temperature(first, move |t| 300.0 + WARMING * bump(t, middle));
            }
            Load::Oven => {
                let oven = scene.oven(move |t| 300.0 + WARMING * bump(t, middle));
                scene.conduct(second, oven, 2.0 * RATE);
            }
        }
        if load == Load::Temperature {
            scene.conduct(second, first, 2.0 * RATE);
        }
        Self {
            scene,
            mass,
            second,
        }
    }

    /// Position and momentum of the mass, and the temperature of the second spring, by Duhamel's integral:
    ///
    /// ```text
    /// q = 1 + a cos ωT + ∫ f sin(ω(T − t))/ω dt,   p = q̇,   θ = 300 + (κ/c) ∫ δθ exp(−κ(T − t)/c) dt
    /// ```
    fn exact(load: Load, swing: f64, middle: f64) -> [f64; 3] {
        let force = load.force();
        let warming = match load {
            Load::Temperature | Load::Oven => WARMING,
            _ => 0.0,
        };
        let angle = |time| OMEGA * (SPAN - time);
        let q = 1.0 + swing * (OMEGA * SPAN).cos();
        let p = -swing * OMEGA * (OMEGA * SPAN).sin();
        let cooling = weighted(middle, |time| (RATE * (time - SPAN)).exp());
        [
            q + force * weighted(middle, |time| angle(time).sin() / OMEGA),
            p + force * weighted(middle, |time| angle(time).cos()),
            300.0 + warming * RATE * cooling,
        ]
    }
}

/// The worst error, in tolerances, of runs with a bump anywhere.
fn worst(
    (load, swing): (Load, f64),
    (scheme, tolerance): (Scheme, Tolerance),
    places: u32,
    random: &mut Random,
) -> f64 {
    let mut worst = 0.0_f64;
    for place in 0..places {
        // The last place is near the end, where the bump has just acted on the temperature.
        let share = random.unit();
        let middle = match place {
            0 => SPAN - BUMP,
            _ => BUMP + share * (SPAN - 2.0 * BUMP),
        };
        let Bumped {
            scene,
            mass,
            second,
        } = Bumped::new(load, swing, middle);
        let mut run = Simulation::new(scene, scheme, 1.0).unwrap();
        run.control_steps(tolerance).unwrap();
        run.run_until(SPAN).unwrap();
        let ends = [
            run.position(mass).unwrap()[0],
            run.momentum(mass).unwrap()[0],
            run.temperature(second).unwrap(),
        ];
        let exact = Bumped::exact(load, swing, middle);
        for ((end, exact), scale) in ends.into_iter().zip(exact).zip(load.scales(swing)) {
            let error = (end - exact).abs();
            // A momentum that is zero and stays so has no scale.
            if error > 0.0 {
                worst = worst.max(error / scale / tolerance.relative);
            }
        }
    }
    worst
}

fn no_bump_is_missed(swing: f64, places: u32, mut random: Random) {
    let tolerance = Tolerance::new(TOLERANCE);
    for load in Load::ALL {
        for scheme in [
            Scheme::EemTemperature,
            Scheme::EemEntropy4,
            Scheme::EemEntropy6,
            Scheme::EemExplicit,
            Scheme::Auto,
        ] {
            // It refuses rockets.
            if load == Load::Thrust && scheme == Scheme::EemExplicit {
                continue;
            }
            let worst = worst((load, swing), (scheme, tolerance), places, &mut random);
            assert!(worst < SEEN, "{load:?}, {scheme}: {worst} tolerances");
        }
    }
}

#[test]
fn a_bump_of_a_hundredth_of_a_run_is_never_missed() {
    no_bump_is_missed(SWING, at_length(2_000, 7), Random::new(45));
}

/// Where nothing moves, steps grow without limit until a load is seen.
#[test]
fn a_bump_from_rest_is_never_missed() {
    no_bump_is_missed(AT_REST, at_length(2_000, 6), Random::new(46));
}

/// The errors of all steps add up to the tolerance, those of the load among them.
#[test]
fn a_bump_is_seen_with_a_tolerance_over_the_run() {
    let places = at_length(500, 5);
    let mut random = Random::new(47);
    let tolerance = Tolerance::new(TOLERANCE).over(SPAN);
    for swing in [SWING, AT_REST] {
        for scheme in [Scheme::EemTemperature, Scheme::EemEntropy4] {
            let worst = worst(
                (Load::Force, swing),
                (scheme, tolerance),
                places,
                &mut random,
            );
            assert!(worst < OVER, "{swing}, {scheme}: {worst} tolerances");
        }
    }
}

/// A bump changes what is compared by hundreds of tolerances, so that the tests above would notice one that is missed.
#[test]
fn a_bump_matters() {
    for load in Load::ALL {
        for swing in [SWING, AT_REST] {
            let with = Bumped::exact(load, swing, SPAN - BUMP);
            let without = [
                1.0 + swing * (OMEGA * SPAN).cos(),
                -swing * OMEGA * (OMEGA * SPAN).sin(),
                300.0,
            ];
            let changes = with.into_iter().zip(without).zip(load.scales(swing));
            let changes = changes.map(|((with, without), scale)| (with - without).abs() / scale);
            let most = changes.fold(0.0, f64::max) / TOLERANCE;
            assert!(most > 10.0 * SEEN, "{load:?}: {most}");
        }
    }
}

/// A mass on a soft spring that a run of 1 s follows in one step, and a force.
fn quiet(force: impl Fn(f64) -> f64 + Send + Sync + 'static) -> (Scene<1>, Node) {
    let mut scene = Scene::<1>::new();
    let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.0], [1e-3])];
    let spring = hooke(1e-4, 1.0);
    scene.spring(spring, ends);
    scene.force(ends[1], move |t: f64| [force(t)]);
    (scene, ends[1])
}

const BETWEEN: std::ops::Range<f64> = 0.60..0.61;

#[test]
fn a_load_that_panics_in_a_sample_leaves_the_run() {
    let (scene, _) = quiet(|t| {
        assert!(!BETWEEN.contains(&t), "at {t} s");
        0.0
    });
    let mut run = Simulation::new(scene, Scheme::EemTemperature, 1.0).unwrap();
    run.control_steps(Tolerance::new(TOLERANCE)).unwrap();
    let before = run.checkpoint();
    let caught = catch_unwind(AssertUnwindSafe(|| run.run_until(1.0)));
    assert!(caught.is_err());
    assert_eq!(run.checkpoint(), before);
    run.run_until(0.3).unwrap();
}

#[test]
fn a_value_that_is_not_a_number_between_the_times_of_the_scheme_is_an_error() {
    for scheme in [
        Scheme::EemTemperature,
        Scheme::EemEntropy4,
        Scheme::EemExplicit,
        Scheme::Auto,
    ] {
        let (scene, mass) = quiet(|t| if BETWEEN.contains(&t) { f64::NAN } else { 0.0 });
        let mut run = Simulation::new(scene, scheme, 1.0).unwrap();
        run.control_steps(Tolerance::new(TOLERANCE)).unwrap();
        let failure = run.run_until(1.0).unwrap_err().failure;
        let StepFailure::Load {
            node,
            axis: 0,
            time,
            ..
        } = failure
        else {
            panic!("{scheme}: {failure}");
        };
        assert!(node == mass && BETWEEN.contains(&time), "{scheme}: {time}");
    }
}

/// A load without a scale on which it is smooth.
#[test]
fn a_load_that_no_step_resolves_is_named() {
    let mut scene = Scene::<1>::new();
    let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.1], [0.0])];
    let mass = ends[1];
    scene.spring(hooke(4.0, 1.0), ends);
    let noise = |t: f64| Random::new(t.to_bits()).unit() - 0.5;
    scene.force(mass, move |t: f64| [noise(t)]);
    let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.1).unwrap();
    run.control_steps(Tolerance::new(TOLERANCE)).unwrap();
    run.limit_steps([0.02, 1.0]).unwrap();
    let before = run.checkpoint();
    let failure = run.run_until(1.0).unwrap_err().failure;
    let StepFailure::TooSmall { limit, .. } = &failure else {
        panic!("{failure}");
    };
    assert_eq!(
        **limit,
        StepLimit::Load {
            load: TimedLoad::Force(mass)
        }
    );
    let text = failure.to_string();
    assert!(
        text.contains("the force on node 1 changes so much"),
        "{text}"
    );
    assert_eq!(run.checkpoint(), before);
}

#[test]
fn invalid_times_of_loads_are_errors_of_the_scene() {
    let mut scene = Scene::<1>::new();
    scene.stop_at([1.0, f64::NAN]);
    scene.shortest_load(0.0);
    scene.shortest_load(f64::INFINITY);
    scene.stop_at([f64::INFINITY]);
    let text: Vec<_> = scene.errors().iter().map(ToString::to_string).collect();
    assert_eq!(
        text,
        [
            "steps cannot end at NaN s, the time must be finite",
            "the shortest load lasts 0 s, which must be positive and finite",
            "the shortest load lasts inf s, which must be positive and finite",
            "steps cannot end at inf s, the time must be finite",
        ]
    );
}

/// Two masses on springs under gravity and a smooth force.
fn forced() -> Scene<2> {
    let mut scene = Scene::<2>::new();
    let hook = scene.anchor([0.0, 0.0]);
    let near = scene.mass(1.0, [1.1, 0.0], [0.0, 0.5]);
    let far = scene.mass(0.5, [2.0, 0.2], [0.0, 0.0]);
    let spring = |stiffness| hooke(stiffness, 1.0);
    scene.spring(spring(100.0), [hook, near]);
    scene.spring(spring(50.0), [near, far]);
    scene.set_gravity([0.0, -9.81]);
    scene.force(far, |t: f64| [3.0 * (2.0 * t).sin(), (5.0 * t).cos()]);
    scene
}

/// A warm spring whose anchor and temperature are moved smoothly.
fn shaken() -> Scene<2> {
    let mut scene = Scene::<2>::new();
    let wire = ThermoelasticSpring {
        stiffness: 100.0,
        coupling: 0.5,
        capacity: 2.0,
        natural_length: 1.0,
        theta_ref: 300.0,
    };
    let hook = scene.anchor([0.0, 0.0]);
    let mass = scene.mass(1.0, [1.1, 0.0], [0.0, 0.5]);
    let wire = scene.spring(wire, [hook, mass]);
    scene.set_temperature(wire, 300.0);
    scene.move_anchor(hook, |t: f64| [0.1 * (1.0 - (3.0 * t).cos()), 0.0]);
    scene.prescribe_temperature(wire, |t: f64| 300.0 + 20.0 * (0.7 * t).sin());
    scene
}

/// The counts are those of the same runs without a look at the loads.
#[test]
fn smooth_loads_cost_no_steps() {
    type Build = fn() -> Scene<2>;
    for (name, scene, scheme, relative, counted) in [
        ("forced", forced as Build, Scheme::EemEntropy4, 1e-4, 152),
        ("forced", forced, Scheme::EemEntropy6, 1e-4, 53),
        ("forced", forced, Scheme::EemExplicit, 1e-4, 94),
        ("forced", forced, Scheme::EemEntropy6, 1e-6, 119),
        ("forced", forced, Scheme::EemExplicit, 1e-8, 285),
        ("shaken", shaken, Scheme::EemEntropy4, 1e-4, 151),
        ("shaken", shaken, Scheme::EemEntropy6, 1e-6, 115),
    ] {
        let mut run = Simulation::new(scene(), scheme, 0.01).unwrap();
        run.control_steps(Tolerance::new(relative)).unwrap();
        run.run_until(10.0).unwrap();
        let steps = run.step_statistics().unwrap().accepted;
        let most = 1.05 * f64::from(counted);
        assert!(
            f64::from(u32::try_from(steps).unwrap()) <= most,
            "{name}, {scheme}, {relative:e}: {steps} steps"
        );
    }
}

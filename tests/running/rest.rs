//! Masses at rest that smooth loads set in motion: step control begins, is accurate, and takes no more steps than with the best
//! absolute tolerance of momenta.

use std::ops::ControlFlow;

use eem::prelude::*;
use eem::{Equilibrium, Tolerance};
use eem_testkit::length::{at_length, in_turn, is_long};

use crate::support::springs::{Braked, Branched, linear};
use crate::support::{hencky, hooke};

/// ψ = ½ k (λ − 1)² + c (θ − 300 − θ ln(θ/300)), η beside it, constant.
#[derive(Clone, FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    0.5 * k * (lambda - 1.0).powi(2) + c * (theta - 300.0 - theta * ln(theta / 300.0))
})]
#[viscosity(lambda = eta)]
struct KelvinVoigt {
    k: f64,
    c: f64,
    eta: f64,
}

/// J/K
const CAPACITY: f64 = 2.0;

/// A kind of spring.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Linear,
    Maxwell,
    KelvinVoigt,
}

/// One mass on a spring, and a load that begins at rest.
#[derive(Clone, Copy, Debug)]
struct Case {
    kind: Kind,
    /// k, N/m, m, kg, and η, N s/m.
    k: f64,
    mass: f64,
    eta: f64,
    /// The end time, s.
    end: f64,
    load: Load,
}

/// A load by name.
type Load = (&'static str, fn(f64) -> f64);

/// Loads over a unit of time, in units of the force.
const LOADS: [Load; 7] = [
    ("t²", |s| s.powi(2)),
    ("t³", |s| s.powi(3)),
    ("t⁴", |s| s.powi(4)),
    ("t⁵", |s| s.powi(5)),
    ("1 − cos", |s| 0.5 * (1.0 - (6.0 * s).cos())),
    ("bump", |s| (-((s - 0.4) / 0.06).powi(2)).exp()),
    ("step", |s| 0.5 * (1.0 + ((s - 0.4) / 0.04).tanh())),
];

/// What a run ends with.
#[derive(Clone, Copy, Debug)]
struct End {
    position: f64,
    momentum: f64,
    temperature: f64,
    largest_momentum: f64,
}

impl Case {
    /// The force, N: up to a tenth of what doubles the length.
    fn force(self, t: f64) -> f64 {
        0.1 * self.k * (self.load.1)(t / self.end)
    }

    fn scene(self) -> (Scene<1>, Node, Option<Element>) {
        let Self { kind, k, eta, .. } = self;
        let mut scene = Scene::<1>::new();
        let mass = scene.mass(self.mass, [1.0], [0.0]);
        let ends = [scene.anchor([0.0]), mass];
        let mut warm = None;
        match kind {
            Kind::Linear => _ = scene.spring(linear(k), ends),
            Kind::Maxwell => {
                let (mu, length) = (k, 1.0);
                scene.spring(Branched { k, mu, eta, length }, ends);
            }
            Kind::KelvinVoigt => {
                let c = CAPACITY;
                let spring = scene.spring(KelvinVoigt { k, c, eta }, ends);
                scene.set_temperature(spring, 300.0);
                warm = Some(spring);
            }
        }
        scene.force(mass, move |t| [self.force(t)]);
        (scene, mass, warm)
    }

    /// By the classical scheme of order 4 in short steps, from the equations of motion alone.
    fn exact(self) -> End {
        let Self { kind, k, eta, .. } = self;
        let beside = if kind == Kind::KelvinVoigt { eta } else { 0.0 };
        let mu = if kind == Kind::Maxwell { k } else { 0.0 };
        // Displacement, velocity, creep, and heat of the dashpot.
        let rate = |t: f64, [u, v, gamma, _]: [f64; 4]| {
            let branch = mu * (u - gamma);
            let force = self.force(t) - k * u - branch - beside * v;
            let creep = if mu > 0.0 { branch / eta } else { 0.0 };
            [v, force / self.mass, creep, beside * v * v]
        };
        let fastest = (k / self.mass).sqrt() + beside / self.mass + mu / eta;
        let steps = (200.0 * self.end * fastest).ceil().max(2000.0);
        let h = self.end / steps;
        let (mut y, mut largest, mut step) = ([0.0; 4], 0.0_f64, 0.0);
        while step < steps {
            let t = step * h;
            let moved = |by: [f64; 4], h: f64| std::array::from_fn(|i| y[i] + h * by[i]);
            let k1 = rate(t, y);
            let k2 = rate(t + 0.5 * h, moved(k1, 0.5 * h));
            let k3 = rate(t + 0.5 * h, moved(k2, 0.5 * h));
            let k4 = rate(t + h, moved(k3, h));
            y = std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
            largest = largest.max((self.mass * y[1]).abs());
            step += 1.0;
        }
        End {
            position: 1.0 + y[0],
            momentum: self.mass * y[1],
            temperature: 300.0 + y[3] / CAPACITY,
            largest_momentum: largest,
        }
    }

    /// The steps and the error of a run, in the norm of a tolerance; why it fails.
    fn run(self, scheme: Scheme, tolerance: Tolerance, exact: End) -> Result<(u64, f64), String> {
        let (scene, mass, warm) = self.scene();
        let run = Simulation::with_tolerance(scene, scheme, tolerance);
        let mut run = run.map_err(|error| error.to_string())?;
        run.run_until(self.end).map_err(|error| error.to_string())?;
        let q = (run.position(mass).unwrap()[0] - exact.position) / exact.position;
        let p = (run.momentum(mass).unwrap()[0] - exact.momentum) / exact.largest_momentum;
        let theta = warm.map_or(0.0, |warm| {
            run.temperature(warm).unwrap() / exact.temperature - 1.0
        });
        let error = q.abs().max(p.abs()).max(theta.abs());
        Ok((run.step_statistics().unwrap().accepted, error))
    }
}

const SCHEMES: [Scheme; 3] = [Scheme::Auto, Scheme::EemTemperature, Scheme::EemEntropy4];

/// Largest error in tolerances, and steps as a multiple of those of the best search.
const LARGEST_ERROR: f64 = 20.0;
const MOST_STEPS: f64 = 3.0;

/// The fewest steps with an absolute tolerance of momenta, of those that are as accurate as asked; the largest, r max |p|, is what
/// a run would use that knows its largest momentum from the start.
fn best(case: Case, scheme: Scheme, relative: f64, exact: End) -> Option<u64> {
    let shares = [1e-4, 1e-3, 1e-2, 0.1, 0.3, 1.0];
    let runs = shares.map(|share| {
        let momentum = share * relative * exact.largest_momentum;
        case.run(
            scheme,
            Tolerance::new(relative).with_momentum(momentum),
            exact,
        )
    });
    let runs = runs.into_iter().flatten();
    let accurate = runs.filter(|&(_, error)| error <= LARGEST_ERROR * relative);
    accurate.map(|(steps, _)| steps).min()
}

fn check(case: Case, scheme: Scheme, relative: f64, searches: bool) {
    let exact = case.exact();
    let made = case.run(scheme, Tolerance::new(relative), exact);
    let name = format!("{case:?}, {scheme}, {relative:e}");
    let (steps, error) = made.unwrap_or_else(|error| panic!("{name}: {error}"));
    let error = error / relative;
    assert!(
        error <= LARGEST_ERROR,
        "{name}: {error} tolerances in {steps} steps"
    );
    if searches && let Some(best) = best(case, scheme, relative, exact) {
        let [own, most] = [steps, best].map(|steps| f64::from(u32::try_from(steps).unwrap()));
        assert!(
            own <= MOST_STEPS * most,
            "{name}: {steps} steps, best {best}"
        );
    }
    if is_long() {
        println!("{name}: {steps} steps, {error:.2} tolerances");
    }
}

/// Three springs, seven loads, three schemes, two tolerances: 126 runs; one tolerance, and the schemes in turn, without `EEM_LONG`.
#[test]
fn smooth_loads_set_masses_in_motion() {
    let kinds = [Kind::Linear, Kind::Maxwell, Kind::KelvinVoigt];
    for (row, kind) in kinds.into_iter().enumerate() {
        for (column, load) in LOADS.into_iter().enumerate() {
            let (k, mass, eta, end) = (100.0, 1.0, 2.0, 2.0);
            let case = Case {
                kind,
                k,
                mass,
                eta,
                end,
                load,
            };
            for &scheme in in_turn(&SCHEMES, row + column) {
                for relative in at_length([1e-4, 1e-6].as_slice(), &[1e-4]) {
                    check(case, scheme, *relative, true);
                }
            }
        }
    }
}

/// Stiff and soft springs, light and heavy masses, dampers up to ten times the critical one, over about five periods.
#[test]
fn neither_mass_nor_stiffness_nor_damping_matters() {
    for (k, mass, part) in [
        (1e6, 1.0, 0.1),
        (1e6, 1e-3, 1.0),
        (1.0, 50.0, 10.0),
        (3e3, 0.02, 0.01),
    ] {
        let eta = part * 2.0 * f64::sqrt(k * mass);
        let end = 30.0 * f64::sqrt(mass / k);
        for kind in [Kind::Maxwell, Kind::KelvinVoigt] {
            for load in LOADS.into_iter().step_by(at_length(1, 3)) {
                let case = Case {
                    kind,
                    k,
                    mass,
                    eta,
                    end,
                    load,
                };
                check(case, Scheme::Auto, 1e-4, false);
            }
        }
    }
}

/// A mass that hangs on two springs, or three, in equilibrium, and is pushed aside by t³; with the same positions and momenta as
/// Gauss collocation in steps of 0.5 ms.
#[test]
fn hanging_masses_are_set_in_motion() {
    fn run<const D: usize>(tolerance: Option<f64>) -> ([f64; D], [f64; D], f64) {
        let mut scene = Scene::<D>::new();
        let mut low = [0.0; D];
        low[D - 1] = -1.0;
        let mass = scene.mass(0.5, low, [0.0; D]);
        for corner in 0..D {
            let mut place = [0.0; D];
            for (axis, entry) in place[..D - 1].iter_mut().enumerate() {
                *entry = if axis == corner { 1.5 } else { -1.0 };
            }
            let hook = scene.anchor(place);
            let spring = hencky(80.0, 1.2);
            scene.spring(spring, [hook, mass]);
        }
        let mut gravity = [0.0; D];
        gravity[D - 1] = -9.81;
        scene.set_gravity(gravity);
        scene.equilibrium(Equilibrium::new()).unwrap();
        scene.force(mass, |t| {
            let mut force = [0.0; D];
            force[0] = 4.0 * t.powi(3);
            force
        });
        let mut run = match tolerance {
            None => Simulation::new(scene, Scheme::Gauss4, 5e-4).unwrap(),
            Some(relative) => {
                let tolerance = Tolerance::new(relative);
                Simulation::with_tolerance(scene, Scheme::Auto, tolerance).unwrap()
            }
        };
        let mut largest = 0.0_f64;
        run.run_until_with(1.0, |run, _| {
            largest = largest.max(run.largest_momentum());
            ControlFlow::Continue(())
        })
        .unwrap();
        (
            run.position(mass).unwrap().into(),
            run.momentum(mass).unwrap().into(),
            largest,
        )
    }
    fn compare<const D: usize>() {
        let (q, p, largest) = run::<D>(None);
        for relative in [1e-4, 1e-6] {
            let (own_q, own_p, _) = run::<D>(Some(relative));
            for axis in 0..D {
                // |q|₂ is above 1 m.
                let errors = [
                    (own_q[axis] - q[axis]).abs(),
                    (own_p[axis] - p[axis]).abs() / largest,
                ];
                let most = LARGEST_ERROR * relative;
                assert!(
                    errors[0].max(errors[1]) <= most,
                    "{D}: {errors:?} at {relative:e}"
                );
            }
        }
    }
    compare::<1>();
    compare::<2>();
    compare::<3>();
}

/// A car at rest on its springs, and a bump of the road after 1 s.
#[test]
fn a_car_runs_over_a_bump() {
    let steps = [1e-4, 1e-8].map(|relative| {
        let mut scene = Scene::<1>::new();
        let road = scene.anchor([0.0]);
        let wheel = scene.mass(40.0, [1.0], [0.0]);
        let body = scene.mass(300.0, [2.0], [0.0]);
        scene.spring(linear(2e5), [road, wheel]);
        scene.spring(
            Branched {
                k: 2e4,
                mu: 1e4,
                eta: 1.5e3,
                length: 1.0,
            },
            [wheel, body],
        );
        scene.set_gravity([-9.81]);
        scene.equilibrium(Equilibrium::new()).unwrap();
        scene.move_anchor(road, |t| {
            let part = (10.0 * (t - 1.0)).clamp(0.0, 1.0);
            [0.025 * (1.0 - (std::f64::consts::TAU * part).cos())]
        });
        let tolerance = Tolerance::new(relative);
        let mut run = Simulation::with_tolerance(scene, Scheme::Auto, tolerance).unwrap();
        run.run_until(3.0).unwrap();
        (
            run.step_statistics().unwrap().accepted,
            run.position(body).unwrap()[0],
        )
    });
    let [(rough, place), (fine, exact)] = steps;
    assert!(rough <= 300 && fine <= 1000, "{rough}, {fine}");
    assert!(
        (place - exact).abs() <= LARGEST_ERROR * 1e-4,
        "{place}, {exact}"
    );
}

/// Neither a length nor a time in the scene: a mass at the origin that nothing holds.
#[test]
fn a_free_mass_at_the_origin_begins_to_move() {
    for scheme in [Scheme::EemTemperature, Scheme::EemEntropy6] {
        let mut scene = Scene::<2>::new();
        let mass = scene.mass(1.0, [0.0, 0.0], [0.0, 0.0]);
        scene.force(mass, |t| [t.powi(3), 0.0]);
        let mut run = Simulation::with_tolerance(scene, scheme, Tolerance::new(1e-5)).unwrap();
        run.run_until(2.0).unwrap();
        let [x, y] = run.position(mass).unwrap().into();
        assert!(
            (x / 1.6 - 1.0).abs() < LARGEST_ERROR * 1e-5,
            "{scheme}: {x}"
        );
        assert_eq!(y.to_bits(), 0.0_f64.to_bits());
    }
}

/// Masses that dashpots bring to rest, and that a flight would take to the mirror image: through its anchor, through the line of two
/// anchors, and through the plane of three.
#[test]
fn masses_at_rest_do_not_fly_to_their_mirror_images() {
    fn check<const D: usize>(
        (anchors, place): (&[[f64; D]], [f64; D]),
        length: f64,
        runs: &[(Scheme, f64, f64)],
    ) {
        for &(scheme, relative, end) in runs {
            let mut scene = Scene::<D>::new();
            let mass = scene.mass(1.0, place, [0.0; D]);
            for &anchor in anchors {
                let ends = [scene.anchor(anchor), mass];
                let (k, eta) = (100.0, 5.0);
                scene.spring(Braked { k, eta, length }, ends);
            }
            let tolerance = Tolerance::new(relative);
            let mut run = Simulation::with_tolerance(scene, scheme, tolerance).unwrap();
            let ran = run.run_until_with(end, |run, report| {
                let height = run.position(mass).unwrap()[D - 1];
                let (time, step) = (report.time, report.step);
                assert!(height > 0.0, "{D}, {scheme}, {time} s, {step} s: {height}");
                ControlFlow::Continue(())
            });
            ran.unwrap();
        }
    }
    check(
        (&[[0.0]], [1.2]),
        1.0,
        &[
            (Scheme::Auto, 1e-2, 1e7),
            (Scheme::EemEntropy4, 0.1, 2e7),
            (Scheme::EemEntropy6, 1e-2, 2e7),
        ],
    );
    check(
        (&[[-1.0, 0.0], [1.0, 0.0]], [0.05, 0.3]),
        1.1,
        &[
            (Scheme::EemTemperature, 0.1, 2e8),
            (Scheme::EemEntropy4, 1e-2, 4e5),
            (Scheme::EemEntropy6, 0.1, 4e5),
        ],
    );
    let corners = [[1.0, 0.0, 0.0], [-0.5, 0.86, 0.0], [-0.5, -0.86, 0.0]];
    check(
        (&corners, [0.1, 0.05, 0.9]),
        1.4,
        &[
            (Scheme::EemDamped, 1e-2, 5e7),
            (Scheme::EemEntropy4, 1e-4, 1e9),
            (Scheme::EemEntropy6, 1e-2, 5e7),
        ],
    );
}

/// A mass that stands on a spring does not fall through its foot to hang below.
#[test]
fn a_standing_mass_does_not_fall_through_its_anchor() {
    for (scheme, relative, end) in [
        (Scheme::Auto, 0.1, 5e7),
        (Scheme::Auto, 1e-2, 5e6),
        (Scheme::EemEntropy4, 0.1, 2e5),
    ] {
        let mut scene = Scene::<1>::new();
        let ends = [scene.anchor([0.0]), scene.mass(1.0, [0.9], [0.0])];
        let (k, eta, length) = (100.0, 5.0, 1.0);
        scene.spring(Braked { k, eta, length }, ends);
        scene.set_gravity([-5.0]);
        let tolerance = Tolerance::new(relative);
        let mut run = Simulation::with_tolerance(scene, scheme, tolerance).unwrap();
        run.run_until(end).unwrap();
        let place = run.position(ends[1]).unwrap()[0];
        assert!((place - 0.95).abs() < 0.1, "{scheme}: {place}");
    }
}

/// Step control takes a motion through an anchor where it follows the vibration: a spring without a length.
#[test]
fn a_mass_may_fly_through_its_anchor() {
    for scheme in [
        Scheme::EemTemperature,
        Scheme::EemEntropy4,
        Scheme::EemEntropy6,
    ] {
        let mut scene = Scene::<1>::new();
        let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.0], [0.0])];
        scene.spring(hooke(1.0, 0.0), ends);
        let tolerance = Tolerance::new(1e-4);
        let mut run = Simulation::with_tolerance(scene, scheme, tolerance).unwrap();
        run.run_until(20.0).unwrap();
        let place = run.position(ends[1]).unwrap()[0];
        assert!(
            (place - f64::cos(20.0)).abs() < 20.0 * 1e-4,
            "{scheme}: {place}"
        );
    }
}

/// A Gaussian push whose tail is below the smallest normal number until t = 2.3 s; its impulse is `w √π`.
#[test]
fn a_free_mass_feels_a_load_that_begins_below_all_numbers() {
    for scheme in [Scheme::EemTemperature, Scheme::EemEntropy6, Scheme::Auto] {
        let mut scene = Scene::<1>::new();
        let mass = scene.mass(2.0, [0.0], [0.0]);
        scene.force(mass, |t: f64| [(-((t - 5.0) / 0.1).powi(2)).exp()]);
        let tolerance = Tolerance::new(1e-4);
        let mut run = Simulation::with_tolerance(scene, scheme, tolerance).unwrap();
        run.run_until(10.0).unwrap();
        let expected = 0.1 * core::f64::consts::PI.sqrt();
        let momentum = run.momentum(mass).unwrap()[0];
        assert!(
            (momentum / expected - 1.0).abs() < 20.0 * 1e-4,
            "{scheme}: {momentum}"
        );
        let steps = run.step_statistics().unwrap();
        assert!(
            steps.accepted + steps.rejected() < 5000,
            "{scheme}: {steps:?}"
        );
    }
}

/// What `equilibrium` leaves of rounding is no vibration that steps have to follow until the load begins.
#[test]
fn a_weight_from_equilibrium_waits_for_its_load_in_few_steps() {
    // u″ = F(t) − 100 u from u = 0, beside the length 1 + 9.81/100, in 30 digits.
    let exact = -1.270_758_629_710_338_3;
    // With the best absolute tolerance of momenta it takes 77, 34, 33 and 33 steps.
    for (scheme, most) in [
        (Scheme::EemEntropy4, 180),
        (Scheme::EemEntropy6, 80),
        (Scheme::EemExplicit, 75),
        (Scheme::Auto, 75),
    ] {
        let mut scene = Scene::<2>::new();
        let hook = scene.anchor([0.0; 2]);
        let mass = scene.mass(1.0, [0.0, -1.0], [0.0; 2]);
        scene.spring(linear(100.0), [hook, mass]);
        scene.set_gravity([0.0, -9.81]);
        scene.equilibrium(Equilibrium::new()).unwrap();
        let push = |t: f64| -10.0 * ((t - 1.4) / 0.4).clamp(0.0, 1.0).powi(3);
        scene.force(mass, move |t| [0.0, push(t)]);
        scene.stop_at([1.4, 1.8]);
        let tolerance = Tolerance::new(1e-8);
        let mut run = Simulation::with_tolerance(scene, scheme, tolerance).unwrap();
        run.run_until(2.0).unwrap();
        let steps = run.step_statistics().unwrap().accepted;
        assert!(steps <= most, "{scheme}: {steps} steps");
        let off = (run.position(mass).unwrap()[1] - exact).abs();
        assert!(off < 20.0 * 1e-8, "{scheme}: off by {off:e} m");
    }
}

/// The unknown that limits a step is named.
#[test]
fn what_limits_a_step_is_named() {
    let load = LOADS[0];
    let case = Case {
        kind: Kind::Maxwell,
        k: 100.0,
        mass: 1.0,
        eta: 2.0,
        end: 2.0,
        load,
    };
    for scheme in [Scheme::EemTemperature, Scheme::EemExplicit] {
        let tolerance = Tolerance::new(1e-8);
        let mut run = Simulation::with_tolerance(case.scene().0, scheme, tolerance).unwrap();
        run.set_step_size(0.1).unwrap();
        run.limit_steps([0.05, 1.0]).unwrap();
        let message = run.step().unwrap_err().to_string();
        for part in [
            "steps of less than 0.05 s would be needed: the error of the last one was ",
            ", most of it in the momentum of node 0 along axis 0: ",
            " kg m/s is allowed; a larger tolerance or `with_momentum` allows more",
        ] {
            assert!(message.contains(part), "{message}");
        }
    }
}

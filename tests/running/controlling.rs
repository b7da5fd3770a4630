//! Forces, motions and temperatures that are set in the middle of a run.

use eem::prelude::*;
use eem_testkit::length::at_length;
use eem_testkit::random::Random;

use crate::support::{EXACT, ThermoViscoElastic, hencky};

/// What a controller acts on.
#[derive(Clone, Copy)]
struct Handles {
    hook: Node,
    masses: [Node; 2],
    warm: Element,
    held: Element,
}

/// Two warm springs that hang on a hook, and one between the masses; the second has a thermostat.
fn scene() -> (Scene<2>, Handles) {
    let mut scene = Scene::<2>::new();
    let hook = scene.anchor([0.0, 0.0]);
    let masses = [
        scene.mass(1.0, [1.5, 0.0], [0.0, 1.0]),
        scene.mass(0.5, [1.5, -1.1], [0.2, 0.0]),
    ];
    let warm = scene.spring(ThermoViscoElastic::PENDULUM, [hook, masses[0]]);
    let held = scene.spring(ThermoViscoElastic::PENDULUM, masses);
    let spring = hencky(30.0, 1.5);
    scene.spring(spring, [hook, masses[1]]);
    scene.set_temperature(warm, 320.0);
    scene.hold_temperature(held, 310.0);
    scene.conduct(warm, held, 3.0);
    let air = scene.reservoir(300.0);
    scene.conduct(warm, air, 10.0);
    let handles = Handles {
        hook,
        masses,
        warm,
        held,
    };
    (scene, handles)
}

/// Sets something at random.
fn act(run: &mut Simulation<2>, random: &mut Random, at: Handles) {
    let mut number = |size: f64| size * (2.0 * random.unit() - 1.0);
    let force = [number(5.0), number(5.0)];
    let speed = [number(0.5), number(0.5)];
    let theta = 310.0 + number(2.0);
    let which = random.below(4);
    match which {
        0 | 1 => run.set_force(at.masses[which], force).unwrap(),
        2 => run.set_motion(at.hook, speed).unwrap(),
        _ => run.set_temperature_of(at.held, theta).unwrap(),
    }
}

#[test]
fn work_and_heat_of_random_controllers_are_booked() {
    for scheme in EXACT {
        let (scene, at) = scene();
        let mut run = Simulation::new(scene, scheme, 0.01).unwrap();
        let mut random = Random::new(7);
        let start = run.ledger();
        let (mut bound, mut entropy) = (0.0, start.entropy);
        for _ in 0..300 {
            act(&mut run, &mut random, at);
            let report = run.step().unwrap();
            // Of the step, and of the sums of the ledger.
            bound += 2.0 * report.bound;
            let now = run.ledger();
            let defect = (now.balance - start.balance).abs();
            assert!(defect <= bound, "{scheme}: {defect:e} above {bound:e}");
            let sizes = now.element_entropy.abs() + now.thermostat_entropy.abs();
            assert!(
                now.entropy - entropy >= -4.0 * f64::EPSILON * sizes,
                "{scheme}"
            );
            entropy = now.entropy;
        }
        let end = run.ledger();
        assert!(end.work.abs() > 0.1 && end.heat.abs() > 0.1, "{scheme}");
    }
}

#[test]
fn solids_are_moved_and_pushed_too() {
    use crate::support::solids::SaintVenant;
    let exact = [
        Scheme::EemEntropy,
        Scheme::EemTemperature,
        Scheme::EemEntropy6,
    ];
    let both = |own| [(own, false), (own, true)];
    for (scheme, is_controlled) in exact.into_iter().flat_map(both) {
        let rubber = SaintVenant {
            lame: 2000.0,
            shear: 1000.0,
        };
        let mut scene = Scene::<2>::new();
        let mesh = Mesh::<Quad4, 2>::block([3, 1], [[0.0, 3.0], [0.0, 1.0]]).unwrap();
        let plate = scene.solid(rubber, &mesh, &Bulk::new(10.0));
        for (&node, [x, _]) in plate.nodes().iter().zip(mesh.nodes()) {
            if *x == 0.0 {
                scene.fix(node);
            }
        }
        let mut run = Simulation::new(scene, scheme, 0.01).unwrap();
        let [root, tip] = [[0.0, 0.0], [3.0, 1.0]].map(|place| plate.node_at(place, 1e-9).unwrap());
        if is_controlled {
            run.control_steps(Tolerance::new(1e-3)).unwrap();
        }
        let start = run.ledger().balance;
        let mut bound = 0.0;
        for step in 0..at_length(40, 12) {
            let time = f64::from(step) * 0.01;
            run.set_force(tip, [0.0, 20.0 * (9.0 * time).sin()])
                .unwrap();
            run.set_motion(root, [0.1 * (5.0 * time).cos(), 0.0])
                .unwrap();
            bound += 2.0 * run.step().unwrap().bound;
        }
        let end = run.ledger();
        assert!(end.work.abs() > 1e-6);
        let defect = (end.balance - start).abs();
        assert!(defect <= bound, "{scheme}: {defect:e} above {bound:e}");
    }
}

#[test]
fn a_constant_force_is_that_of_the_scene() {
    for scheme in Scheme::ALL {
        let (free, at) = scene();
        let mut loaded = free.clone();
        loaded.dead_load(at.masses[0], [1.0, -2.0]);
        let [mut given, mut set] =
            [loaded, free].map(|scene| Simulation::new(scene, scheme, 0.01).unwrap());
        set.set_force(at.masses[0], [1.0, -2.0]).unwrap();
        for run in [&mut given, &mut set] {
            run.run_until(0.2).unwrap();
        }
        let places = [&given, &set].map(|run| run.position(at.masses[1]).unwrap());
        let bits = places.map(|place| place.map(f64::to_bits));
        assert_eq!(bits[0], bits[1], "{scheme}");
    }
}

#[test]
fn velocities_and_temperatures_are_kept() {
    for scheme in EXACT {
        let (scene, at) = scene();
        let mut run = Simulation::new(scene, scheme, 0.01).unwrap();
        run.step().unwrap();
        let start = run.time();
        run.set_motion(at.hook, [0.5, -1.0]).unwrap();
        run.set_temperature_of(at.held, 312.5).unwrap();
        for _ in 0..3 {
            run.step().unwrap();
            let elapsed = run.time() - start;
            let place = run.position(at.hook).unwrap();
            // Three sums of displacements, each rounded.
            let rounding = 8.0 * f64::EPSILON * elapsed;
            assert!((place[0] - 0.5 * elapsed).abs() < rounding, "{scheme}");
            assert!((place[1] + elapsed).abs() < rounding, "{scheme}");
            assert_eq!(run.temperature(at.held), Ok(312.5));
        }
    }
}

#[test]
fn runs_with_controllers_resume_with_all_bits() {
    for scheme in EXACT.into_iter().chain([Scheme::Midpoint, Scheme::Gauss4]) {
        let (scene, at) = scene();
        let build = || Simulation::new(scene.clone(), scheme, 0.01).unwrap();
        let steps = |run: &mut Simulation<2>, at: Handles, seed: u64| {
            let mut random = Random::new(seed);
            for _ in 0..12 {
                act(run, &mut random, at);
                run.step().unwrap();
            }
        };
        let mut run = build();
        steps(&mut run, at, 1);
        // Set, but not reached yet.
        run.set_motion(at.hook, [0.1, 0.0]).unwrap();
        run.set_temperature_of(at.held, 309.0).unwrap();
        let saved = run.checkpoint();
        let mut fresh = build();
        fresh.restore(&saved).unwrap();
        assert_eq!(fresh.checkpoint(), saved, "{scheme}");
        for run in [&mut run, &mut fresh] {
            run.step().unwrap();
            steps(run, at, 2);
        }
        let bits = [&run, &fresh].map(|run| format!("{:?}", run.checkpoint()));
        assert!(bits[0] == bits[1], "{scheme}");
        // Back to a state in which nothing was set.
        let other = build();
        fresh.restore(&other.checkpoint()).unwrap();
        assert_eq!(fresh.checkpoint(), other.checkpoint(), "{scheme}");
    }
}

#[test]
fn a_controller_damps_a_pendulum() {
    let (scene, at) = scene();
    let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.01).unwrap();
    let motion = |run: &Simulation<2>| run.ledger().kinetic_energy;
    let start = motion(&run);
    for _ in 0..600 {
        for node in at.masses {
            let velocity = run.velocity(node).unwrap();
            run.set_force(node, [-1.5 * velocity[0], -1.5 * velocity[1]])
                .unwrap();
        }
        run.step().unwrap();
    }
    assert!(motion(&run) < 1e-3 * start);
    let end = run.ledger();
    assert!(end.work < -0.4, "{}", end.work);
}

#[test]
fn step_control_takes_what_is_set() {
    for scheme in [Scheme::EemTemperature, Scheme::EemEntropy4, Scheme::Auto] {
        let (scene, at) = scene();
        let mut run = Simulation::new(scene, scheme, 0.01).unwrap();
        run.control_steps(Tolerance::new(1e-4)).unwrap();
        let start = run.ledger().balance;
        for index in 0..20_i32 {
            let sign = f64::from(1 - 2 * (index % 2));
            run.set_force(at.masses[0], [3.0 * sign, 0.0]).unwrap();
            run.set_temperature_of(at.held, 310.0 + 0.1 * sign).unwrap();
            run.run_until(0.05 * f64::from(index + 1)).unwrap();
        }
        let end = run.ledger();
        assert!((end.balance - start).abs() < 1e-9 && end.work.abs() > 0.1);
    }
}

#[test]
fn what_cannot_be_set_is_refused() {
    let (mut given, at) = scene();
    given.dead_load(at.masses[0], [1.0, 0.0]);
    given.move_anchor(at.hook, |t: f64| [0.1 * t, 0.0]);
    given.prescribe_temperature(at.warm, |_| 320.0);
    let mut run = Simulation::new(given, Scheme::EemEntropy, 0.01).unwrap();
    let before = format!("{:?}", run.checkpoint());
    let text = |refused: Result<(), SceneError>| refused.unwrap_err().to_string();
    for (message, expected) in [
        (
            text(run.set_force(at.masses[0], [0.0; 2])),
            "the force of node 1 is given by the scene",
        ),
        (
            text(run.set_motion(at.hook, [0.0; 2])),
            "the motion of node 0 is given by the scene",
        ),
        (
            text(run.set_temperature_of(at.warm, 300.0)),
            "the temperature of element 0",
        ),
        (
            text(run.set_force(at.hook, [0.0; 2])),
            "node 0 cannot be given a force",
        ),
        (
            text(run.set_motion(at.masses[1], [0.0; 2])),
            "node 2 cannot be given a prescribed motion",
        ),
        (text(run.set_force(at.masses[1], [0.0, f64::NAN])), "NaN"),
        (text(run.set_temperature_of(at.held, -1.0)), "-1 K"),
        (
            text(run.set_temperature_of(at.held, f64::INFINITY)),
            "inf K",
        ),
    ] {
        assert!(message.contains(expected), "{message}");
    }
    assert_eq!(format!("{:?}", run.checkpoint()), before);

    let (free, at) = scene();
    let mut run = Simulation::new(free, Scheme::EemEntropy, 0.01).unwrap();
    let message = text(run.set_temperature_of(at.warm, 300.0));
    assert!(message.contains("call `hold_temperature`"), "{message}");
    let message = text(run.set_motion(at.hook, [f64::INFINITY, 0.0]));
    assert!(message.contains("inf m/s"), "{message}");
    let (_, foreign) = scene();
    assert!(run.set_force(foreign.masses[0], [0.0; 2]).is_err());
}

/// A wire without expansion that an oven warms: `θ̇ = 2/s (θ_oven − θ)`.
fn oven() -> (Scene<1>, Element, HeatPath, Reservoir) {
    let wire = eem::materials::ThermoelasticSpring {
        stiffness: 5.0,
        coupling: 0.0,
        capacity: 2.0,
        natural_length: 1.0,
        theta_ref: 300.0,
    };
    let mut scene = Scene::<1>::new();
    let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.1], [0.0])];
    let wire = scene.spring(wire, ends);
    scene.set_temperature(wire, 300.0);
    let oven = scene.oven(|t: f64| 300.0 + 10.0 * t);
    let path = scene.conduct(wire, oven, 4.0);
    (scene, wire, path, oven)
}

#[test]
fn ovens_warm_with_order_two_and_keep_the_balance() {
    let exact = 310.0 - 5.0 * (1.0 - (-2.0_f64).exp());
    for scheme in EXACT {
        let error = |steps: u32| {
            let step = f64::from(steps).recip();
            let (scene, wire, path, oven) = oven();
            let mut run = Simulation::new(scene, scheme, step).unwrap();
            run.fix_steps();
            run.meter_heat();
            let start = run.ledger();
            let (mut bound, mut entropy) = (0.0, start.entropy);
            for _ in 0..steps {
                bound += 2.0 * run.step().unwrap().bound;
                let now = run.ledger();
                assert!(now.entropy >= entropy - 4.0 * f64::EPSILON * now.element_entropy.abs());
                entropy = now.entropy;
            }
            let end = run.ledger();
            assert!((end.balance - start.balance).abs() <= bound, "{scheme}");
            let conducted = run.conducted_heat(path).unwrap();
            assert!((conducted - end.heat).abs() < 1e-12 * end.heat, "{scheme}");
            assert_eq!(
                run.reservoir_heat(oven),
                Err(SceneError::Oven { reservoir: oven })
            );
            run.temperature(wire).unwrap() - exact
        };
        let errors = [10, 20].map(|steps| error(steps).abs());
        if scheme == Scheme::Staggered {
            assert!(errors[0] < 0.2 && errors[1] < errors[0], "{errors:?}");
        } else {
            let order = (errors[0] / errors[1]).log2();
            assert!((order - 2.0).abs() < 0.1, "{scheme}: {errors:?}");
        }
    }
}

#[test]
fn runs_with_ovens_resume_with_all_bits() {
    for scheme in EXACT {
        let (scene, ..) = oven();
        let build = || Simulation::new(scene.clone(), scheme, 0.02).unwrap();
        let mut whole = build();
        whole.run_until(0.2).unwrap();
        let saved = whole.checkpoint();
        let mut fresh = build();
        fresh.restore(&saved).unwrap();
        for run in [&mut whole, &mut fresh] {
            run.run_until(0.4).unwrap();
        }
        let bits = [&whole, &fresh].map(|run| format!("{:?}", run.checkpoint()));
        assert!(bits[0] == bits[1], "{scheme}");
    }
}

#[test]
fn an_oven_below_zero_is_an_error_of_the_step() {
    let (mut scene, wire, ..) = oven();
    let cold = scene.oven(|t: f64| 10.0 - 100.0 * t);
    scene.conduct(wire, cold, 0.1);
    let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.05).unwrap();
    let error = run.run_until(1.0).unwrap_err();
    let StepFailure::Oven {
        reservoir: 1,
        value,
        ..
    } = error.failure
    else {
        panic!("{error}");
    };
    assert!(value <= 0.0 && run.time() > 0.05);
    let (mut scene, ..) = oven();
    scene.oven(|_| f64::NAN);
    let refused = Simulation::new(scene, Scheme::EemTemperature, 0.05).unwrap_err();
    assert!(matches!(
        refused.errors(),
        [SceneError::ReservoirTemperature { .. }]
    ));
}

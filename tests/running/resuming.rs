//! A run that is resumed from a saved state has the bits of one that was never interrupted.

use eem::RestoreError;
use eem::prelude::*;

use crate::support::{
    DoublePendulum, ThermoViscoElastic, bits, busy, hencky, hooke, single_pendulum,
};

const STEP: f64 = 0.05;

/// A scene with everything in it.
fn busy_scene(scheme: Scheme) -> Simulation<2> {
    Simulation::new(busy(), scheme, 0.01).unwrap()
}

/// Steps on and keeps the bits of every report and of the state at the end.
fn trace<const D: usize>(run: &mut Simulation<D>, steps: usize) -> (Vec<[u64; 5]>, String) {
    let reports = (0..steps).map(|_| {
        let report = run.step().unwrap();
        let numbers = [report.time, report.step, report.update, report.residual];
        let [time, step, update, residual] = numbers.map(f64::to_bits);
        [time, step, update, residual, report.iterations as u64]
    });
    (reports.collect(), bits(run))
}

/// A resumed run has the bits of an uninterrupted one, in a new simulation and in one that has
/// been elsewhere.
fn assert_resumes<const D: usize>(build: impl Fn() -> Simulation<D>) {
    let mut whole = build();
    let settings = NewtonSettings {
        tolerance: 1e-9,
        ..whole.newton_settings()
    };
    whole.set_newton_settings(settings).unwrap();
    trace(&mut whole, 20);
    whole.set_step_size(0.7 * whole.step_size()).unwrap();
    trace(&mut whole, 3);
    let checkpoint = whole.checkpoint();
    let expected = trace(&mut whole, 40);

    let mut fresh = build();
    let mut elsewhere = build();
    elsewhere
        .set_step_size(0.3 * elsewhere.step_size())
        .unwrap();
    trace(&mut elsewhere, 7);
    for (place, run) in [
        ("fresh", &mut fresh),
        ("elsewhere", &mut elsewhere),
        ("back", &mut whole),
    ] {
        run.restore(&checkpoint).unwrap();
        assert_eq!(run.checkpoint(), checkpoint);
        let scheme = run.scheme().name();
        assert!(trace(run, 40) == expected, "{scheme}, {place}");
    }
}

#[test]
fn resumed_runs_have_the_bits_of_uninterrupted_ones() {
    for scheme in Scheme::ALL {
        assert_resumes(|| single_pendulum(scheme, STEP).run);
        assert_resumes(|| DoublePendulum::KRUEGER.simulation(scheme, STEP).run);
        assert_resumes(|| DoublePendulum::LOGARITHMIC.simulation(scheme, 0.02).run);
        assert_resumes(|| busy_scene(scheme));
    }
}

/// The error of restoring `from` into `to`.
fn refusal<const D: usize, const E: usize>(
    from: &Simulation<D>,
    to: &mut Simulation<E>,
) -> RestoreError {
    let before = bits(to);
    let error = to.restore(&from.checkpoint()).unwrap_err();
    assert_eq!(before, bits(to));
    error
}

/// The sums of an explicit scheme, too, are not evaluated again: then the bound of the next step had other digits.
#[test]
fn a_refused_checkpoint_leaves_the_reports_as_they_were() {
    for scheme in Scheme::ALL {
        let run = || single_pendulum(scheme, STEP).run;
        let [mut whole, mut tried] = [run(), run()];
        trace(&mut whole, 7);
        trace(&mut tried, 7);
        refusal(&busy_scene(scheme), &mut tried);
        let [whole, tried] = [&mut whole, &mut tried].map(|run| run.step().unwrap());
        assert_eq!(whole, tried, "{scheme}");
    }
}

#[test]
fn a_scene_of_another_shape_is_refused_with_what_differs() {
    /// Two nodes, the second an anchor or a mass, and a spring with or without temperature.
    fn scene<const D: usize>(
        second_is_mass: bool,
        thermal: bool,
        reservoirs: usize,
    ) -> Simulation<D> {
        let mut scene = Scene::<D>::new();
        let first = scene.anchor([0.0; D]);
        let second = if second_is_mass {
            scene.mass(1.0, [1.0; D], [0.0; D])
        } else {
            scene.anchor([1.0; D])
        };
        if thermal {
            let spring = scene.spring(ThermoViscoElastic::PENDULUM, [first, second]);
            scene.set_temperature(spring, 300.0);
        } else {
            scene.spring(hencky(1.0, 1.0), [first, second]);
        }
        for _ in 0..reservoirs {
            scene.reservoir(300.0);
        }
        Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap()
    }
    let mut target = scene::<2>(true, true, 1);
    let mut expect = |from: &Simulation<2>, text: &str| {
        assert_eq!(refusal(from, &mut target).to_string(), text);
    };
    expect(
        &scene(true, true, 2),
        "number of reservoirs: the checkpoint has 2, the simulation has 1",
    );
    expect(
        &scene(false, true, 1),
        "node 1 is an anchor in the checkpoint and a mass in the simulation",
    );
    expect(
        &scene(true, false, 1),
        "element 0 has 0 dashpots in the checkpoint and 1 in the simulation",
    );
    expect(
        &single_pendulum(Scheme::Midpoint, 0.1).run,
        "the checkpoint is one of the scheme midpoint, the simulation has eem-entropy",
    );
    expect(
        &Simulation::new(Scene::new(), Scheme::EemEntropy, 0.1).unwrap(),
        "number of nodes: the checkpoint has 0, the simulation has 2",
    );
    assert_eq!(
        refusal(&scene::<3>(true, true, 1), &mut target).to_string(),
        "number of dimensions: the checkpoint has 3, the simulation has 2"
    );
}

#[cfg(feature = "serde")]
mod files {
    use super::*;
    use crate::support::solids::{Relaxing, SECTION, ThermoelasticSolid};

    fn through_text<const D: usize>(run: &Simulation<D>) -> Checkpoint {
        let text = serde_json::to_string(&run.checkpoint()).unwrap();
        serde_json::from_str(&text).unwrap()
    }

    #[test]
    fn checkpoints_survive_text_bit_for_bit() {
        for scheme in Scheme::ALL {
            let mut run = busy_scene(scheme);
            trace(&mut run, 50);
            let read = through_text(&run);
            assert_eq!(bits(&run), format!("{read:?}"));
            let mut resumed = busy_scene(scheme);
            resumed.restore(&read).unwrap();
            assert_eq!(trace(&mut run, 50), trace(&mut resumed, 50));
        }
    }

    /// A square of a solid that turns.
    fn solid() -> Simulation<2> {
        let mut scene = Scene::<2>::new();
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let nodes = corners.map(|[x, y]| scene.node([x, y], [0.5 - y, x]));
        for point in scene.quadrilateral(ThermoelasticSolid::RUBBER, nodes, SECTION) {
            scene.set_temperature(point, 310.0);
        }
        Simulation::new(scene, Scheme::EemEntropy, 0.05).unwrap()
    }

    #[test]
    fn solids_are_resumed_and_their_momenta_are_those_of_the_velocities() {
        let mut run = solid();
        trace(&mut run, 5);
        let read = through_text(&run);
        let mut resumed = solid();
        resumed.restore(&read).unwrap();
        assert_eq!(trace(&mut run, 20), trace(&mut resumed, 20));

        let mut run = solid();
        let text = serde_json::to_string(&run.checkpoint()).unwrap();
        let at = text.find("\"velocities\":[[").unwrap();
        let text = text[..at].to_owned() + &text[at..].replacen("0.5", "1e160", 1);
        let before = bits(&run);
        let error = run
            .restore(&serde_json::from_str(&text).unwrap())
            .unwrap_err();
        assert!(
            error.to_string().contains("those of the velocities"),
            "{error}"
        );
        assert_eq!(before, bits(&run));
    }

    #[test]
    fn viscous_strains_are_resumed() {
        let flowing = || {
            let mut scene = Scene::<2>::new();
            let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
            let nodes = corners.map(|[x, y]| scene.node([x, y], [0.5 - y, 2.0 * x]));
            let points = scene.quadrilateral(Relaxing::RUBBER, nodes, SECTION);
            for point in points {
                scene.set_temperature(point, 310.0);
            }
            let run = Simulation::new(scene, Scheme::EemEntropy, 0.05).unwrap();
            (run, points[2])
        };
        let (mut run, point) = flowing();
        trace(&mut run, 5);
        let read = through_text(&run);
        let (mut resumed, same) = flowing();
        resumed.restore(&read).unwrap();
        let strain = run.viscous_strain(point).unwrap();
        assert!(strain.norm() > 1e-3);
        assert_eq!(strain, resumed.viscous_strain(same).unwrap());
        assert_eq!(trace(&mut run, 20), trace(&mut resumed, 20));
    }

    /// Energy and momenta of an explicit run are those of the state that somebody has edited.
    #[test]
    fn targets_follow_an_edited_state() {
        let mut run = single_pendulum(Scheme::EemExplicit, 0.01);
        trace(&mut run.run, 5);
        let text = serde_json::to_string(&run.run.checkpoint()).unwrap();
        let momentum = run.run.momentum(run.bob).unwrap();
        let start = text.find("\"momenta\":").unwrap();
        let (head, tail) = text.split_at(start);
        let value = format!("[{:?},0.0]", momentum.y);
        assert!(tail.contains(&value), "{tail}");
        let edited = head.to_owned() + &tail.replacen(&value, "[2.5,0.0]", 1);
        let checkpoint: Checkpoint = serde_json::from_str(&edited).unwrap();
        run.run.restore(&checkpoint).unwrap();
        approx::assert_relative_eq!(run.run.momentum(run.bob).unwrap().y, 2.5);
        let mut laws = crate::support::Laws::new(&run.run);
        for _ in 0..100 {
            run.run.step().unwrap();
            laws.watch(&run.run);
        }
        println!("{laws:?}");
        assert!(laws.energy <= 6e-15 && laws.angular_momentum <= 2e-15);
    }

    /// The error of restoring a pendulum from a text in which `from` has been replaced by `to`.
    fn damaged(from: &str, to: &str) -> String {
        let mut run = single_pendulum(Scheme::EemEntropy, 0.125).run;
        let text = serde_json::to_string(&run.checkpoint()).unwrap();
        assert!(text.contains(from), "{text}");
        let before = bits(&run);
        let error = match serde_json::from_str(&text.replacen(from, to, 1)) {
            Ok(checkpoint) => run.restore(&checkpoint).unwrap_err().to_string(),
            Err(error) => error.to_string(),
        };
        assert_eq!(before, bits(&run));
        error
    }

    #[test]
    fn damaged_files_are_errors() {
        assert_eq!(
            damaged("\"viscous\":[[0.0,0.0]]", "\"viscous\":[]"),
            "number of viscous stretches: the checkpoint has 0, the simulation has 1"
        );
        let error = damaged("\"time\":[0.0,0.0]", "\"time\":[]");
        assert!(error.starts_with("invalid length 0"), "{error}");
        assert_eq!(
            damaged("\"temperatures\":[380.0]", "\"temperatures\":[-1.0]"),
            "the checkpoint has -1 among its values of temperatures, they must be positive and finite"
        );
        assert_eq!(
            damaged("\"step\":0.125", "\"step\":0.0"),
            "the checkpoint has 0 among its values of step size, they must be positive and finite"
        );
        let error = damaged("eem-entropy", "leapfrog");
        assert!(
            error.starts_with("there is no scheme `leapfrog`"),
            "{error}"
        );
        let error = damaged("\"temperatures\"", "\"colours\"");
        assert!(error.starts_with("unknown field `colours`"), "{error}");
        let error = damaged("380.0", "null");
        assert!(error.starts_with("invalid type: null"), "{error}");
    }
}

/// A gas spring that is cold and stiff, so that rounding decides how many iterations a step takes.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    -pressure * theta / 300 * ln(lambda / length - 0.1) - attraction * length / lambda
        + 0.1 * pressure * (lambda / length).powi(2)
        + capacity * (theta - 300 - theta * ln(theta / 300))
})]
struct Gas {
    pressure: f64,
    attraction: f64,
    length: f64,
    capacity: f64,
}

fn gas_spring(scheme: Scheme) -> Simulation<2> {
    let gas = Gas {
        pressure: 125_101.0,
        attraction: 12_288.0,
        length: 9.043,
        capacity: 0.1496,
    };
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([-6.136, -1.881]);
    let mass = scene.mass(1_429.0, [3.182, -0.5396], [0.124, -0.102]);
    let spring = scene.spring(gas, [pivot, mass]);
    scene.set_temperature(spring, 28.62);
    Simulation::new(scene, scheme, 1.33).unwrap()
}

#[test]
fn a_resumed_step_is_judged_by_the_same_numbers() {
    for scheme in [
        Scheme::EemTemperature,
        Scheme::EemEntropy,
        Scheme::EemEntropy4,
        Scheme::EemEntropy6,
        Scheme::Staggered,
    ] {
        let mut whole = gas_spring(scheme);
        for _ in 0..100 {
            let mut resumed = gas_spring(scheme);
            resumed.restore(&whole.checkpoint()).unwrap();
            assert_eq!(whole.step(), resumed.step(), "{scheme}");
            assert_eq!(bits(&whole), bits(&resumed), "{scheme}");
        }
    }
}

/// A light mass that passes the origin, where additions to its coordinates cancel.
#[test]
fn every_state_of_high_order_can_be_restored() {
    let build = |scheme| {
        let mut scene = Scene::<3>::new();
        let pivot = scene.anchor([-1.7, 0.4, 2.3]);
        let light = scene.mass(1e-5, [-0.7, 2.2, 0.6], [0.003, 0.01, -0.02]);
        let heavy = scene.mass(1e5, [-1.2, 1.7, -2.5], [0.02, -0.003, 0.02]);
        for (ends, stiffness, natural_length) in
            [([pivot, light], 280.0, 2.3), ([light, heavy], 0.6, 4.8)]
        {
            let spring = hooke(stiffness, natural_length);
            scene.spring(spring, ends);
        }
        scene.set_gravity([0.0, 0.0, -9.81]);
        Simulation::new(scene, scheme, 2.67e-3).unwrap()
    };
    for scheme in [Scheme::EemEntropy4, Scheme::EemEntropy6] {
        let (mut run, mut other) = (build(scheme), build(scheme));
        for _ in 0..600 {
            run.step().unwrap();
            other.restore(&run.checkpoint()).unwrap();
        }
    }
}

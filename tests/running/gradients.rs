//! Gradients of runs: against differences of runs, and against the laws, which say what the gradient of the energy is.

use eem::kinematics::{Hex8, Quad4};
use eem::materials::KelvinVoigtDamper;
use eem::prelude::*;
use eem::{Gradient, GradientError, History, Objective};

use crate::support::dashpots::TwoDashpots;
use crate::support::solids::{Relaxing, Viscous};
use crate::support::{DoublePendulum, ThermoViscoElastic, single_pendulum_scene};

mod inputs;
mod storage;
mod tangents;
mod times;

use tangents::assert_tangent;

const FORMS: [Scheme; 2] = [Scheme::EemTemperature, Scheme::EemEntropy];

const VOIGT: KelvinVoigtDamper = KelvinVoigtDamper {
    stiffness: 50.0,
    coupling: 0.05,
    capacity: 3.0,
    natural_length: 1.1,
    theta_ref: 300.0,
    a: 400.0,
    eta: 0.7,
};

/// Its parameters in [`Inputs`].
const NAMES: [&str; 6] = [
    "stiffness",
    "natural_length",
    "coupling",
    "capacity",
    "eta",
    "a",
];

const TWO: TwoDashpots = TwoDashpots {
    stiffness: 60.0,
    coupling: 0.1,
    capacity: 2.0,
    natural_length: 0.9,
    theta_ref: 300.0,
    a: 500.0,
    mu1: 20.0,
    eta1: 3.0,
    mu2: 15.0,
    eta2: 0.4,
};

/// The inputs of [`net`] besides those of its materials.
#[derive(Clone, Copy)]
struct Inputs {
    voigt: [f64; 6],
    /// k, μ₁, η₁ of the spring with two dashpots.
    two: [f64; 3],
    masses: [f64; 2],
    gravity: [f64; 2],
    conductances: [f64; 2],
    air: f64,
    anchor: [f64; 2],
    position: [f64; 2],
    velocity: [f64; 2],
    temperature: f64,
    viscous: f64,
}

const INPUTS: Inputs = Inputs {
    voigt: [50.0, 1.1, 0.05, 3.0, 0.7, 400.0],
    two: [60.0, 20.0, 3.0],
    masses: [1.0, 0.5],
    gravity: [1.0, -9.81],
    conductances: [0.8, 0.3],
    air: 290.0,
    anchor: [0.0, 0.1],
    position: [1.2, 0.0],
    velocity: [0.3, 1.5],
    temperature: 315.0,
    viscous: 0.05,
};

struct Net {
    scene: Scene<2>,
    nodes: [Node; 3],
    springs: [Element; 2],
    paths: [HeatPath; 2],
    air: Reservoir,
}

/// Two springs in contact, with dashpots beside them and in series, in air, under gravity and a force.
fn net(inputs: &Inputs) -> Net {
    let mut scene = Scene::<2>::new();
    let anchor = scene.anchor(inputs.anchor);
    let bob = scene.mass(inputs.masses[0], inputs.position, inputs.velocity);
    let tail = scene.mass(inputs.masses[1], [1.9, -0.4], [0.0, -0.5]);
    let [stiffness, natural_length, coupling, capacity, eta, a] = inputs.voigt;
    let voigt = KelvinVoigtDamper {
        stiffness,
        natural_length,
        coupling,
        capacity,
        eta,
        a,
        ..VOIGT
    };
    let [stiffness, mu1, eta1] = inputs.two;
    let two = TwoDashpots {
        stiffness,
        mu1,
        eta1,
        ..TWO
    };
    let springs = [
        scene.spring(voigt, [anchor, bob]),
        scene.spring(two, [bob, tail]),
    ];
    scene.set_temperature(springs[0], inputs.temperature);
    scene.set_temperature(springs[1], 295.0);
    scene.set_viscous_stretch(springs[1], 0, inputs.viscous);
    let air = scene.reservoir(inputs.air);
    let paths = [
        scene.conduct(springs[0], springs[1], inputs.conductances[0]),
        scene.conduct(springs[1], air, inputs.conductances[1]),
    ];
    scene.set_gravity(inputs.gravity);
    scene.force(tail, |t| [0.5 * t.sin(), 0.2]);
    Net {
        scene,
        nodes: [anchor, bob, tail],
        springs,
        paths,
        air,
    }
}

/// A sum of everything that has a derivative, at the end, in the middle and on the way.
fn objective(net: &Net) -> Objective<2> {
    let [_, bob, tail] = net.nodes;
    let [voigt, two] = net.springs;
    Objective::at_end(Quantity::Position(bob)).component(1)
        + Objective::at_end(Quantity::Temperature(voigt)).times(0.1)
        + Objective::at_end(Quantity::ViscousStretch(two, 1)).times(3.0)
        + Objective::at_end(Quantity::Momentum(tail))
        + Objective::at_end(Quantity::ReservoirHeat(net.air)).times(0.2)
        + Objective::at(0.2, Quantity::Velocity(tail))
        + Objective::integral(Quantity::Stretch(two)).times(2.0)
        + Objective::integral(Quantity::TotalEnergy).times(0.01)
        + Objective::misfit(Quantity::KineticEnergy, [[0.1, 1.0, 0.5], [0.3, 1.2, 0.5]])
}

fn start(inputs: &Inputs, scheme: Scheme) -> (Net, Simulation<2>) {
    let net = net(inputs);
    let mut run = Simulation::new(net.scene.clone(), scheme, 0.025).unwrap();
    run.keep_history(History::default());
    run.run_until(0.4).unwrap();
    (net, run)
}

/// A change of an input.
type Change = Box<dyn Fn(&mut Inputs, f64)>;

/// Fourth order in the change of an input.
fn difference_by(
    inputs: &Inputs,
    scheme: Scheme,
    size: f64,
    change: impl Fn(&mut Inputs, f64),
) -> f64 {
    let value = |steps: f64| {
        let mut inputs = *inputs;
        change(&mut inputs, steps * size);
        let (net, mut run) = start(&inputs, scheme);
        run.gradient(&objective(&net)).unwrap().value()
    };
    (8.0 * (value(1.0) - value(-1.0)) - (value(2.0) - value(-2.0))) / (12.0 * size)
}

#[test]
fn gradients_are_differences_of_runs() {
    for scheme in FORMS {
        let (net, mut run) = start(&INPUTS, scheme);
        let objective = objective(&net);
        let gradient = run.gradient(&objective).unwrap();
        assert_tangent("net", &mut run, &gradient, &objective);
        let [anchor, bob, _] = net.nodes;
        let [voigt, two] = net.springs;
        let by = |element, name: &str| gradient.by_parameter(element, name).unwrap();
        let mut all: Vec<(String, f64, f64, Change)> = Vec::new();
        let mut check = |name: &str, got: f64, size: f64, change: Change| {
            all.push((name.to_owned(), got, size, change));
        };
        for (at, name) in NAMES.into_iter().enumerate() {
            let size = 1e-3 * INPUTS.voigt[at];
            check(
                name,
                by(voigt, name),
                size,
                Box::new(move |i, x| i.voigt[at] += x),
            );
        }
        for (at, name) in ["stiffness", "mu1", "eta1"].into_iter().enumerate() {
            let size = 1e-3 * INPUTS.two[at];
            check(
                name,
                by(two, name),
                size,
                Box::new(move |i, x| i.two[at] += x),
            );
        }
        for at in 0..2 {
            let node = net.nodes[at + 1];
            let mass = gradient.by_mass(node).unwrap();
            check("mass", mass, 1e-3, Box::new(move |i, x| i.masses[at] += x));
            let gravity = gradient.by_gravity()[at];
            check(
                "gravity",
                gravity,
                1e-2,
                Box::new(move |i, x| i.gravity[at] += x),
            );
            let path = gradient.by_conductance(net.paths[at]).unwrap();
            check(
                "conductance",
                path,
                1e-3,
                Box::new(move |i, x| i.conductances[at] += x),
            );
            let place = gradient.by_position(anchor).unwrap()[at];
            check(
                "anchor",
                place,
                1e-3,
                Box::new(move |i, x| i.anchor[at] += x),
            );
            let position = gradient.by_position(bob).unwrap()[at];
            check(
                "position",
                position,
                1e-3,
                Box::new(move |i, x| i.position[at] += x),
            );
            let velocity = gradient.by_velocity(bob).unwrap()[at];
            check(
                "velocity",
                velocity,
                1e-3,
                Box::new(move |i, x| i.velocity[at] += x),
            );
        }
        let air = gradient.by_reservoir_temperature(net.air).unwrap();
        check("air", air, 1e-1, Box::new(|i, x| i.air += x));
        let theta = gradient.by_temperature(voigt).unwrap();
        check(
            "temperature",
            theta,
            1e-1,
            Box::new(|i, x| i.temperature += x),
        );
        let gamma = gradient.by_viscous_stretch(two, 0).unwrap();
        check(
            "viscous stretch",
            gamma,
            1e-3,
            Box::new(|i, x| i.viscous += x),
        );
        for (name, got, size, change) in all {
            let expected = difference_by(&INPUTS, scheme, size, change);
            let off = (got - expected).abs();
            // Differences of fourth order; rounding of the values, which are about 10, over the size.
            let bound = 1e-7 * expected.abs() + 1e-12 / size;
            assert!(off <= bound, "{scheme}, {name}: {got} {expected}");
        }
    }
}

/// A pushed mass on a spring at a moved anchor, and another one on a spring at a given temperature, with these amplitudes of
/// force (N), motion (m) and temperature (K), and the coupling, μ₁ and η₁ of the latter, of small capacity.
fn driven(values: [f64; 6]) -> (Scene<2>, [Node; 2], [Element; 2]) {
    let [force, motion, heating, coupling, mu1, eta1] = values;
    let held = TwoDashpots {
        coupling,
        capacity: 0.2,
        mu1,
        eta1,
        ..TWO
    };
    let mut scene = Scene::<2>::new();
    let support = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [1.1, 0.0], [0.0, 1.0]);
    let tail = scene.mass(0.5, [1.5, -1.1], [0.2, 0.0]);
    let springs = [
        scene.spring(VOIGT, [support, bob]),
        scene.spring(held, [bob, tail]),
    ];
    scene.set_temperature(springs[0], 320.0);
    scene.prescribe_temperature(springs[1], move |t| 310.0 + heating * (4.0 * t).sin());
    scene.set_temperature(springs[1], 310.0);
    scene.conduct(springs[0], springs[1], 0.5);
    scene.force(bob, move |t| [force * (3.0 * t).cos(), 0.2]);
    scene.move_anchor(support, move |t| [motion * (5.0 * t).sin(), 0.0]);
    (scene, [support, bob], springs)
}

const DRIVEN: [f64; 6] = [2.0, 0.1, 5.0, 1.0, 20.0, 3.0];

#[test]
fn values_of_loads_and_parameters_of_held_springs_have_derivatives() {
    for scheme in FORMS {
        let end = |values| {
            let (scene, [support, bob], springs) = driven(values);
            let mut run = Simulation::new(scene, scheme, 0.02).unwrap();
            run.keep_history(History::default());
            run.run_until(0.5).unwrap();
            let objective = Objective::at_end(Quantity::Position(bob))
                + Objective::integral(Quantity::Stretch(springs[0]))
                + Objective::at_end(Quantity::Position(support))
                + Objective::at_end(Quantity::Temperature(springs[0])).times(0.1);
            run.gradient(&objective).unwrap()
        };
        let (scene, [support, bob], [free, held]) = driven(DRIVEN);
        let mut run = Simulation::new(scene, scheme, 0.02).unwrap();
        run.keep_history(History::default());
        run.run_until(0.5).unwrap();
        let objective = Objective::at_end(Quantity::Position(bob))
            + Objective::integral(Quantity::Stretch(free))
            + Objective::at_end(Quantity::Position(support))
            + Objective::at_end(Quantity::Temperature(free)).times(0.1);
        let gradient = run.gradient(&objective).unwrap();
        assert_tangent("driven", &mut run, &gradient, &objective);
        let forces = gradient.by_force(bob).unwrap();
        let motions = gradient.by_motion(support).unwrap();
        let thermostat = gradient.by_thermostat(held).unwrap();
        let total = motions.iter().fold(0.0, |sum, (_, by)| sum + by[0]);
        let shifted = gradient.by_position(support).unwrap()[0];
        assert!((total - shifted).abs() < 1e-13, "{total} {shifted}");
        let found = [
            forces
                .iter()
                .map(|(t, by)| by[0] * (3.0 * t).cos())
                .sum::<f64>(),
            motions.iter().map(|(t, by)| by[0] * (5.0 * t).sin()).sum(),
            thermostat.iter().map(|(t, by)| by * (4.0 * t).sin()).sum(),
            gradient.by_parameter(held, "coupling").unwrap(),
            gradient.by_parameter(held, "mu1").unwrap(),
            gradient.by_parameter(held, "eta1").unwrap(),
        ];
        for (at, found) in found.into_iter().enumerate() {
            let size = 1e-3;
            let value = |steps: f64| {
                let mut values = DRIVEN;
                values[at] += steps * size;
                end(values).value()
            };
            let expected =
                (8.0 * (value(1.0) - value(-1.0)) - (value(2.0) - value(-2.0))) / (12.0 * size);
            let off = (found - expected).abs();
            assert!(
                off <= 1e-7 * expected.abs() + 1e-12 / size,
                "{scheme}, {at}: {found} {expected}"
            );
        }
        assert!(
            gradient
                .by_thermostat(free)
                .unwrap_err()
                .to_string()
                .contains("no thermostat")
        );
    }
}

/// The largest difference of two gradients, in units of the largest number.
fn difference<const D: usize>(a: &Gradient<D>, b: &Gradient<D>) -> f64 {
    let [a, b] = [a, b].map(Gradient::numbers);
    let size = b.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let pairs = a.iter().zip(&b);
    pairs.fold(0.0, |most, (a, b)| f64::max(most, (a - b).abs())) / size
}

/// The gradient of the energy at the end is that of the energy at the start: it is kept whatever the inputs are.
fn assert_energy_law<const D: usize>(what: &str, scene: &Scene<D>, step: f64, steps: usize) {
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
        assert!(off <= 1e-12, "{what}, {scheme}: {off:e}");
        let energies = Objective::integral(Quantity::KineticEnergy)
            + Objective::at_end(Quantity::TotalEnergy).times(0.1);
        let gradient = run.gradient(&energies).unwrap();
        assert_tangent(what, &mut run, &gradient, &energies);
        let size = start.numbers().into_iter().fold(0.0, f64::max) / step;
        let by_sizes = end.by_step_size().unwrap();
        assert_eq!(by_sizes.len(), steps);
        for (_, by) in by_sizes {
            assert!(by.abs() <= 1e-12 * size, "{what}, {scheme}: {by:e}");
        }
    }
}

#[test]
fn the_gradient_of_the_energy_is_kept() {
    assert_energy_law("single", &single_pendulum_scene().0, 0.1, 50);
    for case in DoublePendulum::ALL {
        assert_energy_law(case.name, &case.scene().0, case.step, 20);
    }
    // Roundings of momenta must not be multiplied by 2/h in every step.
    let [.., log] = DoublePendulum::ALL;
    assert_energy_law("short steps", &log.scene().0, 1e-5, 500);
    let mut scene = Scene::<3>::new();
    let nodes = [[0.0; 3], [1.2, 0.1, 0.0], [1.9, 0.8, 0.3]];
    let nodes = nodes.map(|at| scene.mass(1.0, at, [0.1, at[0], -at[1]]));
    let springs = [
        scene.spring(VOIGT, [nodes[0], nodes[1]]),
        scene.spring(TWO, [nodes[1], nodes[2]]),
        scene.spring(ThermoViscoElastic::PENDULUM, [nodes[2], nodes[0]]),
    ];
    for (spring, theta) in springs.into_iter().zip([310.0, 295.0, 300.0]) {
        scene.set_temperature(spring, theta);
    }
    scene.conduct(springs[0], springs[1], 3.0);
    scene.conduct(springs[1], springs[2], 1.0);
    assert_energy_law("free", &scene, 0.05, 40);
}

#[test]
fn the_gradient_of_the_energy_of_solids_is_kept() {
    let mut scene = Scene::<2>::new();
    let mesh = Mesh::<Quad4, 2>::block([2, 1], [[0.0, 2.0], [0.0, 1.0]]).unwrap();
    let body = scene.solid(Viscous::RUBBER, &mesh, &Bulk::new(10.0).conductivity(5.0));
    scene.set_temperatures(&body, 305.0);
    scene.fix(body.nodes()[0]);
    let corner = body.node_at([2.0, 1.0], 1e-9).unwrap();
    let bob = scene.mass(1.0, [3.0, 1.0], [0.0, 0.5]);
    let spring = scene.spring(ThermoViscoElastic::PENDULUM, [corner, bob]);
    scene.set_temperature(spring, 310.0);
    scene.set_gravity([0.0, -9.81]);
    assert_energy_law("plane", &scene, 0.02, 10);

    let mut scene = Scene::<3>::new();
    let mesh = Mesh::<Hex8, 3>::block([1; 3], [[0.0, 1.0]; 3]).unwrap();
    let body = scene.solid(Relaxing::RUBBER, &mesh, &Bulk::new(10.0));
    scene.set_temperatures(&body, 305.0);
    for (at, &node) in body.nodes().iter().enumerate() {
        let x = f64::from(u8::try_from(at).unwrap());
        scene.set_velocity(node, [0.3 * x.sin(), 0.2 * x, 0.1 * x.cos()]);
    }
    assert_energy_law("relaxing", &scene, 0.02, 5);
}

#[test]
fn controlled_steps_and_resumed_ones_have_gradients() {
    let (scene, bob, ..) = single_pendulum_scene();
    for scheme in FORMS {
        let mut run = Simulation::new(scene.clone(), scheme, 0.05).unwrap();
        run.control_steps(Tolerance::new(1e-4)).unwrap();
        run.keep_history(History::default());
        let energy = Objective::at_end(Quantity::TotalEnergy);
        let start = run.gradient(&energy).unwrap();
        run.run_until(0.5).unwrap();
        let middle = run.checkpoint();
        run.run_until(1.0).unwrap();
        let off = difference(&run.gradient(&energy).unwrap(), &start);
        assert!(off <= 1e-12, "{scheme}: {off:e}");
        // Back to a state of the history, which goes on from there.
        run.restore(&middle).unwrap();
        run.run_until(1.0).unwrap();
        let position = Objective::at_end(Quantity::Position(bob));
        let gradient = run.gradient(&position).unwrap();
        assert_eq!(
            gradient.value().to_bits(),
            run.position(bob).unwrap()[0].to_bits()
        );
        assert!(difference(&run.gradient(&energy).unwrap(), &start) <= 1e-12);
    }
}

#[test]
fn growth_of_derivatives_is_noted() {
    let [_, krueger, _] = DoublePendulum::ALL;
    let growth = |steps: usize| {
        let (scene, masses, _) = krueger.scene();
        let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
        run.keep_history(History::default());
        for _ in 0..steps {
            run.step().unwrap();
        }
        let objective = Objective::at_end(Quantity::Position(masses[1]));
        run.gradient(&objective).unwrap()
    };
    let [short, long] = [50, 2000].map(growth);
    assert!(short.growth() >= 1.0 && short.growth() < 1e6);
    assert!(!short.to_string().contains("grow"));
    assert!(long.growth() > 1e6 && long.to_string().contains("about 0 digits"));
}

#[test]
fn what_has_no_gradient_is_an_error() {
    let (net, mut run) = start(&INPUTS, Scheme::EemTemperature);
    let [anchor, ..] = net.nodes;
    let [voigt, two] = net.springs;
    let at_end = |quantity| Objective::at_end(quantity);
    let error = |run: &mut Simulation<2>, objective| run.gradient(&objective).unwrap_err();
    let never = error(&mut run, Objective::at(0.2001, Quantity::TotalEnergy));
    assert!(
        matches!(never, GradientError::NotAnEndOfStep { nearest, .. } if (nearest - 0.2).abs() < 1e-12)
    );
    let never = error(
        &mut run,
        Objective::at(f64::INFINITY, Quantity::TotalEnergy),
    );
    assert!(matches!(never, GradientError::NotAnEndOfStep { .. }));
    let infinite = error(&mut run, Objective::time().times(f64::INFINITY));
    assert!(matches!(infinite, GradientError::NotFinite { .. }));
    let none = error(&mut run, at_end(Quantity::NewtonIterations));
    assert!(
        none.to_string().contains("`Quantity::NewtonIterations`"),
        "{none}"
    );
    let third = error(&mut run, at_end(Quantity::Position(anchor)).component(2));
    assert!(matches!(
        third,
        GradientError::Component { components: 2, .. }
    ));
    let gradient = run.gradient(&at_end(Quantity::TotalEnergy)).unwrap();
    let unknown = gradient.by_parameter(voigt, "k").unwrap_err().to_string();
    assert!(unknown.contains("it has stiffness, coupling"), "{unknown}");
    assert!(gradient.by_viscous_stretch(two, 2).is_err());
    let other = single_pendulum_scene().1;
    assert!(matches!(
        gradient.by_mass(other),
        Err(GradientError::Scene(_))
    ));

    let mut run = Simulation::new(net.scene.clone(), Scheme::EemTemperature, 0.025).unwrap();
    assert_eq!(
        error(&mut run, at_end(Quantity::TotalEnergy)),
        GradientError::NoHistory
    );
    run.keep_history(History::snapshots(1));
    run.run_until(1.0).unwrap();
    let large = error(&mut run, at_end(Quantity::TotalEnergy));
    assert_eq!(large, GradientError::HistoryTooLarge { most: 4 });
    for deviation in [0.0, -1.0, f64::INFINITY, f64::NAN] {
        let misfit = Objective::misfit(Quantity::TotalEnergy, [[0.2, 1.0, deviation]]);
        run.keep_history(History::default());
        let error = error(&mut run, misfit);
        assert!(matches!(error, GradientError::Deviation { time: 0.2, .. }));
    }
    let before = run.checkpoint();
    run.keep_history(History::default());
    run.step().unwrap();
    run.step().unwrap();
    run.restore(&before).unwrap();
    assert!(run.gradient(&at_end(Quantity::TotalEnergy)).is_ok());
    run.step().unwrap();
    run.keep_history(History::default());
    run.restore(&before).unwrap();
    let broken = error(&mut run, at_end(Quantity::TotalEnergy));
    assert!(
        matches!(broken, GradientError::HistoryBroken { .. }),
        "{broken}"
    );
    // Another form in the middle.
    let mut run = Simulation::new(net.scene.clone(), Scheme::EemTemperature, 0.025).unwrap();
    run.keep_history(History::default());
    run.step().unwrap();
    run.step().unwrap();
    let mut run = run.with_scheme(Scheme::EemEntropy).unwrap();
    run.step().unwrap();
    let broken = error(&mut run, at_end(Quantity::TotalEnergy));
    assert!(
        matches!(broken, GradientError::HistoryBroken { time: 0.05 }),
        "{broken}"
    );
    let scene = single_pendulum_scene().0;
    let mut run = Simulation::new(scene, Scheme::EemEntropy4, 0.01).unwrap();
    run.keep_history(History::default());
    // Before the first step and after it.
    for _ in 0..2 {
        let scheme = error(&mut run, at_end(Quantity::TotalEnergy));
        assert!(matches!(
            scheme,
            GradientError::NoAdjoint {
                scheme: "eem-entropy-4",
                ..
            }
        ));
        run.step().unwrap();
    }
}

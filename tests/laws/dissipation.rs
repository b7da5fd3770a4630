//! Dissipation, entropy production and conducted heat are what the steps book.

use eem::prelude::*;

use crate::support::solids::Viscous;
use crate::support::springs::{Braked, Branched};
use crate::support::{EXACT, ThermoViscoElastic};

const MAXWELL: Branched = Branched {
    k: 4.0,
    mu: 10.0,
    eta: 2.0,
    length: 1.0,
};

const VOIGT: Braked = Braked {
    k: 4.0,
    eta: 0.5,
    length: 1.0,
};

/// A dashpot whose heat warms the element and nothing else.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    0.5 * mu * (lambda - 1 - gamma).powi(2) + c * (theta - theta * ln(theta / 300))
})]
#[viscosity(gamma = eta)]
struct Warm {
    mu: f64,
    eta: f64,
    c: f64,
}

/// Roundings of sums of this size over the steps of a test, generously.
fn rounding(size: f64, steps: f64) -> f64 {
    steps * f64::EPSILON * size
}

/// Warm springs with dashpots that exchange heat with each other and with the air.
fn warm_pair() -> (Scene<2>, [Element; 2], [HeatPath; 2], Reservoir) {
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [1.5, 0.0], [0.0, 1.0]);
    let tail = scene.mass(0.5, [1.5, -1.1], [0.2, 0.0]);
    let first = scene.spring(ThermoViscoElastic::PENDULUM, [pivot, bob]);
    let second = scene.spring(ThermoViscoElastic::PENDULUM, [bob, tail]);
    scene.set_temperature(first, 340.0);
    scene.set_temperature(second, 310.0);
    let air = scene.reservoir(300.0);
    // From the second to the first: the path is listed at the other end.
    let between = scene.conduct(second, first, 3.0);
    let outside = scene.conduct(first, air, 10.0);
    (scene, [first, second], [between, outside], air)
}

#[test]
fn heat_of_dashpots_without_temperature_is_what_leaves_the_scene() {
    for scheme in EXACT {
        let mut scene = Scene::<2>::new();
        let nodes = [
            scene.anchor([0.0, 0.0]),
            scene.mass(1.0, [1.2, 0.0], [0.0, 0.5]),
            scene.mass(1.0, [2.1, 0.3], [0.0, 0.0]),
        ];
        let springs = [0, 1].map(|i| scene.spring(MAXWELL, [nodes[i], nodes[i + 1]]));
        let mut run = Simulation::new(scene, scheme, 0.05).unwrap();
        run.meter_heat();
        run.run_until(2.0).unwrap();
        let heats = springs.map(|spring| run.dissipation(spring).unwrap());
        let lost = run.ledger().lost_heat;
        assert!(heats[0] > 0.0 && heats[1] > 0.0 && lost > 0.1);
        let difference = (heats[0] + heats[1] - lost).abs();
        assert!(
            difference <= rounding(lost, 400.0),
            "{scheme}: {difference:e}"
        );
        let of_one = run.dissipation_of(springs[0], 0).unwrap();
        assert_eq!(of_one.to_bits(), heats[0].to_bits());
    }
}

#[test]
fn productions_are_the_entropy_that_the_scene_gains() {
    for scheme in EXACT {
        let (scene, springs, [between, outside], air) = warm_pair();
        let mut run = Simulation::new(scene, scheme, 0.02).unwrap();
        run.meter_heat();
        let start = run.ledger();
        run.run_until(1.0).unwrap();
        let end = run.ledger();
        let produced = springs.map(|spring| run.produced_entropy(spring).unwrap());
        let gained = end.entropy - start.entropy;
        let size = end.element_entropy.abs() + end.reservoir_entropy.abs();
        let difference = (produced[0] + produced[1] - gained).abs();
        assert!(produced[0] > 0.0 && produced[1] > 0.0 && gained > 1e-3);
        assert!(
            difference <= rounding(size, 100.0),
            "{scheme}: {difference:e} of {gained}"
        );

        let received = run.reservoir_heat(air).unwrap();
        let given = run.conducted_heat(outside).unwrap();
        let difference = (received + given).abs();
        assert!(
            difference <= rounding(received, 400.0),
            "{scheme}: {difference:e}"
        );
        // The first one is warmer most of the time.
        assert!(run.conducted_heat(between).unwrap() > 1.0, "{scheme}");
    }
}

#[test]
fn heat_of_a_dashpot_warms_its_element() {
    for scheme in EXACT {
        let mut scene = Scene::<1>::new();
        let ends = [scene.anchor([0.0]), scene.anchor([2.0])];
        let spring = Warm {
            mu: 8.0,
            eta: 2.0,
            c: 0.5,
        };
        let spring = scene.spring(spring, ends);
        scene.set_temperature(spring, 300.0);
        let mut run = Simulation::new(scene, scheme, 0.01).unwrap();
        run.meter_heat();
        run.run_until(0.5).unwrap();
        let heat = run.dissipation(spring).unwrap();
        let stored = 0.5 * (run.temperature(spring).unwrap() - 300.0);
        // The relaxation γ̇ = 4 (1 − γ) turns 4 J (1 − e⁻⁸ᵗ) into heat.
        let exact = 4.0 * (1.0 - (-4.0_f64).exp());
        assert!((stored - exact).abs() < 2e-2, "{scheme}: {stored} {exact}");
        // Temperatures of 300 K are rounded in each step. The explicit scheme integrates the heat with the error of the
        // step, which only `Auto` makes so large that it shows, below its tolerance.
        let bound = if scheme == Scheme::Auto {
            1e-6 * heat
        } else {
            rounding(0.5 * 308.0, 400.0)
        };
        assert!((heat - stored).abs() <= bound, "{scheme}: {heat} {stored}");
    }
}

#[test]
fn step_control_restarts_and_other_schemes_keep_the_sums() {
    let (scene, [first, _], [_, outside], air) = warm_pair();
    let build = || Simulation::new(scene.clone(), Scheme::EemEntropy, 0.02).unwrap();
    let mut run = build();
    run.control_steps(Tolerance::new(1e-4)).unwrap();
    run.meter_heat();
    run.run_until(0.5).unwrap();
    let saved = run.checkpoint();
    let mut resumed = build();
    resumed.restore(&saved).unwrap();
    let heat = |run: &Simulation<2>| run.dissipation(first).unwrap().to_bits();
    assert_eq!(heat(&resumed), heat(&run));
    let mut run = resumed.with_scheme(Scheme::EemExplicit).unwrap();
    run.run_until(1.0).unwrap();
    let mut run = run.with_scheme(Scheme::EemEntropy6).unwrap();
    run.run_until(1.5).unwrap();
    let given = run.conducted_heat(outside).unwrap();
    let received = run.reservoir_heat(air).unwrap();
    assert!((given + received).abs() <= rounding(received, 400.0));
}

#[test]
fn dashpots_in_parallel_and_points_of_solids_are_metered() {
    let schemes = [
        Scheme::EemEntropy,
        Scheme::EemTemperature,
        Scheme::EemEntropy4,
        Scheme::EemEntropy6,
    ];
    for scheme in schemes {
        let mut scene = Scene::<1>::new();
        let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.2], [0.0])];
        let spring = scene.spring(VOIGT, ends);
        let mut run = Simulation::new(scene, scheme, 0.05).unwrap();
        run.meter_heat();
        run.run_until(2.0).unwrap();
        let heat = run.dissipation_of(spring, 0).unwrap();
        let lost = run.ledger().lost_heat;
        assert!((heat - lost).abs() <= rounding(lost, 100.0), "{scheme}");

        let mut scene = Scene::<2>::new();
        let mesh = Mesh::<Quad4, 2>::block([2, 1], [[0.0, 2.0], [0.0, 1.0]]).unwrap();
        let body = scene.solid(Viscous::RUBBER, &mesh, &Bulk::new(10.0));
        for &point in body.points() {
            scene.set_temperature(point, 300.0);
        }
        for (&node, [x, y]) in body.nodes().iter().zip(mesh.nodes()) {
            scene.set_velocity(node, [0.5 * x, -0.2 * y]);
        }
        let mut run = Simulation::new(scene, scheme, 0.01).unwrap();
        let quantities = [
            (
                "heat",
                Quantity::sum(run.elements_of("Viscous").map(Quantity::Dissipation)),
            ),
            (
                "S",
                Quantity::sum(
                    body.points()
                        .iter()
                        .map(|&p| Quantity::EntropyProduction(p)),
                ),
            ),
        ];
        let mut recorder = Recorder::new(&run, quantities).unwrap().every(3);
        let start = run.ledger().entropy;
        run.run_until_with(0.15, |run, report| recorder.observe(run, report))
            .unwrap();
        let sum = |name| recorder.column(name).unwrap().iter().sum::<f64>();
        let gained = run.ledger().entropy - start;
        // Near 300 K, without conduction.
        let ratio = sum("heat") / sum("S");
        assert!(
            gained > 1e-5 && (ratio - 300.0).abs() < 1.0,
            "{gained} {ratio}"
        );
        let bound = rounding(run.ledger().element_entropy.abs() + 1.0, 200.0);
        assert!(
            (sum("S") - gained).abs() <= bound,
            "{scheme}: {} {gained}",
            sum("S")
        );
        assert_eq!(recorder.columns()[1].head(), "heat (J)");
        assert_eq!(recorder.columns()[2].head(), "S (J/K)");
    }
}

#[test]
fn rows_have_what_happened_since_the_last_one() {
    let (scene, [first, second], [between, outside], _) = warm_pair();
    let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.02).unwrap();
    let mut recorder = Recorder::new(
        &run,
        [
            ("first", Quantity::Dissipation(first)),
            (
                "both",
                Quantity::sum([first, second].map(Quantity::Dissipation)),
            ),
            ("between", Quantity::HeatFlow(between)),
            ("outside", Quantity::HeatFlow(outside)),
            ("balance", Quantity::Balance),
            ("work", Quantity::Work),
        ],
    )
    .unwrap()
    .every(7);
    run.run_until_with(1.0, |run, report| recorder.observe(run, report))
        .unwrap();
    recorder.record(&run).unwrap();
    // Again without a step: the row is replaced by the same.
    let before: Vec<_> = recorder.columns().to_vec();
    recorder.record(&run).unwrap();
    assert_eq!(recorder.columns(), before);
    let sum = |name| recorder.column(name).unwrap().iter().sum::<f64>();
    for (name, total) in [
        ("first", run.dissipation(first).unwrap()),
        ("between", run.conducted_heat(between).unwrap()),
        ("outside", run.conducted_heat(outside).unwrap()),
    ] {
        assert!(
            (sum(name) - total).abs() <= rounding(total.abs(), 100.0),
            "{name}"
        );
    }
    assert!(sum("both") > sum("first"));
    assert_eq!(recorder.column("work").unwrap(), vec![0.0; recorder.rows()]);
}

#[test]
fn what_cannot_be_metered_is_refused() {
    let (scene, [first, _], [between, _], _) = warm_pair();
    let run = Simulation::new(scene.clone(), Scheme::Midpoint, 0.02).unwrap();
    let expected = SceneError::NotMetered { scheme: "midpoint" };
    assert_eq!(run.dissipation(first), Err(expected.clone()));
    assert_eq!(run.conducted_heat(between), Err(expected));
    assert!(Recorder::new(&run, [("Q", Quantity::HeatFlow(between))]).is_err());
    let run = Simulation::new(scene, Scheme::EemEntropy, 0.02).unwrap();
    let expected = SceneError::NoSuchDashpot {
        element: first,
        dashpot: 1,
        dashpots: 1,
    };
    assert_eq!(run.dissipation_of(first, 1), Err(expected));
    let (_, [foreign, _], [path, _], _) = warm_pair();
    assert!(matches!(
        run.dissipation(foreign),
        Err(SceneError::ForeignHandle { .. })
    ));
    assert!(matches!(
        run.conducted_heat(path),
        Err(SceneError::ForeignHandle { .. })
    ));
    let mixed = Quantity::sum([Quantity::Dissipation(first), Quantity::Temperature(first)]);
    let refused = Recorder::new(&run, [("mixed", mixed)]).unwrap_err();
    assert!(refused.to_string().contains("one component and one unit"));
}

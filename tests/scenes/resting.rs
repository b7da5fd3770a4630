//! Scenes that are moved into a state at rest, and those that have none.

use eem::kinematics::{Hex8, Quad4};
use eem::materials::{
    Hooke, KelvinVoigtDamper, MaxwellDamper, SaintVenantKirchhoff, ThermoelasticSpring,
};
use eem::prelude::*;
use eem::{EquilibriumError, MotionKind};

use crate::support::hooke;
use crate::support::solids::Relaxing;

const SPRING: Hooke = hooke(100.0, 1.0);

const DAMPER: MaxwellDamper = MaxwellDamper {
    stiffness: 100.0,
    coupling: 0.5,
    capacity: 2.0,
    natural_length: 1.0,
    theta_ref: 300.0,
    a: 500.0,
    mu: 40.0,
    eta: 20.0,
};

/// The root of a falling function.
fn root(function: impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2]) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if function(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// A damper with a load of 10 N and the viscous stretch 0.02 m at 310 K: its stretch, viscous stretch and temperature at
/// rest.
fn loaded_damper(settings: Equilibrium) -> [f64; 3] {
    let mut scene = Scene::<1>::new();
    let wall = scene.anchor([0.0]);
    let mass = scene.mass(1.0, [1.0], [3.0]);
    let damper = scene.spring(DAMPER, [wall, mass]);
    scene.set_temperature(damper, 310.0);
    scene.set_viscous_stretch(damper, 0, 0.02);
    scene.force(mass, |t| [10.0 + t]);
    let report = scene.equilibrium(settings).unwrap();
    assert!(report.residual < 1e-13, "{report:?}");
    let run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
    assert_eq!(run.velocity(mass).unwrap()[0].to_bits(), 0.0_f64.to_bits());
    [
        run.stretch(damper).unwrap(),
        run.viscous_stretch(damper, 0).unwrap(),
        run.temperature(damper).unwrap(),
    ]
}

#[test]
fn dashpots_are_relaxed_or_held() {
    // k ln λ/λ − β ϑ/λ + μ (λ − L − γ) = 10 N
    let missing = |gamma: &dyn Fn(f64) -> f64, x: f64| {
        10.0 - (100.0 * x.ln() / x - 5.0 / x + 40.0 * (x - 1.0 - gamma(x)))
    };
    let [stretch, gamma, theta] = loaded_damper(Equilibrium::new().held());
    let exact = root(|x| missing(&|_| 0.02, x), [1.0, 1.5]);
    assert!((stretch - exact).abs() < 1e-14);
    assert!((gamma - 0.02).abs() < 1e-17 && (theta - 310.0).abs() < 1e-12);

    let [stretch, gamma, theta] = loaded_damper(Equilibrium::new().relaxed());
    let exact = root(|x| missing(&|x| x - 1.0, x), [1.0, 1.5]);
    assert!((stretch - exact).abs() < 1e-14);
    assert!((gamma - (exact - 1.0)).abs() < 1e-14 && (theta - 310.0).abs() < 1e-12);
}

#[test]
fn temperatures_come_into_balance_along_the_paths_of_heat() {
    // air (400 K) – 2 W/K – spring – 3 W/K – spring – 6 W/K – thermostat at 300 K: 100 K/(1/2 + 1/3 + 1/6) K/W = 100 W.
    let spring = ThermoelasticSpring {
        stiffness: 100.0,
        coupling: 0.5,
        capacity: 2.0,
        natural_length: 1.0,
        theta_ref: 300.0,
    };
    let mut scene = Scene::<1>::new();
    let mut nodes = vec![scene.anchor([0.0])];
    for place in [1.0, 2.0, 3.0] {
        nodes.push(scene.mass(1.0, [place], [0.0]));
    }
    nodes.push(scene.anchor([4.0]));
    let springs: Vec<_> = nodes
        .windows(2)
        .map(|ends| scene.spring(spring.clone(), [ends[0], ends[1]]))
        .collect();
    for &spring in &springs {
        scene.set_temperature(spring, 300.0);
    }
    let air = scene.reservoir(400.0);
    scene.conduct(springs[0], air, 2.0);
    scene.conduct(springs[0], springs[1], 3.0);
    scene.conduct(springs[1], springs[2], 6.0);
    scene.hold_temperature(springs[2], 300.0);
    let report = scene
        .equilibrium(Equilibrium::new().thermal_balance())
        .unwrap();
    assert!(report.heat < 1e-12 && report.residual < 1e-13, "{report:?}");
    let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.1).unwrap();
    // The last one has no path, and keeps its temperature.
    let exact = [350.0, 350.0 - 100.0 / 3.0, 300.0, 300.0];
    let steady = |run: &Simulation<1>| {
        for (&spring, exact) in springs.iter().zip(exact) {
            let found = run.temperature(spring).unwrap();
            assert!((found - exact).abs() < 1e-10, "{found} {exact}");
        }
        let forces: Vec<_> = springs.iter().map(|&s| run.force(s).unwrap()).collect();
        assert!(forces.windows(2).all(|two| (two[0] - two[1]).abs() < 1e-10));
    };
    steady(&run);
    for _ in 0..10 {
        run.step().unwrap();
    }
    steady(&run);
}

#[test]
fn a_rocket_turns_with_its_line() {
    // A rod from an anchor, pushed across the line from the anchor to the mass, against a second spring.
    let mut scene = Scene::<2>::new();
    let hinge = scene.anchor([0.0, 0.0]);
    let mass = scene.mass(1.0, [1.0, 0.0], [0.0, 0.0]);
    let post = scene.anchor([1.0, -1.0]);
    let (rod, stay) = (
        scene.spring(SPRING, [hinge, mass]),
        scene.spring(SPRING, [post, mass]),
    );
    // Along the rod, away from the hinge.
    scene.rocket(mass, [hinge, mass], |_| 10.0);
    scene.equilibrium(Equilibrium::new()).unwrap();
    let run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
    // All forces on the mass but that of the stay are along the rod: the stay has none, and the rod 10 N.
    assert!(run.force(stay).unwrap().abs() < 1e-12);
    assert!((run.force(rod).unwrap() - 10.0).abs() < 1e-12);
    assert!((run.stretch(rod).unwrap() - 1.1).abs() < 1e-14);
}

#[test]
fn a_rocket_pushes_along_a_line_that_moves() {
    // A weight on a spring, blown away from a fan.
    let mut scene = Scene::<2>::new();
    let (hook, fan) = (scene.anchor([0.0, 0.0]), scene.anchor([-1.0, -0.8]));
    let weight = scene.mass(0.5, [0.0, -1.0], [0.0, 0.0]);
    scene.spring(SPRING, [hook, weight]);
    scene.rocket(weight, [fan, weight], |_| 8.0);
    scene.set_gravity([0.0, -10.0]);
    scene.equilibrium(Equilibrium::new()).unwrap();
    let run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
    let q = run.position(weight).unwrap();
    let away = q - run.position(fan).unwrap();
    let pull = -100.0 * (q.norm() - 1.0) * q / q.norm();
    let balance = pull + 8.0 * away / away.norm();
    assert!(
        balance[0].abs() < 1e-12 && (balance[1] - 5.0).abs() < 1e-12,
        "{balance}"
    );
    assert!(q[0] > 0.5, "{q}");
}

/// Two rods that meet in an arch of 0.2 m above their supports, 2 m apart, and what is left of a load of P on the top
/// that has gone down to y: `P + 2 k (ℓ − L) y/ℓ`.
fn arch(load: f64) -> (Scene<2>, Node, impl Fn(f64) -> f64) {
    let length = 1.04_f64.sqrt();
    let rod = Hooke {
        natural_length: length,
        ..SPRING
    };
    let mut scene = Scene::<2>::new();
    let top = scene.mass(1.0, [0.0, 0.2], [0.0, 0.0]);
    for side in [-1.0, 1.0] {
        let support = scene.anchor([side, 0.0]);
        scene.spring(rod, [support, top]);
    }
    scene.dead_load(top, [0.0, -load]);
    let left = move |y: f64| {
        let now = (1.0 + y * y).sqrt();
        load + 200.0 * (now - length) * y / now
    };
    (scene, top, left)
}

#[test]
fn an_arch_snaps_through_beyond_its_limit() {
    // The largest load is 0.305 N, at y = 0.115 m.
    for (load, range) in [(0.25, [0.2, 0.12]), (0.35, [-0.2, -0.4])] {
        let (mut scene, top, left) = arch(load);
        let report = scene.equilibrium(Equilibrium::new()).unwrap();
        assert_eq!(report.followed < 1.0, load > 0.3, "{report:?}");
        let run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
        let [x, y]: [f64; 2] = run.position(top).unwrap().into();
        let exact = root(left, range);
        assert!(x.abs() < 1e-14 && (y - exact).abs() < 1e-12, "{y} {exact}");
    }
}

/// A hanging chain whose upper spring is far too soft for its weight, so that heavy masses would fall onto light ones below them.
fn hang<const D: usize>(springs: &[[f64; 4]]) {
    let mut scene = Scene::<D>::new();
    let at = |height: f64| -> [f64; D] {
        std::array::from_fn(|axis| if axis == D - 1 { height } else { 0.0 })
    };
    let mut nodes = vec![scene.anchor(at(0.0))];
    for &[stiffness, natural_length, mass, height] in springs {
        let mass = scene.mass(mass, at(height), at(0.0));
        let spring = hooke(stiffness, natural_length);
        scene.spring(spring, [nodes[nodes.len() - 1], mass]);
        nodes.push(mass);
    }
    scene.set_gravity(at(-9.81));
    let found = scene.equilibrium(Equilibrium::new());
    found.unwrap_or_else(|error| panic!("{D}, {springs:?}: {error}"));
    let run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
    let mut exact = 0.0;
    for (above, &[stiffness, natural_length, ..]) in springs.iter().enumerate() {
        let weight: f64 = springs[above..].iter().map(|spring| 9.81 * spring[2]).sum();
        exact -= natural_length + weight / stiffness;
        let found = run.position(nodes[above + 1]).unwrap()[D - 1];
        assert!((found / exact - 1.0).abs() < 1e-12, "{D}: {found} {exact}");
    }
}

#[test]
fn heavy_masses_do_not_fall_onto_light_ones() {
    // N/m, m, kg, m
    let chains: [&[[f64; 4]]; 3] = [
        &[[45.814, 1.0, 18.542, -0.687], [1.003, 1.0, 0.04728, -1.678]],
        &[
            [9.96, 1.1, 13.95, -1.09],
            [1.32, 0.67, 0.1, -1.58],
            [97.9, 0.8, 1.79, -2.13],
        ],
        &[
            [1.38, 0.86, 0.028, -0.55],
            [6.54, 1.18, 11.1, -1.84],
            [7.34, 0.96, 0.48, -2.66],
            [7.35, 0.99, 0.38, -3.72],
        ],
    ];
    for chain in chains {
        hang::<1>(chain);
        hang::<2>(chain);
        hang::<3>(chain);
    }
}

#[test]
fn a_relaxed_solid_stays_where_it_is() {
    let mesh = Mesh::<Quad4, 2>::block([2, 2], [[0.0, 1.0]; 2]).unwrap();
    let mut scene = Scene::<2>::new();
    let body = scene.solid(Relaxing::RUBBER, &mesh, &Bulk::new(10.0));
    for &point in body.points() {
        scene.set_temperature(point, 310.0);
    }
    for node in body.nodes_where(|[x, _]| x <= 0.0) {
        scene.fix(node);
    }
    let end = mesh.face(|[x, _]| x >= 1.0).unwrap();
    scene.traction(&body, &end, |_| [200.0, 100.0]);
    let mut held = scene.clone();
    held.equilibrium(Equilibrium::new().held()).unwrap();
    scene.equilibrium(Equilibrium::new()).unwrap();
    let tip = body.node_at([1.0, 1.0], 0.0).unwrap();
    let place = |run: &Simulation<2>| run.position(tip).unwrap();
    let held = Simulation::new(held, Scheme::EemTemperature, 0.1).unwrap();
    let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.1).unwrap();
    let start = place(&run);
    for _ in 0..20 {
        run.step().unwrap();
    }
    assert!((place(&run) - start).norm() < 1e-12);
    // At first the branch helps.
    assert!((place(&held) - start).norm() > 0.01);
    // From the held state it creeps to the relaxed one, at temperatures that dissipation raises by less than 1 K.
    let mut run = held;
    run.run_until(10.0).unwrap();
    assert!(
        (place(&run) - start).norm() < 0.01,
        "{} {start}",
        place(&run)
    );
}

#[test]
fn free_bodies_are_named() {
    let mut scene = Scene::<2>::new();
    let ends = [
        scene.mass(1.0, [0.0, 0.0], [0.0; 2]),
        scene.mass(1.0, [1.0, 0.0], [0.0; 2]),
    ];
    scene.spring(SPRING, ends);
    let error = scene.equilibrium(Equilibrium::new()).unwrap_err();
    let EquilibriumError::Free { motion } = &error else {
        panic!("{error}");
    };
    assert!(matches!(
        motion.kind,
        MotionKind::Translation | MotionKind::Rotation
    ));
    assert_eq!(motion.nodes.len(), 2);

    // Held in a corner a triangle can only turn.
    let mut scene = Scene::<2>::new();
    let hinge = scene.anchor([0.0, 0.0]);
    let ends = [
        scene.mass(1.0, [1.0, 0.0], [0.0; 2]),
        scene.mass(1.0, [0.0, 1.0], [0.0; 2]),
    ];
    let diagonal = Hooke {
        natural_length: f64::sqrt(2.0),
        ..SPRING
    };
    scene.spring(SPRING, [hinge, ends[0]]);
    scene.spring(SPRING, [hinge, ends[1]]);
    scene.spring(diagonal, ends);
    let error = scene.equilibrium(Equilibrium::new()).unwrap_err();
    let EquilibriumError::Free { motion } = &error else {
        panic!("{error}");
    };
    assert_eq!(motion.kind, MotionKind::Rotation);
    assert!(
        error
            .to_string()
            .starts_with("nothing holds a rigid rotation of node "),
        "{error}"
    );

    // It hangs down in the end if it has weight.
    scene.set_gravity([0.0, -10.0]);
    scene.equilibrium(Equilibrium::new()).unwrap();
    let run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
    let [one, other] = ends.map(|node| run.position(node).unwrap());
    assert!((one[0] + other[0]).abs() < 1e-12 && one[1] < -0.7 && other[1] < -0.7);
}

#[test]
fn a_mass_without_springs_is_free() {
    let mut scene = Scene::<3>::new();
    let mass = scene.mass(1.0, [0.0; 3], [0.0; 3]);
    scene.set_gravity([0.0, 0.0, -10.0]);
    let error = scene.equilibrium(Equilibrium::new()).unwrap_err();
    let EquilibriumError::Free { motion } = error else {
        panic!("{error}");
    };
    assert_eq!(motion.kind, MotionKind::Translation);
    assert_eq!(motion.nodes[0].0, mass);
}

#[test]
fn a_solid_without_supports_is_free() {
    let mesh = Mesh::<Hex8, 3>::block([2, 1, 1], [[0.0, 2.0], [0.0, 1.0], [0.0, 1.0]]).unwrap();
    let solid = |fixed: &[[f64; 3]]| {
        let mut scene = Scene::<3>::new();
        let steel = SaintVenantKirchhoff {
            lame: 2000.0,
            shear: 1000.0,
        };
        let body = scene.solid(steel, &mesh, &Bulk::new(10.0));
        for &place in fixed {
            scene.fix(body.node_at(place, 0.0).unwrap());
        }
        scene
    };
    // On two nodes it can turn about their line, with or without weight on the other side.
    let axis = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    let kind = |scene: &mut Scene<3>| match scene.equilibrium(Equilibrium::new()) {
        Err(EquilibriumError::Free { motion }) => Some(motion.kind),
        _ => None,
    };
    assert_eq!(kind(&mut solid(&axis)), Some(MotionKind::Rotation));
    let free = kind(&mut solid(&[]));
    assert!(
        matches!(free, Some(kind) if kind != MotionKind::Deformation),
        "{free:?}"
    );
    let mut falling = solid(&[]);
    falling.set_gravity([0.0, -10.0, 0.0]);
    let free = kind(&mut falling);
    assert!(
        matches!(free, Some(kind) if kind != MotionKind::Deformation),
        "{free:?}"
    );
    let mut hanging = solid(&axis);
    hanging.set_gravity([0.0, -10.0, 0.0]);
    hanging.equilibrium(Equilibrium::new()).unwrap();
}

/// Two springs in line between anchors, pressed at their common node by a third.
fn strut(push: f64, offset: f64) -> (Scene<2>, Node) {
    let mut scene = Scene::<2>::new();
    let foot = scene.anchor([0.0, 0.0]);
    let top = scene.mass(1.0, [offset, 1.0], [0.0; 2]);
    scene.spring(SPRING, [foot, top]);
    // Keeps it upright with 5 N/m.
    for side in [-1.0, 1.0] {
        let wall = scene.anchor([side, 1.0]);
        scene.spring(hooke(2.5, 1.0), [wall, top]);
    }
    scene.dead_load(top, [0.0, -push]);
    (scene, top)
}

#[test]
fn a_strut_buckles_and_says_so() {
    // Upright under 2 N it is stable; under 10 N, 5 N/m of the stays are less than 10 N/(0.9 m).
    let (mut scene, top) = strut(2.0, 0.0);
    scene.equilibrium(Equilibrium::new()).unwrap();
    let run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
    assert!(run.position(top).unwrap()[0].abs() < 1e-14);

    let (mut scene, top) = strut(10.0, 0.0);
    let before = scene.clone();
    let error = scene.equilibrium(Equilibrium::new()).unwrap_err();
    let EquilibriumError::Unstable { motion, followed } = &error else {
        panic!("{error}");
    };
    assert_eq!(motion.nodes[0].0, top);
    assert!(
        motion.stiffness < 0.0 && motion.nodes[0].1[0].abs() > 0.99,
        "{motion:?}"
    );
    assert!(*followed > 0.3 && *followed < 0.6, "{followed}");
    // Unchanged.
    let [old, new] = [before, scene].map(|scene| {
        Simulation::new(scene, Scheme::EemEntropy, 0.1)
            .unwrap()
            .values()
    });
    assert_eq!(old, new);

    // With a small offset it falls over, and hangs.
    let (mut scene, top) = strut(10.0, 1e-3);
    let report = scene.equilibrium(Equilibrium::new()).unwrap();
    assert!(
        report.followed < 0.6 && report.friction_steps > 0,
        "{report:?}"
    );
    let run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
    let [x, y]: [f64; 2] = run.position(top).unwrap().into();
    assert!(x.abs() < 1e-14 && y < -1.0, "{x} {y}");
}

#[test]
fn dashpots_in_parallel_hold_nothing_at_rest() {
    let damper = KelvinVoigtDamper {
        stiffness: 100.0,
        coupling: 0.0,
        capacity: 2.0,
        natural_length: 1.0,
        theta_ref: 300.0,
        a: 0.0,
        eta: 1e6,
    };
    let damped = |stiffness: f64| {
        let mut scene = Scene::<1>::new();
        let wall = scene.anchor([0.0]);
        let mass = scene.mass(1.0, [1.0], [2.0]);
        let own = KelvinVoigtDamper {
            stiffness,
            ..damper.clone()
        };
        let spring = scene.spring(own, [wall, mass]);
        scene.set_temperature(spring, 300.0);
        scene.dead_load(mass, [100.0 * 1.1_f64.ln() / 1.1]);
        let found = scene.equilibrium(Equilibrium::new());
        found.map(|_| {
            let run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
            run.stretch(spring).unwrap()
        })
    };
    assert!((damped(100.0).unwrap() - 1.1).abs() < 1e-14);
    let error = damped(0.0).unwrap_err();
    assert!(matches!(error, EquilibriumError::Free { .. }), "{error}");
}

#[test]
fn what_cannot_move_is_at_rest() {
    let mut scene = Scene::<1>::new();
    let report = scene.equilibrium(Equilibrium::new()).unwrap();
    assert_eq!((report.residual.to_bits(), report.node), (0, None));
    let walls = [scene.anchor([0.0]), scene.anchor([3.0])];
    let damper = scene.spring(DAMPER, walls);
    scene.set_temperature(damper, 300.0);
    scene.equilibrium(Equilibrium::new()).unwrap();
    let run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
    assert!((run.viscous_stretch(damper, 0).unwrap() - 2.0).abs() < 1e-15);
}

#[test]
fn insulated_elements_and_bad_settings_are_refused() {
    let mut scene = Scene::<1>::new();
    let wall = scene.anchor([0.0]);
    let mut last = wall;
    let mut springs = Vec::new();
    for place in [1.0, 2.0] {
        let next = scene.mass(1.0, [place], [0.0]);
        springs.push(scene.spring(DAMPER, [last, next]));
        scene.set_temperature(springs[springs.len() - 1], 300.0);
        last = next;
    }
    scene.conduct(springs[0], springs[1], 1.0);
    let error = scene
        .equilibrium(Equilibrium::new().thermal_balance())
        .unwrap_err();
    assert_eq!(
        error,
        EquilibriumError::Insulated {
            element: springs[0]
        }
    );
    let error = scene
        .equilibrium(Equilibrium::new().load_steps(0))
        .unwrap_err();
    assert!(matches!(
        error,
        EquilibriumError::Setting { value: 0.0, .. }
    ));

    scene.force(last, |t| [1.0 / t - f64::INFINITY]);
    let error = scene.equilibrium(Equilibrium::new()).unwrap_err();
    assert!(
        matches!(error, EquilibriumError::Start(StepFailure::Load { .. })),
        "{error}"
    );
    scene.mass(-1.0, [5.0], [0.0]);
    let error = scene.equilibrium(Equilibrium::new()).unwrap_err();
    assert!(matches!(error, EquilibriumError::Scene { .. }), "{error}");
}

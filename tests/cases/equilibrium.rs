//! States at rest against solutions that do not come from the library.

use eem::EquilibriumError;
use eem::kinematics::{Hex8, Hex20, Quad8, Shape};
use eem::materials::Hooke;
use eem::prelude::*;

use crate::support::hooke;
use crate::support::solids::{SaintVenant, ThermoelasticSolid};

const SPRINGS: u8 = 200;
const CHAIN: Hooke = hooke(500.0, 0.1);
const MASS: f64 = 0.02;
const GRAVITY: f64 = 10.0;

/// The nodes of a chain between (0, 0) and (span, 0): in a spring with the force (H, V) the length is L + √(H² + V²)/k,
/// and V grows by a weight from spring to spring. H is found by bisection.
fn hanging(span: f64) -> Vec<[f64; 2]> {
    let weight = MASS * GRAVITY;
    let place = |tension: f64| {
        let mut nodes = vec![[0.0, 0.0]];
        for spring in 0..SPRINGS {
            let middle = 0.5 * f64::from(SPRINGS - 1);
            let (h, v) = (tension, weight * (f64::from(spring) - middle));
            let force = f64::hypot(h, v);
            let length = CHAIN.natural_length + force / CHAIN.stiffness;
            let [x, y] = nodes[nodes.len() - 1];
            nodes.push([x + length * h / force, y + length * v / force]);
        }
        nodes
    };
    let (mut low, mut high) = (1e-6, 1e4);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        let nodes = place(middle);
        if nodes[nodes.len() - 1][0] < span {
            low = middle;
        } else {
            high = middle;
        }
    }
    place(low)
}

fn hangs(span: f64, start: impl Fn(f64) -> [f64; 2]) {
    let mut scene = Scene::<2>::new();
    let mut nodes = vec![scene.anchor([0.0, 0.0])];
    for node in 1..SPRINGS {
        let share = f64::from(node) / f64::from(SPRINGS);
        nodes.push(scene.mass(MASS, start(share), [0.0, 0.0]));
    }
    nodes.push(scene.anchor([span, 0.0]));
    for ends in nodes.windows(2) {
        scene.spring(CHAIN, [ends[0], ends[1]]);
    }
    scene.set_gravity([0.0, -GRAVITY]);
    scene.equilibrium(Equilibrium::new()).unwrap();
    let run = Simulation::new(scene, Scheme::EemEntropy, 1e-3).unwrap();
    let mut worst = 0.0_f64;
    for (&node, exact) in nodes.iter().zip(hanging(span)) {
        let found = run.position(node).unwrap();
        for axis in 0..2 {
            worst = worst.max((found[axis] - exact[axis]).abs());
        }
    }
    assert!(worst < 1e-10, "{worst:e}");
}

#[test]
fn a_chain_hangs_as_it_does() {
    hangs(25.0, |share| [25.0 * share, 0.0]);
}

#[test]
fn a_slack_chain_falls_to_where_it_hangs() {
    // A tent above the anchors.
    hangs(12.0, |share| {
        let height = 8.0 * share.min(1.0 - share);
        [12.0 * share, height]
    });
}

/// Young's modulus, Pa; without Poisson's ratio, so that the clamped end is not stiffer than the beam.
const MODULUS: f64 = 1e6;

/// The deflection of the end of a cantilever with a square section of 1 m, 20 m long, under a small force along y at
/// its end, relative to that of Timoshenko's beam.
fn deflection<H: Shape<3>>(cells: [usize; 3]) -> f64 {
    let mesh = Mesh::<H, 3>::block(cells, [[0.0, 20.0], [0.0, 1.0], [0.0, 1.0]]).unwrap();
    let material = SaintVenant {
        lame: 0.0,
        shear: 0.5 * MODULUS,
    };
    let mut scene = Scene::<3>::new();
    let body = scene.solid(material, &mesh, &Bulk::new(1000.0));
    for node in body.nodes_where(|[x, ..]| x <= 0.0) {
        scene.fix(node);
    }
    let end = mesh.face(|[x, ..]| x >= 20.0).unwrap();
    let force = 1e-2;
    scene.traction(&body, &end, move |_| [0.0, force, 0.0]);
    scene.equilibrium(Equilibrium::new().load_steps(1)).unwrap();
    let run = Simulation::new(scene, Scheme::EemTemperature, 1e-3).unwrap();
    let tip = body.node_at([20.0, 0.0, 0.0], 1e-9).unwrap();
    let found = run.position(tip).unwrap()[1];
    // F L³/(3 E I) + F L/(5/6 G A) with G = E/2.
    let beam = force * 8000.0 * 12.0 / (3.0 * MODULUS) + force * 20.0 * 2.4 / MODULUS;
    found / beam
}

#[test]
fn a_cantilever_of_twenty_nodes_bends_like_a_beam() {
    let found = deflection::<Hex20>([10, 1, 1]);
    assert!((found - 1.0).abs() < 0.01, "{found}");
}

#[test]
fn a_cantilever_of_eight_nodes_converges_with_order_two() {
    // The shear that a bent cell of eight nodes has by mistake makes it stiffer by a number times the square of its
    // length.
    let errors = [20, 40, 80].map(|cells| deflection::<Hex8>([cells, 2, 1]).recip() - 1.0);
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 2.0).abs() < 0.05, "{errors:?}");
    }
    assert!(errors[2] < 0.04, "{errors:?}");
}

/// A spring that has no force where a node is in the end, and keeps it from leaving in one direction.
fn guide<const D: usize>(scene: &mut Scene<D>, node: Node, end: [f64; D], axis: usize) {
    let spring = hooke(100.0, 1.0);
    let mut place = end;
    place[axis] -= 1.0;
    let anchor = scene.anchor(place);
    scene.spring(spring, [anchor, node]);
}

#[test]
fn a_patch_under_traction_has_one_stress() {
    // S = λ tr E 1 + 2 μ E, with E_xx given and S_yy = 0, in plane strain; F = diag(a, b), and the traction is a S_xx.
    let (lame, shear) = (2000.0, 1000.0);
    let a: f64 = 1.1;
    let xx = 0.5 * (a * a - 1.0);
    let yy = -lame * xx / (lame + 2.0 * shear);
    let b = (1.0 + 2.0 * yy).sqrt();
    let traction = a * (lame * (xx + yy) + 2.0 * shear * xx);

    let square = Mesh::<Quad8, 2>::block([3, 3], [[0.0, 1.0]; 2]).unwrap();
    // Skew inside, straight at the edges.
    let skew = |[x, y]: [f64; 2]| {
        let wave = 0.8 * x * (1.0 - x) * y * (1.0 - y);
        [x + wave, y - wave]
    };
    let mesh = square.mapped(skew).unwrap();
    let mut scene = Scene::<2>::new();
    let body = scene.solid(SaintVenant { lame, shear }, &mesh, &Bulk::new(10.0));
    scene.fix(body.node_at([0.0, 0.0], 1e-12).unwrap());
    let corner = body.node_at([1.0, 0.0], 1e-12).unwrap();
    guide(&mut scene, corner, [a, 0.0], 1);
    for (side, sign) in [(0.0, -1.0), (1.0, 1.0)] {
        let face = mesh.face(|[x, _]| (x - side).abs() < 1e-12).unwrap();
        scene.traction(&body, &face, move |_| [sign * traction, 0.0]);
    }
    scene.equilibrium(Equilibrium::new()).unwrap();
    let run = Simulation::new(scene, Scheme::EemEntropy, 1e-3).unwrap();
    for (&node, [x, y]) in body.nodes().iter().zip(mesh.nodes()) {
        let found = run.position(node).unwrap();
        assert!((found[0] - a * x).abs() < 1e-13 && (found[1] - b * y).abs() < 1e-13);
    }
    for &point in body.points() {
        let stress = run.solid_state(point).unwrap().stress;
        // On b of 1 m in the end, and no force in the other direction.
        assert!((stress[(0, 0)] - traction / b).abs() < 1e-12 * traction);
        assert!(stress[(0, 1)].abs() < 1e-12 * traction);
        assert!(stress[(1, 1)].abs() < 1e-12 * traction);
    }
}

#[test]
fn a_block_free_to_expand_has_no_stress() {
    // A wall at 320 K warms it all, from 300 K. At rest and without stress μ (a² − 1) + 3 Λ ln a = β · 20 K.
    let material = ThermoelasticSolid {
        softening: 0.0,
        ..ThermoelasticSolid::RUBBER
    };
    let (shear, lame, expansion) = (material.shear, material.lame, material.expansion);
    let (mut low, mut high) = (1.0_f64, 2.0_f64);
    for _ in 0..100 {
        let a = 0.5 * (low + high);
        if shear * (a * a - 1.0) + 3.0 * lame * a.ln() < 20.0 * expansion {
            low = a;
        } else {
            high = a;
        }
    }
    let a = low;
    let mesh = Mesh::<Hex8, 3>::block([2; 3], [[0.0, 1.0]; 3]).unwrap();
    let mut scene = Scene::<3>::new();
    let body = scene.solid(material, &mesh, &Bulk::new(10.0).conductivity(10.0));
    for &point in body.points() {
        scene.set_temperature(point, 300.0);
    }
    let water = scene.reservoir(320.0);
    scene.wall(&body, &mesh.face(|[x, ..]| x <= 0.0).unwrap(), water);
    scene.fix(body.node_at([0.0; 3], 0.0).unwrap());
    let node = |place| body.node_at(place, 0.0).unwrap();
    guide(&mut scene, node([1.0, 0.0, 0.0]), [a, 0.0, 0.0], 1);
    guide(&mut scene, node([1.0, 0.0, 0.0]), [a, 0.0, 0.0], 2);
    guide(&mut scene, node([0.0, 1.0, 0.0]), [0.0, a, 0.0], 2);
    let report = scene
        .equilibrium(Equilibrium::new().thermal_balance())
        .unwrap();
    assert!(report.heat < 1e-10, "{report:?}");

    let run = Simulation::new(scene, Scheme::EemTemperature, 1e-3).unwrap();
    // E α = 3 K α · E/3 K = β E/(3 Λ + 2 μ) with E = μ (3 Λ + 2 μ)/(Λ + μ).
    let unit = 20.0 * expansion * shear / (lame + shear);
    for &point in body.points() {
        assert!((run.temperature(point).unwrap() - 320.0).abs() < 1e-12 * 320.0);
        let stress = run.solid_state(point).unwrap().stress;
        assert!(stress.amax() < 1e-12 * unit, "{:e}", stress.amax() / unit);
    }
}

/// Roundings of a force `k (λ − l)` and of its length.
const ROUNDINGS: f64 = 64.0;

/// Masses in a row on springs, each given by its stiffness, and with a load.
fn row(spacing: f64, springs: &[(f64, f64)]) -> (Scene<1>, Vec<Node>) {
    let mut scene = Scene::<1>::new();
    let mut nodes = vec![scene.anchor([0.0])];
    let mut place = 0.0;
    for &(stiffness, load) in springs {
        place += spacing;
        let node = scene.mass(1.0, [place], [0.0]);
        scene.spring(hooke(stiffness, spacing), [nodes[nodes.len() - 1], node]);
        scene.dead_load(node, [load]);
        nodes.push(node);
    }
    (scene, nodes)
}

/// Loads from below an ulp of k l to a tenth of it: what is left is `k ε λ`, however large that is.
#[test]
fn bars_rest_at_the_rounding_of_their_length() {
    for (length, stiffness) in [
        (1.0, 100.0),
        (1e5, 1e5),
        (1e5, 1e9),
        (1e-5, 1e-3),
        (1e8, 1e3),
    ] {
        for share in [0.0, 1e-20, 1e-17, 3e-16, 1e-12, 1e-6, 0.1, -0.1, -3e-16] {
            let load = share * stiffness * length;
            let (mut scene, nodes) = row(length, &[(stiffness, load)]);
            let report = scene.equilibrium(Equilibrium::new()).unwrap();
            let rounding = ROUNDINGS * f64::EPSILON * stiffness * length;
            assert!(
                report.residual <= rounding,
                "{length} m, {share}: {report:?}"
            );
            let run = Simulation::new(scene, Scheme::EemEntropy, 1e-3).unwrap();
            let off = run.position(nodes[1]).unwrap()[0] - length * (1.0 + share);
            assert!(
                off.abs() <= ROUNDINGS * f64::EPSILON * length,
                "{length} m, {share}: {off:e}"
            );
        }
    }
}

/// A soft spring that holds stiff ones is a support, though it is 10⁻¹² of them.
#[test]
fn stiffnesses_in_series_may_differ_by_twelve_digits() {
    for springs in [
        [(1e-3, 1e-6), (1e9, 1e-6), (1e9, 2e-6)],
        [(1e9, 1e-6), (1e-3, 1e-6), (1e9, 2e-6)],
        [(1e9, 3e3), (1e-3, 1e-6), (1e-3, 0.0)],
    ] {
        let (mut scene, nodes) = row(1.0, &springs);
        scene.equilibrium(Equilibrium::new()).unwrap();
        let run = Simulation::new(scene, Scheme::EemEntropy, 1e-3).unwrap();
        let mut place = 0.0;
        for (index, &(stiffness, _)) in springs.iter().enumerate() {
            let force: f64 = springs[index..].iter().map(|(_, load)| load).sum();
            place += 1.0 + force / stiffness;
            let found = run.position(nodes[index + 1]).unwrap()[0];
            // The force in a soft spring has the rounding k ε λ of the stiff ones beside it.
            let stiffest = springs
                .iter()
                .fold(0.0_f64, |most, spring| most.max(spring.0));
            let soft = springs[..=index]
                .iter()
                .map(|(k, _)| k.recip())
                .sum::<f64>();
            let off = ROUNDINGS * f64::EPSILON * (place + stiffest * soft);
            assert!(
                (found - place).abs() <= off,
                "{springs:?}: {found} and {place}, {off:e}"
            );
        }
    }
}

/// A mass, kg, on a spring of 1 m and a stiffness, N/m, at an angle from the vertical above its hook, with a load to the side.
fn weight<const D: usize>(angle: f64, [mass, stiffness]: [f64; 2], load: f64) -> (Scene<D>, Node) {
    let mut scene = Scene::new();
    let vector = |side: f64, up: f64| {
        let mut vector = [0.0; D];
        (vector[0], vector[D - 1]) = (side, up);
        vector
    };
    let hook = scene.anchor([0.0; D]);
    let weight = scene.mass(mass, vector(angle.sin(), angle.cos()), [0.0; D]);
    scene.spring(hooke(stiffness, 1.0), [hook, weight]);
    scene.set_gravity(vector(0.0, -GRAVITY));
    scene.dead_load(weight, vector(load, 0.0));
    (scene, weight)
}

/// 1 kg on 10⁴ N/m.
const LIGHT: [f64; 2] = [1.0, 1e4];

/// The last digit of a force does not keep it from its place, which is 1 mm below that of the natural length.
#[test]
fn a_weight_swings_down_from_any_angle() {
    for step in 1..=31 {
        let angle = 0.1 * f64::from(step);
        let (mut scene, weight) = weight::<2>(angle, LIGHT, 0.0);
        let report = scene.equilibrium(Equilibrium::new());
        let report = report.unwrap_or_else(|error| panic!("{angle}: {error}"));
        assert!(
            report.residual <= ROUNDINGS * f64::EPSILON * 1e4,
            "{angle}: {report:?}"
        );
        let run = Simulation::new(scene, Scheme::EemEntropy, 1e-3).unwrap();
        let place = run.position(weight).unwrap();
        let (x, y) = (place[0], place[1]);
        assert!(
            x.abs() < 1e-7 && (y + 1.001).abs() < 1e-13,
            "{angle}: {x:e}, {y}"
        );
    }
}

/// Turns a stiff spring from an angle above its hook.
fn swings_down<const D: usize>(angle: f64, [mass, stiffness]: [f64; 2]) {
    let what = format!("{D}D, {mass} kg, {stiffness} N/m, {angle}");
    let (mut scene, node) = weight::<D>(angle, [mass, stiffness], 0.0);
    let report = scene.equilibrium(Equilibrium::new());
    report.unwrap_or_else(|error| panic!("{what}: {error}"));
    let run = Simulation::new(scene, Scheme::EemEntropy, 1e-3).unwrap();
    let place = run.position(node).unwrap();
    let pull = mass * GRAVITY;
    let length = 1.0 + pull / stiffness;
    // A force that rounding explains, against the stiffness m g/λ of a pendulum and that of the spring.
    let force = ROUNDINGS * f64::EPSILON * (stiffness * length + 2.0 * pull);
    let side = force * length / pull;
    for axis in 0..D - 1 {
        assert!(place[axis].abs() <= side, "{what}: {place:?}");
    }
    let low = force / stiffness + 0.5 * side * side / length;
    assert!((place[D - 1] + length).abs() <= low, "{what}: {place:?}");
}

/// Nor does the stiffness of the spring, which is stretched by the square of the angle that it turns in a step.
#[test]
fn weights_on_stiff_springs_swing_down() {
    for angle in [0.02, 0.3, 0.8, 1.6, 2.9] {
        for mass in [0.1, 2.0, 100.0] {
            for stiffness in [1e2, 1e5, 1e7, 1e10] {
                swings_down::<2>(angle, [mass, stiffness]);
                swings_down::<3>(angle, [mass, stiffness]);
            }
        }
    }
}

/// Pressed against its hook a weight has no state at rest along the vertical; nothing starts the turn.
#[test]
fn what_nothing_turns_is_named() {
    for stiffness in [1e2, 1e3] {
        let (mut scene, node) = weight::<2>(0.0, [100.0, stiffness], 0.0);
        match scene.equilibrium(Equilibrium::new()) {
            Err(EquilibriumError::Unstable { motion, .. }) => {
                assert!(motion.stiffness < 0.0, "{motion:?}");
                assert_eq!(motion.nodes[0].0, node);
                assert!(motion.nodes[0].1[0].abs() > 0.99, "{motion:?}");
            }
            other => panic!("{stiffness}: {other:?}"),
        }
    }
}

/// Exactly above its hook the forces are balanced: the error says that it would fall, and a small load decides to where.
#[test]
fn a_weight_exactly_above_its_hook_would_fall() {
    let (mut scene, _) = weight::<2>(0.0, LIGHT, 0.0);
    match scene.equilibrium(Equilibrium::new()) {
        Err(EquilibriumError::Unstable { motion, .. }) => {
            // −m g/λ at λ = 1 m − m g/k.
            assert!(
                (motion.stiffness + GRAVITY / 0.999).abs() < 1e-9,
                "{motion:?}"
            );
            let by = &motion.nodes[0].1;
            assert!(
                (by[0].abs() - 1.0).abs() < 1e-12 && by[1].abs() < 1e-12,
                "{by:?}"
            );
        }
        other => panic!("{other:?}"),
    }
    let (mut scene, weight) = weight::<2>(0.0, LIGHT, 1e-6);
    scene.equilibrium(Equilibrium::new()).unwrap();
    let run = Simulation::new(scene, Scheme::EemEntropy, 1e-3).unwrap();
    let place = run.position(weight).unwrap();
    let (x, y) = (place[0], place[1]);
    assert!(
        (x - 1.001e-7).abs() < 1e-12 && (y + 1.001).abs() < 1e-12,
        "{x:e}, {y}"
    );
}

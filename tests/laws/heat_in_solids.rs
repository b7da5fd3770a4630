//! Conduction in blocks of hexahedra is of second order, exchanges heat through films and walls as it should,
//! and keeps energy.

use core::f64::consts::PI;

use eem::Body;
use eem::kinematics::{Hex8, Hex20, Shape};
use eem::prelude::*;
use eem_testkit::length::at_length;

use crate::support::solids::MooneyRivlin;

/// A cube that cannot move, with the conductivity 10 W/(m K); its points are warm as a function of the place of
/// their sub-cells.
fn cube(
    cells: [usize; 3],
    warm: impl Fn([f64; 3]) -> f64,
) -> (Scene<3>, Body<Hex8, 3>, Vec<[f64; 3]>) {
    let mesh = Mesh::<Hex8, 3>::block(cells, [[0.0, 1.0]; 3]).unwrap();
    let mut scene = Scene::<3>::new();
    let bulk = Bulk::new(10.0).conductivity(10.0);
    let body = scene.solid(MooneyRivlin::RUBBER, &mesh, &bulk);
    for &node in body.nodes() {
        scene.fix(node);
    }
    let sizes = cells.map(|cells| 1.0 / f64::from(u16::try_from(cells).unwrap()));
    let mut places = Vec::new();
    for cell in mesh.cells() {
        let corner = mesh.nodes()[cell[0]];
        for point in 0..8_u8 {
            places.push(std::array::from_fn(|axis| {
                let upper = f64::from((point >> axis) & 1);
                corner[axis] + sizes[axis] * (0.25 + 0.5 * upper)
            }));
        }
    }
    for (&point, &place) in body.points().iter().zip(&places) {
        scene.set_temperature(point, warm(place));
    }
    (scene, body, places)
}

/// `cos πx cos πy` decays with `2π² k/c`, insulated.
#[test]
fn conduction_is_of_second_order() {
    let shape = |[x, y, _]: [f64; 3]| f64::cos(PI * x) * f64::cos(PI * y);
    let error = |cells: usize| {
        let (scene, body, places) = cube([cells, cells, 1], |place| 300.0 + shape(place));
        let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.01).unwrap();
        let before = run.ledger();
        run.run_until(0.2).unwrap();
        assert!((run.ledger().balance - before.balance).abs() <= 1e-14 * 3e4);
        let decay = f64::exp(-2.0 * PI * PI * 10.0 / 100.0 * 0.2);
        let errors = body.points().iter().zip(&places).map(|(&point, &place)| {
            // Of what is there at the beginning.
            ((run.temperature(point).unwrap() - 300.0) / shape(place) - decay).abs()
        });
        errors.fold(0.0, f64::max)
    };
    let cells = [2, 4, 8];
    let cells = at_length(&cells[..], &cells[..2]).iter();
    let errors: Vec<f64> = cells.map(|&cells| error(cells)).collect();
    println!("{errors:?}");
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 2.0).abs() < 0.05, "{errors:?}");
    }
}

/// Between a wall and a film the flow is that of resistances one after the other, to rounding.
#[test]
fn films_and_walls_are_resistances_in_a_row() {
    let (mut scene, body, _) = cube([2, 1, 1], |_| 300.0);
    let [cold, warm] = [290.0, 310.0].map(|theta| scene.reservoir(theta));
    let left = body.mesh().face(|[x, ..]| x <= 0.0).unwrap();
    let right = body.mesh().face(|[x, ..]| x >= 1.0).unwrap();
    scene.wall(&body, &left, cold);
    scene.exchange(&body, &right, warm, 5.0);
    let mut run = Simulation::new(scene, Scheme::EemTemperature, 1.0).unwrap();
    // The slowest of its motions decays with 0.4/s.
    run.run_until(200.0).unwrap();
    let before = run.reservoir_heat(cold).unwrap();
    run.step().unwrap();
    let flow = run.reservoir_heat(cold).unwrap() - before;
    // 1 m of 10 W/(m K), and a film of 5 W/K.
    let known = 20.0 / (1.0 / 10.0 + 1.0 / 5.0);
    assert!((flow - known).abs() <= 1e-10 * known, "{flow} W");
}

/// A bar of four cells between walls of the temperatures 290 K and 310 K has two points per cell, d apart, of which
/// `sin πx` is a mode: it decays with `Λ = (4k/cd²) sin²(πd/2)`, in steps h as `(1 − Λh/2)/(1 + Λh/2)`, to the linear
/// profile. As `θ*Δs = c Δθ`, the temperature θ* of a point in a step is the logarithmic mean of its ends, which is
/// `Δθ²/12θ` less than their half sum.
#[test]
fn bars_between_walls_go_to_a_linear_profile_as_their_cells_do() {
    const STEPS: i32 = 40;
    let (distance, step, amplitude) = (0.125, 0.05, 1.0);
    let linear = |x: f64| 290.0 + 20.0 * x;
    let rate = 4.0 * 10.0 / 100.0 * f64::powi(f64::sin(0.5 * PI * distance) / distance, 2);
    let factor = (1.0 - 0.5 * rate * step) / (1.0 + 0.5 * rate * step);
    for scheme in [Scheme::EemTemperature, Scheme::EemEntropy] {
        let warm = |[x, ..]: [f64; 3]| linear(x) + amplitude * f64::sin(PI * x);
        let (mut scene, body, places) = cube([4, 1, 1], warm);
        let [cold, hot] = [290.0, 310.0].map(|theta| scene.reservoir(theta));
        let left = body.mesh().face(|[x, ..]| x <= 0.0).unwrap();
        let right = body.mesh().face(|[x, ..]| x >= 1.0).unwrap();
        scene.wall(&body, &left, cold);
        scene.wall(&body, &right, hot);
        let mut run = Simulation::new(scene, scheme, step).unwrap();
        for at in 1..=STEPS {
            run.step().unwrap();
            let share = amplitude * factor.powi(at);
            // Δθ is at most Λh times the amplitude; its square goes with sin², of which a step conducts 2Λh.
            let change = rate * step * amplitude;
            let mean = f64::from(at) * 2.0 * rate * step * change * change / (12.0 * 290.0);
            // The rounding of temperatures, of which steps add up.
            let rounding = 4.0 * f64::from(at) * f64::EPSILON * 310.0;
            for (&point, &[x, ..]) in body.points().iter().zip(&places) {
                let known = linear(x) + share * f64::sin(PI * x);
                let error = (run.temperature(point).unwrap() - known).abs();
                assert!(
                    error <= mean + rounding,
                    "{scheme} {at} {x}: {error:e} K, {mean:e}"
                );
            }
        }
        // All modes, with Λ to 4k/cd², fall by a third in a step: to 1e-14 in 80.
        let most = 4.0 * 10.0 / 100.0 / (distance * distance);
        run.set_step_size(2.0 / f64::sqrt(rate * most)).unwrap();
        for _ in 0..80 {
            run.step().unwrap();
        }
        for (&point, &[x, ..]) in body.points().iter().zip(&places) {
            let error = (run.temperature(point).unwrap() - linear(x)).abs();
            assert!(
                error <= 64.0 * f64::EPSILON * 310.0,
                "{scheme} {x}: {error:e} K"
            );
        }
    }
}

/// The first node of each cell, m, and the temperatures of its points, K, in the order of these nodes.
type ByCell = Vec<([f64; 3], Vec<f64>)>;

fn first_nodes<H: Shape<3>>(mesh: &Mesh<H, 3>) -> Vec<[f64; 3]> {
    let first = |cell: &H::PerNode<usize>| mesh.nodes()[cell.as_ref()[0]];
    mesh.cells().iter().map(first).collect()
}

/// Sets bodies in motion, warm as a function of the place of their cells, and lets them go for some steps, which keep
/// the laws.
fn walk<H: Shape<3>>(mut scene: Scene<3>, bodies: &[&Body<H, 3>]) -> ByCell {
    let points = |body: &Body<H, 3>| {
        let per_cell = body.points().len() / body.mesh().cells().len();
        let points = body.points().chunks(per_cell).map(<[Element]>::to_vec);
        let places = first_nodes(body.mesh()).into_iter();
        places.zip(points).collect::<Vec<_>>()
    };
    for body in bodies {
        for ([x, y, _], points) in points(body) {
            for point in points {
                scene.set_temperature(point, 293.0 + 10.0 * x + 7.0 * y);
            }
        }
        for (&node, [x, y, z]) in body.nodes().iter().zip(body.mesh().nodes()) {
            scene.set_velocity(node, [0.1 * y, -0.2 * x, 0.05 * x * z]);
        }
    }
    let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.05).unwrap();
    let before = run.ledger();
    let mut entropy = before.entropy;
    for _ in 0..at_length(5, 2) {
        run.step().unwrap();
        let ledger = run.ledger();
        // 2 m³ with 100 J/(K m³) at some 300 K.
        assert!((ledger.balance - before.balance).abs() <= 1e-15 * 6e4);
        assert!(ledger.entropy >= entropy);
        entropy = ledger.entropy;
    }
    let temperature = |point: &Element| run.temperature(*point).unwrap();
    let all = bodies.iter().flat_map(|body| points(body));
    let all = all.map(|(place, points)| (place, points.iter().map(temperature).collect()));
    let mut all: ByCell = all.collect();
    all.sort_by(|a, b| a.partial_cmp(b).unwrap());
    all
}

/// The largest difference of temperatures, K, between a bar of one mesh and the same bar as two solids that share
/// a face.
fn between_one_and_two<H: Shape<3>>(cells: [usize; 3], conduct: bool) -> f64 {
    let bulk = Bulk::new(10.0).conductivity(10.0);
    let mesh = Mesh::<H, 3>::block(cells, [[0.0, 2.0], [0.0, 1.0], [0.0, 1.0]]).unwrap();
    let half = |left: bool| mesh.kept(|[x, ..]| (x < 1.0) == left).unwrap();

    let mut scene = Scene::<3>::new();
    let whole = scene.solid(MooneyRivlin::RUBBER, &mesh, &bulk);
    let known = walk(scene, &[&whole]);

    let mut scene = Scene::<3>::new();
    let left = scene.solid(MooneyRivlin::RUBBER, &half(true), &bulk);
    let joined = bulk.joined_to(&left, 1e-9);
    let right = scene.solid(MooneyRivlin::RUBBER, &half(false), &joined);
    if conduct {
        scene.conduct_between(&right, &left);
    }
    let found = walk(scene, &[&left, &right]);

    let pairs = known.iter().zip(&found);
    let errors = pairs.flat_map(|((place, known), (same, found))| {
        assert_eq!(place.map(f64::to_bits), same.map(f64::to_bits));
        let pairs = known.iter().zip(found);
        pairs.map(|(known, found)| (known - found).abs())
    });
    errors.fold(0.0, f64::max)
}

#[test]
fn heat_passes_between_joined_solids_as_within_one() {
    let linear = between_one_and_two::<Hex8>([4, 2, 1], true);
    let quadratic = between_one_and_two::<Hex20>([2, 1, 1], true);
    let insulated = between_one_and_two::<Hex8>([4, 2, 1], false);
    println!("{linear:e} K, {quadratic:e} K, insulated {insulated:e} K");
    // Some 1e-13 K is the rounding of a temperature, of which five steps add up.
    assert!(
        linear <= 5e-12 && quadratic <= 5e-12,
        "{linear:e} {quadratic:e}"
    );
    assert!(insulated > 0.1);
}

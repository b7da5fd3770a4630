//! Cells of every shape: exact mean-value gradients, exact tangents, no energy of a turn, the patch test.

use eem::kinematics::{Ends, Hex8, Hex20, Kinematics, Measure, Quad4, Quad8, Shape, SolidPoint};
use eem::nalgebra::{Rotation, Rotation2, Rotation3, Vector3};
use eem::prelude::*;
use eem::{Array, Body};

use crate::support::numbers::Numbers;
use crate::support::solids::{SaintVenant, ThermoelasticSolid};

/// A point of a cell with all measures.
type CellPoint<H, const D: usize> = SolidPoint<H, COUNT, D>;

const COUNT: usize = 7;

type Arms<H, const D: usize> = <H as Shape<D>>::PerArm<[f64; D]>;

/// A cell of size 1 whose nodes are off by some share, at one of its points.
fn point<H: Shape<D>, const D: usize>(numbers: &mut Numbers) -> (Vec<[f64; D]>, CellPoint<H, D>) {
    let mut reference = H::PerNode::filled([0.0; D]);
    for (place, node) in reference.as_mut().iter_mut().zip(H::NODES) {
        *place = node.map(|side| 0.5 * f64::from(side) + 0.03 * numbers.next());
    }
    let mut fibre = [0.0; D];
    (fibre[0], fibre[1]) = (0.6, 0.8);
    let measures = [
        Measure::Trace,
        Measure::Square,
        Measure::Dilatation,
        Measure::Fibre(fibre),
        Measure::Component(1),
        Measure::Component(2),
        Measure::Component(5),
    ];
    let points = CellPoint::<H, D>::points(&reference, 1.0, measures).unwrap();
    let all = points.as_ref();
    let at = numbers.0 as usize % all.len();
    (reference.as_ref().to_vec(), all[at])
}

fn arms<H: Shape<D>, const D: usize>(places: &[[f64; D]]) -> Arms<H, D> {
    let mut arms = Arms::<H, D>::filled([0.0; D]);
    for (arm, place) in arms.as_mut().iter_mut().zip(&places[1..]) {
        *arm = std::array::from_fn(|axis| place[axis] - places[0][axis]);
    }
    arms
}

fn shifted<const D: usize>(places: &[[f64; D]], numbers: &mut Numbers, size: f64) -> Vec<[f64; D]> {
    let places = places.iter();
    places
        .map(|place| place.map(|at| at + size * numbers.next()))
        .collect()
}

fn ends<H: Shape<D>, const D: usize>(
    point: &CellPoint<H, D>,
    [r0, r1]: [Arms<H, D>; 2],
) -> Ends<CellPoint<H, D>, D> {
    let measures = [point.measure(&r0), point.measure(&r1)];
    Ends::new(point, [r0, r1], measures)
}

fn dot<const D: usize>(a: &[[f64; D]], b: &[[f64; D]]) -> f64 {
    let pairs = a.as_flattened().iter().zip(b.as_flattened());
    pairs.map(|(a, b)| a * b).sum()
}

fn gradients_are_exact<H: Shape<D>, const D: usize>() {
    let mut numbers = Numbers(1);
    for trial in 0..200 {
        let (reference, point) = point::<H, D>(&mut numbers);
        let old = shifted(&reference, &mut numbers, 0.1);
        let new = shifted(&old, &mut numbers, [0.1, 1e-3, 1e-9][trial % 3]);
        let ends = ends(&point, [&old, &new].map(|places| arms::<H, D>(places)));
        let mut change = ends.r1;
        for (new, old) in change.as_mut().iter_mut().zip(ends.r0.as_ref()) {
            *new = std::array::from_fn(|axis| new[axis] - old[axis]);
        }
        for (a, gradient) in point.discrete_gradient(&ends).iter().enumerate() {
            let found = dot(gradient.as_ref(), change.as_ref());
            let difference = ends.measures1[a] - ends.measures0[a];
            let terms: f64 = {
                let pairs = gradient.as_ref().iter().zip(change.as_ref());
                pairs.map(|(g, d)| dot(&[*g], &[*d]).abs()).sum()
            };
            let sizes = point.sizes(&ends.r1, &ends.measures1)[a];
            let error = (found - difference).abs();
            assert!(
                error <= 8.0 * f64::EPSILON * (sizes + terms),
                "{} {trial} {a}: {error:e}",
                H::NAME
            );
        }
    }
}

#[test]
fn mean_value_gradients_of_all_shapes_are_exact() {
    gradients_are_exact::<Quad4, 2>();
    gradients_are_exact::<Quad8, 2>();
    gradients_are_exact::<Hex8, 3>();
    gradients_are_exact::<Hex20, 3>();
}

/// What rounding of the arms does to gradients, in units of ε of what they are computed from: at most some, also where
/// strains vanish and nothing else is left of the gradient of E:E; and there not much less, so that nothing hides.
fn rounding_of_gradients_has_its_size<H: Shape<D>, const D: usize>() {
    let mut numbers = Numbers(3);
    let mut largest = [0.0_f64; COUNT];
    for trial in 0..60 {
        let (reference, point) = point::<H, D>(&mut numbers);
        let places = shifted(&reference, &mut numbers, [0.1, 1e-6, 0.0][trial % 3]);
        let arms = arms::<H, D>(&places);
        let mut rounded = arms;
        for at in rounded.as_mut().as_flattened_mut() {
            *at *= 1.0 + f64::EPSILON * numbers.next();
        }
        let measures = point.measure(&arms);
        let sizes = point.slope_sizes(&arms, &measures);
        let [exact, found] = [&arms, &rounded].map(|arms| point.gradient(arms, &measures));
        for a in 0..COUNT {
            let pairs = exact[a].as_ref().as_flattened().iter();
            let pairs = pairs.zip(found[a].as_ref().as_flattened());
            let change: f64 = pairs.map(|(exact, found)| (exact - found).abs()).sum();
            largest[a] = largest[a].max(change / (f64::EPSILON * sizes[a]));
        }
    }
    println!("{}: {largest:?}", H::NAME);
    assert!(largest.iter().all(|&most| most <= 4.0), "{largest:?}");
    assert!(largest[1] >= 0.01, "{largest:?}");
}

#[test]
fn rounding_of_gradients_of_all_shapes_has_its_size() {
    rounding_of_gradients_has_its_size::<Quad4, 2>();
    rounding_of_gradients_has_its_size::<Quad8, 2>();
    rounding_of_gradients_has_its_size::<Hex8, 3>();
    rounding_of_gradients_has_its_size::<Hex20, 3>();
}

/// `Σ f_a gradient_a`, flat.
fn pulled<A: AsRef<[[f64; D]]>, const D: usize>(gradients: &[A], force: &[f64; COUNT]) -> Vec<f64> {
    let mut sum = vec![0.0; gradients[0].as_ref().len() * D];
    for (gradient, force) in gradients.iter().zip(force) {
        for (sum, entry) in sum.iter_mut().zip(gradient.as_ref().as_flattened()) {
            *sum += force * entry;
        }
    }
    sum
}

/// The derivative at zero by the difference formula of eighth order. With a width w of 0.02 of the length
/// over which gradients change, `w⁸` is below the error `ε/w` of rounding.
pub(super) fn derivative(length: f64, of: impl Fn(f64) -> Vec<f64>) -> Vec<f64> {
    let width = 0.02 * length;
    let weights = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    let mut sum = vec![0.0; of(0.0).len()];
    let mut at = 0.0;
    for weight in weights {
        at += width;
        let pairs = of(at).into_iter().zip(of(-at));
        for (sum, (ahead, behind)) in sum.iter_mut().zip(pairs) {
            *sum += weight * (ahead - behind) / width;
        }
    }
    sum
}

/// The tangent of `Σ f_a D*π_a` with forces that depend on the new measures, and the curvature.
fn tangents_are_derivatives<H: Shape<D>, const D: usize>() {
    let mut numbers = Numbers(2);
    for _ in 0..5 {
        let (reference, point) = point::<H, D>(&mut numbers);
        let old = shifted(&reference, &mut numbers, 0.05);
        let new = shifted(&old, &mut numbers, 0.05);
        let both = ends(&point, [&old, &new].map(|places| arms::<H, D>(places)));
        let slopes = [(); COUNT].map(|()| numbers.next());
        let force_of = |measures: [f64; COUNT]| -> [f64; COUNT] {
            std::array::from_fn(|a| 0.5 + slopes[a] * measures[(a + 1) % COUNT])
        };
        let force = force_of(both.measures1);
        let by_measure = point.gradient(&both.r1, &both.measures1);
        let mut by_arm = by_measure;
        for (a, row) in by_arm.iter_mut().enumerate() {
            *row = by_measure[(a + 1) % COUNT];
            let entries = row.as_mut().as_flattened_mut().iter_mut();
            entries.for_each(|entry| *entry *= slopes[a]);
        }
        let length = point.length(&both.measures1);
        let tangent = point.discrete_tangent(&both, &force, &by_arm);
        let curvature = point.curvature(&both.r1, &both.measures1, &force);
        for (j, axis) in (0..H::NODES.len() - 1).flat_map(|j| (0..D).map(move |axis| (j, axis))) {
            let moved = |shift: f64| {
                let mut r1 = both.r1;
                r1[j][axis] += shift;
                ends(&point, [both.r0, r1])
            };
            let discrete = derivative(length, |shift| {
                let ends = moved(shift);
                pulled(&point.discrete_gradient(&ends), &force_of(ends.measures1))
            });
            let ordinary = derivative(length, |shift| {
                let ends = moved(shift);
                pulled(&point.gradient(&ends.r1, &ends.measures1), &force)
            });
            for (blocks, known) in [(&tangent, discrete), (&curvature, ordinary)] {
                let largest = known
                    .iter()
                    .fold(0.0, |most: f64, entry| most.max(entry.abs()));
                for (i, row) in blocks.as_ref().iter().enumerate() {
                    for along in 0..D {
                        let error = (row[j][along][axis] - known[i * D + along]).abs();
                        let bound = 1e-12 * largest.max(1.0);
                        assert!(error <= bound, "{}: {error:e}", H::NAME);
                    }
                }
            }
        }
    }
}

#[test]
fn tangents_of_all_shapes_are_derivatives() {
    tangents_are_derivatives::<Quad4, 2>();
    tangents_are_derivatives::<Quad8, 2>();
    tangents_are_derivatives::<Hex8, 3>();
    tangents_are_derivatives::<Hex20, 3>();
}

/// Young's modulus is about 1e9 Pa.
fn stiff() -> SaintVenant {
    SaintVenant {
        lame: 5e8,
        shear: 4e8,
    }
}

/// A block of 2 cells along each axis, 1 m long.
fn block<H: Shape<D>, const D: usize>() -> Mesh<H, D> {
    Mesh::block([2; D], [[0.0, 1.0]; D]).unwrap()
}

fn turn_stores_nothing<H: Shape<D>, const D: usize>(turn: &Rotation<f64, D>) {
    let mesh = Mesh::<H, D>::block([1; D], [[0.0, 1.0]; D]).unwrap();
    let mut scene = Scene::<D>::new();
    let body = scene.solid(stiff(), &mesh, &Bulk::new(10.0));
    let moved = mesh.rotated(turn).unwrap().translated([10.0; D]).unwrap();
    for (&node, &place) in body.nodes().iter().zip(moved.nodes()) {
        scene.set_position(node, place);
    }
    let run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
    let energy = run.ledger().internal_energy;
    // The positions at 10 m are rounded by 1e-15 m, which is a strain of that size.
    assert!(energy.abs() <= 1e-18, "{}: {energy:e} J", H::NAME);
}

#[test]
fn turned_bodies_of_all_shapes_store_nothing() {
    let (plane, space) = (
        Rotation2::new(1.1),
        Rotation3::new(Vector3::new(0.3, -1.2, 0.7)),
    );
    turn_stores_nothing::<Quad4, 2>(&plane);
    turn_stores_nothing::<Quad8, 2>(&plane);
    turn_stores_nothing::<Hex8, 3>(&space);
    turn_stores_nothing::<Hex20, 3>(&space);
}

/// A mesh whose inner nodes are off their places, pulled by a linear map: inner nodes are in balance, as the
/// strain is the same everywhere.
fn patch_test<H: Shape<D>, const D: usize>(off: f64) {
    let mut numbers = Numbers(7);
    for _ in 0..3 {
        let mesh = block::<H, D>();
        let is_inner = |place: &[f64; D]| place.iter().all(|at| *at > 0.0 && *at < 1.0);
        // Middles of edges stay in the middle, so that edges are straight.
        let shift: [f64; D] = [(); D].map(|()| off * numbers.next());
        let hat = |place: [f64; D]| {
            let share = place
                .iter()
                .fold(1.0, |share, at| share * (1.0 - (2.0 * at - 1.0).abs()));
            std::array::from_fn(|axis| place[axis] + share * shift[axis])
        };
        let mesh = mesh.mapped(hat).unwrap();
        let map: [[f64; D]; D] = [(); D].map(|()| [(); D].map(|()| 0.2 * numbers.next()));
        let moved = |place: &[f64; D]| -> [f64; D] {
            std::array::from_fn(|row| place[row] + dot(&[map[row]], &[*place]))
        };
        let mut scene = Scene::<D>::new();
        let material = ThermoelasticSolid::RUBBER;
        let body: Body<H, D> = scene.solid(material, &mesh, &Bulk::new(10.0));
        for &point in body.points() {
            scene.set_temperature(point, 320.0);
        }
        for (&node, place) in body.nodes().iter().zip(mesh.nodes()) {
            scene.set_position(node, moved(place));
            if !is_inner(place) {
                scene.fix(node);
            }
        }
        let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
        run.step().unwrap();
        for (&node, place) in body.nodes().iter().zip(mesh.nodes()) {
            let (found, known) = (run.position(node).unwrap(), moved(place));
            for axis in 0..D {
                let error = (found[axis] - known[axis]).abs();
                assert!(error <= 4e-16, "{}: {error:e} m", H::NAME);
            }
        }
    }
}

#[test]
fn all_shapes_pass_the_patch_test() {
    patch_test::<Quad4, 2>(0.08);
    patch_test::<Hex8, 3>(0.08);
    patch_test::<Quad8, 2>(0.0);
    patch_test::<Hex20, 3>(0.0);
}

/// The kinetic energy of a block of 10 kg/m³ that turns about z with 1/s, J.
fn energy_of_turn<H: Shape<3>>(mesh: &Mesh<H, 3>) -> f64 {
    let mut scene = Scene::<3>::new();
    let body = scene.solid(stiff(), mesh, &Bulk::new(10.0));
    for (&node, [x, y, _]) in body.nodes().iter().zip(mesh.nodes()) {
        scene.set_velocity(node, [-y, *x, 0.0]);
    }
    let run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
    run.ledger().kinetic_energy
}

/// Mass, and moments of inertia to rounding: `T = ½ ω² ∫ρ(x² + y²)` of a turning block that is no
/// parallelepiped.
#[test]
fn consistent_masses_are_exact_for_rigid_motions() {
    let taper = |[x, y, z]: [f64; 3]| [x, y * (1.0 + x), z];
    // ∫ (x² + y²) over 0 < x < 1, 0 < y < 1 + x: 7/12 + 15/12.
    let known = 0.5 * 10.0 * 22.0 / 12.0;
    let [hex8, hex20] = [
        energy_of_turn(&block::<Hex8, 3>().mapped(taper).unwrap()),
        energy_of_turn(
            &Mesh::<Hex20, 3>::block([1; 3], [[0.0, 1.0]; 3])
                .unwrap()
                .mapped(taper)
                .unwrap(),
        ),
    ];
    assert!((hex8 - known).abs() < 1e-13, "{hex8}");
    assert!((hex20 - known).abs() < 1e-13, "{hex20}");
}

/// A lumped cube of n cells per side has 1 + 2/n² times its moment of inertia.
#[test]
fn lumped_masses_are_as_said() {
    for (cells, factor) in [(1, 3.0), (2, 1.5)] {
        let mesh = Mesh::<Hex8, 3>::block([cells; 3], [[-0.5, 0.5]; 3]).unwrap();
        let mut scene = Scene::<3>::new();
        let body = scene.solid(stiff(), &mesh, &Bulk::new(6.0).lumped());
        for (&node, [x, y, _]) in body.nodes().iter().zip(mesh.nodes()) {
            scene.set_velocity(node, [-y, *x, 0.0]);
        }
        let run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
        let spin = run.ledger().angular_momentum[2];
        assert!((spin - factor).abs() < 1e-14, "{cells}: {spin}");
    }
}

/// A cube and a square that are stretched along the first axis and turned.
#[test]
fn stress_is_that_of_the_formula_and_turns_with_the_body() {
    let (a, angle) = (1.3, 0.7_f64);
    let (lame, shear) = (2000.0, 1000.0);
    let along = 0.5 * (a * a - 1.0);
    // S₁₁ = (Λ + 2μ) E₁₁, S₂₂ = S₃₃ = Λ E₁₁; σ = F S Fᵀ/J with J = a.
    let expected = [a * (lame + 2.0 * shear) * along, lame * along / a];
    let material = || SaintVenant { lame, shear };
    let (sin, cos) = angle.sin_cos();
    let place = |[x, y]: [f64; 2]| [cos * a * x - sin * y, sin * a * x + cos * y];
    let mut scene = Scene::<3>::new();
    let mesh = Mesh::<Hex8, 3>::block([1; 3], [[0.0, 1.0]; 3]).unwrap();
    let cube = scene.solid(material(), &mesh, &Bulk::new(10.0));
    for (&node, &[x, y, z]) in cube.nodes().iter().zip(mesh.nodes()) {
        let [x, y] = place([x, y]);
        scene.set_position(node, [x, y, z]);
    }
    let in_space = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
    let mut scene = Scene::<2>::new();
    let mesh = Mesh::<Quad4, 2>::block([1; 2], [[0.0, 1.0]; 2]).unwrap();
    let square = scene.solid(material(), &mesh, &Bulk::new(10.0).thickness(0.3));
    for (&node, &corner) in square.nodes().iter().zip(mesh.nodes()) {
        scene.set_position(node, place(corner));
    }
    let in_plane = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
    let points = cube
        .points()
        .iter()
        .map(|&point| in_space.solid_state(point));
    let points = points.chain(
        square
            .points()
            .iter()
            .map(|&point| in_plane.solid_state(point)),
    );
    for state in points.map(Result::unwrap) {
        let [first, second] = expected;
        let turned = [
            first * cos * cos + second * sin * sin,
            first * sin * sin + second * cos * cos,
            (first - second) * sin * cos,
        ];
        let near = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-12 * first);
        near(state.stress[(0, 0)], turned[0]);
        near(state.stress[(1, 1)], turned[1]);
        near(state.stress[(0, 1)], turned[2]);
        near(state.stress[(2, 2)], second);
        near(state.von_mises(), first - second);
        near(first * state.strain[(0, 0)], first * along);
        near(first * state.dilatation, first * (a - 1.0));
    }
}

//! Solids keep energy, momenta and the growth of entropy, store nothing when they turn, and pass the patch
//! test.

use eem::kinematics::{Ends, Kinematics, Measure, Quad4, Quad8, SolidPoint};
use eem::prelude::*;
use eem_testkit::length::at_length;

use crate::support::numbers::Numbers;
use crate::support::solids::{Relaxing, SECTION, SaintVenant, ThermoelasticSolid, Viscous};

const MEASURES: [Measure<2>; 3] = [Measure::Trace, Measure::Square, Measure::Dilatation];

/// A point of a quadrilateral.
type QuadPoint = SolidPoint<Quad4, 3, 2>;

/// A bar of two squares that tumbles in free space, warm at one end and in contact with air, and what its
/// heat capacity is, J/K.
fn tumbling<M, const N: usize>(
    material: &M,
    is_thermal: bool,
    scheme: Scheme,
    step: f64,
) -> Simulation<2>
where
    M: FreeEnergy<f64> + eem::StrainEnergy<N> + Clone + Send + Sync + 'static,
{
    let mut scene = Scene::<2>::new();
    let speed = f64::min(1.0, 0.2 / step);
    let nodes: Vec<_> = (0..6_u8)
        .map(|at| {
            let [x, y] = [f64::from(at % 3) - 1.0, f64::from(at / 3) - 0.5];
            let velocity = [-y + 1e-3 * x * y, x - 1e-3 * x];
            scene.node([x, y], velocity.map(|v| speed * v))
        })
        .collect();
    let mut points = Vec::new();
    for first in [0, 1] {
        let corners = [first, first + 1, first + 4, first + 3].map(|at| nodes[at]);
        points.extend(scene.quadrilateral(material.clone(), corners, SECTION));
    }
    if is_thermal {
        let mut theta = 300.0;
        for &point in &points {
            scene.set_temperature(point, theta);
            theta += 0.05;
        }
        for pair in points.windows(2) {
            scene.conduct(pair[0], pair[1], 20.0);
        }
        let air = scene.reservoir(295.0);
        scene.conduct(points[0], air, 5.0);
    }
    Simulation::new(scene, scheme, step).unwrap()
}

/// 40 steps keep the laws, whatever the step.
fn keeps_the_laws<M, const N: usize>(name: &str, material: &M, is_thermal: bool)
where
    M: FreeEnergy<f64> + eem::StrainEnergy<N> + Clone + Send + Sync + 'static,
{
    for scheme in [Scheme::EemEntropy, Scheme::EemTemperature] {
        for step in [1e-3, 1e-2, 1e-1, 1.0, 10.0] {
            let mut run = tumbling(material, is_thermal, scheme, step);
            let first = run.ledger();
            // Temperatures, which are rounded, are energies of c θ: 100 J/K in each m³.
            let heat = if is_thermal { 2.0 * 100.0 * 300.0 } else { 0.0 };
            // Strains are rounded by ε whatever their size, which is work of the stress: with the energy T
            // in the volume V of modulus k, V σ² ≤ k T.
            let kinetic = first.kinetic_energy;
            let size = kinetic + heat + f64::sqrt(2.0 * 2000.0 * kinetic);
            let momenta = 20.0 * f64::min(1.0, 0.2 / step);
            let mut entropy = first.entropy;
            for _ in 0..at_length(40, 12) {
                let report = run.step().unwrap();
                let ledger = run.ledger();
                let energy = (ledger.balance - first.balance).abs();
                assert!(
                    energy <= 2e-15 * size,
                    "{name} {scheme} {step}: {energy:e} J"
                );
                let linear = (ledger.linear_momentum - first.linear_momentum).norm();
                assert!(
                    linear <= 2e-14 * momenta,
                    "{name} {scheme} {step}: {linear:e}"
                );
                let angular = (ledger.angular_momentum - first.angular_momentum).norm();
                let spin = first.angular_momentum.norm();
                assert!(
                    angular <= 5e-14 * spin,
                    "{name} {scheme} {step}: {angular:e}"
                );
                let change = ledger.entropy - entropy;
                assert!(change >= -2.0 * f64::EPSILON * entropy.abs(), "{change:e}");
                assert!(report.least_production >= 0.0);
                entropy = ledger.entropy;
            }
            assert!(!is_thermal || entropy > first.entropy);
        }
    }
}

#[test]
fn solids_keep_the_laws() {
    let elastic = SaintVenant {
        lame: 2000.0,
        shear: 1000.0,
    };
    keeps_the_laws("elastic", &elastic, false);
    keeps_the_laws("softening", &ThermoelasticSolid::RUBBER, true);
    keeps_the_laws("viscous", &Viscous::RUBBER, true);
    keeps_the_laws("relaxing", &Relaxing::RUBBER, true);
}

#[test]
fn ordinary_rules_and_the_staggered_scheme_step_solids() {
    let schemes = [
        Scheme::Staggered,
        Scheme::Midpoint,
        Scheme::MidpointTemperature,
        Scheme::Trapezoidal,
        Scheme::TrapezoidalTemperature,
    ];
    for scheme in schemes {
        let mut exact = tumbling(&Viscous::RUBBER, true, Scheme::EemEntropy, 1e-3);
        let mut run = tumbling(&Viscous::RUBBER, true, scheme, 1e-3);
        for _ in 0..20 {
            exact.step().unwrap();
            run.step().unwrap();
        }
        let [kinetic, internal] = [
            run.ledger().kinetic_energy - exact.ledger().kinetic_energy,
            run.ledger().internal_energy - exact.ledger().internal_energy,
        ];
        assert!(
            kinetic.abs() < 2e-4 && internal.abs() < 2e-3,
            "{scheme}: {kinetic:e} {internal:e}"
        );
    }
    for scheme in [Scheme::Variational, Scheme::Variational4, Scheme::Gauss4] {
        let mut scene = Scene::<2>::new();
        let corners = SQUARE.map(|corner| scene.node(corner, [0.0; 2]));
        scene.quadrilateral(stiff(), corners, SECTION);
        let error = Simulation::new(scene, scheme, 0.1).unwrap_err();
        assert!(error.to_string().starts_with(scheme.name()), "{error}");
    }
}

const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

/// Stiff: 1e9 Pa.
fn stiff() -> SaintVenant {
    SaintVenant {
        lame: 5e8,
        shear: 4e8,
    }
}

#[test]
fn a_turned_body_stores_nothing() {
    for angle in [0.3, 1.1, 2.9] {
        let (sin, cos) = f64::sin_cos(angle);
        let mut scene = Scene::<2>::new();
        let corners = SQUARE.map(|corner| scene.node(corner, [0.0; 2]));
        scene.quadrilateral(stiff(), corners, SECTION);
        for (node, [x, y]) in corners.into_iter().zip(SQUARE) {
            scene.set_position(node, [10.0 + cos * x - sin * y, -10.0 + sin * x + cos * y]);
        }
        let run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
        // The positions at 10 m are rounded by 1e-15 m, which is a strain of that size.
        let energy = run.ledger().internal_energy;
        assert!(energy.abs() <= 1e-20, "{energy:e} J");
    }
}

/// Nine nodes of four cells whose inner node is off the middle, pulled by a linear map: the inner node is in
/// balance, as the strain is the same everywhere.
#[test]
fn the_patch_test_is_passed() {
    let mut numbers = Numbers(7);
    for _ in 0..20 {
        let inner = [0.5 + 0.08 * numbers.next(), 0.5 + 0.08 * numbers.next()];
        let map = [numbers.point(0.2), numbers.point(0.2)];
        let moved = |[x, y]: [f64; 2]| {
            let at = |row: [f64; 2], own: f64| own + row[0] * x + row[1] * y;
            [at(map[0], x), at(map[1], y)]
        };
        let place = |at: u8| match at {
            4 => inner,
            _ => [f64::from(at % 3) / 2.0, f64::from(at / 3) / 2.0],
        };
        let mut scene = Scene::<2>::new();
        let nodes: Vec<_> = (0..9)
            .map(|at| match at {
                4 => scene.node(place(at), [0.0; 2]),
                _ => scene.anchor(place(at)),
            })
            .collect();
        for first in [0, 1, 3, 4] {
            let corners = [first, first + 1, first + 4, first + 3].map(|at| nodes[at]);
            for point in scene.quadrilateral(ThermoelasticSolid::RUBBER, corners, SECTION) {
                scene.set_temperature(point, 320.0);
            }
        }
        for (at, &node) in (0..).zip(&nodes) {
            scene.set_position(node, moved(place(at)));
        }
        let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
        run.step().unwrap();
        let expected = moved(inner);
        let found = run.position(nodes[4]).unwrap();
        for axis in 0..2 {
            assert!(
                (found[axis] - expected[axis]).abs() <= 4e-16,
                "{found} {expected:?}"
            );
        }
    }
}

/// J is known to ε where little is left of a volume, and beside a large shear.
#[test]
fn crushed_and_sheared_bodies_have_their_volume() {
    let [point, ..] = QuadPoint::points(&SQUARE, 1.0, MEASURES).unwrap();
    let volume = |f: [[f64; 2]; 2]| {
        let arms = [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let arms = arms.map(|[x, y]: [f64; 2]| f.map(|row| row[0] * x + row[1] * y));
        1.0 + point.measure(&arms)[2]
    };
    for size in [1e-1, 1e-2, 1e-3, 1e-5] {
        let error = volume([[size, 0.0], [0.0, size]]) - size * size;
        assert!(error.abs() <= 4.0 * f64::EPSILON, "{size}: {error:e}");
    }
    let error = volume([[1.0, 1e9], [0.0, 1.0]]) - 1.0;
    assert!(error.abs() <= 1e9 * 4.0 * f64::EPSILON, "{error:e}");
}

/// Old and new arms of a deformed quadrilateral at one of its points.
fn ends(numbers: &mut Numbers, step: f64) -> (QuadPoint, Ends<QuadPoint, 2>) {
    let reference = SQUARE.map(|[x, y]| [x + 0.1 * numbers.next(), y + 0.1 * numbers.next()]);
    let points = QuadPoint::points(&reference, 1.0, MEASURES).unwrap();
    let point = points[numbers.0 as usize % 4];
    let old = reference.map(|[x, y]| [x + 0.2 * numbers.next(), y + 0.2 * numbers.next()]);
    let new = old.map(|[x, y]| [x + step * numbers.next(), y + step * numbers.next()]);
    let arms = |q: &[[f64; 2]; 4]| [1, 2, 3].map(|at| [q[at][0] - q[0][0], q[at][1] - q[0][1]]);
    let (r0, r1) = (arms(&old), arms(&new));
    let measures = [point.measure(&r0), point.measure(&r1)];
    (point, Ends::new(&point, [r0, r1], measures))
}

fn dot(a: &[[f64; 2]; 3], b: &[[f64; 2]; 3]) -> f64 {
    a.as_flattened()
        .iter()
        .zip(b.as_flattened())
        .map(|(a, b)| a * b)
        .sum()
}

#[test]
fn mean_value_gradients_of_strains_are_exact() {
    let mut numbers = Numbers(1);
    for trial in 0..200 {
        let (point, ends) = ends(&mut numbers, [0.3, 1e-3, 1e-9][trial % 3]);
        let mut change = ends.r1;
        for (new, old) in change
            .as_flattened_mut()
            .iter_mut()
            .zip(ends.r0.as_flattened())
        {
            *new -= old;
        }
        for (a, gradient) in point.discrete_gradient(&ends).iter().enumerate() {
            let difference = ends.measures1[a] - ends.measures0[a];
            let error = (dot(gradient, &change) - difference).abs();
            assert!(error <= 8.0 * f64::EPSILON * 4.0, "{trial} {a}: {error:e}");
        }
    }
}

/// The same with other new arms.
fn moved_to(point: &QuadPoint, ends: &Ends<QuadPoint, 2>, r1: [[f64; 2]; 3]) -> Ends<QuadPoint, 2> {
    Ends::new(point, [ends.r0, r1], [ends.measures0, point.measure(&r1)])
}

/// `Σ f_a gradient_a`.
fn pulled(gradients: [[[f64; 2]; 3]; 3], force: [f64; 3]) -> [[f64; 2]; 3] {
    let mut sum = [[0.0; 2]; 3];
    for (gradient, force) in gradients.iter().zip(force) {
        for (sum, entry) in sum
            .as_flattened_mut()
            .iter_mut()
            .zip(gradient.as_flattened())
        {
            *sum += force * entry;
        }
    }
    sum
}

/// The tangent of `Σ f_a D*π_a` with forces that depend on the new measures, and the curvature, against
/// differences.
#[test]
fn tangents_of_strains_are_derivatives() {
    let mut numbers = Numbers(2);
    let width = 1e-6;
    for _ in 0..50 {
        let (point, ends) = ends(&mut numbers, 0.2);
        let slopes = [numbers.next(), numbers.next(), numbers.next()];
        let force_of = |measures: [f64; 3]| -> [f64; 3] {
            std::array::from_fn(|a| 0.5 + slopes[a] * measures[(a + 1) % 3])
        };
        let force = force_of(ends.measures1);
        let by_measure = point.gradient(&ends.r1, &ends.measures1);
        let mut by_arm = by_measure;
        for (a, row) in by_arm.iter_mut().enumerate() {
            *row = by_measure[(a + 1) % 3].map(|arm| arm.map(|entry| slopes[a] * entry));
        }
        let tangent = point.discrete_tangent(&ends, &force, &by_arm);
        let curvature = point.curvature(&ends.r1, &ends.measures1, &force);
        for (j, axis) in [(0, 0), (0, 1), (1, 0), (1, 1), (2, 0), (2, 1)] {
            let shifted = |shift: f64| {
                let mut r1 = ends.r1;
                r1[j][axis] += shift;
                let ends = moved_to(&point, &ends, r1);
                let discrete = pulled(point.discrete_gradient(&ends), force_of(ends.measures1));
                (
                    discrete,
                    pulled(point.gradient(&r1, &ends.measures1), force),
                )
            };
            let (ahead, behind) = (shifted(width), shifted(-width));
            for i in 0..3 {
                for row in 0..2 {
                    let slope = |a: [[f64; 2]; 3], b: [[f64; 2]; 3]| {
                        (a[i][row] - b[i][row]) / (2.0 * width)
                    };
                    let errors = [
                        tangent[i][j][row][axis] - slope(ahead.0, behind.0),
                        curvature[i][j][row][axis] - slope(ahead.1, behind.1),
                    ];
                    // ε/width of numbers of order one, and width².
                    assert!(errors.iter().all(|error| error.abs() < 2e-8), "{errors:?}");
                }
            }
        }
    }
}

#[test]
fn what_is_wrong_with_a_solid_is_said() {
    let build =
        |change: &dyn Fn(&mut Scene<2>, [Node; 4]), section: Section, corners: [[f64; 2]; 4]| {
            let mut scene = Scene::<2>::new();
            let nodes = corners.map(|corner| scene.node(corner, [0.0; 2]));
            scene.quadrilateral(stiff(), nodes, section);
            change(&mut scene, nodes);
            Simulation::new(scene, Scheme::EemEntropy, 0.1)
                .unwrap_err()
                .to_string()
        };
    let nothing = |_: &mut Scene<2>, _: [Node; 4]| {};
    let clockwise = [SQUARE[0], SQUARE[3], SQUARE[2], SQUARE[1]];
    let message = build(&nothing, SECTION, clockwise);
    assert!(
        message.starts_with("det dX/dxi of the solid at element 0 (SaintVenantKirchhoff) is -0.25"),
        "{message}"
    );
    let mut nowhere = SQUARE;
    nowhere[2][1] = f64::NAN;
    let message = build(&nothing, SECTION, nowhere);
    assert!(message.contains("node 2 is NaN"), "{message}");
    let section = Section {
        density: 0.0,
        ..SECTION
    };
    let message = build(&nothing, section, SQUARE);
    assert!(
        message.starts_with(
            "the density of the solid at element 0 (SaintVenantKirchhoff) is 0 kg/m^3"
        ),
        "{message}"
    );
    let message = build(
        &|scene, nodes| scene.set_momentum(nodes[1], [1.0, 0.0]),
        SECTION,
        SQUARE,
    );
    assert!(
        message.starts_with("node 1 belongs to a solid"),
        "{message}"
    );
    let message = {
        let mut scene = Scene::<2>::new();
        let nodes = SQUARE.map(|corner| scene.mass(-1.0, corner, [0.0; 2]));
        scene.quadrilateral(stiff(), nodes, SECTION);
        let error = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap_err();
        error.to_string()
    };
    assert!(
        message.contains("\n- the mass of node 0 is -1 kg"),
        "{message}"
    );
    let message = build(
        &|scene, nodes| scene.set_position(nodes[2], [-3.0, -3.0]),
        SECTION,
        SQUARE,
    );
    assert!(
        message.contains("det F of the solid at element 0 (SaintVenantKirchhoff) is -"),
        "{message}"
    );
    let message = build(
        &|scene, _| {
            scene.node([0.0; 2], [0.0; 2]);
        },
        SECTION,
        SQUARE,
    );
    assert!(
        message.starts_with("the mass of node 4 is 0 kg"),
        "{message}"
    );
}

/// Masses between corners and middles of edges are negative in places, and the shortest steps are judged by them.
#[test]
fn the_shortest_steps_of_consistent_masses_are_taken() {
    for step in [1e-3, 1e-5, 1e-7, 1e-9] {
        let mesh = Mesh::<Quad8, 2>::block([1, 1], [[0.0, 0.1]; 2]).unwrap();
        let mut scene = Scene::<2>::new();
        let body = scene.solid(stiff(), &mesh, &Bulk::new(1100.0));
        for &node in body.nodes() {
            scene.set_velocity(node, [10.0, 3.0]);
        }
        let mut run = Simulation::new(scene, Scheme::EemEntropy, step).unwrap();
        for _ in 0..3 {
            assert_eq!(run.step().unwrap().iterations, 1, "with h = {step} s");
        }
    }
}

//! Solids keep energy, momenta and the growth of entropy.

use eem::kinematics::{Kinematics, Measure, Quad4, Quad8, SolidPoint};
use eem::prelude::*;
use eem_testkit::length::at_length;

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

#[test]
fn what_is_wrong_with_a_solid_is_said() {
    type Change = fn(&mut Scene<2>, [Node; 4]);
    let nothing: Change = |_, _| {};
    let clockwise = [SQUARE[0], SQUARE[3], SQUARE[2], SQUARE[1]];
    let mut nowhere = SQUARE;
    nowhere[2][1] = f64::NAN;
    let cases: [(_, Change, &str); 6] = [
        (
            (SECTION.density, clockwise),
            nothing,
            "det dX/dxi of the solid at element 0 (SaintVenantKirchhoff) is -0.25",
        ),
        ((SECTION.density, nowhere), nothing, "node 2 is NaN"),
        (
            (0.0, SQUARE),
            nothing,
            "the density of the solid at element 0 (SaintVenantKirchhoff) is 0 kg/m^3",
        ),
        (
            (SECTION.density, SQUARE),
            |scene, nodes| scene.set_momentum(nodes[1], [1.0, 0.0]),
            "node 1 belongs to a solid",
        ),
        (
            (SECTION.density, SQUARE),
            |scene, nodes| scene.set_position(nodes[2], [-3.0, -3.0]),
            "det F of the solid at element 0 (SaintVenantKirchhoff) is -",
        ),
        (
            (SECTION.density, SQUARE),
            |scene, _| _ = scene.node([0.0; 2], [0.0; 2]),
            "the mass of node 4 is 0 kg",
        ),
    ];
    for ((density, corners), change, expected) in cases {
        let mut scene = Scene::<2>::new();
        let nodes = corners.map(|corner| scene.node(corner, [0.0; 2]));
        let section = Section { density, ..SECTION };
        scene.quadrilateral(stiff(), nodes, section);
        change(&mut scene, nodes);
        let refused = Simulation::new(scene, Scheme::EemEntropy, 0.1);
        let message = refused.unwrap_err().to_string();
        assert!(message.contains(expected), "{message}");
    }
    let mut scene = Scene::<2>::new();
    let nodes = SQUARE.map(|corner| scene.mass(-1.0, corner, [0.0; 2]));
    scene.quadrilateral(stiff(), nodes, SECTION);
    let refused = Simulation::new(scene, Scheme::EemEntropy, 0.1);
    let message = refused.unwrap_err().to_string();
    assert!(
        message.contains("\n- the mass of node 0 is -1 kg"),
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

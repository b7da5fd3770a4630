//! Solids whose shape flows: exact gradients and tangents, relaxation, heat, and no axis of their own.

mod element;
mod relaxation;

use eem::kinematics::{Hex8, Quad4};
use eem::nalgebra::{Matrix3, Rotation3, Vector3};
use eem::prelude::*;
use eem::{Body, SolidError};
use eem_testkit::length::at_length;

use crate::support::solids::{Flowing, Relaxing, SaintVenant};

/// A bar that tumbles, all of it turned by some rotation.
fn turned(turn: &Rotation3<f64>, scheme: Scheme) -> (Simulation<3>, Body<Hex8, 3>) {
    let mut scene = Scene::<3>::new();
    let mesh = Mesh::block([1; 3], [[0.0, 2.0], [0.0, 1.0], [0.0, 1.0]]).unwrap();
    let fibre = turn * Vector3::new(0.6, 0.8, 0.0);
    let bulk = Bulk::new(10.0).fibre(fibre.into());
    let rotated = mesh.rotated(turn).unwrap();
    let body = scene.solid(Flowing::RUBBER, &rotated, &bulk);
    for (&node, &[x, y, z]) in body.nodes().iter().zip(mesh.nodes()) {
        let velocity = Vector3::new(2.0 * z + x * y, 0.5 - z, 3.0 * x - y);
        scene.set_velocity(node, (turn * velocity).into());
    }
    for &point in body.points() {
        scene.set_temperature(point, 310.0);
    }
    (Simulation::new(scene, scheme, 0.02).unwrap(), body)
}

#[test]
fn a_rotated_copy_does_the_same() {
    let turn = Rotation3::new(Vector3::new(0.3, -1.2, 0.7));
    for scheme in [
        Scheme::EemEntropy,
        Scheme::EemTemperature,
        Scheme::EemDamped,
        Scheme::EemEntropy4,
        Scheme::Midpoint,
        Scheme::Trapezoidal,
    ] {
        let (mut one, body) = turned(&Rotation3::identity(), scheme);
        let (mut other, rotated) = turned(&turn, scheme);
        for _ in 0..at_length(20, 8) {
            one.step().unwrap();
            other.step().unwrap();
        }
        for (&a, &b) in body.nodes().iter().zip(rotated.nodes()) {
            let error = (turn * one.position(a).unwrap() - other.position(b).unwrap()).norm();
            assert!(error < 1e-13, "{scheme}: {error:e} m");
        }
        let mut largest = 0.0;
        for (&a, &b) in body.points().iter().zip(rotated.points()) {
            let strain = one.viscous_strain(a).unwrap();
            let strains = turn.matrix() * strain * turn.matrix().transpose();
            let error = (strains - other.viscous_strain(b).unwrap()).norm();
            assert!(error < 1e-13, "{scheme}: {error:e}");
            largest = strain.norm().max(largest);
            let heating = one.temperature(a).unwrap() - other.temperature(b).unwrap();
            assert!(heating.abs() < 1e-12, "{scheme}: {heating:e} K");
        }
        assert!(largest > 0.01, "{largest}");
    }
}

/// Its numbers are of any type.
#[derive(Clone, FreeEnergy)]
#[free_energy(|e2: StrainSquare, m3: ViscousStrain, m2: ViscousSquare, _m1: ViscousTrace| {
    shear * e2 + branch * (e2 - 2 * m3 + m2)
})]
#[viscosity(m3 = eta, _m1 = 3 * eta)]
struct Generic<T> {
    shear: T,
    branch: T,
    eta: T,
}

#[test]
fn models_with_a_scalar_of_their_own_flow() {
    let mut scene = Scene::<2>::new();
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let nodes = corners.map(|corner| scene.node(corner, [0.0; 2]));
    let material = Generic {
        shear: 100.0,
        branch: 200.0,
        eta: 40.0,
    };
    let section = Section {
        density: 10.0,
        thickness: 1.0,
    };
    let [point, ..] = scene.quadrilateral(material, nodes, section);
    for (node, [x, y]) in nodes.into_iter().zip(corners) {
        scene.set_position(node, [2.0 * x, y]);
        scene.fix(node);
    }
    let mut run = Simulation::new(scene, Scheme::EemEntropy, 4.0).unwrap();
    run.step().unwrap();
    // Γ¹ = h (10 dev(E − ½Γ¹) + (10/3) vol(E − ½Γ¹)): Γ¹ = 40/21 dev E + 40/23 vol E.
    let strain = run.viscous_strain(point).unwrap();
    let [first, others] = [40.0 / 21.0 + 20.0 / 23.0, 20.0 / 23.0 - 20.0 / 21.0];
    assert!((strain[(0, 0)] - first).abs() < 1e-14, "{strain}");
    assert!((strain[(1, 1)] - others).abs() < 1e-14, "{strain}");
    assert!((strain[(2, 2)] - others).abs() < 1e-14, "{strain}");
}

#[test]
fn the_description_has_roles_and_viscosities() {
    let description = Flowing::DESCRIPTION;
    let roles = description.arguments.iter().map(|argument| argument.role);
    let roles: Vec<_> = roles.collect();
    let [strains, flows] = [
        ["StrainTrace", "FibreStrain", "Dilatation", "StrainSquare"],
        ["ViscousTrace", "ViscousStrain", "ViscousSquare", "Viscous"],
    ];
    assert_eq!(roles[..4], strains);
    assert_eq!(roles[4..8], flows);
    let of = |symbol| description.equation(symbol).unwrap();
    assert_eq!(of("η_1"), "η_1 = eta_f");
    assert_eq!(of("η_3"), "η_3 = eta_v");
}

/// A cube that is free, with this initial viscous strain.
fn cube(strain: [[f64; 3]; 3]) -> (Simulation<3>, Body<Hex8, 3>) {
    let mut scene = Scene::<3>::new();
    let mesh = Mesh::block([1; 3], [[0.0, 1.0]; 3]).unwrap();
    let body = scene.solid(Relaxing::RUBBER, &mesh, &Bulk::new(10.0));
    for &point in body.points() {
        scene.set_temperature(point, 300.0);
        scene.set_viscous_strain(point, strain);
    }
    (
        Simulation::new(scene, Scheme::EemEntropy, 0.05).unwrap(),
        body,
    )
}

/// Without a volumetric viscosity the trace stays zero to rounding, whatever happens.
#[test]
fn the_viscous_strain_has_no_trace_without_a_viscosity_of_its_own() {
    let strain = [[0.3, 0.1, 0.0], [0.1, -0.1, 0.02], [0.0, 0.02, 0.1]];
    let (mut run, body) = cube(strain);
    let deviator = Matrix3::from(strain) - Matrix3::identity() * 0.1;
    let found = run.viscous_strain(body.points()[0]).unwrap();
    assert!((found - deviator).norm() < 1e-15, "{found}");
    for _ in 0..20 {
        run.step().unwrap();
        for &point in body.points() {
            let strain = run.viscous_strain(point).unwrap();
            assert!(strain.trace().abs() <= 4.0 * f64::EPSILON * strain.norm());
        }
    }
}

#[test]
fn a_solid_without_viscous_strain_says_so() {
    let mut scene = Scene::<3>::new();
    let mesh = Mesh::<Hex8, 3>::block([1; 3], [[0.0, 1.0]; 3]).unwrap();
    let elastic = SaintVenant {
        lame: 2.0,
        shear: 1.0,
    };
    let body = scene.solid(elastic.clone(), &mesh, &Bulk::new(10.0));
    let point = body.points()[0];
    let run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
    let error = run.viscous_strain(point).unwrap_err();
    assert_eq!(error, SolidError::NoViscousStrain { element: point }.into());

    let mut scene = Scene::<3>::new();
    let body = scene.solid(elastic, &mesh, &Bulk::new(10.0));
    scene.set_viscous_strain(body.points()[0], [[0.0; 3]; 3]);
    let refused = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap_err();
    let text = "element 0 (SaintVenantKirchhoff) has no viscous strain: its free energy has no `ViscousStrain`";
    assert!(refused.to_string().contains(text), "{refused}");
}

#[test]
fn what_is_no_viscous_strain_is_refused() {
    let slanted = [[0.0, 0.4, 0.0], [0.0; 3], [0.0; 3]];
    let out_of_plane = [[0.0, 0.0, 0.1], [0.0; 3], [0.1, 0.0, 0.0]];
    let mut scene = Scene::<2>::new();
    let mesh = Mesh::<Quad4, 2>::block([1; 2], [[0.0, 1.0]; 2]).unwrap();
    let points = scene
        .solid(
            Generic {
                shear: 1.0,
                branch: 1.0,
                eta: 1.0,
            },
            &mesh,
            &Bulk::new(10.0),
        )
        .points()
        .to_vec();
    scene.set_viscous_strain(points[0], slanted);
    scene.set_viscous_strain(points[1], out_of_plane);
    scene.set_viscous_stretch(points[2], 0, 0.1);
    let refused = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap_err();
    let texts: Vec<_> = refused.errors().iter().map(ToString::to_string).collect();
    let plane = "in plane strain with zeros between the plane and its normal";
    let name = |point| format!("element {point} (Generic)");
    assert_eq!(
        texts,
        [
            format!(
                "the viscous strain of {} has 0.4 in row 0, column 1 and 0 across the diagonal: it must be symmetric, {plane}",
                name(0)
            ),
            format!(
                "the viscous strain of {} has 0.1 in row 0, column 2 and 0.1 across the diagonal: it must be symmetric, {plane}",
                name(1)
            ),
            format!("{} has 0 dashpots, there is no dashpot 0", name(2)),
        ]
    );
}

#[test]
fn schemes_that_step_no_solids_refuse_it() {
    for scheme in Scheme::ALL {
        let mut scene = Scene::<3>::new();
        let mesh = Mesh::<Hex8, 3>::block([1; 3], [[0.0, 1.0]; 3]).unwrap();
        let body = scene.solid(Relaxing::RUBBER, &mesh, &Bulk::new(10.0));
        for &point in body.points() {
            scene.set_temperature(point, 300.0);
        }
        let elastic = {
            let mut scene = Scene::<3>::new();
            scene.solid(
                SaintVenant {
                    lame: 2.0,
                    shear: 1.0,
                },
                &mesh,
                &Bulk::new(10.0),
            );
            Simulation::new(scene, scheme, 0.1)
        };
        match (Simulation::new(scene, scheme, 0.1), elastic) {
            (Ok(mut run), Ok(_)) => {
                run.step().unwrap();
            }
            (Err(found), Err(known)) => assert_eq!(found.to_string(), known.to_string()),
            (found, known) => panic!("{scheme}: {found:?}, {known:?}"),
        }
    }
}

//! A block that is held in shear relaxes at the known rate, and what its stress loses is heat.

use eem::kinematics::{Hex8, Quad4, Shape};
use eem::nalgebra::{Matrix3, RowVector3};
use eem::prelude::*;
use eem::{Body, SolidState};
use eem_testkit::length::at_length;

use crate::support::solids::Relaxing;

/// With constant viscosity and branch. Γ̇ = 2 branch dev(E − Γ)/η has the time η/(2 branch) = 0.1 s.
const MATERIAL: Relaxing = Relaxing {
    softening: 0.0,
    expansion: 0.0,
    a: 0.0,
    ..Relaxing::RUBBER
};

/// s
const TIME: f64 = 0.1;

/// The deformation gradient in which it is held.
const HELD: [[f64; 3]; 3] = [[1.1, 0.3, 0.0], [0.0, 0.9, 0.0], [0.0, 0.0, 1.0]];

/// `E = ½(FᵀF − 1)`.
fn strain() -> Matrix3<f64> {
    let rows = HELD.map(RowVector3::from);
    let tensor = Matrix3::from_rows(&rows);
    (tensor.transpose() * tensor - Matrix3::identity()) * 0.5
}

fn deviator(tensor: Matrix3<f64>) -> Matrix3<f64> {
    tensor - Matrix3::identity() * (tensor.trace() / 3.0)
}

/// A cube or a square of 1 m whose nodes are fixed.
fn held<H: Shape<D>, const D: usize>(scheme: Scheme, step: f64) -> (Simulation<D>, Body<H, D>) {
    let mut scene = Scene::<D>::new();
    let mesh = Mesh::<H, D>::block([1; D], [[0.0, 1.0]; D]).unwrap();
    let body = scene.solid(MATERIAL, &mesh, &Bulk::new(10.0));
    for (&node, place) in body.nodes().iter().zip(mesh.nodes()) {
        let moved = |row: usize| (0..D).map(|axis| HELD[row][axis] * place[axis]).sum();
        scene.set_position(node, std::array::from_fn(moved));
        scene.fix(node);
    }
    for &point in body.points() {
        scene.set_temperature(point, 300.0);
    }
    (Simulation::new(scene, scheme, step).unwrap(), body)
}

/// The largest error of Γ and of the stress at five times up to the time of relaxation, as shares of
/// their first values.
fn errors(scheme: Scheme, steps: u32) -> [f64; 2] {
    let (mut run, body) = held::<Quad4, 2>(scheme, TIME / 5.0 / f64::from(steps));
    let point = body.points()[3];
    let driving = deviator(strain());
    let stress_of = |state: SolidState| state.stress;
    let glassy = stress_of(run.solid_state(point).unwrap());
    let tensor = Matrix3::from(HELD).transpose();
    // σ = F S Fᵀ/J; S of the branch at first.
    let branch = tensor * driving * tensor.transpose();
    let branch = branch * (2.0 * MATERIAL.branch / tensor.determinant());
    let mut worst = [0.0_f64; 2];
    for _ in 0..5 {
        for _ in 0..steps {
            run.step().unwrap();
        }
        let left = f64::exp(-run.time() / TIME);
        let flow = run.viscous_strain(point).unwrap() - driving * (1.0 - left);
        let stress = stress_of(run.solid_state(point).unwrap()) - glassy + branch * (1.0 - left);
        let shares = [flow.norm() / driving.norm(), stress.norm() / branch.norm()];
        worst = [worst[0].max(shares[0]), worst[1].max(shares[1])];
    }
    worst
}

#[test]
fn shear_relaxes_at_the_known_rate() {
    let schemes = [
        Scheme::EemEntropy,
        Scheme::EemTemperature,
        Scheme::Midpoint,
        Scheme::Trapezoidal,
        Scheme::MidpointTemperature,
        Scheme::TrapezoidalTemperature,
    ];
    for &scheme in at_length(&schemes[..], &schemes[..4]) {
        let [coarse, fine] = [10, 20].map(|steps| errors(scheme, steps));
        println!("{scheme}: {coarse:?} {fine:?}");
        for (coarse, fine) in coarse.into_iter().zip(fine) {
            // The implicit midpoint rule of an exponential: t h²/12 e⁻ᵗ, most at t = 1 in units of the time.
            let known = 0.02_f64.powi(2) / 12.0 * f64::exp(-1.0);
            assert!((coarse / known - 1.0).abs() < 1e-3, "{scheme}: {coarse:e}");
            assert!((f64::log2(coarse / fine) - 2.0).abs() < 1e-3);
        }
    }
}

/// `μ_v (E − Γ):(E − Γ)` per volume becomes heat, point by point; so do the laws say.
#[test]
fn what_the_branch_loses_is_heat() {
    for scheme in [Scheme::EemEntropy, Scheme::EemTemperature] {
        let (mut run, body) = held::<Hex8, 3>(scheme, 0.02);
        let first = run.ledger();
        let driving = deviator(strain());
        // At first G = 2 branch dev E, and w G:G/(η θ) is produced.
        let point = body.points()[0];
        let force = driving * (2.0 * MATERIAL.branch);
        let known = force.norm_squared() / (8.0 * MATERIAL.eta * 300.0);
        let found = run.entropy_production(point).unwrap();
        assert!((found / known - 1.0).abs() < 1e-13, "{found} {known}");
        for _ in 0..50 {
            run.step().unwrap();
        }
        let mut heat = 0.0;
        for &point in body.points() {
            let left = strain() - run.viscous_strain(point).unwrap();
            let lost = strain().norm_squared() - left.norm_squared();
            let heating = run.temperature(point).unwrap() - 300.0;
            let error = MATERIAL.capacity * heating - MATERIAL.branch * lost;
            // 300 K are rounded.
            let size = MATERIAL.capacity * 300.0;
            assert!(error.abs() <= 4.0 * f64::EPSILON * size, "{error:e}");
            heat += MATERIAL.capacity / 8.0 * heating;
        }
        // After ten times of relaxation nothing is left of the deviator.
        let all = MATERIAL.branch * driving.norm_squared();
        assert!((heat / all - 1.0).abs() < 1e-8, "{heat} {all}");
        let last = run.ledger();
        assert!((last.balance - first.balance).abs() <= 1e-15 * 100.0 * 300.0);
        assert!(last.entropy > first.entropy);
    }
}

/// In plane strain the viscous strain across the plane is the one of space.
#[test]
fn plane_strain_is_that_of_space() {
    let (mut space, cube) = held::<Hex8, 3>(Scheme::EemEntropy, 0.02);
    let (mut plane, square) = held::<Quad4, 2>(Scheme::EemEntropy, 0.02);
    for _ in 0..5 {
        space.step().unwrap();
        plane.step().unwrap();
    }
    let (one, other) = (cube.points()[0], square.points()[0]);
    let flows = [
        space.viscous_strain(one).unwrap(),
        plane.viscous_strain(other).unwrap(),
    ];
    assert!((flows[0] - flows[1]).norm() < 1e-15, "{flows:?}");
    assert!(flows[1][(2, 2)].abs() > 1e-3);
    let stresses = [
        space.solid_state(one).unwrap().stress,
        plane.solid_state(other).unwrap().stress,
    ];
    assert!((stresses[0] - stresses[1]).norm() < 1e-12 * stresses[0].norm());
}

//! Discrete gradients and tangents.

use eem::StrainEnergy;
use eem::kinematics::{Hex8, Quad4, Shape};
use eem::nalgebra::Matrix3;
use eem::prelude::*;
use eem_testkit::length::at_length;

use crate::support::numbers::Numbers;
use crate::support::solids::{Flowing, Relaxing};

/// Any of the invariants alone.
#[derive(Clone, FreeEnergy)]
#[free_energy(|e2: StrainSquare, m1: ViscousTrace, m2: ViscousSquare, m3: ViscousStrain| {
    k0 * e2 + k1 * m1 + k2 * m2 + k3 * m3
})]
#[viscosity(m3 = eta, m1 = eta)]
struct Linear {
    k0: f64,
    k1: f64,
    k2: f64,
    k3: f64,
    eta: f64,
}

/// `f_E:ΔE − g_Γ:ΔΓ = Δm` of each invariant m, to rounding of its terms.
#[test]
fn joint_invariants_have_exact_mean_value_gradients() {
    let mut numbers = Numbers(5);
    for trial in 0..300 {
        let mut k = [0.0; 3];
        k[trial % 3] = 1.0;
        let material = Linear {
            k0: 0.0,
            k1: k[0],
            k2: k[1],
            k3: k[2],
            eta: 1.0,
        };
        let energy = material.at_point();
        let size = [1.0, 1e-3, 1e-9][trial / 3 % 3];
        // e2, six components of E, six of Γ.
        let x0: [f64; 13] = std::array::from_fn(|_| numbers.next());
        let x1 = x0.map(|x| x + size * numbers.next());
        let old = energy.temperature_form_old(&x0);
        let (response, _) = energy.temperature_form(&old, &x1);
        let mut found = 0.0;
        for (place, conjugate) in response.iter().enumerate() {
            let sign = if place < 7 { 1.0 } else { -1.0 };
            found += sign * conjugate * (x1[place] - x0[place]);
        }
        let [before, after] = [&x0, &x1].map(|x| invariants(&x[1..])[trial % 3]);
        let change = after - before;
        let error = (found - change).abs();
        assert!(error <= 8.0 * f64::EPSILON * 12.0, "{trial}: {error:e}");
    }
}

/// tr Γ, Γ:Γ and E:Γ from components.
fn invariants(x: &[f64]) -> [f64; 3] {
    let (strain, viscous) = x.split_at(6);
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    [
        f64::sqrt(3.0) * viscous[5],
        dot(viscous, viscous),
        dot(strain, viscous),
    ]
}

/// One cell with every quantity somewhere in between.
fn cell<H, M, const N: usize, const D: usize>(
    (material, bulk): (&M, &Bulk<D>),
    scheme: Scheme,
) -> Simulation<D>
where
    H: Shape<D>,
    M: FreeEnergy<f64> + StrainEnergy<N> + Clone + Send + Sync + 'static,
{
    let mut numbers = Numbers(9);
    let mesh = Mesh::<H, D>::block([1; D], [[0.0, 1.0]; D]).unwrap();
    let mut scene = Scene::<D>::new();
    let body = scene.solid(material.clone(), &mesh, bulk);
    for (&node, place) in body.nodes().iter().zip(mesh.nodes()) {
        scene.set_position(node, place.map(|at| at + 0.1 * numbers.next()));
        scene.set_velocity(node, [(); D].map(|()| numbers.next()));
    }
    for &point in body.points() {
        scene.set_temperature(point, 300.0 + 10.0 * numbers.next());
        let mut strain = Matrix3::from_fn(|_, _| 0.1 * numbers.next());
        if D == 2 {
            strain.fill_row(2, 0.0);
            strain[(2, 2)] = 0.1 * numbers.next();
            strain.column_mut(2).rows_mut(0, 2).fill(0.0);
        }
        let symmetric = strain + strain.transpose();
        scene.set_viscous_strain(point, symmetric.into());
    }
    Simulation::new(scene, scheme, 0.3).unwrap()
}

/// The tangent of a step of a whole cell against differences of eighth order, whose error at a width of 0.02
/// is below that of rounding.
fn tangent_is_exact<H, M, const N: usize, const D: usize>(parts: (&M, &Bulk<D>), scheme: Scheme)
where
    H: Shape<D>,
    M: FreeEnergy<f64> + StrainEnergy<N> + Clone + Send + Sync + 'static,
{
    let mut numbers = Numbers(4);
    let mut run = cell::<H, M, N, D>(parts, scheme);
    let count = run.unknowns();
    let at: Vec<f64> = (0..count).map(|_| 0.05 * numbers.next()).collect();
    assert_eq!(count, H::NODES.len() * D);
    let tangent = run.linearize(&at).unwrap().tangent;
    let weights = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    let width = 5e-3;
    let (mut largest, mut worst) = (0.0_f64, 0.0_f64);
    // Fewer of a hexahedron, of all axes.
    for column in (0..count).step_by(at_length(1, if D == 3 { 5 } else { 1 })) {
        let mut derivative = vec![0.0; count];
        for (k, weight) in (1..).zip(weights) {
            for sign in [1.0, -1.0] {
                let mut moved = at.clone();
                moved[column] += sign * width * f64::from(k);
                let residual = run.linearize(&moved).unwrap().residual;
                for (sum, entry) in derivative.iter_mut().zip(residual) {
                    *sum += sign * weight * entry / width;
                }
            }
        }
        for (row, known) in derivative.iter().enumerate() {
            largest = largest.max(known.abs());
            worst = worst.max((tangent[row * count + column] - known).abs());
        }
    }
    println!("{} {scheme}: {:e}", H::NAME, worst / largest);
    assert!(worst <= 1e-12 * largest, "{scheme}: {:e}", worst / largest);
}

#[test]
fn tangents_of_whole_cells_are_derivatives() {
    for scheme in [
        Scheme::EemEntropy,
        Scheme::EemTemperature,
        Scheme::Midpoint,
        Scheme::Trapezoidal,
    ] {
        let bulk = Bulk::new(10.0);
        tangent_is_exact::<Quad4, _, 7, 2>((&Relaxing::RUBBER, &bulk), scheme);
        let bulk = bulk.fibre([0.6, 0.8]);
        tangent_is_exact::<Quad4, _, 10, 2>((&Flowing::RUBBER, &bulk), scheme);
    }
    let both = [Scheme::EemEntropy, Scheme::EemTemperature];
    for &scheme in at_length(&both[..], &both[..1]) {
        let bulk = Bulk::new(10.0).fibre([0.6, 0.8, 0.0]);
        tangent_is_exact::<Hex8, _, 10, 3>((&Flowing::RUBBER, &bulk), scheme);
    }
}

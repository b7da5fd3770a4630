//! Solids of texts: with dashpots, and with a viscous strain.

use eem::StrainEnergy;
use eem::kinematics::Quad4;
use eem::prelude::*;
use eem::typed::{Source, solid};

use super::{Built, assert_same_bits, law};
use crate::support::solids::{Flowing, Viscous};

fn viscous(model: &Viscous) -> solid!(strains: 2, dashpots: 1, temperature: 1) {
    let source = Source::new(
        "|e1: StrainTrace, e2: StrainSquare, gamma: Viscous, theta: Temperature| {
            let heating = theta - theta_ref;
            0.5 * lame * e1.powi(2) + shear * e2 + 0.5 * relaxing * (e1 - gamma).powi(2)
                - expansion * heating * e1
                + capacity * (heating - theta * ln(theta / theta_ref))
        }",
    )
    .viscosity("gamma", "eta * exp(a / theta - a / theta_ref)");
    let fields = law!(
        model,
        source,
        [
            lame, shear, relaxing, expansion, capacity, eta, a, theta_ref
        ]
    );
    fields.named("Viscous").unwrap().model().unwrap()
}

/// The shape, the volume and a fibre flow; measures are mentioned in no order.
fn flowing(
    model: &Flowing,
) -> solid!(strains: 4, invariants: 3, volume_flow: 1, dashpots: 1, temperature: 1) {
    let source = Source::new(
        "|e1: StrainTrace, fibre: Viscous, m1: ViscousTrace, e4: FibreStrain, m3: ViscousStrain,
            j: Dilatation, e2: StrainSquare, theta: Temperature, m2: ViscousSquare| {
            let heating = theta - theta_ref;
            let difference = e2 - 2 * m3 + m2;
            shear * e2 + 0.5 * lame * ln_1p(j).powi(2) + kf * (e4 - fibre).powi(2)
                + (branch - softening * heating) * difference * (1 + difference)
                + 0.5 * bulk * (e1 - m1).powi(2)
                - expansion * heating * ln_1p(j)
                + capacity * (heating - theta * ln(theta / theta_ref))
        }",
    )
    .viscosity("m1", "eta_v")
    .viscosity("m3", "eta * exp(a / theta - a / theta_ref)")
    .viscosity("fibre", "eta_f");
    let fields = law!(
        model,
        source,
        [
            lame, shear, branch, softening, bulk, kf, expansion, capacity, eta, eta_v, eta_f, a,
            theta_ref
        ]
    );
    fields.named("Flowing").unwrap().model().unwrap()
}

/// Two warm cells that tumble, are stretched, and lose heat.
fn plate<M, const N: usize>(material: M, bulk: &Bulk<2>) -> Built<2>
where
    M: eem::Material + StrainEnergy<N>,
{
    let mut scene = Scene::new();
    let mesh = Mesh::<Quad4, 2>::block([2, 1], [[0.0, 2.0], [0.0, 1.0]]).unwrap();
    let body = scene.solid(material, &mesh, bulk);
    for (&node, &[x, y]) in body.nodes().iter().zip(mesh.nodes()) {
        scene.set_velocity(node, [0.3 * x * y - 2.0 * y, 2.0 * x + 0.4 * y]);
    }
    for &point in body.points() {
        scene.set_temperature(point, 310.0);
    }
    let air = scene.reservoir(300.0);
    scene.conduct(body.points()[0], air, 10.0);
    (scene, body.nodes().to_vec(), body.points().to_vec())
}

const SCHEMES: [Scheme; 6] = [
    Scheme::EemEntropy,
    Scheme::EemTemperature,
    Scheme::EemEntropy4,
    Scheme::Staggered,
    Scheme::Midpoint,
    Scheme::Trapezoidal,
];

#[test]
fn solids_of_texts_have_the_bits_of_derived_ones() {
    let bulk = Bulk::new(10.0);
    let typed = plate(viscous(&Viscous::RUBBER), &bulk);
    let derived = plate(Viscous::RUBBER, &bulk);
    assert_same_bits([&derived, &typed], SCHEMES, (20, 0.02));
}

#[test]
fn solids_of_texts_flow_with_the_bits_of_derived_ones() {
    let bulk = Bulk::new(10.0).fibre([0.6, 0.8]);
    let typed = plate(flowing(&Flowing::RUBBER), &bulk);
    let derived = plate(Flowing::RUBBER, &bulk);
    assert_same_bits([&derived, &typed], SCHEMES, (20, 0.02));
}

#[test]
fn a_solid_of_texts_knows_its_strains() {
    let rubber = flowing(&Flowing::RUBBER);
    assert_eq!(
        rubber.strains()[..4],
        <Flowing as StrainEnergy<10>>::STRAINS[..4]
    );
    // The fibre has no direction.
    let (scene, ..) = plate(rubber, &Bulk::new(10.0));
    let refused = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap_err();
    assert!(refused.to_string().contains("(Flowing)"), "{refused}");
    assert!(refused.to_string().contains("fibre"), "{refused}");
}

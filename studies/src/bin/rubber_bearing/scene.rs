//! The bearing: rubber between two plates, the upper of which is shaken.

use core::f64::consts::TAU;
use std::error::Error;

use eem::Body;
use eem::kinematics::Quad8;
use eem::prelude::*;

/// Step and end time, s: 20 cycles of 40 steps.
pub(crate) const STEP: f64 = 0.025;
pub(crate) const END: f64 = 20.0;

/// Cycles per second, and the displacement of the upper plate, m.
pub(crate) const FREQUENCY: f64 = 1.0;
const AMPLITUDE: f64 = 0.1;

/// Width, height and length of the rubber, m.
const WIDTH: f64 = 0.4;
pub(crate) const HEIGHT: f64 = 0.1;
const LENGTH: f64 = 0.4;

/// Volume, m³.
pub(crate) const VOLUME: f64 = WIDTH * HEIGHT * LENGTH;

/// Density (kg/m³) and conductivity (W/(m K)) of the rubber, and the film between it and the air (W/(m² K)).
const DENSITY: f64 = 1100.0;
const CONDUCTIVITY: f64 = 0.25;
const FILM: f64 = 10.0;

/// Of everything at t = 0, and of plates and air, K.
pub(crate) const TEMPERATURE: f64 = 293.15;

/// Rubber whose shear stress relaxes: a spring, nearly incompressible, beside a branch that creeps. Both creep
/// and stiffness of the branch depend on temperature.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|e1: StrainTrace, e2: StrainSquare, j: Dilatation, m3: ViscousStrain, m2: ViscousSquare, theta: Temperature| {
    let heating = theta - theta_ref;
    let growth = ln_1p(j);
    shear * (e1 - growth) + 0.5 * lame * growth.powi(2)
        + (branch - softening * heating) * (e2 - 2 * m3 + m2)
        - 3 * expansion * bulk * heating * growth
        + capacity * (heating - theta * ln(theta / theta_ref))
})]
#[viscosity(m3 = viscosity * exp(activation / theta - activation / theta_ref))]
pub(crate) struct Rubber {
    #[unit("Pa")]
    shear: f64,
    #[unit("Pa")]
    lame: f64,
    #[unit("Pa")]
    branch: f64,
    #[unit("Pa/K")]
    softening: f64,
    #[unit("1/K")]
    expansion: f64,
    #[unit("Pa")]
    bulk: f64,
    #[unit("J/(K m^3)")]
    pub(crate) capacity: f64,
    #[unit("Pa s")]
    viscosity: f64,
    #[unit("K")]
    activation: f64,
    #[unit("K")]
    theta_ref: f64,
}

pub(crate) const RUBBER: Rubber = Rubber {
    shear: 4e5,
    lame: 2e7,
    branch: 6e5,
    softening: 3e3,
    expansion: 2e-4,
    bulk: 2e7,
    capacity: 2e6,
    viscosity: 1.2e5,
    activation: 3000.0,
    theta_ref: TEMPERATURE,
};

/// The scene, the rubber in it, and a node that the upper plate moves.
pub(crate) struct Bearing {
    pub(crate) scene: Scene<2>,
    pub(crate) rubber: Body<Quad8, 2>,
    pub(crate) plate: Node,
}

/// The bearing at rest, as warm as what is around it.
pub(crate) fn bearing() -> Result<Bearing, Box<dyn Error>> {
    let mesh = Mesh::<Quad8, 2>::block([8, 2], [[0.0, WIDTH], [0.0, HEIGHT]])?;
    let bulk = Bulk::new(DENSITY)
        .thickness(LENGTH)
        .conductivity(CONDUCTIVITY)
        .lumped();
    let mut scene = Scene::<2>::new();
    let rubber = scene.solid(RUBBER, &mesh, &bulk);
    for &point in rubber.points() {
        scene.set_temperature(point, TEMPERATURE);
    }
    for (&node, &[x, z]) in rubber.nodes().iter().zip(mesh.nodes()) {
        let is_upper = z >= HEIGHT;
        if is_upper || z <= 0.0 {
            scene.fix(node);
        }
        if is_upper {
            scene.move_anchor(node, move |t| [x + displacement(t), z]);
        }
    }
    let surroundings = scene.reservoir(TEMPERATURE);
    let plates = mesh.face(|[_, z]| z <= 0.0 || z >= HEIGHT)?;
    scene.wall(&rubber, &plates, surroundings);
    let sides = mesh.face(|[x, _]| x <= 0.0 || x >= WIDTH)?;
    scene.exchange(&rubber, &sides, surroundings, FILM);
    let plate = rubber.node_at([0.0, HEIGHT], 0.0)?;
    Ok(Bearing {
        scene,
        rubber,
        plate,
    })
}

/// Of the upper plate, m: it starts without a jump of its velocity.
fn displacement(t: f64) -> f64 {
    let start = (FREQUENCY * t).min(1.0);
    AMPLITUDE * start * start * (TAU * FREQUENCY * t).sin()
}

//! The solver, compiled for models that several test programs use.
//!
//! These functions are never called. In the debug profile, programs reuse the generic code that is compiled here.

use eem::kinematics::{Hex8, Hex20, Quad4, Quad8};
use eem::materials::{Hencky, LogarithmicStiffness, SaintVenantKirchhoff, ThermoelasticSolid};
use eem::prelude::*;

use crate::scenes::dashpots::{ThreeDashpots, TwoDashpots};
use crate::scenes::solids::{MooneyRivlin, Reinforced, Relaxing};
use crate::scenes::springs::{Braked, Branched};

const HENCKY: Hencky = Hencky {
    stiffness: 1.0,
    natural_length: 1.0,
};
const ELASTIC: SaintVenantKirchhoff = SaintVenantKirchhoff {
    lame: 1.0,
    shear: 1.0,
};

const BRANCHED: Branched = Branched {
    k: 1.0,
    mu: 1.0,
    eta: 1.0,
    length: 1.0,
};
const BRAKED: Braked = Braked {
    k: 1.0,
    eta: 1.0,
    length: 1.0,
};

/// Models of springs on a line.
pub fn line(
    mut scene: Scene<1>,
    ends: [Node; 2],
) -> Result<StepReport, Box<dyn std::error::Error>> {
    scene.spring(BRANCHED, ends);
    scene.spring(BRAKED, ends);
    Ok(Simulation::new(scene, Scheme::EemEntropy, 1.0)?.step()?)
}

/// Models of springs and solids in the plane.
pub fn plane(
    mut scene: Scene<2>,
    ends: [Node; 2],
) -> Result<StepReport, Box<dyn std::error::Error>> {
    scene.spring(HENCKY, ends);
    scene.spring(LogarithmicStiffness::FIRST, ends);
    scene.spring(BRANCHED, ends);
    scene.spring(BRAKED, ends);
    scene.spring(TwoDashpots::DATA, ends);
    scene.spring(ThreeDashpots::DATA, ends);
    let linear = Mesh::<Quad4, 2>::block([1; 2], [[0.0, 1.0]; 2])?;
    scene.solid(ELASTIC, &linear, &Bulk::new(1.0));
    scene.solid(ThermoelasticSolid::RUBBER, &linear, &Bulk::new(1.0));
    scene.solid(Relaxing::RUBBER, &linear, &Bulk::new(1.0));
    let quadratic = Mesh::<Quad8, 2>::block([1; 2], [[0.0, 1.0]; 2])?;
    scene.solid(ELASTIC, &quadratic, &Bulk::new(1.0));
    Ok(Simulation::new(scene, Scheme::EemEntropy, 1.0)?.step()?)
}

/// Models of springs and solids in space.
pub fn space(
    mut scene: Scene<3>,
    ends: [Node; 2],
) -> Result<StepReport, Box<dyn std::error::Error>> {
    scene.spring(HENCKY, ends);
    let linear = Mesh::<Hex8, 3>::block([1; 3], [[0.0, 1.0]; 3])?;
    scene.solid(ELASTIC, &linear, &Bulk::new(1.0));
    scene.solid(ThermoelasticSolid::RUBBER, &linear, &Bulk::new(1.0));
    scene.solid(MooneyRivlin::RUBBER, &linear, &Bulk::new(1.0));
    scene.solid(Reinforced::RUBBER, &linear, &Bulk::new(1.0));
    let quadratic = Mesh::<Hex20, 3>::block([1; 3], [[0.0, 1.0]; 3])?;
    scene.solid(ELASTIC, &quadratic, &Bulk::new(1.0));
    Ok(Simulation::new(scene, Scheme::EemEntropy, 1.0)?.step()?)
}

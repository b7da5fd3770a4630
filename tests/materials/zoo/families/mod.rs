//! All specimens, by family.

mod bonds;
mod dashpots;
mod functions;
mod gases;
mod heat;
mod helpers;
mod memory;
mod published;
mod rubber;
mod solids;
pub(crate) mod springs;

use crate::zoo::specimen::{Formula, Specimen};

/// The examples of these models.
macro_rules! examples {
    ($($model:path),* $(,)?) => {
        vec![$(Box::new(<$model>::example()) as Box<dyn Specimen>),*]
    };
}

/// The whole zoo.
pub(crate) fn all() -> Vec<Box<dyn Specimen>> {
    examples![
        published::ThermoViscoElastic,
        published::ConstantStiffness,
        published::LogarithmicStiffness,
        springs::Linear,
        springs::Hencky,
        springs::Duffing,
        springs::GreenLagrange,
        springs::FermiPastaUlam,
        springs::Toda,
        springs::Corrugated,
        springs::Inclined,
        springs::Thermoelastic,
        springs::Softening,
        bonds::Morse,
        bonds::LennardJones,
        bonds::Mie,
        bonds::Fene,
        bonds::KremerGrest,
        bonds::Buckingham,
        bonds::BornMayer,
        bonds::WormLikeChain,
        bonds::TwoState,
        rubber::NeoHookean,
        rubber::MooneyRivlin,
        rubber::Ogden,
        rubber::Gent,
        rubber::Yeoh,
        rubber::ArrudaBoyce,
        rubber::Entropic,
        rubber::EntropicGent,
        rubber::FreelyJointed,
        gases::Ideal,
        gases::VanDerWaals,
        gases::RedlichKwong,
        gases::SquareWell,
        gases::Photons,
        heat::Power,
        heat::Polynomial,
        heat::Metal,
        heat::Einstein,
        heat::ThreeModes,
        heat::Saturating,
        heat::Schottky,
        memory::Falk,
        memory::TwoPhases,
        memory::GlassTransition,
        helpers::Branches,
        helpers::Periodic,
        functions::Powers,
        functions::Every,
        dashpots::Maxwell,
        dashpots::Zener,
        dashpots::Burgers,
        dashpots::TwoBranches,
        dashpots::ThreeBranches,
        dashpots::Logarithmic,
        dashpots::ViscousRubber,
        dashpots::AirSpring,
        solids::FibreReinforced,
        solids::SaintVenantKirchhoff,
        solids::CompressibleMooneyRivlin,
        solids::Compressible,
        solids::ThermoelasticSolid,
        solids::Coupled,
        solids::Viscoelastic,
        solids::Flowing,
    ]
}

//! Scenes in space.

use eem_studies::build::Build;
use eem_studies::models::Elastic;
use eem_studies::pendulums::{Double, LOGARITHMIC, SPRING};

use crate::matrix::Entry;
use crate::watch::{Case, Drive};

#[derive(Clone, Copy)]
pub(crate) enum Spatial {
    Romero,
    Krueger,
    Log,
    FreePair,
    FreeLine,
    Tetrahedron,
}

const fn entry(name: &'static str, case: Spatial, step: f64, drive: Drive) -> Entry<Spatial> {
    Entry {
        name,
        case,
        step,
        drive,
    }
}

pub(crate) const SPATIAL: [Entry<Spatial>; 7] = [
    entry("romero", Spatial::Romero, 0.3, Drive::Steps(30)),
    entry("krueger", Spatial::Krueger, 0.1, Drive::Steps(30)),
    entry("log", Spatial::Log, 0.05, Drive::Steps(30)),
    entry("free-pair-3d", Spatial::FreePair, 0.05, Drive::Steps(50)),
    entry("free-line-3d", Spatial::FreeLine, 0.02, Drive::Steps(30)),
    entry("tetrahedron", Spatial::Tetrahedron, 0.02, Drive::Steps(20)),
    entry(
        "control-3d",
        Spatial::FreePair,
        0.05,
        Drive::Controlled(1e-3, 20),
    ),
];

const HOOKE: Elastic = Elastic {
    stiffness: 100.0,
    length: 1.0,
};

impl Case<3> for Spatial {
    fn build(self) -> Build<3> {
        let mut build = Build::new();
        let scene = &mut build;
        match self {
            Self::Romero => return Double::ROMERO.build(),
            Self::Krueger => return Double::KRUEGER.build(),
            Self::Log => return Double::LOG.build(),
            Self::FreePair => {
                let ends = [
                    scene.mass(1.0, [0.1, 0.2, 0.3], [0.5, -1.0, 0.2]),
                    scene.mass(3.0, [1.1, 0.5, -0.2], [-0.5, 2.0, 1.0]),
                ];
                scene.spring(HOOKE, ends);
            }
            Self::FreeLine => {
                let masses =
                    [0.0, 1.0, 2.1].map(|x| scene.mass(1.0 + x, [x, 0.0, 0.0], [0.1, x, 1.0 - x]));
                scene.spring(HOOKE, [masses[0], masses[1]]);
                scene.warm(SPRING, [masses[1], masses[2]], 310.0);
            }
            Self::Tetrahedron => tetrahedron(scene),
        }
        build
    }
}

/// Four free masses and six springs of three kinds, two of them in contact.
fn tetrahedron(scene: &mut Build<3>) {
    let places = [
        [1.1, 0.0, 0.0],
        [-0.5, 0.9, 0.0],
        [-0.5, -0.9, 0.1],
        [0.1, 0.0, 1.3],
    ];
    let velocities = [
        [0.0, 0.5, 0.1],
        [-0.4, -0.2, 0.0],
        [0.4, -0.1, -0.2],
        [0.1, 0.0, 0.3],
    ];
    let masses = [1.0, 2.0, 1.5, 0.5];
    let [a, b, c, d] = [0, 1, 2, 3].map(|i| scene.mass(masses[i], places[i], velocities[i]));
    let first = scene.warm(LOGARITHMIC, [a, b], 300.0);
    let second = scene.warm(SPRING, [b, c], 310.0);
    scene.conduct(first, second, 10.0);
    scene.warm(SPRING, [c, a], 290.0);
    for ends in [[a, d], [b, d], [c, d]] {
        scene.spring(HOOKE, ends);
    }
}

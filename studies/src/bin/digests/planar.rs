//! Scenes in the plane.

use eem::Scalar;
use eem::prelude::*;
use eem_studies::build::Build;
use eem_studies::models::{Elastic, Thermoelastic, TwoDashpots, Voigt};
use eem_studies::pendulums::{LOGARITHMIC, SPRING, single};

use crate::matrix::Entry;
use crate::watch::{Case, Drive};

#[derive(Clone, Copy)]
pub(crate) enum Planar {
    Elastic,
    Thermoelastic,
    Creeping,
    Single,
    TwoDashpots,
    Voigt,
    Gravity,
    Loads,
    Thermostat,
    MovedAnchor,
    FreePair,
    FreeTriangle,
    Chain,
    LongChain,
    Rockets,
}

const fn entry(name: &'static str, case: Planar, step: f64, drive: Drive) -> Entry<Planar> {
    Entry {
        name,
        case,
        step,
        drive,
    }
}

pub(crate) const PLANAR: [Entry<Planar>; 18] = [
    entry("elastic", Planar::Elastic, 0.05, Drive::Steps(50)),
    entry(
        "thermoelastic",
        Planar::Thermoelastic,
        0.02,
        Drive::Steps(50),
    ),
    entry("creeping", Planar::Creeping, 0.02, Drive::Steps(50)),
    entry("single", Planar::Single, 0.2, Drive::Steps(50)),
    entry("single-fine", Planar::Single, 0.02, Drive::Steps(50)),
    entry("two-dashpots", Planar::TwoDashpots, 0.02, Drive::Steps(50)),
    entry("voigt", Planar::Voigt, 0.02, Drive::Steps(50)),
    entry("gravity", Planar::Gravity, 0.02, Drive::Steps(50)),
    entry("loads", Planar::Loads, 0.02, Drive::Steps(50)),
    entry("thermostat", Planar::Thermostat, 0.02, Drive::Steps(50)),
    entry("moved-anchor", Planar::MovedAnchor, 0.02, Drive::Steps(50)),
    entry("free-pair", Planar::FreePair, 0.02, Drive::Steps(50)),
    entry(
        "free-triangle",
        Planar::FreeTriangle,
        0.02,
        Drive::Steps(50),
    ),
    entry("chain", Planar::Chain, 0.02, Drive::Steps(10)),
    entry("rockets", Planar::Rockets, 0.05, Drive::Steps(30)),
    entry("control", Planar::Single, 0.05, Drive::Controlled(1e-4, 20)),
    entry(
        "control-free",
        Planar::FreePair,
        0.05,
        Drive::Controlled(1e-4, 20),
    ),
    entry("event", Planar::Single, 0.05, Drive::Event(2.0)),
];

/// With sparse elimination.
pub(crate) const LARGE: [Entry<Planar>; 1] = [entry(
    "long-chain",
    Planar::LongChain,
    0.01,
    Drive::Steps(2),
)];

impl Case<2> for Planar {
    fn build(self) -> Build<2> {
        let mut build = Build::new();
        let scene = &mut build;
        match self {
            Self::Single => return single(),
            Self::Elastic => {
                let ends = pendulum(scene);
                scene.spring(ELASTIC, ends);
            }
            Self::Thermoelastic => {
                let ends = pendulum(scene);
                scene.warm(THERMOELASTIC, ends, 380.0);
            }
            Self::Creeping => {
                let ends = pendulum(scene);
                scene.warm(SPRING, ends, 380.0);
            }
            Self::TwoDashpots => {
                let ends = pendulum(scene);
                scene.spring(TWO_DASHPOTS, ends);
            }
            Self::Voigt => {
                let ends = pendulum(scene);
                let spring = scene.warm(VOIGT, ends, 320.0);
                let air = scene.reservoir(300.0);
                scene.conduct(spring, air, 3.0);
            }
            Self::Gravity => {
                for ends in row(scene, 3, 1.1) {
                    scene.spring(ELASTIC, ends);
                }
                scene.scene.set_gravity([1.0, -9.81]);
            }
            Self::Loads => loads(scene),
            Self::Thermostat => thermostat(scene),
            Self::MovedAnchor => moved_anchor(scene),
            Self::FreePair => free_pair(scene),
            Self::FreeTriangle => {
                triangle(scene);
            }
            Self::Rockets => {
                let [first, second, third] = triangle(scene);
                let thrust = |time: f64| 4.0 * Scalar::cos(2.0 * time);
                scene.scene.rocket(first, [second, third], thrust);
                scene.scene.rocket(third, [third, first], |_| 2.5);
            }
            Self::Chain => chain(scene, 12),
            Self::LongChain => chain(scene, 600),
        }
        build
    }
}

const ELASTIC: Elastic = Elastic {
    stiffness: 100.0,
    length: 1.0,
};
const THERMOELASTIC: Thermoelastic = Thermoelastic {
    stiffness: 100.0,
    softening: 0.1,
    coupling: 4.0,
    capacity: 2.0,
    length: 1.0,
    theta_ref: 300.0,
};
const TWO_DASHPOTS: TwoDashpots = TwoDashpots {
    stiffness: 40.0,
    length: 1.0,
    eta: 5.0,
};
const VOIGT: Voigt = Voigt {
    stiffness: 60.0,
    length: 1.0,
    coupling: 0.1,
    capacity: 2.0,
    theta_ref: 300.0,
    eta: 1.5,
    activation: 800.0,
};
/// The ends of the spring of a pendulum that swings.
fn pendulum(scene: &mut Build<2>) -> [Node; 2] {
    let pivot = scene.anchor([0.0, 0.0]);
    [pivot, scene.mass(1.0, [1.5, 0.2], [0.2, 1.0])]
}

/// An anchor and masses in a row, so many metres apart: the ends of springs between them.
fn row(scene: &mut Build<2>, masses: u32, distance: f64) -> Vec<[Node; 2]> {
    let mut last = scene.anchor([0.0, 0.0]);
    (1..=masses)
        .map(|index| {
            let x = distance * f64::from(index);
            let mass = scene.mass(1.0, [x, 0.0], [0.1 * Scalar::sin(x), Scalar::cos(x)]);
            [std::mem::replace(&mut last, mass), mass]
        })
        .collect()
}

/// A constant force, and one that changes in time.
fn loads(scene: &mut Build<2>) {
    let ends = row(scene, 2, 1.1);
    for &ends in &ends {
        scene.warm(SPRING, ends, 320.0);
    }
    let [first, last] = ends[1];
    scene.scene.dead_load(last, [3.0, -2.0]);
    let force = |time: f64| [Scalar::sin(5.0 * time), 1.0];
    scene.scene.force(first, force);
}

/// One spring is kept at a temperature, and warms the other.
fn thermostat(scene: &mut Build<2>) {
    let springs: Vec<_> = row(scene, 2, 1.1)
        .into_iter()
        .map(|ends| scene.warm(THERMOELASTIC, ends, 300.0))
        .collect();
    scene.conduct(springs[0], springs[1], 5.0);
    let rising = |time: f64| 300.0 + 20.0 * time;
    scene.scene.prescribe_temperature(springs[1], rising);
}

/// A pendulum on a pivot that is shaken.
fn moved_anchor(scene: &mut Build<2>) {
    let ends = pendulum(scene);
    scene.warm(SPRING, ends, 310.0);
    let motion = |time: f64| [0.1 * Scalar::sin(3.0 * time), 0.0];
    scene.scene.move_anchor(ends[0], motion);
}

/// Two masses that fly and turn.
fn free_pair(scene: &mut Build<2>) {
    let ends = [
        scene.mass(1.0, [0.1, 0.2], [0.5, -1.0]),
        scene.mass(3.0, [1.1, 0.5], [-0.5, 2.0]),
    ];
    scene.warm(THERMOELASTIC, ends, 320.0);
}

/// A free triangle of springs of different kinds.
fn triangle(scene: &mut Build<2>) -> [Node; 3] {
    let places = [[0.0, 0.0], [1.3, 0.1], [0.4, 1.1]];
    let velocities = [[0.2, 0.0], [0.1, 0.6], [-0.4, 0.1]];
    let [a, b, c] = [0, 1, 2].map(|i| scene.mass(1.5, places[i], velocities[i]));
    scene.spring(ELASTIC, [a, b]);
    let warm = scene.warm(SPRING, [b, c], 320.0);
    let other = scene.warm(THERMOELASTIC, [c, a], 290.0);
    scene.conduct(warm, other, 5.0);
    [a, b, c]
}

/// Springs in a row, each in contact with the next.
fn chain(scene: &mut Build<2>, springs: u32) {
    let mut before = None;
    for (ends, warmth) in row(scene, springs, 2.0).into_iter().zip((0..7).cycle()) {
        let spring = scene.warm(LOGARITHMIC, ends, 300.0 + f64::from(warmth));
        if let Some(before) = before.replace(spring) {
            scene.conduct(before, spring, 10.0);
        }
    }
}

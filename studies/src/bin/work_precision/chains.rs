//! Chains of springs that hang on one end: one of equal springs, one of soft and stiff springs by turns.

use eem::prelude::*;

use super::double_pendulum::ThermoelasticSpring;
use super::single_pendulum::SPRING;

/// Springs of the chain of equal ones, and of the one of soft and stiff ones.
const EQUAL: u32 = 16;
const BY_TURNS: u32 = 12;

/// Acceleration of free fall, m/s².
const GRAVITY: f64 = 9.81;

/// Of each node, kg.
const MASS: f64 = 1.0;

/// Between springs that share a node, W/K.
const CONDUCTANCE: f64 = 10.0;

/// The soft spring of the case krueger, and how much stiffer the others are.
const SOFT: ThermoelasticSpring = ThermoelasticSpring {
    natural_length: 1.0,
    ..super::double_pendulum::KRUEGER.springs[0]
};
const RATIO: f64 = 1e4;

/// A wave in which neighbours differ, of the order of one.
fn wave(index: u32, phase: f64) -> f64 {
    (0.7 * f64::from(index) + phase).sin()
}

/// Springs of 1 m along a line below the first node, whose nodes move sideways.
fn hanging<M>(springs: u32, model: impl Fn(u32) -> (M, f64)) -> Scene<2>
where
    M: FreeEnergy<f64> + Send + Sync + 'static,
{
    let mut scene = Scene::new();
    scene.set_gravity([0.0, -GRAVITY]);
    let mut last = scene.anchor([0.0, 0.0]);
    let mut above = None;
    for index in 1..=springs {
        let next = scene.mass(MASS, [0.0, -f64::from(index)], [wave(index, 0.0), 0.0]);
        let (model, temperature) = model(index);
        let spring = scene.spring(model, [last, next]);
        scene.set_temperature(spring, temperature);
        if let Some(above) = above.replace(spring) {
            scene.conduct(above, spring, CONDUCTANCE);
        }
        last = next;
    }
    scene
}

/// Thermo-visco-elastic springs, warm and cold ones in waves.
pub(crate) fn soft() -> Scene<2> {
    hanging(EQUAL, |index| {
        let temperature = SPRING.theta_ref + 10.0 * wave(index, 1.0);
        (SPRING, temperature)
    })
}

/// Thermoelastic springs at the reference temperature, every other one stiff: vibrations of 2 rad/ms that are
/// hardly excited, beside a slow motion.
pub(crate) fn stiff() -> Scene<2> {
    hanging(BY_TURNS, |index| {
        let ratio = if index % 2 == 0 { RATIO } else { 1.0 };
        let spring = ThermoelasticSpring {
            stiffness: ratio * SOFT.stiffness,
            ..SOFT
        };
        (spring, SOFT.theta_ref)
    })
}

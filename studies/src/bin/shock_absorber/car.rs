//! The quarter car: its data, its materials, and the scene at t = 0.
//!
//! Equations, symbols and sources are in the example `shock_absorber`.

#![allow(dead_code, reason = "examples that share this file use a part of it")]

use eem::prelude::*;

use super::road::Track;

/// 0 °C in K.
pub(crate) const CELSIUS: f64 = 273.15;

/// Air, and damper before the drive, K.
pub(crate) const WINTER: f64 = CELSIUS - 20.0;

/// Acceleration of free fall, m/s².
pub(crate) const GRAVITY: f64 = 9.81;

/// Body and wheel, kg.
pub(crate) const BODY: f64 = 300.0;
pub(crate) const WHEEL: f64 = 0.15 * BODY;

/// Stiffness of suspension spring and tyre, N/m.
pub(crate) const SUSPENSION: f64 = 63.3 * BODY;
pub(crate) const TYRE: f64 = 653.0 * BODY;

/// Height of the wheel's centre above the road and of the body above that, at rest, m. The
/// equations do not depend on them: natural lengths are such that the car rests there.
pub(crate) const RADIUS: f64 = 0.3;
pub(crate) const CLEARANCE: f64 = 0.4;

/// From the damper to the air, W/K.
const CONDUCTANCE: f64 = 4.0;

/// Waves of 100 m to 1 m length on 200 m of a poor road.
pub(crate) const TRACK: Track = Track {
    lap: 200.0,
    speed: 20.0,
    roughness: 1024e-6,
    waves: [2, 200],
};

/// A linear spring: suspension and tyre.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch| 0.5 * stiffness * (lambda - natural_length).powi(2))]
struct Spring {
    #[unit("N/m")]
    stiffness: f64,
    #[unit("m")]
    natural_length: f64,
}

/// A rubber mount in series with oil that thins when it warms, beside a gas charge.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    let travel = lambda - natural_length;
    0.5 * mount * (travel - gamma).powi(2)
        - gas_force * (theta / theta_ref) * travel
        + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
})]
#[viscosity(gamma = eta0 * exp(a * (1 / theta - 1 / theta_ref)))]
pub(crate) struct Damper {
    #[unit("m")]
    natural_length: f64,
    #[unit("K")]
    theta_ref: f64,
    #[unit("N/m")]
    pub(crate) mount: f64,
    #[unit("N")]
    gas_force: f64,
    #[unit("J/K")]
    pub(crate) capacity: f64,
    #[unit("N s/m")]
    pub(crate) eta0: f64,
    #[unit("K")]
    a: f64,
}

pub(crate) const DAMPER: Damper = Damper {
    natural_length: CLEARANCE,
    theta_ref: CELSIUS + 20.0,
    mount: 500e3,
    gas_force: 200.0,
    capacity: 500.0,
    eta0: 1500.0,
    a: 1306.0,
};

impl Damper {
    /// η(θ), N s/m.
    pub(crate) fn viscosity(&self, theta: f64) -> f64 {
        self.eta0 * (self.a * (1.0 / theta - 1.0 / self.theta_ref)).exp()
    }

    /// What the suspension spring carries of the body beside it, N.
    pub(crate) fn load_beside(&self) -> f64 {
        BODY * GRAVITY - self.gas_force * WINTER / self.theta_ref
    }

    /// The same damper with the viscosity that it has now, whatever its temperature will be.
    pub(crate) fn frozen(self, theta: f64) -> Self {
        let eta0 = self.viscosity(theta);
        Self {
            eta0,
            a: 0.0,
            ..self
        }
    }
}

/// The scene, and what to find in it.
#[derive(Debug)]
pub(crate) struct Car {
    pub(crate) scene: Scene<1>,
    /// Where the tyre touches the road.
    pub(crate) contact: Node,
    pub(crate) wheel: Node,
    pub(crate) body: Node,
    /// Tyre, suspension spring and damper.
    pub(crate) parts: [Element; 3],
}

/// The quarter car with this damper, at rest on the track.
pub(crate) fn car(damper: Damper) -> Car {
    car_on(SUSPENSION, damper)
}

/// The same on a suspension spring of this stiffness, N/m, as long as the body then needs to rest where it does.
pub(crate) fn car_on(stiffness: f64, damper: Damper) -> Car {
    let spring = Spring {
        stiffness,
        natural_length: CLEARANCE + damper.load_beside() / stiffness,
    };
    let tyre = Spring {
        stiffness: TYRE,
        natural_length: RADIUS + (BODY + WHEEL) * GRAVITY / TYRE,
    };
    let road = TRACK.road();
    let start = road.height(0.0);

    let mut scene = Scene::<1>::new();
    scene.set_gravity([-GRAVITY]);
    let contact = scene.anchor([start]);
    scene.move_anchor(contact, move |t| [road.height(t)]);
    let wheel = scene.mass(WHEEL, [start + RADIUS], [0.0]);
    let body = scene.mass(BODY, [start + RADIUS + CLEARANCE], [0.0]);
    let tyre = scene.spring(tyre, [contact, wheel]);
    let spring = scene.spring(spring, [wheel, body]);
    let damper = scene.spring(damper, [wheel, body]);
    scene.set_temperature(damper, WINTER);
    let air = scene.reservoir(WINTER);
    scene.conduct(damper, air, CONDUCTANCE);
    Car {
        scene,
        contact,
        wheel,
        body,
        parts: [tyre, spring, damper],
    }
}

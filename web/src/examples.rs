//! Sheets to begin with.

use serde::Serialize;

use crate::pendulum::Setting;

/// A sheet with a start.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Example {
    /// What the page calls it.
    pub name: &'static str,
    /// Its sheet.
    pub sheet: &'static str,
    /// Its start.
    pub setting: Setting,
}

/// The start of most of them: stretched and slow.
const SETTING: Setting = Setting {
    step: 0.1,
    mass: 1.0,
    length: 3.0,
    speed: 1.0,
    gravity: 0.0,
    spring: 380.0,
    air: 300.0,
    conductance: 10.0,
};

/// All of them; a page begins with the first.
pub const EXAMPLES: [Example; 4] = [
    Example {
        name: "Hot pendulum with a dashpot",
        sheet: "\
|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    let strain = ln(lambda / l);
    let elastic = strain - gamma / l;
    0.5 * k * strain.powi(2) + 0.5 * k1 * elastic.powi(2)
        - beta * (theta - t0) * strain
        + c * (theta - t0 - theta * ln(theta / t0))
}

viscosity gamma = eta * exp(a / theta)

l = 1 m           // natural length
k = 100 J         // stiffness
k1 = 20 J         // stiffness of the branch with the dashpot
beta = 4 J/K      // thermal expansion
c = 1 J/K         // heat capacity
t0 = 300 K        // temperature without thermal stress
eta = 5 N s/m     // viscosity
a = 10 K          // how much warmth thins the oil
",
        setting: SETTING,
    },
    Example {
        name: "Hooke's law",
        sheet: "\
|lambda: Stretch| 0.5 * k * (lambda - l).powi(2)

k = 100 N/m       // stiffness
l = 1 m           // natural length
",
        setting: Setting {
            step: 0.05,
            length: 1.5,
            speed: 2.0,
            gravity: 9.81,
            ..SETTING
        },
    },
    Example {
        name: "Rubber, logarithmic strain",
        sheet: "\
|lambda: Stretch, theta: Temperature| {
    let strain = ln(lambda / l);
    0.5 * k * (theta / t0) * strain.powi(2)
        + c * (theta - t0 - theta * ln(theta / t0))
}

l = 1 m           // natural length
k = 100 J         // stiffness at t0: rubber stiffens with warmth
c = 5 J/K         // heat capacity
t0 = 300 K        // reference temperature
",
        setting: Setting {
            conductance: 2.0,
            ..SETTING
        },
    },
    Example {
        name: "Shock absorber",
        sheet: "\
|lambda: Stretch, theta: Temperature| {
    0.5 * k * (lambda - l).powi(2)
        + c * (theta - t0 - theta * ln(theta / t0))
}

viscosity lambda = eta * (t0 / theta).powi(3)

l = 1 m           // natural length
k = 100 N/m       // stiffness
c = 0.2 J/K       // heat capacity of the oil
t0 = 300 K        // reference temperature
eta = 2 N s/m     // viscosity at t0
",
        setting: Setting {
            length: 2.0,
            speed: 3.0,
            gravity: 9.81,
            spring: 300.0,
            conductance: 0.05,
            ..SETTING
        },
    },
];

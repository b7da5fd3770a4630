//! A pendulum on a spring, stepped with one scheme, and samples of its motion and of both laws.

use eem::{Element, Node, Scene, Scheme, Simulation, StepError};
use eem_typed::{DampedSpring, Law, LawError, Spring0, Spring8};
use serde::{Deserialize, Serialize};

/// Numbers of a [`Sample`].
pub const SAMPLE: usize = 6;

/// Time, s; position of the mass, m; `E − E₀`, J; `S − S₀`, J/K; temperature of the spring, K, or 0 without one.
pub type Sample = [f64; SAMPLE];

/// How the pendulum starts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Setting {
    /// Step size, s.
    pub step: f64,
    /// Mass, kg.
    pub mass: f64,
    /// Length of the spring, m; it lies horizontally.
    pub length: f64,
    /// Velocity of the mass at right angles to the spring, m/s.
    pub speed: f64,
    /// Acceleration downwards, m/s².
    pub gravity: f64,
    /// Temperature of the spring, K, if it has one.
    pub spring: f64,
    /// Temperature of the air, K.
    pub air: f64,
    /// Conductance between the two, W/K.
    pub conductance: f64,
}

/// What the steps of a run have kept so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Balance {
    /// The largest `|E − E₀|`, J.
    pub drift: f64,
    /// What rounding explains of it in a scheme that proves its laws, J.
    pub bound: f64,
    /// `S − S₀`, J/K.
    pub production: f64,
    /// The smallest change of S in a step, J/K.
    pub least: f64,
}

/// One run.
pub struct Pendulum {
    run: Simulation<2>,
    bob: Node,
    spring: Element,
    is_thermal: bool,
    energy: f64,
    entropy: f64,
    balance: Balance,
}

impl Pendulum {
    /// The pendulum at its start.
    ///
    /// # Errors
    ///
    /// What is wrong with the scene, the scheme or the step, or that the spring has more dashpots than were compiled.
    ///
    /// ```
    /// use eem_web::examples::EXAMPLES;
    /// use eem_web::pendulum::Pendulum;
    /// use eem_web::sheet::Material;
    ///
    /// let example = &EXAMPLES[0];
    /// let law = Material::read(example.sheet).unwrap().law;
    /// let mut pendulum = Pendulum::new(&law, &example.setting, "eem-temperature")?;
    /// let start = pendulum.sample();
    /// assert_eq!(start[..3], [0.0, 3.0, 0.0]);
    /// for _ in 0..100 {
    ///     pendulum.step().unwrap();
    /// }
    /// let balance = pendulum.balance();
    /// assert!(balance.drift <= balance.bound && balance.least >= 0.0);
    /// # Ok::<(), String>(())
    /// ```
    pub fn new(law: &Law, setting: &Setting, scheme: &str) -> Result<Self, String> {
        let scheme = Scheme::from_name(scheme).ok_or_else(|| format!("no scheme is `{scheme}`"))?;
        let mut scene = Scene::<2>::new();
        let ends = [
            scene.anchor([0.0, 0.0]),
            scene.mass(setting.mass, [setting.length, 0.0], [0.0, setting.speed]),
        ];
        scene.set_gravity([0.0, -setting.gravity]);
        let spring = add_spring(law, &mut scene, ends).map_err(|error| error.to_string())?;
        let arguments = law.compiled().arguments();
        let is_thermal = arguments.iter().any(|one| one.role == "Temperature");
        if is_thermal {
            scene.set_temperature(spring, setting.spring);
            let air = scene.reservoir(setting.air);
            scene.conduct(spring, air, setting.conductance);
        }
        let run = Simulation::new(scene, scheme, setting.step);
        let run = run.map_err(|refused| refused.to_string())?;
        let start = run.ledger();
        Ok(Self {
            run,
            bob: ends[1],
            spring,
            is_thermal,
            energy: start.balance,
            entropy: start.entropy,
            balance: Balance {
                least: f64::INFINITY,
                ..Balance::default()
            },
        })
    }

    /// Makes a step.
    ///
    /// # Errors
    ///
    /// That of the step; the pendulum is as it was then.
    pub fn step(&mut self) -> Result<Sample, StepError> {
        let report = self.run.step()?;
        let sample = self.sample();
        let balance = &mut self.balance;
        balance.drift = balance.drift.max(sample[3].abs());
        balance.bound += report.bound;
        balance.least = balance.least.min(sample[4] - balance.production);
        balance.production = sample[4];
        Ok(sample)
    }

    /// The present state.
    #[must_use]
    pub fn sample(&self) -> Sample {
        let ledger = self.run.ledger();
        let position = self.run.position(self.bob).unwrap_or_default();
        let temperature = if self.is_thermal {
            self.run.temperature(self.spring).unwrap_or_default()
        } else {
            0.0
        };
        [
            self.run.time(),
            position[0],
            position[1],
            ledger.balance - self.energy,
            ledger.entropy - self.entropy,
            temperature,
        ]
    }

    /// What the laws have become so far.
    #[must_use]
    pub fn balance(&self) -> Balance {
        self.balance
    }
}

/// Puts the spring into the scene, with the smallest of three types that it fits. [`Law::add_spring`] would choose among five, for
/// which the module would need a sixth more bytes.
fn add_spring(law: &Law, scene: &mut Scene<2>, ends: [Node; 2]) -> Result<Element, LawError> {
    law.check_spring()?;
    let elastic: Result<Spring0, _> = law.model();
    if let Ok(spring) = elastic {
        return Ok(scene.spring(spring, ends));
    }
    let damped: Result<DampedSpring, _> = law.model();
    if let Ok(spring) = damped {
        return Ok(scene.spring(spring, ends));
    }
    let with_many: Spring8 = law.model()?;
    Ok(scene.spring(with_many, ends))
}

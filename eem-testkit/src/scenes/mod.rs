//! The published cases, and reference data.

pub mod dashpots;
pub mod numbers;
pub mod orders;
pub mod solids;
pub mod springs;
pub mod tangents;

pub use springs::{hencky, hooke};

pub use eem::materials::{Hencky, LogarithmicStiffness, ThermoViscoElastic};
use eem::prelude::*;
use eem::{EndState, Material, RefusedScene, StateQuantity};

/// The only error for which a scene is refused.
pub fn only_error<const D: usize>(refused: Result<Simulation<D>, RefusedScene<D>>) -> SceneError {
    let refused = refused.unwrap_err();
    let [error] = refused.errors() else {
        panic!("{refused}")
    };
    error.clone()
}

/// Everything that a step depends on, as text that tells all doubles apart.
pub fn bits<const D: usize>(run: &Simulation<D>) -> String {
    format!("{:?}", run.checkpoint())
}

/// An observer that only watches.
pub fn watch<const D: usize>(_: &Simulation<D>, _: &StepReport) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// The schemes that keep the laws, and the choice among them.
pub const EXACT: [Scheme; 8] = [
    Scheme::EemEntropy,
    Scheme::EemTemperature,
    Scheme::EemDamped,
    Scheme::EemEntropy4,
    Scheme::EemEntropy6,
    Scheme::EemExplicit,
    Scheme::Staggered,
    Scheme::Auto,
];

/// Springs of two models between an anchor and two masses, in thermal contact and in air, under gravity: the scene, its nodes,
/// and the springs with a temperature, of which [`busy`] prescribes the second.
pub fn in_air() -> (Scene<2>, [Node; 3], [Element; 2]) {
    let mut scene = Scene::<2>::new();
    let support = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [1.5, 0.0], [0.0, 1.0]);
    let tail = scene.mass(0.5, [1.5, -1.1], [0.2, 0.0]);
    let warm = scene.spring(ThermoViscoElastic::PENDULUM, [support, bob]);
    let kept = scene.spring(ThermoViscoElastic::PENDULUM, [bob, tail]);
    let hencky = Hencky {
        stiffness: 30.0,
        natural_length: 1.5,
    };
    scene.spring(hencky, [support, tail]);
    scene.set_temperature(warm, 320.0);
    scene.set_temperature(kept, 310.0);
    scene.conduct(warm, kept, 3.0);
    let air = scene.reservoir(300.0);
    scene.conduct(warm, air, 10.0);
    scene.set_gravity([0.0, -9.81]);
    (scene, [support, bob, tail], [warm, kept])
}

/// The same with a pushed mass, a moved anchor and a thermostat.
pub fn busy() -> Scene<2> {
    let (mut scene, [support, bob, _], [_, kept]) = in_air();
    scene.prescribe_temperature(kept, |t| 310.0 + 5.0 * t.sin());
    scene.force(bob, |t| [(3.0 * t).sin(), 0.2]);
    scene.move_anchor(support, |t| [0.1 * (2.0 * t).sin(), 0.0]);
    scene
}

/// The largest error of a state in any kind of quantity, relative as in studies.
pub fn largest_error(own: &EndState, exact: &EndState) -> f64 {
    let errors = StateQuantity::ALL.map(|quantity| own.difference(exact, quantity));
    errors.into_iter().flatten().fold(0.0, f64::max)
}

/// A simulation of the pendulum, with handles of its parts.
#[derive(Debug)]
pub struct Pendulum {
    pub run: Simulation<2>,
    pub bob: Node,
    pub spring: Element,
    pub air: Reservoir,
}

/// The single pendulum of García Orden & Romero (2012), §4.1.
pub fn single_pendulum(scheme: Scheme, step: f64) -> Pendulum {
    let (scene, bob, spring, air) = single_pendulum_scene();
    let run = Simulation::new(scene, scheme, step).unwrap();
    Pendulum {
        run,
        bob,
        spring,
        air,
    }
}

/// The scene of the single pendulum, with bob, spring and air.
pub fn single_pendulum_scene() -> (Scene<2>, Node, Element, Reservoir) {
    let mut scene = Scene::default();
    let pivot = scene.anchor([0.0; 2]);
    let bob = scene.mass(1.0, [3.0, 0.0], [0.0, 1.0]);
    let spring = scene.spring(ThermoViscoElastic::PENDULUM, [pivot, bob]);
    scene.set_temperature(spring, 380.0);
    let air = scene.reservoir(300.0);
    scene.conduct(spring, air, 10.0);
    (scene, bob, spring, air)
}

impl Pendulum {
    /// q, p, θ, γ and σ in the order of the reference data.
    pub fn row(&self) -> [f64; 7] {
        let q = self.run.position(self.bob).unwrap();
        let p = self.run.momentum(self.bob).unwrap();
        let theta = self.run.temperature(self.spring).unwrap();
        let gamma = self.run.viscous_stretch(self.spring, 0).unwrap();
        let sigma = self.run.reservoir_entropy(self.air).unwrap();
        [q.x, q.y, p.x, p.y, theta, gamma, sigma]
    }
}

/// A double pendulum of Conde Martín, Betsch & García Orden (2016): origin – spring – mass – spring –
/// mass, in space, the springs in thermal contact.
#[derive(Clone, Copy, Debug)]
pub struct DoublePendulum {
    pub name: &'static str,
    pub stiffness: [f64; 2],
    pub softening: [f64; 2],
    pub masses: [f64; 2],
    pub coupling: f64,
    pub capacity: [f64; 2],
    pub conductance: f64,
    pub positions: [[f64; 3]; 2],
    pub momenta: [[f64; 3]; 2],
    pub temperatures: [f64; 2],
    pub duration: f64,
    pub step: f64,
    /// E, S and |J| at the start, as published.
    pub start: [f64; 3],
}

impl DoublePendulum {
    pub const ROMERO: Self = Self {
        name: "romero",
        stiffness: [0.1, 1.0],
        softening: [0.0, 0.0],
        masses: [1.0, 2.0],
        coupling: 0.2,
        capacity: [5.0, 5.0],
        conductance: 300.0,
        positions: [[1.0, 0.0, 0.0], [2.2, 0.0, 0.0]],
        momenta: [[0.0, 2.0, 0.0], [1.0, 0.0, 0.0]],
        temperatures: [380.0, 310.0],
        duration: 25.0,
        step: 0.3,
        start: [421.641_105_799_8, 1.243_727_879_7, 2.0],
    };

    pub const KRUEGER: Self = Self {
        name: "kruger",
        stiffness: [100.0, 100.0],
        capacity: [1000.0, 1000.0],
        conductance: 10.0,
        momenta: [[0.0, 1.0, 0.0], [0.0, 4.4, 0.0]],
        duration: 500.0,
        step: 0.1,
        start: [90_000.375_170_773_5, 269.076_435_762_5, 10.68],
        ..Self::ROMERO
    };

    pub const LOGARITHMIC: Self = Self {
        name: "log",
        stiffness: [5000.0, 10_000.0],
        softening: [50.0, 60.0],
        masses: [10.0, 20.0],
        coupling: 20.0,
        capacity: [5000.0, 2000.0],
        conductance: 300.0,
        positions: [[3.0, 0.0, 0.5], [3.0, 1.0, 1.0]],
        momenta: [[0.0, 10.0, 0.0], [0.0, 0.0, -20.0]],
        temperatures: [380.0, 298.0],
        duration: 25.0,
        step: 0.1,
        start: [400_819.933_391_345, 1_183.024_338_221_3, 71.5891],
    };

    pub const ALL: [Self; 3] = [Self::ROMERO, Self::KRUEGER, Self::LOGARITHMIC];

    /// A simulation of it, with its masses and springs.
    pub fn simulation(&self, scheme: Scheme, step: f64) -> DoubleRun {
        let (scene, masses, springs) = self.scene();
        let run = Simulation::new(scene, scheme, step).unwrap();
        DoubleRun {
            run,
            masses,
            springs,
        }
    }

    /// Its scene, with its masses and springs.
    pub fn scene(&self) -> (Scene<3>, [Node; 2], [Element; 2]) {
        self.scene_of(|model| model)
    }

    /// The same with springs of another material.
    pub fn scene_of<M: Material>(
        &self,
        of: impl Fn(LogarithmicStiffness) -> M,
    ) -> (Scene<3>, [Node; 2], [Element; 2]) {
        let mut scene = Scene::<3>::new();
        let pivot = scene.anchor([0.0; 3]);
        let masses = [0, 1].map(|i| {
            let velocity = self.momenta[i].map(|p| p / self.masses[i]);
            scene.mass(self.masses[i], self.positions[i], velocity)
        });
        let ends = [[pivot, masses[0]], [masses[0], masses[1]]];
        let springs = [0, 1].map(|i| {
            let model = LogarithmicStiffness {
                stiffness: self.stiffness[i],
                softening: self.softening[i],
                coupling: self.coupling,
                capacity: self.capacity[i],
                natural_length: [2.0, 1.0][i],
                theta_ref: 300.0,
            };
            let spring = scene.spring(of(model), ends[i]);
            scene.set_temperature(spring, self.temperatures[i]);
            spring
        });
        scene.conduct(springs[0], springs[1], self.conductance);
        (scene, masses, springs)
    }
}

/// A double pendulum in motion.
#[derive(Debug)]
pub struct DoubleRun {
    pub run: Simulation<3>,
    pub masses: [Node; 2],
    pub springs: [Element; 2],
}

impl DoubleRun {
    /// q, p and θ in the order of the reference data.
    pub fn row(&self) -> Vec<f64> {
        let positions = self.masses.map(|mass| self.run.position(mass).unwrap());
        let momenta = self.masses.map(|mass| self.run.momentum(mass).unwrap());
        let temperatures = self
            .springs
            .map(|spring| self.run.temperature(spring).unwrap());
        let vectors = positions.iter().chain(&momenta);
        vectors
            .flat_map(|vector| vector.iter().copied())
            .chain(temperatures)
            .collect()
    }
}

/// Largest violations of the laws along a run. A NaN anywhere stays a NaN, which no bound admits.
#[derive(Clone, Copy, Debug)]
pub struct Laws {
    first_energy: f64,
    first_momentum: [f64; 3],
    entropy: f64,
    /// max |E − E₀|/|E₀|.
    pub energy: f64,
    /// max |J − J₀|/|J₀|.
    pub angular_momentum: f64,
    /// The smallest ΔS of a step, in ulp of S.
    pub entropy_ulps: f64,
}

impl Laws {
    /// Starts watching.
    pub fn new<const D: usize>(run: &Simulation<D>) -> Self {
        let ledger = run.ledger();
        Self {
            first_energy: ledger.energy,
            first_momentum: ledger.angular_momentum.into(),
            entropy: ledger.entropy,
            energy: 0.0,
            angular_momentum: 0.0,
            entropy_ulps: f64::INFINITY,
        }
    }

    /// Steps to a time, and looks at every state; steps of exact schemes produce entropy everywhere.
    pub fn until<const D: usize>(run: &mut Simulation<D>, end: f64) -> Self {
        let mut laws = Self::new(run);
        let (mut iterations, mut steps) = (0, 0);
        while run.time() < end - 0.5 * run.step_size() {
            let report = run.step().unwrap();
            assert!(!run.scheme().is_exact() || report.least_production >= 0.0);
            (iterations, steps) = (iterations + report.iterations, steps + 1);
            laws.watch(run);
        }
        let (scheme, h) = (run.scheme(), run.step_size());
        println!("{scheme}, h = {h}: {steps} steps, {iterations} iterations, {laws:?}");
        laws
    }

    /// Looks at the state after a step.
    pub fn watch<const D: usize>(&mut self, run: &Simulation<D>) {
        let ledger = run.ledger();
        let energy = (ledger.energy - self.first_energy).abs() / self.first_energy.abs();
        self.energy = worse(self.energy, energy, energy > self.energy);
        let norm = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let momentum: [f64; 3] = ledger.angular_momentum.into();
        let change = [0, 1, 2].map(|axis| momentum[axis] - self.first_momentum[axis]);
        let defect = norm(change) / norm(self.first_momentum);
        self.angular_momentum = worse(
            self.angular_momentum,
            defect,
            defect > self.angular_momentum,
        );
        let ulp = f64::EPSILON * ledger.entropy.abs();
        let ulps = (ledger.entropy - self.entropy) / ulp;
        self.entropy_ulps = worse(self.entropy_ulps, ulps, ulps < self.entropy_ulps);
        self.entropy = ledger.entropy;
    }
}

/// The old or the new value, and NaN if either is.
fn worse(old: f64, new: f64, is_worse: bool) -> f64 {
    if old.is_nan() || (!is_worse && !new.is_nan()) {
        old
    } else {
        new
    }
}

/// The rows of a reference file, without its header.
pub fn reference(name: &str) -> Vec<Vec<f64>> {
    let path = format!("{}/../tests/data/{name}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let row = |line: &str| line.split(',').map(|cell| cell.parse().unwrap()).collect();
    text.lines().skip(1).map(row).collect()
}

/// A hundred steps of a chain of two thermo-visco-elastic springs that hangs on one end, one hot, with
/// a conductance (W/K) between them: Newton iterations in all, and the laws.
pub fn pendulums_in_contact(scheme: Scheme, step: f64, conductance: f64) -> (usize, Laws) {
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let nodes = [
        scene.mass(1.0, [1.2, 0.0], [0.0, 1.0]),
        scene.mass(1.0, [2.3, 0.3], [0.0, 0.0]),
    ];
    let ends = [[pivot, nodes[0]], [nodes[0], nodes[1]]];
    let springs = ends.map(|ends| scene.spring(ThermoViscoElastic::PENDULUM, ends));
    scene.set_temperature(springs[0], 380.0);
    scene.set_temperature(springs[1], 300.0);
    scene.conduct(springs[0], springs[1], conductance);
    let mut run = Simulation::new(scene, scheme, step).unwrap();
    let mut laws = Laws::new(&run);
    let steps = (0..100).map(|_| {
        let report = run.step().unwrap();
        laws.watch(&run);
        report.iterations
    });
    (steps.sum(), laws)
}

//! Elements whose temperatures are prescribed: the heat is θ times the entropy given, so that no more free energy is had from a
//! thermostat than `∫ψ dt` allows. The numbers are those of formulas, from positions, momenta, viscous stretches and heat.

use eem::kinematics::Quad4;
use eem::prelude::*;

use crate::support::orders::slope;
use crate::support::solids::Relaxing;

/// All exact schemes that have one.
fn exact() -> impl Iterator<Item = Scheme> {
    Scheme::ALL.into_iter().filter(|scheme| scheme.is_exact())
}

/// Whose elements have one set of forces and one temperature in a step.
const OF_ONE_RATE: [Scheme; 3] = [
    Scheme::EemEntropy,
    Scheme::EemTemperature,
    Scheme::Staggered,
];

/// Roundings of a sum: of the terms of an energy, in a step and in the formulas here.
const ROUNDINGS: f64 = 16.0;

/// A spring and a branch whose lengths depend on the temperature, strongly for its small capacity.
#[derive(Clone, Copy, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    let stretch = lambda - length;
    0.5 * k * stretch.powi(2) + 0.5 * mu * (stretch - gamma).powi(2) - beta * (theta - theta_ref) * stretch
        + capacity * (theta - theta * ln(theta / theta_ref))
})]
#[viscosity(gamma = eta)]
struct Warmed {
    k: f64,
    mu: f64,
    eta: f64,
    length: f64,
    beta: f64,
    capacity: f64,
    theta_ref: f64,
}

const WARMED: Warmed = Warmed {
    k: 10.0,
    mu: 10.0,
    eta: 1.0,
    length: 1.0,
    beta: 0.3,
    capacity: 0.04,
    theta_ref: 300.0,
};

/// A mass on a spring at a temperature that is given.
struct Held {
    run: Simulation<2>,
    mass: Node,
    spring: Element,
    material: Warmed,
}

/// What formulas say of a state.
#[derive(Clone, Copy, Debug)]
struct Of {
    /// `K + ψ` and `K + ψ + θ s`, J.
    free: f64,
    total: f64,
    creep: f64,
    /// The magnitude of all terms, J.
    terms: f64,
}

impl Held {
    fn new(
        material: Warmed,
        (scheme, step): (Scheme, f64),
        hold: impl FnOnce(&mut Scene<2>, Element),
    ) -> Self {
        let mut scene = Scene::<2>::new();
        let wall = scene.anchor([0.0, 0.0]);
        let mass = scene.mass(1.0, [1.05, 0.0], [0.0, 0.1]);
        let spring = scene.spring(material, [wall, mass]);
        hold(&mut scene, spring);
        let run = Simulation::new(scene, scheme, step).unwrap();
        Self {
            run,
            mass,
            spring,
            material,
        }
    }

    fn at(&self, theta: f64) -> Of {
        let Warmed {
            k,
            mu,
            length,
            beta,
            capacity,
            theta_ref,
            ..
        } = self.material;
        let [x, y]: [f64; 2] = self.run.position(self.mass).unwrap().into();
        let [p, q]: [f64; 2] = self.run.momentum(self.mass).unwrap().into();
        let creep = self.run.viscous_stretch(self.spring, 0).unwrap();
        let stretch = x.hypot(y) - length;
        let mechanics = [
            0.5 * (p * p + q * q),
            0.5 * k * stretch * stretch,
            0.5 * mu * (stretch - creep).powi(2),
        ];
        let entropies = [beta * stretch, capacity * (theta / theta_ref).ln()];
        let sum = |terms: &[f64]| terms.iter().sum::<f64>();
        let size = |terms: &[f64]| terms.iter().map(|x| x.abs()).sum::<f64>();
        // ψ = … + c θ − θ s + β θ_r (λ − ℓ)
        let total = sum(&mechanics) + beta * theta_ref * stretch + capacity * theta;
        Of {
            free: total - theta * sum(&entropies),
            total,
            creep,
            terms: size(&mechanics)
                + theta * size(&entropies)
                + beta * theta_ref * (stretch.abs() + length)
                + capacity * theta,
        }
    }
}

/// `Δ(K + ψ) = −Σ η Δγ²/h` with one rate in a step, and no more with several, by the Cauchy–Schwarz inequality.
#[test]
fn a_held_spring_loses_the_free_energy_that_it_dissipates() {
    let theta = 400.0;
    for scheme in exact() {
        for step in [0.003, 0.03, 0.1] {
            let hold = |scene: &mut Scene<2>, spring| scene.hold_temperature(spring, theta);
            let mut held = Held::new(WARMED, (scheme, step), hold);
            let mut turnover = 0.0;
            for _ in 0..30 {
                let (old, before) = (held.at(theta), held.run.ledger());
                held.run.step().unwrap();
                let (new, after) = (held.at(theta), held.run.ledger());
                let bound = ROUNDINGS * f64::EPSILON * (old.terms + new.terms);
                let what = format!("{scheme}, h = {step}: {old:?} {new:?}");
                let heat = after.heat - before.heat;
                let given = before.thermostat_entropy - after.thermostat_entropy;
                assert!((new.total - old.total - heat).abs() <= bound, "{what}");
                assert!(
                    (heat - theta * given).abs() <= bound,
                    "{what}, {heat} {given}"
                );
                let lost = old.free - new.free;
                let least = WARMED.eta * (new.creep - old.creep).powi(2) / step;
                if OF_ONE_RATE.contains(&scheme) {
                    assert!((lost - least).abs() <= bound, "{what}, {least}");
                }
                // The weights of the explicit scheme are not all positive.
                let least = if scheme == Scheme::EemExplicit {
                    0.0
                } else {
                    least
                };
                assert!(lost >= least - bound, "{what}, {least}");
                turnover += heat.abs();
            }
            assert!(turnover > 10.0, "{scheme}: {turnover}");
        }
    }
}

/// The temperature at which heat is given lies between those at both ends.
#[test]
fn heat_of_a_changing_temperature_is_given_within_its_range() {
    let course = |t: f64| 400.0 + 80.0 * (9.0 * t).sin();
    for scheme in [
        Scheme::EemEntropy,
        Scheme::EemTemperature,
        Scheme::EemDamped,
    ] {
        let hold = |scene: &mut Scene<2>, spring| {
            scene.set_temperature(spring, 400.0);
            scene.prescribe_temperature(spring, course);
        };
        let mut held = Held::new(WARMED, (scheme, 0.03), hold);
        for _ in 0..30 {
            let ends = [held.run.time(), held.run.time() + 0.03].map(course);
            let (old, before) = (held.at(ends[0]), held.run.ledger());
            held.run.step().unwrap();
            let (new, after) = (held.at(ends[1]), held.run.ledger());
            let heat = after.heat - before.heat;
            let given = before.thermostat_entropy - after.thermostat_entropy;
            let bound = ROUNDINGS * f64::EPSILON * (old.terms + new.terms);
            assert!((new.total - old.total - heat).abs() <= bound, "{scheme}");
            let beyond = (heat - 0.5 * (ends[0] + ends[1]) * given).abs();
            let range = 0.5 * (ends[1] - ends[0]).abs() * given.abs();
            assert!(beyond <= range + bound, "{scheme}: {heat} {given} {ends:?}");
        }
    }
}

/// Motion, creep and heat against those of the explicit scheme in short steps.
#[test]
fn held_springs_and_their_heat_have_the_order_of_the_scheme() {
    let material = Warmed {
        beta: 0.03,
        ..WARMED
    };
    let end = |scheme: Scheme, step: f64| {
        let hold = |scene: &mut Scene<2>, spring| {
            scene.set_temperature(spring, 350.0);
            scene.prescribe_temperature(spring, |t| 350.0 + 40.0 * (3.0 * t).sin());
        };
        let mut held = Held::new(material, (scheme, step), hold);
        while held.run.time() < 0.96 - 0.5 * step {
            held.run.step().unwrap();
        }
        let [x, y]: [f64; 2] = held.run.position(held.mass).unwrap().into();
        let ledger = held.run.ledger();
        let creep = held.run.viscous_stretch(held.spring, 0).unwrap();
        let entropy = 350.0 * ledger.thermostat_entropy;
        [x, y, creep, ledger.heat, entropy]
    };
    let exact = end(Scheme::EemExplicit, 0.005);
    for (scheme, order, step) in [
        (Scheme::EemEntropy, 2.0, 0.12),
        (Scheme::EemEntropy4, 4.0, 0.12),
        (Scheme::EemEntropy6, 6.0, 0.08),
    ] {
        let runs = [1.0, 0.5, 0.25].map(|part| end(scheme, part * step));
        for (at, &exact) in exact.iter().enumerate() {
            let errors = runs.map(|row| (row[at] - exact).abs());
            println!("{scheme}, {at}: {errors:?}, slope {}", slope(&errors));
            assert!((slope(&errors) - order).abs() <= 0.3, "{scheme}, {at}");
        }
    }
}

/// Solids whose branches soften with heat: the temperature of every stage is that of the thermostat.
#[test]
fn held_solids_take_heat_at_their_temperature() {
    let theta = 350.0;
    let mesh = Mesh::<Quad4, 2>::block([2, 1], [[0.0, 2.0], [0.0, 1.0]]).unwrap();
    for scheme in exact().filter(|&scheme| scheme != Scheme::EemExplicit) {
        let mut scene = Scene::<2>::new();
        let body = scene.solid(Relaxing::RUBBER, &mesh, &Bulk::new(10.0));
        for (&node, place) in body.nodes().iter().zip(mesh.nodes()) {
            if place[0] < 0.5 {
                scene.fix(node);
            } else {
                scene.set_velocity(node, [0.5, 2.0 * place[0]]);
            }
        }
        for &point in body.points() {
            scene.hold_temperature(point, theta);
        }
        let mut run = Simulation::new(scene, scheme, 0.02).unwrap();
        let mut turnover = 0.0;
        for _ in 0..5 {
            let before = run.ledger();
            let report = run.step().unwrap();
            let after = run.ledger();
            let heat = after.heat - before.heat;
            let given = before.thermostat_entropy - after.thermostat_entropy;
            let off = (heat - theta * given).abs();
            assert!(off <= report.bound, "{scheme}: {heat} {given} {report:?}");
            let free = |ledger: &Ledger<2>| {
                ledger.kinetic_energy + ledger.internal_energy - theta * ledger.element_entropy
            };
            assert!(free(&after) - free(&before) <= report.bound, "{scheme}");
            turnover += heat.abs();
        }
        assert!(turnover > 1e-3, "{scheme}: {turnover}");
    }
}

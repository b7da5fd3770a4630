//! The explicit scheme with moved anchors: a weak dashpot beside a stiff spring, and springs at rest that a support begins to
//! strain.

use eem::Tolerance;
use eem::prelude::*;

use crate::support::springs::Branched;

const SCHEME: Scheme = Scheme::EemExplicit;

/// Roundings of each term of an energy, as in the certificate.
const ROUNDINGS: f64 = 64.0;

/// The end of a spring and the work on it, with a viscous stretch, follow from `γ̇ = μ (x − ℓ − γ)/η` for
/// `x = 1.1 + a (1 − cos ωt)`.
struct Course {
    model: Branched,
    amplitude: f64,
    omega: f64,
}

impl Course {
    fn end(&self, t: f64) -> f64 {
        1.1 + self.amplitude * (1.0 - (self.omega * t).cos())
    }

    fn gamma(&self, t: f64) -> f64 {
        let Self {
            model,
            amplitude,
            omega,
        } = self;
        let (rate, mean) = (model.mu / model.eta, 0.1 + amplitude);
        let decay = (-rate * t).exp();
        let angle = omega * t;
        let swing = rate * angle.cos() + omega * angle.sin() - rate * decay;
        mean * (1.0 - decay) - amplitude * rate * swing / (rate * rate + omega * omega)
    }

    /// `∫ g²/η dt` by Simpson's rule.
    fn lost(&self, end: f64) -> f64 {
        let parts = 3_000;
        let part = end / f64::from(parts);
        let power = |t: f64| {
            let g = self.model.mu * (self.end(t) - self.model.length - self.gamma(t));
            g * g / self.model.eta
        };
        let sum = (0..parts).map(|index| {
            let t = part * f64::from(index);
            power(t) + 4.0 * power(t + 0.5 * part) + power(t + part)
        });
        sum.sum::<f64>() * part / 6.0
    }

    fn stored(&self, t: f64) -> f64 {
        let strain = self.end(t) - self.model.length;
        let elastic = strain - self.gamma(t);
        0.5 * self.model.k * strain * strain + 0.5 * self.model.mu * elastic * elastic
    }
}

/// The energy of the spring is 500 J, that of the dashpot 5e-3 J: it bears no error of the spring's work.
#[test]
fn a_weak_dashpot_beside_a_stiff_spring_keeps_its_accuracy() {
    let model = Branched {
        k: 1e5,
        mu: 1.0,
        eta: 1.0,
        length: 1.0,
    };
    let course = Course {
        model,
        amplitude: 1e-3,
        omega: 6.0,
    };
    let end = 3.0;
    let (gamma, lost) = (course.gamma(end), course.lost(end));
    let work = course.stored(end) - course.stored(0.0) + lost;
    for scheme in [SCHEME, Scheme::Auto] {
        for relative in [1e-4, 1e-6, 1e-8] {
            let mut scene = Scene::<2>::new();
            let ends = [scene.anchor([0.0, 0.0]), scene.anchor([1.1, 0.0])];
            let spring = scene.spring(model, ends);
            scene.move_anchor(ends[1], |t| [1.1 + 1e-3 * (1.0 - (6.0 * t).cos()), 0.0]);
            let tolerance = Tolerance::new(relative);
            let mut run = Simulation::with_tolerance(scene, scheme, tolerance).unwrap();
            run.run_until(end).unwrap();
            let found = run.viscous_stretch(spring, 0).unwrap();
            let ledger = run.ledger();
            assert!((found - gamma).abs() <= relative, "{relative:e}: {found}");
            let defect = ledger.lost_heat - lost;
            assert!(defect.abs() <= 0.1 * relative, "{relative:e}: {defect:e}");
            // With the rounding of 500 J, once.
            let bound = 0.1 * relative + ROUNDINGS * f64::EPSILON * 500.0;
            let defect = ledger.work - work;
            assert!(defect.abs() <= bound, "{relative:e}: {defect:e}");
        }
    }
}

/// Up and down within a tenth of a second, m.
fn bump(t: f64) -> f64 {
    let phase = 10.0 * (t - 0.5);
    let is_inside = (0.0..1.0).contains(&phase);
    if is_inside {
        0.005 * (1.0 - (core::f64::consts::TAU * phase).cos())
    } else {
        0.0
    }
}

/// A row of springs between two anchors, at rest, of which one is moved.
fn row(model: Branched, has_mass: bool) -> (Scene<2>, Option<Node>, Vec<Element>) {
    let mut scene = Scene::<2>::new();
    let length = model.length;
    let count = if has_mass { 2.0 } else { 1.0 };
    let ends = [scene.anchor([0.0; 2]), scene.anchor([count * length, 0.0])];
    let mass = has_mass.then(|| scene.mass(1.0, [length, 0.0], [0.0; 2]));
    let nodes: Vec<_> = [ends[0]].into_iter().chain(mass).chain([ends[1]]).collect();
    let pairs = nodes.windows(2);
    let springs = pairs.map(|pair| scene.spring(model, [pair[0], pair[1]]));
    let springs = springs.collect();
    scene.move_anchor(ends[1], move |t| [count * length + bump(t), 0.0]);
    scene.shortest_load(0.1);
    (scene, mass, springs)
}

/// The energy of a row by its formula, and the terms whose rounding it has, J.
fn energy(
    run: &Simulation<2>,
    model: Branched,
    (mass, springs): (Option<Node>, &[Element]),
) -> [f64; 2] {
    let length = model.length;
    let count = if mass.is_some() { 2.0 } else { 1.0 };
    let end = count * length + bump(run.time());
    let (mut points, mut sum) = (vec![0.0], 0.0);
    if let Some(mass) = mass {
        let p = run.momentum(mass).unwrap()[0];
        points.push(run.position(mass).unwrap()[0]);
        sum += 0.5 * p * p;
    }
    points.push(end);
    let mut terms = sum;
    for (pair, &spring) in points.windows(2).zip(springs) {
        let strain = pair[1] - pair[0] - length;
        let elastic = strain - run.viscous_stretch(spring, 0).unwrap();
        let own = 0.5 * model.k * strain * strain + 0.5 * model.mu * elastic * elastic;
        let force = model.k * strain.abs() + model.mu * elastic.abs();
        let stiffness = model.k + model.mu;
        sum += own;
        terms += own + force * end + f64::EPSILON * stiffness * end * end;
    }
    [sum, terms]
}

/// Rounding of positions and viscous stretches is all that its first energies are.
#[test]
fn a_support_begins_to_strain_what_is_at_rest() {
    for has_mass in [false, true] {
        for (k, mu) in [(0.1, 0.1), (0.1, 1e3), (10.0, 10.0)] {
            for (eta, length) in [(0.1, 1.0), (100.0, 0.3)] {
                let model = Branched { k, mu, eta, length };
                let name = format!("{has_mass} {k} {mu} {eta} {length}");
                for relative in [1e-4, 1e-7] {
                    let (scene, mass, springs) = row(model, has_mass);
                    let tolerance = Tolerance::new(relative);
                    let mut run = Simulation::with_tolerance(scene, SCHEME, tolerance).unwrap();
                    let at = |run: &Simulation<2>| {
                        let [energy, terms] = energy(run, model, (mass, &springs));
                        let ledger = run.ledger();
                        let sums = ledger.work.abs() + ledger.lost_heat;
                        [energy + ledger.lost_heat - ledger.work, terms + sums]
                    };
                    let [mut before, mut terms] = at(&run);
                    let mut steps = 0;
                    while run.time() < 0.7 {
                        let step = run.step();
                        step.unwrap_or_else(|error| panic!("{name}: {error}"));
                        let [after, new_terms] = at(&run);
                        let bound = ROUNDINGS * f64::EPSILON * (terms + new_terms);
                        let defect = after - before;
                        assert!(defect.abs() <= bound, "{name}: {defect:e}, {bound:e}");
                        (before, terms) = (after, new_terms);
                        steps += 1;
                    }
                    assert!(steps <= 1_500, "{name}: {steps} steps");
                }
            }
        }
    }
}

#[test]
fn constant_steps_leave_rest() {
    for length in [0.3, 1.0] {
        let model = Branched {
            k: 10.0,
            mu: 10.0,
            eta: 1.0,
            length,
        };
        for has_mass in [false, true] {
            let (scene, ..) = row(model, has_mass);
            let mut run = Simulation::new(scene, SCHEME, 0.005).unwrap();
            run.run_until(1.5).unwrap();
        }
    }
}

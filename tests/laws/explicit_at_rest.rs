//! The explicit scheme at rest: where energies vanish, what rounding of positions does to them is no reason to refuse a step, and the
//! law of energy, found from positions and momenta, still holds to this rounding.

use eem::Tolerance;
use eem::prelude::*;

use crate::support::springs::{Branched, linear};

const SCHEME: Scheme = Scheme::EemExplicit;

/// k, N/m, of a spring at a mass of 1 kg.
const K: f64 = 100.0;

/// Roundings of each term of an energy, as in the certificate.
const ROUNDINGS: f64 = 64.0;

/// Loads in N, at rest at first: the energies of the first steps are between 1e-15 and 1e-60 J.
const LOADS: [fn(f64) -> f64; 4] = [
    |t| t.powi(3),
    |t| 0.5 * t.powi(4),
    |t| 0.3 * t.powi(5),
    |t| 10.0 * (-((t - 0.8) / 0.12).powi(2)).exp(),
];

/// The energy of a mass on a spring, and the terms whose rounding it has:
/// those of the energy, `|f|λ`, and `ε k λ²` of a length that is rounded to ε λ, J.
fn energy([q, p]: [f64; 2]) -> [f64; 2] {
    let (kinetic, force) = (0.5 * p * p, K * (q - 1.0));
    let stored = 0.5 * force * (q - 1.0);
    let rounded = (force * q).abs() + f64::EPSILON * K * q * q;
    [kinetic + stored, kinetic + stored + rounded]
}

#[test]
fn a_mass_at_rest_begins_to_move() {
    for (load, force) in LOADS.into_iter().enumerate() {
        for relative in [1e-4, 1e-6, 1e-8] {
            let mut scene = Scene::<1>::new();
            let mass = scene.mass(1.0, [1.0], [0.0]);
            let ends = [scene.anchor([0.0]), mass];
            scene.spring(linear(K), ends);
            scene.force(mass, move |t| [force(t)]);
            let tolerance = Tolerance::new(relative);
            let mut run = Simulation::with_tolerance(scene, SCHEME, tolerance).unwrap();
            let at = |run: &Simulation<1>| {
                let [q, p] = [run.position(mass), run.momentum(mass)];
                [q.unwrap()[0], p.unwrap()[0]]
            };
            let ([mut before, mut terms], mut work) = (energy(at(&run)), 0.0);
            let mut steps = 0;
            while run.time() < 2.0 {
                let step = run.step();
                step.unwrap_or_else(|error| panic!("{load}, {relative:e}: {error}"));
                let ([after, new_terms], all) = (energy(at(&run)), run.ledger().work);
                let own = all - work;
                let defect = after - before - own;
                // The ledger is a sum, which is rounded as a whole.
                let bound = ROUNDINGS * f64::EPSILON * (terms + new_terms + own.abs() + all.abs());
                assert!(defect.abs() <= bound, "{load}: {defect:e}, {bound:e}");
                (before, terms, work) = (after, new_terms, all);
                steps += 1;
            }
            assert!(steps <= 150, "{load}, {relative:e}: {steps} steps");
        }
    }
}

/// `x = t⁷/42` for a force t⁵, and the kinetic energy is the work.
#[test]
fn a_free_mass_at_the_origin_has_the_work_of_its_load() {
    let mut scene = Scene::<2>::new();
    let mass = scene.mass(1.0, [0.0, 0.0], [0.0, 0.0]);
    scene.force(mass, |t| [t.powi(5), 0.0]);
    let tolerance = Tolerance::new(1e-6);
    let mut run = Simulation::with_tolerance(scene, SCHEME, tolerance).unwrap();
    let mut steps = 0.0;
    while run.time() < 2.0 {
        run.step().unwrap();
        steps += 1.0;
        let [p, _] = run.momentum(mass).unwrap().into();
        let (kinetic, work) = (0.5 * p * p, run.ledger().work);
        // Each step rounds the momentum and the work.
        let bound = 4.0 * steps * f64::EPSILON * work;
        assert!((kinetic - work).abs() <= bound, "{kinetic:e}, {work:e}");
    }
    let [x, y] = run.position(mass).unwrap().into();
    let exact = run.time().powi(7) / 42.0;
    assert!((x / exact - 1.0).abs() < 20.0 * 1e-6, "{x}, {exact}");
    assert_eq!(y.to_bits(), 0.0_f64.to_bits());
    assert!(steps < 100.0, "{steps}");
}

/// The first steps have squares of momenta, powers or forces that are no normal numbers, of which ε is not the rounding. Before, the energy was
/// off by 4.9e-324 J, «where rounding explains 0».
#[test]
fn a_load_begins_as_a_subnormal_number() {
    for [mass, step] in [[1.0, 0.01], [1e-6, 0.01], [1e3, 100.0_f64]] {
        for start in [18.9, 19.1, 19.3, 23.0, 26.7, 27.2] {
            // A Gaussian of the width w around the time w `start`.
            let width = 10.0 * step;
            let mut scene = Scene::<1>::new();
            let [free, held] = [2.0, 1.0].map(|x| scene.mass(mass, [x], [0.0]));
            let stiffness = mass / (5.0 * step).powi(2);
            let ends = [scene.anchor([0.0]), held];
            scene.spring(linear(stiffness), ends);
            for node in [free, held] {
                scene.force(node, move |t| [(-(t / width - start).powi(2)).exp()]);
            }
            let mut run = Simulation::new(scene, SCHEME, step).unwrap();
            run.run_until((start + 3.0) * width)
                .unwrap_or_else(|error| panic!("{mass} kg, {start}: {error}"));
            // √π w (1 + erf 3)/2, with erfc 3 = 2.209e-5.
            let exact = core::f64::consts::PI.sqrt() * width * (1.0 - 0.5 * 2.209e-5);
            let momentum = run.momentum(free).unwrap()[0];
            assert!((momentum / exact - 1.0).abs() < 1e-8, "{momentum}, {exact}");
            let ledger = run.ledger();
            let terms = ledger.energy + ledger.work + stiffness;
            let defect = ledger.energy - ledger.work;
            assert!(
                defect.abs() <= ROUNDINGS * f64::EPSILON * terms,
                "{defect:e}"
            );
        }
    }
}

/// After a bump the motion decays to the last bits. What the bump has left of the rounding of its energy, 1e-3 J, is then more than all that
/// moves, and no reason to refuse a step.
#[test]
fn a_damped_mass_rests_after_a_bump() {
    let (k, length, mass) = (2.8e5, 0.56, 0.29);
    for mu in [4.217e4, 5.0119e4, 6.4938e4, 7.2862e4, 8.1752e4] {
        let spring = Branched {
            k,
            mu,
            eta: 170.0,
            length,
        };
        let mut scene = Scene::<1>::new();
        let node = scene.mass(mass, [-length], [0.0]);
        let ends = [scene.anchor([0.0]), node];
        let spring = scene.spring(spring, ends);
        scene.force(node, |t| [95.0 * (-((t - 3.5) / 0.142).powi(2)).exp()]);
        let tolerance = Tolerance::new(1e-3);
        let mut run = Simulation::with_tolerance(scene, SCHEME, tolerance).unwrap();
        // Σ e, and its terms with those of the rounding of lengths.
        let energy = |run: &Simulation<1>| {
            let [q, p] = [run.position(node), run.momentum(node)].map(|x| x.unwrap()[0]);
            let creep = run.viscous_stretch(spring, 0).unwrap();
            let stretch = -q - length;
            let kinetic = 0.5 * p * p / mass;
            let [at, inner] = [k * stretch, mu * (stretch - creep)];
            let stored = 0.5 * (at * stretch + inner * (stretch - creep));
            let forces = (at + inner).abs() * q.abs() + inner.abs() * creep.abs();
            let rounded = f64::EPSILON * (k + mu) * q * q;
            [kinetic + stored, kinetic + stored + forces + rounded]
        };
        let ([mut before, mut terms], mut given) = (energy(&run), 0.0);
        let mut steps = 0;
        while run.time() < 5.0 {
            run.step()
                .unwrap_or_else(|error| panic!("{mu}, {}: {error}", run.time()));
            let ([after, new_terms], ledger) = (energy(&run), run.ledger());
            let all = ledger.work - ledger.lost_heat;
            let defect = after - before - (all - given);
            // The ledger has two sums, which are rounded as a whole.
            let sums = ledger.work.abs() + ledger.lost_heat;
            let bound = ROUNDINGS * f64::EPSILON * (terms + new_terms + sums);
            assert!(defect.abs() <= bound, "{mu}: {defect:e}, {bound:e}");
            (before, terms, given) = (after, new_terms, all);
            steps += 1;
        }
        assert!(steps <= 1000, "{mu}: {steps} steps");
    }
}

/// A weight that hangs at rest from the origin, against gravity g, with its spring.
fn hanging<const D: usize>(g: [f64; D]) -> (Scene<D>, Node) {
    let size = g.iter().fold(0.0, |sum, g| sum + g * g).sqrt();
    let mut scene = Scene::<D>::new();
    let node = scene.mass(1.0, g.map(|g| g / size * (1.0 + size / K)), [0.0; D]);
    let ends = [scene.anchor([0.0; D]), node];
    scene.spring(linear(K), ends);
    scene.set_gravity(g);
    (scene, node)
}

/// A mass on a line has no angular momentum along it. The rounding of the torque of its weight has, where the line is skew to the axes,
/// and that is no reason to turn the line or to refuse a step.
#[test]
fn weights_rest_on_skew_lines() {
    for g in [
        [0.3, 0.2, -9.81],
        [-0.7, -0.6, -2.8],
        [4.0, -3.0, 1.7],
        [0.1, 5.0, 0.2],
    ] {
        for step in [None, Some(0.01)] {
            let (scene, node) = hanging(g);
            let mut run = match step {
                None => Simulation::with_tolerance(scene, SCHEME, Tolerance::new(1e-4)),
                Some(step) => Simulation::new(scene, SCHEME, step),
            }
            .unwrap();
            let before = run.position(node).unwrap();
            run.run_until(2.0)
                .unwrap_or_else(|error| panic!("{g:?}, {step:?}: {error}"));
            let moved = (run.position(node).unwrap() - before).norm();
            // The spring pulls with 10 N, known to 1e-15 N, and has the period 0.6 s.
            assert!(moved < 1e-13, "{g:?}, {step:?}: moved by {moved:e} m");
        }
    }
}

/// A small force in the plane of the weight and an axis moves it in this plane only: as in two dimensions.
#[test]
fn weights_on_skew_lines_move_as_in_the_plane() {
    let push = |t: f64| 0.001 * (t / 4.0).powi(2);
    let down = 3.0;
    let pushed = |tolerance: f64| {
        let (mut scene, node) = hanging([0.0, -down]);
        scene.force(node, move |t| [push(t), -push(t)]);
        let tolerance = Tolerance::new(tolerance);
        let mut run = Simulation::with_tolerance(scene, SCHEME, tolerance).unwrap();
        run.run_until(4.0).unwrap();
        run.momentum(node).unwrap()
    };
    let exact = pushed(1e-10);
    for (n, a) in [
        ([-0.7, -0.6, -2.8], [1.0, 0.0, 0.0]),
        ([0.2, 0.9, 0.4], [0.0, 0.0, 1.0]),
    ] {
        let n = nalgebra::Vector3::from(n).normalize();
        let a = nalgebra::Vector3::from(a);
        let a = (a - n * a.dot(&n)).normalize();
        let (mut scene, node) = hanging((n * down).into());
        scene.force(node, move |t| ((a + n) * push(t)).into());
        let tolerance = 1e-7;
        let mut run = Simulation::with_tolerance(scene, SCHEME, Tolerance::new(tolerance)).unwrap();
        run.run_until(4.0).unwrap();
        let p = run.momentum(node).unwrap();
        let off = [
            p.dot(&a) - exact[0],
            p.dot(&n) + exact[1],
            p.dot(&n.cross(&a)),
        ];
        let off = off.iter().fold(0.0_f64, |most, off| most.max(off.abs()));
        assert!(off < 20.0 * tolerance * exact.norm(), "{n:?}: {off:e}");
    }
}

/// Masses that are pushed along a line through their anchor have no angular momentum but rounding, which is that of the momenta they have
/// had: where they are slow, it is no reason to turn the line.
#[test]
fn masses_pushed_along_skew_lines_stay_on_them() {
    let load = |t: f64| 0.5 * (1.0 - (3.0 * t).cos());
    for (index, line) in [
        [0.36, -0.93, 0.08],
        [-0.7, 0.6, 0.3],
        [0.1, 0.2, 0.97],
        [0.55, 0.6, -0.58],
        [-0.2, -0.5, -0.8],
        [0.9, 0.3, -0.2],
    ]
    .into_iter()
    .enumerate()
    {
        let line = nalgebra::Vector3::from(line).normalize();
        for (masses, tolerance) in [(1, Some(1e-4)), (1, Some(1e-8)), (1, None), (3, None)] {
            let mut scene = Scene::<3>::new();
            let mut last = scene.anchor([0.0; 3]);
            for mass in 1..=masses {
                let next = scene.mass(1.0, (line * f64::from(mass)).into(), [0.0; 3]);
                scene.spring(linear(K), [last, next]);
                last = next;
            }
            scene.force(last, move |t| (line * load(t)).into());
            let mut run = match tolerance {
                Some(tolerance) => {
                    Simulation::with_tolerance(scene, SCHEME, Tolerance::new(tolerance))
                }
                None => Simulation::new(scene, SCHEME, 0.02),
            }
            .unwrap();
            run.run_until(8.0)
                .unwrap_or_else(|error| panic!("line {index}, {masses}, {tolerance:?}: {error}"));
            let place = run.position(last).unwrap();
            let off = (place - line * place.dot(&line)).norm();
            // Rounding of positions of 3 m, which a line of three under 1 N hardly enlarges in this time.
            assert!(
                off < 1e-12,
                "line {index}, {masses}, {tolerance:?}: off by {off:e} m"
            );
        }
    }
}

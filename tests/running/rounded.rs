//! Errors that rounding explains neither reject a step nor make it shorter: far from the origin, long after the time zero, and where
//! stiff springs hold a mass that hardly moves. Nor does the rounding of the energy of a prestress change a vibration beside it.

use eem::prelude::*;
use eem::{StepStatistics, Tolerance};
use std::ops::ControlFlow;

use crate::support::hooke;
use crate::support::springs::{Branched, linear};

const SCHEMES: [Scheme; 5] = [
    Scheme::Auto,
    Scheme::EemExplicit,
    Scheme::EemEntropy6,
    Scheme::EemEntropy4,
    Scheme::EemEntropy,
];

/// Accepted and rejected steps.
fn tried(steps: StepStatistics) -> u64 {
    let StepStatistics {
        accepted,
        rejected_by_error,
        rejected_by_newton,
        rejected_by_domain,
        rejected_by_law,
        ..
    } = steps;
    accepted + rejected_by_error + rejected_by_newton + rejected_by_domain + rejected_by_law
}

/// Masses of 1 kg in a row, at distances of 1 m, on linear springs from an anchor, and a load along the row on the last one.
#[derive(Clone, Copy, Debug)]
struct Row {
    masses: usize,
    k: f64,
    anchor: f64,
    /// The load is this times (t/end)⁵, N.
    load: f64,
    end: f64,
}

impl Row {
    fn force(self, t: f64) -> f64 {
        self.load * (t / self.end).powi(5)
    }

    /// The displacement and the momentum of the last mass, and the number of steps.
    fn run(self, scheme: Scheme, relative: f64) -> ([f64; 2], u64) {
        let mut scene = Scene::<1>::new();
        let mut place = self.anchor;
        let mut last = scene.anchor([place]);
        for _ in 0..self.masses {
            place += 1.0;
            let mass = scene.mass(1.0, [place], [0.0]);
            scene.spring(linear(self.k), [last, mass]);
            last = mass;
        }
        scene.force(last, move |t: f64| [self.force(t)]);
        let mut run = Simulation::new(scene, scheme, 0.01).unwrap();
        run.control_steps(Tolerance::new(relative)).unwrap();
        run.run_until(self.end).unwrap();
        let found = [
            run.position(last).unwrap()[0] - place,
            run.momentum(last).unwrap()[0],
        ];
        (found, tried(run.step_statistics().unwrap()))
    }

    /// The same by the classical scheme of order 4 in short steps, in displacements, which know no origin.
    fn exact(self) -> [f64; 2] {
        let count = self.masses;
        let rates = |t: f64, y: &[f64]| -> Vec<f64> {
            let stretch = |at: usize| y[at] - if at > 0 { y[at - 1] } else { 0.0 };
            let forces = (0..count).map(|at| {
                let outer = if at + 1 < count {
                    self.k * stretch(at + 1)
                } else {
                    self.force(t)
                };
                outer - self.k * stretch(at)
            });
            y[count..].iter().copied().chain(forces).collect()
        };
        let steps = (30.0 * self.end * self.k.sqrt()).ceil();
        let h = self.end / steps;
        let mut y = vec![0.0; 2 * count];
        let mut step = 0.0;
        while step < steps {
            let t = step * h;
            let moved = |by: &[f64], h: f64| -> Vec<f64> {
                y.iter().zip(by).map(|(y, by)| y + h * by).collect()
            };
            let k1 = rates(t, &y);
            let k2 = rates(t + 0.5 * h, &moved(&k1, 0.5 * h));
            let k3 = rates(t + 0.5 * h, &moved(&k2, 0.5 * h));
            let k4 = rates(t + h, &moved(&k3, h));
            for (i, y) in y.iter_mut().enumerate() {
                *y += h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
            }
            step += 1.0;
        }
        [y[count - 1], y[2 * count - 1]]
    }

    /// What the rounding of positions explains of displacement and momentum: the 16 roundings of forces that step control forgives,
    /// for all the time.
    fn rounding(self) -> [f64; 2] {
        #[expect(clippy::cast_precision_loss, reason = "a few masses")]
        let distance = self.anchor.abs() + self.masses as f64;
        let momentum = 16.0 * f64::EPSILON * self.k * distance * self.end;
        [momentum / self.k.sqrt(), momentum]
    }
}

/// Before, 13 279, 2 438, 698 785 and 1 130 540 steps.
#[test]
fn masses_that_hardly_move_take_no_more_steps_than_stability_needs() {
    let chain = Row {
        masses: 5,
        k: 1e4,
        anchor: 0.0,
        load: 1.0,
        end: 3.0,
    };
    let far = Row {
        masses: 1,
        k: 400.0,
        anchor: 1e7,
        load: 1.0,
        end: 3.0,
    };
    let stiff = Row {
        masses: 1,
        k: 1e6,
        anchor: 100.0,
        load: 1e-4,
        end: 3.0,
    };
    for (row, scheme) in [
        (chain, Scheme::Auto),
        (far, Scheme::Auto),
        (stiff, Scheme::Auto),
        (stiff, Scheme::EemExplicit),
        (chain, Scheme::EemEntropy6),
        (far, Scheme::EemEntropy6),
        (stiff, Scheme::EemEntropy6),
    ] {
        let relative = 1e-6;
        let (found, steps) = row.run(scheme, relative);
        let (exact, rounding) = (row.exact(), row.rounding());
        // Stable steps of the explicit scheme are at most 6/ω, with ω² = 4 k/m in a row; each may be tried three times.
        let stable = row.end * 2.0 * row.k.sqrt() / 6.0;
        let most = if scheme == Scheme::EemEntropy6 {
            60.0
        } else {
            60.0 + 3.0 * stable
        };
        #[expect(clippy::cast_precision_loss, reason = "a count")]
        let steps = steps as f64;
        assert!(steps < most, "{row:?} {scheme}: {steps}");
        // The step that the tolerance of positions allows does not matter here: the mass moves by less.
        let sizes = [exact[0].abs(), exact[1].abs()];
        for at in 0..2 {
            let error = (found[at] - exact[at]).abs();
            let allowed = 100.0 * relative * sizes[at] + rounding[at];
            assert!(
                error <= allowed,
                "{row:?} {scheme} {at}: {error:e} {allowed:e}"
            );
        }
    }
}

/// What is a function of time in [`driven`].
#[derive(Clone, Copy, Debug)]
enum Driven {
    Force,
    Anchor,
}

/// The displacement of a mass of 1 kg on a spring of 100 N/m from rest, 3 s after the start, its exact value, and the number of steps.
fn driven(what: Driven, scheme: Scheme, start: f64) -> ([f64; 2], u64) {
    let end = 3.0;
    let mut scene = Scene::<1>::new();
    let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.0], [0.0])];
    scene.spring(linear(100.0), ends);
    match what {
        Driven::Force => scene.force(ends[1], move |t: f64| [10.0 * (2.0 * (t - start)).sin()]),
        Driven::Anchor => {
            scene.move_anchor(ends[0], move |t: f64| {
                [0.1 * (2.0 * (t - start)).sin().powi(3)]
            });
        }
    }
    scene.start_at(start);
    let mut run = Simulation::new(scene, scheme, 0.01).unwrap();
    run.control_steps(Tolerance::new(1e-6)).unwrap();
    run.run_until(start + end).unwrap();
    // A load k a sin wt from rest: a (sin wt − w/ω sin ωt)/(1 − w²/ω²), ω = 10/s; 0.1 sin³ 2t = 0.075 sin 2t − 0.025 sin 6t.
    let follow = |a: f64, w: f64| {
        a * ((w * end).sin() - w / 10.0 * (10.0 * end).sin()) / (1.0 - w * w / 100.0)
    };
    let exact = match what {
        Driven::Force => follow(0.1, 2.0),
        Driven::Anchor => follow(0.075, 2.0) - follow(0.025, 6.0),
    };
    let found = run.position(ends[1]).unwrap()[0] - 1.0;
    ([found, exact], tried(run.step_statistics().unwrap()))
}

/// Before, all schemes but those of order 4 and 6 ended with an error.
#[test]
fn a_load_is_followed_as_far_as_the_time_is_known() {
    let start = 1.7e9;
    for what in [Driven::Force, Driven::Anchor] {
        // Errors of the force: 4 roundings of the time at 20 N/s, and of an anchor at 0.46 m/s; on a vibration of 10/s for 3 s.
        let rate = match what {
            Driven::Force => 20.0,
            Driven::Anchor => 100.0 * 0.46,
        };
        let rounding = 4.0 * f64::EPSILON * start * rate * 3.0 / 10.0;
        for scheme in SCHEMES {
            let ([_, _], usual) = driven(what, scheme, 0.0);
            let ([found, exact], steps) = driven(what, scheme, start);
            println!("{what:?} {scheme} {usual} {steps} {:e}", found - exact);
            assert!(
                steps <= usual + usual / 2,
                "{what:?} {scheme}: {steps} for {usual}"
            );
            let error = (found - exact).abs();
            assert!(
                error <= rounding + 1e-6,
                "{what:?} {scheme}: {error:e} {rounding:e}"
            );
        }
    }
}

/// A dashpot between anchors relaxes with μ/η = 10/s. Before, 2 steps and an error of 3 % at 10⁶ m.
#[test]
fn a_dashpot_between_anchors_does_not_know_where_it_is() {
    for scheme in SCHEMES {
        let [near, far] = [0.0, 1e6].map(|x| {
            let mut scene = Scene::<1>::new();
            let ends = [scene.anchor([x]), scene.anchor([x + 1.1])];
            let spring = Branched {
                k: 100.0,
                mu: 100.0,
                eta: 10.0,
                length: 1.0,
            };
            let spring = scene.spring(spring, ends);
            let mut run = Simulation::new(scene, scheme, 0.001).unwrap();
            run.control_steps(Tolerance::new(1e-2)).unwrap();
            run.run_until(0.25).unwrap();
            let gamma = run.viscous_stretch(spring, 0).unwrap();
            (gamma, run.step_statistics().unwrap().accepted)
        });
        let exact = 0.1 * (1.0 - (-2.5_f64).exp());
        println!("{scheme} {near:?} {far:?} {exact}");
        // Errors below rounding let the first steps of high orders grow less.
        assert!(
            (near.1..=near.1 + 4).contains(&far.1),
            "{scheme} {near:?} {far:?}"
        );
        for (gamma, _) in [near, far] {
            assert!((gamma - exact).abs() <= 1e-2 * exact, "{scheme} {gamma}");
        }
    }
}

/// 1 kg at the origin with the velocity 10⁻⁵ m/s, between two springs of 10⁴ N/m and 0.8 m from anchors at ±1 m: 400 J.
fn beside_prestress(scheme: Scheme) {
    const SPEED: f64 = 1e-5;
    let spring = hooke(1e4, 0.8);
    let mut scene = Scene::<1>::new();
    let mass = scene.mass(1.0, [0.0], [SPEED]);
    for side in [-1.0, 1.0] {
        let anchor = scene.anchor([side]);
        scene.spring(spring, [anchor, mass]);
    }
    let mut run = Simulation::new(scene, scheme, 1e-3).unwrap();
    run.control_steps(Tolerance::new(1e-7)).unwrap();
    let rate = (2.0 * spring.stiffness).sqrt();
    let first = run.ledger().balance;
    // ψ, |f|λ and the target of the energy, of both springs.
    let stretch = 1.0 - spring.natural_length;
    let terms = 2.0 * spring.stiffness * stretch * (stretch + 1.0);
    let allowed = 8.0 * f64::EPSILON * terms;
    for hundredth in 1..=150 {
        run.run_until_with(f64::from(hundredth) / 100.0, |run, report| {
            let change = run.ledger().balance - first;
            assert!(change.abs() <= allowed, "{scheme} {change:e}");
            assert!(report.defect.abs() <= report.bound, "{scheme} {report:?}");
            ControlFlow::Continue(())
        })
        .unwrap();
        let angle = rate * run.time();
        let momentum = run.momentum(mass).unwrap()[0] - SPEED * angle.cos();
        let position = rate * run.position(mass).unwrap()[0] - SPEED * angle.sin();
        let error = position.hypot(momentum) / SPEED;
        assert!(error < 20.0 * 1e-7, "{scheme} {}: {error:e}", run.time());
    }
}

/// Before, 15 % of the velocity.
#[test]
fn a_vibration_beside_a_prestress_keeps_its_amplitude() {
    for scheme in [Scheme::EemExplicit, Scheme::Auto] {
        beside_prestress(scheme);
    }
}

/// What moved anchors do to a prestress far from the origin is closed as ever: no step is `Ok` beyond its bound.
#[test]
fn moved_anchors_beside_a_prestress_keep_the_energy() {
    let spring = hooke(1.7e4, 0.825);
    for [origin, tolerance, way] in [[27.9, 1e-6, 1e-3], [3.7, 1e-4, 1e-4]] {
        let mut scene = Scene::<1>::new();
        let fixed = scene.anchor([origin]);
        let mass = scene.mass(1.0, [origin + 1.0], [0.168]);
        let moved = scene.anchor([origin + 2.0]);
        scene.move_anchor(moved, move |t: f64| {
            [origin + 2.0 + way * (60.0 * t).sin().powi(2)]
        });
        for ends in [[fixed, mass], [mass, moved]] {
            scene.spring(spring, ends);
        }
        let tolerance = Tolerance::new(tolerance);
        let mut run = Simulation::with_tolerance(scene, Scheme::EemExplicit, tolerance).unwrap();
        run.run_until_with(0.6, |_, report| {
            assert!(report.defect.abs() <= report.bound, "{origin} {report:?}");
            ControlFlow::Continue(())
        })
        .unwrap();
    }
}

/// The end of three masses on springs under tension, after 60 steps beside an anchor that stands or is moved by a Gaussian of which only the
/// tail, 10⁻¹⁴¹ m, is there.
fn beside_tail(scheme: Scheme, is_moved: bool) -> [f64; 3] {
    let tail = |t: f64| 0.1 * (-(t - 18.0).powi(2)).exp();
    let mut scene = Scene::<1>::new();
    let anchor = scene.anchor([if is_moved { tail(0.0) } else { 0.0 }]);
    let spring = hooke(1.0, 0.8);
    let masses = [1.0, 2.0, 3.0].map(|x| scene.mass(1.0, [x], [0.0]));
    for ends in [anchor, masses[0], masses[1], masses[2]].windows(2) {
        scene.spring(spring, [ends[0], ends[1]]);
    }
    if is_moved {
        scene.move_anchor(anchor, move |t: f64| [tail(t)]);
    }
    let mut run = Simulation::new(scene, scheme, 0.01).unwrap();
    for _ in 0..60 {
        run.step()
            .unwrap_or_else(|error| panic!("{scheme}: {error}"));
    }
    masses.map(|mass| run.position(mass).unwrap()[0])
}

/// The tangent took rounding over the increments for a stiffness of 10¹²⁰ N/m: Newton's method ended with updates of 10⁻¹⁰⁰.
#[test]
fn an_anchor_that_hardly_moves_is_as_good_as_one_that_stands() {
    for scheme in [Scheme::EemEntropy4, Scheme::EemEntropy6, Scheme::EemEntropy] {
        let [still, moved] = [false, true].map(|is_moved| beside_tail(scheme, is_moved));
        for (still, moved) in still.into_iter().zip(moved) {
            // Each of 60 steps rounds positions of 3 m.
            let rounding = 60.0 * 3.0 * f64::EPSILON;
            assert!(
                (still - moved).abs() <= rounding,
                "{scheme} {still} {moved}"
            );
        }
    }
}

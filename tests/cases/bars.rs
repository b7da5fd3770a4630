//! Bars and blocks with closed solutions: waves, free expansion, rigid rotation.

use core::f64::consts::{FRAC_PI_2, PI};

use eem::kinematics::{Hex8, Quad4, Quad8, Shape};
use eem::prelude::*;

/// Linear in the Green–Lagrange strain, with thermal expansion: `S = λ tr E + 2 μ E − β (θ − θ_ref)`.
#[derive(Clone, Copy, Debug, FreeEnergy)]
#[free_energy(|e1: StrainTrace, e2: StrainSquare, theta: Temperature| {
    let heating = theta - theta_ref;
    0.5 * lame * e1.powi(2) + shear * e2 - expansion * heating * e1
        + capacity * (heating - theta * ln(theta / theta_ref))
})]
struct Linear {
    #[unit("Pa")]
    lame: f64,
    #[unit("Pa")]
    shear: f64,
    #[unit("Pa/K")]
    expansion: f64,
    #[unit("Pa/K")]
    capacity: f64,
    #[unit("K")]
    theta_ref: f64,
}

impl Linear {
    /// Without Poisson's ratio and thermal expansion: no force acts across a bar.
    const BAR: Self = Self {
        lame: 0.0,
        shear: 1000.0,
        expansion: 0.0,
        capacity: 100.0,
        theta_ref: 300.0,
    };
}

/// kg/m³
const DENSITY: f64 = 10.0;

/// All that step solids.
const SCHEMES: [Scheme; 7] = [
    Scheme::EemEntropy,
    Scheme::EemTemperature,
    Scheme::Staggered,
    Scheme::Midpoint,
    Scheme::MidpointTemperature,
    Scheme::Trapezoidal,
    Scheme::TrapezoidalTemperature,
];

/// A number of cells or steps.
fn real(count: usize) -> f64 {
    f64::from(u32::try_from(count).unwrap())
}

/// A bar of 1 m and some height whose nodes start at a function of their places; those at `x = 0` are fixed if
/// it is clamped.
fn bar<H: Shape<D>, const D: usize>(
    material: Linear,
    (cells, height): (usize, f64),
    (is_clamped, is_lumped): (bool, bool),
    start: impl Fn([f64; D]) -> [f64; D],
    (scheme, step): (Scheme, f64),
) -> (Simulation<D>, Body<H, D>) {
    let (mut counts, mut sides) = ([1; D], [[0.0, height]; D]);
    (counts[0], sides[0]) = (cells, [0.0, 1.0]);
    let mesh = Mesh::<H, D>::block(counts, sides).unwrap();
    let bulk = Bulk::new(DENSITY);
    let bulk = if is_lumped { bulk.lumped() } else { bulk };
    let mut scene = Scene::<D>::new();
    let body = scene.solid(material, &mesh, &bulk);
    for &point in body.points() {
        scene.set_temperature(point, material.theta_ref);
    }
    for (&node, &place) in body.nodes().iter().zip(mesh.nodes()) {
        if is_clamped && place[0] <= 0.0 {
            scene.fix(node);
        }
        scene.set_position(node, start(place));
    }
    (Simulation::new(scene, scheme, step).unwrap(), body)
}

/// Steps a clamped bar that is stretched by its first mode.
fn steps<H: Shape<D>, const D: usize>(scheme: Scheme, cells: usize, amplitude: f64, count: usize) {
    let stretched = |mut place: [f64; D]| {
        place[0] += amplitude * (FRAC_PI_2 * place[0]).sin();
        place
    };
    let period = 4.0 / (2.0 * Linear::BAR.shear / DENSITY).sqrt();
    let (mut run, _) = bar::<H, D>(
        Linear::BAR,
        (cells, 0.1),
        (true, false),
        stretched,
        (scheme, period / 400.0),
    );
    for step in 0..count {
        if let Err(error) = run.step() {
            panic!(
                "{scheme}, {} {cells}, {amplitude:e} m, step {step}: {error}",
                H::NAME
            );
        }
    }
}

/// Across such a bar nothing acts but the rounding of the axial forces.
#[test]
fn bars_without_lateral_forces_are_stepped() {
    for scheme in SCHEMES {
        steps::<Quad4, 2>(scheme, 10, 1e-12, 2);
        if scheme.is_exact() {
            steps::<Quad4, 2>(scheme, 40, 1e-6, 2);
            steps::<Quad4, 2>(scheme, 20, 1e-4, 2);
        }
    }
    // A larger force hides the rounding of its terms but where it vanishes.
    steps::<Quad4, 2>(Scheme::EemTemperature, 40, 1e-2, 2);
    for scheme in [Scheme::EemEntropy, Scheme::EemTemperature] {
        steps::<Quad8, 2>(scheme, 20, 1e-4, 1);
        steps::<Hex8, 3>(scheme, 10, 1e-4, 2);
    }
}

/// The angular frequency that the schemes of second order have in steps h of a vibration with ω: one of
/// `tan(ωh/2)` becomes `ωh/2`.
fn in_steps(omega: f64, step: f64) -> f64 {
    2.0 / step * (0.5 * omega * step).atan()
}

/// Bar of 10 cells with ν = 0, clamped at one end: a linear element in x for each cell, of which
///
/// ```text
/// ω² = (6 c²/d²) (1 − cos kd)/(2 + cos kd) consistent,   (2 c²/d²) (1 − cos kd) lumped,   c² = 2μ/ρ
/// ```
///
/// is exact for `sin kx`, `k = π/2L`. The stress `2μ (u' + 3u'²/2 + …)` is linear to `3 u'/2 ≤ 3ka/2` of itself,
/// which changes the phase by as much times ωt.
#[test]
fn waves_in_bars_have_the_frequency_of_their_cells() {
    const CELLS: usize = 10;
    const STEPS: usize = 20;
    let (amplitude, wave, cell) = (1e-6, FRAC_PI_2, 1.0 / real(CELLS));
    let speed = (2.0 * Linear::BAR.shear / DENSITY).sqrt();
    let step = 4.0 / speed / real(STEPS);
    for scheme in [
        Scheme::EemEntropy,
        Scheme::EemTemperature,
        Scheme::Trapezoidal,
    ] {
        for is_lumped in [false, true] {
            let cos = (wave * cell).cos();
            let square = if is_lumped {
                2.0 * (1.0 - cos)
            } else {
                6.0 * (1.0 - cos) / (2.0 + cos)
            };
            let omega = in_steps(square.sqrt() * speed / cell, step);
            let stretched = |[x, y]: [f64; 2]| [x + amplitude * (wave * x).sin(), y];
            let setting = (scheme, step);
            let (mut run, body) = bar::<Quad4, 2>(
                Linear::BAR,
                (CELLS, 0.1),
                (true, is_lumped),
                stretched,
                setting,
            );
            let end = body.node_at([1.0, 0.0], 0.0).unwrap();
            for at in 1..=STEPS {
                run.step().unwrap();
                let phase = omega * step * real(at);
                let error = (run.position(end).unwrap().x - 1.0) / amplitude - phase.cos();
                let nonlinear = 1.5 * wave * amplitude * phase;
                // Of a position of 1 m, in units of the amplitude.
                let rounding = 64.0 * f64::EPSILON / amplitude;
                assert!(
                    error.abs() <= nonlinear + rounding,
                    "{scheme} lumped {is_lumped} {at}: {error:e}"
                );
            }
        }
    }
}

/// Free bar of one layer of 20 cells in plane strain, ν = 0.3. In one layer of the height H, u does not depend on y
/// and v is `ψ y` (Mindlin & Herrmann 1951). With `k = π/L` and linear elements of the length d along x, where ψ
/// follows u' in the mean only,
///
/// ```text
/// ω² = (E'/ρ) k² · (6/(kd)²) (1 − cos kd)/(2 + cos kd) · (1 + χ (kd)²/12) · (1 + r μ/E')/(1 + r)
/// E' = E/(1 − ν²),   ν' = ν/(1 − ν),   r = (ν' kH)²/12,   χ = λ²/((λ + 2μ) E')
/// ```
///
/// to the first order of r and of `χ (kd)²`. What is left out of ω are the ends: the shear `μ ψ'` of the wave, which is
/// not free there, in a layer of the size H, and the share χ of the energy of both end cells, `4d (kd/2)²` of all.
#[test]
fn waves_in_bars_with_lateral_contraction_have_the_speed_of_bars() {
    const STEPS: usize = 40;
    let (modulus, ratio) = (2600.0, 0.3);
    let shear = modulus / (2.0 + 2.0 * ratio);
    let material = Linear {
        lame: modulus * ratio / ((1.0 + ratio) * (1.0 - 2.0 * ratio)),
        shear,
        ..Linear::BAR
    };
    let (amplitude, wave, height, cells) = (1e-6, PI, 0.05, 20);
    let contraction = ratio / (1.0 - ratio);
    let start = |[x, y]: [f64; 2]| {
        let strain = amplitude * wave * (wave * x).sin();
        let lateral = contraction * strain * (y - 0.5 * height);
        [x - amplitude * (wave * x).cos(), y - lateral]
    };
    let of_bar = modulus / (1.0 - ratio * ratio);
    let speed = (of_bar / DENSITY).sqrt();
    let setting = (Scheme::EemTemperature, 2.0 / speed / real(STEPS));
    let shape = ((cells, height), (false, false));
    let (mut run, body) = bar::<Quad4, 2>(material, shape.0, shape.1, start, setting);
    let ends = [0.0, 1.0].map(|x| body.node_at([x, 0.0], 0.0).unwrap());
    let (mut before, mut crossings) = (1.0_f64, Vec::new());
    for at in 0..3 * STEPS / 2 {
        run.step().unwrap();
        let [left, right] = ends.map(|node| run.position(node).unwrap().x);
        let now = (right - left - 1.0) / (2.0 * amplitude);
        if (now > 0.0) != (before > 0.0) {
            let share = before.asin() / (before.asin() - now.asin());
            crossings.push(setting.1 * (real(at) + share));
        }
        before = now;
    }
    let [first, .., last] = crossings[..] else {
        panic!("{crossings:?}")
    };
    let found = PI * real(crossings.len() - 1) / (last - first);
    let (cell, cos) = (wave / real(cells), (wave / real(cells)).cos());
    let coupling = material.lame.powi(2) / ((material.lame + 2.0 * shear) * of_bar);
    let elements = 6.0 * (1.0 - cos) / (2.0 + cos) / (cell * cell);
    let following = 1.0 + coupling * cell * cell / 12.0;
    let r = (contraction * wave * height).powi(2) / 12.0;
    let lateral = (1.0 + r * shear / of_bar) / (1.0 + r);
    let continuous = wave * speed * (elements * following * lateral).sqrt();
    let known = in_steps(continuous, setting.1);
    let error = (found / known - 1.0).abs();
    let left_out = r * wave * height + 2.0 / real(cells) * coupling * (0.5 * cell).powi(2);
    println!("{error:e}, {left_out:e} of ω");
    assert!(error <= left_out, "{found} instead of {known}");
}

/// `E = α Δθ`, `α = β/(Dλ + 2μ)` in D dimensions, leaves no stress: a block of that size, heated by Δθ, stays where
/// it is.
fn expands<H: Shape<D>, const D: usize>(dimension: f64) {
    let material = Linear {
        lame: 2000.0,
        expansion: 3.0,
        ..Linear::BAR
    };
    let heating = 40.0;
    let strain = material.expansion * heating / (dimension * material.lame + 2.0 * material.shear);
    let stretch = (1.0 + 2.0 * strain).sqrt();
    for scheme in [
        Scheme::EemEntropy,
        Scheme::EemTemperature,
        Scheme::Staggered,
    ] {
        let mesh = Mesh::<H, D>::block([2; D], [[0.0, 1.0]; D]).unwrap();
        let mut scene = Scene::<D>::new();
        let bulk = Bulk::new(DENSITY).conductivity(20.0);
        let body = scene.solid(material, &mesh, &bulk);
        for &point in body.points() {
            scene.set_temperature(point, material.theta_ref + heating);
        }
        for (&node, place) in body.nodes().iter().zip(mesh.nodes()) {
            scene.set_position(node, place.map(|at| stretch * at));
        }
        let mut run = Simulation::new(scene, scheme, 0.05).unwrap();
        for _ in 0..5 {
            run.step().unwrap();
        }
        for &point in body.points() {
            let state = run.solid_state(point).unwrap();
            for axis in 0..D {
                let error = (state.strain[(axis, axis)] - strain).abs();
                assert!(
                    error <= 16.0 * f64::EPSILON,
                    "{} {scheme}: {error:e}",
                    H::NAME
                );
                let stress = state.stress[(axis, axis)].abs();
                let terms = material.expansion * (material.theta_ref + heating);
                assert!(
                    stress <= 64.0 * f64::EPSILON * (terms + material.lame),
                    "{} {scheme}: {stress:e} Pa",
                    H::NAME
                );
            }
        }
    }
}

#[test]
fn heated_blocks_expand_without_stress() {
    expands::<Quad4, 2>(2.0);
    expands::<Quad8, 2>(2.0);
    expands::<Hex8, 3>(3.0);
}

/// A stiff block that turns by 0.1 in each step: its strains are those of the centrifugal force, at most twice
/// `ρω²r²/E` as they start from none.
fn turns<H: Shape<D>, const D: usize>() {
    let material = Linear {
        lame: 0.0,
        shear: 5e8,
        ..Linear::BAR
    };
    let (spin, angle) = (1e-3, 0.1);
    for scheme in [
        Scheme::EemEntropy,
        Scheme::EemTemperature,
        Scheme::Staggered,
    ] {
        let mesh = Mesh::<H, D>::block([1; D], [[-0.5, 0.5]; D]).unwrap();
        let mut scene = Scene::<D>::new();
        let body = scene.solid(material, &mesh, &Bulk::new(DENSITY));
        for &point in body.points() {
            scene.set_temperature(point, material.theta_ref);
        }
        for (&node, place) in body.nodes().iter().zip(mesh.nodes()) {
            let mut velocity = [0.0; D];
            (velocity[0], velocity[1]) = (-spin * place[1], spin * place[0]);
            scene.set_velocity(node, velocity);
        }
        let mut run = Simulation::new(scene, scheme, angle / spin).unwrap();
        let first = run.ledger();
        for _ in 0..10 {
            run.step().unwrap();
        }
        let last = run.ledger();
        // I = ρ/6 of a square or cube of 1 m.
        let moment = DENSITY / 6.0 * spin;
        let spun = (last.angular_momentum - first.angular_momentum).norm();
        assert!(
            spun <= 64.0 * f64::EPSILON * moment,
            "{} {scheme}: {spun:e}",
            H::NAME
        );
        let kinetic = 0.5 * moment * spin;
        let lost = (last.kinetic_energy - kinetic).abs();
        assert!(
            lost <= 64.0 * f64::EPSILON * kinetic,
            "{} {scheme}: {lost:e} J of {kinetic:e}",
            H::NAME
        );
        let most = 2.0 * DENSITY * spin * spin * 0.5 / (2.0 * material.shear);
        for &point in body.points() {
            let strain = run.solid_state(point).unwrap().strain;
            let largest = strain
                .iter()
                .fold(0.0, |most, entry| f64::max(most, entry.abs()));
            assert!(
                largest <= most + 16.0 * f64::EPSILON,
                "{} {scheme}: {largest:e}",
                H::NAME
            );
        }
    }
}

#[test]
fn turning_blocks_stay_rigid() {
    turns::<Quad4, 2>();
    turns::<Hex8, 3>();
}

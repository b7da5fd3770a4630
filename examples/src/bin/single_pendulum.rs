//! A hot pendulum with three schemes: what the laws of thermodynamics are worth.
//!
//! A mass moves in the plane on a spring that starts hot and three times too long. The spring creeps, which heats it,
//! and gives its heat to the air.
//!
//! ```text
//! q̇ = p/m,   ṗ = −f ∂λ/∂q,   γ̇ = g/η,   θ ṡ = g²/η + κ (θr − θ)
//! λ = |q|,   f = ∂ψ/∂λ,   g = −∂ψ/∂γ,   s = −∂ψ/∂θ
//!
//! ψe = k(θ)/2 ln²(λ/λ0) − βt (θ − θr) ln(λ/λ0) + c (θ − θr − θ ln(θ/θr))
//! ψ  = (1 + βc) ψe + μ(θ) γ² − βc γ ∂ψe/∂λ
//! k  = k0 − k1 (θ − θr),   μ = μ0 − μ1 (θ − θr),   η = η0 exp(a (1/θ − 1/θr))
//! ```
//!
//! Source: García Orden & Romero, Eur. J. Mech. A/Solids 32 (2012), §4.1, with its step of 0.2 s, two periods of the
//! fastest vibration. What it claims: the energy–entropy–momentum scheme keeps the energy to rounding and never loses
//! entropy; the midpoint and the trapezoidal rule gain energy, or find no state at all.

use std::error::Error;
use std::fs;

use eem::prelude::*;
use plotters::prelude::*;

/// The material: this is all that has to be written.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    let strain = ln(lambda / natural_length);
    let heating = theta - theta_ref;
    let elastic = 0.5 * (k0 - k1 * heating) * strain.powi(2)
        - thermal_coupling * heating * strain
        + capacity * (heating - theta * ln(theta / theta_ref));
    (1 + viscous_coupling) * elastic
        + (mu0 - mu1 * heating) * gamma.powi(2)
        - viscous_coupling * gamma * diff(elastic, lambda)
})]
#[viscosity(gamma = eta0 * exp(a * (1 / theta - 1 / theta_ref)))]
struct CreepingSpring {
    #[unit("m")]
    natural_length: f64,
    #[unit("K")]
    theta_ref: f64,
    #[unit("N m")]
    k0: f64,
    #[unit("N m/K")]
    k1: f64,
    #[unit("N m/K")]
    thermal_coupling: f64,
    #[unit("N m/K")]
    capacity: f64,
    #[unit("1")]
    viscous_coupling: f64,
    #[unit("N/m")]
    mu0: f64,
    #[unit("N/(m K)")]
    mu1: f64,
    #[unit("N s/m")]
    eta0: f64,
    #[unit("K")]
    a: f64,
}

fn pendulum() -> Scene<2> {
    let spring = CreepingSpring {
        natural_length: 1.0,
        theta_ref: 300.0,
        k0: 100.0,
        k1: 0.5,
        thermal_coupling: 4.0,
        capacity: 1.0,
        viscous_coupling: 0.1,
        mu0: 5.0,
        mu1: 0.1,
        eta0: 100.0,
        a: 10.0,
    };
    let mut scene = Scene::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let mass = scene.mass(1.0, [3.0, 0.0], [0.0, 1.0]);
    let spring = scene.spring(spring, [pivot, mass]);
    scene.set_temperature(spring, 380.0);
    let air = scene.reservoir(300.0);
    scene.conduct(spring, air, 10.0);
    scene
}

/// Energy (J) and entropy (J/K) over time (s), until the end or the first step that fails.
struct Run {
    scheme: Scheme,
    states: Vec<[f64; 3]>,
    failure: Option<StepError>,
}

fn simulate(scheme: Scheme) -> Result<Run, SceneError> {
    let mut run = Simulation::new(pendulum(), scheme, 0.2)?;
    let (mut states, mut failure) = (Vec::new(), None);
    loop {
        let now = run.ledger();
        states.push([run.time(), now.energy, now.entropy]);
        if run.time() > 19.9 {
            break;
        }
        if let Err(error) = run.step() {
            failure = Some(error);
            break;
        }
    }
    Ok(Run {
        scheme,
        states,
        failure,
    })
}

fn main() -> Result<(), Box<dyn Error>> {
    let schemes = [
        Scheme::EemTemperature,
        Scheme::Midpoint,
        Scheme::Trapezoidal,
    ];
    let mut runs = Vec::new();
    println!("scheme            reaches   largest change of the energy   steps that lose entropy");
    for scheme in schemes {
        let run = simulate(scheme)?;
        let start = run.states[0];
        let off = run.states.iter().map(|state| (state[1] - start[1]).abs());
        let off = off.fold(0.0, f64::max);
        // Beyond the rounding of the entropy.
        let least = |s: f64| -2.0 * f64::EPSILON * s.abs();
        let losses = run
            .states
            .windows(2)
            .filter(|two| two[1][2] - two[0][2] < least(two[0][2]));
        let losses = losses.count();
        let time = run.states.last().map_or(0.0, |state| state[0]);
        println!(
            "{:16} {time:6.1} s {:18.1e} J of {:.0} J {losses:19}",
            scheme.name(),
            off,
            start[1]
        );
        if scheme == Scheme::EemTemperature {
            assert!(run.failure.is_none() && off < 1e-12 * start[1] && losses == 0);
        }
        runs.push(run);
    }
    assert!(runs[1..].iter().all(|run| {
        run.failure.is_some()
            || run
                .states
                .iter()
                .any(|s| (s[1] - run.states[0][1]).abs() > 1.0)
    }));

    let file = "target/eem/single_pendulum.svg";
    fs::create_dir_all("target/eem")?;
    draw(file, &runs)?;
    println!("picture: {file}");
    Ok(())
}

/// Changes of energy up to which curves are drawn, J.
const LARGEST: f64 = 100.0;

/// Energy above, entropy below; a cross where a curve ends early.
fn draw(file: &str, runs: &[Run]) -> Result<(), Box<dyn Error>> {
    let root = SVGBackend::new(file, (800, 640)).into_drawing_area();
    root.fill(&WHITE)?;
    let colors = [
        RGBColor(0, 90, 160),
        RGBColor(210, 90, 0),
        RGBColor(120, 120, 120),
    ];
    let charts = [
        (1, "change of the energy (J)", -60.0..LARGEST),
        (2, "entropy grown (J/K)", 0.0..0.5),
    ];
    for (area, (column, label, range)) in root.split_evenly((2, 1)).iter().zip(charts) {
        let mut chart = ChartBuilder::on(area)
            .margin(16)
            .x_label_area_size(36)
            .y_label_area_size(64)
            .build_cartesian_2d(0.0..20.0, range)?;
        chart
            .configure_mesh()
            .light_line_style(WHITE)
            .bold_line_style(RGBColor(225, 225, 225))
            .x_desc("time (s)")
            .y_desc(label)
            .draw()?;
        for (run, color) in runs.iter().zip(colors) {
            let start = run.states[0];
            let is_off = |state: &[f64; 3]| (state[1] - start[1]).abs() > LARGEST;
            let off = run.states.iter().position(is_off);
            let drawn = &run.states[..off.unwrap_or(run.states.len())];
            let points = || {
                drawn
                    .iter()
                    .map(|state| (state[0], state[column] - start[column]))
            };
            let name = match (&run.failure, drawn.last()) {
                (_, Some(end)) if off.is_some() => {
                    format!("{}, lost at {:.1} s", run.scheme.name(), end[0])
                }
                (Some(error), _) => format!("{}, fails at {:.1} s", run.scheme.name(), error.time),
                _ => run.scheme.name().to_owned(),
            };
            let style = color.stroke_width(2);
            chart
                .draw_series(LineSeries::new(points(), style))?
                .label(name)
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 24, y)], style));
            if run.failure.is_some() || off.is_some() {
                chart.draw_series(points().next_back().map(|end| Cross::new(end, 6, style)))?;
            }
        }
        if column == 1 {
            chart
                .configure_series_labels()
                .position(SeriesLabelPosition::LowerRight)
                .border_style(WHITE)
                .background_style(WHITE)
                .draw()?;
        }
    }
    root.present()?;
    Ok(())
}

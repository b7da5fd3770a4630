//! A hot pendulum with three schemes, one of which keeps the laws of thermodynamics: a mass moves in the plane on a spring
//! that starts hot and at three times its natural length. Creep heats the spring; the air cools it.
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
//! Source: García Orden & Romero, Eur. J. Mech. A/Solids 32 (2012), §4.1, with its step of 0.2 s, more than two periods of
//! the fastest vibration. Claim: the energy–entropy–momentum scheme conserves the energy to rounding and never loses
//! entropy; the energy of the midpoint and the trapezoidal rule is wrong by more than 1 J, or a step fails.

use std::error::Error;
use std::fs;

use eem::materials::ThermoViscoElastic;
use eem::prelude::*;
use plotters::prelude::*;

/// Time (s), energy (J) and entropy (J/K).
type State = [f64; 3];

/// The states of a run, until its end or the first step that fails.
struct Run {
    scheme: Scheme,
    states: Vec<State>,
    has_failed: bool,
}

fn pendulum() -> Scene<2> {
    let mut scene = Scene::new();
    let ends = [
        scene.anchor([0.0, 0.0]),
        scene.mass(1.0, [3.0, 0.0], [0.0, 1.0]),
    ];
    let spring = scene.spring(ThermoViscoElastic::PENDULUM, ends);
    scene.set_temperature(spring, 380.0);
    let air = scene.reservoir(300.0);
    scene.conduct(spring, air, 10.0);
    scene
}

fn simulate(scheme: Scheme) -> Result<Run, SceneError> {
    let mut run = Simulation::new(pendulum(), scheme, 0.2)?;
    let mut states = Vec::new();
    let has_failed = loop {
        let now = run.ledger();
        states.push([run.time(), now.energy, now.entropy]);
        if run.time() > 19.9 {
            break false;
        }
        if run.step().is_err() {
            break true;
        }
    };
    Ok(Run {
        scheme,
        states,
        has_failed,
    })
}

fn main() -> Result<(), Box<dyn Error>> {
    println!("scheme            reaches   largest change of the energy   steps that lose entropy");
    let mut runs = Vec::new();
    for scheme in [
        Scheme::EemTemperature,
        Scheme::Midpoint,
        Scheme::Trapezoidal,
    ] {
        let run = simulate(scheme)?;
        let [_, energy, _] = run.states[0];
        let changes = run.states.iter().map(|state| (state[1] - energy).abs());
        let change = changes.fold(0.0, f64::max);
        // Losses larger than the rounding of the entropy.
        let loses = |s: &&[State]| s[1][2] - s[0][2] < -2.0 * f64::EPSILON * s[0][2].abs();
        let losses = run.states.windows(2).filter(loses).count();
        let [end, ..] = run.states[run.states.len() - 1];
        let name = scheme.name();
        println!("{name:16} {end:6.1} s {change:18.1e} J of {energy:.0} J {losses:19}");
        if scheme == Scheme::EemTemperature {
            assert!(!run.has_failed && change < 1e-12 * energy && losses == 0);
        } else {
            assert!(run.has_failed || change > 1.0);
        }
        runs.push(run);
    }
    let file = "target/eem/single_pendulum.svg";
    fs::create_dir_all("target/eem")?;
    draw(file, &runs)?;
    println!("picture: {file}");
    Ok(())
}

/// Changes of energy up to which curves are drawn, J.
const LARGEST: f64 = 100.0;

/// The change of energy over time; a cross marks the early end of a curve.
fn draw(file: &str, runs: &[Run]) -> Result<(), Box<dyn Error>> {
    let root = SVGBackend::new(file, (800, 400)).into_drawing_area();
    root.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&root)
        .margin(16)
        .x_label_area_size(36)
        .y_label_area_size(64)
        .build_cartesian_2d(0.0..20.0, -60.0..LARGEST)?;
    chart
        .configure_mesh()
        .light_line_style(WHITE)
        .bold_line_style(RGBColor(225, 225, 225))
        .x_desc("time (s)")
        .y_desc("change of the energy (J)")
        .draw()?;
    for (run, color) in runs.iter().zip([BLUE, RED, BLACK]) {
        let start = run.states[0][1];
        let points = run.states.iter().map(|state| (state[0], state[1] - start));
        let drawn: Vec<_> = points
            .take_while(|point| point.1.abs() <= LARGEST)
            .collect();
        let (end, _) = drawn[drawn.len() - 1];
        let is_lost = drawn.len() < run.states.len();
        let name = match (is_lost, run.has_failed) {
            (true, _) => format!("{}, lost at {end:.1} s", run.scheme),
            (_, true) => format!("{}, fails at {end:.1} s", run.scheme),
            _ => run.scheme.to_string(),
        };
        let style = color.stroke_width(2);
        if is_lost || run.has_failed {
            let end = drawn[drawn.len() - 1];
            chart.draw_series([Cross::new(end, 6, style)])?;
        }
        chart
            .draw_series(LineSeries::new(drawn, style))?
            .label(name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 24, y)], style));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::LowerRight)
        .border_style(WHITE)
        .background_style(WHITE)
        .draw()?;
    root.present()?;
    Ok(())
}

//! What the derive makes of a free energy: formulas, divided differences, operations.
//!
//! Three published springs in print. From one formula ψ(λ, γ, θ) with the units of its parameters
//! follow, without another line by hand,
//!
//! ```text
//! s = −∂ψ/∂θ,   e = ψ + θ s,   f = ∂ψ/∂λ,   g = −∂ψ/∂γ,   c = θ ∂s/∂θ
//! F[x⁰, x¹] = (F(x¹) − F(x⁰))/(x¹ − x⁰)      for F = ψ, s along λ and γ, F = e, s along θ
//! ```
//!
//! and the functions that compute them. `f[a, b]` in a formula is the divided difference of the
//! function f, `f′(a)` in the limit `b → a`. The discrete derivatives of a step are means of
//! divided differences over the edges between its two states, which is why no formula below has
//! a difference in its denominator.
//!
//! | spring | symbols | units |
//! |---|---|---|
//! | `CreepingSpring` | k0, k1; βt, c; μ0, μ1; βc; η0, a | N m, N m/K; N m/K; N/m, N/(m K); 1; N s/m, K |
//! | `ThermoelasticSpring` | C, β, c | J, J/K, J/K |
//! | `SofteningSpring` | C0, C1, β, c | J, J/K, J/K, J/K |
//! | all | natural length λ0, reference temperature θr | m, K |
//!
//! Sources: `CreepingSpring`, García Orden & Romero, Eur. J. Mech. A/Solids 32 (2012), §4.1;
//! `ThermoelasticSpring`, the double pendulum of Romero (2009) and of Krüger, Groß & Betsch (2011);
//! `SofteningSpring`, Conde Martín, Betsch & García Orden, Commun. Nonlinear Sci. Numer. Simul. 32
//! (2016), §4.2. Nothing moves here: of the options of the other
//! examples there is `--out` only.
//!
//! What the example claims, and fails without: every parameter has a unit, and occurs in ψ or in a
//! viscosity; every spring has all formulas of its kind.

use std::error::Error;
use std::fs;
use std::path::PathBuf;
use std::process::ExitCode;

use eem::Description;
use eem::prelude::*;

use eem_studies::claims::{self, Claims};
use eem_studies::{command_line, output, terminal};

const ABOUT: &str = "The formulas, units and operation counts of three published springs";
const HINT: &str = "Add --out DIR for one text file per spring.";

/// Nonlinear in length and temperature, viscous, softening when hot.
#[derive(Clone, Debug, FreeEnergy)]
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

/// Of constant stiffness; cools when it is stretched.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let strain = ln(lambda / natural_length);
    0.5 * stiffness * strain.powi(2)
        - coupling * (theta - theta_ref) * strain
        + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
})]
struct ThermoelasticSpring {
    #[unit("J")]
    stiffness: f64,
    #[unit("J/K")]
    coupling: f64,
    #[unit("J/K")]
    capacity: f64,
    #[unit("m")]
    natural_length: f64,
    #[unit("K")]
    theta_ref: f64,
}

/// Stiffness logarithmic in the temperature.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let strain = ln(lambda / natural_length);
    let current_stiffness = stiffness - softening * theta_ref * ln(theta / theta_ref);
    0.5 * current_stiffness * strain.powi(2)
        - coupling * (theta - theta_ref) * strain
        + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
})]
struct SofteningSpring {
    #[unit("J")]
    stiffness: f64,
    #[unit("J/K")]
    softening: f64,
    #[unit("J/K")]
    coupling: f64,
    #[unit("J/K")]
    capacity: f64,
    #[unit("m")]
    natural_length: f64,
    #[unit("K")]
    theta_ref: f64,
}

const SPRINGS: [Description; 3] = [
    CreepingSpring::DESCRIPTION,
    ThermoelasticSpring::DESCRIPTION,
    SofteningSpring::DESCRIPTION,
];

/// Options of this example, which steps nothing.
#[derive(Clone, Debug, clap::Parser)]
struct Options {
    /// Directory for a text file per spring; created when missing.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

fn main() -> ExitCode {
    claims::verdict(run(&command_line::read(ABOUT)))
}

fn run(options: &Options) -> Result<Claims, Box<dyn Error>> {
    for spring in &SPRINGS {
        terminal::say(spring);
    }
    match &options.out {
        None => terminal::say(HINT),
        Some(directory) => {
            output::prepare(directory)?;
            for spring in &SPRINGS {
                let path = directory.join(format!("{}.txt", spring.name));
                fs::write(path, spring.to_string())?;
            }
            terminal::say(format_args!("Descriptions: {}", directory.display()));
        }
    }
    let mut claims = Claims::default();
    for spring in &SPRINGS {
        check(&mut claims, spring);
    }
    Ok(claims)
}

fn check(claims: &mut Claims, spring: &Description) {
    let name = spring.name;
    let laws = ["ψ", "η"].map(|symbol| spring.equation(symbol).unwrap_or_default());
    for parameter in spring.parameters {
        let occurs = laws.iter().any(|law| law.contains(parameter.name));
        let parameter_name = parameter.name;
        claims.holds(occurs, format!("{name}: {parameter_name} is in no formula"));
        let has_unit = parameter.unit.is_some();
        claims.holds(has_unit, format!("{name}: {parameter_name} has no unit"));
    }
    let is_viscous = spring.arguments.iter().any(|a| a.role == "Viscous");
    let thermoelastic = ["ψ", "s", "e", "f", "c", "ψ[lambda]", "e[theta]", "s[theta]"];
    let viscous: &[&str] = if is_viscous {
        &["g", "η", "ψ[gamma]"]
    } else {
        &[]
    };
    for symbol in thermoelastic.iter().chain(viscous) {
        let exists = spring.equation(symbol).is_some();
        claims.holds(exists, format!("{name} has no formula for {symbol}"));
    }
}

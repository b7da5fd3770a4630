//! The pendulum and the plate of the tests of the package, run by the library without Python.
//!
//! ```text
//! reference bits        bits of positions and temperatures; tests/bits.txt is what it prints
//! reference steps       seconds for 100 000 steps
//! reference ensemble    seconds for 1 000 pendulums with 1 000 steps each
//! ```

use std::error::Error;
use std::time::Instant;

use eem::prelude::*;
use eem::typed::{Law, Source, compile};
use eem_solids::Solids;

/// The parameters of rubber with their units and values.
const RUBBER: [(&str, &str, f64); 8] = [
    ("l", "m", 1.0),
    ("k", "J", 100.0),
    ("k1", "J", 20.0),
    ("beta", "J/K", 4.0),
    ("c", "J/K", 1.0),
    ("t0", "K", 300.0),
    ("eta", "N s/m", 5.0),
    ("a", "K", 10.0),
];

fn rubber() -> Result<Law, Box<dyn Error>> {
    let source = Source::new(
        "|lambda: Stretch, gamma: Viscous, theta: Temperature| {
            let e = ln(lambda / l);
            0.5 * k * e.powi(2) + 0.5 * k1 * (e - gamma / l).powi(2) - beta * (theta - t0) * e
                + c * (theta - t0 - theta * ln(theta / t0))
        }",
    )
    .viscosity("gamma", "eta * exp(a / theta)");
    let source = RUBBER.iter().fold(source, |source, (name, unit, _)| {
        source.parameter(*name, Some(unit))
    });
    let values = RUBBER.map(|(name, _, value)| (name, value));
    Ok(Law::new(compile(&source)?, &values)?)
}

fn pendulum(law: &Law) -> Result<(Scene<2>, Node, Element), Box<dyn Error>> {
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [3.0, 0.0], [0.0, 1.0]);
    let spring = law.add_spring(&mut scene, [pivot, bob])?;
    scene.set_temperature(spring, 380.0);
    let air = scene.reservoir(300.0);
    scene.conduct(spring, air, 10.0);
    Ok((scene, bob, spring))
}

/// The parameters of a thermoelastic solid.
const METAL: [(&str, &str, f64); 5] = [
    ("lame", "Pa", 2000.0),
    ("mu", "Pa", 1000.0),
    ("beta", "Pa/K", 3.0),
    ("c", "J/(K m^3)", 100.0),
    ("t0", "K", 300.0),
];

/// A plate of six cells that tumbles and conducts, held at no node; with its last node and point.
fn plate() -> Result<(Scene<2>, Node, Element), Box<dyn Error>> {
    let source = Source::new(
        "|e1: StrainTrace, e2: StrainSquare, theta: Temperature| {
            0.5 * lame * e1.powi(2) + mu * e2 - beta * (theta - t0) * e1
                + c * (theta - t0 - theta * ln(theta / t0))
        }",
    );
    let source = METAL.iter().fold(source, |source, (name, unit, _)| {
        source.parameter(*name, Some(unit))
    });
    let values = METAL.map(|(name, _, value)| (name, value));
    let law = Law::new(compile(&source)?, &values)?;
    let mut scene = Scene::<2>::new();
    let mesh = Mesh::<Quad4, 2>::block([3, 2], [[0.0, 3.0], [0.0, 2.0]])?;
    let cells = mesh.cells().concat();
    let bulk = Bulk::new(10.0).conductivity(5.0);
    let (nodes, points) = scene
        .add_solid(&law, mesh.nodes().to_vec(), &cells, (bulk, 0.5))
        .map_err(|refused| format!("{refused:?}"))?;
    for (&node, &[x, y]) in nodes.iter().zip(mesh.nodes()) {
        scene.set_velocity(node, [0.25 * x - 2.0 * y, 2.0 * x]);
    }
    for (index, &point) in (0_u8..).zip(&points) {
        scene.set_temperature(point, 300.0 + f64::from(index));
    }
    Ok((scene, nodes[nodes.len() - 1], points[points.len() - 1]))
}

/// A number that tells elementary functions apart whose last bits differ.
fn fingerprint() -> Result<u64, Box<dyn Error>> {
    let arguments: Vec<_> = (1..=1000).map(|k| 0.1 * f64::from(k)).collect();
    let mut all = 0_u64;
    for psi in ["|x: Stretch| exp(0.1 * x)", "|x: Stretch| x * ln(x)"] {
        let law = Law::new(compile(&Source::new(psi))?, &[])?;
        for value in law.free_energies(&arguments)? {
            all = all.rotate_left(7) ^ value.to_bits();
        }
    }
    Ok(all)
}

/// Prints every tenth of 100 steps.
fn print(
    name: &str,
    scheme: Scheme,
    (scene, node, element): (Scene<2>, Node, Element),
) -> Result<(), Box<dyn Error>> {
    let mut run = Simulation::new(scene, scheme, 0.01)?;
    for step in 1..=100 {
        run.step()?;
        if step % 10 == 0 {
            let q = run.position(node)?.map(f64::to_bits);
            let theta = run.temperature(element)?.to_bits();
            println!(
                "{name} {scheme} {step} {:016x} {:016x} {theta:016x}",
                q[0], q[1]
            );
        }
    }
    Ok(())
}

/// The pendulum with five schemes, and the plate with three.
fn bits() -> Result<(), Box<dyn Error>> {
    println!("functions {:016x}", fingerprint()?);
    let law = rubber()?;
    for scheme in [
        Scheme::EemTemperature,
        Scheme::EemEntropy,
        Scheme::EemEntropy4,
        Scheme::EemExplicit,
        Scheme::Midpoint,
    ] {
        print("pendulum", scheme, pendulum(&law)?)?;
    }
    for scheme in [
        Scheme::EemTemperature,
        Scheme::EemEntropy,
        Scheme::EemEntropy4,
    ] {
        print("plate", scheme, plate()?)?;
    }
    Ok(())
}

fn steps() -> Result<(), Box<dyn Error>> {
    let (scene, ..) = pendulum(&rubber()?)?;
    let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.01)?;
    run.run_until(1.0)?;
    let start = Instant::now();
    run.run_until(1001.0)?;
    println!("{}", start.elapsed().as_secs_f64());
    Ok(())
}

fn ensemble() -> Result<(), Box<dyn Error>> {
    let law = rubber()?;
    let start = Instant::now();
    let stiffnesses: Vec<_> = (0..1000).map(|k| 90.0 + 0.02 * f64::from(k)).collect();
    let laws = stiffnesses.iter().map(|&k| law.with_values(&[("k", k)]));
    let laws: Vec<_> = laws.collect::<Result<_, _>>()?;
    let places = Ensemble::new(Scheme::EemTemperature, 0.01).run(
        &laws,
        // A law that made no spring leaves the scene without one, and the run below finds no node.
        |law| {
            pendulum(law).map_or_else(
                |_| (Scene::new(), None),
                |(scene, bob, _)| (scene, Some(bob)),
            )
        },
        |run, bob, _| {
            run.run_until(10.0)?;
            let bob = bob.ok_or_else(|| eem::MemberFailure::other("the law makes no spring"))?;
            Ok(run.position(bob)?[0])
        },
    );
    for place in places {
        place?;
    }
    println!("{}", start.elapsed().as_secs_f64());
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    match std::env::args().nth(1).as_deref() {
        Some("bits") => bits(),
        Some("steps") => steps(),
        Some("ensemble") => ensemble(),
        _ => Err("say what: bits, steps or ensemble".into()),
    }
}

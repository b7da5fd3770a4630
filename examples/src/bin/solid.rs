//! A block of rubber that is heated on one side; writes files for `ParaView`.
//!
//! ```text
//! ψ = ½ Λ e1² + μ e2 − 3 α K (θ − θr) e1 + c (θ − θr − θ ln(θ/θr))     e1 = tr E, e2 = E:E
//! ```
//!
//! The bottom is fixed, a plate of 400 K heats the left side, heat flows through the block, and the block bends. Claim: the
//! energy of block and plate is constant to rounding, and their entropy grows.

use eem::VtkSeries;
use eem::kinematics::Hex8;
use eem::prelude::*;

#[derive(Clone, FreeEnergy)]
#[free_energy(|e1: StrainTrace, e2: StrainSquare, theta: Temperature| {
    let heating = theta - theta_ref;
    0.5 * lame * e1.powi(2) + mu * e2 - 3 * expansion * bulk * heating * e1
        + capacity * (heating - theta * ln(theta / theta_ref))
})]
struct Rubber {
    #[unit("Pa")]
    lame: f64,
    #[unit("Pa")]
    mu: f64,
    #[unit("1/K")]
    expansion: f64,
    #[unit("Pa")]
    bulk: f64,
    #[unit("J/(K m^3)")]
    capacity: f64,
    #[unit("K")]
    theta_ref: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let rubber = Rubber {
        lame: 2e6,
        mu: 1e6,
        expansion: 2e-4,
        bulk: 2.67e6,
        capacity: 2e6,
        theta_ref: 300.0,
    };
    let mesh = Mesh::<Hex8, 3>::block([4, 2, 6], [[0.0, 0.04], [0.0, 0.02], [0.0, 0.1]])?;
    let mut scene = Scene::<3>::new();
    let block = scene.solid(rubber, &mesh, &Bulk::new(1100.0).conductivity(0.5));
    for &point in block.points() {
        scene.set_temperature(point, 300.0);
    }
    for node in block.nodes_where(|[_, _, z]| z <= 0.0) {
        scene.fix(node);
    }
    let left = mesh.face(|[x, ..]| x <= 0.0)?;
    let plate = scene.reservoir(400.0);
    scene.exchange(&block, &left, plate, 200.0); // W/(m² K)

    let folder = std::path::Path::new("target/eem/solid");
    let mut files = VtkSeries::new(&scene, folder, "block");
    let mut run = Simulation::new(scene, Scheme::EemTemperature, 5.0)?;
    let start = run.ledger();
    files.write(&run)?;
    for _ in 0..12 {
        run.run_until(run.time() + 25.0)?;
        files.write(&run)?;
    }
    let end = run.ledger();

    let temperatures = block.points().iter().map(|&point| run.temperature(point));
    let temperatures = temperatures.collect::<Result<Vec<_>, _>>()?;
    let coldest = temperatures
        .iter()
        .fold(f64::INFINITY, |least, &theta| least.min(theta));
    let hottest = temperatures
        .iter()
        .fold(0.0_f64, |most, &theta| most.max(theta));
    println!(
        "after {} s the block has {coldest:.1} to {hottest:.1} K",
        run.time()
    );
    println!(
        "energy of block and plate has changed by {:.1e} J",
        end.energy - start.energy
    );
    println!(
        "their entropy has grown by {:.3} J/K",
        end.entropy - start.entropy
    );
    println!("files for ParaView are in {}", folder.display());
    // The energies are rounded relative to the heat c θ V of the block.
    assert!((end.energy - start.energy).abs() < 1e-13 * 2e6 * 300.0 * 8e-5);
    assert!(end.entropy > start.entropy);
    assert!(hottest < 400.0 && coldest > 300.0);
    Ok(())
}

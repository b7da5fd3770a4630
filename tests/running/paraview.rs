//! Files for ParaView say what the simulation says. `tests/paraview.py` opens those that this leaves behind.

use std::fs;
use std::path::Path;

use eem::kinematics::Hex8;
use eem::nalgebra::SVector;
use eem::prelude::*;
use eem::{SolidState, VtkSeries};

use crate::support::solids::{Relaxing, SECTION, ThermoelasticSolid};
use crate::support::{ThermoViscoElastic, hencky};

/// The numbers of an array of a file.
fn array(text: &str, name: &str) -> Vec<f64> {
    let (_, rest) = text.split_once(&format!("Name=\"{name}\"")).unwrap();
    let (_, rest) = rest.split_once('>').unwrap();
    let (numbers, _) = rest.split_once('<').unwrap();
    let numbers = numbers.split_whitespace();
    numbers.map(|number| number.parse().unwrap()).collect()
}

#[test]
fn files_have_all_digits_of_every_state() {
    let mut scene = Scene::<2>::new();
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let nodes = corners.map(|at| scene.node(at, [-at[1], at[0]]));
    let points = scene.quadrilateral(ThermoelasticSolid::RUBBER, nodes, SECTION);
    for (at, point) in (0..).zip(points) {
        scene.set_temperature(point, 300.0 + f64::from(at));
    }
    let bob = scene.mass(1.0, [2.0, 1.0], [0.0, 1.0]);
    let damper = scene.spring(ThermoViscoElastic::PENDULUM, [nodes[2], bob]);
    scene.set_temperature(damper, 320.0);
    let spring = scene.spring(hencky(10.0, 1.0), [nodes[1], bob]);
    scene.conduct(damper, points[2], 2.0);
    let alone = scene.mass(2.0, [4.0, 0.0], [0.5, 0.0]);

    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("paraview");
    let mut series = VtkSeries::new(&scene, &folder, "a \"solid\" & springs");
    let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.05).unwrap();
    series.write(&run).unwrap();
    for frame in 1..=3 {
        run.run_until(0.1 * f64::from(frame)).unwrap();
        series.write(&run).unwrap();
    }

    let file = folder.join("a \"solid\" & springs_00003.vtu");
    let text = fs::read_to_string(file).unwrap();
    let same = |name: &str, expected: &[f64]| {
        let found = array(&text, name);
        let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&found), bits(expected), "{name}: {found:?}");
    };
    let in_space = |q: SVector<f64, 2>| [q[0], q[1], 0.0];
    let all = [nodes[0], nodes[1], nodes[2], nodes[3], bob, alone];
    let positions = all.map(|node| in_space(run.position(node).unwrap()));
    same("position", positions.as_flattened());
    let velocities = all.map(|node| in_space(run.velocity(node).unwrap()));
    same("velocity", velocities.as_flattened());
    let theta = |element| run.temperature(element).unwrap();
    let mean = points.iter().map(|&point| theta(point)).sum::<f64>() / 4.0;
    same("temperature", &[mean, theta(damper), f64::NAN, f64::NAN]);
    let stretch = |element| run.stretch(element).unwrap();
    same(
        "stretch",
        &[f64::NAN, stretch(damper), stretch(spring), f64::NAN],
    );
    let produced = |element| run.entropy_production(element).unwrap();
    let solid = points.iter().map(|&point| produced(point)).sum();
    same(
        "entropy_production",
        &[solid, produced(damper), f64::NAN, f64::NAN],
    );
    let states = points.map(|point| run.solid_state(point).unwrap());
    let stress = states.iter().map(SolidState::von_mises).sum::<f64>() / 4.0;
    same("von_mises", &[stress, f64::NAN, f64::NAN, f64::NAN]);
    let growth = states.iter().map(|state| state.dilatation).sum::<f64>() / 4.0;
    same("dilatation", &[growth, f64::NAN, f64::NAN, f64::NAN]);
    // 11, 22, 33, 12, 23, 13.
    let places = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)];
    for (name, tensor) in [
        ("stress", states.map(|state| state.stress)),
        ("strain", states.map(|state| state.strain)),
    ] {
        let mean = places.map(|place| tensor.iter().map(|t| t[place]).sum::<f64>() / 4.0);
        same(
            name,
            [mean, [f64::NAN; 6], [f64::NAN; 6], [f64::NAN; 6]].as_flattened(),
        );
    }
    assert!(!text.contains("viscous_strain"));
    same(
        "connectivity",
        &[0.0, 1.0, 2.0, 3.0, 2.0, 4.0, 1.0, 4.0, 5.0],
    );
    same("offsets", &[4.0, 6.0, 8.0, 9.0]);
    same("types", &[9.0, 3.0, 3.0, 1.0]);

    let list = fs::read_to_string(folder.join("a \"solid\" & springs.pvd")).unwrap();
    assert_eq!(list.matches("<DataSet").count(), 4);
    assert!(list.contains("file=\"a &quot;solid&quot; &amp; springs_00003.vtu\""));
}

/// The strain within a Maxwell branch is a tensor of its own.
#[test]
fn viscous_strains_are_written_where_there_are_any() {
    let mesh = Mesh::<Hex8, 3>::block([1; 3], [[0.0, 1.0]; 3]).unwrap();
    let mut scene = Scene::<3>::new();
    let body = scene.solid(Relaxing::RUBBER, &mesh, &Bulk::new(10.0));
    let strain = [[0.2, 0.1, 0.0], [0.1, -0.2, 0.0], [0.0; 3]];
    for &point in body.points() {
        scene.set_viscous_strain(point, strain);
        scene.set_temperature(point, 300.0);
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("paraview");
    let mut series = VtkSeries::new(&scene, &folder, "viscous");
    series
        .write(&Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap())
        .unwrap();
    let text = fs::read_to_string(folder.join("viscous_00000.vtu")).unwrap();
    let found = array(&text, "viscous_strain");
    for (found, expected) in found.iter().zip([0.2, -0.2, 0.0, 0.1, 0.0, 0.0]) {
        assert!((found - expected).abs() < 1e-15, "{found} {expected}");
    }
    assert_eq!(found.len(), 6);
}

#[test]
fn a_run_of_another_scene_is_refused() {
    let mut scene = Scene::<1>::new();
    scene.mass(1.0, [0.0], [0.0]);
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("nothing");
    let mut series = VtkSeries::new(&scene, &folder, "other");
    let mut other = Scene::<1>::new();
    other.mass(1.0, [0.0], [0.0]);
    let run = Simulation::new(other, Scheme::EemEntropy, 0.1).unwrap();
    let error = series.write(&run).unwrap_err();
    assert_eq!(error.to_string(), "node 0 belongs to another scene");
    assert!(!folder.exists());
}

/// What is wrong with a series is said before anything is written.
#[test]
fn names_are_of_files_and_scenes_are_complete() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("refused series");
    let written = |folder: &Path, name: &str, more: bool| {
        let mut scene = Scene::<1>::new();
        scene.mass(1.0, [0.0], [0.0]);
        let mut series = VtkSeries::new(&scene, folder, name);
        if more {
            scene.mass(1.0, [1.0], [0.0]);
        }
        let run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
        series.write(&run)?;
        series.write(&run)
    };
    for name in ["", "../name", "a/b", "a\\b"] {
        let error = written(&folder, name, false).unwrap_err().to_string();
        assert!(
            error.starts_with(&format!("`{name}` is no name of a series")),
            "{error}"
        );
    }
    assert_eq!(
        written(&folder, "late", true).unwrap_err().to_string(),
        "the series has 1 nodes and 0 elements, and the simulation 2 and 0: make the series when everything is in the \
         scene"
    );
    assert!(!folder.exists());
    // A file is no folder; what is wrong with it names it.
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("no folder");
    fs::write(&file, "").unwrap();
    let inside = file.join("inside");
    let error = written(&inside, "name", false).unwrap_err().to_string();
    assert!(
        error.starts_with(&format!("`{}`: ", inside.display())),
        "{error}"
    );
    let error = written(Path::new(env!("CARGO_TARGET_TMPDIR")), "nul\0", false).unwrap_err();
    assert!(error.to_string().contains("nul\0_00000.vtu`: "), "{error}");

    assert!(written(&folder, "once", false).is_ok());
    let error = written(&folder.join("../refused series"), "once", false).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("already that of another series of this program"),
        "{error}"
    );
    assert!(written(&folder, "twice", false).is_ok());
    fs::remove_dir_all(folder).unwrap();
}

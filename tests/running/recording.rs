//! A recorder keeps what the simulation says, and gives it back bit for bit.

use eem::prelude::*;
use eem::{Column, RecordError};

use crate::support::{Pendulum, single_pendulum};

#[test]
fn columns_hold_what_the_simulation_says() {
    let Pendulum {
        mut run,
        bob,
        spring,
        air,
    } = single_pendulum(Scheme::EemEntropy, 0.1);
    let start = run.ledger();
    let quantities = [
        ("q", Quantity::Position(bob)),
        ("p", Quantity::Momentum(bob)),
        ("v", Quantity::Velocity(bob)),
        ("stretch", Quantity::Stretch(spring)),
        ("force", Quantity::Force(spring)),
        ("e", Quantity::InternalEnergy(spring)),
        ("theta", Quantity::Temperature(spring)),
        ("s", Quantity::Entropy(spring)),
        ("gamma", Quantity::ViscousStretch(spring, 0)),
        ("sigma", Quantity::ReservoirEntropy(air)),
        ("heat", Quantity::ReservoirHeat(air)),
        ("E", Quantity::TotalEnergy),
        ("S", Quantity::TotalEntropy),
        ("P", Quantity::LinearMomentum),
        ("L", Quantity::AngularMomentum),
        ("T", Quantity::Ledger(|ledger| ledger.kinetic_energy)),
        ("iterations", Quantity::NewtonIterations),
        ("twice the time", Quantity::custom(|run| 2.0 * run.time())),
    ];
    let mut recorder = Recorder::new(&run, quantities).unwrap().every(4);
    recorder.reserve(10);
    let mut iterations = Vec::new();
    let end = run.run_until_with(1.0, |run, report| {
        iterations.push(report.iterations);
        recorder.observe(run, report)
    });
    assert_eq!(end.unwrap(), RunEnd::Reached);
    // The initial state, steps 4 and 8, and the end, which is not yet due.
    assert_eq!(recorder.rows(), 3);
    recorder.record(&run).unwrap();
    assert_eq!(recorder.rows(), 4);
    let names: Vec<_> = recorder.columns().iter().map(Column::name).collect();
    let expected = "time q_x q_y p_x p_y v_x v_y stretch force e theta s gamma sigma heat E S P_x P_y L T iterations";
    assert_eq!(names[..22].join(" "), expected);
    assert_eq!(names[22..], ["twice the time"]);
    let last = |name: &str| recorder.column(name).unwrap()[3];
    let row = Pendulum {
        run,
        bob,
        spring,
        air,
    }
    .row();
    let names = ["q_x", "q_y", "p_x", "p_y", "theta", "gamma", "sigma"];
    assert_eq!(
        names.map(|name| last(name).to_bits()),
        row.map(f64::to_bits)
    );
    approx::assert_relative_eq!(last("twice the time"), 2.0);
    approx::assert_relative_eq!(last("heat"), 300.0 * last("sigma"));
    approx::assert_relative_eq!(last("E"), start.energy, max_relative = 4e-15);
    approx::assert_relative_eq!(last("L"), start.angular_momentum[2], max_relative = 1e-14);
    let sums: Vec<_> = [0..0, 0..4, 4..8, 8..10]
        .map(|steps| iterations[steps].iter().sum::<usize>())
        .map(|sum| f64::from(u32::try_from(sum).unwrap()))
        .into();
    assert_eq!(recorder.column("iterations"), Some(sums.as_slice()));
}

#[test]
fn a_row_that_closes_a_run_is_not_kept_twice() {
    let Pendulum {
        mut run, spring, ..
    } = single_pendulum(Scheme::EemEntropy, 0.1);
    let quantities = [
        ("theta", Quantity::Temperature(spring)),
        ("iterations", Quantity::NewtonIterations),
    ];
    let mut recorder = Recorder::new(&run, quantities).unwrap().every(5);
    run.run_until_with(1.0, |run, report| recorder.observe(run, report))
        .unwrap();
    let iterations = recorder.column("iterations").unwrap().to_vec();
    recorder.record(&run).unwrap();
    recorder.record(&run).unwrap();
    assert_eq!(recorder.rows(), 3);
    assert_eq!(recorder.column("iterations"), Some(iterations.as_slice()));
    run.step().unwrap();
    recorder.record(&run).unwrap();
    assert_eq!(recorder.rows(), 4);
}

#[test]
fn recorders_refuse_what_a_simulation_does_not_have() {
    let pendulum = single_pendulum(Scheme::EemEntropy, 0.1);
    let other = single_pendulum(Scheme::EemEntropy, 0.1);
    let new = |name: &str, quantity| Recorder::new(&pendulum.run, [(name, quantity)]).unwrap_err();
    let error = new("q", Quantity::Position(other.bob));
    assert_eq!(
        error.to_string(),
        "quantity `q`: node 1 belongs to another scene"
    );
    let error = new("gamma", Quantity::ViscousStretch(pendulum.spring, 1));
    assert_eq!(
        error.to_string(),
        "quantity `gamma`: element 0 (ThermoViscoElastic) has 1 dashpot, there is no dashpot 1"
    );
    let error = new("time", Quantity::TotalEnergy);
    let name = "time".to_owned();
    assert_eq!(error, RecordError::DuplicateColumn { name });

    let quantities = [("q", Quantity::Position(pendulum.bob))];
    let mut recorder = Recorder::new(&pendulum.run, quantities).unwrap();
    let mut stranger = other.run;
    let end = stranger.run_until_with(1.0, |run, report| recorder.observe(run, report));
    assert_eq!(end.unwrap(), RunEnd::Stopped);
    let error = recorder.record(&stranger).unwrap_err();
    assert!(matches!(error, SceneError::ForeignHandle { .. }));
    assert!(
        recorder
            .columns()
            .iter()
            .all(|column| column.values().len() == 1)
    );
}

#[cfg(feature = "csv")]
#[test]
fn csv_gives_back_every_bit() {
    let Pendulum { mut run, bob, .. } = single_pendulum(Scheme::EemEntropy, 0.1);
    let quantities = [
        ("q", Quantity::Position(bob)),
        ("energy, total", Quantity::TotalEnergy),
        ("iterations", Quantity::NewtonIterations),
    ];
    let mut recorder = Recorder::new(&run, quantities).unwrap();
    run.run_until_with(0.2, |run, report| recorder.observe(run, report))
        .unwrap();
    let mut bytes = Vec::new();
    recorder.write_csv(&mut bytes).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    println!("{text}");
    let mut lines = text.lines();
    assert_eq!(
        lines.next(),
        Some("time (s),q_x (m),q_y (m),\"energy, total (J)\",iterations")
    );
    let first = lines.next().unwrap();
    assert!(first.starts_with("0.0000000000000000e0,3.0000000000000000e0,0.0000000000000000e0,"));
    assert!(first.ends_with(",0"));
    for (row, line) in (1..).zip(lines) {
        let values = line.split(',').map(|cell| cell.parse::<f64>().unwrap());
        let columns = recorder.columns().iter();
        let expected = columns.map(|column| column.values()[row].to_bits());
        assert!(values.map(f64::to_bits).eq(expected), "{line}");
    }
    assert_eq!(text.lines().count(), 1 + recorder.rows());
}

#[cfg(feature = "csv")]
#[test]
fn the_file_of_a_resumed_run_is_that_of_an_uninterrupted_one() {
    let quantities = |bob| {
        [
            ("q", Quantity::Position(bob)),
            ("entropy", Quantity::TotalEntropy),
            ("iterations", Quantity::NewtonIterations),
        ]
    };
    let Pendulum { mut run, bob, .. } = single_pendulum(Scheme::EemEntropy, 0.1);
    let mut recorder = Recorder::new(&run, quantities(bob)).unwrap().every(2);
    run.run_until_with(0.6, |run, report| recorder.observe(run, report))
        .unwrap();
    let mut text = Vec::new();
    recorder.write_csv(&mut text).unwrap();
    let saved = run.checkpoint();
    run.run_until_with(1.4, |run, report| recorder.observe(run, report))
        .unwrap();
    let mut whole = Vec::new();
    recorder.write_csv(&mut whole).unwrap();

    let Pendulum { mut run, bob, .. } = single_pendulum(Scheme::EemEntropy, 0.1);
    run.restore(&saved).unwrap();
    let mut recorder = Recorder::new(&run, quantities(bob)).unwrap().every(2);
    run.run_until_with(1.4, |run, report| recorder.observe(run, report))
        .unwrap();
    recorder.append_csv(&mut text).unwrap();
    assert_eq!(String::from_utf8(text), String::from_utf8(whole));
}

#[test]
fn a_recorder_is_for_one_scene_and_not_for_its_copies() {
    let mut scene = Scene::<1>::new();
    let mass = scene.mass(1.0, [0.0], [1.0]);
    let mut copy = Simulation::new(scene.clone(), Scheme::EemEntropy, 0.1).unwrap();
    let run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
    let mut recorder = Recorder::new(&run, [("q", Quantity::Position(mass))]).unwrap();
    let end = copy.run_until_with(1.0, |run, report| recorder.observe(run, report));
    assert_eq!((end.unwrap(), recorder.rows()), (RunEnd::Stopped, 1));
    let error = recorder.record(&copy).unwrap_err();
    assert_eq!(error.to_string(), "the recorder belongs to another scene");
}

//! The bits of a merged table depend on the inputs alone.

use std::fs;
use std::path::Path;

use eem::prelude::*;
use eem::sweep::{Format, Inputs, Plan, RunOptions, Selection};

use crate::program::{STEP, Stone, contents, directory, finish, inputs, start, stones};

const MEMBERS: usize = 103;
const STEPS: usize = 20;

/// The merged table after `count` shards with these options.
fn merged(name: &str, count: u64, options: &RunOptions) -> Vec<u8> {
    let directory = directory(name);
    for index in (0..count).rev() {
        let selection = Selection::Shard { index, count };
        let options = RunOptions {
            selection,
            ..options.clone()
        };
        stones(MEMBERS, STEPS).run(&directory, &options).unwrap();
    }
    let merged = stones(MEMBERS, STEPS).merge(&directory, None).unwrap();
    assert_eq!((merged.members, merged.failed), (MEMBERS, 0));
    assert_eq!((merged.superseded, merged.repeated), (0, 0));
    fs::read(merged.path).unwrap()
}

fn rows(table: &[u8]) -> Vec<Vec<String>> {
    let mut reader = csv::Reader::from_reader(table);
    let rows = reader.records().map(Result::unwrap);
    rows.map(|row| row.iter().map(str::to_owned).collect())
        .collect()
}

#[test]
fn shards_threads_and_batches_do_not_change_a_bit_of_the_plain_ensemble() {
    let one = merged("bits-1", 1, &RunOptions::default());
    for count in [2, 8] {
        for (threads, batch) in [(1, None), (2, Some(5)), (0, Some(1))] {
            let options = RunOptions {
                threads,
                batch,
                ..RunOptions::default()
            };
            let several = merged("bits-several", count, &options);
            assert!(
                several == one,
                "{count} shards, {threads} threads, {batch:?}"
            );
        }
    }
    let inputs = inputs(MEMBERS);
    let mut values = Vec::new();
    let values: Vec<[f64; 2]> = (0..MEMBERS)
        .map(|place| inputs.row(place, &mut values).values().try_into().unwrap())
        .collect();
    let ends = Ensemble::new(Scheme::EemEntropy, STEP);
    let stone = Stone { steps: STEPS };
    let ends = ends.run(&values, Stone::build, |run, node, _| {
        stone.observe(run, node)
    });
    let rows = rows(&one);
    assert_eq!(rows.len(), MEMBERS);
    for (id, (row, (input, end))) in rows.iter().zip(values.iter().zip(ends)).enumerate() {
        let end = end.unwrap();
        assert_eq!(
            (row[0].as_str(), row[1].as_str()),
            (id.to_string().as_str(), "")
        );
        let numbers: Vec<u64> = row[2..6]
            .iter()
            .map(|cell| cell.parse::<f64>().unwrap().to_bits())
            .collect();
        let expected = [input[0], input[1], end.height, end.energy].map(f64::to_bits);
        assert_eq!(numbers, expected);
    }
}

#[test]
fn overlapping_processes_repeat_members_with_the_same_bits() {
    let one = merged("bits-whole", 1, &RunOptions::default());
    let (first, second) = (directory("bits-a"), directory("bits-b"));
    let sweep = stones(MEMBERS, STEPS);
    let of = |selection| RunOptions {
        selection,
        batch: Some(7),
        ..RunOptions::default()
    };
    sweep.run(&first, &of(Selection::Range(0..60))).unwrap();
    // What runs at the same time does not see the parts of the other.
    sweep.run(&second, &of(Selection::Range(40..103))).unwrap();
    for (path, bytes) in contents(&second.join("parts")) {
        fs::write(first.join("parts").join(path.file_name().unwrap()), bytes).unwrap();
    }
    let merged = sweep.merge(&first, None).unwrap();
    assert_eq!(merged.repeated, 20);
    assert!(fs::read(merged.path).unwrap() == one);
    let status = sweep.status(&first).unwrap();
    assert_eq!((status.reported, status.repeated), (MEMBERS, 20));
    // A list with gaps fills the holes of another.
    let third = directory("bits-c");
    let even = Selection::Members((0..103).step_by(2).collect());
    assert_eq!(sweep.run(&third, &of(even)).unwrap().ran, 52);
    let report = sweep.run(&third, &of(Selection::All)).unwrap();
    assert_eq!((report.skipped, report.ran), (52, 51));
    let merged = sweep.merge(&third, None).unwrap();
    assert!(fs::read(merged.path).unwrap() == one);
}

#[test]
fn plain_processes_divide_a_sweep_by_a_command_line() {
    let one = merged("bits-line-1", 1, &RunOptions::default());
    let folder = directory("bits-line");
    let dir = folder.to_str().unwrap();
    let head = [MEMBERS.to_string(), STEPS.to_string()];
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    let line = |rest: &[&'static str]| [&head, rest, &["--dir", dir]].concat();
    let shards = ["0/3", "1/3", "2/3"];
    let processes = shards.map(|shard| start(&line(&["run", "--shard", shard])));
    for mut process in processes {
        assert!(process.wait().unwrap().success());
    }
    let (code, said) = finish(&line(&["run", "--range", "50..60"]));
    assert!(code == 0 && said.contains("10 were there, 0 run"), "{said}");
    let (code, said) = finish(&line(&["status"]));
    assert!(code == 0 && said.contains("103 of 103"), "{said}");
    let (code, said) = finish(&line(&["merge"]));
    assert!(code == 0 && said.contains("none missing"), "{said}");
    assert!(fs::read(folder.join("merged.csv")).unwrap() == one);
    let (code, said) = finish(&line(&["run", "--shard", "3/3"]));
    assert!(code == 2 && said.contains("2/3"), "{said}");
}

#[test]
#[cfg(feature = "arrow")]
fn arrow_has_the_numbers_of_csv_and_the_same_bytes_from_any_shards() {
    let options = |batch| RunOptions {
        format: Some(Format::Arrow),
        batch,
        ..RunOptions::default()
    };
    let one = merged("bits-arrow-1", 1, &options(None));
    assert!(one == merged("bits-arrow-8", 8, &options(Some(3))));
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("sweep-bits-arrow-1/merged.arrow");
    let reader = arrow_ipc::reader::FileReader::try_new(fs::File::open(path).unwrap(), None);
    let batches: Vec<_> = reader.unwrap().map(Result::unwrap).collect();
    assert_eq!(batches.len(), 1);
    let rows = rows(&merged("bits-csv", 1, &RunOptions::default()));
    for column in 2..6 {
        let values = batches[0].column(column).as_any();
        let values = values.downcast_ref::<arrow_array::Float64Array>().unwrap();
        for (row, value) in rows.iter().zip(values.values()) {
            assert_eq!(
                row[column].parse::<f64>().unwrap().to_bits(),
                value.to_bits()
            );
        }
    }
}

#[test]
#[cfg(not(feature = "arrow"))]
fn arrow_without_its_feature_is_refused() {
    let options = RunOptions {
        format: Some(Format::Arrow),
        ..RunOptions::default()
    };
    let error = stones(4, 1)
        .run(&directory("no-arrow"), &options)
        .unwrap_err();
    assert!(matches!(error, eem::sweep::SweepError::NoArrow));
    assert!(
        !Path::new(env!("CARGO_TARGET_TMPDIR"))
            .join("sweep-no-arrow/sweep.json")
            .exists()
    );
}

#[test]
fn ids_of_a_file_find_their_members() {
    let folder = directory("bits-ids");
    fs::create_dir_all(&folder).unwrap();
    let file = folder.join("inputs.csv");
    fs::write(&file, "speed,id,stiffness\n1,70,100\n2,5,200\n3,900,300\n").unwrap();
    let inputs = Inputs::csv(&file).unwrap();
    let plan = Plan::new("ids", inputs, Scheme::EemEntropy, STEP).program("1");
    let sweep = Stone { steps: 1 }.sweep(plan, |row| {
        Ok([row.number("stiffness")?, row.number("speed")?])
    });
    let of = |selection| RunOptions {
        selection,
        ..RunOptions::default()
    };
    let directory = folder.join("sweep");
    let range = of(Selection::Range(60..1000));
    assert_eq!(sweep.run(&directory, &range).unwrap().ran, 2);
    assert_eq!(sweep.status(&directory).unwrap().missing, "5");
    let list = of(Selection::Members(vec![5]));
    assert_eq!(sweep.run(&directory, &list).unwrap().ran, 1);
    let table = fs::read(sweep.merge(&directory, None).unwrap().path).unwrap();
    let ids: Vec<String> = rows(&table).into_iter().map(|row| row[0].clone()).collect();
    assert_eq!(ids, ["5", "70", "900"]);
    let unknown = sweep
        .run(&directory, &of(Selection::Members(vec![6])))
        .unwrap_err();
    assert_eq!(
        unknown.to_string(),
        "there is no member 6; ids go from 5 to 900"
    );
}

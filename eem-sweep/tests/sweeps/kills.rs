//! Whatever process is killed when: no record is lost that was reported, none is torn, none is double.

use std::fs;
use std::thread::sleep;
use std::time::Duration;

use eem::sweep::{RunOptions, Selection};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use crate::program::{abort_at, contents, directory, finish, start, stones};

const MEMBERS: usize = 600;
const STEPS: usize = 40;
const SHARDS: u64 = 3;

/// A command line in a directory.
fn line<'a>(head: &'a [String; 2], dir: &'a str, rest: &[&'a str]) -> Vec<&'a str> {
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    [&head, rest, &["--dir", dir]].concat()
}

/// Kills processes at random until so many have died at work; the sweep is then finished and compared.
fn survive(name: &str, kills: usize, seed: u64) {
    let sweep = stones(MEMBERS, STEPS);
    let whole = directory(&format!("{name}-whole"));
    sweep.run(&whole, &RunOptions::default()).unwrap();
    let whole = fs::read(sweep.merge(&whole, None).unwrap().path).unwrap();

    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let head = [MEMBERS.to_string(), STEPS.to_string()];
    let mut killed = 0;
    let mut sweeps = 0;
    while killed < kills {
        sweeps += 1;
        let folder = directory(&format!("{name}-{sweeps}"));
        let dir = folder.to_str().unwrap();
        let mut reported = Vec::new();
        // Beyond that many all members are there.
        for _ in 0..20 {
            let shards: Vec<String> = (0..SHARDS).map(|i| format!("{i}/{SHARDS}")).collect();
            let run = |shard| {
                line(
                    &head,
                    dir,
                    &["run", "--batch", "8", "--threads", "1", "--shard", shard],
                )
            };
            let mut processes: Vec<_> = shards.iter().map(|shard| start(&run(shard))).collect();
            for process in &mut processes {
                sleep(Duration::from_micros(random.random_range(0..40_000)));
                process.kill().unwrap();
                let status = process.wait().unwrap();
                killed += usize::from(status.code().is_none());
            }
            // What was reported before is there with the same bytes, and all of it can be read.
            let parts = contents(&folder.join("parts"));
            let now = |part: &_| parts.contains(part);
            assert!(reported.iter().all(now), "a part was lost");
            let is_part = |path: &std::path::Path| !path.to_string_lossy().ends_with(".tmp");
            reported = parts
                .iter()
                .filter(|(path, _)| is_part(path))
                .cloned()
                .collect();
            if let Ok(status) = sweep.status(&folder) {
                assert_eq!(status.repeated, 0);
                if status.reported == MEMBERS {
                    break;
                }
            } else {
                // Killed before it began.
                assert!(!folder.join("sweep.json").exists() && reported.is_empty());
            }
        }
        let (code, said) = finish(&line(&head, dir, &["run"]));
        assert_eq!(code, 0, "{said}");
        let (code, said) = finish(&line(&head, dir, &["merge"]));
        assert_eq!(code, 0, "{said}");
        assert!(said.contains("0 records superseded, 0 repeated"), "{said}");
        assert!(fs::read(folder.join("merged.csv")).unwrap() == whole);
        fs::remove_dir_all(&folder).unwrap();
    }
}

#[test]
fn killed_processes_lose_tear_and_double_nothing() {
    survive("kills", 12, 1);
}

#[test]
#[ignore = "takes ten seconds and more"]
fn two_hundred_kills() {
    survive("two-hundred-kills", 200, 2);
}

#[test]
fn a_merge_that_is_killed_leaves_the_whole_table_or_none() {
    let folder = directory("killed-merge");
    let sweep = stones(MEMBERS, 1);
    sweep.run(&folder, &RunOptions::default()).unwrap();
    let head = [MEMBERS.to_string(), "1".to_owned()];
    let dir = folder.to_str().unwrap();
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let mut table: Option<Vec<u8>> = None;
    for _ in 0..10 {
        let mut process = start(&line(&head, dir, &["merge"]));
        sleep(Duration::from_micros(random.random_range(0..15_000)));
        process.kill().unwrap();
        process.wait().unwrap();
        let now = fs::read(folder.join("merged.csv")).ok();
        assert!(now.is_some() || table.is_none());
        if let (Some(before), Some(now)) = (&table, &now) {
            assert!(before == now);
        }
        table = now;
    }
    let merged = sweep.merge(&folder, None).unwrap();
    let whole = fs::read(merged.path).unwrap();
    assert!(table.is_none_or(|table| table == whole));
    assert_eq!(whole.split(|&byte| byte == b'\n').count(), MEMBERS + 2);
}

#[test]
fn a_shard_that_was_killed_goes_on_where_it_was() {
    let folder = directory("goes-on");
    let sweep = stones(100, 1);
    let options = |selection| RunOptions {
        selection,
        batch: Some(10),
        ..RunOptions::default()
    };
    // What a killed shard 0/2 leaves: three of its five parts, and half of a fourth.
    sweep
        .run(&folder, &options(Selection::Range(0..30)))
        .unwrap();
    fs::write(
        folder.join("parts/.0000000030-0000000039.10.g0.x.csv.1-2.tmp"),
        "30,",
    )
    .unwrap();
    let report = sweep
        .run(&folder, &options(Selection::Shard { index: 0, count: 2 }))
        .unwrap();
    assert_eq!((report.members, report.skipped, report.ran), (50, 30, 20));
    assert_eq!(sweep.status(&folder).unwrap().missing, "50-99");
}

#[test]
fn a_member_that_kills_its_process_is_the_only_one_that_is_left() {
    let folder = directory("abort");
    let sweep = stones(60, 1);
    let dir = folder.to_str().unwrap();
    let mut died = 0;
    while sweep
        .status(&folder)
        .is_ok_and(|status| status.reported < 59)
        || died == 0
    {
        let line = ["60", "1", "run", "--threads", "3", "--dir", dir];
        let status = abort_at(17, &line).wait().unwrap();
        assert_eq!(status.code(), None);
        died += 1;
        assert!(died < 10, "{}", sweep.status(&folder).unwrap());
    }
    let status = sweep.status(&folder).unwrap();
    assert_eq!(
        (status.missing.as_str(), status.begun.as_str()),
        ("17", "17")
    );
    assert!(status.to_string().contains("has ended at: 17"), "{status}");
    // It can be given up, and where it can be run nothing is left of that.
    let line = ["60", "1", "give-up", "--dir", dir, "--members", "16,17"];
    let (code, said) = finish(&line);
    assert!(code == 3 && said.contains("1 were there, 1 run"), "{said}");
    let merged = sweep.merge(&folder, None).unwrap();
    assert_eq!((merged.members, merged.failed), (60, 1));
    let row = fs::read_to_string(&merged.path).unwrap();
    assert!(row.contains("\n17,given-up,"), "{row}");
    let rerun = sweep.rerun_failed(&folder, &RunOptions::default());
    assert_eq!(rerun.unwrap().ran, 1);
    let merged = sweep.merge(&folder, None).unwrap();
    assert_eq!((merged.failed, merged.superseded), (0, 1));
    let progress = fs::read_dir(folder.join("progress")).unwrap();
    let is_note = |path: &std::path::Path| path.extension().is_some_and(|end| end == "begun");
    assert!(!progress.flatten().any(|entry| is_note(&entry.path())));
}

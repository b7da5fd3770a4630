//! The shard of a process from the environment that an engine gives it.

use thiserror::Error;

/// Why `--shard auto` finds no shard.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum EngineError {
    /// No engine has set its variables.
    #[error(
        "--shard auto: no engine has started this process (looked for {looked_for}); write --shard i/n"
    )]
    None {
        /// The variables.
        looked_for: String,
    },
    /// Several engines have set their variables.
    #[error("--shard auto: {first} and {second} have both started this process; write --shard i/n")]
    Several {
        /// An engine.
        first: &'static str,
        /// Another one.
        second: &'static str,
    },
    /// The engine numbers its tasks, but does not say how many there are.
    #[error("--shard auto: {engine} does not say how many tasks there are; write --shard auto/n")]
    NoCount {
        /// The engine.
        engine: &'static str,
    },
    /// The tasks that were submitted seem to be some of more, so that nobody can tell how many shards there are.
    #[error(
        "--shard auto: the tasks of {engine} are {tasks}, not all of 0-m or 1-m; if they are some of n tasks that are \
         submitted again, write --shard auto/n, and if it is one alone, no --shard at all"
    )]
    Some {
        /// The engine.
        engine: &'static str,
        /// The tasks.
        tasks: String,
    },
    /// A variable is no whole number, or there are 0 tasks.
    #[error(
        "--shard auto: {variable} is `{value}`, not a whole number of that kind; write --shard i/n"
    )]
    Value {
        /// The variable.
        variable: &'static str,
        /// Its value.
        value: String,
    },
    /// The number of the task is not that of a shard.
    #[error(
        "--shard auto/{count}: {engine} says that this is task {index}, but tasks are counted from {first} to {last}; \
         number them so, or write --shard i/{count} with i from 0",
        last = first.saturating_add(*count).saturating_sub(1)
    )]
    TooLarge {
        /// The engine.
        engine: &'static str,
        /// The task.
        index: u64,
        /// The number of shards.
        count: u64,
        /// The number of the first task.
        first: u64,
    },
}

/// The variables of one engine.
struct Engine {
    name: &'static str,
    index: &'static str,
    /// The number of the first task.
    first: u64,
    count: Option<&'static str>,
    /// The smallest and the largest number of the tasks that were submitted together, if users choose these numbers.
    ends: Option<[&'static str; 2]>,
}

const fn engine(name: &'static str, index: &'static str, first: u64) -> Engine {
    Engine {
        name,
        index,
        first,
        count: None,
        ends: None,
    }
}

/// The engines that are known. A process of MPI has the variables of Open MPI or those of MPICH.
const ENGINES: [Engine; 6] = [
    engine("HyperQueue", "HQ_TASK_ID", 0),
    engine("GNU parallel", "PARALLEL_SEQ", 1),
    Engine {
        count: Some("OMPI_COMM_WORLD_SIZE"),
        ..engine("Open MPI", "OMPI_COMM_WORLD_RANK", 0)
    },
    Engine {
        count: Some("PMI_SIZE"),
        ..engine("MPI", "PMI_RANK", 0)
    },
    Engine {
        count: Some("SLURM_ARRAY_TASK_COUNT"),
        ends: Some(["SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_MAX"]),
        ..engine("a Slurm array", "SLURM_ARRAY_TASK_ID", 0)
    },
    engine("a PBS array", "PBS_ARRAY_INDEX", 0),
];

/// The shard (i, n) of this process. `variable` reads a variable of the environment; `count` is the number of shards, if
/// the caller knows it.
pub(crate) fn shard(
    variable: impl Fn(&str) -> Option<String>,
    count: Option<u64>,
) -> Result<(u64, u64), EngineError> {
    let number = |name: &'static str| number(name, variable(name));
    let mut present = ENGINES.iter().filter(|e| variable(e.index).is_some());
    let Some(found) = present.next() else {
        return Err(EngineError::None {
            looked_for: ENGINES.map(|engine| engine.index).join(", "),
        });
    };
    if let Some(second) = present.next() {
        return Err(EngineError::Several {
            first: found.name,
            second: second.name,
        });
    }
    let engine = found.name;
    let said = match found.count {
        None => None,
        Some(name) => match number(name)? {
            Some(0) => return Err(wrong(name, "0")),
            said => said,
        },
    };
    let all = count.or(said).ok_or(EngineError::NoCount { engine })?;
    let mut first = found.first;
    if let Some([least, most]) = found.ends
        && let (Some(least), Some(most), Some(said)) = (number(least)?, number(most)?, said)
    {
        let is_whole = said > 1 && least <= 1 && most.checked_sub(least) == Some(said - 1);
        if is_whole && said == all {
            first = least;
        } else if count.is_none() {
            let tasks = format!("{said} from {least} to {most}");
            return Err(EngineError::Some { engine, tasks });
        }
        // Otherwise they are some of an array that was counted from 0, and keep their numbers.
    }
    let index = number(found.index)?.unwrap_or(first);
    match index.checked_sub(first) {
        Some(shard) if shard < all => Ok((shard, all)),
        _ => Err(EngineError::TooLarge {
            engine,
            index,
            count: all,
            first,
        }),
    }
}

/// The whole number in a variable, if it is there.
fn number(variable: &'static str, value: Option<String>) -> Result<Option<u64>, EngineError> {
    let parse = |value: String| value.trim().parse().map_err(|_| wrong(variable, &value));
    value.map(parse).transpose()
}

fn wrong(variable: &'static str, value: &str) -> EngineError {
    let value = value.to_owned();
    EngineError::Value { variable, value }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(variables: &[(&str, &str)], count: Option<u64>) -> Result<(u64, u64), EngineError> {
        let value = |name: &str| {
            let mut found = variables.iter().filter(|(other, _)| *other == name);
            found.next().map(|(_, value)| (*value).to_owned())
        };
        shard(value, count)
    }

    #[test]
    fn every_engine_gives_its_shard() {
        let slurm = |id, min, max, count| {
            [
                ("SLURM_ARRAY_TASK_ID", id),
                ("SLURM_ARRAY_TASK_MIN", min),
                ("SLURM_ARRAY_TASK_MAX", max),
                ("SLURM_ARRAY_TASK_COUNT", count),
            ]
        };
        assert_eq!(of(&slurm("3", "1", "8", "8"), None), Ok((2, 8)));
        assert_eq!(of(&slurm("7", "0", "7", "8"), None), Ok((7, 8)));
        assert_eq!(of(&slurm("3", "1", "8", "8"), Some(8)), Ok((2, 8)));
        // Some of eight tasks, submitted again: 3 and 5, 3 to 5, 5 alone, the first alone, every other one.
        for (min, max, count) in [
            ("3", "5", "2"),
            ("3", "5", "3"),
            ("5", "5", "1"),
            ("0", "0", "1"),
            ("1", "7", "4"),
        ] {
            let error = of(&slurm(max, min, max, count), None).unwrap_err();
            assert!(matches!(error, EngineError::Some { .. }), "{error}");
            assert!(error.to_string().contains("auto/n"), "{error}");
            let shard = max.parse().unwrap();
            assert_eq!(of(&slurm(max, min, max, count), Some(8)), Ok((shard, 8)));
        }
        let mpi = [("OMPI_COMM_WORLD_RANK", "1"), ("OMPI_COMM_WORLD_SIZE", "4")];
        assert_eq!(of(&mpi, None), Ok((1, 4)));
        assert_eq!(
            of(&[("PMI_RANK", "0"), ("PMI_SIZE", "2")], None),
            Ok((0, 2))
        );
        assert_eq!(of(&[("HQ_TASK_ID", "7")], Some(8)), Ok((7, 8)));
        assert_eq!(of(&[("PARALLEL_SEQ", "8")], Some(8)), Ok((7, 8)));
        assert_eq!(of(&[("PBS_ARRAY_INDEX", "0")], Some(8)), Ok((0, 8)));
    }

    #[test]
    fn what_is_not_clear_is_refused() {
        assert!(matches!(of(&[], None), Err(EngineError::None { .. })));
        let several = [("HQ_TASK_ID", "1"), ("PBS_ARRAY_INDEX", "1")];
        assert!(matches!(
            of(&several, Some(2)),
            Err(EngineError::Several { .. })
        ));
        let no_count = of(&[("HQ_TASK_ID", "1")], None);
        assert!(matches!(no_count, Err(EngineError::NoCount { .. })));
        let large = of(&[("HQ_TASK_ID", "8")], Some(8));
        assert!(large.unwrap_err().to_string().contains("from 0 to 7"));
        let none = [
            ("SLURM_ARRAY_TASK_ID", "0"),
            ("SLURM_ARRAY_TASK_COUNT", "0"),
        ];
        let none = of(&none, None).unwrap_err().to_string();
        assert!(none.contains("SLURM_ARRAY_TASK_COUNT is `0`"), "{none}");
        let most = of(&[("PARALLEL_SEQ", "0")], Some(u64::MAX));
        assert!(matches!(most, Err(EngineError::TooLarge { .. })));
        let word = of(&[("HQ_TASK_ID", "x")], Some(8));
        assert!(matches!(word, Err(EngineError::Value { .. })));
    }
}

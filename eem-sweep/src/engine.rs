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
    /// Several have.
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
    /// Tasks do not follow one another, so that their numbers are no shards.
    #[error(
        "--shard auto: the tasks of {engine} leave numbers out; submit them as 0-{last}, or write --shard i/n"
    )]
    Gaps {
        /// The engine.
        engine: &'static str,
        /// The number of the last one if none were left out.
        last: u64,
    },
    /// A variable is no whole number.
    #[error("--shard auto: {variable} is `{value}`, not a whole number")]
    Value {
        /// The variable.
        variable: &'static str,
        /// Its value.
        value: String,
    },
    /// There are not so many shards.
    #[error(
        "--shard auto/{count}: {engine} says that this is task {index}, but tasks are counted from {first} to {last}",
        last = first + count - 1
    )]
    TooLarge {
        /// The engine.
        engine: &'static str,
        /// The task.
        index: u64,
        /// The shards.
        count: u64,
        /// The number of the first task.
        first: u64,
    },
}

/// The variables of one engine.
struct Engine {
    name: &'static str,
    index: &'static str,
    /// The number of the first task, and the variable that says so where it is not fixed.
    first: u64,
    first_variable: Option<&'static str>,
    count: Option<&'static str>,
    /// The largest number of a task, from which gaps are seen.
    last: Option<&'static str>,
}

const fn engine(name: &'static str, index: &'static str, first: u64) -> Engine {
    Engine {
        name,
        index,
        first,
        first_variable: None,
        count: None,
        last: None,
    }
}

/// The engines that are known; of Open MPI and MPICH one is running.
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
        first_variable: Some("SLURM_ARRAY_TASK_MIN"),
        count: Some("SLURM_ARRAY_TASK_COUNT"),
        last: Some("SLURM_ARRAY_TASK_MAX"),
        ..engine("a Slurm array", "SLURM_ARRAY_TASK_ID", 0)
    },
    engine("a PBS array", "PBS_ARRAY_INDEX", 0),
];

/// The shard (i, n) of this process, `variable` being what the environment says; `count` is the number of shards
/// where the caller knows it.
pub(crate) fn shard(
    variable: impl Fn(&str) -> Option<String>,
    count: Option<u64>,
) -> Result<(u64, u64), EngineError> {
    let number = |name: &'static str| -> Result<Option<u64>, EngineError> {
        let Some(value) = variable(name) else {
            return Ok(None);
        };
        let parsed = value.trim().parse().map_err(|_| EngineError::Value {
            variable: name,
            value,
        });
        parsed.map(Some)
    };
    let optional = |name: Option<&'static str>| name.map_or(Ok(None), number);

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
    let said = optional(found.count)?;
    let all = count.or(said).ok_or(EngineError::NoCount { engine })?;
    let mut first = optional(found.first_variable)?.unwrap_or(found.first);
    if count.is_some() {
        // A part of an array that is submitted again keeps its numbers.
        first = found.first;
    } else if let Some(last) = optional(found.last)?
        && last.saturating_sub(first) + 1 != all
    {
        let last = all.saturating_sub(1);
        return Err(EngineError::Gaps { engine, last });
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
        // Tasks 3 and 5 of eight once more.
        assert!(matches!(
            of(&slurm("5", "3", "5", "2"), None),
            Err(EngineError::Gaps { .. })
        ));
        assert_eq!(of(&slurm("5", "3", "5", "2"), Some(8)), Ok((5, 8)));
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
        let word = of(&[("HQ_TASK_ID", "x")], Some(8));
        assert!(matches!(word, Err(EngineError::Value { .. })));
    }
}

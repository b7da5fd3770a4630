//! A sweep: its inputs, scheme and settings, and the closures that it runs.

use std::collections::BTreeMap;
use std::env;
use std::fmt;
use std::path::{Path, PathBuf};

use eem_runtime::{MemberFailure, NewtonSettings, Scene, Scheme, Simulation};

use crate::digest;
use crate::error::SweepError;
use crate::files;
use crate::format::{Format, Heads};
use crate::inputs::{InputError, Inputs, Row};
use crate::job::{Job, Stepping, job};
use crate::manifest::{Identity, Manifest};
use crate::part::{PARTS, Shelf};
use crate::record::Record;

/// The data of a sweep: inputs, scheme, step and settings. Together with closures it is a [`Sweep`].
///
/// Pendulums on springs of different stiffness. The results have the same bits for any division among processes:
///
/// ```
/// use eem::prelude::*;
/// use eem::sweep::{Inputs, Plan, RunOptions};
/// use eem::Scene;
///
/// let inputs = Inputs::grid([("speed", vec![5.0, 10.0, f64::NAN, 20.0])])?;
/// let sweep = Plan::new("stones", inputs, Scheme::EemEntropy, 0.1)
///     .setting("steps", 10)
///     .closures(
///         |row| row.number("speed"),
///         |&speed| {
///             let mut scene = Scene::<2>::new();
///             let stone = scene.mass(0.5, [0.0, 0.0], [0.0, speed]);
///             scene.set_gravity([0.0, -10.0]);
///             (scene, stone)
///         },
///         |run, stone, _| {
///             for _ in 0..10 {
///                 run.step()?;
///             }
///             Ok(run.position(stone)?.y)
///         },
///     );
///
/// # let directory = std::env::temp_dir().join(format!("eem-stones-{}", std::process::id()));
/// # let _ = std::fs::remove_dir_all(&directory);
/// let report = sweep.run(&directory, &RunOptions::default())?;
/// assert_eq!((report.ran, report.failed), (4, 1));
/// // Nothing is run twice.
/// assert_eq!(sweep.run(&directory, &RunOptions::default())?.ran, 0);
///
/// let merged = sweep.merge(&directory, None)?;
/// let table = std::fs::read_to_string(&merged.path)?;
/// let rows: Vec<&str> = table.lines().collect();
/// assert_eq!(rows[0], "id,failure,speed,value,failed_at (s),message");
/// // y = v t − g t²/2 at t = 1 s.
/// let height: f64 = rows[2].split(',').nth(3).unwrap().parse()?;
/// assert!((height - 5.0).abs() < 1e-14);
/// assert!(rows[3].starts_with("2,scene,NaN,,,"));
/// # std::fs::remove_dir_all(&directory)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Plan {
    name: String,
    program: Option<String>,
    inputs: Inputs,
    stepping: Stepping,
    settings: BTreeMap<String, String>,
}

impl Plan {
    /// A sweep over `inputs` with this scheme and step, s.
    pub fn new(name: impl Into<String>, inputs: Inputs, scheme: Scheme, step: f64) -> Self {
        Self {
            name: name.into(),
            program: None,
            inputs,
            stepping: Stepping {
                scheme,
                step,
                newton: NewtonSettings::default(),
            },
            settings: BTreeMap::new(),
        }
    }

    /// The settings of Newton's method for all members.
    #[must_use]
    pub fn newton(mut self, settings: NewtonSettings) -> Self {
        self.stepping.newton = settings;
        self
    }

    /// Adds another setting on which the results depend, such as the end time. A process with another value is
    /// rejected.
    #[must_use]
    pub fn setting(mut self, name: impl Into<String>, value: impl fmt::Display) -> Self {
        self.settings.insert(name.into(), value.to_string());
        self
    }

    /// Identifies the program by a version instead of a digest of the executable. You promise that programs with
    /// the same version compute the same bits.
    #[must_use]
    pub fn program(mut self, version: impl Into<String>) -> Self {
        self.program = Some(version.into());
        self
    }

    /// A sweep that runs two closures like [`Ensemble::run`](eem_runtime::Ensemble::run). `input` makes their
    /// inputs from rows.
    pub fn closures<'a, const D: usize, I, H, T>(
        self,
        input: impl Fn(Row<'_>) -> Result<I, InputError> + Send + Sync + 'a,
        build: impl Fn(&I) -> (Scene<D>, H) + Sync + 'a,
        observe: impl Fn(&mut Simulation<D>, H, &I) -> Result<T, MemberFailure> + Sync + 'a,
    ) -> Sweep<'a>
    where
        I: Sync + 'a,
        H: 'a,
        T: Record + Send + 'a,
    {
        let job = job(self.stepping, input, move |ensemble, inputs: &[_]| {
            ensemble.run(inputs, &build, &observe)
        });
        self.with(job, T::COLUMNS)
    }

    fn with<'a>(self, job: Job<'a>, outputs: &'static [&'static str]) -> Sweep<'a> {
        Sweep {
            plan: self,
            outputs,
            job,
        }
    }
}

/// A sweep that can run in any number of processes. Each runs some of the members; the results in their common
/// directory are merged.
///
/// See [`Plan`] for an example, and [`main`](fn@crate::main) for the command line.
pub struct Sweep<'a> {
    pub(crate) plan: Plan,
    outputs: &'static [&'static str],
    pub(crate) job: Job<'a>,
}

impl fmt::Debug for Sweep<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Sweep")
            .field("plan", &self.plan)
            .field("outputs", &self.outputs)
            .finish_non_exhaustive()
    }
}

/// A directory that was found to be of this sweep.
pub(crate) struct Opened<'a> {
    pub(crate) manifest: Manifest,
    heads: Heads,
    inputs: &'a Inputs,
    folder: PathBuf,
}

impl Opened<'_> {
    pub(crate) fn shelf(&self) -> Shelf<'_> {
        Shelf {
            folder: &self.folder,
            digest: &self.manifest.digest,
            format: self.manifest.format,
            heads: &self.heads,
            inputs: self.inputs,
        }
    }

    /// The columns of the table.
    pub(crate) fn heads(&self) -> &Heads {
        &self.heads
    }
}

impl Sweep<'_> {
    /// The inputs of all members.
    #[must_use]
    pub fn inputs(&self) -> &Inputs {
        &self.plan.inputs
    }

    /// Opens a directory of this sweep. `begin` says whether to begin the sweep if the directory holds none.
    pub(crate) fn open(
        &self,
        directory: &Path,
        format: Option<Format>,
        begin: bool,
    ) -> Result<Opened<'_>, SweepError> {
        let heads = Heads::new(self.plan.inputs.columns(), self.outputs)?;
        let folder = directory.join(PARTS);
        if begin {
            files::directory(&folder)?;
        }
        let manifest = Manifest::agree(directory, self.identity()?, format, begin)?;
        Ok(Opened {
            manifest,
            heads,
            inputs: &self.plan.inputs,
            folder,
        })
    }

    fn identity(&self) -> Result<Identity, SweepError> {
        let plan = &self.plan;
        let Stepping {
            scheme,
            step,
            newton,
        } = plan.stepping;
        let newton = format!(
            "{} iterations, {:e}",
            newton.max_iterations, newton.tolerance
        );
        let stepping = [
            ("scheme", scheme.to_string()),
            ("step (s)", step.to_string()),
            ("Newton's method", newton),
        ];
        Ok(Identity {
            name: plan.name.clone(),
            program: self.program()?,
            members: plan.inputs.members(),
            inputs: plan.inputs.digest(),
            input_columns: plan.inputs.columns().to_vec(),
            output_columns: self.outputs.iter().map(|&head| head.to_owned()).collect(),
            stepping: stepping
                .map(|(name, value)| (name.to_owned(), value))
                .into(),
            settings: plan.settings.clone(),
        })
    }

    /// The version that the caller gives, or a digest of the executable.
    fn program(&self) -> Result<String, SweepError> {
        if let Some(version) = &self.plan.program {
            return Ok(version.clone());
        }
        let unknown = || files::failed("find the executable of", Path::new("this process"));
        // The running program, even if its file has been replaced or removed.
        let path = if cfg!(target_os = "linux") {
            PathBuf::from("/proc/self/exe")
        } else {
            env::current_exe().map_err(unknown())?
        };
        let digest = digest::of_file(&path).map_err(files::failed("read the executable", &path))?;
        Ok(format!("an executable with digest {digest}"))
    }
}

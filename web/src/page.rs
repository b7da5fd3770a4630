//! What a page asks for, as texts in JSON and samples as numbers.

use serde::{Deserialize, Serialize};

use crate::examples::EXAMPLES;
use crate::pendulum::{Balance, Pendulum, Setting};
use crate::sheet::{Material, Mistake, Parameter};
use eem::Scheme;

/// What a page knows from the start.
#[derive(Serialize)]
struct Contents {
    examples: &'static [crate::examples::Example],
    /// Name, and whether it proves its laws in every step.
    schemes: Vec<(&'static str, bool)>,
}

/// What a sheet means, or why it means nothing.
#[derive(Serialize)]
struct Reading<'a> {
    mistakes: &'a [Mistake],
    law: Option<Meaning<'a>>,
}

#[derive(Serialize)]
struct Meaning<'a> {
    parameters: &'a [Parameter],
    is_thermal: bool,
    /// Symbol, equation, unit.
    formulas: Vec<[String; 3]>,
}

/// A start of one run per scheme.
#[derive(Deserialize)]
struct Start {
    setting: Setting,
    schemes: Vec<String>,
}

/// Why a run does not go on, if it does not.
#[derive(Serialize)]
struct Standing {
    failure: Option<String>,
    balance: Option<Balance>,
}

/// Everything behind one page.
pub struct Page {
    material: Option<Material>,
    runs: Vec<Result<Pendulum, String>>,
    samples: Vec<f64>,
}

impl Page {
    /// A page without a material.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            material: None,
            runs: Vec::new(),
            samples: Vec::new(),
        }
    }

    /// Examples and schemes.
    #[must_use]
    pub fn contents() -> String {
        let mut schemes: Vec<_> = Scheme::ALL.iter().collect();
        schemes.sort_by_key(|scheme| !scheme.is_exact());
        let schemes = schemes.iter().map(|one| (one.name(), one.is_exact()));
        json(&Contents {
            examples: &EXAMPLES,
            schemes: schemes.collect(),
        })
    }

    /// Reads a sheet. If something is wrong with it, the material before it stays.
    pub fn read(&mut self, sheet: &str) -> String {
        match Material::read(sheet) {
            Ok(material) => {
                let answer = json(&Reading {
                    mistakes: &material.warnings,
                    law: Some(Meaning::of(&material)),
                });
                self.material = Some(material);
                answer
            }
            Err(mistakes) => json(&Reading {
                mistakes: &mistakes,
                law: None,
            }),
        }
    }

    /// Starts a run for each scheme, of which the samples are the starts.
    pub fn start(&mut self, text: &str) -> String {
        self.samples.clear();
        self.runs.clear();
        let (Some(material), Ok(start)) = (&self.material, serde_json::from_str::<Start>(text))
        else {
            return json(&Vec::<Standing>::new());
        };
        for scheme in &start.schemes {
            let run = Pendulum::new(&material.law, &start.setting, scheme);
            if let Ok(run) = &run {
                self.samples.extend(run.sample());
            }
            self.runs.push(run);
        }
        let standings = (0..self.runs.len()).map(|index| self.standing(index));
        json(&standings.collect::<Vec<_>>())
    }

    /// Makes steps with a run, of which the samples are kept until the next call, until one fails.
    pub fn advance(&mut self, index: usize, steps: usize) -> String {
        self.samples.clear();
        if let Some(run) = self.runs.get_mut(index) {
            for _ in 0..steps {
                let Ok(pendulum) = run else { break };
                match pendulum.step() {
                    Ok(sample) => self.samples.extend(sample),
                    Err(error) => *run = Err(error.to_string()),
                }
            }
        }
        json(&self.standing(index))
    }

    /// One [`Sample`](crate::pendulum::Sample) after the other.
    #[must_use]
    pub fn samples(&self) -> &[f64] {
        &self.samples
    }

    fn standing(&self, index: usize) -> Standing {
        let run = self.runs.get(index);
        let run = run.map_or(Err("there is no such run"), |run| {
            run.as_ref().map_err(String::as_str)
        });
        Standing {
            failure: run.err().map(ToOwned::to_owned),
            balance: run.ok().map(Pendulum::balance),
        }
    }
}

impl Default for Page {
    fn default() -> Self {
        Self::new()
    }
}

impl<'a> Meaning<'a> {
    fn of(material: &'a Material) -> Self {
        let compiled = material.law.compiled();
        let formulas = compiled.formulas().into_iter();
        Self {
            parameters: &material.parameters,
            is_thermal: compiled
                .arguments()
                .iter()
                .any(|one| one.role == "Temperature"),
            formulas: formulas
                .map(|one| [one.symbol, one.equation, one.unit])
                .collect(),
        }
    }
}

/// Nothing here has a key that is no text, the only thing that could fail.
fn json(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap_or_default()
}

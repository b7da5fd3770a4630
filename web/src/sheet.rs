//! A sheet: ψ, viscosities and values of parameters in one text, and the places of what is wrong in it.
//!
//! ```text
//! |lambda: Stretch, gamma: Viscous| 0.5 * k * (lambda - gamma).powi(2)
//!
//! viscosity gamma = eta
//! k = 100 N/m
//! eta = 5 N s/m
//! ```
//!
//! Lines that begin with `viscosity` or with a name and `=` are read here; the others are ψ, at the places where they stand.

use std::ops::Range;

use eem_typed::{Compiled, Fault, Faults, Law, LawError, Level, Part, Source, compile};
use serde::Serialize;

/// Before the law of a dashpot.
const VISCOSITY: &str = "viscosity ";
/// What ends a line of the sheet.
const COMMENT: &str = "//";

/// A mistake or a warning, with its place in the sheet.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Mistake {
    /// Whether there is a law all the same.
    pub is_warning: bool,
    /// Line of the sheet, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// Characters from there on.
    pub width: usize,
    /// What is wrong.
    pub text: String,
    /// What to write instead.
    pub help: String,
    /// The line, with carets below the place.
    pub drawing: String,
}

/// A parameter, and the place of its value.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// Its value.
    pub value: f64,
    /// Its unit; nothing if the sheet has no units.
    pub unit: String,
    /// The comment behind it.
    pub note: String,
    /// Line of the value, from 1.
    pub line: usize,
    /// Column of the value in characters, from 1.
    pub column: usize,
    /// Characters of the value.
    pub width: usize,
}

/// A law with the lines it was read from.
#[derive(Clone)]
pub struct Material {
    /// The law.
    pub law: Law,
    /// Its parameters in the order of the sheet.
    pub parameters: Vec<Parameter>,
    /// What is accepted and loses digits.
    pub warnings: Vec<Mistake>,
}

/// The name and the rest of a line, as bytes of it.
type Declaration = (Range<usize>, Range<usize>);

/// Where a part of the source begins, from 0.
type Place = (Part, usize, usize);

/// A sheet that is being read.
struct Sheet<'a> {
    text: &'a str,
    source: Source,
    parameters: Vec<Parameter>,
    places: Vec<Place>,
    mistakes: Vec<Mistake>,
}

impl Material {
    /// Reads a sheet.
    ///
    /// # Errors
    ///
    /// All that is wrong, from top to bottom.
    ///
    /// ```
    /// use eem_web::sheet::Material;
    ///
    /// let material = Material::read("|x: Stretch| 0.5 * k * (x - 1).powi(2)\nk = 100").unwrap();
    /// assert_eq!(material.law.gradients(&[1.5]), Ok(vec![50.0]));
    /// assert_eq!(material.parameters[0].column, 5);
    ///
    /// let mistakes = Material::read("|lambda: Stretch| 0.5 * k * (lamda - 1).powi(2)\nk = 100").err().unwrap();
    /// assert_eq!(
    ///     mistakes[0].drawing,
    ///     "error: unknown name `lamda`
    ///  --> line 1, column 30
    ///   |
    /// 1 | |lambda: Stretch| 0.5 * k * (lamda - 1).powi(2)
    ///   |                              ^^^^^
    ///   = help: did you mean `lambda`?"
    /// );
    /// ```
    pub fn read(text: &str) -> Result<Self, Vec<Mistake>> {
        let mut sheet = Sheet::new(text);
        if !sheet.mistakes.is_empty() {
            return Err(sheet.mistakes);
        }
        let compiled = sheet.compile()?;
        let warnings = compiled.warnings().iter();
        let warnings = warnings.map(|fault| sheet.mistake(fault)).collect();
        let values = sheet.parameters.iter();
        let values: Vec<_> = values.map(|one| (one.name.as_str(), one.value)).collect();
        let law = Law::new(compiled, &values);
        let law = law.and_then(|law| law.check_spring().map(|()| law));
        match law {
            Ok(law) => Ok(Self {
                law,
                parameters: sheet.parameters,
                warnings,
            }),
            Err(LawError::Programs(faults)) => Err(sheet.all(&faults)),
            Err(error) => {
                let help = "write ψ of a spring, with one `Stretch`";
                sheet.refuse(0, 0..1, &error.to_string(), help);
                Err(sheet.mistakes)
            }
        }
    }
}

impl<'a> Sheet<'a> {
    /// The sheet line by line.
    fn new(text: &'a str) -> Self {
        let mut sheet = Self {
            text,
            source: Source::new(""),
            parameters: Vec::new(),
            places: vec![(Part::FreeEnergy, 0, 0)],
            mistakes: Vec::new(),
        };
        let mut psi = String::new();
        let mut viscosities = Vec::new();
        for (number, line) in text.split('\n').enumerate() {
            let (code, note) = line.split_once(COMMENT).unwrap_or((line, ""));
            match declaration(code) {
                Some((name, rest)) if is_law(code, &name) => {
                    let part = |range: &Range<usize>| code[range.clone()].to_owned();
                    let (dashpot, law) = (part(&name), part(&rest));
                    sheet.note(Part::Dashpot(dashpot.clone()), number, line, name.start);
                    sheet.note(Part::Viscosity(dashpot.clone()), number, line, rest.start);
                    viscosities.push((dashpot, law));
                }
                Some(found) => sheet.parameter(number, [code, note], found),
                // Its line stays, so that places in ψ are places in the sheet.
                None => psi.push_str(line),
            }
            psi.push('\n');
        }
        let mut source = Source::new(psi);
        for (dashpot, law) in viscosities {
            source = source.viscosity(dashpot, law);
        }
        for Parameter { name, unit, .. } in &sheet.parameters {
            source = source.parameter(name, Some(unit.as_str()).filter(|unit| !unit.is_empty()));
        }
        sheet.source = source;
        sheet
    }

    /// A line such as `k = 100 N/m`.
    fn parameter(&mut self, number: usize, [line, note]: [&str; 2], (name, rest): Declaration) {
        let text = &line[rest.clone()];
        let width = text.find(char::is_whitespace).unwrap_or(text.len());
        let unit = text[width..].trim_start();
        let value = text[..width]
            .parse()
            .ok()
            .filter(|value: &f64| value.is_finite());
        let Some(value) = value else {
            let column = characters(line, rest.start);
            let guilty = column..column + text[..width].chars().count().max(1);
            let text = format!("`{}` has no value", &line[name]);
            self.refuse(
                number,
                guilty,
                &text,
                "write a number and its unit, as in `k = 100 N/m`",
            );
            return;
        };
        let name_text = &line[name.clone()];
        self.note(
            Part::Parameter(name_text.to_owned()),
            number,
            line,
            name.start,
        );
        self.note(
            Part::Unit(name_text.to_owned()),
            number,
            line,
            rest.end - unit.len(),
        );
        self.parameters.push(Parameter {
            name: name_text.to_owned(),
            value,
            unit: unit.to_owned(),
            note: note.trim().to_owned(),
            line: number + 1,
            column: characters(line, rest.start) + 1,
            width,
        });
    }

    fn note(&mut self, part: Part, number: usize, line: &str, byte: usize) {
        self.places.push((part, number, characters(line, byte)));
    }

    /// A mistake that is found here; the line and the columns are counted from 0.
    fn refuse(&mut self, line: usize, columns: Range<usize>, text: &str, help: &str) {
        let (column, width) = (columns.start + 1, columns.len());
        let mistake = self.drawn(false, [line + 1, column, width], text, help, &[]);
        self.mistakes.push(mistake);
    }

    fn compile(&self) -> Result<Compiled, Vec<Mistake>> {
        compile(&self.source).map_err(|faults| self.all(&faults))
    }

    fn all(&self, faults: &Faults) -> Vec<Mistake> {
        let mut all: Vec<_> = faults
            .all()
            .iter()
            .map(|fault| self.mistake(fault))
            .collect();
        all.sort_by_key(|mistake| (mistake.line, mistake.column));
        all
    }

    /// A fault at its place in the sheet.
    fn mistake(&self, fault: &Fault) -> Mistake {
        let mut places = self.places.iter();
        let place = places.find(|(part, ..)| *part == fault.part);
        let (line, column) = place.map_or((0, 0), |&(_, line, column)| (line, column));
        let column = if fault.line == 1 { column } else { 0 };
        let place = [line + fault.line, column + fault.column, fault.width];
        let is_warning = fault.level == Level::Warning;
        self.drawn(is_warning, place, &fault.text, &fault.help, &fault.calls)
    }

    fn drawn(
        &self,
        is_warning: bool,
        [line, column, width]: [usize; 3],
        text: &str,
        help: &str,
        calls: &[String],
    ) -> Mistake {
        let level = if is_warning { "warning" } else { "error" };
        let margin = " ".repeat(line.to_string().len());
        let shown = self.text.split('\n').nth(line - 1).unwrap_or_default();
        // A tab would move what is behind it away from its caret.
        let shown = shown.replace(char::is_control, " ");
        let (before, carets) = (" ".repeat(column - 1), "^".repeat(width));
        let calls = calls.iter().map(|call| format!("{margin} = in {call}\n"));
        let calls: String = calls.collect();
        let drawing = format!(
            "{level}: {text}\n{margin}--> line {line}, column {column}\n{margin} |\n{line} | {shown}\n\
             {margin} | {before}{carets}\n{calls}{margin} = help: {help}"
        );
        Mistake {
            is_warning,
            line,
            column,
            width,
            text: text.to_owned(),
            help: help.to_owned(),
            drawing,
        }
    }
}

/// What a line declares, if it does.
fn declaration(line: &str) -> Option<Declaration> {
    let (before, after) = line.split_once('=')?;
    if after.starts_with('=') {
        return None;
    }
    let start = before.len() - before.trim_start().len();
    let start = match before[start..].strip_prefix(VISCOSITY) {
        Some(rest) => before.len() - rest.trim_start().len(),
        None => start,
    };
    let name = before[start..].trim_end();
    let mut letters = name.chars();
    let is_letter = |c: char| c == '_' || c.is_alphabetic();
    let is_name =
        letters.next().is_some_and(is_letter) && letters.all(|c| is_letter(c) || c.is_numeric());
    let rest = line.trim_end().len().max(before.len() + 1);
    let spaces = after.len() - after.trim_start().len();
    let rest = (before.len() + 1 + spaces).min(rest)..rest;
    is_name.then(|| (start..start + name.len(), rest))
}

/// Whether a declaration is one of a viscosity.
fn is_law(line: &str, name: &Range<usize>) -> bool {
    line[..name.start].trim_start().starts_with(VISCOSITY)
}

/// Characters before a byte.
fn characters(line: &str, byte: usize) -> usize {
    line[..byte].chars().count()
}

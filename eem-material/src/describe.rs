//! The description of a model as static text: arguments, parameters, formulas and costs.

use core::fmt::{self, Display, Formatter};

/// A model that can print itself.
///
/// `#[derive(FreeEnergy)]` implements this trait too. The description does not depend on the number type and is
/// static text.
///
/// ```
/// use eem::{Describe, Description, describe};
///
/// struct Rubber;
///
/// impl Describe for Rubber {
///     const DESCRIPTION: Description = Description {
///         arguments: &[describe::Argument::new("lambda", "Stretch", "m")],
///         formulas: &[describe::Formula::new("ψ", "ψ = 5*lambda^2", "J")],
///         ..Description::new("Rubber")
///     };
/// }
///
/// let description = Rubber::DESCRIPTION;
/// assert_eq!(description.equation("ψ"), Some("ψ = 5*lambda^2"));
/// assert!(description.to_string().contains("lambda"));
/// ```
pub trait Describe {
    /// The description of the model.
    const DESCRIPTION: Description;
}

/// The description of a model; `Display` prints all of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Description {
    /// The name of the type.
    pub name: &'static str,
    /// The variables in the order of the state: length or strains, viscous variables, temperature.
    pub arguments: &'static [Argument],
    /// The fields that the formulas use.
    pub parameters: &'static [Parameter],
    /// ψ, s, e, f, g, c and η, as far as the model has them; per volume in a solid.
    pub formulas: &'static [Formula],
    /// The divided differences in the discrete derivatives: of ψ and s along measures and viscous variables, of e
    /// and s along the temperature, `F[x⁰, x¹] = (F(x¹) − F(x⁰))/(x¹ − x⁰)`.
    pub divided_differences: &'static [Formula],
    /// The generated functions and their costs.
    pub costs: &'static [Cost],
}

/// An argument of the free energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Argument {
    /// Its name in the formulas.
    pub name: &'static str,
    /// `Stretch`, `StrainTrace`, `StrainSquare`, `Dilatation`, `FibreStrain`, `ViscousStrain`, `ViscousSquare`,
    /// `ViscousTrace`, `Viscous` or `Temperature`.
    pub role: &'static str,
    /// Its unit.
    pub unit: &'static str,
}

/// A field that the formulas use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parameter {
    /// Its name in the formulas.
    pub name: &'static str,
    /// Its unit as written, if the model has units.
    pub unit: Option<&'static str>,
}

/// A formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Formula {
    /// The symbol that the formula defines: `ψ`, `f`, `g_2`, `s[theta]`.
    pub symbol: &'static str,
    /// Both sides; a long one is broken into lines.
    pub equation: &'static str,
    /// The unit of both sides.
    pub unit: &'static str,
}

/// The cost of a generated function in operations: additions, multiplications, divisions, elementary functions and
/// divided differences each count one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cost {
    /// The function of [`FreeEnergy`](crate::FreeEnergy).
    pub function: &'static str,
    /// Operations of the part that depends on the old state only, once per step.
    pub per_step: usize,
    /// Operations of each call, once per iteration in a step.
    pub per_call: usize,
}

impl Description {
    /// A description with nothing but a name.
    #[must_use]
    pub const fn new(name: &'static str) -> Self {
        Self {
            name,
            arguments: &[],
            parameters: &[],
            formulas: &[],
            divided_differences: &[],
            costs: &[],
        }
    }

    /// The equation for `symbol`, for example `"ψ"`, `"s"` or `"ψ[lambda]"`.
    #[must_use]
    pub fn equation(&self, symbol: &str) -> Option<&'static str> {
        let mut formulas = self.formulas.iter().chain(self.divided_differences);
        let formula = formulas.find(|formula| formula.symbol == symbol);
        formula.map(|formula| formula.equation)
    }
}

impl Argument {
    /// An argument and its unit.
    #[must_use]
    pub const fn new(name: &'static str, role: &'static str, unit: &'static str) -> Self {
        Self { name, role, unit }
    }
}

impl Parameter {
    /// A parameter with a unit.
    #[must_use]
    pub const fn new(name: &'static str, unit: &'static str) -> Self {
        let unit = Some(unit);
        Self { name, unit }
    }

    /// A parameter of a model without units.
    #[must_use]
    pub const fn without_unit(name: &'static str) -> Self {
        Self { name, unit: None }
    }
}

impl Formula {
    /// A formula and the unit of both sides.
    #[must_use]
    pub const fn new(symbol: &'static str, equation: &'static str, unit: &'static str) -> Self {
        Self {
            symbol,
            equation,
            unit,
        }
    }
}

impl Cost {
    /// Operations of a function.
    #[must_use]
    pub const fn new(function: &'static str, per_step: usize, per_call: usize) -> Self {
        Self {
            function,
            per_step,
            per_call,
        }
    }
}

/// The width of the column of names.
const NAME: usize = 20;
/// The width of a column of numbers or roles.
const COLUMN: usize = 14;

impl Display for Description {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.name)?;
        heading(f, "Arguments", self.arguments.len())?;
        for Argument { name, role, unit } in self.arguments {
            writeln!(f, "  {name:NAME$}{role:COLUMN$}{unit}")?;
        }
        heading(f, "Parameters", self.parameters.len())?;
        for Parameter { name, unit } in self.parameters {
            match unit {
                Some(unit) => writeln!(f, "  {name:NAME$}{unit}")?,
                None => writeln!(f, "  {name}")?,
            }
        }
        heading(f, "Formulas", self.formulas.len())?;
        formulas(f, self.formulas)?;
        let differences = self.divided_differences;
        heading(
            f,
            "Divided differences between two states",
            differences.len(),
        )?;
        formulas(f, differences)?;
        heading(f, "Operations", self.costs.len())?;
        let names = self.costs.iter().map(|cost| cost.function.len());
        let name = names.max().unwrap_or_default().max(NAME);
        if !self.costs.is_empty() {
            writeln!(
                f,
                "  {:name$}{:>COLUMN$}{:>COLUMN$}",
                "", "per step", "per call"
            )?;
        }
        for cost in self.costs {
            let (function, step, call) = (cost.function, cost.per_step, cost.per_call);
            writeln!(f, "  {function:name$}{step:>COLUMN$}{call:>COLUMN$}")?;
        }
        Ok(())
    }
}

/// The title of a section, unless the section is empty.
fn heading(f: &mut Formatter<'_>, title: &str, entries: usize) -> fmt::Result {
    if entries == 0 {
        return Ok(());
    }
    writeln!(f, "\n{title}")
}

fn formulas(f: &mut Formatter<'_>, formulas: &[Formula]) -> fmt::Result {
    for Formula { equation, unit, .. } in formulas {
        let mut lines = equation.lines().peekable();
        while let Some(line) = lines.next() {
            match lines.peek() {
                Some(_) => writeln!(f, "  {line}")?,
                None => writeln!(f, "  {line}   [{unit}]")?,
            }
        }
    }
    Ok(())
}

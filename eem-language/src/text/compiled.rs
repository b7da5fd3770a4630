//! A model compiled from texts.

use std::sync::OnceLock;

use eem_symbolic::{Model, ParameterPrograms, Programs};

use super::fault::{Fault, Faults};
use super::source::Source;
use super::stack::on_deep_stack;
use crate::ast::{Joint, Role, Strain};
use crate::expand::equation::{Equation, equations};
use crate::units::Quantities;

/// An argument of the free energy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Argument {
    /// Its name in the formulas.
    pub name: String,
    /// `Stretch`, `Viscous`, `Temperature`, or a role of solids.
    pub role: &'static str,
    /// Its unit.
    pub unit: String,
}

/// A formula that follows from the free energy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Formula {
    /// The symbol that it defines: `ψ`, `f`, `g_2`.
    pub symbol: String,
    /// Both sides; a long one is broken into lines.
    pub equation: String,
    /// The unit of both sides.
    pub unit: String,
}

/// A model whose texts have no errors.
///
/// ```
/// use eem_language::text::{Source, compile};
/// use eem_symbolic::F64;
///
/// let source = Source::new("|lambda: Stretch| 0.5 * k * (lambda - 1).powi(2)").parameter("k", None);
/// let compiled = compile(&source).unwrap();
/// let psi = &compiled.programs().unwrap().free_energy;
/// // k, lambda
/// assert_eq!(psi.interpret(&F64, &[100.0, 1.5]), [12.5]);
/// ```
#[derive(Clone, Debug)]
pub struct Compiled {
    source: Source,
    model: Model,
    /// In the order of the state.
    arguments: Vec<(String, Role)>,
    units: &'static Quantities,
    /// The first measures of the model; `joints` are the others.
    strains: Vec<Strain>,
    joints: Vec<Joint>,
    /// `None` if a number in them does not fit an `f64`.
    programs: OnceLock<Option<Programs>>,
    parameter_programs: OnceLock<Option<ParameterPrograms>>,
    /// The faults that are returned in that case.
    too_large: Faults,
    warnings: Vec<Fault>,
}

impl Compiled {
    pub(super) fn new(
        source: &Source,
        model: Model,
        (arguments, units): (Vec<(String, Role)>, &'static Quantities),
        (strains, joints): (Vec<Strain>, Vec<Joint>),
        [too_large, warnings]: [Faults; 2],
    ) -> Self {
        Self {
            source: source.clone(),
            model,
            arguments,
            units,
            strains,
            joints,
            programs: OnceLock::new(),
            parameter_programs: OnceLock::new(),
            too_large,
            warnings: warnings.0,
        }
    }

    /// The texts.
    ///
    /// ```
    /// use eem_language::text::{Source, compile};
    ///
    /// let source = Source::new("|lambda: Stretch| lambda.powi(2)");
    /// assert_eq!(compile(&source).unwrap().source(), &source);
    /// ```
    #[must_use]
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// ψ and the viscosities as expressions; the parameters are those that they mention, in the order of the source;
    /// every entry of an array is a parameter.
    ///
    /// ```
    /// use eem_language::text::{Source, compile};
    ///
    /// let source = Source::new("|lambda: Stretch| (k[0] + k[1] * b) * lambda.powi(2)");
    /// let source = source.parameter("b", None).parameter("k[2]", None);
    /// let compiled = compile(&source).unwrap();
    /// let model = compiled.model();
    /// let names: Vec<_> = model.parameters.iter().map(|&k| model.graph.name(k)).collect();
    /// assert_eq!(names, ["b", "k[0]", "k[1]"]);
    /// ```
    #[must_use]
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The arguments of the free energy in the order of the state: length or strains, viscous variables, temperature.
    ///
    /// ```
    /// use eem_language::text::{Source, compile};
    ///
    /// let source = Source::new("|theta: Temperature, x: Stretch| k * x - c * theta * ln(theta / 300)");
    /// let source = source.parameter("k", None).parameter("c", None);
    /// let arguments = compile(&source).unwrap().arguments();
    /// let arguments: Vec<_> = arguments.iter().map(|a| (&*a.name, a.role, &*a.unit)).collect();
    /// assert_eq!(arguments, [("x", "Stretch", "m"), ("theta", "Temperature", "K")]);
    /// ```
    #[must_use]
    pub fn arguments(&self) -> Vec<Argument> {
        let argument = |(name, role): &(String, Role)| Argument {
            name: name.clone(),
            role: role.name(),
            unit: self.units.of_role(*role).to_string(),
        };
        self.arguments.iter().map(argument).collect()
    }

    /// ψ, s, e, forces, dashpot forces, heat capacity and viscosities as text, as in `Describe` of a derived material.
    ///
    /// ```
    /// use eem_language::text::{Source, compile};
    ///
    /// let source = Source::new("|x: Stretch| 0.5 * k * (x - l).powi(2)");
    /// let source = source.parameter("k", Some("N/m")).parameter("l", Some("m"));
    /// let formulas = compile(&source).unwrap().formulas();
    /// assert_eq!(formulas[0].equation, "ψ = 0.5*k*(x - l)^2");
    /// assert_eq!((&*formulas[1].symbol, &*formulas[1].unit), ("f", "N"));
    /// ```
    #[must_use]
    pub fn formulas(&self) -> Vec<Formula> {
        let formulas = on_deep_stack(|| self.model.formulas());
        let equations = equations(&self.arguments, self.units, &formulas);
        let formula = |equation: Equation| Formula {
            equation: equation.lines.join("\n"),
            symbol: equation.symbol,
            unit: equation.unit,
        };
        equations.into_iter().map(formula).collect()
    }

    /// The strains that ψ depends on, the first measures of the model; empty for a spring.
    ///
    /// ```
    /// use eem_language::text::{Joint, Source, Strain, compile};
    ///
    /// let source = Source::new("|m2: ViscousSquare, e2: StrainSquare, m3: ViscousStrain| e2 - 2 * m3 + m2");
    /// let compiled = compile(&source.viscosity("m3", "5")).unwrap();
    /// assert_eq!(compiled.strains(), [Strain::Square]);
    /// assert_eq!(compiled.joints(), [Joint::Square, Joint::Strain]);
    /// ```
    #[must_use]
    pub fn strains(&self) -> &[Strain] {
        &self.strains
    }

    /// The invariants of a viscous strain that ψ depends on, the other measures of the model.
    #[must_use]
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// The programs of the model, made at the first call; the derive prints the same programs.
    ///
    /// # Errors
    ///
    /// If a derivative has a factor that does not fit an `f64`: the fault is at the value of ψ.
    ///
    /// ```
    /// use eem_language::text::{Source, compile};
    ///
    /// let source = Source::new("|lambda: Stretch| 1e200 * (1e200 * lambda).powi(2)");
    /// let compiled = compile(&source).unwrap();
    /// let faults = compiled.programs().unwrap_err();
    /// assert!(faults.all()[0].text.ends_with("has a factor that does not fit an `f64`"));
    /// assert_eq!(faults.all()[0].column, 19);
    /// ```
    pub fn programs(&self) -> Result<&Programs, Faults> {
        let make = || {
            let programs = self.model.programs();
            programs.verify().is_ok().then_some(programs)
        };
        let programs = self.programs.get_or_init(|| on_deep_stack(make));
        programs.as_ref().ok_or_else(|| self.too_large.clone())
    }

    /// The programs of the derivatives with respect to the parameters, made at the first call; the derive prints the same.
    ///
    /// # Errors
    ///
    /// As [`programs`](Self::programs).
    ///
    /// ```
    /// use eem_language::text::{Source, compile};
    /// use eem_symbolic::F64;
    ///
    /// let source = Source::new("|lambda: Stretch| 0.5 * k * (lambda - 1).powi(2)").parameter("k", None);
    /// let compiled = compile(&source).unwrap();
    /// let by_k = &compiled.parameter_programs().unwrap().energy_by_parameters;
    /// // k, lambda
    /// assert_eq!(by_k.interpret(&F64, &[100.0, 1.5]), [0.125]);
    /// ```
    pub fn parameter_programs(&self) -> Result<&ParameterPrograms, Faults> {
        let programs = self.programs()?;
        let make = || {
            let derivatives = self.model.parameter_programs(programs);
            derivatives.verify().is_ok().then_some(derivatives)
        };
        let derivatives = self.parameter_programs.get_or_init(|| on_deep_stack(make));
        derivatives.as_ref().ok_or_else(|| self.too_large.clone())
    }

    /// The warnings, about formulas that are accepted but lose digits, in the order of the source.
    ///
    /// ```
    /// use eem_language::text::{Source, compile};
    ///
    /// let source = Source::new("|e1: StrainTrace| ln(1 + e1).powi(2)");
    /// let compiled = compile(&source).unwrap();
    /// let warning = &compiled.warnings()[0];
    /// assert_eq!(warning.help, "write `ln_1p(x)` for `ln(1 + x)`");
    /// assert!(warning.to_string().starts_with("warning: `ln(1 + e1)` is inaccurate"));
    /// ```
    #[must_use]
    pub fn warnings(&self) -> &[Fault] {
        &self.warnings
    }
}

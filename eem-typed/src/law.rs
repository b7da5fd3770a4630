//! A law: compiled texts with values for their parameters.

use core::fmt;
use std::sync::{Arc, OnceLock};

use eem_language::text::{self, Compiled, Source};
use eem_material::Joint;
use eem_material::number::digest::Digest;
use eem_runtime::Strain;
use eem_symbolic::Model;

use crate::error::LawError;
use crate::functions::Functions;
use crate::names::{NAMELESS, name};
use crate::shape::{Measures, Shape, Size};
use crate::typed::Typed;

/// A material of texts and values, from which springs and solids are made.
///
/// The formulas are evaluated by the operations that a derived material consists of, in the same order: forces, entropies,
/// steps and certificates have the same bits. A copy shares everything.
///
/// ```
/// use eem::prelude::*;
/// use eem::typed::{Law, Source, ThermalSpring1, compile};
///
/// let source = Source::new("|lambda: Stretch, gamma: Viscous, theta: Temperature| {
///     let strain = ln(lambda / l);
///     0.5 * k * strain.powi(2) + 0.5 * k1 * (strain - gamma / l).powi(2)
///         - beta * (theta - t0) * strain + c * (theta - t0 - theta * ln(theta / t0))
/// }")
/// .viscosity("gamma", "eta * exp(a / theta)")
/// .parameter("l", Some("m"))
/// .parameter("k", Some("J"))
/// .parameter("k1", Some("J"))
/// .parameter("beta", Some("J/K"))
/// .parameter("c", Some("J/K"))
/// .parameter("t0", Some("K"))
/// .parameter("eta", Some("N s/m"))
/// .parameter("a", Some("K"));
/// let values = [
///     ("l", 1.0), ("k", 100.0), ("k1", 20.0), ("beta", 4.0), ("c", 1.0), ("t0", 300.0), ("eta", 5.0), ("a", 10.0),
/// ];
/// let law = Law::new(compile(&source)?, &values)?.named("rubber")?;
///
/// let mut scene = Scene::<2>::new();
/// let pivot = scene.anchor([0.0, 0.0]);
/// let bob = scene.mass(1.0, [3.0, 0.0], [0.0, 1.0]);
/// let rubber: ThermalSpring1 = law.model()?;
/// let spring = scene.spring(rubber, [pivot, bob]);
/// scene.set_temperature(spring, 380.0);
/// assert_eq!(spring.to_string(), "element 0 (rubber)");
///
/// let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.05)?;
/// let before = run.ledger().energy;
/// run.run_until(1.0)?;
/// assert!((run.ledger().energy - before).abs() < 1e-12 * before.abs());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone)]
pub struct Law {
    compiled: Arc<Compiled>,
    /// In the order of the parameters of the model.
    values: Arc<[f64]>,
    name: &'static &'static str,
    /// Made at the first request, for each size of a type.
    made: Arc<[OnceLock<Arc<Functions>>; Size::ALL.len()]>,
}

impl Law {
    /// Values for the parameters of compiled texts, those of an array one by one: `("k[0]", 1.0)`.
    ///
    /// # Errors
    ///
    /// If a parameter has no value or two, a value belongs to no parameter or is not finite, or a number in a derivative does
    /// not fit an `f64`.
    ///
    /// ```
    /// use eem::typed::{Law, Source, compile};
    ///
    /// let source = Source::new("|lambda: Stretch| 0.5 * k[0] * lambda.powi(2) + k[1] * lambda.powi(4)");
    /// let compiled = compile(&source.parameter("k[2]", None))?;
    /// let law = Law::new(compiled.clone(), &[("k[0]", 2.0), ("k[1]", 0.5)])?;
    /// assert_eq!(law.parameters().last(), Some(("k[1]", 0.5)));
    ///
    /// let error = Law::new(compiled, &[("k[0]", 2.0), ("k", 0.5)]).unwrap_err();
    /// let text = "there is no parameter `k` for the value 0.5: there are `k[0]`, `k[1]`";
    /// assert_eq!(error.to_string(), text);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(compiled: Compiled, values: &[(&str, f64)]) -> Result<Self, LawError> {
        compiled.programs().map_err(LawError::Programs)?;
        let values = in_order(&compiled, values)?;
        Ok(Self {
            compiled: Arc::new(compiled),
            values: values.into(),
            name: NAMELESS,
            made: Arc::default(),
        })
    }

    /// The same law with a name, which messages and handles of its elements show. The elements of two laws with different
    /// names are treated like those of two types.
    ///
    /// A name is kept until the program ends, so it has at most 64 bytes, and a program may use at most 1024 names.
    ///
    /// # Errors
    ///
    /// [`LawError::Name`] if the name is empty or longer, or the program uses more names.
    ///
    /// ```
    /// use eem::typed::{Law, Source, compile};
    ///
    /// let compiled = compile(&Source::new("|lambda: Stretch| lambda.powi(2)"))?;
    /// let law = Law::new(compiled, &[])?;
    /// assert_eq!(law.name(), "Law");
    /// assert_eq!(law.clone().named("string")?.name(), "string");
    /// assert!(law.named("").is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn named(self, text: &str) -> Result<Self, LawError> {
        Ok(Self {
            name: name(text)?,
            made: Arc::default(),
            ..self
        })
    }

    /// The name of the law, `Law` unless it has been given another.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// The same law with other values for some parameters; the texts are not compiled again.
    ///
    /// # Errors
    ///
    /// If a value belongs to no parameter or is not finite, or a parameter has two values.
    ///
    /// ```
    /// use eem::typed::{Law, Source, compile};
    ///
    /// let source = Source::new("|lambda: Stretch| 0.5 * k * (lambda - l).powi(2)");
    /// let compiled = compile(&source.parameter("k", None).parameter("l", None))?;
    /// let law = Law::new(compiled, &[("k", 40.0), ("l", 2.0)])?.with_values(&[("k", 10.0)])?;
    /// assert_eq!(law.parameters().collect::<Vec<_>>(), [("k", 10.0), ("l", 2.0)]);
    /// assert!(law.with_values(&[("m", 1.0)]).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_values(&self, values: &[(&str, f64)]) -> Result<Self, LawError> {
        let kept = self.parameters();
        let kept = kept.filter(|(name, _)| values.iter().all(|(other, _)| other != name));
        let all: Vec<_> = kept.chain(values.iter().copied()).collect();
        Ok(Self {
            values: in_order(&self.compiled, &all)?.into(),
            made: Arc::default(),
            ..self.clone()
        })
    }

    /// The compiled texts: arguments, formulas, warnings.
    ///
    /// ```
    /// use eem::typed::{Law, Source, compile};
    ///
    /// let compiled = compile(&Source::new("|lambda: Stretch| 3 * lambda.powi(2)"))?;
    /// let law = Law::new(compiled, &[])?;
    /// assert_eq!(law.compiled().formulas()[1].equation, "f = ∂ψ/∂lambda = 6*lambda");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn compiled(&self) -> &Compiled {
        &self.compiled
    }

    /// ψ of many states, J, for drawing. The states follow one another, each in the order of [`Compiled::arguments`]. In a
    /// scene [`model`](Self::model) evaluates ψ, with the same bits.
    ///
    /// # Errors
    ///
    /// [`LawError::States`] if the numbers do not make whole states; see [`model`](Self::model) for others.
    ///
    /// ```
    /// use eem::typed::{Law, Source, compile};
    ///
    /// let compiled = compile(&Source::new("|lambda: Stretch| 3 * lambda.powi(2)"))?;
    /// let law = Law::new(compiled, &[])?;
    /// assert_eq!(law.free_energies(&[1.0, 2.0])?, [3.0, 12.0]);
    /// assert_eq!(law.gradients(&[1.0, 2.0])?, [6.0, 12.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn free_energies(&self, states: &[f64]) -> Result<Vec<f64>, LawError> {
        self.tabulate(states, |functions, x| {
            let mut energy = vec![0.0];
            functions.free_energy.run([x], [&mut energy]);
            energy
        })
    }

    /// `∂ψ/∂x = (f, −g, −s)` of many states, an entry per variable: forces, negative dashpot forces, negative entropy.
    ///
    /// # Errors
    ///
    /// As [`free_energies`](Self::free_energies).
    pub fn gradients(&self, states: &[f64]) -> Result<Vec<f64>, LawError> {
        self.tabulate(states, |functions, x| {
            let mut gradient = vec![0.0; x.len()];
            functions.gradient.run([x], [&mut gradient]);
            functions.gathered(&gradient)
        })
    }

    fn tabulate(
        &self,
        states: &[f64],
        of: impl Fn(&Functions, &[f64]) -> Vec<f64>,
    ) -> Result<Vec<f64>, LawError> {
        let variables = self.shape().variables();
        if !states.len().is_multiple_of(variables) {
            return Err(LawError::States {
                numbers: states.len(),
                variables,
            });
        }
        let functions = self.functions(self.shape().least_size())?;
        let states = states.chunks(variables);
        Ok(states
            .flat_map(|x| of(&functions, &functions.spread(x)))
            .collect())
    }

    /// The texts.
    ///
    /// ```
    /// use eem::typed::{Law, Source, compile};
    ///
    /// let source = Source::new("|lambda: Stretch| lambda.powi(2)");
    /// assert_eq!(Law::new(compile(&source)?, &[])?.source(), &source);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn source(&self) -> &Source {
        self.compiled.source()
    }

    /// The parameters that the formulas mention, and their values, in the order of the source.
    ///
    /// ```
    /// use eem::typed::{Law, Source, compile};
    ///
    /// let source = Source::new("|lambda: Stretch| 0.5 * k * (lambda - l).powi(2)");
    /// let compiled = compile(&source.parameter("l", None).parameter("k", None))?;
    /// let law = Law::new(compiled, &[("k", 40.0), ("l", 2.0)])?;
    /// assert_eq!(law.parameters().collect::<Vec<_>>(), [("l", 2.0), ("k", 40.0)]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn parameters(&self) -> impl Iterator<Item = (&str, f64)> {
        names(self.compiled.model()).zip(self.values.iter().copied())
    }

    /// The law as a material: for [`Scene::spring`](eem_runtime::Scene::spring), [`Scene::solid`](eem_runtime::Scene::solid)
    /// and whatever else takes a [`FreeEnergy`](eem_material::FreeEnergy).
    ///
    /// The type says which variables the law has: [`ThermalSpring1`](crate::ThermalSpring1) and the like for springs,
    /// [`solid!`](crate::solid) for solids. Its tapes are made once and shared. Clone it for another
    /// element.
    ///
    /// # Errors
    ///
    /// [`LawError::Shape`] if the law is not one of that type, [`LawError::TooLarge`] if the formulas are too large.
    ///
    /// ```
    /// use eem::FreeEnergy;
    /// use eem::typed::{Law, LawError, Source, Spring0, ThermalSpring1, compile};
    ///
    /// let source = Source::new("|lambda: Stretch| 0.5 * k * (lambda - 1).powi(2)").parameter("k", None);
    /// let law = Law::new(compile(&source)?, &[("k", 1e300)])?;
    /// let spring: Spring0 = law.model()?;
    /// assert_eq!(spring.gradient(&[2.0]), [1e300]);
    ///
    /// let spring: Result<ThermalSpring1, LawError> = law.model();
    /// let text = "the law has 1 stretch; the type of the material has 1 stretch, 1 dashpot in series, 1 temperature";
    /// assert_eq!(spring.unwrap_err().to_string(), text);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn model<
        H: Measures,
        const N: usize,
        const K: usize,
        const V: usize,
        const D: usize,
        const C: usize,
        const R: usize,
        const O: usize,
    >(
        &self,
    ) -> Result<Typed<H, N, K, V, D, C, R, O>, LawError> {
        let [law, material] = [self.shape(), Typed::<H, N, K, V, D, C, R, O>::SHAPE];
        let size = material.size_for(&law).ok_or_else(|| LawError::Shape {
            law: law.to_string(),
            material: material.of_type(),
        })?;
        self.functions(size).map(Typed::new)
    }

    pub(crate) fn shape(&self) -> Shape {
        Shape::of(&self.compiled)
    }

    /// The tapes for a type of this size.
    fn functions(&self, size: Size) -> Result<Arc<Functions>, LawError> {
        let made = &self.made[size as usize];
        if let Some(functions) = made.get() {
            return Ok(Arc::clone(functions));
        }
        let programs = self.compiled.programs().map_err(LawError::Programs)?;
        let shape = self.shape();
        let identity = (self.name, self.kind());
        let measures = (self.strains(), self.joints());
        let texts = (&self.compiled, programs);
        let functions = Functions::new(
            identity,
            measures,
            texts,
            self.values.to_vec(),
            [&shape, &shape.of_size(size)],
        )?;
        Ok(Arc::clone(made.get_or_init(|| Arc::new(functions))))
    }

    /// The strains of a solid, as the runtime names them.
    fn strains(&self) -> Box<[Strain]> {
        let strains = self.compiled.strains().iter();
        let strains = strains.map(|strain| match strain {
            text::Strain::Trace => Strain::Trace,
            text::Strain::Square => Strain::Square,
            text::Strain::Dilatation => Strain::Dilatation,
            text::Strain::Fibre => Strain::Fibre,
        });
        let components = (0..self.shape().components()).map(Strain::Component);
        strains.chain(components).collect()
    }

    fn joints(&self) -> Box<[Joint]> {
        let joints = self.compiled.joints().iter();
        let joints = joints.map(|joint| match joint {
            text::Joint::Trace => Joint::Trace,
            text::Joint::Square => Joint::Square,
            text::Joint::Strain => Joint::Strain,
        });
        joints.collect()
    }

    /// A digest of its name and texts, without values; never 0.
    fn kind(&self) -> u64 {
        let source = self.source();
        let digest = Digest::of(|digest| {
            let mut add = |text: &str| {
                digest.count(text.len());
                digest.bytes(text.as_bytes());
            };
            add(self.name);
            add(source.free_energy());
            for (dashpot, law) in source.viscosities() {
                add(dashpot);
                add(law);
            }
            for name in names(self.compiled.model()) {
                add(name);
            }
        });
        digest.bits().max(1)
    }
}

impl fmt::Debug for Law {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut all = f.debug_struct(self.name);
        for (name, value) in self.parameters() {
            all.field(name, &value);
        }
        all.finish_non_exhaustive()
    }
}

/// The names of the parameters.
fn names(model: &Model) -> impl Iterator<Item = &str> {
    let parameters = model.parameters.iter();
    parameters.map(|&parameter| model.graph.name(parameter))
}

/// The values in the order of the parameters.
fn in_order(compiled: &Compiled, given: &[(&str, f64)]) -> Result<Vec<f64>, LawError> {
    let model = compiled.model();
    for (index, &(name, value)) in given.iter().enumerate() {
        if !names(model).any(|known| known == name) && !is_spare(compiled, name) {
            let known: Vec<_> = names(model).map(|name| format!("`{name}`")).collect();
            let help = if known.is_empty() {
                "there are none".to_owned()
            } else {
                format!("there are {}", known.join(", "))
            };
            let name = name.to_owned();
            return Err(LawError::Unknown { name, value, help });
        }
        if let Some(&(_, first)) = given[..index].iter().find(|(other, _)| *other == name) {
            return Err(LawError::Repeated {
                name: name.to_owned(),
                first,
                second: value,
            });
        }
        if !value.is_finite() {
            return Err(LawError::NotFinite {
                name: name.to_owned(),
                value,
            });
        }
    }
    let value = |name: &str| {
        let given = given.iter().find(|(other, _)| *other == name);
        given.map(|&(_, value)| value).ok_or(LawError::Missing {
            name: name.to_owned(),
        })
    };
    names(model).map(value).collect()
}

/// Whether this is a parameter like `_k`, or an entry of one, which no formula has to mention.
fn is_spare(compiled: &Compiled, name: &str) -> bool {
    let base = |text: &'_ str| text.split('[').next().map(|base| base.trim().to_owned());
    let mut parameters = compiled.source().parameters();
    name.starts_with('_') && parameters.any(|(text, _)| base(text) == base(name))
}

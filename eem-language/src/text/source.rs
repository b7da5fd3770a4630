//! The texts of a model, as they were written.

/// Bytes that the text of a formula may have.
pub const LONGEST: usize = 64 << 10;

/// A free energy, viscosities, and parameters with their units, as texts.
///
/// ```
/// use eem_language::text::{Source, compile};
///
/// let source = Source::new("|lambda: Stretch, theta: Temperature| {
///     0.5 * k[0] * (lambda - length).powi(2) + k[1] * lambda.powi(4)
///         + c * (theta - 300 - theta * ln(theta / 300))
/// }")
/// .viscosity("lambda", "eta * exp(300 / theta)")
/// .parameter("k[2]", None)
/// .parameter("length", None)
/// .parameter("c", None)
/// .parameter("eta", None);
/// let model = compile(&source).unwrap();
/// assert_eq!(model.model().parameters.len(), 5);
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Source {
    pub(super) free_energy: String,
    pub(super) viscosities: Vec<(String, String)>,
    pub(super) parameters: Vec<(String, Option<String>)>,
}

impl Source {
    /// A free energy: a closure whose arguments have roles.
    ///
    /// ```
    /// use eem_language::text::Source;
    ///
    /// let source = Source::new("|lambda: Stretch| lambda.powi(2)");
    /// assert_eq!(source.free_energy(), "|lambda: Stretch| lambda.powi(2)");
    /// ```
    #[must_use]
    pub fn new(free_energy: impl Into<String>) -> Self {
        Self {
            free_energy: free_energy.into(),
            viscosities: Vec::new(),
            parameters: Vec::new(),
        }
    }

    /// The same with the viscosity of a dashpot, of a viscous strain, or of the stretch: a function of the temperature
    /// and the parameters, in N s/m (Pa s in a solid).
    ///
    /// ```
    /// use eem_language::text::Source;
    ///
    /// let source = Source::new("…").viscosity("gamma", "eta * exp(a / theta)");
    /// assert_eq!(source.viscosities().next(), Some(("gamma", "eta * exp(a / theta)")));
    /// ```
    #[must_use]
    pub fn viscosity(mut self, dashpot: impl Into<String>, law: impl Into<String>) -> Self {
        self.viscosities.push((dashpot.into(), law.into()));
        self
    }

    /// The same with a parameter, or with an array of them as in `k[3]`. If one parameter has a unit, all have one, `1`
    /// if it is dimensionless, and the units of the formulas are checked.
    ///
    /// ```
    /// use eem_language::text::Source;
    ///
    /// let source = Source::new("…").parameter("k", Some("N/m")).parameter("a", Some("1"));
    /// let parameters: Vec<_> = source.parameters().collect();
    /// assert_eq!(parameters, [("k", Some("N/m")), ("a", Some("1"))]);
    /// ```
    #[must_use]
    pub fn parameter(mut self, name: impl Into<String>, unit: Option<&str>) -> Self {
        self.parameters
            .push((name.into(), unit.map(ToOwned::to_owned)));
        self
    }

    /// The text of the free energy; see [`new`](Self::new).
    #[must_use]
    pub fn free_energy(&self) -> &str {
        &self.free_energy
    }

    /// Names and laws, in the order in which they were added; see [`viscosity`](Self::viscosity).
    pub fn viscosities(&self) -> impl Iterator<Item = (&str, &str)> {
        let all = self.viscosities.iter();
        all.map(|(dashpot, law)| (dashpot.as_str(), law.as_str()))
    }

    /// Names and units, in the order in which they were added; see [`parameter`](Self::parameter).
    pub fn parameters(&self) -> impl Iterator<Item = (&str, Option<&str>)> {
        let all = self.parameters.iter();
        all.map(|(name, unit)| (name.as_str(), unit.as_deref()))
    }
}

//! The search of a box of states for one in which a material is invalid.
//!
//! A formula that compiles can still be no material: its heat capacity may become negative beyond
//! a spinodal, a viscosity may change its sign, a logarithm may leave its domain. The check examines
//! the corners of the box and a sample that fills it evenly, and descends from the worst of these.

mod error;
mod point;
mod search;
mod state;

use crate::free_energy::{Array, FreeEnergy};

pub use error::DomainError;
pub use point::{DomainReport, Least};
use point::{Shape, Space};
pub use state::DomainPoint;
use state::Kind;

/// A box of states: an interval for each variable of a model.
///
/// ```
/// use eem::Domain;
///
/// // One dashpot.
/// let domain = Domain::of_stretch([0.5, 2.0])
///     .with_viscous([-0.5, 0.5])
///     .with_temperature([250.0, 400.0]);
/// assert_eq!(domain.ranges().count(), 3);
///
/// // A solid with e1, e2 and j, in the order of the arguments.
/// let domain = Domain::of_strains([[-0.1, 0.2], [0.0, 0.05], [-0.1, 0.2]]);
/// assert_eq!(domain.ranges().count(), 3);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Domain {
    kind: Kind,
    measures: Vec<[f64; 2]>,
    viscous: Vec<[f64; 2]>,
    temperature: Option<[f64; 2]>,
}

impl Domain {
    /// All stretches between two lengths, m.
    #[must_use]
    pub fn of_stretch(range: [f64; 2]) -> Self {
        Self::of(Kind::Spring, vec![range])
    }

    /// A box of strains of a solid, in the order of the arguments of its free energy.
    ///
    /// The strains of a body are not independent, so the box contains impossible states. You can ignore errors
    /// about those.
    #[must_use]
    pub fn of_strains(ranges: impl IntoIterator<Item = [f64; 2]>) -> Self {
        Self::of(Kind::Solid, ranges.into_iter().collect())
    }

    fn of(kind: Kind, measures: Vec<[f64; 2]>) -> Self {
        Self {
            kind,
            measures,
            viscous: Vec::new(),
            temperature: None,
        }
    }

    /// With the viscous stretches of the next dashpot, m; viscous strains in a solid.
    #[must_use]
    pub fn with_viscous(mut self, range: [f64; 2]) -> Self {
        self.viscous.push(range);
        self
    }

    /// With all temperatures between two, K.
    #[must_use]
    pub fn with_temperature(mut self, range: [f64; 2]) -> Self {
        self.temperature = Some(range);
        self
    }

    /// The intervals in the order of the variables: stretch or strains, viscous variables, temperature.
    pub fn ranges(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        let mechanical = self.measures.iter().chain(&self.viscous);
        mechanical.copied().chain(self.temperature)
    }

    fn shape(&self) -> Shape {
        Shape {
            kind: self.kind,
            measures: self.measures.len(),
            dashpots: self.viscous.len(),
            thermal: self.temperature.is_some(),
        }
    }
}

/// Searches a box for states in which a model is not a valid material.
///
/// In every state that is evaluated
///
/// ```text
/// ψ, ∂ψ/∂x, ∂²ψ/∂x²  finite,    C = θ ∂s/∂θ > 0,    η_k(θ) > 0
/// ```
///
/// must hold; conditions on a temperature or dashpots apply if the model has them. The states are the corners of
/// the box, `samples` points of a sequence that fills it evenly (lengths and temperatures in their logarithm), and
/// the path of a descent from the smallest heat capacities and viscosities. The result is the same in every run.
///
/// A report is evidence, not a proof: a dip between the points can be missed. More samples find narrower dips.
///
/// # Errors
///
/// [`DomainError`] with the first invalid state and its value, or if the box does not fit the model.
///
/// # Example
///
/// A spring whose stiffness is logarithmic in the temperature (Conde Martín, Betsch & García Orden
/// 2016, eq. 43) has a positive heat capacity only above a spinodal that grows with the strain:
///
/// ```text
/// C = c − C₁ θ_r ln²(λ/L)/(2 θ) > 0   for   θ > θ_c = C₁ θ_r ln²(λ/L)/(2 c)
/// ```
///
/// ```
/// use eem::prelude::*;
/// use eem::{Domain, DomainError, check_domain};
///
/// #[derive(FreeEnergy)]
/// #[free_energy(|lambda: Stretch, theta: Temperature| {
///     let stiffness = c0 - c1 * theta_ref * ln(theta / theta_ref);
///     0.5 * stiffness * ln(lambda / length).powi(2)
///         + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
/// })]
/// struct Spring { c0: f64, c1: f64, length: f64, capacity: f64, theta_ref: f64 }
///
/// let spring = Spring { c0: 5000.0, c1: 50.0, length: 1.0, capacity: 100.0, theta_ref: 300.0 };
/// let domain = |longest| Domain::of_stretch([1.0, longest]).with_temperature([200.0, 400.0]);
///
/// // At λ = e the spinodal is at 75 K, and C = 100 − 7500/200 = 62.5 J/K at 200 K.
/// let report = check_domain(&spring, &domain(1_f64.exp()), 200)?;
/// let least = report.heat_capacity.expect("there is a temperature");
/// assert!((least.value - 62.5).abs() < 1e-12);
/// assert_eq!(least.point.temperature, Some(200.0));
///
/// // At λ = e² it is at 300 K.
/// let error = check_domain(&spring, &domain(2_f64.exp()), 200).unwrap_err();
/// let DomainError::HeatCapacity { value, point } = &error else { panic!("{error}") };
/// let [theta, strain] = [point.temperature.unwrap(), point.measures[0].ln()];
/// assert!(theta < 7500.0 * strain.powi(2) / 100.0);
/// assert!((value - (100.0 - 7500.0 * strain.powi(2) / theta)).abs() < 1e-12);
/// # Ok::<(), DomainError>(())
/// ```
pub fn check_domain<M: FreeEnergy<f64>>(
    model: &M,
    domain: &Domain,
    samples: usize,
) -> Result<DomainReport, DomainError> {
    let shape = Shape {
        kind: Kind::of(M::PER_VOLUME),
        measures: M::MEASURES,
        dashpots: model.dashpots(),
        thermal: M::THERMAL,
    };
    shape.expect(domain.shape())?;
    let ranges: Vec<[f64; 2]> = domain.ranges().collect();
    let space = Space::new(shape, ranges)?;
    search::search(&space, samples, &|x| examine(model, &space, x))
}

/// The heat capacity of a valid state, then the viscosities of its dashpots, then that of the stretch, as far as it has them.
fn examine<M: FreeEnergy<f64>>(
    model: &M,
    space: &Space,
    x: &[f64],
) -> Result<Vec<f64>, DomainError> {
    let mut variables = M::Variables::filled(0.0);
    let mechanical = M::MEASURES + model.dashpots();
    for (index, &value) in x.iter().enumerate() {
        let unused = if index < mechanical {
            0
        } else {
            M::DASHPOTS - model.dashpots()
        };
        variables[index + unused] = value;
    }
    let point = || space.point(x);
    let finite = |quantity: &'static str, values: &[f64]| {
        let wrong = values.iter().find(|value| !value.is_finite());
        wrong.map_or(Ok(()), |value| {
            Err(DomainError::NotFinite {
                quantity,
                value: *value,
                point: point(),
            })
        })
    };
    finite("free energy", &[model.free_energy(&variables)])?;
    let (gradient, hessian) = model.hessian(&variables);
    finite("first derivative of the free energy", gradient.as_ref())?;
    for row in hessian.as_ref() {
        finite("second derivative of the free energy", row.as_ref())?;
    }
    let mut found = Vec::with_capacity(1 + model.dashpots());
    let mut take = |value: f64, error: &dyn Fn(f64, DomainPoint) -> DomainError| {
        if value > 0.0 && value.is_finite() {
            found.push(value);
            return Ok(());
        }
        Err(error(value, point()))
    };
    if M::THERMAL {
        let heat_capacity = model.caloric(&variables).heat_capacity;
        take(heat_capacity, &|value, point| DomainError::HeatCapacity {
            value,
            point,
        })?;
    }
    let theta = if M::THERMAL { x[x.len() - 1] } else { 0.0 };
    let viscosities = model.viscosity(theta).0;
    let unused = model.dashpots()..M::DASHPOTS;
    let viscosities = viscosities.as_ref().iter().enumerate();
    for (dashpot, &value) in viscosities.filter(|(dashpot, _)| !unused.contains(dashpot)) {
        take(value, &|value, point| DomainError::Viscosity {
            dashpot,
            value,
            point,
        })?;
    }
    for &value in &model.drag(theta).0.as_ref()[..model.drags()] {
        take(value, &|value, point| DomainError::Drag { value, point })?;
    }
    Ok(found)
}

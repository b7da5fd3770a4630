//! The quantities that can be recorded.

use core::fmt;
use core::slice::Iter;

use crate::element::handle::{Element, HeatPath, Node, Reservoir};
use crate::run::ledger::Ledger;
use crate::run::simulation::Simulation;
use crate::scene::error::SceneError;
use eem_material::number::compensated::Sum;

/// A quantity of a simulation that a [`Recorder`](super::Recorder) keeps.
///
/// A vector takes a column per component. The angular momentum is a single column in the plane.
///
/// ```
/// use eem::prelude::*;
///
/// let run = Simulation::new(Scene::<3>::new(), Scheme::EemEntropy, 0.1)?;
/// let work = Quantity::Ledger(|ledger| ledger.work);
/// let recorder = Recorder::new(&run, [("L", Quantity::AngularMomentum), ("work", work)])?;
/// assert_eq!(recorder.columns().len(), 5); // time, L_x, L_y, L_z, work
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
#[non_exhaustive]
pub enum Quantity<const D: usize> {
    /// The position of a node, m.
    Position(Node),
    /// The momentum of a node, kg m/s.
    Momentum(Node),
    /// The velocity of a node, m/s.
    Velocity(Node),
    /// The stretch of an element, m.
    Stretch(Element),
    /// The force of an element, N.
    Force(Element),
    /// The internal energy of an element, J.
    InternalEnergy(Element),
    /// The temperature of an element, K.
    Temperature(Element),
    /// The entropy of an element, J/K.
    Entropy(Element),
    /// The viscous stretch of a dashpot (from 0) of an element, m.
    ViscousStretch(Element, usize),
    /// The entropy that a reservoir has received, J/K.
    ReservoirEntropy(Reservoir),
    /// The heat that a reservoir has received, J.
    ReservoirHeat(Reservoir),
    /// The total energy E of the ledger, J.
    TotalEnergy,
    /// The total entropy S of the ledger, J/K.
    TotalEntropy,
    /// The linear momentum of the ledger, kg m/s.
    LinearMomentum,
    /// The angular momentum of the ledger, kg m²/s.
    AngularMomentum,
    /// The kinetic energy of the ledger, J.
    KineticEnergy,
    /// The potential energy of the ledger, J.
    PotentialEnergy,
    /// The internal energy of all elements, of the ledger, J.
    TotalInternalEnergy,
    /// Work of loads and moved anchors since the start, of the ledger, J.
    Work,
    /// Heat of thermostats since the start, of the ledger, J.
    Heat,
    /// `E − work − heat` of the ledger, J.
    Balance,
    /// The heat that the dashpots of an element have dissipated since the last row, as the steps booked it, J; see
    /// [`Simulation::dissipation`].
    Dissipation(Element),
    /// The heat that one dashpot (from 0) of an element has dissipated since the last row, J; see [`Simulation::dissipation_of`].
    DissipationOf(Element, usize),
    /// The entropy that an element has produced since the last row, J/K; see [`Simulation::produced_entropy`].
    EntropyProduction(Element),
    /// The heat that a path has brought to its element since the last row, J; see [`Simulation::conducted_heat`].
    HeatFlow(HeatPath),
    /// The sum of quantities with one component each, made by [`Quantity::sum`].
    Sum(Vec<Self>),
    /// Any other field of the ledger. Its unit is unknown; use [`custom_in`](Self::custom_in) for a column with a
    /// unit.
    Ledger(fn(&Ledger<D>) -> f64),
    /// Newton iterations since the previous row; 0 in the first row.
    NewtonIterations,
    /// A function of the simulation.
    Custom(CustomQuantity<D>),
}

/// A function of the simulation as a [`Quantity`], made by [`Quantity::custom`].
pub struct CustomQuantity<const D: usize> {
    function: Box<Function<D>>,
    unit: &'static str,
}

type Function<const D: usize> = dyn Fn(&Simulation<D>) -> f64 + Send + Sync;

impl<const D: usize> fmt::Debug for CustomQuantity<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a function")
    }
}

/// Names of the axes in the columns.
const AXES: [&str; 3] = ["x", "y", "z"];

/// The name of an axis, from 0: a letter, or its number beyond the third.
pub(crate) fn axis_name(index: usize) -> String {
    let letter = AXES.get(index).copied();
    letter.map_or_else(|| index.to_string(), str::to_owned)
}

impl<const D: usize> Quantity<D> {
    /// A function of the simulation.
    pub fn custom(function: impl Fn(&Simulation<D>) -> f64 + Send + Sync + 'static) -> Self {
        Self::custom_in("", function)
    }

    /// A function of the simulation with a unit for the header of its column.
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<1>::new();
    /// scene.mass(2.0, [0.0], [3.0]);
    /// let run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// let kinetic = Quantity::custom_in("J", |run: &Simulation<1>| run.ledger().kinetic_energy);
    /// let recorder = Recorder::new(&run, [("kinetic", kinetic)])?;
    /// assert_eq!(recorder.columns()[1].head(), "kinetic (J)");
    /// assert_eq!(recorder.column("kinetic"), Some([9.0].as_slice()));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn custom_in(
        unit: &'static str,
        function: impl Fn(&Simulation<D>) -> f64 + Send + Sync + 'static,
    ) -> Self {
        let function = Box::new(function);
        Self::Custom(CustomQuantity { function, unit })
    }

    /// The sum of quantities that have one component and the same unit each, for instance over the points of a solid or the
    /// [elements of a model](Simulation::elements_of).
    ///
    /// ```
    /// use eem::materials::Hooke;
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<1>::new();
    /// let nodes = [scene.anchor([0.0]), scene.mass(1.0, [1.5], [0.0]), scene.mass(1.0, [2.0], [0.0])];
    /// for ends in nodes.windows(2) {
    ///     scene.spring(Hooke { stiffness: 4.0, natural_length: 1.0 }, [ends[0], ends[1]]);
    /// }
    /// let run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// let energy = Quantity::sum(run.elements_of("Hooke").map(Quantity::InternalEnergy));
    /// let recorder = Recorder::new(&run, [("energy", energy)])?;
    /// // ½ k Δλ² each
    /// assert_eq!(recorder.column("energy"), Some([1.0].as_slice()));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn sum(quantities: impl IntoIterator<Item = Self>) -> Self {
        Self::Sum(quantities.into_iter().collect())
    }

    /// The unit of its values; empty if there is none or it is unknown.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        match self {
            Self::Position(_) | Self::Stretch(_) | Self::ViscousStretch(..) => "m",
            Self::Momentum(_) | Self::LinearMomentum => "kg m/s",
            Self::Velocity(_) => "m/s",
            Self::Force(_) => "N",
            Self::InternalEnergy(_)
            | Self::ReservoirHeat(_)
            | Self::TotalEnergy
            | Self::KineticEnergy
            | Self::PotentialEnergy
            | Self::TotalInternalEnergy
            | Self::Work
            | Self::Heat
            | Self::Balance
            | Self::Dissipation(_)
            | Self::DissipationOf(..)
            | Self::HeatFlow(_) => "J",
            Self::Sum(all) => all.first().map_or("", Self::unit),
            Self::Temperature(_) => "K",
            Self::Entropy(_)
            | Self::ReservoirEntropy(_)
            | Self::TotalEntropy
            | Self::EntropyProduction(_) => "J/K",
            Self::AngularMomentum => "kg m²/s",
            Self::NewtonIterations | Self::Ledger(_) => "",
            Self::Custom(custom) => custom.unit,
        }
    }

    /// Whether the values are whole numbers.
    pub(super) const fn is_count(&self) -> bool {
        matches!(self, Self::NewtonIterations)
    }

    /// The names of its columns.
    pub(crate) fn columns(&self, name: &str) -> Vec<String> {
        let components = match self {
            Self::Position(_) | Self::Momentum(_) | Self::Velocity(_) | Self::LinearMomentum => D,
            Self::AngularMomentum if D > 2 => 3,
            _ => return vec![name.to_owned()],
        };
        let column = |index: usize| format!("{name}_{}", axis_name(index));
        (0..components).map(column).collect()
    }

    /// An error unless the simulation has this quantity. Requests the sums that it needs, and does not call custom functions.
    pub(super) fn check(&self, run: &Simulation<D>) -> Result<(), SceneError> {
        match self {
            Self::Custom(_) => Ok(()),
            Self::Sum(all) => {
                for quantity in all {
                    quantity.check(run)?;
                }
                let are_alike = all.iter().all(|own| own.unit() == self.unit());
                let are_single = all.iter().all(|own| own.columns("").len() == 1);
                if are_alike && are_single {
                    Ok(())
                } else {
                    Err(SceneError::MixedSum)
                }
            }
            built_in => {
                if built_in.metered(run)?.is_some() {
                    run.request_meters();
                }
                built_in.append(run, 0, &mut None, &mut [].iter(), &mut Vec::new())
            }
        }
    }

    /// Its present components.
    #[cfg(feature = "gradients")]
    pub(crate) fn present(&self, run: &Simulation<D>) -> Result<Vec<f64>, SceneError> {
        let mut row = Vec::new();
        self.append(run, 0, &mut None, &mut [].iter(), &mut row)?;
        Ok(row)
    }

    /// The name of its kind.
    #[cfg(feature = "gradients")]
    pub(crate) fn kind(&self) -> String {
        let shown = format!("{self:?}");
        let name = shown.split('(').next().unwrap_or_default();
        format!("`Quantity::{name}`")
    }

    /// The sum whose change since the last row is recorded; `None` for other quantities.
    fn metered(&self, run: &Simulation<D>) -> Result<Option<Sum>, SceneError> {
        match self {
            Self::Dissipation(element) => run.dissipation_sum(*element).map(Some),
            Self::DissipationOf(element, dashpot) => {
                run.dissipation_sum_of(*element, *dashpot).map(Some)
            }
            Self::EntropyProduction(element) => run.produced_sum(*element).map(Some),
            Self::HeatFlow(path) => run.conducted_sum(*path).map(Some),
            _ => Ok(None),
        }
    }

    /// Appends the sums whose changes are recorded; for [`Quantity::Sum`] those of its terms, one by one.
    pub(super) fn add_metered(
        &self,
        run: &Simulation<D>,
        sums: &mut Vec<Sum>,
    ) -> Result<(), SceneError> {
        if let Self::Sum(all) = self {
            return all.iter().try_for_each(|own| own.add_metered(run, sums));
        }
        sums.extend(self.metered(run)?);
        Ok(())
    }

    /// Appends its present values to `row`. The ledger is computed once for all quantities of a row; `last` has the sums at
    /// the last row.
    pub(super) fn append(
        &self,
        run: &Simulation<D>,
        iterations: usize,
        ledger: &mut Option<Ledger<D>>,
        last: &mut Iter<'_, Sum>,
        row: &mut Vec<f64>,
    ) -> Result<(), SceneError> {
        if let Some(sum) = self.metered(run)? {
            let change = last.next().map_or(0.0, |last| sum.change(*last));
            row.push(change);
            return Ok(());
        }
        if let Self::Sum(all) = self {
            let start = row.len();
            for quantity in all {
                quantity.append(run, iterations, ledger, last, row)?;
            }
            let sum = row.drain(start..).sum();
            row.push(sum);
            return Ok(());
        }
        let mut totals = || *ledger.get_or_insert_with(|| run.ledger());
        let mut push = |components: &[f64]| row.extend(components.iter());
        match self {
            Self::Position(node) => push(run.position(*node)?.as_slice()),
            Self::Momentum(node) => push(run.momentum(*node)?.as_slice()),
            Self::Velocity(node) => push(run.velocity(*node)?.as_slice()),
            Self::LinearMomentum => push(totals().linear_momentum.as_slice()),
            Self::AngularMomentum if D > 2 => push(totals().angular_momentum.as_slice()),
            Self::AngularMomentum => push(&[totals().angular_momentum[2]]),
            Self::Stretch(element) => push(&[run.stretch(*element)?]),
            Self::Force(element) => push(&[run.force(*element)?]),
            Self::InternalEnergy(element) => push(&[run.internal_energy(*element)?]),
            Self::Temperature(element) => push(&[run.temperature(*element)?]),
            Self::Entropy(element) => push(&[run.entropy(*element)?]),
            Self::ViscousStretch(element, dashpot) => {
                push(&[run.viscous_stretch(*element, *dashpot)?]);
            }
            Self::ReservoirEntropy(reservoir) => push(&[run.reservoir_entropy(*reservoir)?]),
            Self::ReservoirHeat(reservoir) => push(&[run.reservoir_heat(*reservoir)?]),
            Self::TotalEnergy => push(&[totals().energy]),
            Self::KineticEnergy => push(&[totals().kinetic_energy]),
            Self::PotentialEnergy => push(&[totals().potential_energy]),
            Self::TotalInternalEnergy => push(&[totals().internal_energy]),
            Self::Work => push(&[totals().work]),
            Self::Heat => push(&[totals().heat]),
            Self::Balance => push(&[totals().balance]),
            Self::TotalEntropy => push(&[totals().entropy]),
            Self::Ledger(entry) => push(&[entry(&totals())]),
            Self::NewtonIterations => {
                row.push(u32::try_from(iterations).map_or(f64::INFINITY, f64::from));
            }
            Self::Custom(custom) => push(&[(custom.function)(run)]),
            // Appended above.
            Self::Dissipation(_)
            | Self::DissipationOf(..)
            | Self::EntropyProduction(_)
            | Self::HeatFlow(_)
            | Self::Sum(_) => {}
        }
        Ok(())
    }
}

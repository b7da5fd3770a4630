//! The balance sheet of a state: energy, entropy and momenta.
//!
//! Kinetic, potential and internal energy and the momenta are evaluated from positions, momenta, viscous
//! stretches, temperatures and stored entropies. The entropies of elements, reservoirs and thermostats, work, heat and
//! lost heat are sums that the steps have accumulated; [`Ledger::element_entropy_of_state`] is evaluated from the state.

use core::fmt;

use nalgebra::SVector;

use crate::algebra::vector;
use crate::element::group::ElementTotals;
use crate::element::masses::Masses;
use crate::element::state::State;
use eem_material::number::compensated::Total;

/// The balance sheet of a scene.
///
/// The schemes in entropy form and [`EemTemperature`](crate::Scheme::EemTemperature) store the entropy s of an
/// element as a sum of what it receives, and compute the temperature from it. The ledger contains these sums, whose
/// total never falls, and also the entropies `s(λ, γ, θ)` of the model at the present state. The two
/// differ by rounding:
///
/// ```text
/// |Σ s(λ, γ, θ) − Σ s| ≤ 4 ε Σ (|s| + Σ |∂s/∂x| |x| + c),     x = λ, γ,   c = θ ∂s/∂θ
/// ```
///
/// ```text
/// E = Σ p²/2m − Σ m g·q + Σ (ψ + θ s) + Σ θ_r σ_r + heat lost
/// S = Σ s + Σ σ_r + entropy of the thermostats
/// E − work − heat = const
/// ```
///
/// ```
/// use eem::{Scene, Scheme, Simulation};
///
/// let mut scene = Scene::<2>::new();
/// scene.mass(2.0, [0.0, 0.0], [3.0, 0.0]);
/// let run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
/// let sheet = run.ledger().to_string();
/// assert!(sheet.contains("| E − work − heat     | 9.000000000000000e0  | J     |"), "{sheet}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ledger<const D: usize> {
    /// `Σ p·v/2`, J, which is `Σ p²/2m` where masses do not couple nodes.
    pub kinetic_energy: f64,
    /// `−Σ m g·q`, J.
    pub potential_energy: f64,
    /// `Σ (ψ + θ s)` of the elements, with ψ and θ of the state and the stored entropy s, J.
    pub internal_energy: f64,
    /// Heat received by the reservoirs since the start, `Σ θ_r σ_r`, with the stored `σ_r`, J.
    pub reservoir_heat: f64,
    /// Heat given away by dashpots of elements without temperature since the start, J.
    pub lost_heat: f64,
    /// The sum of all energies, E, J. Constant unless loads do work or thermostats supply heat.
    pub energy: f64,
    /// Work of loads and moved anchors since the start, J.
    pub work: f64,
    /// Heat supplied by thermostats since the start, J.
    pub heat: f64,
    /// `E − work − heat`, J. Constant by the first law.
    pub balance: f64,
    /// `Σ s` of the elements as stored, J/K.
    pub element_entropy: f64,
    /// `Σ s(λ, γ, θ)` of the elements, evaluated at the present state, J/K.
    pub element_entropy_of_state: f64,
    /// `Σ σ_r`, the stored entropy received by the reservoirs since the start, J/K.
    pub reservoir_entropy: f64,
    /// Entropy received by the thermostats since the start, J/K.
    pub thermostat_entropy: f64,
    /// The sum of all stored entropies, S, J/K, with compensated rounding. It never falls, except for two roundings
    /// of this sum and of the exchange in a step.
    pub entropy: f64,
    /// `Σ p`, kg m/s.
    pub linear_momentum: SVector<f64, D>,
    /// `Σ (q − o) × p`, kg m²/s, always with three components; `o` is the anchor if the scene has
    /// exactly one, otherwise the origin. In the plane only the third is not zero.
    pub angular_momentum: SVector<f64, 3>,
    /// The points that steps did not resolve since the start or the restored checkpoint, summed over the steps: see
    /// [`StepReport::unresolved`](crate::StepReport::unresolved).
    pub unresolved: u64,
}

impl Ledger<0> {
    /// The balance sheet of a state, given the totals of its elements, but for the linear momentum; the steps before it are unknown.
    pub(crate) fn of(
        state: &State,
        masses: &Masses,
        totals: &ElementTotals,
        reservoirs: &[f64],
        gravity: &[f64],
    ) -> Self {
        let dimension = gravity.len();
        let kinetic_energy = kinetic_energy(dimension, state, masses);
        let potential_energy = potential_energy(state, masses, gravity);
        let (mut reservoir_heat, mut reservoir_entropy) = (Total::default(), Total::default());
        for (index, &theta) in reservoirs.iter().enumerate() {
            let received = state.reservoir_entropies.sum(index);
            reservoir_heat.add(theta * received.value);
            reservoir_entropy.add_sum(received);
        }
        let (lost_heat, work, heat) = (state.dissipated.value, state.work.value, state.heat.value);
        let internal_energy = totals.energy.value();
        let reservoir_heat = reservoir_heat.value();
        let sum = |terms: &[f64]| Total::of(terms.iter().copied());
        let terms = [
            kinetic_energy,
            potential_energy,
            internal_energy,
            reservoir_heat,
            lost_heat,
            -work,
            -heat,
        ];
        let [energies @ .., _, _] = &terms;
        let mut entropy = totals.entropy;
        entropy.add_total(reservoir_entropy);
        entropy.add_sum(state.thermostat_entropy);
        Self {
            kinetic_energy,
            potential_energy,
            internal_energy,
            reservoir_heat,
            lost_heat,
            energy: sum(energies),
            work,
            heat,
            balance: sum(&terms),
            element_entropy: totals.entropy.value(),
            element_entropy_of_state: totals.entropy_of_state.value(),
            reservoir_entropy: reservoir_entropy.value(),
            thermostat_entropy: state.thermostat_entropy.value,
            entropy: entropy.value(),
            linear_momentum: SVector::from([]),
            angular_momentum: angular_momentum(dimension, state, masses).into(),
            unresolved: 0,
        }
    }

    /// With the linear momentum of the state.
    pub(crate) fn with_momentum<const D: usize>(self, state: &State) -> Ledger<D> {
        let momenta = state.momenta.values();
        Ledger {
            kinetic_energy: self.kinetic_energy,
            potential_energy: self.potential_energy,
            internal_energy: self.internal_energy,
            reservoir_heat: self.reservoir_heat,
            lost_heat: self.lost_heat,
            energy: self.energy,
            work: self.work,
            heat: self.heat,
            balance: self.balance,
            element_entropy: self.element_entropy,
            element_entropy_of_state: self.element_entropy_of_state,
            reservoir_entropy: self.reservoir_entropy,
            thermostat_entropy: self.thermostat_entropy,
            entropy: self.entropy,
            linear_momentum: vector(|axis| component(D, momenta, axis)).into(),
            angular_momentum: self.angular_momentum,
            unresolved: self.unresolved,
        }
    }

    /// The name, value and unit of an entry that is not finite. The laws could not be checked with it.
    pub(crate) fn infinite_entry(
        &self,
        state: &State,
        dimension: usize,
    ) -> Option<(&'static str, f64, &'static str)> {
        let momenta = state.momenta.values();
        let momentum: Vec<_> = (0..dimension)
            .map(|axis| component(dimension, momenta, axis))
            .collect();
        first_infinite(&[
            ("kinetic energy", &[self.kinetic_energy], "J"),
            ("potential energy", &[self.potential_energy], "J"),
            ("internal energy", &[self.internal_energy], "J"),
            ("energy", &[self.energy], "J"),
            ("entropy", &[self.entropy], "J/K"),
            ("linear momentum", &momentum, "kg m/s"),
            (
                "angular momentum",
                self.angular_momentum.as_slice(),
                "kg m²/s",
            ),
        ])
    }
}

/// The first value that is not finite, with its name and its unit.
fn first_infinite(
    all: &[(&'static str, &[f64], &'static str)],
) -> Option<(&'static str, f64, &'static str)> {
    for &(name, values, unit) in all {
        for &value in values {
            if !value.is_finite() {
                return Some((name, value, unit));
            }
        }
    }
    None
}

/// `Σ p·v/2`, J, which is `Σ p²/2m` where masses do not couple nodes.
fn kinetic_energy(dimension: usize, state: &State, masses: &Masses) -> f64 {
    let momenta = state.momenta.values();
    if masses.are_coupled() {
        let both = momenta.iter().zip(state.velocities.values());
        return Total::of(both.map(|(&p, &v)| 0.5 * p * v));
    }
    let mut sum = Total::default();
    for (p, mass) in momenta.chunks_exact(dimension).zip(masses.iter()) {
        if let Some(mass) = mass {
            for &p in p {
                sum.add(p * p / (mass + mass));
            }
        }
    }
    sum.value()
}

/// `−Σ m g·q`, J.
fn potential_energy(state: &State, masses: &Masses, gravity: &[f64]) -> f64 {
    let (mut sum, weights) = (Total::default(), masses.weights());
    let positions = state.positions.values().chunks_exact(gravity.len());
    for (q, &mass) in positions.zip(&*weights) {
        for (&q, &g) in q.iter().zip(gravity) {
            sum.add(-mass * g * q);
        }
    }
    sum.value()
}

/// The sum of the components of all nodes along an axis.
fn component(dimension: usize, values: &[f64], axis: usize) -> f64 {
    Total::of(values.iter().skip(axis).step_by(dimension).copied())
}

/// `Σ (q − o) × p`, kg m²/s, about the only anchor, or the origin.
fn angular_momentum(dimension: usize, state: &State, masses: &Masses) -> [f64; 3] {
    let positions = state.positions.values();
    let mut anchors = masses.anchors();
    let anchor = match (anchors.next(), anchors.next()) {
        (Some(node), None) => Some(&positions[node * dimension..][..dimension]),
        _ => None,
    };
    let mut sums = [Total::default(); 3];
    let momenta = state.momenta.values().chunks_exact(dimension);
    for (q, p) in positions.chunks_exact(dimension).zip(momenta) {
        let arm = |axis: usize| match (axis < dimension, anchor) {
            (false, _) => 0.0,
            (true, None) => q[axis],
            (true, Some(o)) => q[axis] - o[axis],
        };
        let momentum = |axis: usize| if axis < dimension { p[axis] } else { 0.0 };
        for (axis, sum) in sums.iter_mut().enumerate() {
            let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
            sum.add(arm(i) * momentum(j));
            sum.add(-arm(j) * momentum(i));
        }
    }
    vector(|axis| sums[axis].value())
}

impl<const D: usize> fmt::Display for Ledger<D> {
    /// A balance sheet, a line per quantity.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scalars = [
            ("kinetic energy", self.kinetic_energy, "J"),
            ("potential energy", self.potential_energy, "J"),
            ("internal energy", self.internal_energy, "J"),
            ("heat in reservoirs", self.reservoir_heat, "J"),
            ("heat lost", self.lost_heat, "J"),
            ("energy E", self.energy, "J"),
            ("work of loads", self.work, "J"),
            ("heat of thermostats", self.heat, "J"),
            ("E − work − heat", self.balance, "J"),
            ("entropy of elements", self.element_entropy, "J/K"),
            ("… of their state", self.element_entropy_of_state, "J/K"),
            ("… of reservoirs", self.reservoir_entropy, "J/K"),
            ("… of thermostats", self.thermostat_entropy, "J/K"),
            ("entropy S", self.entropy, "J/K"),
        ];
        for (quantity, value, unit) in scalars {
            line(f, quantity, value, unit)?;
        }
        for (axis, &momentum) in ["x", "y", "z"].iter().zip(self.linear_momentum.iter()) {
            line(f, &format!("momentum, {axis}"), momentum, "N s")?;
        }
        // In the plane only the last has a value.
        let first = if D == 2 { 2 } else { 0 };
        let axes = ["x", "y", "z"].iter().zip(self.angular_momentum.iter());
        for (axis, &momentum) in axes.skip(first) {
            line(f, &format!("angular, {axis}"), momentum, "N m s")?;
        }
        writeln!(
            f,
            "| {:<19} | {:<20} | {:<5} |",
            "unresolved", self.unresolved, ""
        )
    }
}

fn line(f: &mut fmt::Formatter<'_>, name: &str, value: f64, unit: &str) -> fmt::Result {
    let value = format!("{value:.15e}");
    writeln!(f, "| {name:<19} | {value:<20} | {unit:<5} |")
}

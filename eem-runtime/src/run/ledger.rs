//! Energy, entropy and momenta of a state: what the free energies say of it, beside what the steps have booked.
//!
//! Kinetic, potential and internal energy and the momenta are evaluated from positions, momenta, viscous
//! stretches, temperatures and the kept entropies of the state. The entropies of elements, reservoirs and
//! thermostats, work, heat and lost heat are sums that the steps have kept; of the entropy there is also
//! the value of the state, [`Ledger::element_entropy_of_state`], which no step has touched.

mod sheet;

use nalgebra::SVector;

use crate::element::group::{ElementTotals, Elements};
use crate::element::masses::Masses;
use crate::element::state::State;
use eem_material::number::compensated::Total;
use eem_material::number::scalar::Real;

/// The balance sheet of a scene.
///
/// The schemes in entropy form and [`EemTemperature`](crate::Scheme::EemTemperature) store the entropy s of an
/// element as a sum of what it receives, and compute the temperature from it. The ledger contains these sums, of
/// which the total never falls, and also the entropies `s(λ, γ, θ)` of the model at the present state. The two
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
pub struct Ledger<const D: usize, S: Real = f64> {
    /// `Σ p·v/2`, J, which is `Σ p²/2m` where masses do not couple nodes.
    pub kinetic_energy: S,
    /// `−Σ m g·q`, J.
    pub potential_energy: S,
    /// `Σ (ψ + θ s)` of the elements, with ψ and θ of the state and the stored entropy s, J.
    pub internal_energy: S,
    /// Heat received by the reservoirs since the start, `Σ θ_r σ_r`, with the stored `σ_r`, J.
    pub reservoir_heat: S,
    /// Heat given away by dashpots of elements without temperature since the start, J.
    pub lost_heat: S,
    /// The sum of all energies, E, J. Constant unless loads do work or thermostats supply heat.
    pub energy: S,
    /// Work of loads and moved anchors since the start, J.
    pub work: S,
    /// Heat supplied by thermostats since the start, J.
    pub heat: S,
    /// `E − work − heat`, J. Constant by the first law.
    pub balance: S,
    /// `Σ s` of the elements as stored, J/K.
    pub element_entropy: S,
    /// `Σ s(λ, γ, θ)` of the elements, evaluated at the present state, J/K.
    pub element_entropy_of_state: S,
    /// `Σ σ_r`, the stored entropy received by the reservoirs since the start, J/K.
    pub reservoir_entropy: S,
    /// Entropy received by the thermostats since the start, J/K.
    pub thermostat_entropy: S,
    /// The sum of all stored entropies, S, J/K, with compensated rounding. It never falls, except for two roundings
    /// of this sum and of the exchange in a step.
    pub entropy: S,
    /// `Σ p`, kg m/s.
    pub linear_momentum: SVector<S, D>,
    /// `Σ (q − o) × p`, kg m²/s, always with three components; `o` is the anchor if the scene has
    /// exactly one, otherwise the origin. In the plane only the third is not zero.
    pub angular_momentum: SVector<S, 3>,
}

impl<const D: usize, S: Real> Ledger<D, S> {
    /// The balance sheet of a state.
    pub(crate) fn of<'a>(
        state: &State<S>,
        masses: &Masses<S>,
        groups: impl Iterator<Item = &'a dyn Elements<S, D>>,
        reservoirs: &[S],
        gravity: &SVector<S, D>,
    ) -> Self {
        let (kinetic, potential) = (
            kinetic_energy::<S, D>(state, masses),
            potential_energy(state, masses, gravity),
        );
        let mut totals = ElementTotals::new();
        for group in groups {
            group.add_totals(state, &mut totals);
        }
        let (mut heat, mut reservoir_entropy) = (Total::default(), Total::default());
        for (index, &theta) in reservoirs.iter().enumerate() {
            let received = state.reservoir_entropies.sum(index);
            heat.add(theta * received.value);
            reservoir_entropy.add_sum(received);
        }
        let [lost_heat, work, given_heat] =
            [state.dissipated, state.work, state.heat].map(|booked| booked.value);
        let internal_energy = totals.energy.value();
        let reservoir_heat = heat.value();
        let energy = [
            kinetic,
            potential,
            internal_energy,
            reservoir_heat,
            lost_heat,
        ];
        let mut entropy = totals.entropy;
        entropy.add_total(reservoir_entropy);
        entropy.add_sum(state.thermostat_entropy);
        Self {
            kinetic_energy: kinetic,
            potential_energy: potential,
            internal_energy,
            reservoir_heat,
            lost_heat,
            energy: Total::of(energy),
            work,
            heat: given_heat,
            balance: Total::of(energy.into_iter().chain([-work, -given_heat])),
            element_entropy: totals.entropy.value(),
            element_entropy_of_state: totals.entropy_of_state.value(),
            reservoir_entropy: reservoir_entropy.value(),
            thermostat_entropy: state.thermostat_entropy.value,
            entropy: entropy.value(),
            linear_momentum: linear_momentum(state),
            angular_momentum: angular_momentum::<S, D>(state, masses),
        }
    }
}

/// `Σ p·v/2`, J, which is `Σ p²/2m` where masses do not couple nodes.
fn kinetic_energy<S: Real, const D: usize>(state: &State<S>, masses: &Masses<S>) -> S {
    let mut sum = Total::default();
    let momenta = state.momenta.values();
    if masses.are_coupled() {
        let half = S::from_f64(0.5);
        let both = momenta.iter().zip(state.velocities.values());
        return Total::of(both.map(|(&p, &v)| half * p * v));
    }
    for (p, mass) in momenta.chunks_exact(D).zip(masses.iter()) {
        let Some(mass) = mass else { continue };
        for &component in p {
            sum.add(component * component / (mass + mass));
        }
    }
    sum.value()
}

/// `−Σ m g·q`, J.
fn potential_energy<S: Real, const D: usize>(
    state: &State<S>,
    masses: &Masses<S>,
    gravity: &SVector<S, D>,
) -> S {
    let mut sum = Total::default();
    let positions = state.positions.values().chunks_exact(D);
    for (q, mass) in positions.zip(masses.weights()) {
        for (&coordinate, &component) in q.iter().zip(gravity.iter()) {
            sum.add(-mass * component * coordinate);
        }
    }
    sum.value()
}

fn linear_momentum<S: Real, const D: usize>(state: &State<S>) -> SVector<S, D> {
    let momenta = state.momenta.values().chunks_exact(D);
    SVector::from_fn(|axis, _| Total::of(momenta.clone().map(|p| p[axis])))
}

fn angular_momentum<S: Real, const D: usize>(
    state: &State<S>,
    masses: &Masses<S>,
) -> SVector<S, 3> {
    let positions = state.positions.values();
    let mut anchors = masses.iter().enumerate().filter(|(_, mass)| mass.is_none());
    let anchor = match (anchors.next(), anchors.next()) {
        (Some((node, _)), None) => Some(&positions[node * D..(node + 1) * D]),
        _ => None,
    };
    let mut sums = [Total::default(), Total::default(), Total::default()];
    for (q, p) in positions
        .chunks_exact(D)
        .zip(state.momenta.values().chunks_exact(D))
    {
        let arm = |axis: usize| match (axis < D, anchor) {
            (false, _) => S::zero(),
            (true, None) => q[axis],
            (true, Some(o)) => q[axis] - o[axis],
        };
        let momentum = |axis: usize| if axis < D { p[axis] } else { S::zero() };
        for (axis, sum) in sums.iter_mut().enumerate() {
            let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
            sum.add(arm(i) * momentum(j));
            sum.add(-arm(j) * momentum(i));
        }
    }
    SVector::from_fn(|axis, _| sums[axis].value())
}

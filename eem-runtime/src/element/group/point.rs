//! One point of an element, where its free energy is evaluated: its model and its variables in a step. A spring has one
//! point.

use super::arms::measures_in;
use super::damping::Damping;
use super::eliminate::{Condensed, PerUnknown, Unknowns};
use crate::element::conjugates::{Family, Form, OneSet, Placement, Start};
use crate::element::error::StateError;
use crate::element::handle::Element;
use crate::element::kinematics::{MeasureSet, Numbers};
use crate::element::layout::Slots;
use crate::element::state::State;
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;
use eem_material::number::compact::compact;
use eem_material::number::scalar::is_positive;
use eem_material::tabled::Tabled;

/// The Kelvin–Voigt dashpot at a trial; `A` is empty without one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drag<A> {
    /// η at θ*, and dη/dθ.
    pub(super) viscosity: (A, A),
    /// `Δλ`, m.
    pub(super) extension: A,
    /// `f_d`, N.
    pub(super) force: A,
}

impl<A: Copy> Drag<A> {
    /// Before the first step, with zeros everywhere.
    pub(super) fn zero(zeros: A) -> Self {
        Self {
            viscosity: (zeros, zeros),
            extension: zeros,
            force: zeros,
        }
    }
}

/// Variables of a scheme that evaluates the model at one point of the step; `V` is per variable.
#[derive(Clone, Copy, Debug)]
pub(super) struct PointMemory<V> {
    /// The contribution of the old state to the rates of the internal variables.
    pub(super) old_rates: V,
    /// Its contribution to the power of the dashpots, `(1 − w) (Σ g⁰ γ̇⁰ + Σ η (λ̇⁰)²)`, W.
    pub(super) old_power: f64,
    /// For a scheme in temperature: the contribution of the old state to θ̇, K/s.
    pub(super) old_heating: f64,
    /// The trial Δs, before the last correction, and the correction, J/K.
    pub(super) entropy_change: f64,
    pub(super) previous_entropy_change: f64,
    pub(super) entropy_correction: f64,
    /// The derivative of the Δs of the response with respect to the variables.
    pub(super) entropy_by: V,
}

impl<V: Array<f64>> PointMemory<V> {
    /// Before the first step.
    pub(super) fn zero() -> Self {
        Self {
            old_rates: V::filled(0.0),
            old_power: 0.0,
            old_heating: 0.0,
            entropy_change: 0.0,
            previous_entropy_change: 0.0,
            entropy_correction: 0.0,
            entropy_by: V::filled(0.0),
        }
    }
}

/// `η_k` and `dη_k/dθ`.
pub(super) type Viscosities<A> = (<A as Arrays>::Viscosities, <A as Arrays>::Viscosities);

/// The damping of a point with this model.
pub(super) type DampingOf<A> = Damping<<A as Arrays>::Variables, <A as Arrays>::Hessian>;

/// A point with its variables in a step. It knows the numbers of its measures `Q`, and no nodes.
pub(crate) struct Point<A: Arrays, Q: MeasureSet> {
    pub(super) scheme: OneSet,
    /// Its handle.
    pub(super) element: Element,
    pub(super) model: Tabled<A>,
    /// Its thermal slot, if it has a temperature, and the offset of its viscous stretches.
    slot: u32,
    viscous: u32,
    /// The index of its contact in the group, if it conducts heat to other elements; out of range otherwise.
    pub(super) contact: u32,
    /// Whether it exchanges heat with reservoirs.
    pub(super) meets_reservoirs: bool,
    /// Whether a thermostat prescribes its temperature.
    pub(super) is_prescribed: bool,
    /// The old state.
    pub(super) start: Start<A>,
    /// Temperatures of mixed states, kept from one iteration to the next; only in entropy form.
    pub(super) corners: A::Corners,
    /// The trial variables `(π, γ, τ)`.
    pub(super) x: A::Variables,
    /// Δγ of the trial, m, stored because `γ⁰ + Δγ` would lose its digits where dashpots are stiff.
    pub(super) creep: A::Viscosities,
    /// Δγ and τ before the last correction, and the correction of all variables.
    pub(super) previous: PerUnknown<A::Viscosities>,
    pub(super) correction: A::Variables,
    /// The response at the trial, and the derivatives of `(f*, g*, θ*)` with respect to `x`.
    pub(super) response: A::Response,
    pub(super) slopes: A::Hessian,
    /// `η_k` and `dη_k/dθ` at θ*.
    pub(super) viscosities: Viscosities<A>,
    /// The Kelvin–Voigt dashpot, if there is one.
    pub(super) drag: Drag<A::Drag>,
    /// Local unknowns as functions of the global ones.
    pub(super) condensed: Condensed<A, Q>,
    /// What only some schemes have.
    special: Option<Box<Special<A>>>,
}

/// The variables of a point in a scheme that is not [exact](OneSet::Exact).
enum Special<A: Arrays> {
    /// For a scheme that evaluates the model at one point of the step.
    Single(PointMemory<A::Variables>),
    Damped(DampingOf<A>),
}

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// Number of variables.
    pub(super) const VARIABLES: usize = A::Variables::LEN;

    /// The most variables that are eliminated within the element: viscous stretches, temperature.
    pub(super) const UNKNOWNS: usize = A::Variables::LEN - A::MEASURES;

    /// The index of the temperature among the variables, and of θ* in the response.
    pub(super) const TEMPERATURE: usize = A::MEASURES + A::DASHPOTS;

    /// The index of Δs in the response.
    pub(super) const ENTROPY: usize = Self::TEMPERATURE + 1;

    pub(super) fn new(scheme: OneSet, element: Element, model: Tabled<A>, slots: Slots) -> Self {
        let zeros = A::Variables::filled(0.0);
        let viscosities = A::Viscosities::filled(0.0);
        let special = match scheme {
            OneSet::Exact(_) => None,
            OneSet::Damped => Some(Special::Damped(DampingOf::<A>::none())),
            OneSet::Point(_) => Some(Special::Single(PointMemory::zero())),
        };
        Self {
            scheme,
            element,
            model,
            slot: compact(slots.thermal.unwrap_or(0)),
            viscous: compact(slots.viscous),
            contact: u32::MAX,
            meets_reservoirs: false,
            is_prescribed: false,
            start: Start::nothing(),
            corners: A::Corners::filled(0.0),
            x: zeros,
            creep: viscosities,
            previous: PerUnknown::zero(),
            correction: zeros,
            response: A::Response::filled(0.0),
            slopes: A::Hessian::filled(zeros),
            viscosities: (viscosities, viscosities),
            drag: Drag::zero(A::Drag::filled(0.0)),
            condensed: Condensed::zero(),
            special: special.map(Box::new),
        }
    }

    /// Number of dashpots in series.
    #[inline]
    pub(super) fn dashpots(&self) -> usize {
        self.model.dashpots()
    }

    /// Number of measures with a dashpot of their own.
    #[inline]
    pub(super) fn drags(&self) -> usize {
        self.model.drags()
    }

    /// Whether it has a temperature.
    #[inline]
    pub(super) fn is_thermal(&self) -> bool {
        self.model.is_thermal()
    }

    /// The variables that are eliminated, from zero: the viscous stretches, and the temperature after the last that there may be.
    #[inline]
    pub(super) fn unknowns(&self) -> impl Iterator<Item = usize> + use<A, Q> {
        let own = self.own_unknowns();
        (0..Self::UNKNOWNS).filter(move |&u| own.has::<A>(u))
    }

    /// Which of [`UNKNOWNS`](Self::UNKNOWNS) it has.
    #[inline]
    pub(super) fn own_unknowns(&self) -> Unknowns {
        Unknowns::of(&self.model)
    }

    /// The state indices of its internal variables.
    #[inline]
    pub(super) fn slots(&self) -> Slots {
        Slots {
            viscous: self.viscous as usize,
            thermal: self.is_thermal().then_some(self.slot as usize),
        }
    }

    /// The unit of its viscous stretches.
    #[inline]
    pub(super) fn viscous_unit(&self) -> f64 {
        Q::unit(&self.old_measures())
    }

    /// The old measures.
    #[inline]
    pub(super) fn old_measures(&self) -> Numbers<Q> {
        measures_in::<Q>(&self.start.x0)
    }

    /// Its variables of a scheme that evaluates the model at one point.
    #[inline]
    pub(super) fn single<C: Family>(&self) -> Option<&PointMemory<A::Variables>> {
        match self.special.as_deref() {
            Some(Special::Single(single)) if !C::IS_EXACT => Some(single),
            _ => None,
        }
    }

    /// The same, mutable.
    #[inline]
    pub(super) fn single_mut<C: Family>(&mut self) -> Option<&mut PointMemory<A::Variables>> {
        match self.special.as_deref_mut() {
            Some(Special::Single(single)) if !C::IS_EXACT => Some(single),
            _ => None,
        }
    }

    /// Its damping in a damped scheme.
    #[inline]
    pub(super) fn damping<C: Family>(&self) -> Option<&DampingOf<A>> {
        match self.special.as_deref() {
            Some(Special::Damped(damping)) if !C::IS_EXACT => Some(damping),
            _ => None,
        }
    }

    /// The same, mutable.
    pub(super) fn damping_mut(&mut self) -> Option<&mut DampingOf<A>> {
        match self.special.as_deref_mut() {
            Some(Special::Damped(damping)) => Some(damping),
            _ => None,
        }
    }

    /// Its contact, if it conducts heat to other elements.
    #[inline]
    pub(super) fn contact_in<'a, T>(&self, contacts: &'a [T]) -> Option<&'a T> {
        if self.is_thermal() {
            contacts.get(self.contact as usize)
        } else {
            None
        }
    }

    /// Stores the response, and the rows of its tangent that are needed later.
    #[inline]
    pub(super) fn keep<C: Family>(&mut self, (response, tangent): &Form<A>) {
        self.response = *response;
        for row in 0..Self::VARIABLES {
            self.slopes[row] = tangent[row];
        }
        if self.is_thermal()
            && let Some(at_point) = self.single_mut::<C>()
        {
            at_point.entropy_by = tangent[Self::ENTROPY];
        }
    }

    /// The increment `h (w ẋ + c)` of an internal variable with the rate `ẋ` of the response; c is the contribution of
    /// the old state.
    #[inline]
    pub(super) fn increment<C: Family>(&self, index: usize, rate: f64, h: f64) -> f64 {
        let own = C::implicit(self.scheme) * rate;
        let old = self.single::<C>();
        h * old.map_or(own, |old| own + old.old_rates[index])
    }

    /// The new temperature that τ stands for, given the old one, K.
    pub(super) fn new_temperature(&self, old: f64) -> f64 {
        let theta = self.x[Self::TEMPERATURE];
        match self.scheme.placement() {
            Placement::Ends | Placement::End => theta,
            Placement::Middle | Placement::Start => theta + theta - old,
        }
    }

    /// The algorithmic temperature θ*, K; zero without temperature.
    #[inline]
    pub(super) fn temperature(&self) -> f64 {
        temperature_in::<A>(&self.response)
    }

    /// An error unless a free energy is finite.
    pub(super) fn unless_infinite(&self, psi: f64) -> Result<(), StateError> {
        unless_infinite(self.element, psi)
    }

    /// Finds the viscosities at a temperature; an error unless all are positive.
    #[inline]
    pub(super) fn find_viscosities(&mut self, theta: f64) -> Result<(), StateError> {
        if self.dashpots() > 0 {
            self.viscosities = self.model.viscosity(theta);
        }
        self.check_viscosities(theta)
    }

    /// An error unless the viscosities, found at a temperature, are positive.
    #[inline]
    pub(super) fn check_viscosities(&self, theta: f64) -> Result<(), StateError> {
        if self.dashpots() == 0 {
            return Ok(());
        }
        let viscosities = self.viscosities.0.as_ref();
        match viscosities.iter().position(|&eta| !is_positive(eta)) {
            None => Ok(()),
            Some(dashpot) => Err(StateError::Viscosity {
                element: self.element,
                dashpot,
                value: viscosities[dashpot],
                unit: Q::VISCOSITY_UNIT,
                temperature: self.is_thermal().then_some(theta),
            }),
        }
    }

    /// Starts the next correction, of zero, from the present trial.
    #[inline]
    pub(super) fn hold<C: Family>(&mut self) {
        self.remember();
        self.correction = A::Variables::filled(0.0);
        if let Some(at_point) = self.single_mut::<C>() {
            at_point.previous_entropy_change = at_point.entropy_change;
            at_point.entropy_correction = 0.0;
        }
    }

    /// Stores Δγ and τ of the present trial, from which the next correction starts.
    #[inline]
    pub(super) fn remember(&mut self) {
        for k in 0..self.dashpots() {
            self.previous.set(k, self.creep[k]);
        }
        if self.is_thermal() {
            self.previous.set(A::DASHPOTS, self.x[Self::TEMPERATURE]);
        }
    }

    /// Applies the fraction `share` of the correction: viscous stretches linearly, the temperature so that it stays positive: in classical
    /// schemes, and otherwise if `by_factors`, in its logarithm.
    #[inline]
    pub(super) fn apply<C: Family>(&mut self, share: f64, by_factors: bool) {
        for k in 0..self.dashpots() {
            let index = A::MEASURES + k;
            self.creep[k] = self.previous.get(k) + share * self.correction[index];
            self.x[index] = self.start.x0[index] + self.creep[k];
        }
        if self.is_thermal() {
            let change = share * self.correction[Self::TEMPERATURE];
            let previous = self.previous.get(A::DASHPOTS);
            self.x[Self::TEMPERATURE] = if by_factors || !C::is_exact(self.scheme) {
                grown(previous, change)
            } else {
                changed(previous, change)
            };
        }
        if let Some(at) = self.single_mut::<C>() {
            at.entropy_change = at.previous_entropy_change + share * at.entropy_correction;
        }
    }
}

/// An error unless a free energy is finite.
pub(super) fn unless_infinite(element: Element, psi: f64) -> Result<(), StateError> {
    if psi.is_finite() {
        return Ok(());
    }
    Err(StateError::NotFinite {
        element,
        quantity: "free energy",
        value: psi,
    })
}

/// A temperature after the correction δθ, linear unless that would take more than half of it, and positive:
///
/// ```text
/// θ + δθ            δθ ≥ −½θ
/// −θ²/4δθ           below, with the same value and slope at −½θ
/// ```
#[inline]
fn changed(theta: f64, change: f64) -> f64 {
    if change < -0.5 * theta {
        let least = -LARGEST_FALL * theta;
        return -0.25 * theta * (theta / if least < change { change } else { least });
    }
    let most = LARGEST_RISE * theta;
    theta + if most < change { most } else { change }
}

/// The largest changes of a temperature in one Newton iteration, a factor of 7 as below, in units of it.
const LARGEST_RISE: f64 = 6.0;
const LARGEST_FALL: f64 = 1.75;

/// A temperature after the correction δθ, `θ (θ + ½δθ)/(θ − ½δθ)`.
///
/// It is `θ e^(δθ/θ)` up to `(δθ/θ)³/12`, positive, and limited.
#[inline]
pub(super) fn grown(theta: f64, change: f64) -> f64 {
    let most = LARGEST_HALF_CHANGE * theta;
    let half = 0.5 * change;
    let limited = || if half > 0.0 { most } else { -most };
    let half = if most < half.abs() { limited() } else { half };
    theta * ((theta + half) / (theta - half))
}

/// Half the largest change of ln θ in one Newton iteration: a factor of 7. It limits a wild first iteration and is
/// never reached near the solution.
const LARGEST_HALF_CHANGE: f64 = 0.75;

/// θ* of a response, K; zero without temperature.
#[inline]
pub(super) fn temperature_in<A: Arrays>(response: &A::Response) -> f64 {
    if A::THERMAL {
        response[A::MEASURES + A::DASHPOTS]
    } else {
        0.0
    }
}

/// The variables `x = (π, γ, θ)` of a point in a state, given its measures.
#[inline]
pub(super) fn variables<A: Arrays>(
    model: &Tabled<A>,
    measures: &[f64],
    slots: Slots,
    state: &State,
) -> A::Variables {
    let mut x = A::Variables::filled(0.0);
    for (a, &measure) in measures.iter().enumerate() {
        x[a] = measure;
    }
    for k in 0..model.dashpots() {
        x[A::MEASURES + k] = state.viscous.values()[slots.viscous + k];
    }
    if let Some(slot) = slots.thermal {
        x[A::MEASURES + A::DASHPOTS] = state.temperatures[slot];
    }
    x
}

//! The Kelvin–Voigt dashpot, in parallel with a spring, whose force acts along λ.
//!
//! ```text
//! f_d = η(θ*) (λ¹ − λ⁰)/h,   heat η(θ*) (λ¹ − λ⁰)²/h
//! ```
//!
//! It acts along the same mean-value gradient as f*, so that its work is `f_d Δλ`, the heat that the element
//! receives, for any step. `Δλ = D*λ Δr` is found from the motion of the nodes: the difference of lengths would
//! lose its digits where the dashpot is stiff. The classical schemes take `η λ̇` at their point of the step. The
//! response stays that of the free energy; [`Point::pulls`] returns elastic plus viscous force.

use super::arms::measures_in;
use super::local::Dissipation;
use super::point::{Point, temperature_in};
use crate::element::conjugates::{Family, Form};
use crate::element::error::StateError;
use crate::element::group::view::StepView;
use crate::element::kinematics::{MeasureSet, Numbers};
use crate::element::tally::Tally;
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;
use eem_material::number::scalar::is_positive;
use eem_material::tabled::Tabled;

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// Whether its type has room for such a dashpot. What only they need is not compiled for others.
    pub(super) const MAY_HAVE_DRAG: bool = A::Drag::LEN > 0;

    /// Whether `λ̇` is the rate of a classical scheme, with its own derivatives with respect to the arms, and not a
    /// difference of lengths.
    #[inline]
    pub(super) fn has_rates<C: Family>(&self) -> bool {
        self.drags() > 0 && !C::is_exact(self.scheme)
    }

    /// `λ̇` of the trial, m/s.
    #[inline]
    fn extension_rate<C: Family>(&self, a: usize, per_step: f64) -> f64 {
        self.drag.extension[a] * self.per_share::<C>(per_step)
    }

    /// `1/(w h)`, 1/s.
    #[inline]
    pub(super) fn per_share<C: Family>(&self, per_step: f64) -> f64 {
        per_step * C::implicit(self.scheme).recip()
    }

    /// Evaluates the viscosity at a temperature; an error unless it is positive.
    #[inline]
    pub(super) fn find_drag_viscosity(&mut self, theta: f64) -> Result<(), StateError> {
        if const { !Self::MAY_HAVE_DRAG } || self.drags() == 0 {
            return Ok(());
        }
        self.drag.viscosity = self.model.drag(theta);
        check_drag::<A, Q>(&self.model, self.drag.viscosity.0, theta)
            .map_err(|error| error.of(self.element))
    }

    /// Finds the force for a response, given 1/h, 1/s.
    #[inline]
    pub(super) fn find_drag<C: Family>(
        &mut self,
        per_step: f64,
        response: &A::Response,
    ) -> Result<(), StateError> {
        self.find_drag_viscosity(temperature_in::<A>(response))?;
        for a in 0..self.drags() {
            self.drag.force[a] = self.drag.viscosity.0[a] * self.extension_rate::<C>(a, per_step);
        }
        Ok(())
    }

    /// Adds the force and its derivatives to a form; returns the forces without it.
    #[inline]
    pub(super) fn add_drag<C: Family>(
        &self,
        per_step: f64,
        (response, tangent): &mut Form<A>,
    ) -> A::Drag {
        let mut elastic = A::Drag::filled(0.0);
        for a in 0..self.drags() {
            elastic[a] = response[a];
            response[a] += self.drag.force[a];
            if self.is_thermal() {
                let thinning = self.thinning::<C>(a, per_step);
                for column in 0..Self::VARIABLES {
                    let by_theta = tangent[Self::TEMPERATURE][column];
                    tangent[a][column] += thinning * by_theta;
                }
            }
            if !self.has_rates::<C>() {
                tangent[a][a] += self.drag.viscosity.0[a] * per_step;
            }
        }
        elastic
    }

    /// `λ̇ dη/dθ`, the derivative of the force with respect to θ*.
    #[inline]
    fn thinning<C: Family>(&self, a: usize, per_step: f64) -> f64 {
        self.extension_rate::<C>(a, per_step) * self.drag.viscosity.1[a]
    }

    /// Restores the response of a form to that of the free energy.
    #[inline]
    pub(super) fn drop_drag(&mut self, elastic: &A::Drag) {
        for a in 0..self.drags() {
            self.response[a] = elastic[a];
        }
    }

    /// Adds `η λ̇²` and its derivatives to what the dashpots turn into heat.
    #[inline]
    pub(super) fn dissipate_by_drag<C: Family>(
        &self,
        view: &StepView<'_>,
        (_, tangent): &Form<A>,
        dissipation: &mut Dissipation<A>,
    ) {
        for a in 0..self.drags() {
            let rate = self.extension_rate::<C>(a, view.per_step);
            let force = self.drag.force[a];
            dissipation.power += force * rate;
            if self.is_thermal() {
                let thinning = rate * self.thinning::<C>(a, view.per_step);
                for column in 0..Self::VARIABLES {
                    let by_theta = tangent[Self::TEMPERATURE][column];
                    dissipation.by[column] += thinning * by_theta;
                }
            }
            if !self.has_rates::<C>() {
                // ∂(η λ̇²)/∂λ = 2 η λ̇/h
                dissipation.by[a] += (force + force) * view.per_step;
            }
        }
    }

    /// For a scheme with old forces: adds the force of the old state and its rate, with the weight `1 − w`, given `π̇⁰`; returns
    /// its power, W.
    pub(super) fn add_old_drag(
        &mut self,
        speeds: &Numbers<Q>,
        gradient: &mut A::Variables,
        rates: &mut A::Variables,
    ) -> Result<f64, StateError> {
        let mut power = 0.0;
        if const { !Self::MAY_HAVE_DRAG } || self.drags() == 0 {
            return Ok(power);
        }
        let x0 = self.start.x0;
        self.find_drag_viscosity(x0[Self::VARIABLES - 1])?;
        let share = 1.0 - self.scheme.implicit();
        for a in 0..self.drags() {
            let rate = speeds[a];
            let force = self.drag.viscosity.0[a] * rate;
            gradient[a] += force;
            rates[a] = share * rate;
            power += force * rate;
        }
        Ok(power)
    }

    /// Books the entropy production of the step; returns the heat, J.
    #[inline]
    pub(super) fn book_drag(&self, per_theta: f64, tally: &mut Tally) -> f64 {
        let mut dissipated = 0.0;
        for a in 0..self.drags() {
            let heat = self.drag.force[a] * self.drag.extension[a];
            dissipated += heat;
            tally.produce(heat * per_theta);
        }
        dissipated
    }

    /// The forces between the nodes: those of the response plus those of Kelvin–Voigt dashpots and of damping, N.
    #[inline]
    pub(super) fn pulls<C: Family>(&self) -> Numbers<Q> {
        let mut forces = measures_in::<Q>(&self.response);
        for a in 0..self.drags() {
            forces[a] += self.drag.force[a];
        }
        if let Some(damping) = self.damping::<C>() {
            for a in 0..A::MEASURES {
                forces[a] += damping.force[a];
            }
        }
        forces
    }

    /// A row of the response, including damping, and the dashpot force if the row is a force.
    #[inline]
    pub(super) fn pull_of_row<C: Family>(&self, row: usize) -> f64 {
        let own = if row < self.drags() {
            self.response[row] + self.drag.force[row]
        } else {
            self.response[row]
        };
        let damping = self.damping::<C>();
        damping.map_or(own, |damping| own + damping.force[row])
    }
}

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// Takes `Δλ` along the gradients of the trial; for a classical scheme it is `w h λ̇`, with the rate λ̇ of the trial.
    #[inline]
    pub(super) fn extend(&mut self, increments: &Numbers<Q>) {
        for a in 0..self.drags() {
            self.drag.extension[a] = increments[a];
        }
    }

    /// For a classical scheme: adds the derivatives of the heat balance by the increments through the rates.
    #[inline]
    pub(super) fn warm_by_rates<C: Family>(
        &self,
        view: &StepView<'_>,
        by_increment: &mut Numbers<Q>,
    ) {
        let per_share = self.per_share::<C>(view.per_step);
        for a in 0..self.drags() {
            let force = self.drag.force[a];
            by_increment[a] += self.condensed.heat_factor * (force + force) * per_share;
        }
    }
}

/// An invalid viscosity.
pub(super) struct WrongDrag {
    value: f64,
    unit: &'static str,
    temperature: Option<f64>,
}

impl WrongDrag {
    /// As the error of an element.
    pub(super) fn of(self, element: crate::element::handle::Element) -> StateError {
        StateError::Drag {
            element,
            value: self.value,
            unit: self.unit,
            temperature: self.temperature,
        }
    }
}

/// An error unless the viscosity of a Kelvin–Voigt dashpot is positive and finite.
#[inline]
pub(super) fn check_drag<A: Arrays, Q: MeasureSet>(
    model: &Tabled<A>,
    drag: A::Drag,
    theta: f64,
) -> Result<(), WrongDrag> {
    let mut all = drag.as_ref()[..model.drags()].iter();
    match all.find(|&&eta| !is_positive(eta)) {
        None => Ok(()),
        Some(eta) => Err(WrongDrag {
            value: *eta,
            unit: Q::VISCOSITY_UNIT,
            temperature: model.is_thermal().then_some(theta),
        }),
    }
}

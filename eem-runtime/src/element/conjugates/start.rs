//! The old state of an element, and its response in a step from there.

use crate::element::conjugates::corners::find_corners;
use crate::element::conjugates::family::{ExactForm, Family, OneSet, not_of_this_family};
use crate::element::conjugates::infeasible::Infeasible;
use eem_material::arrays::Arrays;
pub(crate) use eem_material::formulas::Form;
use eem_material::free_energy::Array;
use eem_material::tabled::Tabled;

/// The old state of an element as its scheme sees it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Start<A: Arrays> {
    /// x⁰.
    pub(crate) x0: A::Variables,
    /// What the scheme keeps of the old state.
    pub(crate) old: Kept<A::Kept>,
}

/// What a scheme keeps of the old state. It tells the form of the step.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Kept<O> {
    Exact(ExactForm, O),
    /// s⁰, J/K, for the classical schemes.
    State(f64),
}

impl<O: Array<f64>> Kept<O> {
    /// What a form keeps; zeros if it was another one that kept something.
    #[inline]
    fn in_form(&mut self, form: ExactForm) -> &mut O {
        if !matches!(self, Self::Exact(own, _) if *own == form) {
            *self = Self::Exact(form, O::filled(0.0));
        }
        match self {
            Self::Exact(_, old) => old,
            Self::State(_) => not_of_this_family(),
        }
    }
}

impl<A: Arrays> Start<A> {
    /// Before the first step.
    pub(crate) fn nothing() -> Self {
        Self {
            x0: A::Variables::filled(0.0),
            old: Kept::State(0.0),
        }
    }

    /// Stores what the scheme keeps of the old variables and the old entropy, once per step, and whether a thermostat prescribes
    /// the temperature.
    #[inline]
    pub(crate) fn keep(
        &mut self,
        scheme: OneSet,
        model: &Tabled<A>,
        entropy: f64,
        is_prescribed: bool,
    ) {
        match scheme {
            OneSet::Exact(ExactForm::Entropy) if !is_prescribed => {
                model.keep_for_entropy_form(&self.x0, self.old.in_form(ExactForm::Entropy));
            }
            OneSet::Exact(_) | OneSet::Damped => {
                let old = self.old.in_form(ExactForm::Temperature);
                model.keep_for_temperature_form(&self.x0, old);
            }
            OneSet::Point(_) => self.old = Kept::State(entropy),
        }
    }

    /// Room for what a form keeps.
    pub(crate) fn room_for(&mut self, form: ExactForm) -> &mut [f64] {
        self.old.in_form(form).as_mut()
    }

    /// What the form keeps.
    pub(crate) fn kept(&self) -> &[f64] {
        match &self.old {
            Kept::Exact(_, old) => old.as_ref(),
            Kept::State(_) => not_of_this_family(),
        }
    }

    /// Finds what the form needs besides the variables: temperatures of mixed states, only in entropy form.
    #[inline]
    pub(crate) fn prepare(
        &self,
        model: &Tabled<A>,
        x: &A::Variables,
        corners: &mut A::Corners,
    ) -> Result<(), Infeasible> {
        match &self.old {
            Kept::Exact(ExactForm::Entropy, old) if model.is_thermal() => {
                find_corners((model, [&self.x0, x]), old, corners)
            }
            _ => Ok(()),
        }
    }

    /// The response `(f*…, g*…, θ*, Δs)` and its tangent.
    #[inline]
    pub(crate) fn form<C: Family>(
        &self,
        scheme: OneSet,
        model: &Tabled<A>,
        x: &A::Variables,
        corners: &A::Corners,
    ) -> Form<A> {
        if !C::is_exact(scheme) {
            return scheme.point_rule().respond(model, self, x);
        }
        match &self.old {
            Kept::Exact(ExactForm::Entropy, old) => model.entropy_form(old, x, corners),
            Kept::Exact(ExactForm::Temperature, old) => model.temperature_form(old, x),
            Kept::State(_) => not_of_this_family(),
        }
    }

    /// A fallback form that is easier to solve and gives an initial guess for the entropy form: the temperature form, which has no
    /// mixed states. With a small heat capacity their temperatures overflow away from the solution.
    #[cold]
    #[inline(never)]
    pub(crate) fn starting_form(&self, model: &Tabled<A>, x: &A::Variables) -> Option<Form<A>> {
        match self.old {
            Kept::Exact(ExactForm::Entropy, _) => {
                let mut old = A::Kept::filled(0.0);
                model.keep_for_temperature_form(&self.x0, &mut old);
                Some(model.temperature_form(&old, x))
            }
            Kept::Exact(ExactForm::Temperature, _) | Kept::State(_) => None,
        }
    }

    /// The response alone, without its tangent, at the end of a step. That the new state is stable is
    /// checked where its temperature is found.
    #[inline]
    pub(crate) fn response<C: Family>(
        &self,
        scheme: OneSet,
        model: &Tabled<A>,
        x: &A::Variables,
        corners: &A::Corners,
    ) -> A::Response {
        if !C::is_exact(scheme) {
            return scheme.point_rule().respond(model, self, x).0;
        }
        match &self.old {
            Kept::Exact(ExactForm::Entropy, old) => model.entropy_form_response(old, x, corners),
            Kept::Exact(ExactForm::Temperature, old) => model.temperature_form_response(old, x),
            Kept::State(_) => not_of_this_family(),
        }
    }

    /// The derivative of the weighted response of an exact scheme with respect to the parameters at fixed `x⁰` and `x¹`.
    #[cfg(feature = "gradients")]
    pub(crate) fn form_adjoint(
        &self,
        model: &Tabled<A>,
        x: &A::Variables,
        corners: &A::Corners,
        weights: &A::Response,
        found: &mut [f64],
    ) {
        let ends = [&self.x0, x];
        match self.old {
            Kept::Exact(ExactForm::Entropy, _) => {
                model.entropy_form_adjoint(ends, corners, weights, found);
            }
            Kept::Exact(ExactForm::Temperature, _) => {
                model.temperature_form_adjoint(ends, weights, found);
            }
            Kept::State(_) => not_of_this_family(),
        }
    }

    /// The derivative of the response along a direction of the parameters, likewise.
    #[cfg(feature = "gradients")]
    pub(crate) fn form_tangent(
        &self,
        model: &Tabled<A>,
        x: &A::Variables,
        corners: &A::Corners,
        direction: &[f64],
    ) -> A::Response {
        let ends = [&self.x0, x];
        match self.old {
            Kept::Exact(ExactForm::Entropy, _) => {
                model.entropy_form_tangent(ends, corners, direction)
            }
            Kept::Exact(ExactForm::Temperature, _) => {
                model.temperature_form_tangent(ends, direction)
            }
            Kept::State(_) => not_of_this_family(),
        }
    }
}

//! The interface between free energies and schemes: the trait that the derive implements.

use core::any::Any;

pub use crate::array::{Array, Entry};
use crate::number::scalar::Scalar;
pub use crate::together::{ExactForm, MOST_TOGETHER, Steps, Together};
use crate::values::absent;
pub use crate::values::{Caloric, Rates};

/// A Helmholtz free energy `ψ(x)` with everything that the schemes need.
///
/// `#[derive(FreeEnergy)]` generates every method as straight-line code; do not implement it by hand. The variables are
///
/// ```text
/// x = (π₁ … π_M, γ₁ … γ_K, θ)      N = M + K + T components
/// ```
///
/// measures of the deformation (`M = 1`, the stretch λ in m, for a spring),
/// viscous stretches of the dashpots (m) and, if the model has one (`T = 1`),
/// the temperature (K). Index 0 is the old, 1 the new state of a step. The
/// algorithmic quantities of a step, the *response*, are
///
/// ```text
/// (f*₁ … f*_M, g*₁ … g*_K, θ*, Δs)      R = M + K + 2T components
/// f* = D_π e,   g* = −D_γ e,   θ* = D_s e,   Δs = S(x¹) − S(x⁰)
/// ```
///
/// with the symmetrised partitioned discrete derivatives D of García Orden &
/// Romero (2012), eq. (28). A model without temperature has `D ψ` instead.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no free energy in the scalar `{S}`",
    label = "no material for `{S}`",
    note = "write `#[derive(FreeEnergy)]` and `#[free_energy(|lambda: Stretch| …)]` on top of the struct"
)]
pub trait FreeEnergy<S: Scalar> {
    /// Number of measures of the deformation, M.
    const MEASURES: usize;
    /// Number of dashpots, K.
    const DASHPOTS: usize;
    /// Whether there is a temperature, T.
    const THERMAL: bool;
    /// Whether ψ is per reference volume, a function of strains; then all units with J, N and J/K below are per m³.
    /// See `StrainEnergy` in `eem-runtime`.
    const PER_VOLUME: bool = false;
    /// The number of dashpots, the last ones, that are components of a viscous strain tensor.
    const VISCOUS_STRAIN: usize = 0;
    /// Whether the heat capacity does not depend on the temperature.
    const HAS_CONSTANT_CAPACITY: bool = false;
    /// Whether derivatives with respect to the parameters exist: the functions from
    /// [`temperature_form_adjoint`](Self::temperature_form_adjoint) to [`drag_adjoint`](Self::drag_adjoint). The derive
    /// generates them with the feature `gradients` of `eem`. If `false`, they return NaN, and the runtime does not call
    /// them.
    ///
    /// ```
    /// use eem::FreeEnergy;
    ///
    /// #[derive(FreeEnergy)]
    /// #[free_energy(|lambda: Stretch| 0.5 * stiffness * (lambda - 1.0).powi(2))]
    /// struct Spring {
    ///     stiffness: f64,
    /// }
    ///
    /// let spring = Spring { stiffness: 40.0 };
    /// // f* = k ((λ⁰ + λ¹)/2 − 1), with the weight 2.
    /// let [by_stiffness]: [f64; 1] = spring.temperature_form_adjoint(&[1.25], &[1.75], &[2.0]);
    /// if <Spring as FreeEnergy<f64>>::HAS_PARAMETER_DERIVATIVES {
    ///     assert_eq!(by_stiffness, 2.0 * 0.5);
    /// } else {
    ///     assert!(by_stiffness.is_nan());
    /// }
    /// ```
    const HAS_PARAMETER_DERIVATIVES: bool = false;
    /// The name of the struct.
    const MODEL: &'static str;
    /// The names of the parameters that the model uses.
    const PARAMETERS: &'static [&'static str];
    /// Their units as written, `1` for none; empty unless the model has units.
    const PARAMETER_UNITS: &'static [&'static str] = &[];

    /// `[S; P]`, an entry for each of the P [`PARAMETERS`](Self::PARAMETERS), in their order. If these are known only at run
    /// time, P is the largest possible number, and the entries beyond the parameters are unused.
    type Parameters: Array<S>;
    /// `[S; N]`, the variables.
    type Variables: Array<S>;
    /// `[[S; N]; N]`.
    type Hessian: Array<Self::Variables>;
    /// `[S; K]`, with one or two more entries for the flows of a viscous strain, see [`JointEnergy`](crate::JointEnergy).
    type Viscosities: Array<S>;
    /// `[S; 1]` with a dashpot in parallel with the spring (Kelvin–Voigt), else `[S; 0]`.
    type Drag: Array<S>;
    /// `[S; 2(N − 1)]`, `[S; 0]` without temperature.
    type Corners: Array<S>;
    /// `[S; R]`.
    type Response: Array<S>;
    /// `[[S; N]; R]`.
    type Tangent: Array<Self::Variables>;
    /// Values of the old state that the entropy form reuses.
    type EntropyFormOld: Array<S>;
    /// Values of the old state that the temperature form reuses.
    type TemperatureFormOld: Array<S>;

    /// A copy of the material, for a copy of its scene. The derive clones all fields.
    #[must_use]
    fn duplicate(&self) -> Self
    where
        Self: Sized;

    /// The name of the material in messages: [`MODEL`](Self::MODEL), unless it is known only at run time.
    fn model(&self) -> &'static &'static str {
        &Self::MODEL
    }

    /// Distinguishes free energies of one type: a digest of the formulas, or 0 if the type determines them. Springs of
    /// different kinds are treated like springs of different types.
    fn kind(&self) -> u64 {
        0
    }

    /// The material that was derived: this one, unless it is behind a table.
    fn as_any(&self) -> &dyn Any
    where
        Self: Sized + 'static,
    {
        self
    }

    /// Functions that evaluate several springs (no solids) of this material in one call, if that takes less time than one by one. Springs are
    /// evaluated together if their functions have one address, which those with other values of parameters must not have.
    fn together(&self) -> Option<&TogetherOf<Self, S>> {
        None
    }

    /// The number of [`PARAMETERS`](Self::PARAMETERS), unless it is known only at run time.
    fn parameter_count(&self) -> usize {
        Self::PARAMETERS.len()
    }

    /// The names of the parameters with respect to which derivatives exist: [`PARAMETERS`](Self::PARAMETERS), unless they are
    /// known only at run time.
    fn parameter_names(&self) -> &'static [&'static str] {
        Self::PARAMETERS
    }

    /// [`PARAMETER_UNITS`](Self::PARAMETER_UNITS), unless they are known only at run time.
    fn parameter_units(&self) -> &'static [&'static str] {
        Self::PARAMETER_UNITS
    }

    /// [`HAS_PARAMETER_DERIVATIVES`](Self::HAS_PARAMETER_DERIVATIVES), unless it is known only at run time.
    fn has_parameter_derivatives(&self) -> bool {
        Self::HAS_PARAMETER_DERIVATIVES
    }

    /// [`HAS_CONSTANT_CAPACITY`](Self::HAS_CONSTANT_CAPACITY), unless it is known only at run time.
    #[inline]
    fn has_constant_capacity(&self) -> bool {
        Self::HAS_CONSTANT_CAPACITY
    }

    /// [`DASHPOTS`](Self::DASHPOTS), unless their number is known only at run time: then that constant is the most that there
    /// may be. Variables, rows and viscosities of those that are missing are unused, and the temperature stays the last of the
    /// variables.
    #[inline]
    fn dashpots(&self) -> usize {
        Self::DASHPOTS
    }

    /// [`THERMAL`](Self::THERMAL), unless it is known only at run time: then that constant is true, and without a temperature
    /// its variable and its rows are unused.
    #[inline]
    fn is_thermal(&self) -> bool {
        Self::THERMAL
    }

    /// The number of dashpots in parallel: the length of [`Drag`](Self::Drag), unless it is known only at run time.
    #[inline]
    fn drags(&self) -> usize {
        Self::Drag::LEN
    }

    /// [`VISCOUS_STRAIN`](Self::VISCOUS_STRAIN), unless it is known only at run time.
    fn viscous_strain(&self) -> usize {
        Self::VISCOUS_STRAIN
    }

    /// The value of parameter `index` of [`PARAMETERS`](Self::PARAMETERS).
    fn parameter(&self, index: usize) -> S;

    /// `ψ(x)`, J.
    fn free_energy(&self, x: &Self::Variables) -> S;

    /// `Σ |terms of ψ|`, J; times ε it bounds the rounding of [`free_energy`](Self::free_energy),
    ///
    /// ```text
    /// |ψ_computed − ψ_exact| ≤ 8 ε · energy_magnitude      |ψ| ≤ energy_magnitude
    /// ```
    ///
    /// to first order in ε, for the given x and parameters. Rounding inside functions, powers and products counts
    /// with its effect on ψ: `ln(λ/l)` contributes `1 + |ln(λ/l)|`, because the quotient is rounded. If terms of ψ
    /// cancel, the magnitude is far above |ψ|, and differences of energies below ε times the magnitude are
    /// meaningless.
    fn energy_magnitude(&self, x: &Self::Variables) -> S;

    /// `e(x) = ψ − θ ∂ψ/∂θ`, J.
    fn internal_energy(&self, x: &Self::Variables) -> S;

    /// `∂ψ/∂x = (f, −g, −s)`.
    fn gradient(&self, x: &Self::Variables) -> Self::Variables;

    /// `∂ψ/∂x` and `∂²ψ/∂x²`.
    fn hessian(&self, x: &Self::Variables) -> (Self::Variables, Self::Hessian);

    /// Entropy and heat capacity; zero without temperature.
    fn caloric(&self, x: &Self::Variables) -> Caloric<S>;

    /// [`caloric`](Self::caloric) and [`free_energy`](Self::free_energy) as functions of the temperature with the
    /// other variables of `x`, for inversions with several evaluations. Everything independent of the temperature
    /// is computed once. Results differ by rounding.
    fn caloric_at(&self, x: Self::Variables) -> impl Fn(S) -> (Caloric<S>, S) {
        move |theta| {
            let mut x = x;
            if let Some(last) = x.as_mut().last_mut() {
                *last = theta;
            }
            (self.caloric(&x), self.free_energy(&x))
        }
    }

    /// [`caloric_at`](Self::caloric_at) of the mixed state with the first `new` measures and viscous variables
    /// of `x1` and the others of `x0`, one of the [`Corners`](Self::Corners).
    #[inline]
    fn caloric_between(
        &self,
        x0: &Self::Variables,
        x1: &Self::Variables,
        new: usize,
    ) -> impl Fn(S) -> (Caloric<S>, S) {
        self.caloric_at(x0.beginning_as(x1, new))
    }

    /// Forces, heat capacity and the slopes of the entropy.
    fn rates(&self, x: &Self::Variables) -> Rates<Self::Variables> {
        let (gradient, hessian) = self.hessian(x);
        let mut rates = Rates {
            forces: gradient,
            slopes: Self::Variables::filled(S::zero()),
        };
        let last = Self::MEASURES + Self::DASHPOTS;
        for dashpot in Self::MEASURES..last {
            rates.forces[dashpot] = -gradient[dashpot];
        }
        if Self::THERMAL {
            rates.forces[last] = -x[last] * hessian[last][last];
            for index in 0..last {
                rates.slopes[index] = -hessian[last][index];
            }
        }
        rates
    }

    /// [`rates`](Self::rates) with `[s, ψ]`, J/K and J, as functions of the temperature with the other variables of
    /// `x`. Everything independent of the temperature is computed once. Without temperature the argument is
    /// ignored, and s is zero.
    fn rates_at(&self, x: Self::Variables) -> impl Fn(S) -> (Rates<Self::Variables>, [S; 2]) {
        move |theta| {
            let mut x = x;
            let mut entropy = S::zero();
            if Self::THERMAL {
                let last = Self::MEASURES + Self::DASHPOTS;
                x[last] = theta;
                entropy = -self.gradient(&x)[last];
            }
            (self.rates(&x), [entropy, self.free_energy(&x)])
        }
    }

    /// `∂²s/∂x²`, for the tangent of the classical schemes in temperature variables; zero without temperature.
    fn entropy_hessian(&self, x: &Self::Variables) -> Self::Hessian;

    /// `η_k(θ)` and `dη_k/dθ`, N s/m and N s/(m K).
    fn viscosity(&self, theta: S) -> (Self::Viscosities, Self::Viscosities);

    /// `η(θ)` and `dη/dθ` of the dashpot in parallel with the spring, whose force is `η λ̇`, N s/m and N s/(m K).
    fn drag(&self, theta: S) -> (Self::Drag, Self::Drag);

    /// The values of the old state for [`entropy_form`](Self::entropy_form).
    fn entropy_form_old(&self, x0: &Self::Variables) -> Self::EntropyFormOld;

    /// The response in entropy form and its tangent `∂(response)/∂x¹`.
    ///
    /// `corners` are the temperatures of the mixed states between old and new:
    /// for `k = 1 … N − 1` the first `k` variables new, the rest old, with the
    /// old entropy; then the first `k` old, the rest new, with the new entropy
    /// `S(x¹)`. The tangent is total: corners move with `x¹`.
    fn entropy_form(
        &self,
        old: &Self::EntropyFormOld,
        x1: &Self::Variables,
        corners: &Self::Corners,
    ) -> (Self::Response, Self::Tangent);

    /// The response of [`entropy_form`](Self::entropy_form) without the tangent, with the same bits and less work.
    fn entropy_form_response(
        &self,
        old: &Self::EntropyFormOld,
        x1: &Self::Variables,
        corners: &Self::Corners,
    ) -> Self::Response {
        self.entropy_form(old, x1, corners).0
    }

    /// Residuals of the entropies of the [`Corners`](Self::Corners) at trial temperatures, and the heat capacities there,
    /// J/K.
    ///
    /// A residual is the entropy less that of `x0` in the first half of the corners, and less that of `x1` in the second.
    /// The derive sums up divided differences, which keep the digits of small changes.
    fn mixed_states(
        &self,
        x0: &Self::Variables,
        _old: &Self::EntropyFormOld,
        x1: &Self::Variables,
        corners: &Self::Corners,
    ) -> [Self::Corners; 2] {
        let mut found = [*corners; 2];
        let steps = Self::Corners::LEN / 2;
        let wanted = [x0, x1].map(|x| self.caloric(x).entropy);
        for index in 0..Self::Corners::LEN {
            let (is_second, new) = (index >= steps, index % steps + 1);
            let [before, after] = if is_second { [x1, x0] } else { [x0, x1] };
            let caloric = self.caloric_between(before, after, new)(corners[index]).0;
            found[0][index] = caloric.entropy - wanted[usize::from(is_second)];
            found[1][index] = caloric.heat_capacity;
        }
        found
    }

    /// The values of the old state for [`temperature_form`](Self::temperature_form).
    fn temperature_form_old(&self, x0: &Self::Variables) -> Self::TemperatureFormOld;

    /// The response in temperature form and its tangent `∂(response)/∂x¹`
    /// (Conde Martín, Betsch & García Orden 2016, eqs. 37–39):
    /// `θ* = D_θ e / D_θ s`, `f* = D_λ e − θ* D_λ s`, `g* = −(D_γ e − θ* D_γ s)`.
    fn temperature_form(
        &self,
        old: &Self::TemperatureFormOld,
        x1: &Self::Variables,
    ) -> (Self::Response, Self::Tangent);

    /// The response of [`temperature_form`](Self::temperature_form) without the tangent, with the same bits and
    /// less work.
    fn temperature_form_response(
        &self,
        old: &Self::TemperatureFormOld,
        x1: &Self::Variables,
    ) -> Self::Response {
        self.temperature_form(old, x1).0
    }

    /// `Σ w_i ∂(response_i)/∂μ` of the response in temperature form at fixed `x0` and `x1`, for every parameter μ.
    ///
    /// Here and below, a derivative has the unit of the differentiated function over that of the parameter.
    fn temperature_form_adjoint(
        &self,
        _x0: &Self::Variables,
        _x1: &Self::Variables,
        _weights: &Self::Response,
    ) -> Self::Parameters {
        absent()
    }

    /// `Σ ∂(response)/∂μ δμ` of the response in temperature form at fixed `x0` and `x1`, for a `direction` δμ.
    fn temperature_form_tangent(
        &self,
        _x0: &Self::Variables,
        _x1: &Self::Variables,
        _direction: &Self::Parameters,
    ) -> Self::Response {
        absent()
    }

    /// `Σ w_i d(response_i)/dμ` of the response in entropy form at fixed `x0` and `x1`, for every parameter μ.
    ///
    /// The derivative is total: [`Corners`](Self::Corners) move with the parameters, because they keep the entropy
    /// of `x0` or of `x1`.
    fn entropy_form_adjoint(
        &self,
        _x0: &Self::Variables,
        _x1: &Self::Variables,
        _corners: &Self::Corners,
        _weights: &Self::Response,
    ) -> Self::Parameters {
        absent()
    }

    /// `Σ d(response)/dμ δμ` of the response in entropy form at fixed `x0` and `x1`, for a `direction` δμ; total as
    /// [`entropy_form_adjoint`](Self::entropy_form_adjoint).
    fn entropy_form_tangent(
        &self,
        _x0: &Self::Variables,
        _x1: &Self::Variables,
        _corners: &Self::Corners,
        _direction: &Self::Parameters,
    ) -> Self::Response {
        absent()
    }

    /// `Σ w_i ∂²ψ/∂x_i∂μ` for every parameter μ: the weighted derivatives of the forces and the entropy of a state, with the
    /// signs of [`gradient`](Self::gradient).
    fn gradient_adjoint(
        &self,
        _x: &Self::Variables,
        _weights: &Self::Variables,
    ) -> Self::Parameters {
        absent()
    }

    /// `∂e/∂μ` at fixed `x`, thus at fixed temperature, for every parameter μ.
    fn energy_by_parameters(&self, _x: &Self::Variables) -> Self::Parameters {
        absent()
    }

    /// `Σ w_k ∂η_k/∂μ` for every parameter μ.
    fn viscosity_adjoint(&self, _theta: S, _weights: &Self::Viscosities) -> Self::Parameters {
        absent()
    }

    /// `w ∂η/∂μ` of the dashpot in parallel with the spring for every parameter μ.
    fn drag_adjoint(&self, _theta: S, _weights: &Self::Drag) -> Self::Parameters {
        absent()
    }
}

/// [`Together`] for the arrays of a material.
pub type TogetherOf<M, S = f64> = dyn Together<
        <M as FreeEnergy<S>>::Variables,
        <M as FreeEnergy<S>>::Viscosities,
        <M as FreeEnergy<S>>::Corners,
        <M as FreeEnergy<S>>::Response,
        <M as FreeEnergy<S>>::Tangent,
    >;

/// A free energy that a scene can use. Implemented for every type that qualifies.
///
/// ```
/// use eem::{FreeEnergy, Material};
///
/// #[derive(FreeEnergy)]
/// #[free_energy(|lambda: Stretch| 3.0 * lambda.powi(2))]
/// struct Spring;
///
/// fn measures<M: Material>(_: &M) -> usize {
///     M::MEASURES
/// }
/// assert_eq!(measures(&Spring), 1);
/// ```
pub trait Material: FreeEnergy<f64> + Send + Sync + 'static {}

impl<M: FreeEnergy<f64> + Send + Sync + 'static> Material for M {}

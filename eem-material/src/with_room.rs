//! A material of a spring in arrays with room for more variables than it has.
//!
//! ```text
//! (λ, γ₁ … γ_k, θ)  ↦  (λ, γ₁ … γ_k, unused …, θ)
//! ```
//!
//! Nothing depends on an unused variable, and unused results are 0, except viscosities and heat capacities, which are 1: what
//! divides by them stays finite.

use core::any::Any;
use core::marker::PhantomData;

use crate::arrays::Arrays;
use crate::free_energy::{Array, Caloric, FreeEnergy, Material};

/// A material in the arrays A.
pub(crate) struct WithRoom<M, A> {
    material: M,
    arrays: PhantomData<A>,
}

/// Number of variables and responses of the material before the unused ones.
const fn used<M: FreeEnergy<f64>>() -> usize {
    M::MEASURES + M::DASHPOTS
}

/// Copies an array of a material into a larger one, or back: the first `used` numbers to the beginning, those beyond (as many as both
/// arrays have) to the end. The rest is `unused`.
fn moved<F: Array<f64>, T: Array<f64>>(from: &F, used: usize, unused: f64) -> T {
    let mut to = T::filled(unused);
    for index in 0..used {
        to[index] = from[index];
    }
    let beyond = F::LEN.min(T::LEN) - used;
    for index in 1..=beyond {
        to[T::LEN - index] = from[F::LEN - index];
    }
    to
}

impl<M: Material, A: Arrays> WithRoom<M, A> {
    /// Whether the arrays have room for a material.
    pub(crate) const FITS: bool = M::MEASURES == A::MEASURES
        && !M::PER_VOLUME
        && M::DASHPOTS <= A::DASHPOTS
        && A::THERMAL
        && M::Drag::LEN <= A::Drag::LEN;

    pub(crate) fn new(material: M) -> Self {
        Self {
            material,
            arrays: PhantomData,
        }
    }

    fn own(x: &A::Variables) -> M::Variables {
        moved(x, used::<M>(), 0.0)
    }

    fn variables(own: &M::Variables) -> A::Variables {
        moved(own, used::<M>(), 0.0)
    }

    fn matrix(own: &M::Hessian) -> A::Hessian {
        let mut rows = A::Hessian::filled(A::Variables::filled(0.0));
        for row in 0..used::<M>() {
            rows[row] = Self::variables(&own[row]);
        }
        if M::THERMAL {
            rows[A::Variables::LEN - 1] = Self::variables(&own[used::<M>()]);
        }
        rows
    }

    fn response(own: &M::Response) -> A::Response {
        moved(own, used::<M>(), 0.0)
    }

    fn own_response(weights: &A::Response) -> M::Response {
        moved(weights, used::<M>(), 0.0)
    }

    fn form((response, tangent): (M::Response, M::Tangent)) -> (A::Response, A::Tangent) {
        let mut rows = A::Tangent::filled(A::Variables::filled(0.0));
        for row in 0..used::<M>() {
            rows[row] = Self::variables(&tangent[row]);
        }
        if M::THERMAL {
            for beyond in 1..=2 {
                let own = &tangent[M::Response::LEN - beyond];
                rows[A::Response::LEN - beyond] = Self::variables(own);
            }
        }
        (Self::response(&response), rows)
    }

    /// The numbers of both chains of mixed states.
    fn corners(own: &M::Corners, unused: f64) -> A::Corners {
        let mut corners = A::Corners::filled(unused);
        for index in 0..M::Corners::LEN / 2 {
            corners[index] = own[index];
            corners[A::Corners::LEN / 2 + index] = own[M::Corners::LEN / 2 + index];
        }
        corners
    }

    fn own_corners(corners: &A::Corners) -> M::Corners {
        let mut own = M::Corners::filled(0.0);
        for index in 0..M::Corners::LEN / 2 {
            own[index] = corners[index];
            own[M::Corners::LEN / 2 + index] = corners[A::Corners::LEN / 2 + index];
        }
        own
    }
}

impl<M: Material, A: Arrays> FreeEnergy<f64> for WithRoom<M, A> {
    const MEASURES: usize = A::MEASURES;
    const DASHPOTS: usize = A::DASHPOTS;
    const THERMAL: bool = A::THERMAL;
    const HAS_CONSTANT_CAPACITY: bool = M::HAS_CONSTANT_CAPACITY;
    const HAS_PARAMETER_DERIVATIVES: bool = M::HAS_PARAMETER_DERIVATIVES;
    const MODEL: &'static str = M::MODEL;
    const PARAMETERS: &'static [&'static str] = M::PARAMETERS;
    const PARAMETER_UNITS: &'static [&'static str] = M::PARAMETER_UNITS;

    type Parameters = M::Parameters;
    type Variables = A::Variables;
    type Hessian = A::Hessian;
    type Viscosities = A::Viscosities;
    type Drag = A::Drag;
    type Corners = A::Corners;
    type Response = A::Response;
    type Tangent = A::Tangent;
    type EntropyFormOld = M::EntropyFormOld;
    type TemperatureFormOld = M::TemperatureFormOld;

    fn duplicate(&self) -> Self {
        Self::new(self.material.duplicate())
    }

    fn model(&self) -> &'static &'static str {
        self.material.model()
    }

    fn kind(&self) -> u64 {
        self.material.kind()
    }

    fn as_any(&self) -> &dyn Any {
        self.material.as_any()
    }

    fn dashpots(&self) -> usize {
        self.material.dashpots()
    }

    fn drags(&self) -> usize {
        self.material.drags()
    }

    fn is_thermal(&self) -> bool {
        self.material.is_thermal()
    }

    fn parameter(&self, index: usize) -> f64 {
        self.material.parameter(index)
    }

    fn free_energy(&self, x: &A::Variables) -> f64 {
        self.material.free_energy(&Self::own(x))
    }

    fn energy_magnitude(&self, x: &A::Variables) -> f64 {
        self.material.energy_magnitude(&Self::own(x))
    }

    fn internal_energy(&self, x: &A::Variables) -> f64 {
        self.material.internal_energy(&Self::own(x))
    }

    fn gradient(&self, x: &A::Variables) -> A::Variables {
        Self::variables(&self.material.gradient(&Self::own(x)))
    }

    fn hessian(&self, x: &A::Variables) -> (A::Variables, A::Hessian) {
        let (gradient, hessian) = self.material.hessian(&Self::own(x));
        (Self::variables(&gradient), Self::matrix(&hessian))
    }

    fn caloric(&self, x: &A::Variables) -> Caloric<f64> {
        self.material.caloric(&Self::own(x))
    }

    fn caloric_at(&self, x: A::Variables) -> impl Fn(f64) -> (Caloric<f64>, f64) {
        self.material.caloric_at(Self::own(&x))
    }

    fn caloric_between(
        &self,
        x0: &A::Variables,
        x1: &A::Variables,
        new: usize,
    ) -> impl Fn(f64) -> (Caloric<f64>, f64) {
        let new = new.min(used::<M>());
        let [x0, x1] = [x0, x1].map(Self::own);
        self.material.caloric_at(x0.beginning_as(&x1, new))
    }

    fn entropy_hessian(&self, x: &A::Variables) -> A::Hessian {
        Self::matrix(&self.material.entropy_hessian(&Self::own(x)))
    }

    fn viscosity(&self, theta: f64) -> (A::Viscosities, A::Viscosities) {
        let (viscosities, slopes) = self.material.viscosity(theta);
        (
            moved(&viscosities, M::DASHPOTS, 1.0),
            moved(&slopes, M::DASHPOTS, 0.0),
        )
    }

    fn drag(&self, theta: f64) -> (A::Drag, A::Drag) {
        let (drag, slope) = self.material.drag(theta);
        let own = M::Drag::LEN;
        (moved(&drag, own, 0.0), moved(&slope, own, 0.0))
    }

    fn entropy_form_old(&self, x0: &A::Variables) -> M::EntropyFormOld {
        self.material.entropy_form_old(&Self::own(x0))
    }

    fn entropy_form(
        &self,
        old: &M::EntropyFormOld,
        x1: &A::Variables,
        corners: &A::Corners,
    ) -> (A::Response, A::Tangent) {
        let (x1, corners) = (Self::own(x1), Self::own_corners(corners));
        Self::form(self.material.entropy_form(old, &x1, &corners))
    }

    fn entropy_form_response(
        &self,
        old: &M::EntropyFormOld,
        x1: &A::Variables,
        corners: &A::Corners,
    ) -> A::Response {
        let (x1, corners) = (Self::own(x1), Self::own_corners(corners));
        Self::response(&self.material.entropy_form_response(old, &x1, &corners))
    }

    fn mixed_states(
        &self,
        x0: &A::Variables,
        old: &M::EntropyFormOld,
        x1: &A::Variables,
        corners: &A::Corners,
    ) -> [A::Corners; 2] {
        let ([x0, x1], corners) = ([x0, x1].map(Self::own), Self::own_corners(corners));
        let [excess, capacities] = self.material.mixed_states(&x0, old, &x1, &corners);
        [Self::corners(&excess, 0.0), Self::corners(&capacities, 1.0)]
    }

    fn temperature_form_old(&self, x0: &A::Variables) -> M::TemperatureFormOld {
        self.material.temperature_form_old(&Self::own(x0))
    }

    fn temperature_form(
        &self,
        old: &M::TemperatureFormOld,
        x1: &A::Variables,
    ) -> (A::Response, A::Tangent) {
        Self::form(self.material.temperature_form(old, &Self::own(x1)))
    }

    fn temperature_form_response(
        &self,
        old: &M::TemperatureFormOld,
        x1: &A::Variables,
    ) -> A::Response {
        let response = self.material.temperature_form_response(old, &Self::own(x1));
        Self::response(&response)
    }

    fn temperature_form_adjoint(
        &self,
        x0: &A::Variables,
        x1: &A::Variables,
        weights: &A::Response,
    ) -> M::Parameters {
        let ([x0, x1], weights) = ([x0, x1].map(Self::own), Self::own_response(weights));
        self.material.temperature_form_adjoint(&x0, &x1, &weights)
    }

    fn temperature_form_tangent(
        &self,
        x0: &A::Variables,
        x1: &A::Variables,
        direction: &M::Parameters,
    ) -> A::Response {
        let [x0, x1] = [x0, x1].map(Self::own);
        Self::response(&self.material.temperature_form_tangent(&x0, &x1, direction))
    }

    fn entropy_form_adjoint(
        &self,
        x0: &A::Variables,
        x1: &A::Variables,
        corners: &A::Corners,
        weights: &A::Response,
    ) -> M::Parameters {
        let ([x0, x1], corners) = ([x0, x1].map(Self::own), Self::own_corners(corners));
        let weights = Self::own_response(weights);
        self.material
            .entropy_form_adjoint(&x0, &x1, &corners, &weights)
    }

    fn entropy_form_tangent(
        &self,
        x0: &A::Variables,
        x1: &A::Variables,
        corners: &A::Corners,
        direction: &M::Parameters,
    ) -> A::Response {
        let ([x0, x1], corners) = ([x0, x1].map(Self::own), Self::own_corners(corners));
        let material = &self.material;
        Self::response(&material.entropy_form_tangent(&x0, &x1, &corners, direction))
    }

    fn energy_by_parameters(&self, x: &A::Variables) -> M::Parameters {
        self.material.energy_by_parameters(&Self::own(x))
    }

    fn viscosity_adjoint(&self, theta: f64, weights: &A::Viscosities) -> M::Parameters {
        self.material
            .viscosity_adjoint(theta, &moved(weights, M::DASHPOTS, 0.0))
    }

    fn drag_adjoint(&self, theta: f64, weights: &A::Drag) -> M::Parameters {
        self.material
            .drag_adjoint(theta, &moved(weights, M::Drag::LEN, 0.0))
    }
}

//! A free energy of joint invariants of E and Γ, as a function of the components of both.
//!
//! A material depends on invariants only: partitioned derivatives with respect to components would depend on the axes.
//! From the conjugates `f_m` of the invariants between two states follow those of the components,
//!
//! ```text
//! f_E = Σ f_m P^E_m,   g_Γ = −Σ f_m P^Γ_m,   f_E:ΔE − g_Γ:ΔΓ = Σ f_m Δm   exactly
//! ```
//!
//! Elements treat components as any other measures and viscous strains: the components of Γ are dashpots, whose viscosity
//! is that of their flow (deviatoric or volumetric), so that `Σ η γ̇²` is `Γ̇:V⁻¹Γ̇`.

mod chain;

use crate::free_energy::{Array, Caloric, FreeEnergy};
use crate::joint::JointEnergy;
use chain::Chain;

/// The free energy of a material `M` with joint invariants, of N variables with K dashpots,
///
/// ```text
/// x = (strains, components of E, γ of scalar dashpots, components of Γ, θ),
/// ```
///
/// and R algorithmic quantities. A and B are the numbers of values of the old state that the entropy form and the
/// temperature form reuse. Units are those of the material, per volume.
///
/// ```
/// use eem::{FreeEnergy, StrainEnergy};
///
/// #[derive(Clone, FreeEnergy)]
/// #[free_energy(|e2: StrainSquare, m3: ViscousStrain, m2: ViscousSquare| 3.0 * (e2 - 2 * m3 + m2))]
/// #[viscosity(m3 = 5.0)]
/// struct Fluid;
///
/// // E:E, five components of E and five of Γ, for E = 0.1 b_0 and Γ = 0.04 b_0.
/// let energy = Fluid.at_point();
/// let mut x = [0.0; 11];
/// (x[0], x[1], x[6]) = (0.01, 0.1, 0.04);
/// assert!((energy.free_energy(&x) - 3.0_f64 * 0.06 * 0.06).abs() < 1e-15);
/// // ∂ψ/∂Γ = −6 (E − Γ)
/// assert!((energy.gradient(&x)[6] + 6.0_f64 * 0.06).abs() < 1e-15);
/// assert_eq!(energy.viscosity(300.0).0, [5.0; 5]);
/// ```
#[derive(Clone, Debug)]
pub struct ComponentEnergy<
    M,
    const N: usize,
    const K: usize,
    const R: usize,
    const A: usize,
    const B: usize,
> {
    material: M,
}

impl<M, const N: usize, const K: usize, const R: usize, const A: usize, const B: usize>
    ComponentEnergy<M, N, K, R, A, B>
{
    /// Wraps a material.
    pub fn new(material: M) -> Self {
        Self { material }
    }
}

// Keeps this type out of the compiler's lists of types that implement the trait.
#[diagnostic::do_not_recommend]
impl<
    M: FreeEnergy<f64> + JointEnergy,
    const N: usize,
    const K: usize,
    const R: usize,
    const A: usize,
    const B: usize,
> FreeEnergy<f64> for ComponentEnergy<M, N, K, R, A, B>
{
    const MEASURES: usize = N - K - M::THERMAL as usize;
    const DASHPOTS: usize = K;
    const THERMAL: bool = M::THERMAL;
    const PER_VOLUME: bool = true;
    const VISCOUS_STRAIN: usize = K - M::DASHPOTS;
    const HAS_CONSTANT_CAPACITY: bool = M::HAS_CONSTANT_CAPACITY;
    const HAS_PARAMETER_DERIVATIVES: bool = M::HAS_PARAMETER_DERIVATIVES;
    const MODEL: &'static str = M::MODEL;
    const PARAMETERS: &'static [&'static str] = M::PARAMETERS;
    const PARAMETER_UNITS: &'static [&'static str] = M::PARAMETER_UNITS;

    type Parameters = M::Parameters;
    type Variables = [f64; N];
    type Hessian = [[f64; N]; N];
    type Viscosities = [f64; K];
    type Drag = M::Drag;
    type Corners = M::Corners;
    type Response = [f64; R];
    type Tangent = [[f64; N]; R];
    type EntropyFormOld = [f64; A];
    type TemperatureFormOld = [f64; B];

    fn duplicate(&self) -> Self {
        Self::new(self.material.duplicate())
    }

    fn model(&self) -> &'static &'static str {
        self.material.model()
    }

    fn kind(&self) -> u64 {
        self.material.kind()
    }

    #[inline]
    fn parameter_count(&self) -> usize {
        self.material.parameter_count()
    }

    fn parameter_names(&self) -> &'static [&'static str] {
        self.material.parameter_names()
    }

    #[inline]
    fn has_constant_capacity(&self) -> bool {
        self.material.has_constant_capacity()
    }

    fn parameter(&self, index: usize) -> f64 {
        self.material.parameter(index)
    }

    fn free_energy(&self, x: &[f64; N]) -> f64 {
        self.material.free_energy(&self.material.variables(x))
    }

    // The rounding of the invariants is included.
    fn energy_magnitude(&self, x: &[f64; N]) -> f64 {
        let (tensors, variables) = (M::tensors(x), self.material.variables(x));
        let gradient = self.material.gradient(&variables);
        let own = self.material.energy_magnitude(&variables);
        self.material.invariants().fold(own, |sum, (index, joint)| {
            sum + gradient[index].abs() * tensors.size(joint)
        })
    }

    fn internal_energy(&self, x: &[f64; N]) -> f64 {
        self.material.internal_energy(&self.material.variables(x))
    }

    fn gradient(&self, x: &[f64; N]) -> [f64; N] {
        let gradient = self.material.gradient(&self.material.variables(x));
        self.material
            .conjugates(&M::tensors(x), gradient.as_ref(), 1.0)
    }

    fn hessian(&self, x: &[f64; N]) -> ([f64; N], [[f64; N]; N]) {
        let tensors = M::tensors(x);
        let (gradient, hessian) = self.material.hessian(&self.material.variables(x));
        let gradient = gradient.as_ref();
        (
            self.material.conjugates(&tensors, gradient, 1.0),
            self.material
                .slopes([&tensors; 2], (gradient, hessian.as_ref()), [1.0; 2]),
        )
    }

    fn caloric(&self, x: &[f64; N]) -> Caloric<f64> {
        self.material.caloric(&self.material.variables(x))
    }

    fn caloric_at(&self, x: [f64; N]) -> impl Fn(f64) -> (Caloric<f64>, f64) {
        self.material.caloric_at(self.material.variables(&x))
    }

    // Mixed states consist of old and new strains and invariants, not of components.
    fn caloric_between(
        &self,
        x0: &[f64; N],
        x1: &[f64; N],
        new: usize,
    ) -> impl Fn(f64) -> (Caloric<f64>, f64) {
        let [x0, x1] = [x0, x1].map(|x| self.material.variables(x));
        self.material.caloric_at(x0.beginning_as(&x1, new))
    }

    fn entropy_hessian(&self, x: &[f64; N]) -> [[f64; N]; N] {
        let (tensors, variables) = (M::tensors(x), self.material.variables(x));
        let hessian = self.material.entropy_hessian(&variables);
        // ∂s/∂x = −∂²ψ/∂θ∂x
        let slopes = self.material.rates(&variables).slopes;
        let of_material = (slopes.as_ref(), hessian.as_ref());
        self.material.slopes([&tensors; 2], of_material, [1.0; 2])
    }

    fn viscosity(&self, theta: f64) -> ([f64; K], [f64; K]) {
        let (viscosities, slopes) = self.material.viscosity(theta);
        (M::spread(viscosities.as_ref()), M::spread(slopes.as_ref()))
    }

    fn drag(&self, theta: f64) -> (M::Drag, M::Drag) {
        self.material.drag(theta)
    }

    fn entropy_form_old(&self, x0: &[f64; N]) -> [f64; A] {
        let own = self.material.entropy_form_old(&self.material.variables(x0));
        M::joined(own.as_ref(), x0)
    }

    fn entropy_form(
        &self,
        old: &[f64; A],
        x1: &[f64; N],
        corners: &M::Corners,
    ) -> ([f64; R], [[f64; N]; R]) {
        let (own, tensors) = M::split(old);
        let variables = self.material.variables(x1);
        let form = self.material.entropy_form(&own, &variables, corners);
        self.material.form(&tensors, x1, form)
    }

    fn entropy_form_response(
        &self,
        old: &[f64; A],
        x1: &[f64; N],
        corners: &M::Corners,
    ) -> [f64; R] {
        let (own, tensors) = M::split(old);
        let (material, variables) = (&self.material, self.material.variables(x1));
        let response = material.entropy_form_response(&own, &variables, corners);
        self.material.response(&tensors, x1, &response)
    }

    fn mixed_states(
        &self,
        x0: &[f64; N],
        old: &[f64; A],
        x1: &[f64; N],
        corners: &M::Corners,
    ) -> [M::Corners; 2] {
        let (own, _) = M::split(old);
        let [x0, x1] = [x0, x1].map(|x| self.material.variables(x));
        self.material.mixed_states(&x0, &own, &x1, corners)
    }

    fn temperature_form_old(&self, x0: &[f64; N]) -> [f64; B] {
        let own = self
            .material
            .temperature_form_old(&self.material.variables(x0));
        M::joined(own.as_ref(), x0)
    }

    fn temperature_form(&self, old: &[f64; B], x1: &[f64; N]) -> ([f64; R], [[f64; N]; R]) {
        let (own, tensors) = M::split(old);
        let form = self
            .material
            .temperature_form(&own, &self.material.variables(x1));
        self.material.form(&tensors, x1, form)
    }

    fn temperature_form_response(&self, old: &[f64; B], x1: &[f64; N]) -> [f64; R] {
        let (own, tensors) = M::split(old);
        let variables = self.material.variables(x1);
        let response = self.material.temperature_form_response(&own, &variables);
        self.material.response(&tensors, x1, &response)
    }

    fn temperature_form_adjoint(
        &self,
        x0: &[f64; N],
        x1: &[f64; N],
        weights: &[f64; R],
    ) -> M::Parameters {
        let weights = self.material.response_weights([x0, x1], weights);
        let [x0, x1] = [x0, x1].map(|x| self.material.variables(x));
        self.material.temperature_form_adjoint(&x0, &x1, &weights)
    }

    fn temperature_form_tangent(
        &self,
        x0: &[f64; N],
        x1: &[f64; N],
        direction: &M::Parameters,
    ) -> [f64; R] {
        let [old, new] = [x0, x1].map(|x| self.material.variables(x));
        let (material, tensors) = (&self.material, M::tensors(x0));
        let tangent = material.temperature_form_tangent(&old, &new, direction);
        self.material.response(&tensors, x1, &tangent)
    }

    fn entropy_form_adjoint(
        &self,
        x0: &[f64; N],
        x1: &[f64; N],
        corners: &M::Corners,
        weights: &[f64; R],
    ) -> M::Parameters {
        let weights = self.material.response_weights([x0, x1], weights);
        let [x0, x1] = [x0, x1].map(|x| self.material.variables(x));
        let material = &self.material;
        material.entropy_form_adjoint(&x0, &x1, corners, &weights)
    }

    fn entropy_form_tangent(
        &self,
        x0: &[f64; N],
        x1: &[f64; N],
        corners: &M::Corners,
        direction: &M::Parameters,
    ) -> [f64; R] {
        let [old, new] = [x0, x1].map(|x| self.material.variables(x));
        let (material, tensors) = (&self.material, M::tensors(x0));
        let tangent = material.entropy_form_tangent(&old, &new, corners, direction);
        self.material.response(&tensors, x1, &tangent)
    }

    fn gradient_adjoint(&self, x: &[f64; N], weights: &[f64; N]) -> M::Parameters {
        let weights = self.material.weights(&M::tensors(x), weights, 1.0);
        self.material
            .gradient_adjoint(&self.material.variables(x), &weights)
    }

    fn energy_by_parameters(&self, x: &[f64; N]) -> M::Parameters {
        self.material
            .energy_by_parameters(&self.material.variables(x))
    }

    fn viscosity_adjoint(&self, theta: f64, weights: &[f64; K]) -> M::Parameters {
        let weights = M::gathered(weights);
        self.material.viscosity_adjoint(theta, &weights)
    }

    fn drag_adjoint(&self, theta: f64, weights: &M::Drag) -> M::Parameters {
        self.material.drag_adjoint(theta, weights)
    }
}

//! The measures of an element as functions of its arms.

use crate::element::error::StateError;
use crate::element::handle::Element;
use crate::element::kinematics::solid_state::SolidState;
use eem_material::free_energy::{Array, Entry};
use eem_mesh::Points;

/// The arms of an element, m.
pub type Arms<K, const D: usize> = <K as Kinematics<D>>::PerArm<[f64; D]>;

/// `[T; number of measures]`.
pub(crate) type PerMeasure<K, T, const D: usize> =
    <<K as Kinematics<D>>::Measures as MeasureSet>::Per<T>;

/// A number per measure: the measures themselves, or their conjugate forces.
pub type Measures<K, const D: usize> = PerMeasure<K, f64, D>;

/// Derivatives of measures with respect to the arms: per measure and arm.
pub type Gradient<K, const D: usize> = PerMeasure<K, Arms<K, D>, D>;

/// Second derivatives with respect to the arms: a square block per pair of arms.
pub type Blocks<K, const D: usize> =
    <K as Kinematics<D>>::PerArm<<K as Kinematics<D>>::PerArm<[[f64; D]; D]>>;

/// A number per pair of arms.
pub type Weights<K, const D: usize> =
    <K as Kinematics<D>>::PerArm<<K as Kinematics<D>>::PerArm<f64>>;

/// The arms and measures of one element at both ends of a step.
#[derive(Clone, Copy, Debug)]
pub struct Ends<K: Kinematics<D>, const D: usize> {
    /// Old arms `r⁰`, m.
    pub r0: Arms<K, D>,
    /// New arms `r¹`, m.
    pub r1: Arms<K, D>,
    /// Old measures `π⁰`.
    pub measures0: Measures<K, D>,
    /// New measures `π¹`.
    pub measures1: Measures<K, D>,
    pub(super) between: K::Between,
}

impl<K: Kinematics<D>, const D: usize> Ends<K, D> {
    /// Old and new arms, whose measures are given.
    #[inline]
    pub fn new(
        kinematics: &K,
        [r0, r1]: [Arms<K, D>; 2],
        [measures0, measures1]: [Measures<K, D>; 2],
    ) -> Self {
        let between = kinematics.between([&r0, &r1]);
        Self {
            r0,
            r1,
            measures0,
            measures1,
            between,
        }
    }
}

/// The measures of a point, apart from its nodes: all that the balances of its internal variables know of them.
pub trait MeasureSet: Copy + Send + Sync + core::fmt::Debug + 'static {
    /// `[T; number of measures]`.
    type Per<T: Entry>: Array<T>;

    /// Whether the measure is a length, whose conjugate is a force.
    const IS_SPRING: bool;
    /// Unit of a viscous stretch, whose rate times the viscosity is the force of a dashpot.
    const VISCOUS_UNIT: &'static str;
    /// Unit of a viscosity.
    const VISCOSITY_UNIT: &'static str;

    /// The factor that makes an energy of the force of a dashpot: the measure, m, for a force in N; one for strains.
    fn unit(measures: &Self::Per<f64>) -> f64;
}

/// A number per measure of a set.
pub(crate) type Numbers<Q> = <Q as MeasureSet>::Per<f64>;

/// The length of a spring.
#[derive(Clone, Copy, Debug)]
pub struct Length;

impl MeasureSet for Length {
    type Per<T: Entry> = [T; 1];

    const IS_SPRING: bool = true;
    const VISCOUS_UNIT: &'static str = "m";
    const VISCOSITY_UNIT: &'static str = "N s/m";

    #[inline]
    fn unit(&[lambda]: &[f64; 1]) -> f64 {
        lambda
    }
}

/// The N strains at a point of a solid.
#[derive(Clone, Copy, Debug)]
pub struct StrainSet<const N: usize>;

impl<const N: usize> MeasureSet for StrainSet<N> {
    type Per<T: Entry> = [T; N];

    const IS_SPRING: bool = false;
    const VISCOUS_UNIT: &'static str = "";
    const VISCOSITY_UNIT: &'static str = "J s";

    #[inline]
    fn unit(_: &[f64; N]) -> f64 {
        1.0
    }
}

/// The measures at a point of an element as functions of its edge vectors from node 0 (arms), in `D` dimensions.
pub trait Kinematics<const D: usize>: Copy + Send + Sync + core::fmt::Debug + 'static {
    /// `[T; number of nodes]`.
    type PerNode<T: Entry>: Array<T>;
    /// `[T; number of nodes − 1]`.
    type PerArm<T: Entry>: Array<T>;
    /// Its measures.
    type Measures: MeasureSet;

    /// `[T; number of points]`, at which the free energy is evaluated.
    type PerPoint<T: Send + Sync>: Points<T>;

    /// The common part of the mean-value gradients between two states.
    type Between: Copy + Send + Sync + core::fmt::Debug;

    /// Whether an element can have these arms, whose measures are given.
    fn is_admissible(&self, r: &Arms<Self, D>, measures: &Measures<Self, D>) -> bool;

    /// Why an element cannot have these arms.
    fn refusal(&self, element: Element, r: &Arms<Self, D>) -> StateError;

    /// The displacement that changes its gradients by their own size, m.
    fn length(&self, measures: &Measures<Self, D>) -> f64;

    /// The terms of the measures, `|∂π/∂r| |r|`: times ε, the effect of rounding of the arms.
    fn sizes(&self, r: &Arms<Self, D>, measures: &Measures<Self, D>) -> Measures<Self, D>;

    /// The largest `|∂π/∂r|` of each measure.
    fn slopes(&self, r: &Arms<Self, D>, measures: &Measures<Self, D>) -> Measures<Self, D>;

    /// The magnitude of the terms of `∂π/∂r`, `|∂²π/∂r²| |r|`: times ε, the rounding of the gradient. It is the
    /// gradient itself unless its terms cancel.
    fn slope_sizes(&self, r: &Arms<Self, D>, measures: &Measures<Self, D>) -> Measures<Self, D> {
        self.slopes(r, measures)
    }

    /// Stress and strain with these arms under conjugates of the measures; `None` for a spring.
    fn solid_state(&self, _: &Arms<Self, D>, _: &Measures<Self, D>) -> Option<SolidState> {
        None
    }

    /// Calls `see` with the numbers of the reference configuration, which distinguish elements.
    fn numbers(&self, see: &mut dyn FnMut(f64));

    /// The measures `π(r)`, exact to rounding where the arms are admissible. Elsewhere they may be zero or infinite.
    fn measure(&self, r: &Arms<Self, D>) -> Measures<Self, D>;

    /// `∂π/∂r` at `r`, whose measures are given.
    fn gradient(&self, r: &Arms<Self, D>, measures: &Measures<Self, D>) -> Gradient<Self, D>;

    /// `Σ_a f_a ∂²π_a/∂r²`.
    fn curvature(
        &self,
        r: &Arms<Self, D>,
        measures: &Measures<Self, D>,
        force: &Measures<Self, D>,
    ) -> Blocks<Self, D>;

    /// The common part of the mean-value gradients between old and new arms.
    fn between(&self, arms: [&Arms<Self, D>; 2]) -> Self::Between;

    /// `∂π/∂r` at the new arms.
    #[inline]
    fn new_gradient(&self, ends: &Ends<Self, D>) -> Gradient<Self, D> {
        self.gradient(&ends.r1, &ends.measures1)
    }

    /// The mean-value gradient `D*π` between two states.
    fn discrete_gradient(&self, ends: &Ends<Self, D>) -> Gradient<Self, D>;

    /// `Σ_a f_a D*π_a` along given gradients. If forces of several measures cancel, they are summed before they act on the
    /// nodes, whose torque is then zero to the rounding of the sum.
    #[inline]
    fn pull(
        &self,
        _: &Ends<Self, D>,
        gradient: &Gradient<Self, D>,
        force: &Measures<Self, D>,
    ) -> Arms<Self, D> {
        let mut sum = gradient[0];
        for (a, (row, &force)) in gradient.as_ref().iter().zip(force.as_ref()).enumerate() {
            for (sum, row) in sum.as_mut().iter_mut().zip(row.as_ref()) {
                for (sum, &entry) in sum.iter_mut().zip(row) {
                    let term = force * entry;
                    *sum = if a == 0 { term } else { *sum + term };
                }
            }
        }
        sum
    }

    /// The derivative of `Σ_a f_a D*π_a` with respect to `r¹`, given that of the forces,
    ///
    /// ```text
    /// Σ_a (f_a ∂(D*π_a)/∂r¹ + D*π_a ∂f_a/∂r¹)
    /// ```
    fn discrete_tangent(
        &self,
        ends: &Ends<Self, D>,
        force: &Measures<Self, D>,
        force_by_arm: &Gradient<Self, D>,
    ) -> Blocks<Self, D>;

    /// Adds [`discrete_tangent`](Self::discrete_tangent) to a sum.
    #[inline]
    fn add_discrete_tangent(
        &self,
        ends: &Ends<Self, D>,
        force: &Measures<Self, D>,
        force_by_arm: &Gradient<Self, D>,
        sum: &mut Blocks<Self, D>,
    ) {
        let own = self.discrete_tangent(ends, force, force_by_arm);
        add_blocks::<Self, D>(sum, &own);
    }

    /// `D*π_a·w` of each measure, for vectors w on the arms.
    #[cfg(feature = "gradients")]
    #[inline]
    fn discrete_rates(&self, ends: &Ends<Self, D>, w: &Arms<Self, D>) -> Measures<Self, D> {
        let mut rates = Measures::<Self, D>::filled(0.0);
        let gradient = self.discrete_gradient(ends);
        for (rate, row) in rates.as_mut().iter_mut().zip(gradient.as_ref()) {
            let pairs = row
                .as_ref()
                .iter()
                .flatten()
                .zip(w.as_ref().iter().flatten());
            *rate = pairs.fold(0.0, |sum, (&g, &w)| sum + g * w);
        }
        rates
    }

    /// The derivative of `Σ_a (p_a π_a(r¹) + f_a D*π_a·w)` with respect to `r¹`, for numbers p and vectors w on the arms.
    #[cfg(feature = "gradients")]
    #[inline]
    fn pull_back(
        &self,
        ends: &Ends<Self, D>,
        p: &Measures<Self, D>,
        (force, w): (&Measures<Self, D>, &Arms<Self, D>),
    ) -> Arms<Self, D> {
        let still = Gradient::<Self, D>::filled(Arms::<Self, D>::filled([0.0; D]));
        let blocks = self.discrete_tangent(ends, force, &still);
        let mut sum = self.pull(ends, &self.new_gradient(ends), p);
        for (row, w) in blocks.as_ref().iter().zip(w.as_ref()) {
            for (sum, block) in sum.as_mut().iter_mut().zip(row.as_ref()) {
                for (entries, &w) in block.iter().zip(w) {
                    for (sum, &entry) in sum.iter_mut().zip(entries) {
                        *sum += w * entry;
                    }
                }
            }
        }
        sum
    }

    /// A of `Σ_a f_a D*π_a = A r_m`, which depends on the arms only through the strains at both ends.
    fn secant(&self, ends: &Ends<Self, D>, force: &Measures<Self, D>) -> Weights<Self, D>;
}

/// A number per component of the strain C.
pub(crate) type PerStrain<G> = <G as StrainMeasures>::PerStrain<f64>;

/// A number per measure of a strain.
pub(crate) type MeasuresOf<G> = Numbers<<G as StrainMeasures>::Measures>;

/// Derivatives of measures with respect to the strain.
pub(crate) type StrainSlopes<G> =
    <<G as StrainMeasures>::Measures as MeasureSet>::Per<PerStrain<G>>;

/// A square matrix of the components of the strain.
pub(crate) type StrainMatrix<G> = <G as StrainMeasures>::PerStrain<PerStrain<G>>;

/// Measures as functions of the strain C, apart from its nodes: all that the path of a point through a step knows of them.
pub(crate) trait StrainMeasures: Copy + Send + Sync + core::fmt::Debug + 'static {
    /// Its measures.
    type Measures: MeasureSet;
    /// `[T; number of components]`.
    type PerStrain<T: Entry>: Array<T>;

    /// The magnitude of the terms of each component of a strain.
    fn sizes(&self, strain: &PerStrain<Self>) -> PerStrain<Self>;

    /// The weight of each component in the square of a strain, and the unit of the strain.
    fn metric(&self, strain: &PerStrain<Self>) -> (PerStrain<Self>, f64);

    /// The measures of a strain; `None` if no deformation has it.
    fn measures_of(&self, strain: &PerStrain<Self>) -> Option<MeasuresOf<Self>>;

    /// Why an element cannot have this strain within a step.
    fn refuse(&self, element: Element, strain: &PerStrain<Self>) -> StateError;

    /// P with `P·(C¹ − C⁰) = π¹ − π⁰` exactly, symmetric in both.
    fn slopes(&self, ends: [&PerStrain<Self>; 2]) -> StrainSlopes<Self>;

    /// `Σ_a f_a ∂²π_a/∂C²`.
    fn curvature(&self, strain: &PerStrain<Self>, force: &MeasuresOf<Self>) -> StrainMatrix<Self>;
}

/// Kinematics with the strain C of an element, which is quadratic in the arms:
///
/// ```text
/// spring    C = λ² = r·r             solid    C = E = ½(FᵀF − 1), component by component
/// Ċ = ∂C/∂r·ṙ                        bilinear in arms and velocities
/// ```
///
/// A path of C through a step, with Ċ from the arms at Gauss points, ends at the strain of the new arms exactly.
pub(crate) trait QuadraticStrain<const D: usize>: Kinematics<D> {
    /// What [`strain_measures`](Self::strain_measures) gives.
    type Strain: StrainMeasures<Measures = Self::Measures>;

    /// The measures as functions of C.
    fn strain_measures(&self) -> Self::Strain;

    /// C of these arms.
    fn strain(&self, r: &Arms<Self, D>) -> PerStrain<Self::Strain>;

    /// `∂C/∂r·w`, bilinear in r and w.
    fn strain_rate(&self, r: &Arms<Self, D>, w: &Arms<Self, D>) -> PerStrain<Self::Strain>;

    /// `Σ n_q ∂C_q/∂r`, linear in r.
    fn strain_force(&self, r: &Arms<Self, D>, n: &PerStrain<Self::Strain>) -> Arms<Self, D>;

    /// The magnitude of the terms of [`strain_force`](Self::strain_force), given that of n.
    fn strain_force_size(&self, r: &Arms<Self, D>, n: &PerStrain<Self::Strain>) -> f64;

    /// `Σ n_q ∂²C_q/∂r²`.
    fn strain_stiffness(&self, n: &PerStrain<Self::Strain>) -> Weights<Self, D>;
}

/// Adds blocks to a sum.
#[inline]
pub(crate) fn add_blocks<K: Kinematics<D>, const D: usize>(
    sum: &mut Blocks<K, D>,
    own: &Blocks<K, D>,
) {
    for (sum, own) in sum.as_mut().iter_mut().zip(own.as_ref()) {
        for (sum, own) in sum.as_mut().iter_mut().zip(own.as_ref()) {
            for (sum, own) in sum.as_flattened_mut().iter_mut().zip(own.as_flattened()) {
                *sum += *own;
            }
        }
    }
}

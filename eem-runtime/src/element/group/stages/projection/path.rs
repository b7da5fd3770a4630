//! The path of a point through a step: its beginning, its points at a trial, and the projections from them.

use super::vector::{Last, Matrix, Vector, chained, derivatives, steepness, sum_of};
use crate::element::conduction::InterfaceTemperatures;
use crate::element::conjugates::{Infeasible, temperature_at};
use crate::element::error::StateError;
use crate::element::group::point::Point;
use crate::element::group::stages::point::StagePoint;
use crate::element::group::stages::site::PerPair;
use crate::element::group::view::StepView;
use crate::element::handle::Element;
use crate::element::kinematics::{MeasuresOf, PerStrain, StrainMeasures};
use crate::element::tableau::{MOST_POINTS, MOST_SETS, MOST_STAGES, Path};
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;
use eem_material::number::scalar::is_positive;

/// The path of a point through a step, and the projections from it. It knows the strain and no nodes, so that it is the same in any
/// number of dimensions.
pub(crate) struct PointPath<A: Arrays, G: StrainMeasures> {
    pub(super) point: StagePoint,
    /// Its measures as functions of C.
    pub(super) measures: G,
    /// `y⁰ = (C, γ…, s)`, and the data of `(π, γ, θ)⁰` for the discrete derivatives.
    pub(super) old: Vector<A, G>,
    old_form: A::Kept,
    /// The units of the increments of γ and s: that of viscous stretches, the old heat capacity.
    pub(super) units: Vector<A, G>,
    /// The diagonal of W.
    pub(super) metric: Vector<A, G>,
    /// R: the increments h ẏ at the stages.
    pub(super) rates: [Vector<A, G>; MOST_STAGES],
    /// R before the last correction, and the correction, both without C.
    pub(super) previous: [Vector<A, G>; MOST_STAGES],
    pub(super) correction: [Vector<A, G>; MOST_STAGES],
    /// The temperatures of the points of the path, and that of its end, K; constant in a step if they are prescribed.
    pub(super) temperatures: [f64; MOST_POINTS + 1],
    /// w, of prescribed temperatures, and μ w, J.
    pub(super) warming: f64,
    pub(super) heat_beyond: f64,
    /// y¹, and `∇ê` and the magnitudes of the terms of C at both ends.
    pub(super) end: Vector<A, G>,
    pub(crate) end_slopes: [Vector<A, G>; 2],
    pub(super) end_sizes: [PerStrain<G>; 2],
    /// a.
    pub(crate) conjugates: [Vector<A, G>; MOST_STAGES],
    /// `∂a_i/∂R_j`.
    pub(super) by_rates: Box<PerPair<Matrix<A, G>>>,
    /// `Σ_r |projection_ir| Σ_y |∂²ê/∂x∂y| |y|`: times ε, the conditioning error of the conjugates.
    pub(super) conditioning: [Vector<A, G>; MOST_STAGES],
    /// `|∂²ψ/∂γ_k²|` in the old state, N/m.
    pub(super) stiffness: A::Viscosities,
    /// `η_k` and `dη_k/dθ` at `Θ_i`.
    pub(super) viscosities: [(A::Viscosities, A::Viscosities); MOST_STAGES],
    /// The heat `f ν` of the Kelvin–Voigt dashpot at the stages, J, and its derivatives with respect to the temperature
    /// and, at constant temperature, to the increments of C.
    pub(super) viscous_heat: [f64; MOST_STAGES],
    pub(super) heat_by_theta: [f64; MOST_STAGES],
    pub(super) heat_by_strain: PerPair<PerStrain<G>>,
    /// Heat from other elements at the stages, W.
    pub(super) received: [f64; MOST_STAGES],
}

impl<A: Arrays, G: StrainMeasures> PointPath<A, G> {
    /// Number of variables y, of components of the strain among them, and the index of the entropy.
    pub(super) const LEN: usize = Vector::<A, G>::LEN;
    pub(super) const STRAINS: usize = Vector::<A, G>::STRAINS;
    pub(super) const ENTROPY: usize = Vector::<A, G>::ENTROPY;

    pub(crate) fn new(measures: G, point: StagePoint) -> Self {
        let (none, zeros) = (0.0, Vector::zero());
        let viscosities = A::Viscosities::filled(none);
        let strain = PerStrain::<G>::filled(none);
        Self {
            point,
            measures,
            old: zeros,
            old_form: A::Kept::filled(none),
            units: zeros,
            metric: zeros,
            rates: [zeros; MOST_STAGES],
            previous: [zeros; MOST_STAGES],
            correction: [zeros; MOST_STAGES],
            temperatures: [none; MOST_POINTS + 1],
            warming: none,
            heat_beyond: none,
            end: zeros,
            end_slopes: [zeros; 2],
            end_sizes: [strain; 2],
            conjugates: [zeros; MOST_STAGES],
            by_rates: Box::new([[Matrix::zero(); MOST_SETS]; MOST_SETS]),
            conditioning: [zeros; MOST_STAGES],
            stiffness: viscosities,
            viscosities: [(viscosities, viscosities); MOST_STAGES],
            viscous_heat: [none; MOST_STAGES],
            heat_by_theta: [none; MOST_STAGES],
            heat_by_strain: [[strain; MOST_SETS]; MOST_SETS],
            received: [none; MOST_STAGES],
        }
    }

    /// Starts the trial at the old variables and the old strain.
    pub(super) fn begin_at(
        &mut self,
        in_state: &Point<A, G::Measures>,
        x0: &A::Variables,
        strain: &PerStrain<G>,
    ) {
        let (measures, last) = (&self.measures, A::Variables::LEN - 1);
        let (gradient, hessian) = in_state.model.hessian(x0);
        (in_state.model).keep_for_temperature_form(x0, &mut self.old_form);
        (self.old.rest, self.old.strain) = (*x0, *strain);
        for k in 0..self.point.dashpots {
            let row = A::MEASURES + k;
            self.stiffness[k] = hessian[row][row].abs();
        }
        let (slopes, curvatures) = self.derivatives(strain, (x0, &gradient, &hessian));
        self.end_slopes[0] = slopes;
        self.end_sizes[0] = measures.sizes(strain);
        let strains = 0..Self::STRAINS;
        let (counts, unit) = measures.metric(strain);
        let derivatives = (&slopes, &curvatures);
        let of_strain = steepness(derivatives, strains.clone(), |q| counts[q], unit);
        for q in strains.clone() {
            self.metric[q] = counts[q] * of_strain;
        }
        let entropy = Self::ENTROPY;
        let components = entropy - in_state.model.viscous_strain()..entropy;
        for index in strains.end..components.start {
            let unit = self.point.viscous_unit;
            self.units[index] = unit;
            self.metric[index] = steepness(derivatives, index..index + 1, |_| 1.0, unit);
        }
        // Components of a tensor count alike, whatever the axes are.
        let of_components = steepness(derivatives, components.clone(), |_| 1.0, 1.0);
        for index in components {
            self.units[index] = self.point.viscous_unit;
            self.metric[index] = of_components;
        }
        if self.point.is_thermal {
            let theta = x0[last];
            self.old[entropy] = self.point.entropy;
            self.units[entropy] = -theta * hessian[last][last];
            self.metric[entropy] = curvatures.at([entropy, entropy]);
            self.temperatures = [theta; MOST_POINTS + 1];
            self.warming = 0.0;
            if let Some(prescribed) = self.point.prescribed {
                let course = self.point.rule.course(theta, &prescribed);
                if let Some((temperatures, squares)) = course {
                    self.temperatures = temperatures;
                    self.warming = -hessian[last][last] * squares;
                }
            }
        }
        self.rates = [Vector::zero(); MOST_STAGES];
    }

    /// Evaluates the model along the path, given the increments of C.
    pub(crate) fn evaluate(
        &mut self,
        in_state: &mut Point<A, G::Measures>,
        strain_rates: &[PerStrain<G>; MOST_STAGES],
        (view, interface): (&StepView<'_>, &InterfaceTemperatures),
    ) -> Result<(), StateError> {
        for (rates, strain) in self.rates.iter_mut().zip(strain_rates) {
            rates.strain = *strain;
        }
        if let Some(slot) = in_state.slots().thermal {
            for stage in 0..self.point.rule.stages() {
                self.received[stage] = self.point.heat_received(stage, slot, (view, interface));
            }
        }
        self.project(in_state)?;
        let end = self.reach_end(in_state)?;
        self.make_exact(&end);
        self.find_viscosities(in_state)?;
        self.add_kelvin_voigt(in_state, view.per_step)
    }

    /// Whether a thermostat prescribes its temperature.
    fn is_held(&self) -> bool {
        self.point.prescribed.is_some()
    }

    /// Θ of a stage, K; zero without temperature.
    pub(super) fn mean_temperature(&self, stage: usize) -> f64 {
        if self.point.is_thermal {
            self.conjugates[stage][Self::ENTROPY]
        } else {
            0.0
        }
    }

    /// `Σ_j shares_j R_j`.
    pub(super) fn increments(&self, shares: &[f64]) -> Vector<A, G> {
        let mut sum = Vector::zero();
        for (rates, &share) in self.rates.iter().zip(shares) {
            for index in 0..Self::LEN {
                sum[index] += share * rates[index];
            }
        }
        sum
    }

    /// `y = (C, γ, s)` at the point of the path after these fractions of the increments.
    pub(super) fn path_at(&self, shares: &[f64]) -> Vector<A, G> {
        let mut y = self.increments(shares);
        for index in 0..Self::LEN {
            y[index] += self.old[index];
        }
        y
    }

    /// Finds the conjugates of the stages and their derivatives, before [`make_exact`](Self::make_exact).
    fn project(&mut self, in_state: &Point<A, G::Measures>) -> Result<(), StateError> {
        let rule = self.point.rule;
        let Some(path) = rule.path else {
            return Ok(());
        };
        self.conjugates = [Vector::zero(); MOST_STAGES];
        self.conditioning = [Vector::zero(); MOST_STAGES];
        let stages = rule.stages();
        for row in &mut self.by_rates[..stages] {
            row[..stages].fill(Matrix::zero());
        }
        for (r, shares) in path.integrals.iter().enumerate() {
            let (y, x) = self.find_point(in_state, shares, r)?;
            let (gradient, hessian) = in_state.model.hessian(&x);
            if self.point.is_thermal {
                // ∂²ψ/∂θ² = −c/θ
                let (last, theta) = (A::Variables::LEN - 1, x[A::Variables::LEN - 1]);
                Infeasible::unless_stable(-theta * hessian[last][last], theta)
                    .map_err(|infeasible| infeasible.of(in_state.element))?;
            }
            check_finite(in_state.element, sum_of(gradient.as_ref()))?;
            let of_energy = self.derivatives(&y.strain, (&x, &gradient, &hessian));
            self.take((&path, r), &y, &of_energy);
        }
        Ok(())
    }

    /// `∇ê` and `∇²ê` at a strain, given the derivatives of ψ.
    pub(super) fn derivatives(
        &self,
        strain: &PerStrain<G>,
        of_model: (&A::Variables, &A::Variables, &A::Hessian),
    ) -> (Vector<A, G>, Matrix<A, G>) {
        let last = match (self.point.is_thermal, self.is_held()) {
            (false, _) => Last::Absent,
            (true, false) => Last::Entropy,
            (true, true) => Last::Temperature,
        };
        derivatives(&self.measures, strain, of_model, last)
    }

    /// Adds the contribution of a point of the path to the projections.
    fn take(
        &mut self,
        (path, r): (&Path, usize),
        y: &Vector<A, G>,
        (slopes, curvatures): &(Vector<A, G>, Matrix<A, G>),
    ) {
        let mut sizes = *y;
        sizes.strain = self.measures.sizes(&y.strain);
        let variables = 0..Self::LEN;
        for (stage, shares) in path.projection.iter().enumerate() {
            let share = shares[r];
            for index in variables.clone() {
                self.conjugates[stage][index] += share * slopes[index];
                let size = variables.clone().fold(0.0, |sum, column| {
                    sum + (curvatures.at([index, column]) * sizes[column]).abs()
                });
                self.conditioning[stage][index] += share.abs() * size;
            }
            for (by, &reach) in self.by_rates[stage].iter_mut().zip(path.integrals[r]) {
                let factor = share * reach;
                for row in variables.clone() {
                    for column in variables.clone() {
                        *by.at_mut([row, column]) += factor * curvatures.at([row, column]);
                    }
                }
            }
        }
    }

    /// The measures of a strain of the path.
    pub(super) fn measures_in_path(
        &self,
        element: Element,
        strain: &PerStrain<G>,
    ) -> Result<MeasuresOf<G>, StateError> {
        let measures = self.measures.measures_of(strain);
        measures.ok_or_else(|| self.measures.refuse(element, strain))
    }

    /// `y = (C, γ, s)` and `x = (π, γ, θ)` at the point of the path after these fractions of the increments.
    pub(super) fn find_point(
        &mut self,
        in_state: &Point<A, G::Measures>,
        shares: &[f64],
        point: usize,
    ) -> Result<(Vector<A, G>, A::Variables), StateError> {
        let y = self.path_at(shares);
        let measures = self.measures_in_path(in_state.element, &y.strain)?;
        let near = self.temperatures[point];
        let mut x = y.variables(measures.as_ref(), near);
        if self.point.is_thermal && !self.is_held() {
            let entropy = y[Self::ENTROPY];
            let found = temperature_at(&in_state.model, x, entropy, near);
            let theta = found.map_err(|infeasible| infeasible.of(in_state.element))?;
            (x[A::Variables::LEN - 1], self.temperatures[point]) = (theta, theta);
        }
        Ok((y, x))
    }

    /// Finds the end of the path; returns `∇ê` there, and the discrete derivatives between both ends, whose product with
    /// the increments is Δê. Of a prescribed temperature, the first are the derivatives of that product by the increments.
    fn reach_end(
        &mut self,
        in_state: &Point<A, G::Measures>,
    ) -> Result<[Vector<A, G>; 2], StateError> {
        let (end, x) = self.find_point(in_state, self.point.rule.weights, MOST_POINTS)?;
        let (measures, model) = (&self.measures, &in_state.model);
        self.end = end;
        self.end_sizes[1] = measures.sizes(&end.strain);
        let mut gradient = model.gradient(&x);
        let response = model.temperature_form_response(&self.old_form, &x);
        let mut mean = A::Variables::filled(0.0);
        mean.as_mut()
            .copy_from_slice(&response.as_ref()[..A::Variables::LEN]);
        for force in &mut mean.as_mut()[A::MEASURES..A::MEASURES + self.point.dashpots] {
            *force = -*force;
        }
        if self.point.is_thermal {
            let last = A::Variables::LEN - 1;
            gradient[last] = x[last];
        }
        let between = |ends, by: A::Variables| Vector {
            strain: chained::<G>(&measures.slopes(ends), by.as_ref()),
            rest: by,
        };
        let slopes = between([&end.strain, &end.strain], gradient);
        let discrete = between([&self.old.strain, &end.strain], mean);
        check_finite(in_state.element, slopes.sum() + discrete.sum())?;
        self.end_slopes[1] = slopes;
        if !self.is_held() {
            return Ok([slopes, discrete]);
        }
        // Δê + θ* (s − S), by (C, γ) and s: ψ_x + (θ − θ*) S_x, θ*
        let (last, (_, hessian)) = (A::Variables::LEN - 1, model.hessian(&x));
        for column in 0..last {
            gradient[column] -= (x[last] - mean[last]) * hessian[last][column];
        }
        gradient[last] = mean[last];
        Ok([between([&end.strain, &end.strain], gradient), discrete])
    }

    /// Finds the viscosities at the temperatures of the stages; an error unless both are positive.
    fn find_viscosities(&mut self, in_state: &mut Point<A, G::Measures>) -> Result<(), StateError> {
        for stage in 0..self.point.rule.stages() {
            let theta = self.mean_temperature(stage);
            if self.point.is_thermal && !is_positive(theta) {
                return Err(StateError::MeanTemperature {
                    element: in_state.element,
                    value: theta,
                });
            }
            in_state.find_viscosities(theta)?;
            self.viscosities[stage] = in_state.viscosities;
        }
        Ok(())
    }
}

/// An error unless a sum is finite.
fn check_finite(element: Element, sum: f64) -> Result<(), StateError> {
    if sum.is_finite() {
        return Ok(());
    }
    Err(StateError::NotFinite {
        element,
        quantity: "force or entropy",
        value: sum,
    })
}

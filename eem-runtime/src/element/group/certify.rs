//! The contribution of the elements to the certificate of a step.

use super::member::Member;
use super::point::Point;
use super::site::HeatPath;
use crate::element::balances::Received;
use crate::element::conduction::InterfaceTemperatures;
use crate::element::conjugates::{Any, Family};
use crate::element::group::view::StepView;
use crate::element::kinematics::{Arms, Kinematics, MeasureSet, Measures, Numbers};
use crate::element::state::Energy;
use crate::element::tally::{Care, Tally};
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;
use eem_material::number::scalar::Scalar;

impl<K: Kinematics<D>, const D: usize> Member<K, D> {
    /// Adds the magnitude of the terms of `h F` to that of the nodes, N s, given the new arms, their change, and what finds the magnitude of a
    /// point from sizes, slopes and sizes of slopes of its measures:
    ///
    /// ```text
    /// h Σ_π (|∂²π/∂r²| |r| |f*| + |∂π/∂r| Σ |∂f*/∂x_j| |x_j|) (1 + |Δr|/ℓ)
    /// ```
    #[cold]
    pub(super) fn add_magnitude(
        &self,
        h: f64,
        [r1, change]: [&Arms<K, D>; 2],
        magnitude_of: &dyn Fn(usize, [&Measures<K, D>; 3]) -> f64,
        magnitudes: &mut [f64],
    ) {
        let mut motion = 0.0;
        for arm in change.as_ref() {
            for component in arm {
                motion = Scalar::maximum(motion, component.abs());
            }
        }
        for (index, point) in self.points.as_ref().iter().enumerate() {
            let (kinematics, old, new) = (&point.kinematics, &point.measures0, &point.measures);
            let sizes = kinematics.sizes(r1, new);
            let slopes = kinematics.slopes(r1, new);
            let slope_sizes = kinematics.slope_sizes(r1, new);
            let sum = magnitude_of(index, [&sizes, &slopes, &slope_sizes]);
            let length = |measures| kinematics.length(measures);
            let magnitude = h * (sum * (1.0 + motion / Scalar::minimum(length(old), length(new))));
            for &node in self.site.nodes.as_ref() {
                magnitudes[node as usize] += magnitude;
            }
        }
    }
}

/// The magnitudes of the terms of the variables: times ε, their errors by rounding. Those of the measures are given.
#[inline]
pub(super) fn sizes_of<X: Array<f64>>(measures: &[f64], x: &X) -> X {
    let mut sizes = *x;
    for (a, &size) in measures.iter().enumerate() {
        sizes[a] = size;
    }
    sizes
}

/// `Σ|f||π| + Σ|g||γ|` of forces in a state, J, given the sizes of the measures.
#[inline]
pub(super) fn work_of<X: Array<f64>>(forces: &[f64], measures: &[f64], x: &X) -> f64 {
    let sizes = sizes_of(measures, x);
    let terms = forces.iter().zip(sizes.as_ref());
    terms.fold(0.0, |sum, (&force, &size)| sum + (force * size).abs())
}

/// Magnitudes of the terms of variables and responses, and the checks of a point by the certificate.
impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// A bound of the force between its nodes, `Σ |∂π/∂r| |f*|`, N.
    #[inline]
    pub(super) fn largest_pull<C: Family>(&self, slopes: &Numbers<Q>) -> f64 {
        let forces = self.pulls::<C>();
        let forces = forces.as_ref().iter().zip(slopes.as_ref());
        forces.fold(0.0, |sum, (&force, &slope)| sum + slope * force.abs())
    }

    /// See [`PointSet::magnitude_of_pull`].
    pub(super) fn magnitude_of_pull(&self, [sizes, slopes, slope_sizes]: [&Numbers<Q>; 3]) -> f64 {
        let sizes = sizes_of(sizes.as_ref(), &self.x);
        let mut sum = 0.0;
        for a in 0..A::MEASURES {
            sum += slope_sizes[a] * self.pull_of_row::<Any>(a).abs();
            sum += slopes[a] * self.resolution_of_row(a, &sizes);
        }
        sum
    }

    /// Adds the terms that the bound of the next step needs of a state: those of the forces and, except for schemes with discrete
    /// derivatives, those of the value of the energy.
    #[cold]
    pub(super) fn add_bounds(&self, sizes: &Numbers<Q>, x: &A::Variables, energy: &mut Energy) {
        let gradient = self.model.gradient(x);
        let forces = &gradient.as_ref()[..Self::TEMPERATURE];
        energy.add_forces(work_of(forces, sizes.as_ref(), x));
        if !self.scheme.is_exact() {
            energy.add_values(self.model.energy_magnitude(x));
        }
    }

    /// `Σ_j |T_ij| |x_j|`: times ε, the error of a response by rounding of the variables.
    fn magnitude_of_row(&self, row: usize, sizes: &A::Variables) -> f64 {
        let terms = self.slopes[row].as_ref().iter().zip(sizes.as_ref());
        terms.fold(0.0, |sum, (&slope, &x)| sum + (slope * x).abs())
    }

    /// The same where the internal variables solve the equations of the element, so that they change with the rounding
    /// of the measures:
    ///
    /// ```text
    /// Σ_j |T_ij| (|x_j| + Σ_a |∂u_j/∂π_a| |π_a|)
    /// ```
    ///
    /// With a small heat capacity c the temperature has an error of `ε θ |∂s/∂λ| λ/c`, far above its own rounding.
    #[cold]
    pub(super) fn resolution_of_row(&self, row: usize, sizes: &A::Variables) -> f64 {
        let mut sum = self.magnitude_of_row(row, sizes);
        for a in 0..A::MEASURES {
            let by_measure = &self.condensed.by_measure[a];
            for u in self.unknowns() {
                let answer = by_measure.get(u) * sizes[a];
                sum += (self.slopes[row][A::MEASURES + u] * answer).abs();
            }
        }
        sum
    }

    /// The contribution of the forces to A* and, for a thorough bound, to A⁺ of `step/certificate.rs`, and
    /// `Σ|f||π| + Σ|g||γ|` of the new state, J:
    ///
    /// ```text
    /// |f*|(λ⁰ + λ¹) + Σ |g*|(|γ⁰| + |γ¹|) + ε (|T_λλ| λ² + Σ |T_γγ| γ²)
    /// Σ_ij |T_ij| |x_j| |Δx_i|,     Δx = (Δλ, Δγ, Δs)
    /// |f* + Σ T_λj Δx_j| λ¹ + Σ |g* + Σ T_γj Δx_j| |γ¹|
    /// ```
    ///
    /// The part with ε is the effect of rounding at a minimum of the energy. The measures of a solid are ratios, whose
    /// sizes are unrelated to the motion: its bound is always thorough.
    ///
    /// `f* + Σ T_λj Δx_j` over the mechanical variables is the force of the new state, since f* is a divided
    /// difference: where only λ changes, `T_λλ = (f¹ − f*)/Δλ`. It is exact for energies that are quadratic in them.
    /// Where the temperature changes, it is the mean of the forces at both temperatures.
    /// A thorough bound also has `of_sums`, the rounding of the sums of forces at its nodes:
    ///
    /// ```text
    /// Σ_a |∂π_a/∂r| |f*_a| Σ |Δq|
    /// ```
    #[inline]
    pub(super) fn amplitude<C: Family>(
        &self,
        [sizes0, sizes1]: &[A::Variables; 2],
        of_sums: Option<f64>,
    ) -> [f64; 2] {
        let (mut sum, mut at_end) = (0.0, 0.0);
        for row in 0..A::MEASURES + self.dashpots() {
            let size = sizes1[row].abs();
            let rounding = f64::EPSILON * size * size;
            sum += self.pull_of_row::<C>(row).abs() * (sizes0[row].abs() + size);
            sum += self.slopes[row][row].abs() * rounding;
            let slopes = &self.slopes[row].as_ref()[..A::MEASURES + A::DASHPOTS];
            let slopes = slopes.iter().enumerate();
            let force = slopes.fold(self.response[row], |force, (column, &slope)| {
                force + slope * self.increment_of(column)
            });
            // The slopes contain those of the damping, which is zero at rest.
            let damping = self.damping::<C>();
            let force = damping.map_or(force, |damping| force - damping.force[row]);
            at_end += force.abs() * size;
        }
        match of_sums {
            Some(of_sums) => sum += self.work_of_arguments(sizes1) + of_sums,
            None if Q::IS_SPRING => {}
            None => sum += self.work_of_arguments(sizes1),
        }
        [sum, at_end]
    }

    #[cold]
    fn work_of_arguments(&self, sizes: &A::Variables) -> f64 {
        let mut sum = 0.0;
        for row in 0..A::MEASURES + self.dashpots() {
            sum += self.magnitude_of_row(row, sizes) * self.increment_of(row).abs();
        }
        if self.is_thermal() {
            let change = self.response[Self::ENTROPY];
            sum += self.magnitude_of_row(Self::TEMPERATURE, sizes) * change.abs();
        }
        sum
    }

    /// The conditioning error of a response, in units of ε.
    #[inline]
    fn known_to(&self, row: usize, sizes: &A::Variables, care: Care) -> f64 {
        match care {
            Care::Quick => self.response[row].abs(),
            Care::Thorough => self.response[row].abs() + self.resolution_of_row(row, sizes),
        }
    }

    /// Checks the balances of the internal variables at the last response, given the received entropy, J/K, the
    /// magnitude of the terms of the energy, J, and the heat capacity, J/K.
    #[expect(
        clippy::inline_always,
        reason = "a call costs 0.5 % of a step of a spring"
    )]
    #[inline(always)]
    pub(super) fn judge<C: Family>(
        &self,
        view: &StepView<'_>,
        (paths, interface): (Option<&[HeatPath]>, &InterfaceTemperatures),
        sizes: &A::Variables,
        (received, [magnitude, capacity]): (Received, [f64; 2]),
        tally: &mut Tally,
    ) {
        for k in 0..self.dashpots() {
            if view.phase.heats() {
                let row = A::MEASURES + k;
                let drag = self.viscosities.0[k] * self.creep_rate::<C>(k, view);
                let terms = drag.abs() + self.known_to(row, sizes, tally.care);
                tally.balance(drag - self.pull_of_row::<C>(row), terms);
                if !C::is_damped(self.scheme) {
                    // g* is a divided difference, with half the slope of g.
                    let slope = self.slopes[row][row].abs();
                    tally.see_relaxation(view.step, slope, self.viscosities.0[k]);
                }
            }
        }
        let Some(slot) = self.slots().thermal else {
            return;
        };
        let theta = self.temperature();
        let taken = theta * self.response[Self::ENTROPY];
        if !self.is_prescribed {
            if !C::is_damped(self.scheme) {
                let settling = view.conduction.settling(slot);
                tally.see_relaxation(view.thermal_step(), settling, capacity);
            }
            let terms = magnitude + theta * received.terms;
            tally.balance(taken - theta * received.entropy, terms);
        }
        if paths.is_some() {
            // A damped temperature is known as well as θ*: Δs is known to ε of the heat capacity.
            let conducting = self.conducting_temperature::<C>(&self.response);
            let terms = self.known_to(Self::TEMPERATURE, sizes, tally.care);
            let terms = terms + (conducting - theta).abs();
            tally.balance(interface.values()[slot] - conducting, terms);
        }
    }
}

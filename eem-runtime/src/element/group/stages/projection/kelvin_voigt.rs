//! The Kelvin–Voigt dashpot, in parallel with a spring or a solid, at the stages.
//!
//! ```text
//! ν_i = P_i·R_i,   f_i = η(Θ_i) ν_i/h,   a_i += f_i P_i,   heat f_i ν_i        P_i = ∂π/∂C at C(c_i)
//! ```
//!
//! at the strain of the path, so that the heat is the work that the nodes lose.

use super::path::PointPath;
use crate::element::error::StateError;
use crate::element::group::point::Point;
use crate::element::kinematics::{MeasuresOf, PerStrain, StrainMeasures};
use crate::element::tableau::MOST_SETS;
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;

impl<A: Arrays, G: StrainMeasures> PointPath<A, G> {
    /// Adds the forces of the dashpot to conjugates that are exact without them.
    pub(super) fn add_kelvin_voigt(
        &mut self,
        in_state: &mut Point<A, G::Measures>,
        per_step: f64,
    ) -> Result<(), StateError> {
        if const { !Point::<A, G::Measures>::MAY_HAVE_DRAG } || in_state.drags() == 0 {
            return Ok(());
        }
        for stage in 0..self.point.rule.stages() {
            in_state.find_drag_viscosity(self.mean_temperature(stage))?;
            let (viscosities, slopes) = in_state.drag.viscosity;
            (self.viscous_heat[stage], self.heat_by_theta[stage]) = (0.0, 0.0);
            self.heat_by_strain[stage] = [PerStrain::<G>::filled(0.0); MOST_SETS];
            for a in 0..in_state.drags() {
                let per_step = [viscosities[a] * per_step, slopes[a] * per_step];
                self.add_kelvin_voigt_of(in_state, [stage, a], per_step)?;
            }
        }
        Ok(())
    }

    /// The same for a measure at a stage, given `η/h` and `(dη/dθ)/h`.
    fn add_kelvin_voigt_of(
        &mut self,
        in_state: &Point<A, G::Measures>,
        [stage, measure]: [usize; 2],
        [eta, slope]: [f64; 2],
    ) -> Result<(), StateError> {
        let (strains, last) = (Self::STRAINS, Self::ENTROPY);
        let (measures, reaches) = (self.measures, self.point.rule.rates[stage]);
        let strain = self.path_at(reaches).strain;
        self.measures_in_path(in_state.element, &strain)?;
        let direction = measures.slopes([&strain, &strain])[measure];
        let mut unit = MeasuresOf::<G>::filled(0.0);
        unit[measure] = 1.0;
        let turning = measures.curvature(&strain, &unit);
        let rates = self.rates[stage].strain;
        // ∂P/∂C·R
        let mut turned = PerStrain::<G>::filled(0.0);
        let mut extension = 0.0;
        for q in 0..strains {
            extension += direction[q] * rates[q];
            for p in 0..strains {
                turned[q] += turning[q][p] * rates[p];
            }
        }
        // The terms of the extension, which may cancel.
        let sizes = measures.sizes(&strain);
        let terms = direction.as_ref().iter().zip(sizes.as_ref());
        let size = terms.fold(0.0, |sum, (&slope, &size)| sum + (slope * size).abs());
        let (force, thinning) = (eta * extension, slope * extension);
        self.viscous_heat[stage] += force * extension;
        self.heat_by_theta[stage] += thinning * extension;
        for q in 0..strains {
            self.conjugates[stage][q] += force * direction[q];
            self.conditioning[stage][q] += (direction[q] * eta * size).abs();
        }
        for (set, &reach) in reaches.iter().enumerate() {
            let by = &mut self.by_rates[stage][set];
            for p in 0..strains {
                let direct = if set == stage { direction[p] } else { 0.0 };
                let by_extension = direct + reach * turned[p];
                self.heat_by_strain[stage][set][p] += (force + force) * by_extension;
                for q in 0..strains {
                    *by.at_mut([q, p]) +=
                        eta * by_extension * direction[q] + force * reach * turning[q][p];
                }
            }
            for q in 0..strains {
                for column in (0..Self::LEN).filter(|_| self.point.is_thermal) {
                    let by_theta = by.at([last, column]);
                    *by.at_mut([q, column]) += thinning * direction[q] * by_theta;
                }
            }
        }
        Ok(())
    }
}

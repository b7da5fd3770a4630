//! From the solution of the global system to the internal variables of the elements.

use super::arms::along;
use super::placed::PlacedPoint;
use super::point::Point;
use super::share::run;
use super::site::{Contact, Site};
use crate::element::conjugates::Family;
use crate::element::kinematics::{Arms, Kinematics, MeasureSet, Numbers};
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;
use eem_material::number::scalar::Scalar;

impl<A: Arrays, K: Kinematics<D>, const D: usize> PlacedPoint<A, K, D> {
    /// Applies the corrections of the local unknowns for a motion of the arms; returns the largest in their units.
    #[inline]
    pub(super) fn correct<C: Family>(
        &mut self,
        motion: &Arms<K, D>,
        contact: Option<&Contact<K, D>>,
        solution: &[[f64; 1]],
        by_factors: bool,
    ) -> f64 {
        let changes = Self::rates_along(&self.sensitivity, motion);
        let mut heat = 0.0;
        if self.is_thermal()
            && let Some(contact) = contact
        {
            heat = self.condensed.heat_factor * contact.heat(solution);
        }
        if !C::IS_EXACT
            && let Some(by_increment) = &self.by_increment
        {
            heat += along::<K, D>(by_increment, motion);
        }
        self.point
            .correct::<C>(&changes, (heat, contact.is_some()), by_factors)
    }
}

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// Applies the corrections of the local unknowns, given the changes of the measures and `δr_s`; returns the largest in
    /// their units.
    #[inline]
    fn correct<C: Family>(
        &mut self,
        changes: &Numbers<Q>,
        (heat, is_coupled): (f64, bool),
        by_factors: bool,
    ) -> f64 {
        for a in 0..A::MEASURES {
            self.correction[a] = changes[a];
        }
        for u in 0..Self::UNKNOWNS {
            if !self.own_unknowns().has::<A>(u) {
                continue;
            }
            let mut change = self.condensed.constant.get(u);
            for a in 0..A::MEASURES {
                change += self.condensed.by_measure[a].get(u) * self.correction[a];
            }
            if self.depends_on_heat::<C>(is_coupled) {
                change += self.condensed.by_heat.get(u) * heat;
            }
            self.correction[A::MEASURES + u] = -change;
        }
        self.remember();
        if self.is_thermal() {
            let (change, correction) = (self.response[Self::ENTROPY], self.correction);
            if let Some(at_point) = self.single_mut::<C>() {
                at_point.previous_entropy_change = change;
                let terms = at_point.entropy_by.as_ref().iter();
                let terms = terms.zip(correction.as_ref());
                at_point.entropy_correction = terms.fold(0.0, |sum, (&a, &b)| sum + a * b);
            }
        }
        let update = self.scaled_update();
        self.apply::<C>(1.0, by_factors);
        update
    }

    /// The largest correction of a local unknown in its unit.
    #[inline]
    fn scaled_update(&self) -> f64 {
        let mut largest = 0.0;
        let unit = self.viscous_unit();
        for index in A::MEASURES..Self::TEMPERATURE {
            let scaled = self.correction[index] / unit;
            largest = Scalar::maximum(largest, scaled.abs());
        }
        if self.is_thermal() {
            let scaled = self.correction[Self::TEMPERATURE] / self.x[Self::TEMPERATURE];
            largest = Scalar::maximum(largest, scaled.abs());
        }
        largest
    }
}

impl<K: Kinematics<D>, const D: usize> Site<K, D> {
    /// The corrections of the arms.
    #[inline]
    pub(super) fn motion_in(&self, solution: &[[f64; 1]]) -> Arms<K, D> {
        let mut motion = Arms::<K, D>::filled([0.0; D]);
        let (rows, solution) = (self.rows.as_ref(), solution.as_flattened());
        let first: &[f64; D] = run(solution, rows[0] as usize);
        for (arm, &row) in motion.as_mut().iter_mut().zip(&rows[1..]) {
            let other: &[f64; D] = run(solution, row as usize);
            for axis in 0..D {
                arm[axis] = other[axis] - first[axis];
            }
        }
        motion
    }
}

impl<K: Kinematics<D>, const D: usize> Contact<K, D> {
    /// `Σ κ (δΘ_partner − δΘ)`, W.
    #[inline]
    pub(super) fn heat(&self, solution: &[[f64; 1]]) -> f64 {
        let own = solution[self.unknown as usize][0];
        self.paths.iter().fold(0.0, |sum, path| {
            sum + path.conductance * (solution[path.unknown as usize][0] - own)
        })
    }
}

//! From the solution of the global system to the internal variables of the elements.

use super::arms::along;
use super::member::Block;
use super::placed::PlacedPoint;
use super::point::Point;
use super::points::PointSet;
use super::share::{Contacts, run};
use super::site::{HeatContact, Site};
use crate::element::conjugates::Family;
use crate::element::kinematics::{Arms, Kinematics, MeasureSet, Numbers};
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;
use eem_material::number::scalar::Scalar;

impl<K: Kinematics<D>, P: ?Sized + PointSet<K::Measures>, const D: usize> Block<K, P, D> {
    /// Applies the corrections of the internal variables for a global solution; returns the largest in their units, or that of the blocks
    /// before.
    #[inline]
    pub(super) fn correct<C: Family>(
        &mut self,
        contacts: &Contacts<K, D>,
        solution: &[[f64; 1]],
        mut largest: f64,
    ) -> f64 {
        let mut index = 0;
        for member in &self.members {
            let motion = member.site.motion_in(solution);
            for point in member.points.as_ref() {
                let changes = PlacedPoint::<K, D>::rates_along(&point.sensitivity, &motion);
                let mut heat = 0.0;
                if !C::IS_EXACT
                    && let Some(by_increment) = &point.by_increment
                {
                    heat = along::<K, D>(by_increment, &motion);
                }
                let changes = (&changes, heat);
                let update = (self.points).correct(index, changes, &contacts.heat, solution);
                largest = Scalar::maximum(largest, update);
                index += 1;
            }
        }
        largest
    }
}

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// Applies the corrections of the local unknowns; returns the largest in their units.
    #[expect(
        clippy::inline_always,
        reason = "a call costs 1 % of a step of a spring"
    )]
    #[inline(always)]
    pub(super) fn correct<C: Family>(
        &mut self,
        (changes, by_motion): (&Numbers<Q>, f64),
        contact: Option<&HeatContact>,
        solution: &[[f64; 1]],
        by_factors: bool,
    ) -> f64 {
        let (mut heat, is_coupled) = (0.0, contact.is_some());
        if let Some(contact) = contact {
            heat = self.condensed.heat_factor * contact.heat(solution);
        }
        if !C::IS_EXACT {
            heat += by_motion;
        }
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

//! Responses of a point as functions of its measures and of the heat that it receives.

use super::eliminate::CondensedRow;
use super::point::Point;
use crate::element::conjugates::{Family, Form};
use crate::element::kinematics::{MeasureSet, Numbers};
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    #[inline]
    pub(super) fn condensed_row<C: Family>(
        &self,
        row: usize,
        (response, tangent): &Form<A>,
        is_coupled: bool,
    ) -> CondensedRow<Numbers<Q>> {
        let mut condensed = CondensedRow {
            value: response[row],
            by_measure: Numbers::<Q>::filled(0.0),
            by_heat: 0.0,
        };
        for a in 0..A::MEASURES {
            condensed.by_measure[a] = tangent[row][a];
        }
        for u in 0..Self::UNKNOWNS {
            if !self.own_unknowns().has::<A>(u) {
                continue;
            }
            let by_unknown = tangent[row][A::MEASURES + u];
            condensed.value -= by_unknown * self.condensed.constant.get(u);
            for a in 0..A::MEASURES {
                condensed.by_measure[a] -= by_unknown * self.condensed.by_measure[a].get(u);
            }
            if self.depends_on_heat::<C>(is_coupled) {
                condensed.by_heat += by_unknown * self.condensed.by_heat.get(u);
            }
        }
        condensed
    }
}

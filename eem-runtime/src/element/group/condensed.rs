//! Responses of a point as functions of its measures and of the heat that it receives.

use super::point::Point;
use crate::element::conjugates::{Family, Form};
use crate::element::kinematics::{MeasureSet, Numbers};
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;

/// A response with the internal variables eliminated: `value + Σ_a by_measure_a δπ_a − by_heat δr_s`.
pub(super) struct CondensedRow<Q: MeasureSet> {
    pub(super) value: f64,
    pub(super) by_measure: Numbers<Q>,
    pub(super) by_heat: f64,
}

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    #[inline]
    pub(super) fn condensed_row<C: Family>(
        &self,
        row: usize,
        (response, tangent): &Form<A>,
        is_coupled: bool,
    ) -> CondensedRow<Q> {
        let mut condensed = CondensedRow::<Q> {
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

//! Elimination of the local unknowns of an element: Gauss–Jordan with partial pivoting.

use crate::algebra::lu::Singular;
use crate::element::kinematics::MeasureSet;
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;
use eem_material::number::scalar::is_positive;
use eem_material::tabled::Tabled;

/// A number per local unknown: the viscous stretches, then the temperature.
#[derive(Clone, Copy, Debug)]
pub(super) struct PerUnknown<V> {
    viscous: V,
    temperature: f64,
}

impl<V: Array<f64>> PerUnknown<V> {
    pub(super) fn zero() -> Self {
        Self {
            viscous: V::filled(0.0),
            temperature: 0.0,
        }
    }

    #[inline]
    pub(super) fn get(&self, unknown: usize) -> f64 {
        if unknown < V::LEN {
            self.viscous[unknown]
        } else {
            self.temperature
        }
    }

    #[inline]
    pub(super) fn set(&mut self, unknown: usize, value: f64) {
        if unknown < V::LEN {
            self.viscous[unknown] = value;
        } else {
            self.temperature = value;
        }
    }
}

/// The solved local system: `δu = −(constant + by_measure δπ + by_heat δr_s)`.
pub(super) struct Condensed<A: Arrays, Q: MeasureSet> {
    pub(super) constant: PerUnknown<A::Viscosities>,
    pub(super) by_measure: Q::Per<PerUnknown<A::Viscosities>>,
    /// Only for elements whose heat depends on global unknowns other than through the measures.
    pub(super) by_heat: PerUnknown<A::Viscosities>,
    /// `∂r_s/∂Q = −h w/θ*`, by which heat from other elements enters.
    pub(super) heat_factor: f64,
}

impl<A: Arrays, Q: MeasureSet> Condensed<A, Q> {
    /// Before the first elimination.
    pub(super) fn zero() -> Self {
        Self {
            constant: PerUnknown::zero(),
            by_measure: Q::Per::filled(PerUnknown::zero()),
            by_heat: PerUnknown::zero(),
            heat_factor: 0.0,
        }
    }
}

/// A response with the internal variables eliminated: `value + Σ_a by_measure_a δπ_a − by_heat δr_s`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CondensedRow<V> {
    pub(super) value: f64,
    pub(super) by_measure: V,
    pub(super) by_heat: f64,
}

impl<V: Array<f64>> CondensedRow<V> {
    pub(super) fn none() -> Self {
        Self {
            value: 0.0,
            by_measure: V::filled(0.0),
            by_heat: 0.0,
        }
    }
}

/// The local equations of an element, a row per unknown. Arrays have an entry per variable, of which the first are
/// used.
pub(super) struct LocalSystem<A: Arrays> {
    /// r, and after the elimination the constant of the solution.
    pub(super) constant: A::Variables,
    /// `∂r/∂x`; the columns of the measures are right-hand sides, and after the elimination the solution.
    pub(super) rows: A::Hessian,
    /// `∂r/∂r_s`, if needed.
    pub(super) by_heat: A::Variables,
    /// Factors that turn rows into energies, in which pivots are compared: a length (m) for a dashpot (N), a
    /// temperature (K) for the heat balance (J/K).
    pub(super) unit: [f64; 2],
}

impl<A: Arrays> LocalSystem<A> {
    /// Without equations.
    #[inline]
    pub(super) fn empty(unit: [f64; 2]) -> Self {
        let zeros = A::Variables::filled(0.0);
        Self {
            constant: zeros,
            rows: A::Hessian::filled(zeros),
            by_heat: zeros,
            unit,
        }
    }
}

/// Which local unknowns a point has, of those that its type may have.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unknowns {
    dashpots: usize,
    is_thermal: bool,
}

impl Unknowns {
    #[inline]
    pub(super) fn of<A: Arrays>(model: &Tabled<A>) -> Self {
        Self {
            dashpots: model.dashpots(),
            is_thermal: model.is_thermal(),
        }
    }

    #[inline]
    pub(super) const fn has<A: Arrays>(self, unknown: usize) -> bool {
        unknown < self.dashpots || self.is_thermal && unknown >= A::DASHPOTS
    }
}

/// Gauss–Jordan elimination with partial pivoting.
#[expect(clippy::inline_always, reason = "a few numbers in registers")]
#[inline(always)]
pub(super) fn eliminate<A: Arrays, const HEAT: bool>(
    system: &mut LocalSystem<A>,
    own: Unknowns,
) -> Result<(), Singular> {
    let LocalSystem {
        constant,
        rows,
        by_heat,
        unit,
    } = system;
    let unknowns = A::Variables::LEN - A::MEASURES;
    let mut units = A::Variables::filled(unit[0]);
    if A::THERMAL {
        units[unknowns - 1] = unit[1];
    }
    for k in 0..unknowns {
        if !own.has::<A>(k) {
            continue;
        }
        let at = A::MEASURES + k;
        for row in k + 1..unknowns {
            if !own.has::<A>(row) {
                continue;
            }
            let size = |row: usize| (units[row] * rows[row][at]).abs();
            if size(k) < size(row) {
                units.as_mut().swap(row, k);
                rows.as_mut().swap(row, k);
                constant.as_mut().swap(row, k);
                by_heat.as_mut().swap(row, k);
            }
        }
        let value = rows[k][at];
        if !is_positive(value.abs()) {
            return Err(Singular);
        }
        let inverse = value.recip();
        // The columns of the measures and of the unknowns not yet eliminated.
        let columns = |column: &usize| *column < A::MEASURES || *column > at;
        for column in (0..A::Variables::LEN).filter(columns) {
            rows[k][column] *= inverse;
        }
        constant[k] *= inverse;
        if HEAT {
            by_heat[k] *= inverse;
        }
        for row in (0..unknowns).filter(|&row| row != k) {
            if !own.has::<A>(row) {
                continue;
            }
            let factor = rows[row][at];
            for column in (0..A::Variables::LEN).filter(columns) {
                let pivot = rows[k][column];
                rows[row][column] -= factor * pivot;
            }
            let (own, heat) = (constant[k], by_heat[k]);
            constant[row] -= factor * own;
            if HEAT {
                by_heat[row] -= factor * heat;
            }
        }
    }
    Ok(())
}

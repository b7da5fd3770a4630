//! What a step remembers of the dashpot beside a spring; see [`kelvin_voigt`](super::kelvin_voigt).

/// The dashpot beside a spring at a trial; `A` has an entry if there is one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drag<A> {
    /// η at θ*, and dη/dθ.
    pub(super) viscosity: (A, A),
    /// `Δλ`, m.
    pub(super) extension: A,
    /// `f_d`, N.
    pub(super) force: A,
}

impl<A: Copy> Drag<A> {
    /// Before the first step, with zeros everywhere.
    pub(super) fn zero(zeros: A) -> Self {
        Self {
            viscosity: (zeros, zeros),
            extension: zeros,
            force: zeros,
        }
    }
}

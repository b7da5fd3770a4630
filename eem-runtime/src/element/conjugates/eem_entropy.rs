//! The energy–entropy–momentum scheme in entropy form.
//!
//! ```text
//! f* = D_λ e,  g* = −D_γ e,  θ* = D_s e      of e(λ, γ, s) = ψ + θ̂ s,  θ̂(λ, γ, s): S(λ, γ, θ̂) = s
//! ```
//!
//! with the symmetrised partitioned discrete derivatives of García Orden & Romero (2012), eq. (28).
//! The sum `f*Δλ − g*Δγ + θ*Δs` is `Δe` exactly, hence the first law; `θ*` is a mean
//! temperature, hence positive, hence the second.
//!
//! The local unknown is the new temperature. The temperatures of the mixed states on the way from
//! old to new come from the Legendre inversion θ̂, by Newton's method, for any free energy.

use crate::element::conjugates::element::{ElementScheme, Form, Infeasible, Placement, Start};
use crate::element::conjugates::temperature::{LAST_CORRECTION, temperature_of};
use core::array;
use eem_material::free_energy::{Array, Entry, FormRows, FreeEnergy, Material};
use eem_material::number::scalar::{Mask, Real, unless};

/// The largest first correction of ln θ with which Newton's method continues, and the factor by which corrections have to
/// shrink; otherwise a safeguarded search finds the temperatures one by one.
const LARGEST_FIRST: f64 = 0.0625;
const SHRINKING: f64 = 0.25;

/// The elements whose mixed states are sought together, with materials that have rows.
const TOGETHER: usize = 32;

/// See the module.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EemEntropy;

impl<S: Real, M: Material<S>> ElementScheme<S, M> for EemEntropy {
    const EXACT: bool = true;
    const ROWS: Option<FormRows<S, M, Self::Old, Self::Memory>> = match M::ROWS {
        Some(rows) => Some(rows.entropy_form),
        None => None,
    };

    type Old = M::EntropyFormOld;
    /// Corner temperatures.
    type Memory = M::Corners;
    type AtPoint<T: Entry> = [T; 0];
    type Damping<T: Entry> = [T; 0];

    #[inline]
    fn placement(self) -> Placement {
        Placement::Ends
    }

    #[inline]
    fn old(model: &M, x0: &M::Variables, _: S) -> Self::Old {
        model.entropy_form_old(x0)
    }

    fn memory(theta0: S) -> Self::Memory {
        M::Corners::filled(theta0)
    }

    #[inline]
    fn prepare(
        model: &M,
        start: &Start<S, M, Self::Old>,
        x: &M::Variables,
        corners: &mut Self::Memory,
    ) -> Result<(), Infeasible> {
        if M::THERMAL {
            find_corners((model, start, x), corners)?;
        }
        Ok(())
    }

    fn prepare_rows<'a>(
        each: impl Fn(usize) -> Step<'a, S, M>,
        memories: &mut [Self::Memory],
    ) -> Result<(), Infeasible> {
        if M::THERMAL {
            find_corners_of_each(each, memories)?;
        }
        Ok(())
    }

    #[inline]
    fn form(
        self,
        model: &M,
        start: &Start<S, M, Self::Old>,
        x: &M::Variables,
        corners: &Self::Memory,
    ) -> Form<S, M> {
        model.entropy_form(&start.old, x, corners)
    }

    /// The temperature form, which has no mixed states: with a small heat capacity their temperatures
    /// overflow away from the solution.
    #[cold]
    #[inline(never)]
    fn starting_form(
        model: &M,
        start: &Start<S, M, Self::Old>,
        x: &M::Variables,
    ) -> Option<Form<S, M>> {
        let old = model.temperature_form_old(&start.x0);
        Some(model.temperature_form(&old, x))
    }

    #[inline]
    fn response(
        self,
        model: &M,
        start: &Start<S, M, Self::Old>,
        x: &M::Variables,
        corners: &Self::Memory,
    ) -> M::Response {
        model.entropy_form_response(&start.old, x, corners)
    }

    /// With old and new state exchanged, the ascending chain is the descending one.
    #[cfg(feature = "gradients")]
    #[inline]
    fn exchanged(corners: &Self::Memory) -> Self::Memory {
        let mut exchanged = *corners;
        exchanged.as_mut().rotate_left(M::Corners::LEN / 2);
        exchanged
    }

    #[cfg(feature = "gradients")]
    fn form_adjoint(
        self,
        model: &M,
        [x0, x1]: [&M::Variables; 2],
        corners: &Self::Memory,
        weights: &M::Response,
    ) -> M::Parameters {
        model.entropy_form_adjoint(x0, x1, corners, weights)
    }

    #[cfg(feature = "gradients")]
    fn form_tangent(
        self,
        model: &M,
        [x0, x1]: [&M::Variables; 2],
        corners: &Self::Memory,
        direction: &M::Parameters,
    ) -> M::Response {
        model.entropy_form_tangent(x0, x1, corners, direction)
    }
}

/// A model, the data of the old state, and the new variables.
type Step<'a, S, M> = (
    &'a M,
    &'a Start<S, M, <M as FreeEnergy<S>>::EntropyFormOld>,
    &'a <M as FreeEnergy<S>>::Variables,
);

/// Finds the temperatures of all mixed states of an element, from those of the last trial.
#[inline]
fn find_corners<S: Real, M: FreeEnergy<S>>(
    step: Step<'_, S, M>,
    corners: &mut M::Corners,
) -> Result<(), Infeasible> {
    let (model, start, x1) = step;
    let mut search = Search::<S, M>::new(corners);
    while !search.settled.all() {
        let mixed = model.mixed_states(&start.x0, &start.old, x1, corners);
        search.correct(step, &mixed, corners)?;
    }
    Ok(())
}

/// The same of several elements, whose mixed states are evaluated in one call, with the same bits.
fn find_corners_of_each<'a, S: Real, M: Material<S>>(
    each: impl Fn(usize) -> Step<'a, S, M>,
    corners: &mut [M::Corners],
) -> Result<(), Infeasible> {
    let Some(rows) = M::ROWS else {
        let mut all = corners.iter_mut().enumerate();
        return all.try_for_each(|(element, corners)| find_corners(each(element), corners));
    };
    for (part, corners) in corners.chunks_mut(TOGETHER).enumerate() {
        let each = |index: usize| each(part * TOGETHER + index);
        let count = corners.len();
        let mut searches: [_; TOGETHER] =
            array::from_fn(|index| Search::<S, M>::new(&corners[index % count]));
        let searches = &mut searches[..count];
        let mut mixed = [[corners[0]; 2]; TOGETHER];
        let mixed = &mut mixed[..count];
        while !searches.iter().all(|search| search.settled.all()) {
            let step = |index: usize| {
                let (model, start, x1) = each(index);
                (model, &start.old, x1, &corners[index])
            };
            (rows.mixed_states)(&step, mixed);
            let found = searches.iter_mut().zip(&*mixed).zip(&mut *corners);
            for (index, ((search, mixed), corners)) in found.enumerate() {
                if !search.settled.all() {
                    search.correct(each(index), mixed, corners)?;
                }
            }
        }
    }
    Ok(())
}

/// Newton's method in ln θ for the temperatures of the mixed states of an element.
struct Search<S: Real, M: FreeEnergy<S>> {
    guesses: M::Corners,
    /// The largest correction with which Newton's method continues.
    limit: S,
    /// Lanes that have converged.
    settled: S::Mask,
}

impl<S: Real, M: FreeEnergy<S>> Search<S, M> {
    #[inline]
    fn new(guesses: &M::Corners) -> Self {
        Self {
            guesses: *guesses,
            limit: S::from_f64(LARGEST_FIRST),
            settled: S::Mask::none(),
        }
    }

    /// One correction, from the [mixed states](FreeEnergy::mixed_states) at the present temperatures.
    #[inline]
    fn correct(
        &mut self,
        (model, start, x1): Step<'_, S, M>,
        [excess, capacities]: &[M::Corners; 2],
        corners: &mut M::Corners,
    ) -> Result<(), Infeasible> {
        let root = S::EPSILON.sqrt();
        // S(ln θ) is linear where the capacity is constant, so that only the series of e^x is left.
        let enough = if model.has_constant_capacity() {
            root.sqrt()
        } else {
            S::from_f64(LAST_CORRECTION) * root
        };
        let settled = self.settled;
        let mut found = *corners;
        let (mut largest, mut sum, mut least) = (S::zero(), S::zero(), S::MAX);
        for index in 0..M::Corners::LEN {
            let correction = -excess[index] / capacities[index];
            let size = correction.abs();
            // The sum keeps a NaN; a comparison loses it.
            sum += size;
            largest = S::select(largest.less(size), size, largest);
            least = S::select(capacities[index].less(least), capacities[index], least);
            found[index] = corners[index] + corners[index] * growth(correction);
        }
        let size = largest + S::zero() * sum;
        let is_far = !(settled | (size.at_most(self.limit) & S::zero().less(least)));
        if is_far.any() {
            let sought = search_corners(model, start, x1, self.guesses)?;
            for index in 0..M::Corners::LEN {
                found[index] = S::select(is_far, sought[index], found[index]);
            }
        }
        for index in 0..M::Corners::LEN {
            corners[index] = unless(settled, corners[index], found[index]);
        }
        self.settled = settled | size.at_most(enough) | is_far;
        self.limit = S::from_f64(SHRINKING) * size;
        Ok(())
    }
}

/// `e^x − 1` up to `x⁵/120`.
#[inline]
fn growth<S: Real>(x: S) -> S {
    let [half, third, quarter] = [0.5, 1.0 / 6.0, 1.0 / 24.0].map(S::from_f64);
    let square = x * x;
    (x + half * square) + (x * square) * (third + quarter * x)
}

/// Searches the temperatures one by one, alternately in two chains: the ascending one, where the first k variables are new
/// and the entropy is old, and the descending one, where they are old and the entropy is new.
///
/// A trial beyond a spinodal is refused, so that all corners lie on the stable branch.
#[cold]
#[inline(never)]
fn search_corners<S: Real, M: FreeEnergy<S>>(
    model: &M,
    start: &Start<S, M, M::EntropyFormOld>,
    x1: &M::Variables,
    mut corners: M::Corners,
) -> Result<M::Corners, Infeasible> {
    let steps = M::Corners::LEN / 2;
    let [old, new] = [&start.x0, x1].map(|x| model.caloric(x));
    Infeasible::unless_stable(new.heat_capacity, x1[M::Variables::LEN - 1])?;
    for k in 1..=steps {
        for (first, ends, entropy) in [
            (0, [&start.x0, x1], old.entropy),
            (steps, [x1, &start.x0], new.entropy),
        ] {
            let mixed = model.caloric_between(ends[0], ends[1], k);
            let corner = &mut corners[first + k - 1];
            *corner = temperature_of(&mixed, entropy, *corner)?;
        }
    }
    Ok(corners)
}

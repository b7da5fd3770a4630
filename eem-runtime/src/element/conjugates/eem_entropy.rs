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

/// The largest first correction of ln θ with which Newton's method continues, and the factor by which corrections have to
/// shrink; otherwise a safeguarded search finds the temperatures one by one.
const LARGEST_FIRST: f64 = 0.0625;
const SHRINKING: f64 = 0.25;

/// The elements whose mixed states are sought together, with materials that have rows.
const TOGETHER: usize = 32;

/// See the module.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EemEntropy;

impl<M: Material> ElementScheme<M> for EemEntropy {
    const EXACT: bool = true;
    const ROWS: Option<FormRows<f64, M, Self::Old, Self::Memory>> = match M::ROWS {
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
    fn old(model: &M, x0: &M::Variables, _: f64) -> Self::Old {
        model.entropy_form_old(x0)
    }

    fn memory(theta0: f64) -> Self::Memory {
        M::Corners::filled(theta0)
    }

    #[inline]
    fn prepare(
        model: &M,
        start: &Start<M, Self::Old>,
        x: &M::Variables,
        corners: &mut Self::Memory,
    ) -> Result<(), Infeasible> {
        if M::THERMAL {
            find_corners((model, start, x), corners)?;
        }
        Ok(())
    }

    fn prepare_rows<'a>(
        each: impl Fn(usize) -> Step<'a, M>,
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
        start: &Start<M, Self::Old>,
        x: &M::Variables,
        corners: &Self::Memory,
    ) -> Form<f64, M> {
        model.entropy_form(&start.old, x, corners)
    }

    /// The temperature form, which has no mixed states: with a small heat capacity their temperatures
    /// overflow away from the solution.
    #[cold]
    #[inline(never)]
    fn starting_form(
        model: &M,
        start: &Start<M, Self::Old>,
        x: &M::Variables,
    ) -> Option<Form<f64, M>> {
        let old = model.temperature_form_old(&start.x0);
        Some(model.temperature_form(&old, x))
    }

    #[inline]
    fn response(
        self,
        model: &M,
        start: &Start<M, Self::Old>,
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
type Step<'a, M> = (
    &'a M,
    &'a Start<M, <M as FreeEnergy<f64>>::EntropyFormOld>,
    &'a <M as FreeEnergy<f64>>::Variables,
);

/// Finds the temperatures of all mixed states of an element, from those of the last trial.
#[inline]
fn find_corners<M: FreeEnergy<f64>>(
    step: Step<'_, M>,
    corners: &mut M::Corners,
) -> Result<(), Infeasible> {
    let (model, start, x1) = step;
    let mut search = Search::<M>::new(corners);
    while !search.settled {
        let mixed = model.mixed_states(&start.x0, &start.old, x1, corners);
        search.correct(step, &mixed, corners)?;
    }
    Ok(())
}

/// The same of several elements, whose mixed states are evaluated in one call, with the same bits.
fn find_corners_of_each<'a, M: Material>(
    each: impl Fn(usize) -> Step<'a, M>,
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
            array::from_fn(|index| Search::<M>::new(&corners[index % count]));
        let searches = &mut searches[..count];
        let mut mixed = [[corners[0]; 2]; TOGETHER];
        let mixed = &mut mixed[..count];
        while !searches.iter().all(|search| search.settled) {
            let step = |index: usize| {
                let (model, start, x1) = each(index);
                (model, &start.old, x1, &corners[index])
            };
            (rows.mixed_states)(&step, mixed);
            let found = searches.iter_mut().zip(&*mixed).zip(&mut *corners);
            for (index, ((search, mixed), corners)) in found.enumerate() {
                if !search.settled {
                    search.correct(each(index), mixed, corners)?;
                }
            }
        }
    }
    Ok(())
}

/// Newton's method in ln θ for the temperatures of the mixed states of an element.
struct Search<M: FreeEnergy<f64>> {
    guesses: M::Corners,
    /// The largest correction with which Newton's method continues.
    limit: f64,
    /// Whether it has converged.
    settled: bool,
}

impl<M: FreeEnergy<f64>> Search<M> {
    #[inline]
    fn new(guesses: &M::Corners) -> Self {
        Self {
            guesses: *guesses,
            limit: LARGEST_FIRST,
            settled: false,
        }
    }

    /// One correction, from the [mixed states](FreeEnergy::mixed_states) at the present temperatures.
    #[inline]
    fn correct(
        &mut self,
        (model, start, x1): Step<'_, M>,
        [excess, capacities]: &[M::Corners; 2],
        corners: &mut M::Corners,
    ) -> Result<(), Infeasible> {
        let root = f64::EPSILON.sqrt();
        // S(ln θ) is linear where the capacity is constant, so that only the series of e^x is left.
        let enough = if model.has_constant_capacity() {
            root.sqrt()
        } else {
            LAST_CORRECTION * root
        };
        let mut found = *corners;
        let (mut largest, mut sum, mut least) = (0.0, 0.0, f64::MAX);
        for index in 0..M::Corners::LEN {
            let correction = -excess[index] / capacities[index];
            let size = correction.abs();
            // The sum keeps a NaN; a comparison loses it.
            sum += size;
            if largest < size {
                largest = size;
            }
            if capacities[index] < least {
                least = capacities[index];
            }
            found[index] = corners[index] + corners[index] * growth(correction);
        }
        let size = largest + 0.0 * sum;
        let is_far = !(size <= self.limit && least > 0.0);
        if is_far {
            found = search_corners(model, start, x1, self.guesses)?;
        }
        *corners = found;
        self.settled = size <= enough || is_far;
        self.limit = SHRINKING * size;
        Ok(())
    }
}

/// `e^x − 1` up to `x⁵/120`.
#[inline]
fn growth(x: f64) -> f64 {
    let [third, quarter] = [1.0 / 6.0, 1.0 / 24.0];
    let square = x * x;
    (x + 0.5 * square) + (x * square) * (third + quarter * x)
}

/// Searches the temperatures one by one, alternately in two chains: the ascending one, where the first k variables are new
/// and the entropy is old, and the descending one, where they are old and the entropy is new.
///
/// A trial beyond a spinodal is refused, so that all corners lie on the stable branch.
#[cold]
#[inline(never)]
fn search_corners<M: FreeEnergy<f64>>(
    model: &M,
    start: &Start<M, M::EntropyFormOld>,
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

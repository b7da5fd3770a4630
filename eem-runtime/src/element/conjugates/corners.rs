//! Temperatures of the mixed states of the entropy form, on the way from the old state to the new one.
//!
//! They come from the Legendre inversion `S(λ, γ, θ̂) = s` by Newton's method, for any free energy.

use crate::element::conjugates::infeasible::Infeasible;
use crate::element::conjugates::temperature::{LAST_CORRECTION, temperature_of};
use eem_material::arrays::Arrays;
use eem_material::formulas::TogetherIn;
use eem_material::free_energy::{Array, MOST_TOGETHER, Steps};
use eem_material::tabled::Tabled;

/// The largest first correction of ln θ with which Newton's method continues, and the factor by which corrections have to
/// shrink; otherwise a safeguarded search finds the temperatures one by one.
const LARGEST_FIRST: f64 = 0.0625;
const SHRINKING: f64 = 0.25;

/// A model, and the variables of both ends of its step.
type Ends<'a, A> = (&'a Tabled<A>, [&'a <A as Arrays>::Variables; 2]);

/// Finds the temperatures of all mixed states of an element, from those of the last trial.
#[inline]
pub(super) fn find_corners<A: Arrays>(
    (model, [x0, x1]): Ends<'_, A>,
    old: &A::Kept,
    corners: &mut A::Corners,
) -> Result<(), Infeasible> {
    let mut search = Search::<A>::new(corners);
    while !search.settled {
        let mixed = model.mixed_states(x0, old, x1, corners);
        search.correct((model, [x0, x1]), &mixed, corners)?;
    }
    Ok(())
}

/// The same of several elements, whose mixed states are evaluated in one call, with the same bits.
pub(crate) fn find_corners_together<'a, A: Arrays>(
    together: &TogetherIn<A>,
    each: impl Fn(usize) -> Ends<'a, A>,
    (kept, x1): (&[&[f64]], &[A::Variables]),
    corners: &mut [A::Corners],
) -> Result<(), Infeasible> {
    let count = corners.len();
    let mut searches = [Search::<A>::new(&corners[0]); MOST_TOGETHER];
    let searches = &mut searches[..count];
    for (search, corners) in searches.iter_mut().zip(&*corners) {
        *search = Search::new(corners);
    }
    let mut mixed = [[corners[0]; 2]; MOST_TOGETHER];
    let mixed = &mut mixed[..count];
    while !searches.iter().all(|search| search.settled) {
        let steps = Steps {
            kept,
            x1,
            corners: &*corners,
        };
        together.mixed_states(steps, mixed);
        let found = searches.iter_mut().zip(&*mixed).zip(&mut *corners);
        for (index, ((search, mixed), corners)) in found.enumerate() {
            if !search.settled {
                search.correct(each(index), mixed, corners)?;
            }
        }
    }
    Ok(())
}

/// Newton's method in ln θ for the temperatures of the mixed states of an element.
#[derive(Clone, Copy)]
struct Search<A: Arrays> {
    guesses: A::Corners,
    /// The largest correction with which Newton's method continues.
    limit: f64,
    /// Whether it has converged.
    settled: bool,
}

impl<A: Arrays> Search<A> {
    #[inline]
    fn new(guesses: &A::Corners) -> Self {
        Self {
            guesses: *guesses,
            limit: LARGEST_FIRST,
            settled: false,
        }
    }

    /// One correction, from the [mixed states](eem_material::FreeEnergy::mixed_states) at the present temperatures.
    #[inline]
    fn correct(
        &mut self,
        (model, ends): Ends<'_, A>,
        [excess, capacities]: &[A::Corners; 2],
        corners: &mut A::Corners,
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
        for index in 0..A::Corners::LEN {
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
            found = search_corners(model, ends, self.guesses)?;
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
fn search_corners<A: Arrays>(
    model: &Tabled<A>,
    [x0, x1]: [&A::Variables; 2],
    mut corners: A::Corners,
) -> Result<A::Corners, Infeasible> {
    let steps = A::Corners::LEN / 2;
    let (old, new) = (model.caloric(x0), model.caloric(x1));
    Infeasible::unless_stable(new.heat_capacity, x1[A::Variables::LEN - 1])?;
    for k in 1..=steps {
        for (first, ends, entropy) in [(0, [x0, x1], old.entropy), (steps, [x1, x0], new.entropy)] {
            let mixed = |theta: f64| model.caloric_between(ends, k, theta);
            let corner = &mut corners[first + k - 1];
            *corner = temperature_of(&mixed, entropy, *corner)?;
        }
    }
    Ok(corners)
}

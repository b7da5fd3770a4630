//! Errors at the end of random scenes, in units of the tolerance that their steps were controlled by.

use eem::EndState;
use eem::prelude::*;
use eem_testkit::length::at_length;
use eem_testkit::scenes::largest_error;

use super::drawing::{Class, Drawing};
use super::random::Random;

/// The tolerance, and that of the references.
const TOLERANCE: f64 = 1e-6;
const EXACT: f64 = 1e-12;

/// The time, in smallest periods of the linearised scene.
const PERIODS: f64 = 5.0;

/// A tenth of the scenes may have errors beyond so many tolerances.
const MOST: f64 = 5.0;

/// The errors of schemes at the end of a random scene, in units of the tolerance.
fn errors<const N: usize>(index: u64, schemes: [Scheme; N]) -> [f64; N] {
    let mut random = Random::new(index);
    let drawing = Drawing::<2>::at_random(&mut random, Class::Ordinary, 5);
    let end = PERIODS * drawing.smallest_period();
    let run = |scheme, tolerance| {
        let mut run = drawing.world().start(scheme, 0.01 * end).unwrap().run;
        run.control_steps(tolerance).unwrap();
        assert_eq!(run.run_until(end), Ok(()), "scene {index}");
        EndState::of(&run)
    };
    let exact = run(Scheme::EemExplicit, Tolerance::new(EXACT));
    schemes.map(|scheme| {
        let own = run(scheme, Tolerance::new(TOLERANCE).over(end));
        largest_error(&own, &exact) / TOLERANCE
    })
}

#[test]
fn errors_at_the_end_of_random_scenes_are_at_most_some_tolerances() {
    let schemes = [Scheme::EemExplicit, Scheme::EemEntropy6];
    let scenes = at_length(100, 20);
    let all: Vec<_> = (0..scenes).map(|index| errors(index, schemes)).collect();
    for (place, scheme) in schemes.into_iter().enumerate() {
        let mut own: Vec<f64> = all.iter().map(|errors| errors[place]).collect();
        own.sort_by(f64::total_cmp);
        let tenth = own[own.len() - 1 - own.len() / 10];
        assert!(tenth <= MOST, "{scheme}: {own:?}");
        // Tolerances are not far too strict either.
        assert!(own[own.len() / 2] > 0.01, "{scheme}: {own:?}");
    }
}

//! What is seen of members in lanes has the bits of what is seen of them one by one.

use core::slice;

use eem::MemberError;
use eem::prelude::*;

use super::scenes::{Double, Pendulum};
use super::watched::{Case, Input, Seen, Watched};

/// The schemes with one set of forces per step, and the explicit one.
pub(crate) const SCHEMES: [Scheme; 10] = [
    Scheme::EemEntropy,
    Scheme::EemTemperature,
    Scheme::EemDamped,
    Scheme::Variational,
    Scheme::Staggered,
    Scheme::Midpoint,
    Scheme::MidpointTemperature,
    Scheme::Trapezoidal,
    Scheme::TrapezoidalTemperature,
    Scheme::EemExplicit,
];

/// Members that move together.
const LANES: usize = if cfg!(feature = "lanes") { 4 } else { 1 };

/// An ensemble on one thread.
pub(crate) fn ensemble<'w>(scheme: Scheme, step: f64) -> Ensemble<'w> {
    Ensemble::new(scheme, step).threads(1)
}

/// What is seen of members that know nothing of each other.
pub(crate) fn one_by_one<const D: usize, C: Case<D>>(
    experiment: &Watched<C>,
    (scheme, step): (Scheme, f64),
    inputs: &[Input],
) -> Vec<Result<Seen, MemberError>> {
    let one = |input| ensemble(scheme, step).run_experiment(experiment, slice::from_ref(input));
    inputs.iter().flat_map(one).collect()
}

/// Asserts that all members move together and see what they see alone; the sums of their iterations
/// alone.
pub(crate) fn check<const D: usize, C: Case<D>>(
    case: C,
    (scheme, step, steps): (Scheme, f64, usize),
    inputs: &[Input],
) -> Vec<usize> {
    let experiment = Watched::new(case, steps);
    let expected = one_by_one(&experiment, (scheme, step), inputs);
    let [_, alone] = experiment.counts();
    assert_eq!(alone, inputs.len());
    let found = ensemble(scheme, step).run_experiment(&experiment, inputs);
    let [together, still_alone] = experiment.counts();
    if cfg!(feature = "lanes") {
        // Two or three that are left over have company too, one has not.
        let rest = inputs.len() % LANES;
        let bundles = inputs.len() / LANES + usize::from(rest > 1);
        let expected = [bundles, alone + usize::from(rest == 1)];
        assert_eq!([together, still_alone], expected, "{scheme:?}");
    }
    let mut iterations = Vec::new();
    for (found, expected) in found.iter().zip(expected) {
        let (found, expected) = (found.as_ref().unwrap(), expected.unwrap());
        assert!(found.bits == expected.bits, "{scheme:?}");
        iterations.push(expected.iterations);
    }
    for (found, alone) in found.chunks(LANES).zip(iterations.chunks(LANES)) {
        let most = *alone.iter().max().unwrap();
        assert!(found[0].as_ref().unwrap().iterations >= most, "{scheme:?}");
    }
    iterations
}

/// Eight members, and one that is left over.
pub(crate) fn inputs(of: impl Fn(f64) -> Input) -> Vec<Input> {
    (0..9).map(|member| of(f64::from(member))).collect()
}

#[test]
fn pendulums_with_dashpots_have_the_bits_of_one_by_one() {
    let inputs = inputs(|i| [0.8 + 0.05 * i, 350.0 + 4.0 * i, 2.0 * i]);
    for scheme in SCHEMES {
        check(Pendulum, (scheme, 0.02, 100), &inputs);
    }
}

#[test]
fn conducting_double_pendulums_have_the_bits_of_one_by_one() {
    let inputs = inputs(|i| [10.0 + 0.1 * i, 290.0 + 5.0 * i, 100.0 * i]);
    for scheme in SCHEMES {
        check(Double, (scheme, 0.05, 60), &inputs);
    }
}

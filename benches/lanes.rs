//! Whether packed numbers pay: the generated functions on lanes of four and eight, beside single
//! numbers; see `README.md`.

#![allow(clippy::unwrap_used, reason = "a benchmark fails by panicking")]

#[path = "lanes/packed.rs"]
mod packed;
#[path = "lanes/pendulum.rs"]
mod pendulum;
use divan::{Bencher, black_box};
use eem::__private::Scalar;
use eem::{FreeEnergy, Scheme, invert};
use eem_testkit::scenes::{ThermoViscoElastic, single_pendulum};
use packed::{Eight, Four, FourByLibrary};
use pendulum::{Law, State};

/// Every line is the work for so many elements, whatever the lanes.
const ELEMENTS: usize = 8;
/// Calls per sample: 2000 times the 20 ns that a clock resolves.
const CALLS: u32 = 100;
/// Calls in a chain, as many as Newton's method makes in a step.
const CHAIN: usize = 4;

const LAW: ThermoViscoElastic = ThermoViscoElastic::PENDULUM;

fn main() {
    divan::main();
}

/// A number for one element, or for several.
trait Bundle: Scalar {
    const LANES: usize;
    /// Packs as many numbers as there are lanes.
    fn pack(numbers: impl Fn(usize) -> f64) -> Self;
    /// Whether no lane exceeds the bound, or is not a number.
    fn all_below(self, bound: f64) -> bool;
}

impl Bundle for f64 {
    const LANES: usize = 1;
    fn pack(numbers: impl Fn(usize) -> f64) -> Self {
        numbers(0)
    }
    fn all_below(self, bound: f64) -> bool {
        self <= bound
    }
}

macro_rules! bundles {
    ($($name:ident),*) => {
        $(
            impl Bundle for $name {
                const LANES: usize = Self::LANES;
                fn pack(numbers: impl Fn(usize) -> f64) -> Self {
                    Self::new(core::array::from_fn(numbers))
                }
                fn all_below(self, bound: f64) -> bool {
                    self.lanes().iter().all(|lane| *lane <= bound)
                }
            }
        )*
    };
}
bundles!(Four, FourByLibrary, Eight);

/// Old and new (λ, γ, θ) and the corner temperatures of an element.
struct Step {
    old: [f64; 3],
    new: [f64; 3],
    corners: [f64; 4],
}

impl Step {
    /// About as far apart as a step of the pendulum takes them, and different for every element.
    fn of(element: usize) -> Self {
        let shift = 0.01 * f64::from(u32::try_from(element).unwrap());
        let old = [3.0 + shift, 0.2 - shift, 380.0 + shift];
        let new = [old[0] - 0.05, old[1] + 0.01 + shift, old[2] - 0.2 + shift];
        let corner = |first: [f64; 3], rest: [f64; 3], k: usize| {
            let mut x = rest;
            x[..k].copy_from_slice(&first[..k]);
            let entropy = LAW.caloric(&rest).entropy;
            let evaluate = |theta| LAW.caloric(&[x[0], x[1], theta]);
            invert(evaluate, entropy, rest[2]).unwrap().temperature
        };
        let corners = [
            corner(new, old, 1),
            corner(new, old, 2),
            corner(old, new, 1),
            corner(old, new, 2),
        ];
        Self { old, new, corners }
    }
}

/// The elements, packed.
struct Inputs<S> {
    old: Vec<[S; 3]>,
    new: Vec<[S; 3]>,
    corners: Vec<[S; 4]>,
}

impl<S: Bundle> Inputs<S> {
    fn new() -> Self {
        let steps: Vec<Step> = (0..ELEMENTS).map(Step::of).collect();
        let bundles = steps.chunks(S::LANES);
        let mut inputs = Self {
            old: Vec::new(),
            new: Vec::new(),
            corners: Vec::new(),
        };
        for bundle in bundles {
            let at = |i: usize| S::pack(|lane| bundle[lane].old[i]);
            inputs.old.push(core::array::from_fn(at));
            let at = |i: usize| S::pack(|lane| bundle[lane].new[i]);
            inputs.new.push(core::array::from_fn(at));
            let at = |i: usize| S::pack(|lane| bundle[lane].corners[i]);
            inputs.corners.push(core::array::from_fn(at));
        }
        inputs
    }
}

/// Single calls, which the processor may overlap.
#[divan::bench(types = [f64, FourByLibrary, Four, Eight], sample_size = CALLS)]
fn temperature_form<S: Bundle>(bencher: Bencher<'_, '_>)
where
    ThermoViscoElastic: FreeEnergy<S, Variables = [S; 3]>,
{
    let Inputs { old, new, .. } = Inputs::<S>::new();
    let old: Vec<_> = old.iter().map(|x0| LAW.temperature_form_old(x0)).collect();
    bencher.bench_local(|| {
        for (old, new) in old.iter().zip(&new) {
            black_box(black_box(&LAW).temperature_form(black_box(old), black_box(new)));
        }
    });
}

/// The same for the entropy form, whose corner temperatures are given.
#[divan::bench(types = [f64, FourByLibrary, Four, Eight], sample_size = CALLS)]
fn entropy_form<S: Bundle>(bencher: Bencher<'_, '_>)
where
    ThermoViscoElastic: FreeEnergy<S, Variables = [S; 3], Corners = [S; 4]>,
{
    let inputs = Inputs::<S>::new();
    let old = inputs.old.iter();
    let old: Vec<_> = old.map(|x0| LAW.entropy_form_old(x0)).collect();
    bencher.bench_local(|| {
        for ((old, new), corners) in old.iter().zip(&inputs.new).zip(&inputs.corners) {
            let law = black_box(&LAW);
            black_box(law.entropy_form(black_box(old), black_box(new), black_box(corners)));
        }
    });
}

/// The call moves the state at which the next one is made, as in Newton's method, so that a single
/// element cannot keep the processor busy and lanes gain more.
#[divan::bench(types = [f64, FourByLibrary, Four, Eight], sample_size = CALLS)]
fn temperature_form_chain<S: Bundle>(bencher: Bencher<'_, '_>)
where
    ThermoViscoElastic: FreeEnergy<S, Variables = [S; 3]>,
{
    let Inputs { old, new, .. } = Inputs::<S>::new();
    let old: Vec<_> = old.iter().map(|x0| LAW.temperature_form_old(x0)).collect();
    // Far below the increments of the step.
    let little = S::from_f64(1e-9);
    bencher.bench_local(|| {
        for (old, new) in old.iter().zip(&new) {
            let mut x = *black_box(new);
            for _ in 0..CHAIN {
                let (response, _) = black_box(&LAW).temperature_form(black_box(old), &x);
                let response: &[S] = response.as_ref();
                for (x, &force) in x.iter_mut().zip(response) {
                    *x += little * force;
                }
            }
            black_box(x);
        }
    });
}

/// Steps of a pendulum: the published run.
const STEPS: usize = 100;

/// How far two codes may differ in the temperature after the run, relative to it: both leave of
/// Newton's method the square of 1e-8, and rounding grows over 100 steps.
const AGREEMENT: f64 = 1e-10;

/// The whole run of eight pendulums, started at different speeds, by a stepper that is written out
/// for lanes: what lanes could give at most.
#[divan::bench(types = [f64, FourByLibrary, Four, Eight], sample_size = 1, sample_count = 500)]
fn pendulums<S: Bundle>(bencher: Bencher<'_, '_>)
where
    ThermoViscoElastic: Law<S>,
{
    // The first one starts at the published 1 m/s.
    let speed = |element: usize| 1.0 + 0.05 * f64::from(u32::try_from(element).unwrap());
    let bundles = 0..ELEMENTS / S::LANES;
    let pack = |bundle: usize| S::pack(|lane| speed(bundle * S::LANES + lane));
    let speeds: Vec<S> = bundles.map(pack).collect();
    let run = |speed: S| {
        let mut state = State::start(speed);
        for _ in 0..STEPS {
            state.step();
        }
        state.theta
    };
    let mut library = single_pendulum(Scheme::EemTemperature, 0.2);
    for _ in 0..STEPS {
        library.run.step().unwrap();
    }
    let expected = library.run.temperature(library.spring).unwrap();
    let difference = (run(S::from_f64(1.0)) / S::from_f64(expected) - S::one()).abs();
    assert!(difference.all_below(AGREEMENT), "{difference:?}");
    bencher.bench_local(|| {
        for &speed in black_box(&speeds) {
            black_box(run(speed));
        }
    });
}

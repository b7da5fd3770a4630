//! Time of one step of the single pendulum, and of the parts it is made of; see `README.md`.

#![allow(clippy::unwrap_used, reason = "a benchmark fails by panicking")]

use divan::{Bencher, black_box};
use eem::{FreeEnergy, Scheme, invert, kernel};
use eem_testkit::scenes::{Pendulum, ThermoViscoElastic, single_pendulum};

/// 10 ms: small enough for every scheme to complete the run.
const STEP: f64 = 0.01;
/// 20 s, the duration of the published runs.
const STEPS: u32 = 2_000;
/// Calls per sample of what takes nanoseconds: 500 times the 20 ns that a clock resolves.
const CALLS: u32 = 1_000;

const LAW: ThermoViscoElastic = ThermoViscoElastic::PENDULUM;
/// Old and new (λ, γ, θ), about as far apart as a step of the pendulum takes them.
const OLD: Variables = [3.0, 0.2, 380.0];
const NEW: Variables = [2.95, 0.21, 379.8];

type Variables = <ThermoViscoElastic as FreeEnergy<f64>>::Variables;
type Corners = <ThermoViscoElastic as FreeEnergy<f64>>::Corners;

fn main() {
    divan::main();
}

/// A step, the ledger not asked: samples are whole runs of the pendulum.
#[divan::bench(args = Scheme::ALL, sample_size = STEPS, sample_count = 20)]
fn step(bencher: Bencher<'_, '_>, scheme: Scheme) {
    let start = || single_pendulum(scheme, STEP).run;
    let mut run = start();
    let mut left = STEPS;
    bencher.bench_local(move || {
        if left == 0 {
            run = start();
            left = STEPS;
        }
        left -= 1;
        run.step().unwrap()
    });
}

/// Building the scene and finding its initial entropies.
#[divan::bench(sample_size = CALLS)]
fn set_up() -> Pendulum {
    single_pendulum(black_box(Scheme::EemEntropy), black_box(STEP))
}

/// The temperature θ of the state (λ, γ, θ) with the entropy of another, from a start.
fn temperature([lambda, gamma, _]: Variables, entropy: f64, start: f64) -> f64 {
    let caloric = LAW.caloric_at([lambda, gamma, start]);
    invert(|theta| caloric(theta).0, entropy, start)
        .unwrap()
        .temperature
}

/// The corner temperatures of the step from [`OLD`] to [`NEW`].
fn corners() -> Corners {
    let mixed = |first: Variables, rest: Variables, k: usize| {
        let mut x = rest;
        x[..k].copy_from_slice(&first[..k]);
        temperature(x, LAW.caloric(&rest).entropy, rest[2])
    };
    [
        mixed(NEW, OLD, 1),
        mixed(NEW, OLD, 2),
        mixed(OLD, NEW, 1),
        mixed(OLD, NEW, 2),
    ]
}

/// The temperature at the end of a step, from that at its beginning.
#[divan::bench(sample_size = CALLS)]
fn invert_warm(bencher: Bencher<'_, '_>) {
    let entropy = LAW.caloric(&NEW).entropy;
    bencher.bench_local(|| temperature(black_box(NEW), black_box(entropy), black_box(OLD[2])));
}

/// The functions that the derive writes.
#[divan::bench_group(sample_size = CALLS)]
mod generated {
    use super::{Bencher, FreeEnergy, LAW, NEW, OLD, black_box};

    #[divan::bench]
    fn free_energy() -> f64 {
        black_box(&LAW).free_energy(black_box(&NEW))
    }

    #[divan::bench]
    fn caloric() -> eem::Caloric<f64> {
        black_box(&LAW).caloric(black_box(&NEW))
    }

    #[divan::bench]
    fn hessian() -> impl Sized {
        black_box(&LAW).hessian(black_box(&NEW))
    }

    /// Once per step.
    #[divan::bench]
    fn entropy_form_old() -> impl Sized {
        black_box(&LAW).entropy_form_old(black_box(&OLD))
    }

    /// Once per iteration.
    #[divan::bench]
    fn entropy_form(bencher: Bencher<'_, '_>) {
        let old = LAW.entropy_form_old(&OLD);
        let corners = super::corners();
        bencher.bench_local(|| {
            black_box(&LAW).entropy_form(black_box(&old), black_box(&NEW), black_box(&corners))
        });
    }

    /// Once per step.
    #[divan::bench]
    fn entropy_form_response(bencher: Bencher<'_, '_>) {
        let old = LAW.entropy_form_old(&OLD);
        let corners = super::corners();
        bencher.bench_local(|| {
            let (old, new, corners) = (black_box(&old), black_box(&NEW), black_box(&corners));
            black_box(&LAW).entropy_form_response(old, new, corners)
        });
    }

    /// Once per iteration.
    #[divan::bench]
    fn temperature_form(bencher: Bencher<'_, '_>) {
        let old = LAW.temperature_form_old(&OLD);
        bencher.bench_local(|| black_box(&LAW).temperature_form(black_box(&old), black_box(&NEW)));
    }

    /// Once per step.
    #[divan::bench]
    fn temperature_form_response(bencher: Bencher<'_, '_>) {
        let old = LAW.temperature_form_old(&OLD);
        bencher.bench_local(|| {
            black_box(&LAW).temperature_form_response(black_box(&old), black_box(&NEW))
        });
    }
}

/// Divided differences, beside the functions they belong to.
#[divan::bench_group(sample_size = CALLS)]
mod kernels {
    use super::{black_box, kernel};

    const A: f64 = 1.3;
    const B: f64 = 1.31;
    const P: f64 = 1.7;

    #[divan::bench]
    fn ln() -> f64 {
        black_box(A).ln()
    }

    #[divan::bench]
    fn ln_dd() -> f64 {
        kernel::ln_dd(black_box(A), black_box(B))
    }

    #[divan::bench]
    fn exp() -> f64 {
        black_box(A).exp()
    }

    #[divan::bench]
    fn exp_dd() -> f64 {
        kernel::exp_dd(black_box(A), black_box(B))
    }

    #[divan::bench]
    fn powf() -> f64 {
        black_box(A).powf(black_box(P))
    }

    #[divan::bench]
    fn powf_dd() -> f64 {
        kernel::powf_dd(black_box(A), black_box(B), black_box(P))
    }
}

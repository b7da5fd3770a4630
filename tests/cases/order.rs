//! The schemes converge with their order to the solution of the continuous equations.

use eem::prelude::*;

use crate::support::orders::{exact_row, step_to};
use crate::support::{DoublePendulum, reference, single_pendulum};

/// What a fitted slope over a factor of four in h may be off.
const SLOPE_TOLERANCE: f64 = 0.1;

/// The largest error of q, p, γ, θ and σ at the time `end`, each relative to its size.
fn error(scheme: Scheme, step: f64, end: f64) -> f64 {
    // time, q_x, q_y, p_x, p_y, γ, θ, σ, error estimate
    let exact = exact_row("single_pendulum", end);
    let mut pendulum = single_pendulum(scheme, step);
    step_to(&mut pendulum.run, end);
    let [qx, qy, px, py, theta, gamma, sigma] = pendulum.row();
    let vector = |x: f64, y: f64, at: usize| {
        (x - exact[at]).hypot(y - exact[at + 1]) / exact[at].hypot(exact[at + 1])
    };
    let scalar = |x: f64, at: usize| (x - exact[at]).abs() / exact[at].abs();
    let errors = [
        vector(qx, qy, 1),
        vector(px, py, 3),
        scalar(gamma, 5),
        scalar(theta, 6),
        scalar(sigma, 7),
    ];
    errors.into_iter().fold(0.0, f64::max)
}

/// The slope of a least-squares line through (ln h, ln error).
fn slope(scheme: Scheme, steps: [f64; 3], end: f64) -> f64 {
    let errors = steps.map(|step| error(scheme, step, end));
    let points = steps.map(f64::ln).into_iter().zip(errors.map(f64::ln));
    let [x, y] = points
        .clone()
        .fold([0.0, 0.0], |[x, y], (h, e)| [x + h / 3.0, y + e / 3.0]);
    let [above, below] = points.fold([0.0, 0.0], |[above, below], (h, e)| {
        [above + (h - x) * (e - y), below + (h - x) * (h - x)]
    });
    println!(
        "{}: errors {errors:?} at h = {steps:?}, slope {}",
        scheme.name(),
        above / below
    );
    above / below
}

#[test]
fn entropy_form_is_of_second_order_at_the_published_steps() {
    let slope = slope(Scheme::EemEntropy, [0.2, 0.1, 0.05], 20.0);
    assert!((slope - 2.0).abs() <= SLOPE_TOLERANCE);
}

#[test]
fn every_scheme_has_its_order() {
    for scheme in Scheme::ALL {
        if scheme == Scheme::EemExplicit {
            // At these steps its errors are roundings; see tests/laws/explicit.rs.
            continue;
        }
        let order = f64::from(scheme.order());
        let slope = slope(scheme, [0.02, 0.01, 0.005], 5.0);
        assert!((slope - order).abs() <= SLOPE_TOLERANCE);
    }
}

/// The seam of rules with several stages: a file of constants gives a scheme its order also where heat
/// flows between elements.
#[test]
fn gauss_collocation_is_of_fourth_order_on_the_logarithmic_pendulum() {
    const END: f64 = 1.0;
    let end_state = |step: f64| {
        let mut pendulum = DoublePendulum::LOGARITHMIC.simulation(Scheme::Gauss4, step);
        while pendulum.run.time() < END - 0.5 * step {
            pendulum.run.step().unwrap();
        }
        pendulum.row()
    };
    let steps = [0.0125, 0.00625];
    // time, q, p, θ, error estimate
    let rows = reference("double_pendulum_log_exact.csv");
    let exact = rows.iter().find(|row| row[0] >= END).unwrap();
    let [coarse, fine] = steps.map(|step| {
        let differences = end_state(step).into_iter().zip(&exact[1..]);
        differences.fold(0.0_f64, |largest, (x, exact)| {
            largest.max((x - exact).abs() / exact.abs().max(1.0))
        })
    });
    let slope = (coarse / fine).log2();
    println!("errors {coarse:e}, {fine:e}, slope {slope}");
    assert!((slope - 4.0).abs() <= SLOPE_TOLERANCE, "{slope}");
}

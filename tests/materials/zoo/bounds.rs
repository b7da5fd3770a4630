//! What rounding can have done to a generated number, and how an oracle is compared with it.
//!
//! The programs are evaluated with a bound of the rounding error beside every number. A generated
//! function performs the same operations, so that it is within the bound of the exact value.

use eem_symbolic::{Bounded, Program, Programs, RunningError};

use crate::zoo::families;
use crate::zoo::specimen::Specimen;
use crate::zoo::states::Corner;

/// Relative error of derivatives that are differences of 96 digits, for outputs without rounding.
const TINY: f64 = 1e-25;

/// Names of functions, their outputs with bounds and what was generated.
pub(crate) struct Output {
    pub(crate) function: &'static str,
    pub(crate) bounded: Vec<Bounded>,
    pub(crate) generated: Vec<f64>,
}

fn output(
    function: &'static str,
    program: &Program,
    inputs: &[Bounded],
    generated: Vec<f64>,
) -> Output {
    let bounded = program.interpret(&RunningError, inputs);
    assert_eq!(bounded.len(), generated.len(), "{function}");
    Output {
        function,
        bounded,
        generated,
    }
}

fn exact(values: &[f64]) -> Vec<Bounded> {
    values.iter().map(|&value| Bounded::exact(value)).collect()
}

/// ψ, e, ∂ψ/∂x with ∂²ψ/∂x², entropy with heat capacity, viscosities with slopes.
pub(crate) fn points(specimen: &dyn Specimen, programs: &Programs, x: &[f64]) -> Vec<Output> {
    let inputs = exact(&[&specimen.parameters(), x].concat());
    let mut outputs = vec![
        output(
            "ψ",
            &programs.free_energy,
            &inputs,
            vec![specimen.free_energy(x)],
        ),
        output(
            "e",
            &programs.internal_energy,
            &inputs,
            vec![specimen.internal_energy(x)],
        ),
        output(
            "gradient",
            &programs.gradient,
            &inputs,
            specimen.gradient(x),
        ),
        output("Hessian", &programs.hessian, &inputs, specimen.hessian(x)),
        output(
            "magnitude of ψ",
            &programs.energy_magnitude,
            &inputs,
            vec![specimen.energy_magnitude(x)],
        ),
    ];
    if let Some(program) = &programs.caloric {
        let caloric = specimen.caloric(x);
        let generated = vec![caloric.entropy, caloric.heat_capacity, caloric.magnitude];
        outputs.push(output("caloric", program, &inputs, generated));
    }
    if let Some(program) = &programs.viscosity {
        let theta = x.last().copied().filter(|_| specimen.thermal());
        let inputs = exact(&[&specimen.parameters()[..], theta.as_slice()].concat());
        let generated = specimen.viscosity(theta.unwrap_or_default());
        outputs.push(output("viscosity", program, &inputs, generated));
    }
    outputs
}

/// Both algorithmic forms with their tangents.
pub(crate) fn forms(
    specimen: &dyn Specimen,
    programs: &Programs,
    [x0, x1]: &[Vec<f64>; 2],
    corners: &[Corner],
) -> Vec<Output> {
    let mut inputs = exact(&[&specimen.parameters(), &x0[..], x1].concat());
    let thetas: Vec<f64> = corners.iter().map(|corner| corner.theta).collect();
    let mut outputs = Vec::new();
    if let Some(program) = &programs.temperature_form {
        let generated = specimen.temperature_form(x0, x1);
        outputs.push(output("temperature form", program, &inputs, generated));
    }
    inputs.extend(corners.iter().map(|corner| Bounded {
        value: corner.theta,
        error: corner.error,
    }));
    let generated = specimen.entropy_form(x0, x1, &thetas);
    outputs.push(output(
        "entropy form",
        &programs.entropy_form,
        &inputs,
        generated,
    ));
    outputs
}

/// The largest errors seen.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Worst {
    /// In units of the bound.
    pub(crate) of_bound: f64,
    /// In ulp of the value, where the bound is below 64 ulp of it: what cancels is left out.
    pub(crate) ulps: f64,
}

/// Beyond this bound, in ulp of the value, an output is the small difference of large terms.
const CANCELS: f64 = 64.0;

impl Worst {
    /// Compares one number; `allowed` bounds are the limit. Returns what is wrong.
    pub(crate) fn see(
        &mut self,
        error: f64,
        bounded: Bounded,
        allowed: f64,
        what: impl FnOnce() -> String,
    ) -> Option<String> {
        let bound = bounded.error + TINY * (1.0 + bounded.value.abs());
        let ulp = f64::EPSILON * bounded.value.abs();
        if error > 0.0 {
            self.of_bound = self.of_bound.max(error / bound);
        }
        if bound <= CANCELS * ulp {
            self.ulps = self.ulps.max(error / ulp);
        }
        let right = error <= allowed * bound;
        (!right).then(|| {
            let bound = bounded.error;
            format!(
                "{}: off by {error:e} of {:e}, bound {bound:e}",
                what(),
                bounded.value
            )
        })
    }
}

/// Compares every specimen with an oracle, prints how far off it was at most, and fails with everything that is wrong.
pub(crate) fn assert_all(
    mut compare: impl FnMut(&dyn Specimen, &Programs, &mut Worst) -> Vec<String>,
) {
    let mut wrong = Vec::new();
    for specimen in families::all() {
        let (programs, mut worst) = (specimen.symbolic().programs(), Worst::default());
        wrong.extend(compare(&*specimen, &programs, &mut worst));
        let Worst { of_bound, ulps } = worst;
        println!(
            "{:22} {of_bound:.2} of the bound, {ulps:.1} ulp",
            specimen.name()
        );
    }
    assert_none(&wrong);
}

/// Fails with everything that is wrong.
pub(crate) fn assert_none(wrong: &[String]) {
    assert!(
        wrong.is_empty(),
        "{} wrong numbers, the first of them:\n{}",
        wrong.len(),
        wrong[..wrong.len().min(20)].join("\n")
    );
}

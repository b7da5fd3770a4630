//! Derivatives by the parameters through the interface: springs, points and components of solids against differences.

use eem::prelude::*;
use eem::{Array, StrainEnergy, invert};
use eem_material::point_energy::PointEnergy;

/// Relative change of a parameter: the four-point difference has the error h⁴ of a fifth derivative, and ε/h of rounding
/// and of inverted corners, both far below [`ALLOWED`].
const STEP: f64 = 1e-3;
const ALLOWED: f64 = 1e-9;

const ACTIVATION: f64 = 50.0;

/// With a constant, an array and a dashpot on both sides.
#[derive(Clone, FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    let u = ln(lambda / length);
    0.5 * (k[0] - k[1] * (theta - 300)) * u.powi(2) + k[2] * (u - gamma).powi(4)
        - capacity * theta * ln(theta / 300)
})]
#[viscosity(gamma = eta * exp(ACTIVATION / theta), lambda = eta * theta)]
struct Spring {
    k: [f64; 3],
    length: f64,
    capacity: f64,
    eta: f64,
}

impl Spring {
    fn new(p: &[f64]) -> Self {
        let &[k0, k1, k2, length, capacity, eta] = p else {
            panic!("six parameters");
        };
        Self {
            k: [k0, k1, k2],
            length,
            capacity,
            eta,
        }
    }
}

const SPRING: [f64; 6] = [100.0, 0.1, 30.0, 1.1, 2.0, 5.0];
const STRETCHED: [[f64; 3]; 2] = [[1.3, 0.1, 310.0], [1.4, 0.15, 305.0]];

/// Shape and volume flow, beside a dashpot.
#[derive(Clone, FreeEnergy)]
#[free_energy(|
    e1: StrainTrace, e2: StrainSquare, m3: ViscousStrain, m2: ViscousSquare, m1: ViscousTrace, g: Viscous,
    theta: Temperature,
| {
    0.5 * bulk * e1.powi(2) + 0.5 * volume * (e1 - m1).powi(2) + branch * (e1 - g).powi(2)
        + (shear - softening * (theta - 300)) * (e2 - 2 * m3 + m2) * (1.0 + m2)
        + capacity * (theta - 300 - theta * ln(theta / 300))
})]
#[viscosity(g = 2 * eta, m3 = eta * exp(50 / theta), m1 = 3 * eta * theta)]
struct Flowing {
    bulk: f64,
    volume: f64,
    branch: f64,
    shear: f64,
    softening: f64,
    capacity: f64,
    eta: f64,
}

impl Flowing {
    fn new(p: &[f64]) -> Self {
        let &[bulk, volume, branch, shear, softening, capacity, eta] = p else {
            panic!("seven parameters");
        };
        Self {
            bulk,
            volume,
            branch,
            shear,
            softening,
            capacity,
            eta,
        }
    }
}

const FLOWING: [f64; 7] = [2000.0, 1500.0, 500.0, 800.0, 2.0, 100.0, 300.0];

/// e1 and e2, six components of E, g, six of Γ, θ.
fn flowing_states() -> [[f64; 16]; 2] {
    let strain =
        |k: u8, size: f64| size * f64::from(k + 1) * if k.is_multiple_of(2) { 0.1 } else { -0.07 };
    [(0.3, 310.0), (0.33, 306.0)].map(|(size, theta)| {
        let mut x = [0.0; 16];
        (x[0], x[1], x[8], x[15]) = (0.4 * size, 0.2 * size, 0.1 * size, theta);
        for k in 0..6 {
            x[2 + usize::from(k)] = strain(k, size);
            x[9 + usize::from(k)] = strain(k, 0.3 * size);
        }
        x
    })
}

/// The corner temperatures of a step.
fn corners<M: FreeEnergy<f64>>(model: &M, x0: &M::Variables, x1: &M::Variables) -> M::Corners {
    let mut corners = M::Corners::filled(0.0);
    let half = M::Corners::LEN / 2;
    for index in 0..M::Corners::LEN {
        let [from, to] = if index < half { [x0, x1] } else { [x1, x0] };
        let mixed = model.caloric_between(from, to, index % half + 1);
        let entropy = model.caloric(from).entropy;
        let theta = from[M::Variables::LEN - 1];
        corners[index] = invert(|theta| mixed(theta).0, entropy, theta)
            .unwrap()
            .temperature;
    }
    corners
}

/// Some numbers that are not alike.
fn seed<A: Array<f64>>() -> A {
    let mut seed = A::filled(0.0);
    for (index, value) in (0_u8..).zip(seed.as_mut()) {
        *value = (1.0 + 2.0 * f64::from(index)).sin();
    }
    seed
}

/// `Σ a b`.
fn product<A: Array<f64>>(a: &A, b: &A) -> f64 {
    a.as_ref().iter().zip(b.as_ref()).map(|(a, b)| a * b).sum()
}

/// `Σ w (output)` of all functions, in the order of [`derivatives`].
fn weighted<M: FreeEnergy<f64>>(model: &M, [x0, x1]: &[M::Variables; 2]) -> [f64; 6] {
    let theta = x1[M::Variables::LEN - 1];
    let corners = corners(model, x0, x1);
    let entropy = model.entropy_form_response(&model.entropy_form_old(x0), x1, &corners);
    let temperature = model.temperature_form_response(&model.temperature_form_old(x0), x1);
    [
        product(&entropy, &seed()),
        product(&temperature, &seed()),
        product(&model.gradient(x1), &seed()),
        model.internal_energy(x1),
        product(&model.viscosity(theta).0, &seed()),
        product(&model.drag(theta).0, &seed()),
    ]
}

fn derivatives<M: FreeEnergy<f64>>(model: &M, [x0, x1]: &[M::Variables; 2]) -> [M::Parameters; 6] {
    let theta = x1[M::Variables::LEN - 1];
    let corners = corners(model, x0, x1);
    [
        model.entropy_form_adjoint(x0, x1, &corners, &seed()),
        model.temperature_form_adjoint(x0, x1, &seed()),
        model.gradient_adjoint(x1, &seed()),
        model.energy_by_parameters(x1),
        model.viscosity_adjoint(theta, &seed()),
        model.drag_adjoint(theta, &seed()),
    ]
}

fn check<M: FreeEnergy<f64>>(
    model: impl Fn(&[f64]) -> M,
    parameters: &[f64],
    states: &[M::Variables; 2],
) {
    assert!(M::HAS_PARAMETER_DERIVATIVES);
    assert_eq!(M::Parameters::LEN, M::PARAMETERS.len());
    let law = model(parameters);
    let found = derivatives(&law, states);
    let scale = weighted(&law, states);
    for j in 0..M::PARAMETERS.len() {
        // The parameter of the struct that `PARAMETERS` lists at this place.
        let value = law.parameter(j);
        let place = parameters
            .iter()
            .position(|p| p.to_bits() == value.to_bits());
        let Some(place) = place else {
            assert_eq!(M::PARAMETERS[j], "ACTIVATION");
            continue;
        };
        let step = STEP * value;
        let at = |steps: f64| {
            let mut moved = parameters.to_vec();
            moved[place] += steps * step;
            weighted(&model(&moved), states)
        };
        let [below, low, high, above] = [-2.0, -1.0, 1.0, 2.0].map(at);
        for (function, found) in found.iter().enumerate() {
            let rise = 8.0 * (high[function] - low[function]) - (above[function] - below[function]);
            let expected = rise / (12.0 * step);
            let size = expected.abs().max((scale[function] / value).abs());
            let error = (found[j] - expected).abs();
            assert!(
                error <= ALLOWED * size,
                "{function} by {}: {} is not {expected}",
                M::PARAMETERS[j],
                found[j]
            );
        }
    }
    agree(&law, states);
}

/// Adjoints against tangents: `wᵀ (∂(response)/∂μ δμ)` both ways, in parts of the parameters.
fn agree<M: FreeEnergy<f64>>(law: &M, states: &[M::Variables; 2]) {
    let [x0, x1] = states;
    let corners = corners(law, x0, x1);
    let mut direction: M::Parameters = seed();
    for (j, part) in direction.as_mut().iter_mut().enumerate() {
        *part *= law.parameter(j);
    }
    let [entropy, temperature, ..] = derivatives(law, states);
    let tangents = [
        law.entropy_form_tangent(x0, x1, &corners, &direction),
        law.temperature_form_tangent(x0, x1, &direction),
    ];
    for (adjoint, tangent) in [entropy, temperature].iter().zip(&tangents) {
        let [backwards, forwards] = [product(adjoint, &direction), product(tangent, &seed())];
        let terms = adjoint.as_ref().iter().zip(direction.as_ref());
        let size: f64 = terms.map(|(a, d)| (a * d).abs()).sum();
        let error = (backwards - forwards).abs();
        // Each sum has some tens of operations.
        assert!(
            error <= 100.0 * f64::EPSILON * size,
            "{backwards} and {forwards}"
        );
    }
}

#[test]
fn of_a_spring_with_dashpots_in_series_and_beside() {
    check(Spring::new, &SPRING, &STRETCHED);
    let names = [
        "k[0]",
        "k[1]",
        "k[2]",
        "length",
        "capacity",
        "eta",
        "ACTIVATION",
    ];
    let found = <Spring as FreeEnergy<f64>>::PARAMETERS;
    assert!(names.iter().all(|name| found.contains(name)), "{found:?}");
}

#[test]
fn of_a_volume_are_those_of_the_density_times_the_volume() {
    let point = |p: &[f64]| PointEnergy::new(Spring::new(p), 0.37);
    check(point, &SPRING, &STRETCHED);
}

#[test]
fn of_components_are_those_of_the_invariants() {
    check(|p| Flowing::new(p).at_point(), &FLOWING, &flowing_states());
    let point = |p: &[f64]| PointEnergy::new(Flowing::new(p).at_point(), 0.37);
    check(point, &FLOWING, &flowing_states());
}

/// Hooke's law with a dashpot beside it.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| 0.5 * stiffness * (lambda - length).powi(2))]
#[viscosity(lambda = eta)]
struct Damper {
    stiffness: f64,
    length: f64,
    eta: f64,
}

#[test]
#[allow(clippy::float_cmp, reason = "no operation rounds")]
fn closed_forms_of_a_damper() {
    let damper = Damper {
        stiffness: 100.0,
        length: 1.0,
        eta: 3.0,
    };
    assert_eq!(
        <Damper as FreeEnergy<f64>>::PARAMETERS,
        ["stiffness", "length", "eta"]
    );
    // f* = k ((λ⁰ + λ¹)/2 − L)
    let [k, length, eta]: [f64; 3] = damper.temperature_form_adjoint(&[1.25], &[1.5], &[2.0]);
    assert_eq!([k, length, eta], [2.0 * 0.375, -2.0 * 100.0, 0.0]);
    let change: [f64; 1] = damper.entropy_form_tangent(&[1.25], &[1.5], &[], &[8.0, 0.5, 1.0]);
    assert_eq!(change, [8.0 * 0.375 - 0.5 * 100.0]);
    // e = ψ = ½ k (λ − L)²
    let energy: [f64; 3] = damper.energy_by_parameters(&[1.5]);
    assert_eq!(energy, [0.5 * 0.25, -100.0 * 0.5, 0.0]);
    let drag: [f64; 3] = damper.drag_adjoint(300.0, &[2.0]);
    assert_eq!(drag, [0.0, 0.0, 2.0]);
}

#[test]
fn costs_are_described() {
    let costs = Spring::DESCRIPTION.costs.iter();
    let costs: Vec<_> = costs.filter(|cost| cost.per_call > 0).collect();
    for function in [
        "temperature_form_adjoint",
        "entropy_form_tangent",
        "drag_adjoint",
    ] {
        let cost = costs.iter().find(|cost| cost.function == function);
        assert!(cost.is_some_and(|cost| cost.per_step == 0), "{function}");
    }
    let text = Spring::DESCRIPTION.to_string();
    let lines = text.lines().filter(|line| line.contains("_form_"));
    let mut ends = lines.map(str::len);
    let first = ends.next().unwrap();
    assert!(ends.all(|end| end == first), "columns:\n{text}");
}

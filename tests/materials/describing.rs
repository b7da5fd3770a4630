//! The description of a model says what was written and what follows from it.

use eem::describe::{Argument, Cost, Parameter};
use eem::prelude::*;

/// A linear spring that expands when it warms, with a field that no formula uses.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    0.5 * stiffness * (lambda - length).powi(2)
        - force * (theta / theta_ref) * lambda
        - capacity * theta * ln(theta / theta_ref)
})]
#[allow(dead_code, reason = "only the type is described")]
struct Spring<T, const N: usize> {
    #[unit("N/m")]
    stiffness: T,
    #[unit("m")]
    length: f64,
    #[unit("mN m/mm")]
    force: f64,
    #[unit(" J K^-1 ")]
    capacity: f64,
    #[unit("K")]
    theta_ref: f64,
    marks: [u8; N],
}

/// Without units.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| 0.5 * stiffness * lambda * lambda)]
#[allow(dead_code, reason = "only the type is described")]
struct Plain {
    stiffness: f64,
}

/// A solid with a dashpot.
#[derive(FreeEnergy)]
#[free_energy(|e1: StrainTrace, g: Viscous, e2: StrainSquare, theta: Temperature| {
    0.5 * branch * (e1 - g).powi(2) + mu * e2 - capacity * theta * ln(theta / theta_ref)
})]
#[viscosity(g = eta)]
#[allow(dead_code, reason = "only the type is described")]
struct Solid {
    #[unit("J/m^3")]
    branch: f64,
    #[unit("Pa")]
    mu: f64,
    #[unit("J/(K m^3)")]
    capacity: f64,
    #[unit("K")]
    theta_ref: f64,
    #[unit("Pa s")]
    eta: f64,
}

const SPRING: eem::Description = Spring::<f64, 3>::DESCRIPTION;

#[test]
fn arguments_are_in_the_order_of_the_state() {
    let lambda = Argument::new("lambda", "Stretch", "m");
    let theta = Argument::new("theta", "Temperature", "K");
    assert_eq!(SPRING.arguments, [lambda, theta]);
    assert_eq!(SPRING.name, "Spring");
}

#[test]
fn parameters_are_the_fields_that_are_used_with_their_units_as_written() {
    let units = SPRING.parameters.iter().map(|parameter| parameter.unit);
    let units: Vec<&str> = units.map(Option::unwrap).collect();
    assert_eq!(units, ["N/m", "m", "mN m/mm", "J K^-1", "K"]);
    let names = SPRING.parameters.iter().map(|parameter| parameter.name);
    let parameters = <Spring<f64, 3> as FreeEnergy<f64>>::PARAMETERS;
    assert_eq!(names.collect::<Vec<&str>>(), parameters);
    assert_eq!(
        Plain::DESCRIPTION.parameters,
        [Parameter::without_unit("stiffness")]
    );
}

#[test]
fn formulas_follow_from_the_free_energy() {
    let force = "f = ∂ψ/∂lambda = stiffness*(lambda - length) - theta*force/theta_ref";
    assert_eq!(SPRING.equation("f"), Some(force));
    let capacity = "c = theta ∂s/∂theta = capacity";
    assert_eq!(SPRING.equation("c"), Some(capacity));
    let secant = "s[lambda⁰, lambda¹] = force/theta_ref";
    assert_eq!(SPRING.equation("s[lambda]"), Some(secant));
    assert_eq!(SPRING.equation("g"), None);
}

#[test]
fn a_solid_is_described_per_volume() {
    let solid = Solid::DESCRIPTION;
    let arguments = [
        Argument::new("e1", "StrainTrace", "1"),
        Argument::new("e2", "StrainSquare", "1"),
        Argument::new("g", "Viscous", "1"),
        Argument::new("theta", "Temperature", "K"),
    ];
    assert_eq!(solid.arguments, arguments);
    let units = solid.formulas.iter().chain(solid.divided_differences);
    let units: Vec<_> = units
        .map(|formula| (formula.symbol, formula.unit))
        .collect();
    let expected = [
        ("ψ", "J/m^3"),
        ("s", "J/(K m^3)"),
        ("e", "J/m^3"),
        ("f_1", "Pa"),
        ("f_2", "Pa"),
        ("g", "Pa"),
        ("c", "J/(K m^3)"),
        ("η", "Pa s"),
        ("ψ[e1]", "Pa"),
        ("ψ[e2]", "Pa"),
        ("ψ[g]", "Pa"),
        ("s[e1]", "Pa/K"),
        ("s[theta]", "J/(K^2 m^3)"),
        ("e[theta]", "J/(K m^3)"),
    ];
    for formula in expected {
        assert!(units.contains(&formula), "{formula:?} is not in {units:?}");
    }
    assert_eq!(solid.equation("f_2"), Some("f_2 = ∂ψ/∂e2 = mu"));
}

#[test]
fn operations_are_counted() {
    let plain = Plain::DESCRIPTION;
    // Two products for ψ once λ is squared, one for f.
    assert!(plain.costs.contains(&Cost::new("free_energy", 0, 3)));
    assert!(plain.costs.contains(&Cost::new("gradient", 0, 1)));
    let mut functions = SPRING.costs.iter().map(|cost| cost.function);
    assert!(!functions.clone().any(|function| function == "viscosity"));
    assert!(
        functions
            .clone()
            .any(|function| function == "temperature_form")
    );
    let derivatives = functions.any(|function| function == "temperature_form_adjoint");
    assert_eq!(derivatives, cfg!(feature = "gradients"));
}

#[test]
fn print_has_a_section_for_everything() {
    let text = SPRING.to_string();
    for part in [
        "Spring\n",
        "  theta               Temperature   K\n",
        "  force               mN m/mm\n",
        "  c = theta ∂s/∂theta = capacity   [J/K]\n",
        "  s[lambda⁰, lambda¹] = force/theta_ref   [N/K]\n",
        "per step      per call\n",
        "  temperature_form",
    ] {
        assert!(text.contains(part), "{part:?} is missing in\n{text}");
    }
    let plain = Plain::DESCRIPTION.to_string();
    assert!(plain.contains("\n  stiffness\n"), "{plain}");
}

//! `T = 1 − θ ∂_θ`: what is linear in θ vanishes, and nothing that cancels is left to rounding.

use crate::oracle::{assert_agree, value};
use crate::reader::read;
use crate::support::laws;
use crate::support::precise::Precise;
use eem_symbolic::{Function, Graph, diff, format, internal_energy};

/// T of the first formula is the second, as an expression.
fn energy_is(psi: &str, expected: &str) {
    let mut graph = Graph::new();
    let (psi, expected) = (read(&mut graph, psi), read(&mut graph, expected));
    let theta = graph.symbol("theta");
    let energy = internal_energy(&mut graph, psi, theta);
    assert_eq!(
        energy,
        expected,
        "{}, not {}",
        format(&graph, energy),
        format(&graph, expected)
    );
}

#[test]
fn what_is_linear_in_the_temperature_vanishes() {
    energy_is("theta", "0");
    energy_is("a*theta", "0");
    energy_is("1e9*theta + a", "a");
    energy_is("a*(theta - r)", "-a*r");
    energy_is("exp(a)*sqrt(l)*theta", "0");
    energy_is("theta*(a + b*l)", "0");
}

#[test]
fn powers_of_the_temperature_keep_their_form() {
    energy_is("theta^2", "-theta^2");
    energy_is("1/theta", "2/theta");
    energy_is("sqrt(theta)", "0.5*sqrt(theta)");
    energy_is("c*theta^p", "c*((1 - p)*theta^p)");
    energy_is("c*theta^-0.25", "1.25*c*theta^-0.25");
}

#[test]
fn logarithms_of_the_temperature_leave_the_energy() {
    energy_is("theta*ln(theta)", "-theta");
    energy_is("theta*ln(theta/r)", "-theta");
    energy_is("c*(theta - r - theta*ln(theta/r))", "c*(theta - r)");
    energy_is("c*theta*(1 - ln(theta/r))", "c*theta");
    energy_is("ln(theta/r)", "ln(theta/r) - 1");
    energy_is("theta*(a + b*theta - c*ln(theta))", "c*theta - b*theta^2");
}

#[test]
fn other_terms_follow_the_definition() {
    energy_is("exp(theta)", "exp(theta) - theta*exp(theta)");
    energy_is("theta*sin(theta)", "-theta^2*cos(theta)");
    energy_is("a", "a");
}

#[test]
fn factors_without_temperature_stay_in_front() {
    energy_is("(k - m*(theta - r))*ln(l)^2", "(k + m*r)*ln(l)^2");
    energy_is("-b*(theta - r)*ln(l)", "b*r*ln(l)");
}

#[test]
fn the_energy_of_the_pendulum_has_no_logarithm_of_the_temperature() {
    let mut law = laws::pendulum();
    let theta = law.model.temperature.unwrap();
    let graph = &mut law.model.graph;
    let energy = internal_energy(graph, law.model.psi, theta);
    let text = format(graph, energy);
    assert!(!text.contains("ln(theta"), "{text}");
    assert!(text.contains("ln(lambda/l0)"), "{text}");
    // E is affine in θ: c θ and nothing else.
    let curvature = diff(graph, energy, theta);
    assert!(
        !graph.depends_on(curvature, theta),
        "{}",
        format(graph, curvature)
    );
}

#[test]
fn every_law_agrees_with_the_definition() {
    let precise = Precise::new();
    for mut law in crate::support::all_laws() {
        let Some(theta) = law.model.temperature else {
            continue;
        };
        let graph = &mut law.model.graph;
        let energy = internal_energy(graph, law.model.psi, theta);
        let slope = diff(graph, law.model.psi, theta);
        let at = graph.variable(theta);
        let product = graph.mul(at, slope);
        let definition = graph.sub(law.model.psi, product);
        let symbols = law.model.parameters.iter().chain(&law.model.measures);
        let symbols: Vec<_> = symbols
            .chain(&law.model.dashpots)
            .chain([&theta])
            .copied()
            .collect();
        let names: Vec<_> = symbols
            .iter()
            .map(|&symbol| graph.name(symbol).to_owned())
            .collect();
        let values = law
            .parameters
            .iter()
            .chain(&law.state)
            .map(|&v| precise.from_f64(v));
        let point: Vec<_> = names.iter().map(String::as_str).zip(values).collect();
        let [computed, exact] = [energy, definition].map(|e| value(&precise, graph, e, &point));
        assert_agree(&precise, &computed, &exact, law.name);
    }
}

#[test]
fn nested_sums_and_products_stay_small() {
    let mut graph = Graph::new();
    let at = read(&mut graph, "theta");
    let mut psi = at;
    for level in 0..500 {
        let a = read(&mut graph, &format!("a{level}"));
        let inner = graph.product(&[a, psi]);
        let logarithm = graph.apply(Function::Tanh, inner);
        let term = graph.mul(at, logarithm);
        psi = graph.sum(&[term, inner, a]);
    }
    let theta = graph.symbol("theta");
    let energy = internal_energy(&mut graph, psi, theta);
    assert!(
        graph.size(energy) < 20 * graph.size(psi),
        "{}",
        graph.size(energy)
    );
}

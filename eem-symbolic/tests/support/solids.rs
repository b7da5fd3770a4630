//! Free energies per volume of strains, e1 = tr E, e2 = E:E and j = J − 1.

use super::laws::{Law, Text, reader::read};
use super::random::{Random, expression};

/// All of them.
pub(crate) fn all() -> Vec<Law> {
    vec![thermoelastic(), rubber(), viscoelastic()]
}

/// No part of it is separable.
fn thermoelastic() -> Law {
    Text {
        name: "thermoelastic solid",
        measures: &["e1", "e2", "j"],
        dashpots: &[],
        parameters: &[
            ("mu", 1000.0),
            ("mu1", 2.0),
            ("la", 2000.0),
            ("b", 3.0),
            ("g", 400.0),
            ("c", 100.0),
            ("theta_r", 300.0),
        ],
        psi: "(mu - mu1*(theta - theta_r))*(e1 - ln_1p(j)) \
            + 0.5*la*ln_1p(j)^2 - b*(theta - theta_r)*ln_1p(j) + g*e2*(theta/theta_r/(1 + j)) \
            + c*(theta - theta_r - theta*ln(theta/theta_r))",
        viscosities: &[],
        state: &[0.12, 0.05, 0.1, 310.0],
    }
    .law()
}

/// Without temperature.
fn rubber() -> Law {
    Text {
        name: "rubber",
        measures: &["e1", "e2", "j"],
        dashpots: &[],
        parameters: &[("a", 250.0), ("b", 150.0), ("c", 4000.0), ("d", 1100.0)],
        psi: "2*a*e1 + b*(4*e1 + 2*e1^2 - 2*e2)*(1 + j)^(-4/3) + 0.5*c*j^2 - d*ln_1p(j)",
        viscosities: &[],
        state: &[0.12, 0.05, 0.1],
    }
    .law()
}

/// With two dashpots.
fn viscoelastic() -> Law {
    Text {
        name: "viscoelastic solid",
        measures: &["e1", "e2"],
        dashpots: &["gamma1", "gamma2"],
        parameters: &[
            ("la", 2000.0),
            ("mu", 1000.0),
            ("k", 1500.0),
            ("n", 2500.0),
            ("n1", 4.0),
            ("b", 3.0),
            ("c", 100.0),
            ("eta", 300.0),
            ("a", 50.0),
            ("theta_r", 300.0),
        ],
        psi: "0.5*la*e1^2 - b*(theta - theta_r)*e1 + mu*e2 + 0.5*k*(e1 - gamma1)^2 \
            + 0.5*(n - n1*(theta - theta_r))*(e2 - gamma2)^2 + c*(theta - theta_r - theta*ln(theta/theta_r))",
        viscosities: &["eta*exp(a*(1/theta - 1/theta_r))"; 2],
        state: &[0.12, 0.05, 0.03, 0.02, 310.0],
    }
    .law()
}

/// A random free energy of all strains that nothing is separable in, and c (θ − θ ln(θ/θr)) with a
/// heat capacity c that no other term comes near to.
pub(crate) fn random(seed: u64) -> Law {
    let mut law = Text {
        name: "random solid",
        measures: &["e1", "e2", "j"],
        dashpots: &[],
        parameters: &[("c", 1e5), ("theta_r", 300.0)],
        psi: "c*(theta - theta_r - theta*ln(theta/theta_r))",
        viscosities: &[],
        state: &[0.12, 0.05, 0.1, 310.0],
    }
    .law();
    let graph = &mut law.model.graph;
    let mut random = Random::new(seed);
    let [volume, first, second] = [
        "1 + j",
        "1 + e1 + e2*(theta/theta_r)",
        "(1 + j)*(theta/theta_r)*(1 + e1 + e2*(theta/theta_r))",
    ]
    .map(|text| read(graph, text));
    for x in [first, second] {
        let term = expression(graph, &mut random, x, 2);
        let other = graph.mul(x, volume);
        let other = expression(graph, &mut random, other, 1);
        let term = graph.product(&[term, other, first]);
        law.model.psi = graph.add(law.model.psi, term);
    }
    law
}

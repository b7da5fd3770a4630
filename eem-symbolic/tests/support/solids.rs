//! Free energies per volume of strains, e1 = tr E, e2 = E:E and j = J − 1.

use eem_symbolic::{ExprId, Function, LowerBound, Model, Number, Rational, Symbol};

use super::laws::{Law, Writer};
use super::random::{Random, expression};

/// All of them.
pub(crate) fn all() -> Vec<Law> {
    vec![thermoelastic(), rubber(), viscoelastic()]
}

/// A strain and from where on it is.
fn strain(w: &mut Writer, name: &str) -> (LowerBound, ExprId) {
    let (symbol, e) = w.variable(name);
    let bound = match name {
        "e1" => LowerBound::above(symbol, Rational::new(-3, 2).expect("a fraction")),
        "e2" => LowerBound::from(symbol, Rational::ZERO),
        _ => LowerBound::above(symbol, Rational::MINUS_ONE),
    };
    (bound, e)
}

fn half(w: &mut Writer, factors: &[ExprId]) -> ExprId {
    let product = w.graph.product(factors);
    w.graph.scale(Number::HALF, product)
}

fn law(
    name: &'static str,
    w: Writer,
    strains: Vec<LowerBound>,
    dashpots: Vec<(Symbol, ExprId)>,
    temperature: Option<Symbol>,
    psi: ExprId,
    state: Vec<f64>,
) -> Law {
    let (dashpots, viscosities) = dashpots.into_iter().unzip();
    let model = Model {
        graph: w.graph,
        measures: strains.iter().map(|strain| strain.symbol).collect(),
        strains,
        dashpots,
        temperature,
        parameters: w.parameters,
        psi,
        viscosities,
        drag: None,
    };
    Law {
        name,
        model,
        parameters: w.values,
        state,
    }
}

/// No part of it is separable:
/// ψ = (μ − μ₁ϑ)(e1 − L) + ½λL² − bϑL + g e2 θ/(θr (1 + j)) + c (ϑ − θ ln(θ/θr)), L = ln(1 + j), ϑ = θ − θr.
fn thermoelastic() -> Law {
    let mut w = Writer::new();
    let [(b1, e1), (b2, e2), (bj, j)] = ["e1", "e2", "j"].map(|name| strain(&mut w, name));
    let (theta, t) = w.variable("theta");
    let data = [("mu", 1000.0), ("mu1", 2.0), ("la", 2000.0)];
    let [mu, mu1, la] = data.map(|(name, value)| w.parameter(name, value));
    let data = [("b", 3.0), ("g", 400.0), ("c", 100.0), ("theta_r", 300.0)];
    let [b, g, c, reference] = data.map(|(name, value)| w.parameter(name, value));
    let excess = w.graph.sub(t, reference);
    let logarithm = w.graph.apply(Function::Ln1p, j);
    let shear = w.softening([mu, mu1], excess);
    let isochoric = w.graph.sub(e1, logarithm);
    let isochoric = w.graph.mul(shear, isochoric);
    let volumetric = w.strain_energy([la, b], logarithm, excess);
    let one = w.graph.integer(1);
    let volume = w.graph.add(one, j);
    let ratio = w.graph.div(t, reference);
    let quotient = w.graph.div(ratio, volume);
    let square = w.graph.product(&[g, e2, quotient]);
    let caloric = w.caloric(c, t, reference);
    let psi = w.graph.sum(&[isochoric, volumetric, square, caloric]);
    let state = vec![0.12, 0.05, 0.1, 310.0];
    law(
        "thermoelastic solid",
        w,
        vec![b1, b2, bj],
        vec![],
        Some(theta),
        psi,
        state,
    )
}

/// ψ = 2a e1 + b (4e1 + 2(e1² − e2))(1 + j)^(−4/3) + ½c j² − d ln(1 + j), without temperature.
fn rubber() -> Law {
    let mut w = Writer::new();
    let [(b1, e1), (b2, e2), (bj, j)] = ["e1", "e2", "j"].map(|name| strain(&mut w, name));
    let data = [("a", 250.0), ("b", 150.0), ("c", 4000.0), ("d", 1100.0)];
    let [a, b, c, d] = data.map(|(name, value)| w.parameter(name, value));
    let (two, four) = (Number::from(2_i64), Number::from(4_i64));
    let first = w.graph.mul(a, e1);
    let first = w.graph.scale(two, first);
    let square = w.graph.powi(e1, 2);
    let terms = [(four, e1), (two, square), (-two, e2)];
    let cofactor = w.graph.weighted_sum(Number::ZERO, &terms);
    let one = w.graph.integer(1);
    let volume = w.graph.add(one, j);
    let exponent = w.graph.number(-four / Number::from(3_i64));
    let power = w.graph.power(volume, exponent);
    let second = w.graph.product(&[b, cofactor, power]);
    let volumetric = half(&mut w, &[c, j, j]);
    let logarithm = w.graph.apply(Function::Ln1p, j);
    let barrier = w.graph.mul(d, logarithm);
    let barrier = w.graph.neg(barrier);
    let psi = w.graph.sum(&[first, second, volumetric, barrier]);
    let state = vec![0.12, 0.05, 0.1];
    law("rubber", w, vec![b1, b2, bj], vec![], None, psi, state)
}

/// Two dashpots:
/// ψ = ½λe1² + μe2 + ½k(e1 − γ₁)² + ½(n − n₁ϑ)(e2 − γ₂)² − bϑe1 + c (ϑ − θ ln(θ/θr)).
fn viscoelastic() -> Law {
    let mut w = Writer::new();
    let [(b1, e1), (b2, e2)] = ["e1", "e2"].map(|name| strain(&mut w, name));
    let [(gamma1, g1), (gamma2, g2)] = ["gamma1", "gamma2"].map(|name| w.variable(name));
    let (theta, t) = w.variable("theta");
    let data = [("la", 2000.0), ("mu", 1000.0), ("k", 1500.0), ("n", 2500.0)];
    let [la, mu, k, n] = data.map(|(name, value)| w.parameter(name, value));
    let data = [("n1", 4.0), ("b", 3.0), ("c", 100.0), ("eta", 300.0)];
    let [n1, b, c, eta] = data.map(|(name, value)| w.parameter(name, value));
    let [a, reference] = [("a", 50.0), ("theta_r", 300.0)].map(|(n, v)| w.parameter(n, v));
    let excess = w.graph.sub(t, reference);
    let elastic = w.strain_energy([la, b], e1, excess);
    let shear = w.graph.mul(mu, e2);
    let over = [(e1, g1), (e2, g2)].map(|(e, g)| w.graph.sub(e, g));
    let first = half(&mut w, &[k, over[0], over[0]]);
    let stiffness = w.softening([n, n1], excess);
    let second = half(&mut w, &[stiffness, over[1], over[1]]);
    let caloric = w.caloric(c, t, reference);
    let psi = w.graph.sum(&[elastic, shear, first, second, caloric]);
    let viscosity = w.viscosity([eta, a], t, reference);
    let dashpots = vec![(gamma1, viscosity), (gamma2, viscosity)];
    let state = vec![0.12, 0.05, 0.03, 0.02, 310.0];
    law(
        "viscoelastic solid",
        w,
        vec![b1, b2],
        dashpots,
        Some(theta),
        psi,
        state,
    )
}

/// A random free energy of all strains that nothing is separable in, and c (θ − θ ln(θ/θr)) with a
/// heat capacity c that no other term comes near to.
pub(crate) fn random(seed: u64) -> Law {
    let mut w = Writer::new();
    let mut random = Random::new(seed);
    let [(b1, e1), (b2, e2), (bj, j)] = ["e1", "e2", "j"].map(|name| strain(&mut w, name));
    let (theta, t) = w.variable("theta");
    let [c, reference] = [("c", 1e5), ("theta_r", 300.0)].map(|(n, v)| w.parameter(n, v));
    let one = w.graph.integer(1);
    let volume = w.graph.add(one, j);
    let ratio = w.graph.div(t, reference);
    let product = w.graph.mul(e2, ratio);
    let first = w.graph.sum(&[one, e1, product]);
    let second = w.graph.product(&[volume, ratio, first]);
    let mut psi = w.caloric(c, t, reference);
    for x in [first, second] {
        let term = expression(&mut w.graph, &mut random, x, 2);
        let other = w.graph.mul(x, volume);
        let other = expression(&mut w.graph, &mut random, other, 1);
        let term = w.graph.product(&[term, other, first]);
        psi = w.graph.add(psi, term);
    }
    let state = vec![0.12, 0.05, 0.1, 310.0];
    law(
        "random solid",
        w,
        vec![b1, b2, bj],
        vec![],
        Some(theta),
        psi,
        state,
    )
}

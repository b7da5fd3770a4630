//! Constitutive laws with data, read from texts.

#[path = "reader.rs"]
pub(crate) mod reader;

use eem_symbolic::{Graph, LowerBound, Model, Rational, Symbol};

use self::reader::read;

/// A model, its parameters and a state to start from.
#[derive(Clone)]
pub(crate) struct Law {
    pub(crate) name: &'static str,
    pub(crate) model: Model,
    pub(crate) parameters: Vec<f64>,
    pub(crate) state: Vec<f64>,
}

/// How a law is written: ψ and viscosities of the variables and parameters; the temperature is `theta`, behind the dashpots.
pub(crate) struct Text<'a> {
    pub(crate) name: &'static str,
    pub(crate) measures: &'a [&'a str],
    pub(crate) dashpots: &'a [&'a str],
    pub(crate) parameters: &'a [(&'a str, f64)],
    pub(crate) psi: &'a str,
    pub(crate) viscosities: &'a [&'a str],
    pub(crate) state: &'a [f64],
}

/// From where on a strain is, by its name: e1 = tr E, e2 = E:E, j = J − 1.
fn strain(name: &str, symbol: Symbol) -> Option<LowerBound> {
    match name {
        "e1" => Rational::new(-3, 2).map(|least| LowerBound::above(symbol, least)),
        "e2" => Some(LowerBound::from(symbol, Rational::ZERO)),
        "j" => Some(LowerBound::above(symbol, Rational::MINUS_ONE)),
        _ => None,
    }
}

impl Text<'_> {
    pub(crate) fn law(&self) -> Law {
        let mut graph = Graph::new();
        let mut symbol = |name: &&str| graph.symbol(name);
        let measures: Vec<_> = self.measures.iter().map(&mut symbol).collect();
        let dashpots: Vec<_> = self.dashpots.iter().map(&mut symbol).collect();
        let is_thermal = self.state.len() > measures.len() + dashpots.len();
        let temperature = is_thermal.then(|| symbol(&"theta"));
        let parameters = self.parameters.iter().map(|(name, _)| symbol(name));
        let parameters = parameters.collect();
        let strains = self.measures.iter().zip(&measures);
        let strains = strains.filter_map(|(name, &symbol)| strain(name, symbol));
        let strains = strains.collect();
        let psi = read(&mut graph, self.psi);
        let laws = self.viscosities.iter();
        let viscosities = laws.map(|law| read(&mut graph, law)).collect();
        let model = Model {
            graph,
            measures,
            strains,
            dashpots,
            temperature,
            parameters,
            psi,
            viscosities,
            drag: None,
        };
        Law {
            name: self.name,
            model,
            parameters: self.parameters.iter().map(|&(_, value)| value).collect(),
            state: self.state.to_vec(),
        }
    }
}

/// All springs.
pub(crate) fn all() -> Vec<Law> {
    vec![
        pendulum(),
        logarithmic_stiffness(),
        two_dashpots(),
        einstein(),
        elastic(),
    ]
}

const PENDULUM: &[(&str, f64)] = &[
    ("k0", 100.0),
    ("k1", 0.5),
    ("beta_c", 0.1),
    ("beta_t", 4.0),
    ("c", 1.0),
    ("mu0", 5.0),
    ("mu1", 0.1),
    ("eta0", 100.0),
    ("a", 10.0),
    ("l0", 1.0),
    ("theta_r", 300.0),
];
/// Of a dashpot of the pendulum, with ∂e/∂λ of the elastic energy e in front of it.
const DASHPOT: &str = "(mu0 - mu1*(theta - theta_r))*gamma^2 \
    - beta_c*gamma*((k0 - k1*(theta - theta_r))*ln(lambda/l0)/lambda - beta_t*(theta - theta_r)/lambda)";
const ELASTIC: &str = "(1 + beta_c)*((0.5*(k0 - k1*(theta - theta_r))*ln(lambda/l0)^2 \
    - beta_t*(theta - theta_r)*ln(lambda/l0)) + c*(theta - theta_r - theta*ln(theta/theta_r)))";
const THINNING: &str = "eta0*exp(a*(1/theta - 1/theta_r))";

/// García Orden & Romero 2012, §4.1.
pub(crate) fn pendulum() -> Law {
    thermo_visco_elastic("pendulum", &["gamma1"], &[1.3, 0.2, 380.0])
}

/// The same with two dashpots.
pub(crate) fn two_dashpots() -> Law {
    let dashpots = ["gamma1", "gamma2"];
    thermo_visco_elastic("two dashpots", &dashpots, &[1.3, 0.2, -0.1, 380.0])
}

fn thermo_visco_elastic(name: &'static str, dashpots: &[&str], state: &[f64]) -> Law {
    let mut psi = ELASTIC.to_owned();
    for dashpot in dashpots {
        psi = format!("{psi} + ({})", DASHPOT.replace("gamma", dashpot));
    }
    Text {
        name,
        measures: &["lambda"],
        dashpots,
        parameters: PENDULUM,
        psi: &psi,
        viscosities: &vec![THINNING; dashpots.len()],
        state,
    }
    .law()
}

/// Conde Martín, Betsch & García Orden 2016, eq. 43 with C(θ) = C⁰ − C¹ θr ln(θ/θr): no closed
/// inverse of s(θ).
pub(crate) fn logarithmic_stiffness() -> Law {
    Text {
        name: "logarithmic stiffness",
        measures: &["lambda"],
        dashpots: &[],
        parameters: &[
            ("c0", 5000.0),
            ("c1", 50.0),
            ("beta", 20.0),
            ("capacity", 5000.0),
            ("l0", 2.0),
            ("theta_r", 300.0),
        ],
        psi: "0.5*(c0 - c1*theta_r*ln(theta/theta_r))*ln(lambda/l0)^2 - beta*(theta - theta_r)*ln(lambda/l0) \
            + capacity*(theta - theta_r - theta*ln(theta/theta_r))",
        viscosities: &[],
        state: &[2.6, 380.0],
    }
    .law()
}

/// Two measures and a solid whose heat capacity freezes out.
pub(crate) fn einstein() -> Law {
    Text {
        name: "Einstein solid",
        measures: &["lambda1", "lambda2"],
        dashpots: &[],
        parameters: &[("k", 3.0), ("c", 2.0), ("einstein", 250.0)],
        psi: "0.5*k*(lambda1^2 + lambda1*lambda2^2)*theta^-0.25 + c*theta*ln_1p(-exp(-(einstein/theta)))",
        viscosities: &[],
        state: &[1.2, 0.7, 150.0],
    }
    .law()
}

/// Without temperature.
pub(crate) fn elastic() -> Law {
    Text {
        name: "elastic",
        measures: &["lambda"],
        dashpots: &["gamma"],
        parameters: &[
            ("k", 100.0),
            ("mu", 5.0),
            ("beta", 0.1),
            ("l0", 1.0),
            ("eta", 7.0),
        ],
        psi: "0.5*k*ln(lambda/l0)^2 + mu*gamma^2 - beta*k*gamma*(ln(lambda/l0)/lambda)",
        viscosities: &["eta"],
        state: &[1.3, 0.45],
    }
    .law()
}

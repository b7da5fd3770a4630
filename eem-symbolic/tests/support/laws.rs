//! Constitutive laws with data, built in the graph.

use eem_symbolic::{ExprId, Function, Graph, Model, Number, Symbol, diff};

/// A model, its parameters and a state to start from.
pub(crate) struct Law {
    pub(crate) name: &'static str,
    pub(crate) model: Model,
    pub(crate) parameters: Vec<f64>,
    pub(crate) state: Vec<f64>,
}

/// All of them.
pub(crate) fn all() -> Vec<Law> {
    vec![
        pendulum(),
        logarithmic_stiffness(),
        two_dashpots(),
        einstein(),
        elastic(),
    ]
}

/// Collects symbols while a formula is written down.
pub(crate) struct Writer {
    pub(crate) graph: Graph,
    pub(crate) parameters: Vec<Symbol>,
    pub(crate) values: Vec<f64>,
}

impl Writer {
    pub(crate) fn new() -> Self {
        Self {
            graph: Graph::new(),
            parameters: Vec::new(),
            values: Vec::new(),
        }
    }

    pub(crate) fn variable(&mut self, name: &str) -> (Symbol, ExprId) {
        let symbol = self.graph.symbol(name);
        (symbol, self.graph.variable(symbol))
    }

    pub(crate) fn parameter(&mut self, name: &str, value: f64) -> ExprId {
        let symbol = self.graph.symbol(name);
        self.parameters.push(symbol);
        self.values.push(value);
        self.graph.variable(symbol)
    }

    /// ln(x/y).
    fn log_ratio(&mut self, x: ExprId, y: ExprId) -> ExprId {
        let ratio = self.graph.div(x, y);
        self.graph.apply(Function::Ln, ratio)
    }

    /// c (θ − θr − θ ln(θ/θr)).
    pub(crate) fn caloric(&mut self, c: ExprId, theta: ExprId, reference: ExprId) -> ExprId {
        let logarithm = self.log_ratio(theta, reference);
        let product = self.graph.mul(theta, logarithm);
        let excess = self.graph.sub(theta, reference);
        let bracket = self.graph.sub(excess, product);
        self.graph.mul(c, bracket)
    }

    /// a − b (θ − θr).
    pub(crate) fn softening(&mut self, [a, b]: [ExprId; 2], excess: ExprId) -> ExprId {
        let loss = self.graph.mul(b, excess);
        self.graph.sub(a, loss)
    }

    /// C/2 L² − β (θ − θr) L.
    pub(crate) fn strain_energy(
        &mut self,
        [c, beta]: [ExprId; 2],
        strain: ExprId,
        excess: ExprId,
    ) -> ExprId {
        let square = self.graph.powi(strain, 2);
        let half = self.graph.number(Number::HALF);
        let elastic = self.graph.product(&[half, c, square]);
        let thermal = self.graph.product(&[beta, excess, strain]);
        self.graph.sub(elastic, thermal)
    }

    /// η0 exp(a (1/θ − 1/θr)).
    pub(crate) fn viscosity(
        &mut self,
        [eta, a]: [ExprId; 2],
        theta: ExprId,
        reference: ExprId,
    ) -> ExprId {
        let inverse = [theta, reference].map(|x| self.graph.recip(x));
        let difference = self.graph.sub(inverse[0], inverse[1]);
        let exponent = self.graph.mul(a, difference);
        let factor = self.graph.apply(Function::Exp, exponent);
        self.graph.mul(eta, factor)
    }
}

/// García Orden & Romero 2012, §4.1.
pub(crate) fn pendulum() -> Law {
    thermo_visco_elastic("pendulum", 1, vec![1.3, 0.2, 380.0])
}

/// The same with two dashpots.
pub(crate) fn two_dashpots() -> Law {
    thermo_visco_elastic("two dashpots", 2, vec![1.3, 0.2, -0.1, 380.0])
}

fn thermo_visco_elastic(name: &'static str, dashpots: usize, state: Vec<f64>) -> Law {
    let mut w = Writer::new();
    let (lambda, l) = w.variable("lambda");
    let names = ["gamma1", "gamma2"];
    let gammas: Vec<_> = names[..dashpots]
        .iter()
        .map(|name| w.variable(name))
        .collect();
    let (theta, t) = w.variable("theta");
    let data = [
        ("k0", 100.0),
        ("k1", 0.5),
        ("beta_c", 0.1),
        ("beta_t", 4.0),
        ("c", 1.0),
    ];
    let [k0, k1, beta_c, beta_t, c] = data.map(|(name, value)| w.parameter(name, value));
    let data = [
        ("mu0", 5.0),
        ("mu1", 0.1),
        ("eta0", 100.0),
        ("a", 10.0),
        ("l0", 1.0),
    ];
    let [mu0, mu1, eta0, a, l0] = data.map(|(name, value)| w.parameter(name, value));
    let reference = w.parameter("theta_r", 300.0);
    let excess = w.graph.sub(t, reference);
    let strain = w.log_ratio(l, l0);
    let stiffness = w.softening([k0, k1], excess);
    let elastic = w.strain_energy([stiffness, beta_t], strain, excess);
    let caloric = w.caloric(c, t, reference);
    let elastic = w.graph.add(elastic, caloric);
    let one = w.graph.integer(1);
    let factor = w.graph.add(one, beta_c);
    let mut psi = w.graph.mul(factor, elastic);
    let force = diff(&mut w.graph, elastic, lambda);
    let mu = w.softening([mu0, mu1], excess);
    for &(_, gamma) in &gammas {
        let square = w.graph.powi(gamma, 2);
        let spring = w.graph.mul(mu, square);
        let coupling = w.graph.product(&[beta_c, gamma, force]);
        let dashpot = w.graph.sub(spring, coupling);
        psi = w.graph.add(psi, dashpot);
    }
    let law = w.viscosity([eta0, a], t, reference);
    let model = Model {
        graph: w.graph,
        measures: vec![lambda],
        strains: vec![],
        dashpots: gammas.iter().map(|&(symbol, _)| symbol).collect(),
        temperature: Some(theta),
        parameters: w.parameters,
        psi,
        viscosities: vec![law; dashpots],
        drag: None,
    };
    Law {
        name,
        model,
        parameters: w.values,
        state,
    }
}

/// Conde Martín, Betsch & García Orden 2016, eq. 43 with C(θ) = C⁰ − C¹ θr ln(θ/θr): no closed
/// inverse of s(θ).
pub(crate) fn logarithmic_stiffness() -> Law {
    let mut w = Writer::new();
    let (lambda, l) = w.variable("lambda");
    let (theta, t) = w.variable("theta");
    let data = [
        ("c0", 5000.0),
        ("c1", 50.0),
        ("beta", 20.0),
        ("capacity", 5000.0),
    ];
    let [c0, c1, beta, capacity] = data.map(|(name, value)| w.parameter(name, value));
    let [l0, reference] = [("l0", 2.0), ("theta_r", 300.0)].map(|(n, v)| w.parameter(n, v));
    let excess = w.graph.sub(t, reference);
    let strain = w.log_ratio(l, l0);
    let logarithm = w.log_ratio(t, reference);
    let loss = w.graph.product(&[c1, reference, logarithm]);
    let stiffness = w.graph.sub(c0, loss);
    let elastic = w.strain_energy([stiffness, beta], strain, excess);
    let caloric = w.caloric(capacity, t, reference);
    let psi = w.graph.add(elastic, caloric);
    let model = Model {
        graph: w.graph,
        measures: vec![lambda],
        strains: vec![],
        dashpots: Vec::new(),
        temperature: Some(theta),
        parameters: w.parameters,
        psi,
        viscosities: Vec::new(),
        drag: None,
    };
    let name = "logarithmic stiffness";
    Law {
        name,
        model,
        parameters: w.values,
        state: vec![2.6, 380.0],
    }
}

/// Two measures and a solid whose heat capacity freezes out: ψ = k/2 (λ₁² + λ₁λ₂²) θ^¼ + c θ ln(1 − e^(−Θ/θ)).
pub(crate) fn einstein() -> Law {
    let mut w = Writer::new();
    let (first, l1) = w.variable("lambda1");
    let (second, l2) = w.variable("lambda2");
    let (theta, t) = w.variable("theta");
    let data = [("k", 3.0), ("c", 2.0), ("einstein", 250.0)];
    let [k, c, einstein] = data.map(|(name, value)| w.parameter(name, value));
    let squares = [l1, l2].map(|l| w.graph.powi(l, 2));
    let mixed = w.graph.mul(l1, squares[1]);
    let strain = w.graph.add(squares[0], mixed);
    let quarter = w.graph.number(Number::from(-1_i64) / Number::from(4_i64));
    let quarter = w.graph.power(t, quarter);
    let half = w.graph.number(Number::HALF);
    let elastic = w.graph.product(&[half, k, strain, quarter]);
    let ratio = w.graph.div(einstein, t);
    let exponent = w.graph.neg(ratio);
    let factor = w.graph.apply(Function::Exp, exponent);
    let minus = w.graph.neg(factor);
    let logarithm = w.graph.apply(Function::Ln1p, minus);
    let caloric = w.graph.product(&[c, t, logarithm]);
    let psi = w.graph.add(elastic, caloric);
    let model = Model {
        graph: w.graph,
        measures: vec![first, second],
        strains: vec![],
        dashpots: Vec::new(),
        temperature: Some(theta),
        parameters: w.parameters,
        psi,
        viscosities: Vec::new(),
        drag: None,
    };
    Law {
        name: "Einstein solid",
        model,
        parameters: w.values,
        state: vec![1.2, 0.7, 150.0],
    }
}

/// No temperature: ψ = k/2 ln²(λ/λ0) + μ γ² − β k γ ln(λ/λ0)/λ.
pub(crate) fn elastic() -> Law {
    let mut w = Writer::new();
    let (lambda, l) = w.variable("lambda");
    let (gamma, g) = w.variable("gamma");
    let data = [
        ("k", 100.0),
        ("mu", 5.0),
        ("beta", 0.1),
        ("l0", 1.0),
        ("eta", 7.0),
    ];
    let [k, mu, beta, l0, eta] = data.map(|(name, value)| w.parameter(name, value));
    let strain = w.log_ratio(l, l0);
    let squares = [strain, g].map(|x| w.graph.powi(x, 2));
    let half = w.graph.number(Number::HALF);
    let elastic = w.graph.product(&[half, k, squares[0]]);
    let viscous = w.graph.mul(mu, squares[1]);
    let quotient = w.graph.div(strain, l);
    let coupling = w.graph.product(&[beta, k, g, quotient]);
    let coupling = w.graph.neg(coupling);
    let psi = w.graph.sum(&[elastic, viscous, coupling]);
    let model = Model {
        graph: w.graph,
        measures: vec![lambda],
        strains: vec![],
        dashpots: vec![gamma],
        temperature: None,
        parameters: w.parameters,
        psi,
        viscosities: vec![eta],
        drag: None,
    };
    Law {
        name: "elastic",
        model,
        parameters: w.values,
        state: vec![1.3, 0.45],
    }
}

//! A law in high precision: corner temperatures by Newton's method, discrete derivatives by plain
//! quotients of e(y, s).

use std::sync::LazyLock;

use eem_symbolic::{Arithmetic, Program, Programs};
use eem_testkit::precise::BigFloat;

use super::laws::Law;
use super::precise::{Precise, to_f64};
use super::solids;

/// How many random solids there are.
pub(crate) const RANDOM: u64 = 3;

/// All laws and then random solids of three measures that nothing is separable in, whose programs take a second.
static BUILT: LazyLock<Vec<(Law, Programs)>> = LazyLock::new(|| {
    let random = (0..RANDOM).map(solids::random);
    let laws = super::all_laws().into_iter().chain(random);
    laws.map(|law| (law.clone(), law.model.programs()))
        .collect()
});

/// All laws and this many random solids.
pub(crate) fn evaluated(random: u64) -> Vec<Evaluated> {
    let left_out = usize::try_from(RANDOM - random).expect("a small number");
    let taken = BUILT.iter().take(BUILT.len() - left_out);
    taken
        .map(|(law, programs)| Evaluated::new(law.clone(), programs.clone()))
        .collect()
}

/// A law that can be evaluated.
pub(crate) struct Evaluated {
    pub(crate) law: Law,
    pub(crate) programs: Programs,
    pub(crate) precise: Precise,
    /// Values of the parameters, those of the law unless a test changes them.
    pub(crate) parameters: State,
}

/// A state in high precision.
pub(crate) type State = Vec<BigFloat>;

impl Evaluated {
    fn new(law: Law, programs: Programs) -> Self {
        let precise = Precise::new();
        Self {
            parameters: precise.all(&law.parameters),
            law,
            programs,
            precise,
        }
    }

    pub(crate) fn thermal(&self) -> bool {
        self.law.model.temperature.is_some()
    }

    /// Number of variables without the temperature.
    pub(crate) fn mechanical(&self) -> usize {
        self.law.state.len() - usize::from(self.thermal())
    }

    /// Outputs of a program at parameters followed by `inputs`.
    pub(crate) fn run(&self, program: &Program, inputs: &[&[BigFloat]]) -> Vec<BigFloat> {
        let mut all = self.parameters.clone();
        for part in inputs {
            all.extend_from_slice(part);
        }
        program.interpret(&self.precise, &all)
    }

    /// θ with S(y, θ) = s, from a start nearby.
    pub(crate) fn temperature(&self, y: &[BigFloat], s: &BigFloat, start: &BigFloat) -> BigFloat {
        let program = self.programs.caloric.as_ref().expect("a thermal law");
        let p = &self.precise;
        let mut point = y.to_vec();
        point.push(start.clone());
        for _ in 0..40 {
            let theta = point.last().expect("θ").clone();
            let caloric = self.run(program, &[&point]);
            let step = p.div(&p.sub(s, &caloric[0]), &caloric[1]);
            let next = p.add(&theta, &p.mul(&theta, &step));
            *point.last_mut().expect("θ") = next;
            if to_f64(&step).abs() < 1e-75 {
                break;
            }
        }
        point.pop().expect("θ")
    }

    pub(crate) fn entropy(&self, x: &[BigFloat]) -> BigFloat {
        let program = self.programs.caloric.as_ref().expect("a thermal law");
        self.run(program, &[x]).swap_remove(0)
    }

    pub(crate) fn energy(&self, x: &[BigFloat]) -> BigFloat {
        self.run(&self.programs.internal_energy, &[x])
            .swap_remove(0)
    }

    /// Corner temperatures in the order of the inputs; none without a temperature.
    pub(crate) fn corners(&self, x0: &[BigFloat], x1: &[BigFloat]) -> State {
        if !self.thermal() {
            return State::new();
        }
        let n = self.mechanical();
        let chain = |from: &[BigFloat], to: &[BigFloat]| -> State {
            let s = self.entropy(from);
            let corner = |k: usize| {
                let y: State = to[..k].iter().chain(&from[k..n]).cloned().collect();
                self.temperature(&y, &s, &from[n])
            };
            (1..=n).map(corner).collect()
        };
        let mut corners = chain(x0, x1);
        corners.extend(chain(x1, x0));
        corners
    }

    /// Response and tangent of the entropy form.
    pub(crate) fn entropy_form(&self, x0: &[BigFloat], x1: &[BigFloat]) -> Vec<BigFloat> {
        let corners = self.corners(x0, x1);
        self.run(&self.programs.entropy_form, &[x0, x1, &corners])
    }

    /// Response and tangent of the temperature form.
    pub(crate) fn temperature_form(&self, x0: &[BigFloat], x1: &[BigFloat]) -> Vec<BigFloat> {
        let program = self
            .programs
            .temperature_form
            .as_ref()
            .expect("a thermal law");
        self.run(program, &[x0, x1])
    }

    /// Number of response entries.
    pub(crate) fn responses(&self) -> usize {
        self.law.state.len() + usize::from(self.thermal())
    }

    /// `D_i F` for all i, by quotients; every increment must be other than zero.
    pub(crate) fn partitioned(
        &self,
        f: &dyn Fn(&[BigFloat]) -> BigFloat,
        v0: &[BigFloat],
        v1: &[BigFloat],
    ) -> Vec<BigFloat> {
        let p = &self.precise;
        let chain = |from: &[BigFloat], to: &[BigFloat], i: usize| {
            let at = |k: usize| -> State { to[..k].iter().chain(&from[k..]).cloned().collect() };
            let rise = p.sub(&f(&at(i + 1)), &f(&at(i)));
            p.div(&rise, &p.sub(&to[i], &from[i]))
        };
        let half = |i: usize| {
            let sum = p.add(&chain(v0, v1, i), &chain(v1, v0, i));
            p.mul(&p.from_f64(0.5), &sum)
        };
        (0..v0.len()).map(half).collect()
    }

    /// The response of the entropy form from its definition.
    pub(crate) fn entropy_quotients(&self, x0: &[BigFloat], x1: &[BigFloat]) -> Vec<BigFloat> {
        let n = self.mechanical();
        if !self.thermal() {
            let derivatives = self.partitioned(&|x| self.energy(x), x0, x1);
            return self.signed(derivatives);
        }
        let with_entropy = |x: &[BigFloat]| -> State {
            let mut v = x[..n].to_vec();
            v.push(self.entropy(x));
            v
        };
        let energy = |v: &[BigFloat]| {
            let theta = self.temperature(&v[..n], &v[n], &x0[n]);
            let mut x = v[..n].to_vec();
            x.push(theta);
            self.energy(&x)
        };
        let (v0, v1) = (with_entropy(x0), with_entropy(x1));
        let mut response = self.signed(self.partitioned(&energy, &v0, &v1));
        response.push(self.precise.sub(&v1[n], &v0[n]));
        response
    }

    /// The response of the temperature form from its definition.
    pub(crate) fn temperature_quotients(&self, x0: &[BigFloat], x1: &[BigFloat]) -> Vec<BigFloat> {
        let (p, n) = (&self.precise, self.mechanical());
        let energy = self.partitioned(&|x| self.energy(x), x0, x1);
        let entropy = self.partitioned(&|x| self.entropy(x), x0, x1);
        let theta = p.div(&energy[n], &entropy[n]);
        let pairs = energy.iter().zip(&entropy).take(n);
        let mut derivatives: State = pairs.map(|(e, s)| p.sub(e, &p.mul(&theta, s))).collect();
        derivatives.push(theta);
        let mut response = self.signed(derivatives);
        response.push(p.sub(&self.entropy(x1), &self.entropy(x0)));
        response
    }

    /// `f* = D_λ e`, `g* = −D_γ e`.
    fn signed(&self, mut derivatives: State) -> State {
        let measures = self.law.model.measures.len();
        let dashpots = self.law.model.dashpots.len();
        for derivative in &mut derivatives[measures..measures + dashpots] {
            *derivative = self.precise.neg(derivative);
        }
        derivatives
    }
}

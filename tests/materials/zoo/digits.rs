//! Derivatives and discrete derivatives of ψ with 96 digits, as plain quotients of differences.

use crate::zoo::number::Value;
use crate::zoo::precise::{Precise, curvature, slope};
use crate::zoo::specimen::Specimen;

/// Newton's method from a temperature with 15 digits: 30, 60, and all of them.
const ITERATIONS: usize = 3;

/// These numbers with all digits.
pub(crate) fn exact(x: &[f64]) -> Vec<Precise> {
    x.iter().map(|&value| Precise::of(value)).collect()
}

/// ψ and what follows from it.
pub(crate) struct Law<'s> {
    pub(crate) specimen: &'s dyn Specimen,
    /// A parameter that has another value than in the specimen.
    pub(crate) moved: Option<(usize, Precise)>,
}

impl<'s> Law<'s> {
    pub(crate) fn new(specimen: &'s dyn Specimen) -> Self {
        let moved = None;
        Self { specimen, moved }
    }

    fn psi(&self, x: &[Precise]) -> Precise {
        self.specimen.precise_psi(x, self.moved)
    }

    fn entropy(&self, x: &[Precise]) -> Precise {
        slope(&|x| self.psi(x), x, x.len() - 1).neg()
    }

    fn energy(&self, x: &[Precise]) -> Precise {
        if !self.specimen.thermal() {
            return self.psi(x);
        }
        self.psi(x).add(x[x.len() - 1].mul(self.entropy(x)))
    }

    fn entropy_slope(&self, x: &[Precise]) -> Precise {
        let last = x.len() - 1;
        curvature(&|x| self.psi(x), x, [last, last]).neg()
    }

    /// Output `i` of a function of a state; nothing for what is a matter of the program.
    pub(crate) fn point(&self, function: &str, i: usize, x: &[Precise]) -> Option<Precise> {
        let (n, psi) = (x.len(), |x: &[Precise]| self.psi(x));
        Some(match (function, i) {
            ("ψ", _) => psi(x),
            ("e", _) => self.energy(x),
            ("gradient", j) => slope(&psi, x, j),
            ("Hessian", j) if j < n => slope(&psi, x, j),
            ("Hessian", entry) => curvature(&psi, x, [entry / n - 1, entry % n]),
            ("caloric", 0) => self.entropy(x),
            ("caloric", 1) => x[n - 1].mul(self.entropy_slope(x)),
            _ => return None,
        })
    }

    /// `x` with the temperature at which it has the entropy `s`, found from a good one.
    fn with_entropy(&self, mut x: Vec<Precise>, s: Precise) -> Vec<Precise> {
        let last = x.len() - 1;
        for _ in 0..ITERATIONS {
            let excess = self.entropy(&x).sub(s);
            x[last] = x[last].sub(excess.div(self.entropy_slope(&x)));
        }
        x
    }

    /// `D_i F = ½ (both chains of quotients)` for the values of F along the chains; where a
    /// variable does not move, there is no quotient.
    fn partitioned(
        ascending: &[Precise],
        descending: &[Precise],
        v: [&[Precise]; 2],
    ) -> Vec<Option<Precise>> {
        let half = |i: usize| {
            let width = v[1][i].sub(v[0][i]);
            let rise = ascending[i + 1].sub(ascending[i]);
            let fall = descending[i].sub(descending[i + 1]);
            let sum = rise.add(fall).mul(Precise::of(0.5));
            (!width.is_zero()).then(|| sum.div(width))
        };
        (0..v[0].len()).map(half).collect()
    }

    /// The response in temperature form, for increments that are not zero.
    fn temperature_form(&self, x0: &[Precise], x1: &[Precise]) -> Option<Vec<Precise>> {
        let mixed = |from: &[Precise], to: &[Precise]| -> Vec<Vec<Precise>> {
            (0..=from.len())
                .map(|k| [&to[..k], &from[k..]].concat())
                .collect()
        };
        let (up, down) = (mixed(x0, x1), mixed(x1, x0));
        let along = |f: &dyn Fn(&[Precise]) -> Precise, chain: &[Vec<Precise>]| -> Vec<Precise> {
            chain.iter().map(|x| f(x)).collect()
        };
        let discrete = |f: &dyn Fn(&[Precise]) -> Precise| {
            let (up, down) = (along(f, &up), along(f, &down));
            Self::partitioned(&up, &down, [x0, x1])
                .into_iter()
                .collect::<Option<Vec<_>>>()
        };
        let (e, s) = (
            discrete(&|x| self.energy(x))?,
            discrete(&|x| self.entropy(x))?,
        );
        let n = x0.len() - 1;
        let theta = e[n].div(s[n]);
        let mut response: Vec<_> = (0..n).map(|i| e[i].sub(theta.mul(s[i]))).collect();
        response.push(theta);
        self.signed(&mut response);
        response.push(self.entropy(x1).sub(self.entropy(x0)));
        Some(response)
    }

    /// The response in entropy form; `near` are the corner temperatures to start from.
    fn entropy_form(
        &self,
        x0: &[Precise],
        x1: &[Precise],
        near: &[Precise],
    ) -> Option<Vec<Precise>> {
        if !self.specimen.thermal() {
            let chain = |from: &[Precise], to: &[Precise]| -> Vec<Precise> {
                (0..=from.len())
                    .map(|k| self.psi(&[&to[..k], &from[k..]].concat()))
                    .collect()
            };
            let discrete = Self::partitioned(&chain(x0, x1), &chain(x1, x0), [x0, x1]);
            let mut response = discrete.into_iter().collect::<Option<Vec<_>>>()?;
            self.signed(&mut response);
            return Some(response);
        }
        let n = x0.len() - 1;
        let [s0, s1] = [x0, x1].map(|x| self.entropy(x));
        let chain = |from: &[Precise], to: &[Precise], s: Precise, near: &[Precise]| {
            let corner = |k: usize| {
                let x = [&to[..k], &from[k..n], &near[k - 1..k]].concat();
                self.energy(&self.with_entropy(x, s))
            };
            let mut energies = vec![self.energy(from)];
            energies.extend((1..=n).map(corner));
            energies.push(self.energy(to));
            energies
        };
        let (up, down) = (chain(x0, x1, s0, &near[..n]), chain(x1, x0, s1, &near[n..]));
        let (v0, v1) = ([&x0[..n], &[s0]].concat(), [&x1[..n], &[s1]].concat());
        let discrete = Self::partitioned(&up, &down, [&v0, &v1]);
        let mut response = discrete.into_iter().collect::<Option<Vec<_>>>()?;
        self.signed(&mut response);
        response.push(s1.sub(s0));
        Some(response)
    }

    /// The response in one of the forms, for increments that are not zero.
    pub(crate) fn form(
        &self,
        function: &str,
        x0: &[Precise],
        x1: &[Precise],
        near: &[Precise],
    ) -> Option<Vec<Precise>> {
        match function {
            "entropy form" => self.entropy_form(x0, x1, near),
            _ => self.temperature_form(x0, x1),
        }
    }

    /// `g* = −D_γ e`.
    fn signed(&self, response: &mut [Precise]) {
        let [first, count] = [self.specimen.measures(), self.specimen.dashpots()];
        for g in &mut response[first..first + count] {
            *g = g.neg();
        }
    }
}

//! One spring at both ends of a step, as the judge sees it.

use super::digits::Digits;
use super::jet::Jet;
use super::model::Body;
use super::stored::Stored;
use super::world::Facts;

/// A spring at the beginning and at the end of a step.
pub(crate) struct Ends<'a> {
    body: &'a dyn Body,
    lambda: [Digits; 2],
    gamma: [Vec<Digits>; 2],
    /// Temperatures, and entropies that are kept.
    pub(crate) theta: Option<[f64; 2]>,
    entropy: [Digits; 2],
    /// `f*` in temperature form, and its like; NaN where the model has none.
    response: (Vec<f64>, Vec<Vec<f64>>),
}

/// All springs of a scene.
pub(crate) fn ends<'a, const D: usize>(facts: &'a Facts<D>, states: [&Stored; 2]) -> Vec<Ends<'a>> {
    let (mut viscous, mut thermal) = (0, 0);
    let mut all = Vec::with_capacity(facts.springs.len());
    for spring in &facts.springs {
        let body = &*spring.body;
        let dashpots = viscous..viscous + body.dashpots();
        viscous = dashpots.end;
        let slot = body.thermal().then_some(thermal);
        thermal += usize::from(body.thermal());
        let lambda = states.map(|state| {
            let [a, b] = spring.ends.map(|node| state.position::<D>(node));
            let arm: [Digits; D] = core::array::from_fn(|axis| b[axis] - a[axis]);
            Digits::norm(&arm)
        });
        let mut ends = Ends {
            body,
            lambda,
            gamma: states.map(|state| state.viscous[dashpots.clone()].to_vec()),
            theta: slot.map(|slot| states.map(|state| state.temperatures[slot])),
            entropy: states.map(|state| slot.map_or(Digits::ZERO, |slot| state.entropies[slot])),
            response: (Vec::new(), Vec::new()),
        };
        let [x0, x1] = [0, 1].map(|end| ends.doubles(end));
        ends.response = body.response(&x0, &x1);
        all.push(ends);
    }
    all
}

/// Whether there are dashpots without temperature, whose heat leaves the scene.
pub(crate) fn has_cold_dashpots<const D: usize>(facts: &Facts<D>) -> bool {
    let is_cold = |body: &dyn Body| body.dashpots() > 0 && !body.thermal();
    facts.springs.iter().any(|spring| is_cold(&*spring.body))
}

/// How many dashpots and paths of heat produce entropy.
pub(crate) fn count_parts<const D: usize>(facts: &Facts<D>) -> f64 {
    let dashpots: usize = facts.springs.iter().map(|own| own.body.dashpots()).sum();
    #[expect(clippy::cast_precision_loss, reason = "small numbers")]
    let parts = (dashpots + facts.paths) as f64;
    parts
}

impl Ends<'_> {
    /// (λ, γ …, θ) at one end.
    fn doubles(&self, end: usize) -> Vec<f64> {
        let mut x = vec![self.lambda[end].value()];
        x.extend(self.gamma[end].iter().map(|gamma| gamma.value()));
        x.extend(self.theta.map(|theta| theta[end]));
        x
    }

    /// ψ and its derivative by θ, with all digits.
    fn psi(&self, end: usize) -> Jet {
        let mut x = vec![Jet::constant(self.lambda[end])];
        x.extend(self.gamma[end].iter().map(|&gamma| Jet::constant(gamma)));
        x.extend(self.theta.map(|theta| Jet::temperature(theta[end])));
        self.body.psi(&x)
    }

    /// `ψ + θ s` with the entropy that is kept.
    pub(crate) fn energy(&self, end: usize) -> Digits {
        let heat = self.theta.map(|theta| self.entropy[end] * theta[end]);
        self.psi(end).value + heat.unwrap_or(Digits::ZERO)
    }

    /// `|s(λ, γ, θ) − s|` at the end of the step, and `|s|₊ + Σ |∂s/∂x| |x| + c` with the magnitude of the terms of s.
    pub(crate) fn kept_entropy(&self) -> (f64, f64) {
        let defect = (self.psi(1).slope + self.entropy[1]).value().abs();
        let x = self.doubles(1);
        let hessian = self.body.hessian(&x);
        let last = x.len() - 1;
        let slopes: f64 = (0..last).map(|j| (hessian[last][j] * x[j]).abs()).sum();
        let caloric = self.body.caloric(&x);
        let terms = caloric.magnitude.max(self.entropy[1].value().abs());
        (defect, terms + slopes + caloric.heat_capacity.abs())
    }

    /// The largest of `|f|` at both ends and `|f*|`.
    pub(crate) fn force(&self) -> f64 {
        let at = |end: usize| self.body.gradient(&self.doubles(end))[0].abs();
        let middle = self.response.0[0].abs();
        at(0)
            .max(at(1))
            .max(if middle.is_finite() { middle } else { 0.0 })
    }

    pub(crate) fn length(&self) -> f64 {
        self.lambda[0].value().max(self.lambda[1].value())
    }

    /// What the element contributes to `A + A⁺` besides its [`energies`](Self::energies).
    pub(crate) fn way(&self, step: f64) -> f64 {
        self.dissipation(step) + self.work_of_arguments()
    }

    /// `Σ over both ends (|f| λ + Σ |g γ| + |ψ| + θ |s| + c θ)`, with the rounding of f and g.
    pub(crate) fn energies(&self) -> f64 {
        self.energies_at(0) + self.energies_at(1)
    }

    fn energies_at(&self, end: usize) -> f64 {
        let x = self.doubles(end);
        let gradient = self.body.gradient(&x);
        let mechanical = x.len() - usize::from(self.theta.is_some());
        // A force is known to ε |∂f/∂x| |x|, which is all there is of one that has relaxed.
        let hessian = self.body.hessian(&x);
        let force = |i: usize| {
            let terms = hessian[i].iter().zip(&x).map(|(h, x)| (h * x).abs());
            gradient[i].abs() + f64::EPSILON * terms.sum::<f64>()
        };
        let work: f64 = (0..mechanical).map(|i| force(i) * x[i].abs()).sum();
        let psi = self.body.free_energy(&x).abs();
        let Some(theta) = self.theta else {
            return work + psi;
        };
        let capacity = self.body.caloric(&x).heat_capacity.abs();
        work + psi + theta[end] * (self.entropy[end].value().abs() + capacity)
    }

    /// `Σ η Δγ²/h`, with the larger η of both ends.
    fn dissipation(&self, step: f64) -> f64 {
        if self.gamma[0].is_empty() {
            return 0.0;
        }
        let theta = self.theta.unwrap_or([1.0; 2]);
        let [eta0, eta1] = theta.map(|theta| self.body.viscosities(theta));
        let change = |k: usize| (self.gamma[1][k] - self.gamma[0][k]).value();
        let heat = |k: usize| {
            // A viscosity that overflows at an end says nothing of that within the step.
            let finite = [eta0[k], eta1[k]].into_iter().filter(|eta| eta.is_finite());
            finite.fold(0.0, f64::max) * change(k) * (change(k) / step)
        };
        (0..eta0.len()).map(heat).sum()
    }

    /// `Σ_ij |T_ij| |x_j| |Δx_i|`; where T is not finite, with the Hessian of an end in its place.
    fn work_of_arguments(&self) -> f64 {
        let [x0, x1] = [0, 1].map(|end| self.doubles(end));
        let mut changes = vec![(self.lambda[1] - self.lambda[0]).value()];
        let gammas = self.gamma[0].iter().zip(&self.gamma[1]);
        changes.extend(gammas.map(|(&old, &new)| (new - old).value()));
        if self.theta.is_some() {
            changes.push((self.entropy[1] - self.entropy[0]).value());
        }
        let of = |tangent: &[Vec<f64>]| -> f64 {
            let row = |i: usize| -> f64 {
                let terms =
                    (0..x1.len()).map(|j| tangent[i][j].abs() * x0[j].abs().max(x1[j].abs()));
                terms.sum()
            };
            (0..changes.len()).map(|i| row(i) * changes[i].abs()).sum()
        };
        let tangents = [
            &self.response.1,
            &self.body.hessian(&x0),
            &self.body.hessian(&x1),
        ];
        let works = tangents.map(|tangent| of(tangent));
        works
            .into_iter()
            .find(|work| work.is_finite())
            .unwrap_or(0.0)
    }
}

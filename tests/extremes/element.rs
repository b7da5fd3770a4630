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
    let is_cold =
        |body: &dyn Body| !body.thermal() && (body.dashpots() > 0 || body.drag(1.0).is_some());
    facts.springs.iter().any(|spring| is_cold(&*spring.body))
}

/// How many dashpots and paths of heat produce entropy.
pub(crate) fn count_parts<const D: usize>(facts: &Facts<D>) -> f64 {
    let of_spring = |body: &dyn Body| body.dashpots() + usize::from(body.drag(1.0).is_some());
    let dashpots: usize = facts.springs.iter().map(|own| of_spring(&*own.body)).sum();
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

    /// The largest of `|f|` at both ends and `|f*|`, with that of a dashpot in parallel in a step of this size.
    pub(crate) fn force(&self, step: f64) -> f64 {
        let at = |end: usize| self.body.gradient(&self.doubles(end))[0].abs();
        let middle = self.response.0[0].abs();
        at(0)
            .max(at(1))
            .max(if middle.is_finite() { middle } else { 0.0 })
            + self.drag(step)
    }

    pub(crate) fn length(&self) -> f64 {
        self.lambda[0].value().max(self.lambda[1].value())
    }

    /// What the element contributes to `A + A⁺` besides its [`energies`](Self::energies).
    pub(crate) fn way(&self, step: f64) -> f64 {
        self.dissipations(step).iter().sum::<f64>() + self.work_of_arguments()
    }

    /// `Σ over both ends (|f| λ + Σ |g γ| + |ψ| + θ |s| + c θ)`, with the rounding of f and g. The force of a dashpot in
    /// parallel is that of the step, at both.
    pub(crate) fn energies(&self, step: f64) -> f64 {
        let drag = self.drag(step) * (2.0 * self.length());
        self.energies_at(0) + self.energies_at(1) + drag
    }

    /// The force of the dashpot in parallel, if there is one, N.
    fn drag(&self, step: f64) -> f64 {
        let way = (self.lambda[1] - self.lambda[0]).value().abs();
        self.largest_drag() * way / step
    }

    /// η of the dashpot in parallel, if there is one.
    fn largest_drag(&self) -> f64 {
        let drag = |theta: f64| self.body.drag(theta).unwrap_or(0.0);
        let theta = self.theta.unwrap_or([1.0; 2]);
        drag(theta[0]).max(drag(theta[1]))
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

    /// `Σ η Δγ²/h`, and `η Δλ²/h` of a dashpot in parallel, with the larger η of both ends: no creep from one end to the
    /// other dissipates less where η is constant.
    pub(crate) fn dissipations(&self, step: f64) -> [f64; 2] {
        let theta = self.theta.unwrap_or([1.0; 2]);
        let [eta0, eta1] = theta.map(|theta| {
            let mut all = self.body.viscosities(theta);
            all.extend(self.body.drag(theta));
            all
        });
        let creep = self.gamma[0].iter().zip(&self.gamma[1]);
        let creep = creep.map(|(&old, &new)| (new - old).value());
        let changes = creep.chain([(self.lambda[1] - self.lambda[0]).value()]);
        let heat = |(change, etas): (f64, [f64; 2])| {
            // A viscosity that overflows at an end says nothing of that within the step.
            let finite = etas.into_iter().filter(|eta| eta.is_finite());
            finite.fold(0.0, f64::max) * change * (change / step)
        };
        let etas = eta0.into_iter().zip(eta1).map(|(old, new)| [old, new]);
        let heats: Vec<f64> = changes.zip(etas).map(heat).collect();
        let (creep, drag) = heats.split_at(self.gamma[0].len());
        [creep.iter().sum(), drag.iter().sum()]
    }

    /// What the arguments of forces round by in a step from the beginning, in units of ε: `Σ |H_ij| |x_j| |Δx_i|` with the
    /// change of length that is given and the creep of the step, and `k λ` times the way of its supports, J.
    pub(crate) fn rounding(&self, [apart, step]: [f64; 2], supports: f64) -> f64 {
        let x = self.doubles(0);
        let (gradient, hessian) = (self.body.gradient(&x), self.body.hessian(&x));
        let etas = self
            .body
            .viscosities(self.theta.map_or(1.0, |theta| theta[0]));
        let creep = |(k, eta): (usize, &f64)| {
            gradient[k].abs() * (step / eta).min(hessian[k][k].abs().recip())
        };
        let mut changes = vec![apart];
        changes.extend((1..).zip(&etas).map(creep));
        let row = |i: usize| -> f64 { (0..x.len()).map(|j| (hessian[i][j] * x[j]).abs()).sum() };
        let works = changes
            .iter()
            .enumerate()
            .map(|(i, change)| row(i) * change);
        let drag = 2.0 * self.largest_drag() * apart / step * self.length();
        works.sum::<f64>() + row(0) * supports + drag
    }

    /// `|∂²ψ/∂λ²|` at the beginning, N/m.
    pub(crate) fn stiffness(&self) -> f64 {
        self.body.hessian(&self.doubles(0))[0][0].abs()
    }

    /// Whether its forces are between those at its ends: there is no dashpot in parallel.
    pub(crate) fn has_forces_of_ends(&self) -> bool {
        self.body.drag(1.0).is_none()
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

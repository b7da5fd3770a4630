//! Rules of several stages in a step, as numbers.

/// A rule of several stages: a partitioned Runge–Kutta method for positions and momenta, with its equations for the
/// internal variables of an element.
///
/// Stages are numbered in the order of time. Those before [`known`](Self::known) are at the old positions and
/// viscous stretches; each of the others has a set of unknowns, `q_i − q⁰`, `γ_i` and a temperature.
#[derive(Debug)]
pub(crate) struct Tableau {
    /// c: the times of the stages, as fractions of the step.
    pub(crate) times: &'static [f64],
    /// The number of stages at the start of the step.
    pub(crate) known: usize,
    /// `q_i = q⁰ + c_i (h/m)(p⁰ − h Σ_j positions_ij F_j)`, a row per set: A Â divided by c.
    pub(crate) positions: &'static [&'static [f64]],
    /// `γ_i = γ⁰ + h Σ_j rates_ij γ̇_j`, a row per set.
    pub(crate) rates: &'static [&'static [f64]],
    /// b: `p¹ = p⁰ − h Σ b_i F_i`, `γ¹ = γ⁰ + h Σ b_i γ̇_i`, `s¹ = s⁰ + h Σ b_i Φ_i`.
    pub(crate) weights: &'static [f64],
    /// `θ_i = Σ_k temperatures_ik Θ_k` with an unknown Θ per set; a row per stage.
    pub(crate) temperatures: &'static [&'static [f64]],
    /// The equations for Θ, one per set.
    pub(crate) entropies: &'static [EntropyBalance],
    /// `h v_i = Σ_j motion_ij (q_j − q⁰)`, the motion at a stage from the displacements of the sets.
    pub(crate) motion: &'static [&'static [f64]],
    pub(crate) ending: Ending,
    /// The projection of the conjugates of the stages from the path of an element; without one they are values at the
    /// stages.
    pub(crate) path: Option<Path>,
}

/// The path of an element through a step, and the projection of quantities at its points.
///
/// The strain C (λ² of a spring, E of a solid), viscous stretches and entropy are polynomials, whose degree is the number of
/// stages, given by their increments `h ẏ_j` at the stages. With `ê = e(C, γ, s)` the conjugates of a stage are
///
/// ```text
/// a_i = Σ_r projection_ir ∇ê(y(τ_r)),   y(τ_r) = y⁰ + Σ_j integrals_rj h ẏ_j
/// ```
///
/// the polynomials nearest to `∇ê` along the path, in the mean of squares.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Path {
    /// `∫_0^τ ℓ_j` for each point of the quadrature.
    pub(crate) integrals: &'static [&'static [f64]],
    /// `w_r ℓ_i(τ_r)/b_i`, a row per stage.
    pub(crate) projection: &'static [&'static [f64]],
    pub(crate) supports: Supports,
}

/// The times at which prescribed motions and temperatures are evaluated: as many as there are stages, the last of which is
/// the end of the step. With the old state they are the nodes of Lobatto's rule, so that the error of the polynomial is
/// orthogonal to everything that would cost order.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Supports {
    pub(crate) times: &'static [f64],
    /// The prescribed displacement of an anchor at a stage from those at the times, a row per stage.
    pub(crate) to_stages: &'static [&'static [f64]],
    /// `∫_0^τ ℓ_j` for each time.
    pub(crate) integrals: &'static [&'static [f64]],
    /// Lobatto's rule: the start of the step and the times, and their weights.
    pub(crate) mean: [&'static [f64]; 2],
}

/// `Σ_i entropies_i s_i = old s⁰ + h Σ_i rates_i Φ_i`, with the entropies `s_i = s(λ_i, γ_i, θ_i)` of the stages
/// and their rates `Φ = (Σ g²/η + Q)/θ`.
#[derive(Debug)]
pub(crate) struct EntropyBalance {
    pub(crate) entropies: &'static [f64],
    pub(crate) old: f64,
    pub(crate) rates: &'static [f64],
    /// The stage whose rate weighs most: Newton's method works on its θ times the equation, which is far
    /// less curved where conduction is stiff.
    pub(crate) stage: usize,
    /// The stage whose temperature is Θ.
    pub(crate) unknown: usize,
    /// The entropy that a thermostat gives at each stage per unit of the defect of the equation.
    pub(crate) supply: &'static [f64],
}

impl EntropyBalance {
    /// `s_i = s⁰ + h Σ_j rates_j Φ_j` of a stage whose temperature is unknown, with the row of its own entropy.
    pub(crate) const fn of_stage(stage: usize, [own, rates, supply]: [&'static [f64]; 3]) -> Self {
        Self {
            entropies: own,
            old: 1.0,
            rates,
            stage,
            unknown: stage,
            supply,
        }
    }
}

/// The rule for the end of a step.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Ending {
    /// Stage after stage from the forces before it; a stage that depends on its own force `A q_i` needs one linear solve.
    /// The last stage is the end.
    StageByStage,
    /// From the forces: `q¹ = q⁰ + (h/m)(p⁰ − h Σ_j weights_j F_j)`.
    Forces(&'static [f64]),
    /// From the displacements of the stages less those of free flight, `w_j = u_j − c_j (h/m) p⁰`, where the
    /// polynomials through them end:
    ///
    /// ```text
    /// q¹ = q⁰ + (h/m) p⁰ + Σ_j displacements_j w_j      displacements = bᵀA⁻¹
    /// p¹ = p⁰ + (m/h) Σ_j impulses_j w_j                impulses = bᵀA⁻²
    /// ```
    Increments {
        displacements: &'static [f64],
        impulses: &'static [f64],
    },
}

/// The most sets of unknowns of a rule, the most stages, and the most points of a path.
pub(crate) const MOST_SETS: usize = 3;
pub(crate) const MOST_STAGES: usize = 3;
pub(crate) const MOST_POINTS: usize = 5;

/// A set of unknowns: the increments `u = q_i − q⁰` with
/// `(inertia m/h)(u − time (h/m) p⁰) = −h Σ weights F`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UnknownSet {
    pub(crate) time: f64,
    pub(crate) inertia: f64,
}

impl Tableau {
    pub(crate) const fn stages(&self) -> usize {
        self.times.len()
    }

    pub(crate) const fn sets(&self) -> usize {
        self.positions.len()
    }

    /// The temperatures of a path that are prescribed at its supports, from the old one, K, and the integral of the squares of their
    /// rates, K²; none without a path.
    pub(crate) fn course(
        &self,
        old: f64,
        prescribed: &[f64; MOST_STAGES],
    ) -> Option<([f64; MOST_POINTS + 1], f64)> {
        let path = self.path?;
        let sum = |shares: &[f64], terms: &[f64; MOST_STAGES]| {
            let terms = shares.iter().zip(terms);
            terms.fold(0.0, |sum, (share, term)| sum + share * term)
        };
        let changes = prescribed.map(|theta| theta - old);
        let (mut at_stages, mut rates) = ([0.0; MOST_STAGES], [0.0; MOST_STAGES]);
        for (at_stage, row) in at_stages.iter_mut().zip(path.supports.to_stages) {
            *at_stage = sum(row, &changes);
        }
        for (rate, row) in rates.iter_mut().zip(self.motion) {
            *rate = sum(row, &at_stages);
        }
        let mut temperatures = [old; MOST_POINTS + 1];
        for (theta, row) in temperatures.iter_mut().zip(path.integrals) {
            *theta = old + sum(row, &rates);
        }
        temperatures[MOST_POINTS] = prescribed[self.stages() - 1];
        let squares = rates.map(|rate| rate * rate);
        Some((temperatures, sum(self.weights, &squares)))
    }

    /// The stage of a set.
    pub(crate) const fn stage_of(&self, set: usize) -> usize {
        self.known + set
    }

    /// The set of a stage; `None` for stages at the start of the step.
    pub(crate) const fn set_of(&self, stage: usize) -> Option<usize> {
        stage.checked_sub(self.known)
    }

    /// The residual ρ of the momentum balance of a set does the work `ρ·Σ_k ways_k u_k/h`, with the displacements u of the
    /// sets: the residuals of all sets leave
    ///
    /// ```text
    /// r_j = h ṗ_j − h F_j = Σ_set (A⁻²)_{j,set} c_set ρ_set,      work = Σ_j b_j q̇_j·r_j,      h q̇_j = Σ_k (A⁻¹)_jk u_k
    /// ```
    ///
    /// at the stages.
    pub(crate) fn ways_of_residual(&self, set: usize) -> impl Iterator<Item = f64> {
        let time = self.times[self.stage_of(set)];
        (0..self.sets()).map(move |other| {
            let stages = self.weights.iter().zip(self.motion);
            let terms = stages.map(|(weight, motion)| {
                let twice = motion.iter().zip(self.motion).map(|(a, row)| a * row[set]);
                weight * twice.sum::<f64>() * motion[other]
            });
            time * terms.sum::<f64>()
        })
    }

    /// The weight of Θ of a set in the temperature of a stage.
    pub(crate) fn share(&self, stage: usize, set: usize) -> f64 {
        self.temperatures[stage][set]
    }
}

#[cfg(test)]
mod tests {
    use crate::step::rule::{eem_entropy_4, eem_entropy_6, gauss_4, variational_4};

    use super::{Ending, MOST_SETS, Tableau};

    const ALL: [&Tableau; 4] = [
        &variational_4::TABLEAU,
        &gauss_4::TABLEAU,
        &eem_entropy_4::TABLEAU,
        &eem_entropy_6::TABLEAU,
    ];

    /// Roundings of sums with terms up to 16.
    const ROUNDINGS: f64 = 64.0;

    fn assert_near(a: f64, b: f64) {
        assert!((a - b).abs() < ROUNDINGS * f64::EPSILON, "{a} {b}");
    }

    fn dot(a: &[f64], b: impl Iterator<Item = f64>) -> f64 {
        a.iter().zip(b).map(|(a, b)| a * b).sum()
    }

    #[test]
    fn weights_integrate_cubics() {
        for rule in ALL {
            for power in 0..4 {
                let integral = dot(rule.weights, rule.times.iter().map(|c| c.powi(power)));
                assert_near(integral, 1.0 / f64::from(power + 1));
            }
        }
    }

    #[test]
    fn stages_are_exact_for_constant_rates_and_forces() {
        for rule in ALL {
            for set in 0..rule.sets() {
                let time = rule.times[rule.stage_of(set)];
                assert_near(rule.rates[set].iter().sum(), time);
                // ∫∫ 1 dt dt = c²/2
                assert_near(rule.positions[set].iter().sum(), 0.5 * time);
            }
        }
    }

    #[test]
    fn motion_is_that_of_quadratic_positions() {
        for rule in ALL {
            for (stage, row) in rule.motion.iter().enumerate() {
                let c = |set: usize| rule.times[rule.stage_of(set)];
                assert_near(dot(row, (0..rule.sets()).map(c)), 1.0);
                let squares = dot(row, (0..rule.sets()).map(|set| c(set) * c(set)));
                assert_near(squares, 2.0 * rule.times[stage]);
            }
        }
    }

    #[test]
    fn equal_temperatures_and_entropies_stay() {
        for rule in ALL {
            for row in rule.temperatures {
                assert_near(row.iter().sum(), 1.0);
            }
            for balance in rule.entropies {
                assert_near(balance.entropies.iter().sum(), balance.old);
                assert_near(rule.temperatures[balance.unknown].iter().sum(), 1.0);
            }
        }
    }

    /// `c_j^power/power`, what `∫_0^τ t^(power − 1) dt` integrates, at the stages.
    fn monomials(rule: &Tableau, power: i32) -> impl Iterator<Item = f64> {
        let rates = rule.times.iter().map(move |c| c.powi(power - 1));
        rates.map(move |rate| f64::from(power) * rate)
    }

    #[test]
    fn paths_are_exact_for_polynomials_and_their_ends_lie_on_them() {
        for rule in ALL {
            let Some(path) = rule.path else { continue };
            let supports = path.supports;
            for power in 1..=i32::try_from(rule.stages()).unwrap() {
                for (time, row) in supports.times.iter().zip(supports.integrals) {
                    assert_near(dot(row, monomials(rule, power)), time.powi(power));
                }
                for (c, row) in rule.times.iter().zip(supports.to_stages) {
                    let known = supports.times.iter().map(|time| time.powi(power));
                    assert_near(dot(row, known), c.powi(power));
                }
                let [times, weights] = supports.mean;
                assert_eq!(&times[1..], supports.times);
                let known = times.iter().map(|time| time.powi(power));
                assert_near(dot(weights, known), 1.0 / f64::from(power + 1));
                let Ending::Increments {
                    displacements,
                    impulses,
                } = rule.ending
                else {
                    panic!("the end is that of the paths");
                };
                let stages = || rule.times.iter().map(|c| c.powi(power));
                assert_near(dot(displacements, stages()), 1.0);
                // From rest, w = ∫ p/m: p = τ^n gives w = τ^(n + 1)/(n + 1).
                if power > 1 {
                    assert_near(dot(impulses, stages()) / f64::from(power), 1.0);
                }
                // The projection gives back polynomials of the degree of the rates.
                if power < i32::try_from(rule.stages()).unwrap() {
                    for (row, c) in path.projection.iter().zip(rule.times) {
                        let points = path.integrals.iter();
                        let values = points.map(|row| dot(row, monomials(rule, power)));
                        assert_near(dot(row, values), c.powi(power));
                    }
                }
            }
        }
    }

    /// What the momenta at the end gain beyond the work of the forces, for displacements that solve no balance.
    #[test]
    fn residuals_do_the_work_that_forces_do_not() {
        // m = h = 1
        let (v, forces, moved) = (0.7, [0.3, -1.1, 0.45], [0.2, -0.6, 0.9]);
        for rule in [&eem_entropy_4::TABLEAU, &eem_entropy_6::TABLEAU] {
            let Ending::Increments { impulses, .. } = rule.ending else {
                panic!("the end is that of the paths");
            };
            let (mut work, mut beyond) = (0.0, [0.0; MOST_SETS]);
            for (set, &time) in rule.times.iter().enumerate() {
                beyond[set] = moved[set] - time * v;
                let motion = dot(rule.motion[set], moved.into_iter());
                work += rule.weights[set] * forces[set] * motion;
            }
            for (set, &time) in rule.times.iter().enumerate() {
                let residual = beyond[set] / time - dot(rule.positions[set], forces.into_iter());
                work += residual
                    * rule
                        .ways_of_residual(set)
                        .zip(moved)
                        .map(|(way, u)| way * u)
                        .sum::<f64>();
            }
            let end = v + dot(impulses, beyond.into_iter());
            assert_near(work / (0.5 * (end * end - v * v)), 1.0);
        }
    }
}

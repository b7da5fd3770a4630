//! The discrete derivatives of e(λ, γ, s): entropy is the variable, at given corner temperatures.
//!
//! ```text
//! up:    x⁰ = A₀ → A₁ → … → A_n → x¹      A_k: y_1 … y_k new, the others old, entropy s⁰
//! down:  x¹ = B₀ → B₁ → … → B_n → x⁰      B_k: y_1 … y_k old, the others new, entropy s¹
//! f* = D_λ e,  g* = −D_γ e,  θ* = D_s e,  Δs = S(x¹) − S(x⁰)
//! ```
//!
//! (García Orden & Romero 2012, eqs. 25–28), n variables y and the entropy renewed last. The
//! temperature `θ_c` of a corner c is an input and solves `S(y_c, θ_c) = s_c`; it depends on x¹ through
//!
//! ```text
//! S_θ(c) dθ_c = ds_c − Σ_{j new in c} S_j(c) dx_j¹,   ds⁰ = 0,  ds¹ = Σ_j S_j(x¹) dx_j¹
//! ```

use super::edge::{self, Edge};
use super::mixed_states::mixed_states;
use super::step::{Form, Point, Step, mixed};
use crate::node::{ExprId, Symbol};

/// `[f*_a …, g*_k …, θ*, Δs]` and their tangent by rows.
pub(crate) fn entropy_form(step: &mut Step) -> Form {
    let stairs = Stairs::new(step);
    let last = step.mechanical;
    let (mut response, mut tangent) = (Vec::new(), Vec::new());
    for i in 0..=last {
        let edges = stairs.edges(step, i);
        let values = edges.each_ref().map(|edge| edge.value);
        let derivative = step.half(&values);
        response.push(if i < last {
            step.conjugate(i, derivative)
        } else {
            derivative
        });
        let row = stairs.total(step, &edges);
        for derivative in row {
            tangent.push(if i < last {
                step.conjugate(i, derivative)
            } else {
                derivative
            });
        }
    }
    response.push(jump(step));
    tangent.extend(stairs.slopes);
    Form { response, tangent }
}

/// `[f*_a …, g*_k …, θ*, Δs]` without tangent, then `[S(c) − s_c …, θ_c S_θ(c) …]`, from which the derivatives of
/// corner temperatures with respect to parameters follow. Both are made of the same divided differences.
pub(crate) fn entropy_form_with_corners(step: &mut Step, theta: Symbol) -> Form {
    let form = entropy_form(step);
    let corners = mixed_states(step, theta);
    let response = [form.response, corners.response, corners.tangent].concat();
    let tangent = Vec::new();
    Form { response, tangent }
}

/// S(x¹) − S(x⁰) as the sum of divided differences times increments, which keeps its relative
/// accuracy when both states are close.
fn jump(step: &mut Step) -> ExprId {
    let (old, new) = (step.old.clone(), step.new.clone());
    let mut terms = Vec::new();
    for i in 0..=step.mechanical {
        let state = mixed(i, &old, &new);
        let slope = step.along(step.entropy, i, [old[i], new[i]], &state);
        let increment = step.increment(i);
        terms.push(step.graph.mul(slope, increment));
    }
    step.graph.sum(&terms)
}

/// Both staircases, and the derivatives of their corner temperatures.
struct Stairs {
    up: Vec<Point>,
    down: Vec<Point>,
    corners: Vec<Corner>,
    /// `S_j(x¹)`, the derivatives of s¹.
    slopes: Vec<ExprId>,
}

/// The derivatives of one corner temperature with respect to x¹.
struct Corner {
    theta: Symbol,
    /// Whether the entropy of the corner is s¹.
    new_entropy: bool,
    /// `1 / S_θ(c)`.
    reciprocal: ExprId,
    /// `S_j(c)` of the variables that are new in c.
    slopes: Vec<(usize, ExprId)>,
}

impl Stairs {
    fn new(step: &mut Step) -> Self {
        let n = step.mechanical;
        let (old, new) = (step.old.clone(), step.new.clone());
        let mut up = step.staircase(0, &new, &old);
        let mut down = step.staircase(n, &old, &new);
        let mut corners = Vec::new();
        for (k, point) in up.iter().enumerate().skip(1) {
            corners.push(Corner::new(step, point, 0..k, false));
        }
        for (k, point) in down.iter().enumerate().skip(1) {
            corners.push(Corner::new(step, point, k..n, true));
        }
        let slopes = (0..=n)
            .map(|j| step.slope_at(step.entropy, j, &new))
            .collect();
        up.push(new);
        down.push(old);
        Self {
            up,
            down,
            corners,
            slopes,
        }
    }

    /// Both edges on which variable `i` changes; the last variable is the entropy.
    fn edges(&self, step: &mut Step, i: usize) -> [Edge; 2] {
        if i < step.mechanical {
            [
                edge::mechanical(step, i, &self.up[i], &self.up[i + 1]),
                edge::mechanical(step, i, &self.down[i + 1], &self.down[i]),
            ]
        } else {
            [
                edge::thermal(step, &self.up[i], &self.up[i + 1]),
                edge::thermal(step, &self.down[i + 1], &self.down[i]),
            ]
        }
    }

    /// Half the sum of the total derivatives of two edges with respect to x¹.
    fn total(&self, step: &mut Step, edges: &[Edge; 2]) -> Vec<ExprId> {
        let mut row: Vec<Vec<ExprId>> = vec![Vec::new(); step.new.len()];
        let mut entropy = Vec::new();
        for &(symbol, partial) in edges.iter().flat_map(|edge| &edge.partials) {
            if let Some(j) = step.new.iter().position(|&new| new == symbol) {
                row[j].push(partial);
            } else {
                let corner = self.corners.iter().find(|corner| corner.theta == symbol);
                let corner = corner.expect("what moves and is no variable is a corner temperature");
                let force = step.graph.mul(partial, corner.reciprocal);
                let force = step.name(force);
                for &(j, slope) in &corner.slopes {
                    let term = step.graph.mul(force, slope);
                    row[j].push(step.graph.neg(term));
                }
                if corner.new_entropy {
                    entropy.push(force);
                }
            }
        }
        let entropy = step.graph.sum(&entropy);
        let entropy = step.name(entropy);
        let columns = row.iter_mut().zip(&self.slopes);
        let half = |(terms, &slope): (&mut Vec<ExprId>, &ExprId)| {
            terms.push(step.graph.mul(entropy, slope));
            step.half(terms)
        };
        columns.map(half).collect()
    }
}

impl Corner {
    fn new(
        step: &mut Step,
        point: &Point,
        renewed: std::ops::Range<usize>,
        new_entropy: bool,
    ) -> Self {
        let capacity = step.slope_at(step.entropy, step.mechanical, point);
        Self {
            theta: point[step.mechanical],
            new_entropy,
            reciprocal: step.reciprocal(capacity),
            slopes: renewed
                .map(|j| (j, step.slope_at(step.entropy, j, point)))
                .collect(),
        }
    }
}

impl Step {
    /// The state `from`, then the mixed states with the first 1, 2, … variables of `to`, at the corner temperatures
    /// `corners[first]`, `corners[first + 1]`, ….
    pub(super) fn staircase(&self, first: usize, to: &Point, from: &Point) -> Vec<Point> {
        let mut points = vec![from.clone()];
        for k in 1..=self.mechanical {
            let mut point = mixed(k, to, from);
            point[self.mechanical] = self.corners[first + k - 1];
            points.push(point);
        }
        points
    }
}

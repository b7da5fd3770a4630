//! How a step integrates a load that is a function of time.

use crate::step::explicit::{load_rule, motion_rule};
use crate::step::scheme::{Closing, Scheme};

/// The times at which a step evaluates a load, as shares of the step, and their weights in its integral.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LoadRule {
    pub(crate) times: &'static [f64],
    pub(crate) weights: &'static [f64],
    /// The order of the scheme, if its error is estimated from the step in two halves, which are kept.
    pub(crate) order: Option<f64>,
}

impl LoadRule {
    /// Of forces and thrusts; `order` as in the result.
    pub(crate) const fn of_forces(scheme: Scheme, order: Option<f64>) -> Self {
        let rule = match (scheme.tableau(), scheme.closing()) {
            (Some(rule), _) => (rule.times, rule.weights),
            (None, Closing::Explicit) => load_rule(),
            (None, _) => return Self::middle(order),
        };
        Self::new(rule, order)
    }

    /// Of the displacement of moved anchors, whose integral acts on masses.
    pub(crate) fn of_motions(scheme: Scheme, order: Option<f64>) -> Self {
        let rule = match (scheme.tableau(), scheme.closing()) {
            (Some(rule), _) => match rule.path {
                Some(path) => path.supports.mean.into(),
                None => (rule.times, rule.weights),
            },
            (None, Closing::Explicit) => motion_rule(),
            // The anchor goes along a straight line.
            (None, _) => (&[0.0, 1.0][..], &[0.5, 0.5][..]),
        };
        Self::new(rule, order)
    }

    /// Of ovens: every scheme takes their temperature from the middle.
    pub(crate) const fn middle(order: Option<f64>) -> Self {
        Self::new((&[0.5], &[1.0]), order)
    }

    const fn new((times, weights): (&'static [f64], &'static [f64]), order: Option<f64>) -> Self {
        Self {
            times,
            weights,
            order,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::LoadRule;
    use crate::step::scheme::Scheme;

    #[test]
    fn rules_are_exact_to_the_order_of_the_scheme() {
        for scheme in Scheme::ALL
            .into_iter()
            .filter(|scheme| scheme.may_change_steps())
        {
            let order = i32::from(scheme.order());
            for rule in [LoadRule::of_forces, LoadRule::of_motions] {
                let rule = rule(scheme, None);
                for power in 0..order {
                    let terms = rule.times.iter().zip(rule.weights);
                    let mean: f64 = terms.map(|(time, weight)| weight * time.powi(power)).sum();
                    assert!(
                        (mean * f64::from(power + 1) - 1.0).abs() < 1e-13,
                        "{scheme} {power}"
                    );
                }
            }
        }
    }
}

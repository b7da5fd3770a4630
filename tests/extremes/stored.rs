//! The state of a scene with all that it stores, values and carries, read from its checkpoint.

use eem::Simulation;
use serde_json::Value;

use super::digits::Digits;

/// What a state consists of; lists are in the order of creation.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Stored {
    pub(crate) time: f64,
    /// q and p, node after node.
    pub(crate) positions: Vec<Digits>,
    pub(crate) momenta: Vec<Digits>,
    /// γ of all dashpots.
    pub(crate) viscous: Vec<Digits>,
    /// s and θ of the elements that have them.
    pub(crate) entropies: Vec<Digits>,
    pub(crate) temperatures: Vec<f64>,
    /// σ of the reservoirs.
    pub(crate) reservoirs: Vec<Digits>,
    pub(crate) work: Digits,
    /// Given by thermostats, and the entropy that they received.
    pub(crate) heat: Digits,
    pub(crate) thermostats: Digits,
    /// Of dashpots without temperature.
    pub(crate) lost: Digits,
}

impl Stored {
    pub(crate) fn of<const D: usize>(run: &Simulation<D>) -> Self {
        let text = serde_json::to_value(run.checkpoint()).expect("a checkpoint can be written");
        let state = &text["state"];
        let sums = |name: &str| -> Vec<Digits> {
            let list = state[name].as_array();
            list.expect("a list of sums").iter().map(sum).collect()
        };
        let temperatures = state["temperatures"].as_array().expect("a list");
        Self {
            time: sum(&state["time"]).value(),
            positions: sums("positions"),
            momenta: sums("momenta"),
            viscous: sums("viscous"),
            entropies: sums("entropies"),
            temperatures: temperatures.iter().map(number).collect(),
            reservoirs: sums("reservoir_entropies"),
            work: sum(&state["work"]),
            heat: sum(&state["heat"]),
            thermostats: sum(&state["thermostat_entropy"]),
            lost: sum(&state["dissipated"]),
        }
    }

    /// The coordinates of a node.
    pub(crate) fn position<const D: usize>(&self, node: usize) -> [Digits; D] {
        core::array::from_fn(|axis| self.positions[node * D + axis])
    }

    pub(crate) fn momentum<const D: usize>(&self, node: usize) -> [Digits; D] {
        core::array::from_fn(|axis| self.momenta[node * D + axis])
    }
}

/// A value and its carry.
fn sum(pair: &Value) -> Digits {
    Digits::pair([number(&pair[0]), number(&pair[1])])
}

/// A number; what is not finite has no JSON and is not a number here.
fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

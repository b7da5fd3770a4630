//! A ledger in print.

use core::fmt;

use super::Ledger;
use eem_material::number::scalar::Real;

impl<const D: usize, S: Real> fmt::Display for Ledger<D, S> {
    /// A balance sheet, a line per quantity.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scalars = [
            ("kinetic energy", self.kinetic_energy, "J"),
            ("potential energy", self.potential_energy, "J"),
            ("internal energy", self.internal_energy, "J"),
            ("heat in reservoirs", self.reservoir_heat, "J"),
            ("heat lost", self.lost_heat, "J"),
            ("energy E", self.energy, "J"),
            ("work of loads", self.work, "J"),
            ("heat of thermostats", self.heat, "J"),
            ("E − work − heat", self.balance, "J"),
            ("entropy of elements", self.element_entropy, "J/K"),
            ("… of their state", self.element_entropy_of_state, "J/K"),
            ("… of reservoirs", self.reservoir_entropy, "J/K"),
            ("… of thermostats", self.thermostat_entropy, "J/K"),
            ("entropy S", self.entropy, "J/K"),
        ];
        for (quantity, value, unit) in scalars {
            line(f, quantity, value, unit)?;
        }
        for (axis, &momentum) in ["x", "y", "z"].iter().zip(self.linear_momentum.iter()) {
            line(f, &format!("momentum, {axis}"), momentum, "N s")?;
        }
        // In the plane only the last has a value.
        let first = if D == 2 { 2 } else { 0 };
        let axes = ["x", "y", "z"].iter().zip(self.angular_momentum.iter());
        for (axis, &momentum) in axes.skip(first) {
            line(f, &format!("angular, {axis}"), momentum, "N m s")?;
        }
        Ok(())
    }
}

fn line<S: Real>(f: &mut fmt::Formatter<'_>, name: &str, value: S, unit: &str) -> fmt::Result {
    let value = format!("{:.15e}", value.to_f64());
    writeln!(f, "| {name:<19} | {value:<20} | {unit:<5} |")
}

//! A member of the sweep: a pendulum from a row of inputs, and the end of its run as numbers in columns.

use eem_sweep::{InputError, Plan, Record, Row, Sweep};

use crate::pendulum::{End, Pendulum, Spring};

impl Record for End {
    const COLUMNS: &'static [&'static str] = &[
        "temperature (K)",
        "entropy (J/K)",
        "energy_defect",
        "entropy_loss (J/K)",
    ];

    fn write(&self, row: &mut [f64]) {
        let Self {
            temperature,
            entropy,
            energy_defect,
            entropy_loss,
        } = *self;
        row.copy_from_slice(&[temperature, entropy, energy_defect, entropy_loss]);
    }
}

/// The spring whose numbers are in a row.
fn spring(row: Row<'_>) -> Result<Spring, InputError> {
    let values = row.values().try_into();
    let values = values.map_err(|_| InputError::refused("a spring has five numbers"))?;
    Ok(Spring { values })
}

/// The sweep whose members make so many steps.
pub(crate) fn sweep(plan: Plan, steps: usize) -> Sweep<'static> {
    let pendulum = Pendulum { steps };
    plan.closures(spring, Pendulum::build, move |run, spring, _| {
        pendulum.observe(run, spring)
    })
}

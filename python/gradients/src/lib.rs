//! Gradients and tangents of runs in one to three dimensions: what goes through their steps is compiled here and nowhere else,
//! for speed. The rest of the package is compiled for size, with which the gradient of a lattice took 1.6 times as long.

use eem::{Gradient, GradientError, Input, Objective, Quantity, Sensitivities, Simulation};

/// A run with derivatives.
pub trait Gradients<const D: usize> {
    /// As [`Simulation::gradient`].
    ///
    /// # Errors
    ///
    /// Those of [`Simulation::gradient`].
    fn find_gradient(&mut self, objective: &Objective<D>) -> Result<Gradient<D>, GradientError>;

    /// Finds it and checks it, see [`Simulation::check_gradient`].
    ///
    /// # Errors
    ///
    /// Those of [`Simulation::gradient`] and [`Simulation::check_gradient`].
    fn confirm_gradient(&mut self, objective: &Objective<D>) -> Result<(), GradientError>;

    /// As [`Simulation::sensitivities`].
    ///
    /// # Errors
    ///
    /// Those of [`Simulation::sensitivities`].
    fn find_sensitivities(
        &mut self,
        inputs: &[Input<D>],
        quantities: Vec<(String, Quantity<D>)>,
    ) -> Result<Sensitivities, GradientError>;
}

macro_rules! gradients {
    ($($dim:literal)*) => {
        $(
            impl Gradients<$dim> for Simulation<$dim> {
                fn find_gradient(
                    &mut self,
                    objective: &Objective<$dim>,
                ) -> Result<Gradient<$dim>, GradientError> {
                    self.gradient(objective)
                }

                fn confirm_gradient(
                    &mut self,
                    objective: &Objective<$dim>,
                ) -> Result<(), GradientError> {
                    let gradient = self.gradient(objective)?;
                    self.check_gradient(&gradient, objective)
                }

                fn find_sensitivities(
                    &mut self,
                    inputs: &[Input<$dim>],
                    quantities: Vec<(String, Quantity<$dim>)>,
                ) -> Result<Sensitivities, GradientError> {
                    self.sensitivities(inputs, quantities)
                }
            }
        )*
    };
}

gradients!(1 2 3);

//! The shapes of springs, and the choice among them when a program runs.

use eem_material::number::scalar::Real;
use eem_runtime::{Element, Node, Scene};

use crate::error::LawError;
use crate::law::{Law, MOST_DASHPOTS};
use crate::typed::Typed;

macro_rules! shapes {
    ($($(#[$docs:meta])* $name:ident: $n:literal, $k:literal, $d:literal, $c:literal, $r:literal;)*) => {
        $(
            $(#[$docs])*
            pub type $name<S = f64> = Typed<S, $n, $k, $d, $c, $r>;
        )*

        impl Law {
            /// Puts a spring of this law between two nodes of a scene, whatever its shape is.
            ///
            /// The solver is compiled for each of the 16 shapes, as for 16 derived materials, for every dimension and type of
            /// numbers that a program calls this for. A program that knows the shapes of its laws calls
            /// [`model`](Self::model) instead.
            ///
            /// # Errors
            ///
            /// [`LawError::NotFinite`] if a value is not finite in the numbers of the scene, [`LawError::TooLarge`]. The scene
            /// is not changed then.
            ///
            /// ```
            /// use eem::prelude::*;
            /// use eem::typed::{Law, Source, compile};
            ///
            /// let elastic = Source::new("|lambda: Stretch| 0.5 * k * (lambda - 1).powi(2)");
            /// let damped = elastic.clone().viscosity("lambda", "k / 20");
            /// let mut scene = Scene::<1>::new();
            /// let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.5], [0.0])];
            /// for source in [elastic, damped] {
            ///     let law = Law::new(compile(&source.parameter("k", None))?, &[("k", 40.0)])?;
            ///     law.add_spring(&mut scene, ends)?;
            /// }
            /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.01)?;
            /// run.run_until(5.0)?;
            /// // ω² = 80/s², damping rate 1/s
            /// let exact = 1.0 + 0.5 * (-5.0_f64).exp() * (79.0_f64.sqrt() * 5.0).cos();
            /// assert!((run.position(ends[1])?[0] - exact).abs() < 1e-3);
            /// # Ok::<(), Box<dyn std::error::Error>>(())
            /// ```
            pub fn add_spring<S: Real, const D: usize>(
                &self,
                scene: &mut Scene<D, S>,
                nodes: [Node; 2],
            ) -> Result<Element, LawError> {
                match self.shape() {
                    $([$n, $k, $d, $c, $r] => Ok(scene.spring(self.model::<S, $n, $k, $d, $c, $r>()?, nodes)),)*
                    [_, dashpots, ..] => Err(LawError::Dashpots { dashpots, most: MOST_DASHPOTS }),
                }
            }
        }
    };
}

shapes! {
    /// A spring without temperature and dashpots.
    Spring0: 1, 0, 0, 0, 1;
    /// A spring without temperature, with one dashpot in series.
    Spring1: 2, 1, 0, 0, 2;
    /// A spring without temperature, with two dashpots in series.
    Spring2: 3, 2, 0, 0, 3;
    /// A spring without temperature, with three dashpots in series.
    Spring3: 4, 3, 0, 0, 4;
    /// A spring with a temperature, without dashpots.
    ThermalSpring0: 2, 0, 0, 2, 3;
    /// A spring with a temperature and one dashpot in series.
    ThermalSpring1: 3, 1, 0, 4, 4;
    /// A spring with a temperature and two dashpots in series.
    ThermalSpring2: 4, 2, 0, 6, 5;
    /// A spring with a temperature and three dashpots in series.
    ThermalSpring3: 5, 3, 0, 8, 6;
    /// A spring without temperature, with a dashpot beside it.
    DampedSpring0: 1, 0, 1, 0, 1;
    /// A spring without temperature, with a dashpot beside it and one in series.
    DampedSpring1: 2, 1, 1, 0, 2;
    /// A spring without temperature, with a dashpot beside it and two in series.
    DampedSpring2: 3, 2, 1, 0, 3;
    /// A spring without temperature, with a dashpot beside it and three in series.
    DampedSpring3: 4, 3, 1, 0, 4;
    /// A spring with a temperature and a dashpot beside it.
    DampedThermalSpring0: 2, 0, 1, 2, 3;
    /// A spring with a temperature, a dashpot beside it and one in series.
    DampedThermalSpring1: 3, 1, 1, 4, 4;
    /// A spring with a temperature, a dashpot beside it and two in series.
    DampedThermalSpring2: 4, 2, 1, 6, 5;
    /// A spring with a temperature, a dashpot beside it and three in series.
    DampedThermalSpring3: 5, 3, 1, 8, 6;
}

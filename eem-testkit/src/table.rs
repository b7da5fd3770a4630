//! Free energies behind a table of functions.
//!
//! The solver is compiled for each model, with each scheme. For springs of this module it is compiled only here, once for each
//! number of dashpots. Any model can be behind the table: results are the same, but slower.

use std::sync::Arc;

use eem::prelude::*;
use eem::{Array, Caloric};

/// The functions of a free energy, on slices; without a dashpot in parallel with the spring.
pub trait Table: Send + Sync {
    /// The numbers of measures of the deformation, of dashpots and of temperatures (0 or 1).
    fn variables(&self) -> [usize; 3];
    /// The numbers that programs take before the state.
    fn parameters(&self) -> Vec<f64>;
    fn free_energy(&self, x: &[f64]) -> f64;
    fn energy_magnitude(&self, x: &[f64]) -> f64;
    fn internal_energy(&self, x: &[f64]) -> f64;
    fn gradient(&self, x: &[f64]) -> Vec<f64>;
    /// Gradient, then Hessian by rows.
    fn hessian(&self, x: &[f64]) -> Vec<f64>;
    /// By rows.
    fn entropy_hessian(&self, x: &[f64]) -> Vec<f64>;
    fn caloric(&self, x: &[f64]) -> Caloric<f64>;
    /// All η, then all dη/dθ.
    fn viscosity(&self, theta: f64) -> Vec<f64>;
    /// Response, then tangent by rows.
    fn entropy_form(&self, x0: &[f64], x1: &[f64], corners: &[f64]) -> Vec<f64>;
    fn temperature_form(&self, x0: &[f64], x1: &[f64]) -> Vec<f64>;
    /// Responses without tangents.
    fn entropy_response(&self, x0: &[f64], x1: &[f64], corners: &[f64]) -> Vec<f64>;
    fn temperature_response(&self, x0: &[f64], x1: &[f64]) -> Vec<f64>;
}

/// The array with these elements.
pub fn array<A: Array<f64>>(elements: &[f64]) -> A {
    let mut array = A::filled(0.0);
    array.as_mut().copy_from_slice(elements);
    array
}

fn rows<R: Array<f64>, M: Array<R>>(elements: &[f64]) -> M {
    let mut matrix = M::filled(R::filled(0.0));
    for (row, elements) in matrix.as_mut().iter_mut().zip(elements.chunks(R::LEN)) {
        row.as_mut().copy_from_slice(elements);
    }
    matrix
}

fn flat<R: Array<f64>, M: Array<R>>(first: &[f64], matrix: &M) -> Vec<f64> {
    let rows = matrix.as_ref().iter().flat_map(AsRef::as_ref);
    first.iter().chain(rows).copied().collect()
}

impl<F: FreeEnergy<f64> + Send + Sync> Table for F {
    fn variables(&self) -> [usize; 3] {
        [F::MEASURES, F::DASHPOTS, usize::from(F::THERMAL)]
    }

    fn parameters(&self) -> Vec<f64> {
        let count = F::PARAMETERS.len();
        (0..count).map(|index| self.parameter(index)).collect()
    }

    fn free_energy(&self, x: &[f64]) -> f64 {
        FreeEnergy::free_energy(self, &array(x))
    }

    fn energy_magnitude(&self, x: &[f64]) -> f64 {
        FreeEnergy::energy_magnitude(self, &array(x))
    }

    fn internal_energy(&self, x: &[f64]) -> f64 {
        FreeEnergy::internal_energy(self, &array(x))
    }

    fn gradient(&self, x: &[f64]) -> Vec<f64> {
        FreeEnergy::gradient(self, &array(x)).as_ref().to_vec()
    }

    fn hessian(&self, x: &[f64]) -> Vec<f64> {
        let (gradient, hessian) = FreeEnergy::hessian(self, &array(x));
        flat(gradient.as_ref(), &hessian)
    }

    fn entropy_hessian(&self, x: &[f64]) -> Vec<f64> {
        flat(&[], &FreeEnergy::entropy_hessian(self, &array(x)))
    }

    fn caloric(&self, x: &[f64]) -> Caloric<f64> {
        FreeEnergy::caloric(self, &array(x))
    }

    fn viscosity(&self, theta: f64) -> Vec<f64> {
        let (eta, slope) = FreeEnergy::viscosity(self, theta);
        [eta.as_ref(), slope.as_ref()].concat()
    }

    fn entropy_form(&self, x0: &[f64], x1: &[f64], corners: &[f64]) -> Vec<f64> {
        let old = self.entropy_form_old(&array(x0));
        let (response, tangent) = FreeEnergy::entropy_form(self, &old, &array(x1), &array(corners));
        flat(response.as_ref(), &tangent)
    }

    fn temperature_form(&self, x0: &[f64], x1: &[f64]) -> Vec<f64> {
        let old = self.temperature_form_old(&array(x0));
        let (response, tangent) = FreeEnergy::temperature_form(self, &old, &array(x1));
        flat(response.as_ref(), &tangent)
    }

    fn entropy_response(&self, x0: &[f64], x1: &[f64], corners: &[f64]) -> Vec<f64> {
        let old = self.entropy_form_old(&array(x0));
        let response = self.entropy_form_response(&old, &array(x1), &array(corners));
        response.as_ref().to_vec()
    }

    fn temperature_response(&self, x0: &[f64], x1: &[f64]) -> Vec<f64> {
        let old = self.temperature_form_old(&array(x0));
        let response = self.temperature_form_response(&old, &array(x1));
        response.as_ref().to_vec()
    }
}

/// A type of springs for each number of dashpots, with and without temperature.
macro_rules! springs {
    ($($name:ident: $dashpots:literal, $thermal:literal,
        [$n:literal variables, $corners:literal corners, $responses:literal responses];)*) => {
        $(
            struct $name(Arc<dyn Table>);

            impl FreeEnergy<f64> for $name {
                const MEASURES: usize = 1;
                const DASHPOTS: usize = $dashpots;
                const THERMAL: bool = $thermal;
                const MODEL: &'static str = stringify!($name);
                const PARAMETERS: &'static [&'static str] = &[];

                type Parameters = [f64; 0];
                type Variables = [f64; $n];
                type Hessian = [[f64; $n]; $n];
                type Viscosities = [f64; $dashpots];
                type Drag = [f64; 0];
                type Corners = [f64; $corners];
                type Response = [f64; $responses];
                type Tangent = [[f64; $n]; $responses];
                type EntropyFormOld = [f64; $n];
                type TemperatureFormOld = [f64; $n];

                fn duplicate(&self) -> Self {
                    Self(Arc::clone(&self.0))
                }

                fn parameter(&self, _index: usize) -> f64 {
                    unreachable!("there are none")
                }

                fn free_energy(&self, x: &Self::Variables) -> f64 {
                    self.0.free_energy(x)
                }

                fn energy_magnitude(&self, x: &Self::Variables) -> f64 {
                    self.0.energy_magnitude(x)
                }

                fn internal_energy(&self, x: &Self::Variables) -> f64 {
                    self.0.internal_energy(x)
                }

                fn gradient(&self, x: &Self::Variables) -> Self::Variables {
                    array(&self.0.gradient(x))
                }

                fn hessian(&self, x: &Self::Variables) -> (Self::Variables, Self::Hessian) {
                    let all = self.0.hessian(x);
                    let (gradient, hessian) = all.split_at($n);
                    (array(gradient), rows(hessian))
                }

                fn caloric(&self, x: &Self::Variables) -> Caloric<f64> {
                    self.0.caloric(x)
                }

                fn entropy_hessian(&self, x: &Self::Variables) -> Self::Hessian {
                    rows(&self.0.entropy_hessian(x))
                }

                fn viscosity(&self, theta: f64) -> (Self::Viscosities, Self::Viscosities) {
                    let all = self.0.viscosity(theta);
                    let (eta, slope) = all.split_at($dashpots);
                    (array(eta), array(slope))
                }

                fn drag(&self, _theta: f64) -> (Self::Drag, Self::Drag) {
                    ([], [])
                }

                fn entropy_form_old(&self, x0: &Self::Variables) -> Self::Variables {
                    *x0
                }

                fn entropy_form(
                    &self,
                    old: &Self::Variables,
                    x1: &Self::Variables,
                    corners: &Self::Corners,
                ) -> (Self::Response, Self::Tangent) {
                    let all = self.0.entropy_form(old, x1, corners);
                    let (response, tangent) = all.split_at($responses);
                    (array(response), rows(tangent))
                }

                fn entropy_form_response(
                    &self,
                    old: &Self::Variables,
                    x1: &Self::Variables,
                    corners: &Self::Corners,
                ) -> Self::Response {
                    array(&self.0.entropy_response(old, x1, corners))
                }

                fn temperature_form_old(&self, x0: &Self::Variables) -> Self::Variables {
                    *x0
                }

                fn temperature_form(
                    &self,
                    old: &Self::Variables,
                    x1: &Self::Variables,
                ) -> (Self::Response, Self::Tangent) {
                    let all = self.0.temperature_form(old, x1);
                    let (response, tangent) = all.split_at($responses);
                    (array(response), rows(tangent))
                }

                fn temperature_form_response(
                    &self,
                    old: &Self::Variables,
                    x1: &Self::Variables,
                ) -> Self::Response {
                    array(&self.0.temperature_response(old, x1))
                }
            }
        )*

        /// Adds a spring of any model without a dashpot in parallel, in the plane.
        pub fn spring(scene: &mut Scene<2>, model: Arc<dyn Table>, ends: [Node; 2]) -> Element {
            match model.variables() {
                $([1, $dashpots, thermal] if (thermal == 1) == $thermal => {
                    scene.spring($name(model), ends)
                })*
                other => panic!("no spring has {other:?} variables"),
            }
        }
    };
}

springs! {
    Elastic: 0, false, [1 variables, 0 corners, 1 responses];
    Warm: 0, true, [2 variables, 2 corners, 3 responses];
    Damped: 1, false, [2 variables, 0 corners, 2 responses];
    WarmDamped: 1, true, [3 variables, 4 corners, 4 responses];
    WarmTwiceDamped: 2, true, [4 variables, 6 corners, 5 responses];
    WarmThriceDamped: 3, true, [5 variables, 8 corners, 6 responses];
}

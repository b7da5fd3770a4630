//! Ready materials. Each is a struct with a free energy and [`FreeEnergy`](crate::FreeEnergy), as you would write it.
//!
//! | | variables | free energy ψ |
//! |---|---|---|
//! | [`Hooke`] | λ | ½ k (λ − L)² |
//! | [`Hencky`] | λ | ½ k ln²(λ/L) |
//! | [`GentSpring`] | λ | −½ E J ln(1 − (I − 3)/J) |
//! | [`ThermoelasticSpring`] | λ, θ | ½ k ε² − β (θ − θr) ε + c (θ − θr − θ ln(θ/θr)) |
//! | [`LogarithmicStiffness`] | λ, θ | the same with k = C₀ − C₁ θr ln(θ/θr) |
//! | [`MaxwellDamper`] | λ, γ, θ | a thermoelastic spring in parallel with a spring and a dashpot in series |
//! | [`KelvinVoigtDamper`] | λ, θ | a thermoelastic spring in parallel with a dashpot |
//! | [`ThermoViscoElastic`] | λ, γ, θ | the element of García Orden & Romero |
//! | [`SaintVenantKirchhoff`] | E | ½ Λ tr²E + μ E:E |
//! | [`NeoHooke`] | E, J | μ (tr E − ln J) + ½ Λ ln²J |
//! | [`ThermoelasticSolid`] | E, J, θ | the same with heat, expansion and a shear modulus that falls with θ |
//!
//! λ is the length of a spring, L its natural length, ε = ln(λ/L), γ the extension of a dashpot, θ the temperature, E the
//! Green–Lagrange strain and J = det F. Energies are in J for springs and in J/m³ of the undeformed body for solids. All
//! fields have SI units, which the derive checks.
//!
//! ```
//! use eem::materials::Hooke;
//! use eem::prelude::*;
//!
//! let mut scene = Scene::<2>::new();
//! let wall = scene.anchor([0.0, 0.0]);
//! let mass = scene.mass(1.0, [1.1, 0.0], [0.0, 0.0]);
//! let hooke = Hooke { stiffness: 100.0, natural_length: 1.0 };
//! scene.spring(hooke, [wall, mass]);
//! let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.01)?;
//! run.step()?;
//! assert!((run.ledger().energy - 0.5).abs() < 1e-14);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod dampers;
mod solids;
mod springs;

pub use dampers::{KelvinVoigtDamper, MaxwellDamper, ThermoViscoElastic};
pub use solids::{NeoHooke, SaintVenantKirchhoff, ThermoelasticSolid};
pub use springs::{GentSpring, Hencky, Hooke, LogarithmicStiffness, ThermoelasticSpring};

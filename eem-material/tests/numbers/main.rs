//! The numbers that formulas are evaluated with: kernels against high precision, and inverted entropies.

mod elementary;
mod inversion;
mod kernels_accuracy;
mod kernels_properties;

use eem::FreeEnergy;

// The parser takes the `if` for a statement and stumbles over `+`.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| { if lambda > 1.0 { k } else { c } + lambda })]
struct StartOfABlock {
    k: f64,
    c: f64,
}

// Before `{`, `c { … }` is no struct, and so the condition ends there.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda + if lambda == Bound { at: 1.0 } { k } else { 0.0 })]
struct StructLiteral {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| { let x = if lambda > 1.0; k * x })]
struct WithoutBranches {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda if lambda > 1.0 else 0.0)]
struct BehindTheValue {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| { match lambda { _ => k } + lambda })]
struct Match {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda + (match lambda))]
struct MatchWithoutArms {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| k * (lambda - gamma).powi(2))]
#[viscosity(gamma = { if eta > 1 { 1 } else { 2 } + eta })]
struct InALaw {
    k: f64,
    eta: f64,
}

// What is wrong before the `if` is a mistake of its own.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k lambda + if lambda > 1.0 { k } else { 0.0 })]
struct MissingOperator {
    k: f64,
}

fn main() {}

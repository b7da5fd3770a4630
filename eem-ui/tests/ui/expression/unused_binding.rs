use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| {
    let strain = ln(lambda);
    let _kept = ln(lambda / 2);
    0.5 * k * (lambda - gamma).powi(2)
})]
#[viscosity(gamma = { let rate = 2; k })]
struct Model {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| {
    let unused = |x| x * k;
    let _kept = |x| x * k;
    let partly = |x, y| { let z = x; let _kept = y; let inner = |u| u + y; x };
    let called_by_none = |x| partly(x, x);
    let empty = |x, _y| k;
    k * lambda + empty(lambda, k) + empty(k, k)
})]
struct Helpers {
    k: f64,
}

fn main() {}

use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| if lambda > 1.0 { k } else { c } * 2.0)]
struct Body {
    k: f64,
    c: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda + if lambda > 1.0 { c } else { 0.0 } * lambda)]
struct InASum {
    k: f64,
    c: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| {
    let bounded = if lambda > 1.0 { lambda } else { 1.0 } * 2.0;
    k * bounded + lambda * match k { _ => 1.0 }
})]
struct InALet {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| { if lambda > 1.0 { k } else { c } * lambda.powi(2) + c })]
struct StartOfABlock {
    k: f64,
    c: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| {
    let x = lambda;
    match k { _ => x } & lambda;
    k * x
})]
struct StartOfAStatement {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| k * (lambda - gamma).powi(2))]
#[viscosity(gamma = eta * if eta > 1 { 1 } else { 2 })]
struct InALaw {
    k: f64,
    eta: f64,
}

fn main() {}

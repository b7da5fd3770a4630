use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| {
    let a = if lambda > k { 1 } else { 2 };
    let b = match lambda { _ => 1 };
    let c = loop { break 1; };
    let d = while k { };
    let e = for i in k { };
    return a + b
})]
struct Model {
    k: f64,
}

fn main() {}

use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| {
    const A: f64 = 1.0;
    k * lambda;
    println!("{}", k);
    let x;
    let (a, b) = k;
    let mut y = k;
    let z: f64 = k;
    let Some(w) = k else { k };
    k * lambda;
})]
struct Model {
    k: f64,
}

fn main() {}

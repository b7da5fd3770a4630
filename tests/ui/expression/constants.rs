use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda * PI + core::f64::consts::TAU + f64::consts::LN_2)]
struct Model {
    k: f64,
}

fn main() {}

use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k[0] * lambda + k[1] * lambda.powi(2) + b[0] * lambda + b[1] * lambda)]
struct Model {
    #[unit("N")]
    k: [f64; 2],
    b: [f64; 2],
}

fn main() {}

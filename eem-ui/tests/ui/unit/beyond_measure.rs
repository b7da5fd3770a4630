use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda.powi(2000000000).powi(2000000000).powi(2000000000).powi(2000000000).powi(2000000000))]
struct Model {
    #[unit("J")]
    k: f64,
}

fn main() {}

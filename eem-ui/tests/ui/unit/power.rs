use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda.powf(n) + k * (lambda / length).powf(length) + k * sqrt(lambda) / length.powf(0.5) + k * lambda.powf(1.5) / length)]
struct Model {
    #[unit("J")]
    k: f64,
    #[unit("1")]
    n: f64,
    #[unit("m")]
    length: f64,
}

fn main() {}
